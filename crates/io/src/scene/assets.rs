//! The files that a scene names: pictures, meshes, profiles of lamps. Those of textures are in [`textures`](super::textures).
//!
//! A file is read once, however often it is named, and shared.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::light::{EnvironmentDesc, IesProfile};
use eyebeam_core::shape::MeshData;

use crate::error::{At, Error, Fault, FileError};
use crate::file;
use crate::ies::read_ies_bytes;
use crate::image::{image_size, read_image_bytes};
use crate::memory::Memory;
use crate::scene::ply::{mesh_size, read_ply_bytes};
use crate::scene::textures;
use crate::warning::Warning;

/// What is to be said about a file, where its name stands.
pub(super) struct Note {
    /// Keys and indices from the root of the scene.
    pub(super) path: Vec<String>,
    pub(super) message: String,
    pub(super) hint: Option<String>,
    /// Whose fault it is; nobody's if the file is read, but not all of it was kept.
    pub(super) fault: Option<Fault>,
}

/// Reads all files that are named. `folder_of` tells where relative names at a path of keys are looked for.
pub(super) fn load<'a>(
    desc: &mut SceneDesc,
    memory: &Memory,
    folder_of: impl Fn(&[String]) -> Option<&'a Path>,
) -> Vec<Note> {
    let mut loader = Loader { folder_of, memory, notes: Vec::new() };
    let mut images = Cache::default();
    if let EnvironmentDesc::Image(map) = &mut desc.environment {
        map.image = loader.get(&mut images, path(&["environment", "image"], None), &map.file);
    }
    for (i, light) in desc.light.projector.iter_mut().enumerate() {
        light.image = loader.get(&mut images, path(&["light", "projector"], Some(i)), &light.file);
    }
    textures::load(&mut loader, &mut desc.texture);
    let mut profiles = Cache::default();
    for (i, light) in desc.light.ies.iter_mut().enumerate() {
        light.profile = loader.get(&mut profiles, path(&["light", "ies"], Some(i)), &light.file);
    }
    let mut meshes = Cache::default();
    for (i, mesh) in desc.shape.mesh.iter_mut().enumerate() {
        if let Some(file) = &mesh.file {
            mesh.data = loader.get(&mut meshes, path(&["shape", "mesh"], Some(i)), file);
        }
    }
    loader.notes
}

/// Keys down to a `file`.
pub(super) fn path(keys: &[&str], index: Option<usize>) -> Vec<String> {
    let keys = keys.iter().map(|key| (*key).to_owned());
    keys.chain(index.map(|i| i.to_string())).chain(["file".to_owned()]).collect()
}

/// What a file becomes.
trait Asset: Sized {
    /// The memory that it takes, about, by its header alone.
    fn size(name: &str, bytes: &[u8]) -> Result<u64, Error>;

    fn read(name: &str, bytes: &[u8]) -> Result<(Self, Vec<Warning>), Error>;
}

impl Asset for Image {
    fn size(name: &str, bytes: &[u8]) -> Result<u64, Error> {
        image_size(name, bytes)
    }

    fn read(name: &str, bytes: &[u8]) -> Result<(Self, Vec<Warning>), Error> {
        read_image_bytes(name, bytes)
    }
}

impl Asset for IesProfile {
    fn size(_: &str, bytes: &[u8]) -> Result<u64, Error> {
        // A number takes two bytes of text at least.
        Ok(2 * bytes.len() as u64)
    }

    fn read(name: &str, bytes: &[u8]) -> Result<(Self, Vec<Warning>), Error> {
        read_ies_bytes(name, bytes)
    }
}

impl Asset for MeshData {
    fn size(name: &str, bytes: &[u8]) -> Result<u64, Error> {
        mesh_size(name, bytes)
    }

    fn read(name: &str, bytes: &[u8]) -> Result<(Self, Vec<Warning>), Error> {
        read_ply_bytes(name, bytes)
    }
}

/// Files of a kind by their full names, also those that could not be read.
type Cache<T> = BTreeMap<PathBuf, Result<Arc<T>, Failure>>;

/// Why a file is not read. The message goes on where the name of the file ends.
#[derive(Clone)]
pub(super) struct Failure {
    message: String,
    hint: Option<String>,
    fault: Fault,
}

