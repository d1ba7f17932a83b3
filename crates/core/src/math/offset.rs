//! Ray origins that do not hit the surface they start on.
//!
//! Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §6.8.6: the origin moves along the normal by as
//! much as the point's rounding error reaches in that direction, and no farther, at every scale.

use glam::Vec3;

/// The origin of a ray that leaves along `w` a surface point `p` with normal `n`, whose coordinates are off by
/// at most `p_error`.
#[inline]
pub fn offset_ray_origin(p: Vec3, p_error: Vec3, n: Vec3, w: Vec3) -> Vec3 {
    // The sum below is rounded too, by at most half of this.
    let rounding = p.abs() * f32::EPSILON;
    let d = n.abs().dot(p_error + rounding);
    p + n * d.copysign(w.dot(n))
}
