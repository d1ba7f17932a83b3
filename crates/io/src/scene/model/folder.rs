//! The files that a model names lie in its folder or below.

use std::path::{Component, Path, PathBuf};

use crate::error::FileError;

/// The folder of a model.
pub(super) fn of(model: &Path) -> &Path {
    model.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Where a file is that a model names.
///
/// # Errors
/// If there is none, or its name or a link leads out of the folder.
pub(super) fn below(folder: &Path, name: &Path) -> Result<PathBuf, FileError> {
    let hint = "put it beside the model or below";
    let text = name.to_string_lossy().replace('\\', "/");
    let name = Path::new(&text);
    let leads_out = |c: Component<'_>| !matches!(c, Component::Normal(_) | Component::CurDir);
    let is_elsewhere = text.contains("://") || text.get(1..2) == Some(":");
    if text.is_empty() {
        return Err(FileError::new("it has no name"));
    }
    if is_elsewhere || name.components().any(leads_out) {
        return Err(FileError::new("its name leads out of the folder of the model").hint(hint));
    }
    let path = folder.join(name);
    let real = |path: &Path| path.canonicalize().map_err(|e| FileError::new(e.to_string()));
    if real(&path)?.starts_with(real(folder)?) {
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
        for bad in ["../a.bin", "/etc/passwd", "a/../../b", "https://a.b/c.bin", "..\\a.bin", "C:\\a.bin"] {
            let error = below(Path::new("."), Path::new(bad)).unwrap_err();
            assert_eq!(error.message, "its name leads out of the folder of the model", "{bad}");
        }
        assert!(below(Path::new("."), Path::new("nowhere.bin")).unwrap_err().hint.is_none());
        assert_eq!((of(Path::new("a.glb")), of(Path::new("b/a.glb"))), (Path::new("."), Path::new("b")));
    }
}
