//! Whether a mesh has an inside.

use eyebeam_core::math::mix;
use eyebeam_core::shape::MeshData;

/// Whether each edge is there as often in one direction as in the other, so that nothing is seen from behind but from within: the sum over
/// all edges of a number for each place where it begins and ends, which the other direction takes away.
pub(super) fn is_closed(mesh: &MeshData) -> bool {
    let place = |index: u32| -> Option<u64> {
        let vertex = mesh.vertices.get(index as usize)?;
        // −0 is 0.
        Some(vertex.iter().fold(0, |hash, &c| mix(hash ^ u64::from((c + 0.0).to_bits()))))
    };
    let edge = |a: u64, b: u64| {
        if a < b { mix(a ^ b.rotate_left(1)) } else { mix(b ^ a.rotate_left(1)).wrapping_neg() }
    };
    let around = |&[a, b, c]: &[u32; 3]| -> Option<u64> {
        let [a, b, c] = [place(a)?, place(b)?, place(c)?];
        let edges = [(a, b), (b, c), (c, a)].into_iter().filter(|(a, b)| a != b);
        Some(edges.fold(0, |sum: u64, (a, b)| sum.wrapping_add(edge(a, b))))
    };
    mesh.triangles.iter().filter_map(around).fold(0, u64::wrapping_add) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_is_closed_and_without_a_side_it_is_not() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, -0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        // The last vertex is the first one again, as where textures have a seam.
        let vertices = [&corners[..], &[[-0.0, 0.0, 0.0]]].concat();
        let triangles = vec![[0, 2, 1], [0, 1, 3], [4, 3, 2], [1, 2, 3]];
        let mut mesh = MeshData { vertices, triangles, ..MeshData::default() };
        assert!(is_closed(&mesh));
        mesh.triangles[1] = [0, 3, 1];
        assert!(!is_closed(&mesh), "one is the wrong way round");
        mesh.triangles.pop();
        assert!(!is_closed(&mesh));
    }
}
