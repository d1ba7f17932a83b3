//! Files that have broken other readers, from a folder beside the repository.

use std::fs;
use std::path::Path;

use eyebeam_io::Error;
use eyebeam_io::ies::read_ies;
use eyebeam_io::image::read_image;
use eyebeam_io::scene::read;

use crate::corpus::corpus;
use crate::{alone, watched};

type Reader = fn(&Path) -> Result<(), Error>;

/// Every file as a scene or model and as a picture, whatever its ending: it is read, or an error names it.
#[test]
fn bad_files() {
    let _alone = alone();
    const ALLOWED: usize = 256 << 20;
    let readers: [(&str, Reader); 3] = [
        ("scene", |path| read(path, &[]).map(drop)),
        ("picture", |path| read_image(path).map(drop)),
        ("profile", |path| read_ies(path).map(drop)),
    ];
    for path in corpus("bad", &[]) {
        let name = path.display().to_string();
        let length = fs::metadata(&path).map_or(0, |file| file.len()) as usize;
        for (reader, read) in readers {
            let (result, peak) = watched(&name, || read(&path));
            if let Err(error) = result {
                let error = error.to_string();
                let file = path.file_name().unwrap_or_default().to_string_lossy();
                assert!(error.contains(&*file) || name.len() > 400, "{name} as {reader}: {error}");
                let most = ALLOWED + 200 * length;
                assert!(peak <= most, "{name} as {reader}: {} MiB, {error}", peak >> 20);
            }
        }
    }
}
