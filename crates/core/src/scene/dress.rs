//! What surfaces wear: materials made of others, holes in them, normals and directions from textures.
//!
//! Only objects whose materials ask for it come here. Chances are hashes of the ray, so that every question about a hit gets the same
//! answer, whichever way through the tree leads to it.

use eyebeam_bvh::{Hit, Ray};
use glam::{Vec2, Vec3};

use crate::material::{Bump, MaterialDesc};
use crate::math::{Frame, GAMMA, mix, unit};
use crate::scene::{Met, Scene};
use crate::shape::{SurfacePoint, visible};
use crate::texture::TexturesAt;

/// Which of a scene's objects rays may pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Holes {
    /// None.
    #[default]
    None,
    /// Flat ones.
    Flat,
    /// Spheres too, of which a tree knows only the first of two places where a ray meets them.
    Round,
}

/// How a surface is dressed where a ray has met it.
pub(crate) struct Dress<'s> {
    /// Unit shading normal.
    pub(crate) ns: Vec3,
    /// The direction in which the first coordinate on the shape grows, of any length.
    pub(crate) along_u: Vec3,
    /// The material that scatters.
    pub(crate) material: &'s MaterialDesc,
}

/// Numbers of a ray's meeting with a primitive, each uniform in [0, 1).
struct Dice(u64);

impl Dice {
    fn new(ray: &Ray, hit: &Hit) -> Self {
        let [ox, oy, oz, dx, dy, dz] =
            [ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z].map(|c| u64::from(c.to_bits()));
        let pairs = [ox << 32 | oy, oz << 32 | dx, dy << 32 | dz, u64::from(hit.prim)];
        Self(pairs.into_iter().fold(u64::from(hit.instances[0]), |state, pair| mix(state.wrapping_add(GAMMA) ^ pair)))
    }

    fn roll(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(GAMMA);
        unit((mix(self.0) >> 32) as u32)
    }
}

impl Scene {
    /// The material that one is made of at a point; none if it is of its own kind.
    fn inner(&self, material: &MaterialDesc, textures: &TexturesAt<'_>, dice: &mut Dice) -> Option<&MaterialDesc> {
        let name = match material {
            MaterialDesc::Mix(m) => {
                let share = m.share.at(textures, 0.0, 1.0);
                if dice.roll() < share { &m.b } else { &m.a }
            }
            MaterialDesc::Mask(m) => &m.of,
            MaterialDesc::NormalMap(m) => &m.of,
            MaterialDesc::Bump(m) => &m.of,
            _ => return None,
        };
        // The check has found that every name exists, and none leads back to itself.
        self.materials.get(name.index() as usize)
    }

    /// Whether there is anything of a surface where a ray meets it.
    pub(super) fn is_there(&self, ray: &Ray, hit: &Hit) -> bool {
        let met = Met::new::<false>(self, hit, ray.time);
        if !met.object.has_holes {
            return true;
        }
        let point = met.point::<false>(ray, hit);
        let (textures, is_behind) = (met.textures(&point), ray.d.dot(point.n) > 0.0);
        let mut dice = Dice::new(ray, hit);
        let mut opacity = 1.0;
        let mut material = self.material(&met);
        loop {
            match material {
                MaterialDesc::Mask(mask) if mask.one_sided && is_behind => return false,
                MaterialDesc::Mask(mask) => opacity *= mask.opacity.at(&textures, 0.0, 1.0),
                MaterialDesc::Null(_) => return false,
                _ => {}
            }
            match self.inner(material, &textures, &mut dice) {
                Some(inner) => material = inner,
                None => return dice.roll() < opacity,
            }
        }
    }

    /// The nearest surface that is there, and the ray from the last sphere that it has passed.
    #[inline(never)]
    pub(super) fn meet(&self, ray: &Ray) -> Option<(Ray, Hit)> {
        let mut ray = *ray;
        loop {
            let is_round = |hit: &Hit| self.objects[self.object_of::<false>(hit) as usize].is_round;
            let hit = self.bvh.intersect_where(&ray, |hit| is_round(hit) || self.is_there(&ray, hit))?;
            if !is_round(&hit) || self.is_there(&ray, &hit) {
                return Some((ray, hit));
            }
            let point = Met::new::<false>(self, &hit, ray.time).point::<false>(&ray, &hit);
            let t_max = ray.t_max - hit.t;
            ray = Ray { t_max, time: ray.time, ..Ray::new(point.ray_origin(-ray.d, ray.d), ray.d) };
        }
    }

    /// Finds of what a surface is made where a ray meets it, and how that lies on it.
    #[inline(never)]
    pub(super) fn dress(&self, point: SurfacePoint, met: &Met<'_>, ray: &Ray, hit: &Hit) -> Dress<'_> {
        let surface = self.bvh.surface(hit, ray.time);
        let tangents = met.tangents(&surface, &point);
        let axes = met.axes(&surface, tangents);
        let textures = met.textures(&point);
        let mut dice = Dice::new(ray, hit);
        let (mut ns, mut material) = (point.ns, self.material(met));
        loop {
            let turned = match material {
                MaterialDesc::NormalMap(map) => map.normal(&textures).map(|n| along(ns, axes).to_world(n)),
                MaterialDesc::Bump(bump) => {
                    let other = if textures.at.uv_1.is_some() { met.tangents_1(&surface) } else { tangents };
                    relief(bump, &textures, met, ns, [tangents, other])
                }
                _ => None,
            };
            ns = turned.map_or(ns, |turned| bent(turned, point.n, ray.d));
            match self.inner(material, &textures, &mut dice) {
                Some(inner) => material = inner,
                None => return Dress { ns, along_u: axes[0], material },
            }
        }
    }
}

/// The frame of a normal whose x and y axes follow growing u and v.
fn along(ns: Vec3, [u, v]: [Vec3; 2]) -> Frame {
    let frame = Frame::from_zx(ns, u);
    if u.cross(v).dot(ns) < 0.0 { frame.mirrored() } else { frame }
}

/// A shading normal that is on the side of the geometric one, and mirrors the view to above the surface.
pub(crate) fn bent(ns: Vec3, n: Vec3, d: Vec3) -> Vec3 {
    let ns = if ns.dot(n) < 0.0 { (ns - 2.0 * ns.dot(n) * n).normalize_or(n) } else { ns };
    let side = 1.0_f32.copysign(-d.dot(n));
    side * visible(side * ns, side * n, -d)
}

/// The normal of a relief; `tangents` are those of both coordinates.
fn relief(bump: &Bump, textures: &TexturesAt<'_>, met: &Met<'_>, ns: Vec3, tangents: [[Vec3; 2]; 2]) -> Option<Vec3> {
    /// Of the size of coordinates, and metres: so short that textures change evenly, so long that single precision tells.
    const STEP: f32 = 2e-4;
    let step = STEP * (1.0 + textures.at.p.abs().max_element());
    let frame = Frame::from_z(ns);
    let moved = |axis: Vec3| {
        let by = step * frame.to_world(axis);
        let coordinates = |[u, v]: [Vec3; 2]| {
            let area = u.cross(v).dot(ns);
            if area == 0.0 { Vec2::ZERO } else { Vec2::new(by.cross(v).dot(ns), u.cross(by).dot(ns)) / area }
        };
        textures.moved(by, met.way_on_shape(by), tangents.map(coordinates))
    };
    let n = bump.normal([textures, &moved(Vec3::X), &moved(Vec3::Y)], step)?;
    Some(frame.to_world(n))
}
