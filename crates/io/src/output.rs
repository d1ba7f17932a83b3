//! Output files appear whole or not at all: they are written beside their name and renamed.

use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use crate::error::Error;

/// Finds out, before work begins, whether a file of this name can be written.
///
/// # Errors
/// If its folder is missing or read-only, or the name is too long or that of a folder.
pub fn check_writable(path: &Path) -> Result<(), Error> {
    match Target::of(path)? {
        Target::File(path) => temporary_beside(&path).map(drop),
        Target::Device => Ok(()),
    }
}

/// Replaces the file by `bytes`, at once.
///
/// # Errors
/// If the file system refuses; a file that was there before is then unchanged.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let refused = |e| Error::write(path, e);
    match Target::of(path)? {
        Target::File(target) => {
            let mut file = temporary_beside(&target)?;
            file.write_all(bytes).map_err(refused)?;
            file.persist(target).map_err(|e| refused(e.error))?;
        }
        Target::Device => {
            let mut device = OpenOptions::new().write(true).open(path).map_err(refused)?;
            device.write_all(bytes).map_err(refused)?;
        }
    }
    Ok(())
}

/// What a name stands for.
enum Target {
    /// A file that is there or not; a link is followed, so that it stays one.
    File(PathBuf),
    /// A device or a pipe, which takes bytes and must not be replaced.
    Device,
}

impl Target {
    fn of(path: &Path) -> Result<Self, Error> {
        match fs::metadata(path) {
            Ok(there) if there.is_dir() => Err(Error::write(path, ErrorKind::IsADirectory.into())),
            Ok(there) if there.is_file() => Ok(Self::File(path.canonicalize().map_err(|e| Error::write(path, e))?)),
            Ok(_) => Ok(Self::Device),
            Err(e) if e.kind() == ErrorKind::NotFound => Ok(Self::File(path.to_owned())),
            Err(e) => Err(Error::write(path, e)),
        }
    }
}

fn temporary_beside(path: &Path) -> Result<NamedTempFile, Error> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        let missing = format!("there is no folder `{}`", folder.display());
        return Err(Error::write(path, std::io::Error::new(ErrorKind::NotFound, missing)));
    }
    let mut builder = Builder::new();
    builder.prefix(".eyebeam-").suffix(".part");
    #[cfg(unix)]
    {
        // As any new file: the process's umask applies.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    // The error's own text names the temporary file, which nobody asked for.
    builder.tempfile_in(folder).map_err(|e| Error::write(path, e.kind().into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_whole_files_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        check_writable(&path).unwrap();
        assert!(!path.exists(), "a check leaves nothing behind");
        write_atomic(&path, b"one").unwrap();
        write_atomic(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn finds_unwritable_names() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(check_writable(folder.path()), Err(Error::Io { .. })));
        assert!(matches!(check_writable(&folder.path().join("missing/a.png")), Err(Error::Io { .. })));
        assert!(matches!(check_writable(&folder.path().join("a".repeat(300))), Err(Error::Io { .. })));
    }

    #[cfg(unix)]
    #[test]
    fn follows_links_and_keeps_devices() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, b"one").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_atomic(&link, b"two").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"two");

        let null = folder.path().join("null");
        std::os::unix::fs::symlink("/dev/null", &null).unwrap();
        check_writable(&null).unwrap();
        write_atomic(&null, b"three").unwrap();
        assert!(!fs::metadata(&null).unwrap().is_file());
    }
}
