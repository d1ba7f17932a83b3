//! What of materials depends on directions in the surface: long highlights, and coats with normals of their own.
//!
//! `KHR_materials_anisotropy`: the width across highlights is α = roughness², and along them α + (1 − α) strength². In
//! [`Principled`](eyebeam_core::material::Principled) these are r² a and r² a (1 − anisotropy), with a = √(2 / (1 + (1 − anisotropy)²)).

use eyebeam_core::color::Rgb;
use eyebeam_core::material::Principled;
use eyebeam_core::texture::{Channel, Color, Encoding, Interpolation, Mapping, Scalar};

use crate::scene::model::gltf::extensions::{Anisotropy, Clearcoat, get};
use crate::scene::model::gltf::material::{Maker, Materials, bounded};
use crate::scene::model::gltf::texture;

/// Of the narrowest highlights: what is across over what is along.
const NARROWEST: f32 = 0.1;

impl Materials<'_> {
    /// How the texture lies whose directions a material needs; none if it needs none.
    pub(super) fn directions(&self, index: Option<usize>) -> Option<Mapping> {
        let material = index.and_then(|index| self.document.materials.get(index))?;
        if let Some(info) = &material.normal_texture {
            return Some(texture::mapping(info));
        }
        // Of what makes no sense there is a warning where the material is made.
        let coat = get(&material.extensions, CLEARCOAT).unwrap_or_default();
        if let Some(info) = coat.and_then(|coat: Clearcoat| coat.clearcoat_normal_texture) {
            return Some(texture::mapping(&info));
        }
        let long: Anisotropy = get(&material.extensions, ANISOTROPY).unwrap_or_default()?;
        let info = long.anisotropy_texture.as_ref();
        (long.anisotropy_strength > 0.0).then(|| info.map(texture::mapping).unwrap_or_default())
    }
}

pub(super) const CLEARCOAT: &str = "KHR_materials_clearcoat";
const ANISOTROPY: &str = "KHR_materials_anisotropy";

impl Maker<'_, '_> {
    /// Highlights that are long in one direction.
    pub(super) fn anisotropy(&mut self, p: &mut Principled) {
        let long: Option<Anisotropy> = self.extension(ANISOTROPY);
        let Some(long) = long.filter(|long| long.anisotropy_strength > 0.0) else { return };
        let info = long.anisotropy_texture.as_ref();
        let strength = self.channel(info, Channel::Blue, long.anisotropy_strength, "anisotropy");
        [p.specular_roughness, p.specular_roughness_anisotropy] = match (p.specular_roughness.clone(), strength) {
            (Scalar::Number(roughness), Scalar::Number(strength)) => {
                let [roughness, anisotropy] = stretched(roughness, strength);
                [roughness.into(), anisotropy.into()]
            }
            (Scalar::Number(roughness), strength) => self.ramps(strength, |strength| stretched(roughness, strength)),
            (roughness, Scalar::Number(strength)) => self.ramps(roughness, |roughness| stretched(roughness, strength)),
            (roughness, strength) => {
                const ABOUT: f32 = 0.4;
                self.warn(
                    "highlights are as long as at a roughness of 0.4, as roughness and length both have textures",
                );
                let [_, anisotropy] = self.ramps(strength, |strength| stretched(ABOUT, strength));
                [roughness, anisotropy]
            }
        };
        p.specular_rotation = bounded(long.anisotropy_rotation.to_degrees() % 360.0, -360.0, 360.0);
        p.geometry_tangent =
            info.and_then(|info| self.image(info, Encoding::Linear, false, "anisotropy-direction")).map(Color::Texture);
    }

    /// Two textures that are functions of one, in 0..1.
    fn ramps(&mut self, input: Scalar, f: impl Fn(f32) -> [f32; 2]) -> [Scalar; 2] {
        const STEPS: u16 = 32;
        let values: Vec<_> = (0..=STEPS).map(|i| f32::from(i) / f32::from(STEPS)).map(|at| (at, f(at))).collect();
        let mut ramp = |part: usize, name: &str| {
            let stops: Vec<_> = values.iter().map(|&(at, value)| (at, value[part])).collect();
            self.ramp(name, input.clone(), &stops, Interpolation::Linear)
        };
        [ramp(0, "roughness.stretched"), ramp(1, "anisotropy.stretched")]
    }

    /// The normals of a clear coat, which those of what is below do not move.
    pub(super) fn coat_normals(&mut self, coat: &Clearcoat, p: &mut Principled) {
        let info = coat.clearcoat_normal_texture.as_ref();
        match info.and_then(|info| Some((info, self.image(info, Encoding::Linear, false, "coat-normal")?))) {
            Some((info, map)) => {
                p.geometry_coat_normal = Some(Color::Texture(map));
                p.geometry_coat_normal_strength = bounded(info.scale.unwrap_or(1.0), -100.0, 100.0);
            }
            None if self.material.normal_texture.is_some() => {
                p.geometry_coat_normal = Some(Rgb([0.5, 0.5, 1.0]).into());
            }
            None => {}
        }
    }
}

/// The roughness and anisotropy of principled for those of glTF.
fn stretched(roughness: f32, strength: f32) -> [f32; 2] {
    let across = roughness * roughness;
    let along = across + (1.0 - across) * strength * strength;
    let narrow = if along > 0.0 { (across / along).max(NARROWEST) } else { 1.0 };
    [(along * (0.5 * (1.0 + narrow * narrow)).sqrt()).sqrt(), 1.0 - narrow]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Widths along and across are those of the extension.
    #[test]
    fn widths_are_kept() {
        for (roughness, strength) in [(0.5_f32, 0.5_f32), (0.8, 1.0), (0.5, 0.0), (0.0, 0.0), (1.0, 0.3)] {
            let [r, anisotropy] = stretched(roughness, strength);
            let narrow = 1.0 - anisotropy;
            let along = r * r * (2.0 / (1.0 + narrow * narrow)).sqrt();
            let across = roughness * roughness;
            assert!((along - (across + (1.0 - across) * strength * strength)).abs() < 1e-5);
            assert!((along * narrow - across).abs() < 1e-5, "{roughness} {strength}");
        }
        // Polished across and long is as narrow as can be.
        assert_eq!(stretched(0.0, 1.0)[1], 1.0 - NARROWEST);
    }
}
