//! A mesh as binary PLY, with all that its vertices have.

use eyebeam_core::shape::MeshData;

/// The bytes of a file that reads back bit for bit.
pub fn encode_ply(mesh: &MeshData) -> Vec<u8> {
    let MeshData { vertices, triangles, .. } = mesh;
    // Numbers that are not whole are linear light.
    let lists: [(&[&str], &[f32]); 7] = [
        (&["x", "y", "z"], vertices.as_flattened()),
        (&["nx", "ny", "nz"], mesh.normals.as_flattened()),
        (&["u", "v"], mesh.uvs.as_flattened()),
        (&["u1", "v1"], mesh.uvs_1.as_flattened()),
        (&["tx", "ty", "tz", "tw"], mesh.tangents.as_flattened()),
        (&["red", "green", "blue"], mesh.colors.as_flattened()),
        (&["alpha"], &mesh.alphas),
    ];
    let is_whole = |(names, numbers): &(&[&str], &[f32])| numbers.len() == names.len() * vertices.len();
    let lists: Vec<_> = lists.into_iter().filter(|list| !list.1.is_empty() && is_whole(list)).collect();
    let mut header = format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices.len());
    let names: &[&str] = if lists.is_empty() { &["x", "y", "z"] } else { &[] };
    for name in lists.iter().flat_map(|(names, _)| *names).chain(names) {
        header += &format!("property float {name}\n");
    }
    header += &format!("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", triangles.len());
    let mut bytes = header.into_bytes();
    for i in 0..vertices.len() {
        for (names, numbers) in &lists {
            let of_vertex = numbers.iter().skip(i * names.len()).take(names.len());
            of_vertex.for_each(|number| bytes.extend(number.to_le_bytes()));
        }
    }
    for triangle in triangles {
        bytes.push(3);
        triangle.iter().for_each(|index| bytes.extend(index.to_le_bytes()));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::ply::read_ply_bytes;

    #[test]
    fn meshes_read_back() {
        let vertices = vec![[0.1, -2.0, 1e-30], [1e30, 0.0, 0.3], [5.0, 6.0, 7.0]];
        let plain = MeshData { vertices, triangles: vec![[0, 1, 2], [2, 2, 0]], ..MeshData::default() };
        let full = MeshData {
            normals: vec![[0.0, 1.0, 0.3]; 3],
            uvs: vec![[0.7, -3.0]; 3],
            uvs_1: vec![[0.2, 1.5]; 3],
            tangents: vec![[1.0, 0.0, 0.1, -1.0]; 3],
            colors: vec![[0.1, 0.2, 7.5]; 3],
            alphas: vec![0.0, 0.25, 1.0],
            ..plain.clone()
        };
        for mesh in [plain, full, MeshData::default()] {
            let read = read_ply_bytes("a.ply", &encode_ply(&mesh)).unwrap();
            assert_eq!(read, (mesh, vec![]));
        }
    }
}
