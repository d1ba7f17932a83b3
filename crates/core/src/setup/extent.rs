//! Where most of a scene is.

use glam::Vec3;

use crate::desc::SceneDesc;

/// A box around what there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    /// The least of each coordinate, metres.
    pub(super) min: Vec3,
    /// The greatest of each coordinate, metres.
    pub(super) max: Vec3,
}

impl Extent {
    /// Of points; none if there are none. A few that are far from all others do not count.
    pub(super) fn of(points: &[Vec3]) -> Option<Self> {
        /// So many parts of all points, at either end of each axis, may be strays.
        const STRAYS: f32 = 0.005;
        /// They are, if they make the box so many times as large.
        const MUCH: f32 = 3.0;
        let whole = Self::around(points.iter().copied())?;
        let strays = (points.len() as f32 * STRAYS) as usize;
        let mut middle = whole;
        for axis in 0..3 {
            let mut along: Vec<f32> = points.iter().map(|p| p[axis]).collect();
            let last = along.len() - 1 - strays;
            middle.min[axis] = *along.select_nth_unstable_by(strays, f32::total_cmp).1;
            middle.max[axis] = *along.select_nth_unstable_by(last, f32::total_cmp).1;
        }
        Some(if whole.size() > MUCH * middle.size() && middle.size() > 0.0 { middle } else { whole })
    }

    fn around(points: impl Iterator<Item = Vec3>) -> Option<Self> {
        let boxed = points.map(|p| Self { min: p, max: p });
        boxed.reduce(|a, b| Self { min: a.min.min(b.min), max: a.max.max(b.max) })
    }

    /// Its middle.
    pub(super) fn center(&self) -> Vec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// From corner to corner, metres.
    pub(super) fn size(&self) -> f32 {
        (self.max - self.min).length()
    }

    /// Whether a point is inside, or on it.
    pub(super) fn holds(&self, p: Vec3) -> bool {
        p.cmpge(self.min).all() && p.cmple(self.max).all()
    }
}

/// Corners of everything; of a sphere, those of the box around it.
pub(super) fn points(desc: &SceneDesc) -> Vec<Vec3> {
    let mut points = Vec::new();
    for mesh in &desc.shape.mesh {
        let vertices = mesh.data.as_ref().map_or(&mesh.vertices, |data| &data.vertices);
        points.extend(vertices.iter().map(|&v| Vec3::from(v)));
    }
    for quad in &desc.shape.quad {
        let [corner, u, v] = [quad.corner, quad.u, quad.v].map(Vec3::from);
        points.extend([corner, corner + u, corner + v, corner + u + v]);
    }
    for sphere in &desc.shape.sphere {
        let (center, r) = (Vec3::from(sphere.center), sphere.radius);
        let corner =
            |i: u32| center + r * Vec3::from([0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.0 } else { 1.0 }));
        points.extend((0..8).map(corner));
    }
    points.retain(|p| p.is_finite());
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::MeshDesc;

    fn of(vertices: Vec<[f32; 3]>) -> Option<Extent> {
        let mut desc = SceneDesc::default();
        desc.shape.mesh.push(MeshDesc { vertices, ..MeshDesc::default() });
        Extent::of(&points(&desc))
    }

    #[test]
    fn a_few_strays_do_not_count_and_a_long_rod_does() {
        let cube: Vec<_> = (0..1000).map(|i| [i % 10, i / 10 % 10, i / 100].map(|c| c as f32)).collect();
        let expected = Extent { min: Vec3::ZERO, max: Vec3::splat(9.0) };
        assert_eq!(of(cube.clone()), Some(expected));
        assert_eq!(of([cube.clone(), vec![[1e6, 0.0, 0.0]]].concat()), Some(expected));
        let rod: Vec<_> = (0..100).map(|i| [i as f32, 0.0, 0.0]).collect();
        assert_eq!(of([cube, rod].concat()).unwrap().max, Vec3::new(99.0, 9.0, 9.0));
        assert_eq!((of(vec![]), of(vec![[2.0; 3]]).unwrap().size()), (None, 0.0));
    }
}
