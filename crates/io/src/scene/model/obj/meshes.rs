//! The meshes of a file: one for each material, and apart those with normals and those without.
//!
//! Where corners share position, coordinates and normal they share a vertex. Normals of smoothing groups are means of those of their
//! triangles, weighted by the angles at the corner: Thürmer & Wüthrich 1998, "Computing Vertex Normals from Polygonal Facets",
//! doi:10.1080/10867651.1998.10487487.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};

use eyebeam_core::color::srgb_decode;
use eyebeam_core::shape::MeshData;
use glam::{DVec3, Vec3};

use crate::error::FileError;

/// Of vertices that have no colour, where others have.
pub(super) const WHITE: [f32; 3] = [1.0; 3];
/// Stands for that where colours are signals that no one knows yet up to what they count.
const NO_COLOR: [f32; 3] = [f32::INFINITY; 3];

/// What faces refer to.
#[derive(Debug, Default)]
pub(super) struct Points {
    pub(super) positions: Vec<[f32; 3]>,
    /// Signals; as many as positions, or fewer if the last have none.
    colors: Vec<[f32; 3]>,
    /// The largest of these.
    brightest: f32,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) normals: Vec<[f32; 3]>,
}

/// A corner of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) uv: Option<u32>,
    pub(super) normal: Normal,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Normal {
    /// That of the triangle.
    None,
    /// The file has it.
    Given(u32),
    /// That of a smoothing group at a position.
    Made(u32),
}

/// Which mesh: the number of a material, and whether it has normals.
pub(super) type Key = (u32, bool);

#[derive(Debug, Default)]
pub(super) struct Meshes {
    meshes: BTreeMap<Key, Mesh>,
    /// Numbers of normals by position and group.
    made: HashMap<(u32, u32), u32>,
    sums: Vec<DVec3>,
    /// Of all meshes.
    vertices: usize,
    triangles: usize,
}

#[derive(Debug, Default)]
struct Mesh {
    data: MeshData,
    vertices: HashMap<Corner, u32>,
    normals: Vec<Normal>,
    has_uvs: bool,
}

impl Meshes {
    /// That all take, about.
    pub(super) fn bytes(&self) -> u64 {
        // A vertex is in lists and in a table that may be half empty.
        const VERTEX: usize = 120;
        (VERTEX * self.vertices + 12 * self.triangles + 48 * self.sums.len()) as u64
    }

    /// The normal of a smoothing group at a position.
    pub(super) fn made(&mut self, position: u32, group: u32) -> Result<Normal, FileError> {
        let count = u32::try_from(self.sums.len()).map_err(|_| FileError::new("there are too many normals"))?;
        let number = *self.made.entry((position, group)).or_insert_with(|| {
            self.sums.push(DVec3::ZERO);
            count
        });
        Ok(Normal::Made(number))
    }

    /// Appends a triangle.
    pub(super) fn push(&mut self, key: Key, corners: [Corner; 3], points: &Points) -> Result<(), FileError> {
        let position = |c: Corner| points.positions.get(c.position as usize).copied().unwrap_or_default();
        let [a, b, c] = corners.map(|c| Vec3::from(position(c)).as_dvec3());
        for (corner, [here, next, last]) in corners.into_iter().zip([[a, b, c], [b, c, a], [c, a, b]]) {
            let Normal::Made(number) = corner.normal else { continue };
            let cross = (next - here).cross(last - here);
            let angle = libm::atan2(cross.length(), (next - here).dot(last - here));
            if let (Some(normal), Some(sum)) = (cross.try_normalize(), self.sums.get_mut(number as usize)) {
                *sum += normal * angle;
            }
        }
        let mesh = self.meshes.entry(key).or_default();
        let before = mesh.data.vertices.len();
        let mut triangle = [0; 3];
        for (vertex, corner) in triangle.iter_mut().zip(corners) {
            *vertex = mesh.vertex(corner, points)?;
        }
        self.vertices += mesh.data.vertices.len() - before;
        self.triangles += 1;
        mesh.data.triangles.push(triangle);
        Ok(())
    }

    /// All meshes.
    pub(super) fn finish(self, points: &Points) -> impl Iterator<Item = (Key, MeshData)> {
        let Self { meshes, sums, .. } = self;
        meshes.into_iter().map(move |(key, Mesh { mut data, normals, has_uvs, .. })| {
            let normal = |normal: Normal| match normal {
                Normal::None => [0.0; 3],
                Normal::Given(i) => points.normals.get(i as usize).copied().unwrap_or_default(),
                Normal::Made(i) => {
                    let sum = sums.get(i as usize).copied().unwrap_or_default();
                    sum.try_normalize().unwrap_or_default().as_vec3().into()
                }
            };
            if key.1 {
                data.normals = normals.into_iter().map(normal).collect();
            }
            if !has_uvs {
                data.uvs = Vec::new();
            }
            if !data.colors.is_empty() {
                data.colors.resize(data.vertices.len(), NO_COLOR);
            }
            data.colors.iter_mut().for_each(|color| *color = points.light(*color));
            (key, data)
        })
    }
}

impl Mesh {
    fn vertex(&mut self, corner: Corner, points: &Points) -> Result<u32, FileError> {
        let Entry::Vacant(entry) = self.vertices.entry(corner) else {
            return Ok(self.vertices.get(&corner).copied().unwrap_or_default());
        };
        let data = &mut self.data;
        let count = data.vertices.len();
        let number = u32::try_from(count).map_err(|_| FileError::new("there are too many vertices"))?;
        let position = corner.position as usize;
        data.vertices.push(points.positions.get(position).copied().unwrap_or_default());
        if let Some(&color) = points.colors.get(position) {
            data.colors.resize(count, NO_COLOR);
            data.colors.push(color);
        }
        let uv = corner.uv.and_then(|uv| points.uvs.get(uv as usize).copied());
        self.has_uvs |= uv.is_some();
        data.uvs.push(uv.unwrap_or_default());
        self.normals.push(corner.normal);
        Ok(*entry.insert(number))
    }
}

impl Points {
    /// That all take.
    pub(super) fn bytes(&self) -> u64 {
        let Self { positions, colors, uvs, normals, .. } = self;
        (size_of_val(&**positions) + size_of_val(&**colors) + size_of_val(&**uvs) + size_of_val(&**normals)) as u64
    }

    /// Gives the last position a colour.
    pub(super) fn color(&mut self, color: [f32; 3]) {
        self.colors.resize(self.positions.len().saturating_sub(1), NO_COLOR);
        self.colors.push(color);
        self.brightest = color.into_iter().fold(self.brightest, f32::max);
    }

    /// Up to what colours count: bytes and words of other programs are larger than signals that were rounded.
    pub(super) fn white(&self) -> f32 {
        match self.brightest {
            ..=2.0 => 1.0,
            ..=255.0 => 255.0,
            _ => 65535.0,
        }
    }

    /// The light that a colour stands for.
    fn light(&self, color: [f32; 3]) -> [f32; 3] {
        if color == NO_COLOR {
            return WHITE;
        }
        color.map(|signal| srgb_decode((signal / self.white()).clamp(0.0, 1.0)))
    }
}
