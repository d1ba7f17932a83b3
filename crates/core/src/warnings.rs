//! What may surprise about a correct description of a scene: it can be rendered, but something in it has no effect.

use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::integrator::IntegratorKind;
use crate::light::{EnvironmentDesc, LightsDesc};
use crate::material::{MaterialDesc, NormalMap};
use crate::texture::{Color, TextureDesc};
use crate::validate::{Checker, Problem};

impl SceneDesc {
    /// Everything that is allowed and yet hardly meant, of a scene in which [`check`](Self::check) finds nothing wrong.
    pub fn warnings(&self) -> Vec<Problem> {
        let mut c = Checker::default();
        self.warn_of_darkness(&mut c);
        c.within("environment", |c| self.environment.warn(c));
        c.within("light", |c| self.light.warn(self.render.integrator, c));
        c.within("material", |c| {
            for (name, _) in self.material.iter().filter(|(_, m)| is_unlit_lamp(m)) {
                c.within(name, |c| c.within("emissive", |c| c.problem("radiance", "this lamp gives no light", None)));
            }
        });
        c.within("material", |c| self.warn_of_normal_maps(c));
        c.within("shape", |c| c.within("mesh", |c| self.warn_of_meshes(c)));
        c.into_problems()
    }

    /// Pictures of normals that are taken for colours.
    fn warn_of_normal_maps(&self, c: &mut Checker) {
        for (name, material) in &self.material {
            let (kind, maps) = match material {
                MaterialDesc::NormalMap(NormalMap { map, .. }) => ("normal-map", [("map", Some(map)), ("", None)]),
                MaterialDesc::Principled(m) => ("principled", m.directions()),
                _ => continue,
            };
            for (key, map) in maps {
                let Some(Color::Texture(map)) = map else { continue };
                let Some(TextureDesc::Image(image)) = self.texture.get(map.name()) else { continue };
                if !image.is_srgb() {
                    continue;
                }
                let message =
                    format!("the normals in `{}` are read as sRGB colours, and point in wrong directions", image.file);
                let hint = format!("say encoding = \"linear\" in [texture.{}.image]", map.name());
                c.within(name, |c| c.within(kind, |c| c.problem(key, message, Some(hint))));
            }
        }
    }

    /// Whether a material, or one that it is made of, is a lamp, and if so, whether that gives light.
    fn lamp(&self, material: &str) -> Option<bool> {
        let material = self.material.get(material)?;
        let here = material.emission().map(|emission| emission.color.rgb() != Some(Rgb::grey(0.0)));
        let mut material = material.clone();
        let parts = material.parts().into_iter().filter_map(|(_, name)| self.lamp(name?.name()));
        here.into_iter().chain(parts).reduce(|a, b| a || b)
    }

    fn is_emissive(&self, material: Option<&str>) -> bool {
        self.lamp(material.unwrap_or(Self::DEFAULT_MATERIAL)).is_some()
    }

    fn warn_of_darkness(&self, c: &mut Checker) {
        if self.environment.is_dark() && self.light.is_dark() && !self.has_lamps() {
            let hint =
                "add [environment.constant], a light as in [[light.point]], or a shape of an `emissive` material";
            c.problem("environment", "nothing shines: the picture will be black", Some(hint.to_owned()));
        }
    }

    /// Whether a surface gives light.
    pub(crate) fn has_lamps(&self) -> bool {
        let shines = |name: Option<&str>| self.lamp(name.unwrap_or(Self::DEFAULT_MATERIAL)) == Some(true);
        self.shape.sphere.iter().any(|s| shines(s.material.as_deref()))
            || self.shape.quad.iter().any(|q| shines(q.material.as_deref()))
            || self
                .shape
                .mesh
                .iter()
                .any(|m| shines(m.material.as_deref()) && m.degenerate_count() < m.triangle_count())
    }

    fn warn_of_meshes(&self, c: &mut Checker) {
        for (i, mesh) in self.shape.mesh.iter().enumerate() {
            if mesh.triangle_count() == 0 {
                c.problem(i, "this mesh has no triangles", None);
            }
            if self.is_emissive(mesh.material.as_deref()) {
                match mesh.degenerate_count() {
                    0 => {}
                    1 => c.problem(i, "1 triangle of this lamp has no area and gives no light", None),
                    n => c.problem(i, format!("{n} triangles of this lamp have no area and give no light"), None),
                }
            }
        }
    }
}

