//! The triangle list, written in the scene or in a file of its own.
//!
//! ```toml
//! [[shape.mesh]]
//! vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
//! triangles = [[0, 1, 2]]
//! material = "paper"
//! ```
//!
//! ```toml
//! [[shape.mesh]]
//! file = "bunny.ply"
//! ```

use std::array;
use std::fmt::Debug;
use std::sync::Arc;

use eyebeam_bvh::{Primitive, Triangle};
use glam::{Affine3A, DVec3, Mat3A, Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::{arrays, optional_array};
use crate::color::Rgb;
use crate::motion::{MotionDesc, MotionKey};
use crate::shape::{ShapeDesc, Smooth};
use crate::validate::Checker;

/// Triangles that share vertices: a `file`, or `vertices` and `triangles`. The normal of triangle a, b, c is
/// (b − a) × (c − a).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MeshDesc {
    /// A file (.ply) with vertices, triangles and perhaps normals. A relative name is looked for beside the scene file that
    /// says it.
    pub file: Option<String>,
    /// Vertices, metres.
    #[serde(deserialize_with = "arrays")]
    pub vertices: Vec<[f32; 3]>,
    /// Three indices into `vertices` each. Triangles without area are never hit.
    #[serde(deserialize_with = "arrays")]
    pub triangles: Vec<[u32; 3]>,
    /// A normal at each vertex, of any length, if the mesh shall look round; else its triangles look flat.
    #[serde(deserialize_with = "arrays")]
    pub normals: Vec<[f32; 3]>,
    /// Coordinates for textures at each vertex.
    #[serde(deserialize_with = "arrays")]
    pub uvs: Vec<[f32; 2]>,
    /// Other such coordinates, for textures whose mapping has the space `uv-1`.
    #[serde(deserialize_with = "arrays", skip_serializing_if = "Vec::is_empty")]
    pub uvs_1: Vec<[f32; 2]>,
    /// At each vertex the direction of growing u for normal maps and long highlights, of any length, and 1 where v grows to the left of it, seen
    /// from above, or -1 where it grows to the right. As `uvs` grow if absent.
    #[serde(deserialize_with = "arrays", skip_serializing_if = "Vec::is_empty")]
    pub tangents: Vec<[f32; 4]>,
    /// A linear colour at each vertex, for the texture `vertex-color`.
    #[serde(deserialize_with = "arrays")]
    pub colors: Vec<[f32; 3]>,
    /// A share at each vertex, 0..1, for the texture `vertex-color` with `alpha`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub alphas: Vec<f32>,
    /// Name of a material; grey matte if absent.
    pub material: Option<String>,
    /// Where it is at some times; it rests if absent.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<MotionKey>,
    /// About what its `motion` turns it, and from where it grows, metres, where it is without motion; [0, 0, 0] if absent.
    #[serde(deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub pivot: Option<[f32; 3]>,
    /// Where its copies are, which share its memory; one where its vertices say if absent. Each is the three rows of a 3×4 matrix, of which
    /// the last column is a place, metres: [1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0] is five metres to the right. Copies neither move nor, if they
    /// shine, light others but by chance.
    #[serde(deserialize_with = "arrays", skip_serializing_if = "Vec::is_empty")]
    pub instances: Vec<[f32; 12]>,
    /// What is in the file, once a reader has loaded it.
    #[serde(skip)]
    pub data: Option<Arc<MeshData>>,
}

/// What a mesh file holds; as in [`MeshDesc`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Vertices, metres.
    pub vertices: Vec<[f32; 3]>,
    /// Three indices into `vertices` each.
    pub triangles: Vec<[u32; 3]>,
    /// A normal at each vertex, or none at all.
    pub normals: Vec<[f32; 3]>,
    /// Coordinates for textures at each vertex, or none at all.
    pub uvs: Vec<[f32; 2]>,
    /// Other such coordinates, or none at all.
    pub uvs_1: Vec<[f32; 2]>,
    /// At each vertex the direction of growing u, and the side on which v grows, or none at all.
    pub tangents: Vec<[f32; 4]>,
    /// A linear colour at each vertex, or none at all.
    pub colors: Vec<[f32; 3]>,
    /// A share at each vertex, 0..1, or none at all.
    pub alphas: Vec<f32>,
}

