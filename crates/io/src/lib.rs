//! Files: scenes to [`SceneDesc`](eyebeam_core::desc::SceneDesc), pictures to bytes.
//!
//! Everything read from outside ends here, as a description or as an [`Error`] with its place; nothing panics.
#![forbid(unsafe_code)]

pub mod error;
mod file;
pub mod ies;
pub mod image;
mod memory;
pub mod output;
pub mod scene;
mod warning;

pub use error::{At, Diagnostic, Error, Fault, FileError, Place};
pub use warning::Warning;
