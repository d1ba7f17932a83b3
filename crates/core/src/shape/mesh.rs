//! The triangle list.
//!
//! ```toml
//! [[shape.mesh]]
//! vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
//! triangles = [[0, 1, 2]]
//! material = "paper"
//! ```

use eyebeam_bvh::{Primitive, Triangle};
use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::arrays;
use crate::shape::{ShapeDesc, Smooth};
use crate::validate::Checker;

/// Triangles that share vertices. The normal of triangle a, b, c is (b − a) × (c − a).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshDesc {
    /// Vertices, metres.
    #[serde(deserialize_with = "arrays")]
    pub vertices: Vec<[f32; 3]>,
    /// Three indices into `vertices` each. Triangles without area are never hit.
    #[serde(deserialize_with = "arrays")]
    pub triangles: Vec<[u32; 3]>,
    /// A normal at each vertex, of any length, if the mesh shall look round; else its triangles look flat.
    #[serde(default, deserialize_with = "arrays")]
    pub normals: Vec<[f32; 3]>,
    /// Name of a material; grey matte if absent.
    #[serde(default)]
    pub material: Option<String>,
}

impl ShapeDesc for MeshDesc {
    fn check(&self, c: &mut Checker) {
        c.within("vertices", |c| {
            for (i, vertex) in
                self.vertices.iter().enumerate().filter(|(_, v)| !v.iter().copied().all(Checker::is_finite))
            {
                c.problem(
                    i,
                    format!("vertex {i} is {vertex:?}"),
                    Some("numbers up to 1e15 in size are allowed".to_owned()),
                );
            }
        });
        let count = self.vertices.len();
        if !self.normals.is_empty() && self.normals.len() != count {
            let message = format!("there are {} normals for {count} vertices", self.normals.len());
            c.problem("normals", message, Some("give one for each vertex, or none".to_owned()));
        }
        c.within("normals", |c| {
            for (i, normal) in
                self.normals.iter().enumerate().filter(|(_, n)| !n.iter().copied().all(Checker::is_finite))
            {
                c.problem(i, format!("normal {i} is {normal:?}"), Some("use finite numbers".to_owned()));
            }
        });
        c.within("triangles", |c| {
            for (i, triangle) in self.triangles.iter().enumerate() {
                if let Some(missing) = triangle.iter().find(|&&v| v as usize >= count) {
                    let hint = format!("the mesh has {count} vertices, counted from 0");
                    c.problem(i, format!("triangle {i} names vertex {missing}, which does not exist"), Some(hint));
                }
            }
        });
    }

    fn push_primitives(&self, primitives: &mut Vec<Primitive>) {
        // The check has found that every vertex exists.
        let vertex = |i: u32| self.vertices.get(i as usize).map(|&v| Vec3::from(v));
        let triangle = |&[a, b, c]: &[u32; 3]| Some(Triangle { a: vertex(a)?, b: vertex(b)?, c: vertex(c)? });
        primitives.extend(self.triangles.iter().filter_map(triangle).map(Primitive::Triangle));
    }

    fn material(&self) -> Option<&str> {
        self.material.as_deref()
    }

    fn smooth(&self) -> Option<Smooth> {
        (!self.normals.is_empty()).then(|| Smooth::new(self.triangles.clone(), &self.normals))
    }
}
