//! The files that a model names lie in its folder or below, unless someone allows more.

use std::path::{Component, Path, PathBuf};

use crate::error::FileError;

/// That of a model.
pub(super) fn of(model: &Path) -> &Path {
    model.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A name as all systems take it: some programs write `tex\a.png` or `./a.png`.
pub(super) fn plain(name: &Path) -> PathBuf {
    let text = name.to_string_lossy().replace('\\', "/");
    Path::new(&text).components().filter(|c| *c != Component::CurDir).collect()
}

/// Where a file is that a model of the folder names, also outside of it if `is_open`.
///
/// # Errors
/// If there is none, or its name or a link leads out of the folder and must not.
pub(super) fn find(folder: &Path, name: &Path, is_open: bool) -> Result<PathBuf, FileError> {
    let hint = "put it beside the model or below, or let it be read where it is with `--allow-outside`";
    let text = name.to_string_lossy();
    let name = plain(name);
    let leads_out = |c: Component<'_>| !matches!(c, Component::Normal(_));
    let has_drive = text.get(1..2) == Some(":");
    if name.as_os_str().is_empty() {
        return Err(FileError::new("it has no name"));
    }
    if text.contains("://") {
        return Err(FileError::new("it is not a file").hint("download it, and put it beside the model"));
    }
    if !is_open && (has_drive || name.components().any(leads_out)) {
        return Err(FileError::new("its name leads out of the folder of the model").hint(hint));
    }
    let path = folder.join(name);
    let real = |path: &Path| path.canonicalize().map_err(|e| FileError::new(e.to_string()));
    if real(&path)?.starts_with(real(folder)?) || is_open {
        Ok(path)
    } else {
        Err(FileError::new("it is a link that leads out of the folder of the model").hint(hint))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_lead_out() {
        let find = |name: &str| find(of(Path::new("a.glb")), Path::new(name), false);
        for bad in ["../a.bin", "/etc/passwd", "a/../../b", "..\\a.bin", "C:\\a.bin"] {
            let error = find(bad).unwrap_err();
            assert_eq!(error.message, "its name leads out of the folder of the model", "{bad}");
            assert!(error.hint.unwrap().contains("--allow-outside"));
        }
        assert_eq!(find("https://a.b/c.bin").unwrap_err().message, "it is not a file");
        assert!(find("nowhere.bin").unwrap_err().hint.is_none());
        assert_eq!([of(Path::new("a.glb")), of(Path::new("b/a.glb"))], [Path::new("."), Path::new("b")]);
    }

    #[test]
    fn they_do_if_allowed() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir(root.path().join("in")).unwrap();
        std::fs::write(root.path().join("a.bin"), "").unwrap();
        let inside = root.path().join("in");
        let find = |name: &Path, is_open| find(&inside, name, is_open);
        assert!(find(Path::new("../a.bin"), false).is_err());
        assert!(find(Path::new("../a.bin"), true).is_ok());
        assert!(find(&root.path().join("a.bin"), true).is_ok());
        assert!(find(Path::new("https://a.b/c.bin"), true).is_err());
    }
}
