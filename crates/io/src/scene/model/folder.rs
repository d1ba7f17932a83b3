//! The files that a model names lie in its folder or below, unless someone allows more.

use std::path::{Component, Path, PathBuf};

use crate::error::FileError;

/// The folder of a model.
#[derive(Clone, Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// Whether names may lead out of it.
    is_open: bool,
}

impl Folder {
    /// That of a model.
    pub(super) fn of(model: &Path, is_open: bool) -> Self {
        let folder = model.parent().filter(|folder| !folder.as_os_str().is_empty());
        Self { path: folder.unwrap_or(Path::new(".")).to_owned(), is_open }
    }

    /// Where a file is that a model names.
    ///
    /// # Errors
    /// If there is none, or its name or a link leads out of the folder and must not.
    pub(super) fn find(&self, name: &Path) -> Result<PathBuf, FileError> {
        let hint = "put it beside the model or below, or let it be read where it is with `--allow-outside`";
        let text = name.to_string_lossy().replace('\\', "/");
        let name = Path::new(&text);
        let leads_out = |c: Component<'_>| !matches!(c, Component::Normal(_) | Component::CurDir);
        let has_drive = text.get(1..2) == Some(":");
        if text.is_empty() {
            return Err(FileError::new("it has no name"));
        }
        if text.contains("://") {
            return Err(FileError::new("it is not a file").hint("download it, and put it beside the model"));
        }
        if !self.is_open && (has_drive || name.components().any(leads_out)) {
            return Err(FileError::new("its name leads out of the folder of the model").hint(hint));
        }
        let path = self.path.join(name);
        let real = |path: &Path| path.canonicalize().map_err(|e| FileError::new(e.to_string()));
        if real(&path)?.starts_with(real(&self.path)?) || self.is_open {
            Ok(path)
        } else {
            Err(FileError::new("it is a link that leads out of the folder of the model").hint(hint))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_lead_out() {
        let folder = Folder::of(Path::new("a.glb"), false);
        for bad in ["../a.bin", "/etc/passwd", "a/../../b", "..\\a.bin", "C:\\a.bin"] {
            let error = folder.find(Path::new(bad)).unwrap_err();
            assert_eq!(error.message, "its name leads out of the folder of the model", "{bad}");
            assert!(error.hint.unwrap().contains("--allow-outside"));
        }
        assert_eq!(folder.find(Path::new("https://a.b/c.bin")).unwrap_err().message, "it is not a file");
        assert!(folder.find(Path::new("nowhere.bin")).unwrap_err().hint.is_none());
        assert_eq!((folder.path, Folder::of(Path::new("b/a.glb"), false).path), (".".into(), "b".into()));
    }

    #[test]
    fn they_do_if_allowed() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir(root.path().join("in")).unwrap();
        std::fs::write(root.path().join("a.bin"), "").unwrap();
        let folder = |is_open| Folder::of(&root.path().join("in/a.glb"), is_open);
        assert!(folder(false).find(Path::new("../a.bin")).is_err());
        assert!(folder(true).find(Path::new("../a.bin")).is_ok());
        assert!(folder(true).find(&root.path().join("a.bin")).is_ok());
        assert!(folder(true).find(Path::new("https://a.b/c.bin")).is_err());
    }
}
