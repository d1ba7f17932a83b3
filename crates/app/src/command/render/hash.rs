//! What tells scenes apart: a hash of all that is in them, and in the files that they name.

use eyebeam_core::desc::{RenderDesc, SceneDesc};
use eyebeam_core::film::Image;
use eyebeam_core::light::{EnvironmentDesc, IesProfile};
use eyebeam_core::shape::MeshData;
use eyebeam_core::texture::{Pixels, Samples, TextureDesc};
use sha2::{Digest, Sha256};

/// SHA-256 of a scene but for its `render` settings: of its JSON, then of the numbers in each file in the order in which
/// the scene has them. Where files lie does not matter, but for the names that the scene says.
pub(super) fn scene_hash(desc: &SceneDesc) -> String {
    let mut hash = Hash(Sha256::new());
    // Scenes are cheap to copy: what was loaded is shared.
    let scene = SceneDesc { render: RenderDesc::default(), ..desc.clone() };
    hash.0.update(serde_json::to_vec(&scene).unwrap_or_default());
    if let EnvironmentDesc::Image(map) = &desc.environment {
        map.image.iter().for_each(|image| hash.image(image));
    }
    desc.light.projector.iter().filter_map(|l| l.image.as_ref()).for_each(|image| hash.image(image));
    for texture in desc.texture.values() {
        if let TextureDesc::Image(texture) = texture {
            texture.pixels.iter().for_each(|pixels| hash.pixels(pixels));
        }
    }
    desc.light.ies.iter().filter_map(|l| l.profile.as_ref()).for_each(|profile| hash.profile(profile));
    desc.shape.mesh.iter().filter_map(|m| m.data.as_ref()).for_each(|mesh| hash.mesh(mesh));
    hash.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

struct Hash(Sha256);

impl Hash {
    /// How many numbers there are, and each of them; little-endian.
    fn numbers(&mut self, numbers: impl ExactSizeIterator<Item = [u8; 4]>) {
        self.0.update((numbers.len() as u64).to_le_bytes());
        numbers.for_each(|bytes| self.0.update(bytes));
    }

    fn floats(&mut self, floats: &[f32]) {
        self.numbers(floats.iter().map(|f| f.to_le_bytes()));
    }

    fn image(&mut self, image: &Image) {
        self.numbers([image.width(), image.height()].into_iter().map(u32::to_le_bytes));
        self.floats(image.pixels().as_flattened());
    }

    fn pixels(&mut self, pixels: &Pixels) {
        self.numbers([pixels.width(), pixels.height(), pixels.channels() as u32].into_iter().map(u32::to_le_bytes));
        match pixels.samples() {
            Samples::Byte(bytes) => self.0.update(bytes),
            Samples::Word(words) | Samples::Half(words) => words.iter().for_each(|w| self.0.update(w.to_le_bytes())),
            Samples::Float(floats) => self.floats(floats),
        }
    }

    fn profile(&mut self, profile: &IesProfile) {
        [profile.vertical(), profile.horizontal(), profile.candela()].into_iter().for_each(|list| self.floats(list));
    }

    fn mesh(&mut self, mesh: &MeshData) {
        self.floats(mesh.vertices.as_flattened());
        self.floats(mesh.normals.as_flattened());
        self.floats(mesh.uvs.as_flattened());
        self.floats(mesh.uvs_1.as_flattened());
        self.floats(mesh.tangents.as_flattened());
        self.floats(&mesh.alphas);
        self.floats(mesh.colors.as_flattened());
        self.numbers(mesh.triangles.as_flattened().iter().map(|i| i.to_le_bytes()));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use eyebeam_core::light::{IesLight, ImageEnvironment, ProjectorLight};
    use eyebeam_core::shape::MeshDesc;
    use eyebeam_core::texture::ImageTexture;
    use serde_json::{from_value, json};

    use super::*;

    fn image(value: f32) -> Option<Arc<Image>> {
        let mut image = Image::new(2, 1);
        image.set_pixel(1, 0, [value, 0.0, 0.0]);
        Some(Arc::new(image))
    }

    /// Scenes that differ by one number in one file.
    #[test]
    fn what_is_in_files_counts() {
        let with_sky = |value| {
            let map: ImageEnvironment = from_value(json!({ "file": "a.hdr" })).unwrap();
            let environment = EnvironmentDesc::Image(ImageEnvironment { image: image(value), ..map });
            SceneDesc { environment, ..SceneDesc::default() }
        };
        let with_slide = |value| {
            let light = json!({ "file": "a.png", "position": [0, 0, 0], "look_at": [0, 0, 1] });
            let light: ProjectorLight = from_value(light).unwrap();
            let mut desc = SceneDesc::default();
            desc.light.projector.push(ProjectorLight { image: image(value), ..light });
            desc
        };
        let with_lamp = |value| {
            let light: IesLight = from_value(json!({ "file": "a.ies", "position": [0, 0, 0] })).unwrap();
            let profile = IesProfile::new(vec![0.0, 90.0], vec![0.0], vec![1.0, value]).ok().map(Arc::new);
            let mut desc = SceneDesc::default();
            desc.light.ies.push(IesLight { profile, ..light });
            desc
        };
        let with_mesh = |value| {
            let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, value, 0.0]];
            let data = MeshData { vertices, triangles: vec![[0, 1, 2]], ..MeshData::default() };
            let mut desc = SceneDesc::default();
            let mesh = MeshDesc { file: Some("a.ply".to_owned()), data: Some(Arc::new(data)), ..MeshDesc::default() };
            desc.shape.mesh.push(mesh);
            desc
        };
        let with_texture = |value| {
            let pixels = Pixels::new(2, 1, 1, Samples::Float(vec![0.0, value])).map(Arc::new);
            let texture = TextureDesc::Image(ImageTexture::new("a.png", pixels));
            SceneDesc { texture: [("a".to_owned(), texture)].into(), ..SceneDesc::default() }
        };
        let kinds: [&dyn Fn(f32) -> SceneDesc; 5] = [&with_sky, &with_slide, &with_lamp, &with_mesh, &with_texture];
        let hashes = kinds.iter().flat_map(|with| [with(1.0), with(2.0)].map(|desc| scene_hash(&desc)));
        let mut hashes: Vec<_> = hashes.collect();
        assert_eq!(scene_hash(&with_mesh(1.0)), hashes[6]);
        hashes.sort();
        hashes.dedup();
        assert_eq!(hashes.len(), 10);
    }

    /// What a file says is not told again in words.
    #[test]
    fn files_do_not_become_text() {
        let data = MeshData { vertices: vec![[0.123; 3]; 1000], ..MeshData::default() };
        let mesh = MeshDesc { file: Some("a.ply".to_owned()), data: Some(Arc::new(data)), ..MeshDesc::default() };
        assert!(serde_json::to_string(&mesh).unwrap().len() < 200);
    }
}
