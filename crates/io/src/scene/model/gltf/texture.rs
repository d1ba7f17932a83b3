//! Pictures of a glTF file, and how materials look them up.
//!
//! `KHR_texture_transform` turns, scales and moves coordinates that hang down from v = 0; ours stand upright, so the same is said in
//! other numbers. A turn after uneven scales cannot be said in them, and is reported.

use std::collections::BTreeMap;
use std::sync::Arc;

use eyebeam_core::film::Wrap;
use eyebeam_core::texture::{Encoding, Filter, ImageTexture, Mapping, Pixels};
use rayon::prelude::*;

use crate::error::FileError;
use crate::image::{pixels_size, read_pixels_bytes};
use crate::scene::assets::MAX_BYTES;
use crate::scene::model::folder::Folder;
use crate::scene::model::gltf::accessor::{Buffers, missing};
use crate::scene::model::gltf::container;
use crate::scene::model::gltf::document::{Document, TextureInfo, TextureTransform};
use crate::warning::Warning;

/// The pictures that the file's textures show, by their index; those that cannot be read are left out.
pub(super) struct Pictures(BTreeMap<usize, Arc<Pixels>>);

impl Pictures {
    /// Decodes all at the same time.
    pub(super) fn read(buffers: &Buffers<'_>, folder: &Folder, warnings: &mut Vec<Warning>) -> Self {
        let mut sources: Vec<_> = buffers.document.textures.iter().filter_map(|texture| texture.source).collect();
        sources.sort_unstable();
        sources.dedup();
        let mut taken = 0;
        let mut encoded = Vec::new();
        for index in sources {
            let bytes = bytes(buffers, folder, index).and_then(|bytes| {
                taken += pixels_size("", &bytes)?;
                if taken > MAX_BYTES {
                    return Err(FileError::new(format!("the pictures take more than {} GiB", MAX_BYTES >> 30)));
                }
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
                    let of = |w: Warning| Warning { message: format!("picture {index}: {}", w.message), ..w };
                    warnings.extend(more.into_iter().map(of));
                    pictures.insert(index, Arc::new(pixels));
                }
                Err(e) => warnings.push(Warning {
                    hint: e.hint,
                    ..Warning::new(format!("picture {index} is left out: {}", e.message))
                }),
            }
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
        let texture = document.textures.get(info.index)?;
        let Some(index) = texture.source else {
            warnings
                .push(Warning::new(format!("texture {} is left out: no picture of it is a PNG or JPEG", info.index)));
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
        if let Some(transform) = &info.extensions.transform {
            image.mapping = mapping(transform).unwrap_or_else(|| {
                warnings.push(Warning::new(format!(
                    "texture {} is turned after uneven scales: it is only moved",
                    info.index
                )));
                Mapping::default()
            });
        }
        if info.extensions.transform.as_ref().and_then(|t| t.tex_coord).unwrap_or(info.tex_coord) != 0 {
            warnings
                .push(Warning::new(format!("texture {} lies as TEXCOORD_0 says, not as another set does", info.index)));
        }
        Some(image)
    }
}

const NEAREST: u32 = 9728;

fn wrap(code: Option<u32>) -> Wrap {
    match code {
        Some(33071) => Wrap::Clamp,
        Some(33648) => Wrap::Mirror,
        _ => Wrap::Repeat,
    }
}

/// The same in coordinates that stand upright; none if they cannot say it.
fn mapping(transform: &TextureTransform) -> Option<Mapping> {
    let TextureTransform { offset: [x, y], rotation, .. } = *transform;
    let [u, v] = transform.scale.unwrap_or([1.0; 2]);
    if rotation != 0.0 && u != v {
        return None;
    }
    let (sin, cos) = (libm::sinf(rotation), libm::cosf(rotation));
    Some(Mapping {
        rotation: rotation.to_degrees(),
        scale: [u, v, 1.0],
        offset: [x + v * sin, 1.0 - y - v * cos, 0.0],
        ..Mapping::default()
    })
}

fn bytes(buffers: &Buffers<'_>, folder: &Folder, index: usize) -> Result<Vec<u8>, FileError> {
    let picture = buffers.document.images.get(index).ok_or_else(|| missing("picture", index))?;
    match (&picture.uri, picture.buffer_view) {
        (Some(uri), _) => container::resolve(uri, folder),
        (None, Some(view)) => Ok(buffers.view(view)?.to_vec()),
        (None, None) => Err(FileError::new("it is nowhere")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u' = x + cos u + sin v, v' = y − sin u + cos v times the scale, from above.
    #[test]
    fn transforms_are_the_same_upright() {
        let transform =
            TextureTransform { offset: [0.2, 0.1], rotation: 0.5, scale: Some([2.0, 2.0]), tex_coord: None };
        let Mapping { rotation, scale, offset, .. } = mapping(&transform).unwrap();
        let (sin, cos) = rotation.to_radians().sin_cos();
        for [u, v] in [[0.0, 0.0], [1.0, 0.0], [0.3, 0.8]] {
            let (s, c) = 0.5_f32.sin_cos();
            let expected = [0.2 + 2.0 * (c * u + s * v), 0.1 + 2.0 * (c * v - s * u)];
            let up = 1.0 - v;
            let turned = [cos * u - sin * up, sin * u + cos * up];
            let place = [turned[0] * scale[0] + offset[0], turned[1] * scale[1] + offset[1]];
            assert!((place[0] - expected[0]).abs() < 1e-5 && (1.0 - place[1] - expected[1]).abs() < 1e-5);
        }
        assert!(mapping(&TextureTransform { scale: Some([1.0, 2.0]), ..transform }).is_none());
    }
}
