//! Meshes to trace rays through: made by formulas, so that nothing has to be downloaded and everyone measures the same.

mod boxes;
mod foliage;
mod interior;
mod noise;
mod sphere;

use clap::ValueEnum;
use eyebeam_bvh::Mesh;
use glam::Vec3;

use crate::kernel::random::Random;

/// The meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MeshName {
    /// A displaced sphere of 1.31 million triangles of even size, on a floor
    Sphere,
    /// A hall of 0.27 million triangles of every size and shape
    Interior,
    /// 2.13 million triangles, most of them small leaves that overlap
    Foliage,
    /// Two boxes in a box, 34 triangles: for trying
    Boxes,
}

impl MeshName {
    /// What is measured if nothing else is asked for.
    pub const LARGE: [Self; 3] = [Self::Sphere, Self::Interior, Self::Foliage];

    /// As in tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Interior => "interior",
            Self::Foliage => "foliage",
            Self::Boxes => "boxes",
        }
    }

    /// Makes the mesh.
    pub fn model(self) -> Model {
        match self {
            Self::Sphere => sphere::model(331),
            Self::Interior => interior::model(),
            Self::Foliage => foliage::model(1_000_000),
            Self::Boxes => boxes::model(),
        }
    }
}

/// A rectangle or parallelogram: a corner and its two edges.
pub(crate) type Patch = [Vec3; 3];

/// Where primary rays come from.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct View {
    pub(crate) eye: Vec3,
    pub(crate) look_at: Vec3,
    /// Vertical field of view, degrees.
    pub(crate) vfov_deg: f32,
}

/// A mesh, from where it is looked at, and what shines on it.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Positions.
    pub vertices: Vec<Vec3>,
    /// Three indices of vertices for each triangle.
    pub triangles: Vec<[u32; 3]>,
    pub(crate) view: View,
    /// What shadow rays go to. Not part of the mesh.
    pub(crate) lights: Vec<Patch>,
}

impl Model {
    /// What a tree is built from.
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh { vertices: &self.vertices, triangles: &self.triangles }
    }

    /// The corners of a triangle.
    pub(crate) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|vertex| self.vertices[vertex as usize])
    }

    /// A surface of `nu` x `nv` cells, two triangles each; `surface` maps the unit square to points.
    fn grid(&mut self, nu: u32, nv: u32, surface: impl Fn(f32, f32) -> Vec3) {
        let base = self.vertices.len() as u32;
        for j in 0..=nv {
            for i in 0..=nu {
                self.vertices.push(surface(i as f32 / nu as f32, j as f32 / nv as f32));
            }
        }
        for j in 0..nv {
            for i in 0..nu {
                let a = base + j * (nu + 1) + i;
                let c = a + nu + 1;
                self.triangles.push([a, a + 1, c]);
                self.triangles.push([a + 1, c + 1, c]);
            }
        }
    }

    fn patch(&mut self, [corner, u, v]: Patch) {
        self.grid(1, 1, |s, t| corner + (u * s + v * t));
    }

    /// A box with a centre and three half edges.
    fn cuboid(&mut self, center: Vec3, half: [Vec3; 3]) {
        for k in 0..3 {
            for side in [-1.0, 1.0] {
                let (u, v) = (half[(k + 1) % 3], half[(k + 2) % 3]);
                self.patch([center + half[k] * side - u - v, u * 2.0, v * 2.0]);
            }
        }
    }

    /// A box with edges along the axes.
    fn upright_cuboid(&mut self, center: Vec3, half: Vec3) {
        self.cuboid(center, [Vec3::X * half.x, Vec3::Y * half.y, Vec3::Z * half.z]);
    }

    /// A box that is turned somehow.
    fn random_cuboid(&mut self, center: Vec3, half: Vec3, random: &mut Random) {
        let a = random_direction(random);
        let b = a.cross(if a.x.abs() < 0.6 { Vec3::X } else { Vec3::Y }).normalize();
        self.cuboid(center, [a * half.x, b * half.y, a.cross(b) * half.z]);
    }
}

/// A point in the cube, projected onto the sphere: not uniform, but as good.
fn random_direction(random: &mut Random) -> Vec3 {
    random_point(random, [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0]).normalize()
}

/// A point in a box that is given by its range along each axis.
fn random_point(random: &mut Random, x: [f32; 2], y: [f32; 2], z: [f32; 2]) -> Vec3 {
    Vec3::new(random.range(x[0], x[1]), random.range(y[0], y[1]), random.range(z[0], z[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Results are compared with those of other days, so the meshes must stay what they are.
    #[test]
    fn meshes_stay_as_large_as_they_are() {
        let expected = [
            (MeshName::Sphere, 1_314_734),
            (MeshName::Interior, 274_076),
            (MeshName::Foliage, 2_131_072),
            (MeshName::Boxes, 34),
        ];
        for (name, triangles) in expected {
            let model = name.model();
            assert_eq!(model.triangles.len(), triangles, "{}", name.label());
            assert!(model.vertices.iter().all(|v| v.is_finite()));
        }
    }
}