impl Failure {
    fn wrong(message: &str, hint: &str) -> Self {
        Self { message: message.to_owned(), hint: Some(hint.to_owned()), fault: Fault::File }
    }

    fn unreadable(error: &std::io::Error) -> Self {
        let hint = "a relative name is looked for beside the scene file that says it".to_owned();
        Self { message: format!("cannot be read: {error}"), hint: Some(hint), fault: Fault::FileSystem }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Io { source, .. } => Self::unreadable(&source),
            Error::File(FileError { message, at, hint, fault, .. }) => {
                let said = if fault == Fault::Memory { "is not read" } else { "is wrong" };
                let at = match at {
                    At::File => String::new(),
                    At::Line(line) => format!(" (line {line})"),
                    At::Character { line, column } => format!(" (line {line}, column {column})"),
                    At::Byte(byte) => format!(" (byte {byte})"),
                    At::Part(part) => format!(" ({part})"),
                };
                Self { message: format!("{said}: {message}{at}"), hint, fault }
            }
            other => Self { message: format!("is wrong: {other}"), hint: None, fault: Fault::File },
        }
    }
}

/// Reads files, and remembers what is to be said of them.
pub(super) struct Loader<'m, F> {
    folder_of: F,
    /// That what was read takes.
    memory: &'m Memory,
    notes: Vec<Note>,
}

/// Where a file is.
pub(super) struct Found {
    /// As it was named.
    pub(super) file: PathBuf,
    /// The same for all names of a file.
    pub(super) real: PathBuf,
}

impl<'a, F: Fn(&[String]) -> Option<&'a Path>> Loader<'_, F> {
    /// The file that is named at a path of keys; none, and a note, if it cannot be had.
    fn get<T: Asset>(&mut self, cache: &mut Cache<T>, path: Vec<String>, name: &str) -> Option<Arc<T>> {
        let asset = self.read_once(cache, &path, name);
        self.or_note(path, name, asset)
    }

    /// What was read; none, and a note, if that has failed.
    pub(super) fn or_note<T>(&mut self, path: Vec<String>, name: &str, asset: Result<T, Failure>) -> Option<T> {
        let Failure { message, hint, fault } = match asset {
            Ok(asset) => return Some(asset),
            Err(failure) => failure,
        };
        self.notes.push(Note { path, message: format!("`{name}` {message}"), hint, fault: Some(fault) });
        None
    }

    /// Notes what could not be kept of a file, where the scene names it.
    pub(super) fn warn(&mut self, path: &[String], name: &str, warnings: Vec<Warning>) {
        self.notes.extend(warnings.into_iter().map(|Warning { message, hint, .. }| Note {
            path: path.to_vec(),
            message: format!("`{name}`: {message}"),
            hint,
            fault: None,
        }));
    }

    /// Where the file is that is named at a path of keys.
    pub(super) fn find(&self, path: &[String], name: &str) -> Result<Found, Failure> {
        let Some(folder) = (self.folder_of)(path) else {
            return Err(Failure::wrong("cannot be read: this scene has no folder", "save the scene as a file"));
        };
        let file = folder.join(name);
        let real = file.canonicalize().map_err(|e| Failure::unreadable(&e))?;
        Ok(Found { file, real })
    }

    /// Counts memory that is about to be used; fails if there is not so much left.
    pub(super) fn take(&mut self, bytes: u64) -> Result<(), Failure> {
        self.memory.take(bytes).map_err(|e| Error::File(e).into())
    }

    fn read_once<T: Asset>(&mut self, cache: &mut Cache<T>, path: &[String], name: &str) -> Result<Arc<T>, Failure> {
        let Found { file, real } = self.find(path, name)?;
        if let Some(known) = cache.get(&real) {
            return known.clone();
        }
        let asset = self.read(&file, path, name);
        cache.insert(real, asset.clone());
        asset
    }

    fn read<T: Asset>(&mut self, file: &Path, path: &[String], name: &str) -> Result<Arc<T>, Failure> {
        let (of, bytes) = (file.display().to_string(), file::read(file)?);
        self.take(T::size(&of, &bytes)?)?;
        let (asset, warnings) = T::read(&of, &bytes)?;
        self.warn(path, name, warnings);
        Ok(Arc::new(asset))
    }
}
