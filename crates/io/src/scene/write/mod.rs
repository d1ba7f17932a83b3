//! A scene, or what was read of a model, as a scene file with all that it needs.
//!
//! Meshes, pictures and profiles of lamps go into a folder beside the file, from memory, each once however often it is used; so it does
//! not matter where they came from. The scene file comes last: where it is, everything is.

mod files;
mod text;

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use eyebeam_core::desc::SceneDesc;

use crate::error::Error;
use crate::output::write_atomic;

use files::Files;

/// How a scene is written.
#[derive(Clone, Copy, Debug, Default)]
pub struct WriteOptions<'a> {
    /// Whether files that are there are replaced.
    pub force: bool,
    /// The first line, without `#`.
    pub comment: &'a str,
}

/// What was written besides the scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The folder beside it.
    pub folder: PathBuf,
    /// The number of files in it; there is no folder if it is 0.
    pub files: usize,
}

/// Finds out, before work begins, whether a scene can be written under this name.
///
/// # Errors
/// If there is such a file, or a folder for what it needs, and nothing may be replaced.
pub fn check_unwritten(path: &Path, force: bool) -> Result<(), Error> {
    let taken = |path: &Path| {
        let why = std::io::Error::new(ErrorKind::AlreadyExists, "it is there already; `--force` replaces it");
        Err(Error::write(path, why))
    };
    let folder = folder_beside(path);
    match force {
        false if path.exists() => taken(path),
        false if folder.exists() => taken(&folder),
        _ => crate::output::check_writable(path),
    }
}

/// Writes a scene whose files are loaded; reading it gives the same scene, but for the names of these files.
///
/// # Errors
/// If a file is there that must not be replaced, or the file system refuses.
pub fn write(desc: &SceneDesc, path: &Path, options: &WriteOptions<'_>) -> Result<Written, Error> {
    check_unwritten(path, options.force)?;
    let folder = folder_beside(path);
    let refused = |e| Error::write(&folder, e);
    // A folder that is new appears whole; in one that was there, each file does.
    let staged = if folder.exists() {
        None
    } else {
        let beside = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some(tempfile::Builder::new().prefix(".eyebeam-").suffix(".part").tempdir_in(beside).map_err(refused)?)
    };
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut desc = desc.clone();
    let mut files = Files::new(staged.as_ref().map_or(folder.as_path(), |staged| staged.path()), &name);
    files.write(&mut desc)?;
    let written = Written { folder: folder.clone(), files: files.count() };
    let text = text::of(&desc, options.comment)?;
    if let Some(staged) = staged.filter(|_| written.files > 0) {
        let staged = staged.keep();
        open_to_others(&staged).and_then(|()| fs::rename(&staged, &folder)).map_err(|e| {
            let _ = fs::remove_dir_all(&staged);
            refused(e)
        })?;
    }
    write_atomic(path, text.as_bytes())?;
    Ok(written)
}

/// For `room.toml` it is `room-assets`.
fn folder_beside(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push("-assets");
    path.with_file_name(name)
}

/// Folders for a moment are their owner's alone; this one is to be like any other.
fn open_to_others(folder: &Path) -> std::io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What the process's mask leaves of a new folder is seen on one.
        let like = folder.join(".like");
        fs::create_dir(&like)?;
        let mode = fs::metadata(&like)?.permissions().mode();
        fs::remove_dir(&like)?;
        fs::set_permissions(folder, fs::Permissions::from_mode(mode))?;
    }
    Ok(())
}