/// What textures ask of the vertices of a mesh.
#[derive(Clone, Debug)]
pub(crate) struct VertexData {
    triangles: Arc<[[u32; 3]]>,
    uvs: Arc<[[f32; 2]]>,
    uvs_1: Arc<[[f32; 2]]>,
    tangents: Arc<[[f32; 4]]>,
    colors: Arc<[[f32; 3]]>,
    alphas: Arc<[f32]>,
}

impl VertexData {
    /// The coordinates for textures at the point of a triangle where its second and third vertex have these weights.
    pub(crate) fn uv(&self, triangle: u32, weights: Vec2) -> Option<Vec2> {
        self.corners(&self.uvs, triangle).map(|corners| between(corners, weights).into())
    }

    /// The other ones, if there are any.
    pub(crate) fn uv_1(&self, triangle: u32, weights: Vec2) -> Option<Vec2> {
        self.corners(&self.uvs_1, triangle).map(|corners| between(corners, weights).into())
    }

    /// The colour there.
    pub(crate) fn color(&self, triangle: u32, weights: Vec2) -> Option<Rgb> {
        self.corners(&self.colors, triangle).map(|corners| Rgb(between(corners, weights)))
    }

    /// The share there.
    pub(crate) fn alpha(&self, triangle: u32, weights: Vec2) -> Option<f32> {
        let corners = self.corners(&self.alphas, triangle)?;
        let [alpha] = between(corners.map(|alpha| [alpha]), weights);
        Some(alpha)
    }

    /// How a point of a triangle with these first two edges moves with the coordinates; nothing is said where they are the same
    /// all over.
    pub(crate) fn tangents(&self, triangle: u32, edges: [Vec3; 2]) -> Option<[Vec3; 2]> {
        self.tangents_of(&self.uvs, triangle, edges)
    }

    /// The same of the other coordinates.
    pub(crate) fn tangents_1(&self, triangle: u32, edges: [Vec3; 2]) -> Option<[Vec3; 2]> {
        self.tangents_of(&self.uvs_1, triangle, edges)
    }

    fn tangents_of(&self, uvs: &[[f32; 2]], triangle: u32, edges: [Vec3; 2]) -> Option<[Vec3; 2]> {
        let [a, b, c] = self.corners(uvs, triangle)?.map(Vec2::from);
        let [first, second] = [b - a, c - a];
        let area = first.perp_dot(second);
        if area == 0.0 {
            return Some([Vec3::ZERO; 2]);
        }
        let [e1, e2] = edges;
        Some([(e1 * second.y - e2 * first.y) / area, (e2 * first.x - e1 * second.x) / area])
    }

    /// The directions of growing u and v for normal maps, as vertices say them; of v only the side counts. None if they do not.
    pub(crate) fn axes(&self, triangle: u32, weights: Vec2, [e1, e2]: [Vec3; 2]) -> Option<[Vec3; 2]> {
        let [x, y, z, side] = between(self.corners(&self.tangents, triangle)?, weights);
        let u = Vec3::new(x, y, z).try_normalize()?;
        Some([u, e1.cross(e2).cross(u) * 1.0_f32.copysign(side)])
    }

    /// Whether v grows to the right of growing u for normal maps, seen from where the triangle is counter-clockwise.
    pub(crate) fn is_mirrored(&self, triangle: u32) -> bool {
        if let Some(corners) = self.corners(&self.tangents, triangle) {
            return corners.map(|[.., side]| side).iter().sum::<f32>() < 0.0;
        }
        let Some([a, b, c]) = self.corners(&self.uvs, triangle) else { return false };
        let [a, b, c] = [a, b, c].map(Vec2::from);
        (b - a).perp_dot(c - a) < 0.0
    }

    /// At the corners of a triangle; none if vertices have no such numbers.
    fn corners<T: Copy>(&self, numbers: &[T], triangle: u32) -> Option<[T; 3]> {
        let &[a, b, c] = self.triangles.get(triangle as usize)?;
        let number = |i: u32| numbers.get(i as usize).copied();
        Some([number(a)?, number(b)?, number(c)?])
    }
}

/// At the point of a triangle where its second and third vertex have these weights.
fn between<const N: usize>([a, b, c]: [[f32; N]; 3], weights: Vec2) -> [f32; N] {
    array::from_fn(|i| a[i] * (1.0 - weights.x - weights.y) + b[i] * weights.x + c[i] * weights.y)
}

