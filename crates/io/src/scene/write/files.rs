//! The files that a scene names, written from memory.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::texture::TextureDesc;

use crate::error::Error;
use crate::ies::encode_ies;
use crate::image::{encode_light, encode_pixels};
use crate::output::write_atomic;
use crate::scene::ply::encode_ply;

/// Files in a folder.
pub(super) struct Files<'a> {
    /// Where they are written.
    folder: &'a Path,
    /// What a scene beside the folder calls it.
    name: &'a str,
    /// Names of files by where in memory their contents are.
    known: BTreeMap<usize, String>,
    /// All names, in lower case: some file systems see no difference.
    used: BTreeSet<String>,
}

impl<'a> Files<'a> {
    pub(super) fn new(folder: &'a Path, name: &'a str) -> Self {
        Self { folder, name, known: BTreeMap::new(), used: BTreeSet::new() }
    }

    /// How many were written.
    pub(super) fn count(&self) -> usize {
        self.used.len()
    }

    /// Writes all that the scene has loaded, and changes its names.
    pub(super) fn write(&mut self, desc: &mut SceneDesc) -> Result<(), Error> {
        for mesh in &mut desc.shape.mesh {
            let Some(data) = &mesh.data else { continue };
            let old = mesh.file.as_deref().unwrap_or("mesh");
            mesh.file = Some(self.file(data, old, || Ok((".ply", encode_ply(data))))?);
        }
        for (name, texture) in &mut desc.texture {
            let TextureDesc::Image(image) = texture else { continue };
            let Some(pixels) = &image.pixels else { continue };
            image.file = self.file(pixels, name, || encode_pixels(pixels))?;
        }
        if let EnvironmentDesc::Image(map) = &mut desc.environment {
            map.file = self.light(map.image.as_ref(), &map.file)?;
        }
        for light in &mut desc.light.projector {
            light.file = self.light(light.image.as_ref(), &light.file)?;
        }
        for light in &mut desc.light.ies {
            let Some(profile) = &light.profile else { continue };
            light.file = self.file(profile, &light.file, || Ok((".ies", encode_ies(profile))))?;
        }
        Ok(())
    }

    fn light(&mut self, image: Option<&Arc<Image>>, old: &str) -> Result<String, Error> {
        match image {
            Some(image) => self.file(image, old, || Ok((".exr", encode_light(image)?))),
            None => Ok(old.to_owned()),
        }
    }

    /// The name of the file that holds a thing, which is written if it is not there yet; it is called about as before.
    fn file<T>(
        &mut self,
        thing: &Arc<T>,
        old: &str,
        encode: impl FnOnce() -> Result<(&'static str, Vec<u8>), Error>,
    ) -> Result<String, Error> {
        let address = Arc::as_ptr(thing).addr();
        if let Some(name) = self.known.get(&address) {
            return Ok(name.clone());
        }
        let (ending, bytes) = encode()?;
        let file = self.unused(&plain(old), ending);
        write_atomic(&self.folder.join(&file), &bytes)?;
        let name = format!("{}/{file}", self.name);
        self.known.insert(address, name.clone());
        Ok(name)
    }

    fn unused(&mut self, stem: &str, ending: &str) -> String {
        let mut name = format!("{stem}{ending}");
        let mut number = 2;
        while !self.used.insert(name.to_lowercase()) {
            name = format!("{stem}-{number}{ending}");
            number += 1;
        }
        name
    }
}

/// A name that every file system takes: the last part of another, without its ending and what is special.
fn plain(name: &str) -> String {
    const LONGEST: usize = 60;
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let endings = [".ply", ".obj", ".stl", ".gltf", ".glb", ".png", ".jpg", ".jpeg", ".hdr", ".exr", ".ies"];
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    let mut stem: String = last.chars().map(|c| if is_plain(c) { c } else { '-' }).collect();
    for ending in endings {
        // Within, it comes before what tells parts of a file apart.
        stem = stem.replace(&format!("{ending}-"), "-");
        if stem.to_ascii_lowercase().ends_with(ending) {
            stem.truncate(stem.len() - ending.len());
        }
    }
    stem.truncate(LONGEST);
    let stem = stem.trim_matches(['.', '-']);
    // Names that begin so are devices in Windows.
    let is_device = ["con", "prn", "aux", "nul", "com", "lpt"].iter().any(|d| stem.to_ascii_lowercase().starts_with(d));
    match stem {
        "" => "file".to_owned(),
        stem if is_device => format!("a-{stem}"),
        stem => stem.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain_and_different() {
        let cases = [
            ("a/b.ply", "b"),
            ("C:\\x y\\h\u{e4}\"use.glb#node3", "h--use-node3"),
            ("../..", "file"),
            ("aux.png", "a-aux"),
            ("wood.base-color", "wood.base-color"),
        ];
        for (name, expected) in cases {
            assert_eq!(plain(name), expected);
        }
        assert!(plain(&"x".repeat(1000)).len() < 100);
        let mut files = Files::new(Path::new("."), "a");
        let names = ["b", "B", "b"].map(|stem| files.unused(stem, ".ply"));
        assert_eq!(names, ["b.ply", "B-2.ply", "b-3.ply"]);
    }
}
