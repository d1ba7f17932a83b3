//! A mesh as binary PLY, with all that its vertices have.

use eyebeam_core::shape::MeshData;

/// The bytes of a file that reads back bit for bit.
pub fn encode_ply(mesh: &MeshData) -> Vec<u8> {
    let MeshData { vertices, triangles, normals, uvs, colors } = mesh;
    let has = |count: usize| count == vertices.len() && count > 0;
    let (has_normals, has_uvs, has_colors) = (has(normals.len()), has(uvs.len()), has(colors.len()));
    let lists: [(bool, &[&str]); 4] = [
        (true, &["x", "y", "z"]),
        (has_normals, &["nx", "ny", "nz"]),
        (has_uvs, &["u", "v"]),
        // Numbers that are not whole are linear light.
        (has_colors, &["red", "green", "blue"]),
    ];
    let names = lists.iter().filter(|(is_there, _)| *is_there).flat_map(|(_, names)| *names);
    let mut header = format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices.len());
    names.for_each(|name| header += &format!("property float {name}\n"));
    header += &format!("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", triangles.len());
    let mut bytes = header.into_bytes();
    let floats = |bytes: &mut Vec<u8>, numbers: Option<&[f32]>| {
        numbers.into_iter().flatten().for_each(|number| bytes.extend(number.to_le_bytes()));
    };
    for (i, vertex) in vertices.iter().enumerate() {
        floats(&mut bytes, Some(vertex));
        floats(&mut bytes, normals.get(i).filter(|_| has_normals).map(<[f32; 3]>::as_slice));
        floats(&mut bytes, uvs.get(i).filter(|_| has_uvs).map(<[f32; 2]>::as_slice));
        floats(&mut bytes, colors.get(i).filter(|_| has_colors).map(<[f32; 3]>::as_slice));
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
            colors: vec![[0.1, 0.2, 7.5]; 3],
            ..plain.clone()
        };
        for mesh in [plain, full, MeshData::default()] {
            let read: MeshData = read_ply_bytes("a.ply", &encode_ply(&mesh)).unwrap().into();
            assert_eq!(read, mesh);
        }
    }
}