/// A mesh, wherever it comes from.
struct Mesh<'a> {
    vertices: &'a [[f32; 3]],
    triangles: &'a [[u32; 3]],
    normals: &'a [[f32; 3]],
    uvs: &'a [[f32; 2]],
    uvs_1: &'a [[f32; 2]],
    tangents: &'a [[f32; 4]],
    colors: &'a [[f32; 3]],
    alphas: &'a [f32],
}

impl MeshDesc {
    /// What the file says, once it is loaded; else what is said here.
    fn mesh(&self) -> Mesh<'_> {
        match self.data.as_deref() {
            Some(MeshData { vertices, triangles, normals, uvs, uvs_1, tangents, colors, alphas }) => {
                Mesh { vertices, triangles, normals, uvs, uvs_1, tangents, colors, alphas }
            }
            None => self.own(),
        }
    }

    /// What is said here.
    fn own(&self) -> Mesh<'_> {
        Mesh {
            vertices: &self.vertices,
            triangles: &self.triangles,
            normals: &self.normals,
            uvs: &self.uvs,
            uvs_1: &self.uvs_1,
            tangents: &self.tangents,
            colors: &self.colors,
            alphas: &self.alphas,
        }
    }

    /// The number of triangles, once the file is loaded.
    pub fn triangle_count(&self) -> usize {
        self.mesh().triangles.len()
    }

    /// Of its lists, once the file is loaded.
    pub fn bytes(&self) -> usize {
        let Mesh { vertices, triangles, normals, uvs, uvs_1, tangents, colors, alphas } = self.mesh();
        size_of_val(vertices)
            + size_of_val(triangles)
            + size_of_val(normals)
            + size_of_val(uvs)
            + size_of_val(uvs_1)
            + size_of_val(tangents)
            + size_of_val(colors)
            + size_of_val(alphas)
            + size_of_val(&*self.instances)
    }

    /// The vertices, once the file is loaded.
    pub fn vertices(&self) -> &[[f32; 3]] {
        self.mesh().vertices
    }

    /// The corners of its triangles, once the file is loaded.
    pub(crate) fn faces(&self) -> impl Iterator<Item = [Vec3; 3]> + Clone {
        self.mesh().corners()
    }

    /// From where the vertices are to where its copies are.
    pub fn copies(&self) -> impl Iterator<Item = Affine3A> {
        let affine = |rows: &[f32; 12]| {
            let column = |i: usize| Vec3::new(rows[i], rows[4 + i], rows[8 + i]);
            Affine3A {
                matrix3: Mat3A::from_cols(column(0).into(), column(1).into(), column(2).into()),
                translation: column(3).into(),
            }
        };
        self.instances.iter().map(affine)
    }

    fn check_instances(&self, c: &mut Checker) {
        check_each(c, "instances", &self.instances, is_finite, ["copy", "is"], FINITE);
        if !self.instances.is_empty() && !self.motion.is_empty() {
            let hint = "move one mesh, or give its copies as meshes of their own".to_owned();
            c.problem("motion", "a mesh with `instances` cannot move", Some(hint));
        }
    }

    /// The number of triangles without area, which are never hit.
    pub(crate) fn degenerate_count(&self) -> usize {
        let mesh = self.mesh();
        let has_area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a) != DVec3::ZERO;
        mesh.corners().filter(|corners| !has_area(corners.map(|c| c.as_dvec3()))).count()
    }
}

