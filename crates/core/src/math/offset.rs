//! Ray origins that do not hit the surface they start on.
//!
//! Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §6.8.6: the origin moves along the normal by as
//! much as the point's rounding error reaches in that direction, and no farther, at every scale.

use glam::Vec3;

/// The origin of a ray that leaves along `w` a surface point `p` with normal `n`, whose coordinates are off by
/// at most `p_error`.
#[inline]
pub fn offset_ray_origin(p: Vec3, p_error: Vec3, n: Vec3, w: Vec3) -> Vec3 {
    let d = n.abs().dot(p_error);
    let offset = if w.dot(n) < 0.0 { -d * n } else { d * n };
    let moved = p + offset;
    // Round away from the surface.
    let away = |x: f32, by: f32| {
        if by > 0.0 {
            x.next_up()
        } else if by < 0.0 {
            x.next_down()
        } else {
            x
        }
    };
    Vec3::new(away(moved.x, offset.x), away(moved.y, offset.y), away(moved.z, offset.z))
}