fn is_unlit_lamp(material: &MaterialDesc) -> bool {
    matches!(material, MaterialDesc::Emissive(lamp) if lamp.radiance.rgb() == Some(Rgb::grey(0.0)))
}

impl EnvironmentDesc {
    fn warn(&self, c: &mut Checker) {
        match self {
            Self::Sky(sky) => {
                if let Some(message) = sky.warning() {
                    c.problem("sky", message, None);
                }
            }
            Self::Image(map) => {
                let size = map.image.as_ref().map(|image| (image.width(), image.height()));
                if let Some((width, height)) = size.filter(|&(w, h)| w != 2 * h && (w, h) != (1, 1)) {
                    let hint = "a panorama of all directions is twice as wide as high".to_owned();
                    let message = format!("`{}` is {width} x {height} pixels: it looks stretched", map.file);
                    c.within("image", |c| c.problem("file", message, Some(hint)));
                }
            }
            Self::Gradient(_) | Self::Constant(_) | Self::None(_) => {}
        }
    }
}

impl LightsDesc {
    /// Each light by its kind and place in the list: whether it is dark, and whether rays can meet it.
    fn each(&self) -> impl Iterator<Item = (&'static str, usize, bool, bool)> {
        let is_black = |rgb: Rgb| rgb.0 == [0.0; 3];
        let points = self.point.iter().map(move |l| (is_black(l.intensity), false)).enumerate();
        let spots = self.spot.iter().map(move |l| (is_black(l.intensity), false)).enumerate();
        let suns = self.directional.iter().map(move |l| (is_black(l.irradiance), l.angle > 0.0)).enumerate();
        let ies = self.ies.iter().map(|l| (l.is_dark(), false)).enumerate();
        let projectors = self.projector.iter().map(|l| (l.is_dark(), false)).enumerate();
        let named = |kind| move |(i, (is_dark, is_seen))| (kind, i, is_dark, is_seen);
        points
            .map(named("point"))
            .chain(spots.map(named("spot")))
            .chain(suns.map(named("directional")))
            .chain(ies.map(named("ies")))
            .chain(projectors.map(named("projector")))
    }

    pub(crate) fn is_dark(&self) -> bool {
        self.each().all(|(_, _, is_dark, _)| is_dark)
    }

