//! Pictures of a glTF file, and how materials look them up.
//!
//! `KHR_texture_transform` scales, turns and moves coordinates that hang down from v = 0; ours stand upright, so the same is said in
//! other numbers.

use std::collections::BTreeMap;
use std::sync::Arc;

use eyebeam_core::film::Wrap;
use eyebeam_core::texture::{Encoding, Filter, ImageTexture, Mapping, Pixels, Space};
use rayon::prelude::*;

use crate::error::FileError;
use crate::image::{pixels_size, read_pixels_bytes};
use crate::scene::model::files::Files;
use crate::scene::model::gltf::accessor::{Buffers, missing};
use crate::scene::model::gltf::container;
use crate::scene::model::gltf::document::{Document, Texture, TextureInfo, TextureTransform};
use crate::warning::Warning;

/// The pictures that the file's textures show, by their index; those that cannot be read are left out.
pub(super) struct Pictures(BTreeMap<usize, Arc<Pixels>>);

impl Pictures {
    /// Decodes all at the same time.
    pub(super) fn read(buffers: &Buffers<'_>, files: Files<'_>, warnings: &mut Vec<Warning>) -> Self {
        let mut sources: Vec<_> = buffers.document.textures.iter().filter_map(Texture::picture).collect();
        sources.sort_unstable();
        sources.dedup();
        // Those of the same bytes are one.
        let mut firsts = BTreeMap::new();
        let mut first_of = |&index: &usize| {
            let picture = buffers.document.images.get(index);
            (index, *firsts.entry(picture.map(|picture| (&picture.uri, picture.buffer_view))).or_insert(index))
        };
        let shared: Vec<_> = sources.iter().map(&mut first_of).filter(|(index, first)| index != first).collect();
        let mut encoded = Vec::new();
        for index in firsts.into_values() {
            let bytes = bytes(buffers, files, index).and_then(|bytes| {
                buffers.memory.take(bytes.len() as u64 + pixels_size("", &bytes)?)?;
                Ok(bytes)
            });
            encoded.push((index, bytes));
        }
        let decoded: Vec<_> = encoded
            .into_par_iter()
            .map(|(index, bytes)| (index, bytes.and_then(|bytes| Ok(read_pixels_bytes("", &bytes)?))))
            .collect();
        let mut pictures = BTreeMap::new();
        for (index, picture) in decoded {
            match picture {
                Ok((pixels, more)) => {
                    warnings.extend(more.into_iter().map(|warning| warning.part(part(index))));
                    pictures.insert(index, Arc::new(pixels));
                }
                Err(e) => warnings.push(Warning {
                    hint: e.hint,
                    ..Warning::new(format!("the picture is left out: {}", e.message)).part(part(index))
                }),
            }
        }
        for (index, first) in shared {
            let picture = pictures.get(&first).cloned();
            pictures.extend(picture.map(|picture| (index, picture)));
        }
        Self(pictures)
    }

    /// A texture of a material; none if its picture is not there. `file` stands before the number of the picture.
    pub(super) fn texture(
        &self,
        document: &Document,
        info: &TextureInfo,
        encoding: Encoding,
        file: &str,
        warnings: &mut Vec<Warning>,
    ) -> Option<ImageTexture> {
        let Some(texture) = document.textures.get(info.index) else {
            warnings.push(Warning::new("there is no such texture").part(format!("texture {}", info.index)));
            return None;
        };
        let Some(index) = texture.picture() else {
            let warning = Warning::new("the texture is left out: it has no picture of a known format");
            warnings.push(warning.part(format!("texture {}", info.index)));
            return None;
        };
        let pixels = self.0.get(&index)?;
        let mut image = ImageTexture::new(&format!("{file}#picture{index}"), Some(pixels.clone()));
        if !pixels.is_light() {
            image.encoding = encoding;
        }
        let sampler = texture.sampler.and_then(|i| document.samplers.get(i));
        if let Some(sampler) = sampler {
            image.wrap = wrap(sampler.wrap_s);
            image.wrap_v = Some(wrap(sampler.wrap_t)).filter(|&v| v != image.wrap);
        }
        if sampler.and_then(|s| s.mag_filter) == Some(NEAREST) {
            image.filter = Filter::Nearest;
        }
        image.mapping = mapping(info);
        let set = set(info);
        if set > 1 {
            let warning = Warning::new(format!("the texture lies as TEXCOORD_0 says, not as TEXCOORD_{set} does"));
            warnings.push(warning.part(format!("texture {}", info.index)).hint("two sets of coordinates are read"));
        }
        Some(image)
    }
}

/// How warnings name a picture.
pub(super) fn part(picture: usize) -> String {
    format!("picture {picture}")
}

const NEAREST: u32 = 9728;

fn wrap(code: Option<u32>) -> Wrap {
    match code {
        Some(33071) => Wrap::Clamp,
        Some(33648) => Wrap::Mirror,
        _ => Wrap::Repeat,
    }
}

/// The coordinates by which a texture lies.
fn set(info: &TextureInfo) -> usize {
    info.extensions.transform.as_ref().and_then(|t| t.tex_coord).unwrap_or(info.tex_coord)
}

/// How a texture lies, in coordinates that stand upright.
pub(super) fn mapping(info: &TextureInfo) -> Mapping {
    let space = (set(info) == 1).then_some(Space::Uv1);
    let Some(transform) = &info.extensions.transform else { return Mapping { space, ..Mapping::default() } };
    let TextureTransform { offset: [x, y], rotation, .. } = *transform;
    let [u, v] = transform.scale.unwrap_or([1.0; 2]);
    let (sin, cos) = (libm::sinf(rotation), libm::cosf(rotation));
    Mapping {
        space,
        scale: [u, v, 1.0],
        rotation_after: rotation.to_degrees() % 360.0,
        offset: [x + v * sin, 1.0 - y - v * cos, 0.0],
        ..Mapping::default()
    }
}

pub(super) fn bytes(buffers: &Buffers<'_>, files: Files<'_>, index: usize) -> Result<Vec<u8>, FileError> {
    let picture = buffers.document.images.get(index).ok_or_else(|| missing("picture", index))?;
    match (&picture.uri, picture.buffer_view) {
        (Some(uri), _) => container::resolve(uri, files),
        (None, Some(view)) => Ok(buffers.view(view)?.to_vec()),
        (None, None) => Err(FileError::new("it is nowhere")),
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::model::gltf::document::TextureInfoExtensions;

    /// u' = x + cos u + sin v, v' = y − sin u + cos v with u and v times their scales, from above.
    #[test]
    fn transforms_are_the_same_upright() {
        for scale in [[2.0, 2.0], [2.0, -0.5]] {
            let transform =
                TextureTransform { offset: [0.2, 0.1], rotation: 0.5, scale: Some(scale), tex_coord: Some(1) };
            let info = TextureInfo {
                extensions: TextureInfoExtensions { transform: Some(transform) },
                ..TextureInfo::default()
            };
            let mapping = mapping(&info);
            assert_eq!(mapping.space, Some(Space::Uv1));
            for [u, v] in [[0.0, 0.0], [1.0, 0.0], [0.3, 0.8]] {
                let (s, c) = 0.5_f32.sin_cos();
                let (su, sv) = (scale[0] * u, scale[1] * v);
                let expected = [0.2 + c * su + s * sv, 0.1 + c * sv - s * su];
                let place = mapping.lay(Vec3::new(u, 1.0 - v, 0.0));
                assert!((place.x - expected[0]).abs() < 1e-5 && (1.0 - place.y - expected[1]).abs() < 1e-5);
            }
        }
    }
}
