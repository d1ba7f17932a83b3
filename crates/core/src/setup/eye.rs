//! Where the eye is put.
//!
//! Of the points as seen along its direction, x to the right, y upwards and z towards the eye, the ones that bound the picture
//! at the right have the largest x / t + z, where t is the tangent of half the angle of view; so for the other sides. The eye
//! that sees a point of each pair of sides at the same angle is where the two planes meet: no search is needed.

use glam::Vec3;

use crate::camera::CameraDesc;
use crate::math::sin_cos_turns;
use crate::setup::extent::{Extent, Faces};

/// Vertical angle of view, degrees: that of a portrait lens.
const VFOV: f32 = 28.0;
/// How much of the picture's width or height is filled.
pub(super) const FILL: f32 = 0.74;

/// A camera in front of what there is, for pictures so many times as wide as high.
pub(super) fn in_front(points: &[Vec3], faces: &impl Faces, extent: &Extent, aspect: f32) -> CameraDesc {
    from_side(points, extent, aspect, direction(faces, extent))
}

/// A camera that sees what there is from a direction, and that fills the picture.
pub(super) fn from_side(points: &[Vec3], extent: &Extent, aspect: f32, back: Vec3) -> CameraDesc {
    let (center, back) = (extent.center(), back.normalize());
    let right = Vec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let (sin, cos) = sin_cos_turns(VFOV / 720.0);
    let t_y = FILL * sin / cos;
    let t_x = t_y * aspect;
    // Right, left, upper and lower side.
    let mut sides = [f32::NEG_INFINITY; 4];
    for p in points.iter().filter(|&&p| extent.holds(p)) {
        let p = *p - center;
        let (x, y, z) = (p.dot(right), p.dot(up), p.dot(back));
        let side = [z + x / t_x, z - x / t_x, z + y / t_y, z - y / t_y];
        sides = [0, 1, 2, 3].map(|i| sides[i].max(side[i]));
    }
    let [x, y] = [0.5 * t_x * (sides[0] - sides[1]), 0.5 * t_y * (sides[2] - sides[3])];
    let distance = (0.5 * (sides[0] + sides[1])).max(0.5 * (sides[2] + sides[3]));
    // Of a single point.
    let distance = if distance > 1e-12 { distance } else { 1.0 };
    let at = center + right * x + up * y;
    CameraDesc {
        look_from: (at + back * distance).into(),
        look_at: at.into(),
        vfov: Some(VFOV),
        ..CameraDesc::default()
    }
}

/// From what there is to the eye: of flat things more from where they are wide, and from where they face to.
fn direction(faces: &impl Faces, extent: &Extent) -> Vec3 {
    /// Thinner than this part of its width a thing is flat.
    const FLAT: f32 = 0.02;
    let size = extent.max - extent.min;
    let is_flat = |axis: usize| size[axis] < FLAT * size.max_element();
    let [azimuth, elevation] = match [is_flat(0), is_flat(1), is_flat(2)] {
        [false, true, false] => [25.0, 50.0],
        [true, false, false] => [75.0, 10.0],
        [false, false, true] => [15.0, 8.0],
        _ => [32.0, 16.0],
    };
    let facing: Vec3 = faces.clone().map(|[a, b, c]| (b - a).cross(c - a)).sum();
    let is_behind = is_flat(0) && facing.x < 0.0 || is_flat(2) && facing.z < 0.0;
    // Through the plane of a flat thing, to the other side.
    let azimuth = match (is_behind, is_flat(0)) {
        (false, _) => azimuth,
        (true, true) => -azimuth,
        (true, false) => 180.0 - azimuth,
    };
    let ((sin_a, cos_a), (sin_e, cos_e)) = (sin_cos_turns(azimuth / 360.0), sin_cos_turns(elevation / 360.0));
    Vec3::new(sin_a * cos_e, sin_e, cos_a * cos_e)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::desc::SceneDesc;
    use crate::setup::extent::points;
    use crate::shape::MeshDesc;

    /// The box of everything in the picture, from −1 to 1 each way.
    fn framed(desc: &SceneDesc, aspect: f32) -> [Vec2; 2] {
        let points = points(desc);
        let camera = in_front(&points, &std::iter::empty(), &Extent::of(&points).unwrap(), aspect);
        let [from, at] = [camera.look_from, camera.look_at].map(|p| Vec3::from(p).as_dvec3());
        let back = (from - at).normalize();
        let right = glam::DVec3::Y.cross(back).normalize();
        let t = (f64::from(camera.vfov.unwrap()).to_radians() / 2.0).tan();
        let place = |p: Vec3| {
            let p = p.as_dvec3() - from;
            let depth = -p.dot(back);
            assert!(depth > 0.0, "in front of the eye");
            Vec2::new((p.dot(right) / depth / t) as f32 / aspect, (p.dot(back.cross(right)) / depth / t) as f32)
        };
        let places: Vec<_> = points.into_iter().map(place).collect();
        [places.iter().copied().reduce(Vec2::min).unwrap(), places.iter().copied().reduce(Vec2::max).unwrap()]
    }

    #[test]
    fn fills_the_picture_whatever_the_shape_and_the_unit() {
        let shapes =
            [[1.0, 1.0, 1.0], [9.0, 0.1, 0.1], [0.1, 9.0, 0.1], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 0.0]];
        for (shape, unit, aspect) in shapes
            .iter()
            .flat_map(|s| [1e-6, 1.0, 1e6].map(|unit| (s, unit)))
            .flat_map(|(s, u)| [16.0 / 9.0, 1.0, 9.0 / 16.0].map(|aspect| (s, u, aspect)))
        {
            let mut desc = SceneDesc::default();
            let corner = |i: usize| {
                [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { 3.0 * unit } else { (3.0 + shape[axis]) * unit })
            };
            desc.shape.mesh.push(MeshDesc { vertices: (0..8).map(corner).collect(), ..MeshDesc::default() });
            let [min, max] = framed(&desc, aspect);
            let fill = (0.5 * (max - min)).max_element();
            assert!((0.7..0.78).contains(&fill), "{shape:?} {unit} {aspect}: {fill}");
            let tight = if max.x - min.x > max.y - min.y { min.x + max.x } else { min.y + max.y };
            assert!(tight.abs() < 0.01, "{shape:?} {unit} {aspect}: {min} {max}");
        }
    }

    /// A sheet that faces along an axis is seen from where it faces to; one that lies is seen from above.
    #[test]
    fn flat_things_are_seen_from_the_front() {
        for (u, v, n) in [
            (Vec3::X, Vec3::Y, Vec3::Z),
            (Vec3::Y, Vec3::X, Vec3::NEG_Z),
            (Vec3::Y, Vec3::Z, Vec3::X),
            (Vec3::Z, Vec3::Y, Vec3::NEG_X),
            (Vec3::Z, Vec3::X, Vec3::Y),
            (Vec3::X, Vec3::Z, Vec3::Y),
        ] {
            let faces = [[Vec3::ZERO, u, v], [u + v, v, u]];
            let points: Vec<_> = faces.iter().flatten().copied().collect();
            let camera = in_front(&points, &faces.into_iter(), &Extent::of(&points).unwrap(), 1.5);
            let back = Vec3::from(camera.look_from) - Vec3::from(camera.look_at);
            assert!(back.normalize().dot(n) > 0.6, "{n}: {back}");
        }
    }
}
