//! Tangents of a mesh that says none, as programs that make normal maps compute them.
//!
//! Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited" (MikkTSpace), which glTF 2.0 asks for (§3.7.2.1). Vertices where triangles of
//! several directions meet become several.

use std::collections::BTreeMap;

use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use eyebeam_core::shape::MeshData;
use eyebeam_core::texture::{Mapping, Space};
use glam::Vec3;

/// Gives a mesh tangents, for a texture that lies so. One without normals or coordinates gets none.
pub(super) fn make(mesh: &mut MeshData, mapping: &Mapping) {
    let uvs = if mapping.space == Some(Space::Uv1) { &mesh.uvs_1 } else { &mesh.uvs };
    if uvs.is_empty() || mesh.normals.is_empty() || mesh.vertices.iter().flatten().any(|c| !c.is_finite()) {
        return;
    }
    let place = |&[u, v]: &[f32; 2]| mapping.lay(Vec3::new(u, v, 0.0)).truncate().into();
    let uvs = uvs.iter().map(place).collect();
    let mut corners = Corners { mesh, uvs, tangents: vec![[NOWHERE; 3]; mesh.triangles.len()] };
    let Ok(()) = generate_tangents(&mut corners) else { return };
    let tangents = corners.tangents;
    split(mesh, &tangents);
}

/// Of what has no direction.
const NOWHERE: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

/// The corners of triangles.
struct Corners<'a> {
    mesh: &'a MeshData,
    uvs: Vec<[f32; 2]>,
    tangents: Vec<[[f32; 4]; 3]>,
}

impl Corners<'_> {
    fn of<const N: usize>(&self, numbers: &[[f32; N]], face: usize, corner: usize) -> [f32; N] {
        let vertex = self.mesh.triangles.get(face).and_then(|triangle| triangle.get(corner));
        vertex.and_then(|&vertex| numbers.get(vertex as usize)).copied().unwrap_or([0.0; N])
    }
}

/// The same bits on all machines.
struct Exact;

impl Ops for Exact {
    fn sqrt(x: f32) -> f32 {
        libm::sqrtf(x)
    }

    fn acos(x: f32) -> f32 {
        libm::acos(x.into()) as f32
    }
}

impl Geometry<Exact> for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.of(&self.mesh.vertices, face, corner)
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.of(&self.mesh.normals, face, corner)
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.of(&self.uvs, face, corner)
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let tangent = space.map(|space| space.tangent_encoded()).filter(|t| t.iter().all(|c| c.is_finite()));
        if let Some(slot) = self.tangents.get_mut(face).and_then(|corners| corners.get_mut(corner)) {
            *slot = tangent.unwrap_or(NOWHERE);
        }
    }
}

/// Gives vertices the tangents of triangles' corners; a vertex of several becomes several.
fn split(mesh: &mut MeshData, tangents: &[[[f32; 4]; 3]]) {
    let mut given: Vec<Option<[f32; 4]>> = vec![None; mesh.vertices.len()];
    let mut more = BTreeMap::new();
    for (triangle, corners) in mesh.triangles.iter_mut().zip(tangents) {
        for (vertex, &tangent) in triangle.iter_mut().zip(corners) {
            let first = given.get(*vertex as usize).copied().flatten().unwrap_or(tangent);
            if first == tangent {
                given[*vertex as usize] = Some(tangent);
                continue;
            }
            let key = (*vertex, tangent.map(f32::to_bits));
            let Ok(next) = u32::try_from(given.len()) else { continue };
            let copy = *more.entry(key).or_insert(next);
            if copy == next {
                copy_last(&mut mesh.vertices, *vertex);
                copy_last(&mut mesh.normals, *vertex);
                copy_last(&mut mesh.uvs, *vertex);
                copy_last(&mut mesh.uvs_1, *vertex);
                copy_last(&mut mesh.colors, *vertex);
                copy_last(&mut mesh.alphas, *vertex);
                given.push(Some(tangent));
            }
            *vertex = copy;
        }
    }
    mesh.tangents = given.into_iter().map(|tangent| tangent.unwrap_or(NOWHERE)).collect();
}

/// Appends a copy of what a vertex has; nothing if none has it.
fn copy_last<T: Copy>(numbers: &mut Vec<T>, vertex: u32) {
    numbers.extend(numbers.get(vertex as usize).copied());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles side by side, the second with coordinates that are mirrored: u grows to the right, then to the left.
    fn mirrored() -> MeshData {
        MeshData {
            vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            normals: vec![[0.0, 0.0, 1.0]; 4],
            uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]],
            alphas: vec![1.0, 0.5, 0.25, 0.0],
            ..MeshData::default()
        }
    }

    #[test]
    fn mirrored_coordinates_split_vertices() {
        let mut mesh = mirrored();
        make(&mut mesh, &Mapping::default());
        assert_eq!((mesh.vertices.len(), mesh.alphas.len(), mesh.uvs_1.len()), (6, 6, 0));
        let sides = |triangle: usize| mesh.triangles[triangle].map(|i| mesh.tangents[i as usize]);
        assert_eq!(sides(0), [[1.0, 0.0, 0.0, 1.0]; 3]);
        assert_eq!(sides(1), [[-1.0, 0.0, 0.0, -1.0]; 3]);
        // Those that were split are where they were.
        let places = |triangle: usize| mesh.triangles[triangle].map(|i| mesh.vertices[i as usize]);
        assert_eq!(places(1), [[0.0; 3], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
        assert_eq!(mesh.triangles[1].map(|i| mesh.alphas[i as usize]), [1.0, 0.25, 0.0]);
    }

    /// A texture that is turned has its normals turned too.
    #[test]
    fn tangents_follow_the_mapping() {
        let mut mesh = mirrored();
        mesh.triangles.truncate(1);
        make(&mut mesh, &Mapping { rotation: -90.0, ..Mapping::default() });
        let [x, y, z, side] = mesh.tangents[0];
        assert!(x.abs() < 1e-6 && y > 0.999 && z == 0.0 && side == 1.0, "{:?}", mesh.tangents[0]);
        assert_eq!(mesh.tangents[3], NOWHERE, "no triangle has it");
        let mut second = MeshData { uvs_1: vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, 0.0]], ..mirrored() };
        make(&mut second, &Mapping { space: Some(Space::Uv1), ..Mapping::default() });
        assert_eq!(second.tangents[1], [0.0, 1.0, 0.0, -1.0]);
    }

    #[test]
    fn nothing_is_made_of_nothing() {
        for mesh in [MeshData { normals: vec![], ..mirrored() }, MeshData { uvs: vec![], ..mirrored() }] {
            let mut copy = mesh.clone();
            make(&mut copy, &Mapping::default());
            assert_eq!(copy, mesh);
        }
        // Triangles without area, in space or as the texture lies, have the direction of a neighbour or none.
        let mut flat = mirrored();
        flat.triangles.push([1, 1, 2]);
        flat.uvs[3] = [0.0, 0.5];
        make(&mut flat, &Mapping::default());
        assert!(flat.tangents.iter().flatten().all(|c| c.is_finite()) && flat.tangents.len() == flat.vertices.len());
    }
}