    fn warn(&self, integrator: IntegratorKind, c: &mut Checker) {
        for (kind, i, is_dark, is_seen) in self.each() {
            if is_dark {
                c.within(kind, |c| c.problem(i, "this light gives no light", None));
            } else if integrator == IntegratorKind::Weekend && !is_seen {
                let hint = "use the integrator `path`, or a shape of an `emissive` material".to_owned();
                let message = "`weekend` does not find this light: it has no size, and no ray meets it";
                c.within(kind, |c| c.problem(i, message, Some(hint)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::film::Image;
    use crate::light::sky::SkyDesc;
    use crate::light::{Constant, DirectionalLight, ImageEnvironment, NoLight, PointLight};
    use crate::material::Emissive;
    use crate::names::Name;
    use crate::shape::{MeshDesc, SphereDesc};
    use crate::texture::{Encoding, ImageTexture, Pixels, Samples};

    const DARK: EnvironmentDesc = EnvironmentDesc::None(NoLight {});

    fn said(desc: &SceneDesc) -> Vec<String> {
        assert_eq!(desc.check(), []);
        desc.warnings().iter().map(ToString::to_string).collect()
    }

    fn with_lamp(radiance: f32) -> SceneDesc {
        let lamp = Emissive { radiance: Rgb::grey(radiance).into(), ..Emissive::default() };
        let material = [("lamp".to_owned(), MaterialDesc::Emissive(lamp))].into();
        SceneDesc { environment: DARK, material, ..SceneDesc::default() }
    }

    fn point(intensity: f32) -> PointLight {
        PointLight { position: [0.0; 3], intensity: Rgb::grey(intensity) }
    }

    #[test]
    fn nothing_shines() {
        const NOTHING: &str = "environment: nothing shines: the picture will be black";
        assert!(said(&SceneDesc::default()).is_empty());
        let dark = SceneDesc { environment: DARK, ..SceneDesc::default() };
        assert_eq!(said(&dark), [NOTHING]);
        let black = EnvironmentDesc::Constant(Constant { radiance: Rgb::grey(0.0) });
        assert_eq!(said(&SceneDesc { environment: black, ..SceneDesc::default() }), [NOTHING]);
        // A lamp that no shape is made of, and one that some are.
        let mut desc = with_lamp(1.0);
        assert_eq!(said(&desc), [NOTHING]);
        desc.shape.sphere.push(SphereDesc {
            center: [0.0; 3],
            radius: 1.0,
            material: Some("lamp".to_owned()),
            ..SphereDesc::default()
        });
        assert!(said(&desc).is_empty());
        let mut desc = dark.clone();
        desc.light.point = vec![point(0.0)];
        assert_eq!(said(&desc), [NOTHING, "light.point.0: this light gives no light"]);
        desc.light.point.push(point(1.0));
        assert_eq!(said(&desc), ["light.point.0: this light gives no light"]);
    }

    #[test]
    fn lamps_without_light() {
        let mut desc = with_lamp(0.0);
        desc.environment = EnvironmentDesc::default();
        assert_eq!(said(&desc), ["material.lamp.emissive.radiance: this lamp gives no light"]);
        let mut desc = with_lamp(1.0);
        desc.environment = EnvironmentDesc::default();
        desc.shape.mesh.push(MeshDesc {
            vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]],
            triangles: vec![[0, 1, 2], [0, 1, 1], [0, 1, 3], [2, 2, 2]],
            material: Some("lamp".to_owned()),
            ..MeshDesc::default()
        });
        assert_eq!(said(&desc), ["shape.mesh.0: 3 triangles of this lamp have no area and give no light"]);
        desc.shape.mesh[0].triangles.clear();
        assert_eq!(said(&desc), ["shape.mesh.0: this mesh has no triangles"]);
    }

    #[test]
    fn the_sun_is_down() {
        let sky = SkyDesc { sun_elevation: Some(-5.0), ..SkyDesc::default() };
        let desc = SceneDesc { environment: EnvironmentDesc::Sky(sky), ..SceneDesc::default() };
        assert!(matches!(said(&desc).as_slice(), [one] if one.contains("5.0 degrees below the horizon")));
    }

    #[test]
    fn panoramas_are_twice_as_wide_as_high() {
        for (width, height, is_fine) in [(1, 1, true), (2, 1, true), (8, 4, true), (8, 8, false), (1, 2, false)] {
            let mut image = Image::new(width, height);
            image.set_pixel(0, 0, [1.0; 3]);
            let map =
                ImageEnvironment { file: "a".to_owned(), rotation: 0.0, scale: 1.0, image: Some(Arc::new(image)) };
            let desc = SceneDesc { environment: EnvironmentDesc::Image(map), ..SceneDesc::default() };
            assert_eq!(said(&desc).is_empty(), is_fine, "{width} x {height}");
        }
    }

    #[test]
    fn normals_are_no_colours() {
        let said_of = |encoding, samples| {
            let pixels = Pixels::new(1, 1, 3, samples).map(Arc::new);
            let image = ImageTexture { encoding, ..ImageTexture::new("n.png", pixels) };
            let of = Name::new("base");
            let map = NormalMap { of, map: Color::Texture(Name::new("n")), strength: 1.0 };
            let mut desc = SceneDesc::default();
            desc.texture.insert("n".to_owned(), TextureDesc::Image(image));
            desc.material.insert("base".to_owned(), MaterialDesc::default());
            desc.material.insert("m".to_owned(), MaterialDesc::NormalMap(map));
            said(&desc)
        };
        let warned = said_of(Encoding::Auto, Samples::Byte(vec![128, 128, 255]));
        assert!(
            warned[0].starts_with("material.m.normal-map.map: the normals in `n.png` are read as sRGB"),
            "{warned:?}"
        );
        assert!(said_of(Encoding::Linear, Samples::Byte(vec![128, 128, 255])).is_empty());
        assert!(said_of(Encoding::Auto, Samples::Float(vec![0.5, 0.5, 1.0])).is_empty());
    }

    #[test]
    fn what_weekend_does_not_find() {
        let mut desc = SceneDesc::default();
        desc.light.point.push(point(1.0));
        for angle in [0.0, 1.0] {
            let direction = [0.0, 1.0, 0.0];
            desc.light.directional.push(DirectionalLight { direction, irradiance: Rgb::grey(1.0), angle });
        }
        assert!(said(&desc).is_empty());
        desc.render.integrator = IntegratorKind::Weekend;
        let said = said(&desc);
        assert!(
            said.len() == 2 && said[0].starts_with("light.point.0: `weekend` does not find this light"),
            "{said:?}"
        );
        assert!(said[1].starts_with("light.directional.0: "), "{said:?}");
    }
}