impl<'a> Mesh<'a> {
    /// The corners of each triangle. The check has found that every vertex exists.
    fn corners(&self) -> impl Iterator<Item = [Vec3; 3]> + Clone + use<'a> {
        let vertices = self.vertices;
        let vertex = |i: u32| vertices.get(i as usize).map(|&v| Vec3::from(v));
        self.triangles.iter().filter_map(move |&[a, b, c]| Some([vertex(a)?, vertex(b)?, vertex(c)?]))
    }

    /// The lists that have something for each vertex, by their keys, with their lengths.
    fn of_vertices(&self) -> [(&'static str, usize); 6] {
        [
            ("normals", self.normals.len()),
            ("uvs", self.uvs.len()),
            ("uvs_1", self.uvs_1.len()),
            ("tangents", self.tangents.len()),
            ("colors", self.colors.len()),
            ("alphas", self.alphas.len()),
        ]
    }

    fn check(&self, c: &mut Checker) {
        let count = self.vertices.len();
        check_each(c, "vertices", self.vertices, is_finite, ["vertex", "is"], "numbers up to 1e15 in size are allowed");
        for (key, given) in self.of_vertices() {
            if given != 0 && given != count {
                let message = format!("there are {given} {key} for {count} vertices");
                c.problem(key, message, Some("give one for each vertex, or none".to_owned()));
            }
        }
        for (key, uvs) in [("uvs", self.uvs), ("uvs_1", self.uvs_1)] {
            check_each(c, key, uvs, is_finite, ["coordinates", "are"], FINITE);
        }
        check_each(c, "tangents", self.tangents, is_finite, ["tangent", "is"], FINITE);
        let is_color = |color: &[f32; 3]| is_finite(color) && color.iter().all(|&c| c >= 0.0);
        check_each(c, "colors", self.colors, is_color, ["color", "is"], "use finite numbers that are not negative");
        let is_share = |alpha: &f32| (0.0..=1.0).contains(alpha);
        check_each(c, "alphas", self.alphas, is_share, ["alpha", "is"], "use numbers from 0 to 1");
        check_each(c, "normals", self.normals, is_finite, ["normal", "is"], FINITE);
        c.within("triangles", |c| {
            for (i, triangle) in self.triangles.iter().enumerate() {
                if let Some(missing) = triangle.iter().find(|&&v| v as usize >= count) {
                    let hint = format!("the mesh has {count} vertices, counted from 0");
                    c.problem(i, format!("triangle {i} names vertex {missing}, which does not exist"), Some(hint));
                }
            }
        });
    }
}

const FINITE: &str = "use finite numbers";

fn is_finite<const N: usize>(numbers: &[f32; N]) -> bool {
    numbers.iter().copied().all(Checker::is_finite)
}

/// Notes each item of a list that is not right; the words stand before and behind its number.
fn check_each<T: Debug>(
    c: &mut Checker,
    key: &'static str,
    list: &[T],
    is_right: impl Fn(&T) -> bool,
    [what, is]: [&str; 2],
    hint: &str,
) {
    c.within(key, |c| {
        for (i, item) in list.iter().enumerate().filter(|(_, item)| !is_right(item)) {
            c.problem(i, format!("{what} {i} {is} {item:?}"), Some(hint.to_owned()));
        }
    });
}

impl ShapeDesc for MeshDesc {
    fn check(&self, c: &mut Checker) {
        let own = self.own();
        let lists = [("vertices", own.vertices.len()), ("triangles", own.triangles.len())];
        let list = lists.into_iter().chain(own.of_vertices()).find(|&(_, length)| length > 0).map(|(name, _)| name);
        match (&self.file, list) {
            (None, None) if self.data.is_none() => {
                let hint = "give the mesh `vertices` and `triangles`, or a `file`".to_owned();
                c.problem("file", "there are neither `vertices` nor a `file`", Some(hint));
            }
            (Some(_), Some(name)) => {
                let hint = "keep one of them".to_owned();
                c.problem(name, format!("`file` and `{name}` both say what the mesh is"), Some(hint));
            }
            (Some(file), None) if self.data.is_none() => c.not_loaded(file),
            _ if self.data.is_some() => c.within("file", |c| self.mesh().check(c)),
            _ => self.mesh().check(c),
        }
        self.check_instances(c);
    }

    fn push_primitives(&self, primitives: &mut Vec<Primitive>) {
        let triangles = self.mesh().corners().map(|[a, b, c]| Triangle { a, b, c });
        primitives.extend(triangles.map(Primitive::Triangle));
    }

    fn material(&self) -> Option<&str> {
        self.material.as_deref()
    }

    fn motion(&self) -> MotionDesc<'_> {
        MotionDesc { keys: &self.motion, pivot: self.pivot }
    }

    fn copies(&self) -> Vec<Affine3A> {
        self.copies().collect()
    }

    fn smooth(&self) -> Option<Smooth> {
        let mesh = self.mesh();
        (!mesh.normals.is_empty()).then(|| Smooth::new(mesh.triangles.to_vec(), mesh.normals))
    }

    fn vertex_data(&self) -> Option<VertexData> {
        let mesh = self.mesh();
        let Mesh { triangles, uvs, uvs_1, tangents, colors, alphas, .. } = mesh;
        let data = || VertexData {
            triangles: triangles.into(),
            uvs: uvs.into(),
            uvs_1: uvs_1.into(),
            tangents: tangents.into(),
            colors: colors.into(),
            alphas: alphas.into(),
        };
        let has_any = mesh.of_vertices().iter().any(|&(key, length)| key != "normals" && length > 0);
        has_any.then(data)
    }
}
