//! Where most of a scene is.

use std::array;

use glam::{Affine3A, Vec3};

use crate::desc::SceneDesc;
use crate::shape::MeshDesc;

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

    pub(super) fn around(points: impl Iterator<Item = Vec3>) -> Option<Self> {
        let boxed = points.map(|p| Self { min: p, max: p });
        boxed.reduce(|a, b| Self { min: a.min.min(b.min), max: a.max.max(b.max) })
    }

    /// Its middle.
    pub(super) fn center(&self) -> Vec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// How far one of the six sides is along the direction outwards: −x, x, −y and so on.
    pub(super) fn side(&self, side: usize) -> f32 {
        if side.is_multiple_of(2) { -self.min[side / 2] } else { self.max[side / 2] }
    }

    /// From corner to corner, metres.
    pub(super) fn size(&self) -> f32 {
        (self.max - self.min).length()
    }

    fn corners(&self) -> [Vec3; 8] {
        let side = |i: usize, axis: usize| if i >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
        array::from_fn(|i| Vec3::new(side(i, 0), side(i, 1), side(i, 2)))
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
        push_mesh(&mut points, mesh);
    }
    for quad in &desc.shape.quad {
        let [corner, u, v] = [quad.corner, quad.u, quad.v].map(Vec3::from);
        points.extend([corner, corner + u, corner + v, corner + u + v]);
    }
    for sphere in &desc.shape.sphere {
        let (center, r) = (Vec3::from(sphere.center), Vec3::splat(sphere.radius));
        points.extend(Extent { min: center - r, max: center + r }.corners());
    }
    points.retain(|p| p.is_finite());
    points
}

/// More points or faces of the copies of a mesh are not looked at one by one.
const MANY: usize = 1 << 20;

/// Triangles by their corners, as often as one likes: those of a large model are not kept.
pub(super) trait Faces: Iterator<Item = [Vec3; 3]> + Clone {}

impl<T: Iterator<Item = [Vec3; 3]> + Clone> Faces for T {}

/// The corners of all triangles and of the halves of quads, counter-clockwise seen from where their normals point. What is there in very many
/// copies is no wall, and left out.
pub(super) fn faces(desc: &SceneDesc) -> impl Faces {
    let of_mesh = |mesh: &'_ MeshDesc| -> Vec<Affine3A> {
        match mesh.instances.len() {
            0 => vec![Affine3A::IDENTITY],
            copies if copies.saturating_mul(mesh.triangle_count()) > MANY => Vec::new(),
            _ => mesh.copies().collect(),
        }
    };
    let meshes = desc.shape.mesh.iter().flat_map(move |mesh| {
        let copies = of_mesh(mesh);
        copies.into_iter().flat_map(move |copy| {
            let is_mirrored = copy.matrix3.determinant() < 0.0;
            let placed = move |corners: [Vec3; 3]| {
                let [a, b, c] = corners.map(|corner| copy.transform_point3(corner));
                if is_mirrored { [a, c, b] } else { [a, b, c] }
            };
            mesh.faces().map(placed)
        })
    });
    let quads = desc.shape.quad.iter().flat_map(|quad| {
        let [corner, u, v] = [quad.corner, quad.u, quad.v].map(Vec3::from);
        [[corner, corner + u, corner + v], [corner + u + v, corner + v, corner + u]]
    });
    meshes.chain(quads)
}

/// Those of a mesh, or of its copies; if these have many, of the boxes around them.
fn push_mesh(points: &mut Vec<Vec3>, mesh: &MeshDesc) {
    let mut vertices: Vec<_> = mesh.vertices().iter().map(|&v| Vec3::from(v)).collect();
    if mesh.instances.is_empty() {
        points.append(&mut vertices);
        return;
    }
    if vertices.len().saturating_mul(mesh.instances.len()) > MANY
        && let Some(whole) = Extent::around(vertices.iter().copied())
    {
        vertices = whole.corners().into();
    }
    points.extend(mesh.copies().flat_map(|copy| vertices.iter().map(move |&v| copy.transform_point3(v))));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(vertices: Vec<[f32; 3]>) -> Option<Extent> {
        let mut desc = SceneDesc::default();
        desc.shape.mesh.push(MeshDesc { vertices, ..MeshDesc::default() });
        Extent::of(&points(&desc))
    }

    #[test]
    fn copies_count_where_they_are() {
        let mut desc = SceneDesc::default();
        let place = |x: f32| [2.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 3.0, 4.0]];
        desc.shape.mesh.push(MeshDesc { vertices, instances: vec![place(-1.0), place(5.0)], ..MeshDesc::default() });
        let expected = Extent { min: Vec3::new(-1.0, 0.0, 0.0), max: Vec3::new(7.0, 3.0, 4.0) };
        assert_eq!(Extent::of(&points(&desc)), Some(expected));
        desc.shape.mesh[0].instances.resize(1 << 19, place(5.0));
        assert_eq!(Extent::of(&points(&desc)), Some(expected));
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
