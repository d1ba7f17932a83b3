//! Mirror and refracted directions; in the local frame of a surface (normal = +z) where no normal is given.

use glam::Vec3;

/// `w` mirrored at the normal; both point away from the surface.
#[inline]
pub fn reflect(w: Vec3) -> Vec3 {
    Vec3::new(-w.x, -w.y, w.z)
}

/// `w` mirrored at a unit normal; both point away from the surface.
#[inline]
pub fn reflect_at(w: Vec3, n: Vec3) -> Vec3 {
    2.0 * w.dot(n) * n - w
}

/// The direction behind the surface that `w` is refracted into, by Snell's law; `eta` is the index behind over
/// the index before, `cos_t` the cosine of the refracted angle (see [`Fresnel`](crate::material::Fresnel)).
#[inline]
pub fn refract(w: Vec3, eta: f32, cos_t: f32) -> Vec3 {
    Vec3::new(-w.x / eta, -w.y / eta, -cos_t.copysign(w.z)).normalize()
}
