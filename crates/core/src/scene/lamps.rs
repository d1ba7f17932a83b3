//! The lights that surfaces are by their materials.

use eyebeam_bvh::{Primitive, Slot};
use glam::Vec2;

use crate::color::Spectrum;
use crate::light::{AreaLight, Light, Lights};
use crate::material::MaterialDesc;
use crate::names::Name;
use crate::sampling::{uniform_sphere, uniform_triangle};
use crate::scene::{Met, Scene};
use crate::shape::{Plane, SurfacePoint};
use crate::texture::TexturesAt;

/// How a material shines, wherever on it.
struct Shine {
    two_sided: bool,
    /// Radiance, if it is the same all over.
    color: Option<Spectrum>,
}

impl Scene {
    /// The lights that primitives are; notes in the objects which these are.
    pub(super) fn find_lamps(&mut self, primitives: &[Primitive]) -> Vec<Light> {
        let shines: Vec<_> = self.objects.iter().map(|object| self.shine(object.material)).collect();
        let mut lights = Vec::new();
        if shines.iter().all(Option::is_none) {
            return lights;
        }
        /// So many primitives are small, each a part of a lamp.
        const MANY: usize = 1 << 13;
        let places = if primitives.len() > MANY { 3 } else { 8 };
        let slots = self.bvh.slots();
        for (i, primitive) in primitives.iter().enumerate() {
            let object = self.object_of[i] as usize;
            let Some(shine) = &shines[object] else { continue };
            if self.objects[object].placement.is_some() {
                self.objects[object].first_light = Some(Lights::UNSAMPLED);
                continue;
            }
            let index = lights.len() as u32;
            let varies = shine.color.is_none().then_some(index);
            let radiance = shine.color.unwrap_or_else(|| self.mean_radiance(primitive, i as u32, places));
            let slot = slots.get(i).copied().unwrap_or(Slot::NONE);
            if let Some(light) = AreaLight::new(primitive, slot, radiance, shine.two_sided, varies) {
                self.objects[object].first_light.get_or_insert(index);
                lights.push(Light::Area(light));
            }
        }
        lights
    }

    /// Of a material by its number, if it shines at all.
    fn shine(&self, material: u32) -> Option<Shine> {
        let material = self.materials.get(material as usize)?;
        if let Some(emission) = material.emission() {
            return Some(Shine { two_sided: emission.two_sided, color: emission.radiance() });
        }
        let parts = material.clone().parts().into_iter().filter_map(|(_, name)| self.shine(name?.index())).collect();
        let parts: Vec<Shine> = parts;
        (!parts.is_empty()).then(|| Shine { two_sided: parts.iter().any(|part| part.two_sided), color: None })
    }

    /// About the mean of the radiance of a primitive over its area, from so many places along each side, or over longitudes and latitudes.
    fn mean_radiance(&self, primitive: &Primitive, index: u32, places: u32) -> Spectrum {
        let object = &self.objects[self.object_of[index as usize] as usize];
        let mut sum = Spectrum::BLACK;
        let place = |i: u32| (i as f32 + 0.5) / places as f32;
        for (x, y) in (0..places).flat_map(|y| (0..places).map(move |x| (place(x), place(y)))) {
            let Some((point, uv)) = place_on(primitive, Vec2::new(x, y)) else { continue };
            let met =
                Met { scene: self, object, primitive: index - object.first_primitive, instance: 0, uv, time: 0.0 };
            sum += self.expected_radiance(object.material, &met.textures(&point));
        }
        sum * (1.0 / (places * places) as f32)
    }

    /// What a material sends out at a point in the mean of all chances, on the side that shines.
    fn expected_radiance(&self, material: u32, textures: &TexturesAt<'_>) -> Spectrum {
        let Some(material) = self.materials.get(material as usize) else { return Spectrum::BLACK };
        let of = |name: &Name| self.expected_radiance(name.index(), textures);
        match material {
            MaterialDesc::Mix(m) => of(&m.a).lerp(of(&m.b), m.share.at(textures, 0.0, 1.0)),
            MaterialDesc::Mask(m) => of(&m.of) * m.opacity.at(textures, 0.0, 1.0),
            MaterialDesc::NormalMap(m) => of(&m.of),
            MaterialDesc::Bump(m) => of(&m.of),
            _ => material.emission().map_or(Spectrum::BLACK, |emission| emission.radiance_at(textures)),
        }
    }
}

/// A point of a primitive, by two numbers that stand for equal areas, and its coordinates there; none of what moves.
fn place_on(primitive: &Primitive, at: Vec2) -> Option<(SurfacePoint, Vec2)> {
    match primitive {
        Primitive::Sphere(s) => {
            let n = uniform_sphere(at).as_dvec3();
            Some((SurfacePoint::on_sphere(s.center.as_dvec3(), s.radius.into(), n), Vec2::ZERO))
        }
        Primitive::Quad(q) => {
            let edges = [q.u.as_dvec3(), q.v.as_dvec3()];
            Some((Plane::new(q.corner.as_dvec3(), edges).point(at), at))
        }
        Primitive::Triangle(t) => {
            let uv = uniform_triangle(at);
            let [a, b, c] = [t.a, t.b, t.c].map(|v| v.as_dvec3());
            Some((Plane::new(a, [b - a, c - a]).point(uv), uv))
        }
        Primitive::MovingTriangle(_) | Primitive::Instance(_) => None,
    }
}
