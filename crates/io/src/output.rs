//! Output files appear whole or not at all: they are written beside their name and renamed.

use std::fs;
use std::io::Write;
use std::path::Path;

use tempfile::{Builder, NamedTempFile};

use crate::error::Error;

/// Finds out, before work begins, whether a file of this name can be written.
///
/// # Errors
/// If its folder is missing or read-only, or the name is that of a folder.
pub fn check_writable(path: &Path) -> Result<(), Error> {
    if path.is_dir() {
        return Err(Error::write(path, std::io::ErrorKind::IsADirectory.into()));
    }
    temporary_beside(path).map(drop)
}

/// Replaces the file by `bytes`, at once.
///
/// # Errors
/// If the file system refuses; a file that was there before is then unchanged.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = temporary_beside(path)?;
    file.write_all(bytes).map_err(|e| Error::write(path, e))?;
    file.persist(path).map_err(|e| Error::write(path, e.error))?;
    Ok(())
}

fn temporary_beside(path: &Path) -> Result<NamedTempFile, Error> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        let missing = format!("there is no folder `{}`", folder.display());
        return Err(Error::write(path, std::io::Error::new(std::io::ErrorKind::NotFound, missing)));
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
    }
}
