//! What textures know of the point that a ray meets.

use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::material::{Lambertian, MaterialDesc};
use eyebeam_core::names::Name;
use eyebeam_core::scene::{Ray, Scene};
use eyebeam_core::shape::{MeshDesc, QuadDesc, SphereDesc};
use eyebeam_core::texture::{Color, Gradient, Mapping, Space, TextureDesc, VertexColor};
use glam::Vec3;

/// A scene whose shapes have this texture.
fn scene(texture: TextureDesc, fill: impl FnOnce(&mut SceneDesc)) -> Scene {
    let mut desc = SceneDesc::default();
    desc.texture.insert("t".to_owned(), texture);
    let albedo = Color::Texture(Name::new("t"));
    desc.material.insert(SceneDesc::DEFAULT_MATERIAL.to_owned(), MaterialDesc::Lambertian(Lambertian { albedo }));
    fill(&mut desc);
    Scene::build(&desc).unwrap()
}

/// The albedo of what is seen from straight above.
fn albedo(scene: &Scene, x: f32, z: f32) -> [f32; 3] {
    let hit = scene.intersect(&Ray::new(Vec3::new(x, 10.0, z), Vec3::NEG_Y)).unwrap();
    hit.bsdf().albedo().to_rgb()
}

fn is_near(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4)
}

#[test]
fn colours_of_vertices_are_interpolated() {
    let texture = VertexColor { otherwise: Rgb([0.1, 0.2, 0.3]), alpha: false };
    let scene = scene(TextureDesc::VertexColor(texture), |desc| {
        let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 0.0, 1.0]];
        let colors = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let all = MeshDesc { triangles: vec![[0, 1, 2]], ..MeshDesc::default() };
        desc.shape.mesh.push(MeshDesc { vertices: vertices[..3].to_vec(), colors, ..all.clone() });
        // Without colours.
        desc.shape.mesh.push(MeshDesc { vertices: vertices[3..].to_vec(), ..all });
    });
    for (x, z) in [(0.01, 0.01), (0.2, 0.3), (0.5, 0.25)] {
        let found = albedo(&scene, x, z);
        assert!(is_near(found, [1.0 - x - z, x, z]), "{found:?}");
    }
    assert_eq!(albedo(&scene, 5.2, 0.2), [0.1, 0.2, 0.3]);
}

/// Shares of vertices are a grey of their own.
#[test]
fn alphas_of_vertices_are_interpolated() {
    let texture = VertexColor { otherwise: Rgb([0.1, 0.2, 0.3]), alpha: true };
    let scene = scene(TextureDesc::VertexColor(texture), |desc| {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let colors = vec![[1.0; 3]; 3];
        let all = MeshDesc { vertices, colors, triangles: vec![[0, 1, 2]], ..MeshDesc::default() };
        desc.shape.mesh.push(MeshDesc { alphas: vec![0.0, 0.5, 1.0], ..all.clone() });
        let vertices = all.vertices.iter().map(|[x, y, z]| [x + 5.0, *y, *z]).collect();
        desc.shape.mesh.push(MeshDesc { vertices, ..all });
    });
    assert!(is_near(albedo(&scene, 0.2, 0.3), [0.4; 3]));
    assert_eq!(albedo(&scene, 5.2, 0.3), [0.1, 0.2, 0.3]);
}

/// A texture lies as the first or the second coordinates of a mesh say; as the first where there are no others.
#[test]
fn a_mesh_has_two_sets_of_coordinates() {
    let along = |space| {
        let mapping = Mapping { space: Some(space), ..Mapping::default() };
        TextureDesc::Gradient(Gradient { mapping, ..Gradient::default() })
    };
    let tile = |desc: &mut SceneDesc| {
        let first = MeshDesc {
            vertices: vec![[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            uvs: vec![[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]],
            ..MeshDesc::default()
        };
        let away = |[x, y, z]: [f32; 3]| [x + 5.0, y, z];
        let uvs_1 = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]];
        let both = MeshDesc { uvs_1, vertices: first.vertices.iter().copied().map(away).collect(), ..first.clone() };
        desc.shape.mesh = vec![first, both];
    };
    let [first, second] = [Space::Uv, Space::Uv1].map(|space| scene(along(space), tile));
    for (x, z) in [(0.1, 0.2), (0.5, 0.25)] {
        assert!(is_near(albedo(&first, x, z), [x; 3]) && is_near(albedo(&first, 5.0 + x, z), [x; 3]));
        assert!(is_near(albedo(&second, x, z), [x; 3]) && is_near(albedo(&second, 5.0 + x, z), [z; 3]));
    }
}

/// In the space of their objects, textures move with the shapes.
#[test]
fn a_texture_on_an_object_moves_with_it() {
    let along = |space| {
        let mapping = Mapping { space: Some(space), ..Mapping::default() };
        TextureDesc::Gradient(Gradient { mapping, ..Gradient::default() })
    };
    for at in [0.0, 3.0] {
        let fill = |desc: &mut SceneDesc| {
            let corner = [at, 0.0, 1.0];
            let quad = QuadDesc { corner, u: [2.0, 0.0, 0.0], v: [0.0, 0.0, -2.0], ..QuadDesc::default() };
            desc.shape.quad.push(quad);
            desc.shape.sphere.push(SphereDesc { center: [at + 10.0, 0.0, 0.0], radius: 1.0, ..SphereDesc::default() });
        };
        let (object, world) = (scene(along(Space::Object), fill), scene(along(Space::World), fill));
        for x in [0.25, 0.75] {
            // From the corner of the quad, and from the middle of the ball.
            assert!(is_near(albedo(&object, at + x, 0.5), [x; 3]));
            assert!(is_near(albedo(&object, at + 10.0 + x, 0.0), [x; 3]));
            assert!(is_near(albedo(&world, at + x, 0.5), [f32::min(at + x, 1.0); 3]));
        }
    }
}

#[test]
fn one_colour_for_each_vertex() {
    let mesh = |colors| {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let mut desc = SceneDesc::default();
        desc.shape.mesh.push(MeshDesc { vertices, triangles: vec![[0, 1, 2]], colors, ..MeshDesc::default() });
        desc.check().into_iter().map(|p| p.message).collect::<Vec<_>>()
    };
    assert_eq!(mesh(vec![[0.5; 3]; 3]), [""; 0]);
    assert_eq!(mesh(vec![[0.5; 3]; 2]), ["there are 2 colors for 3 vertices"]);
    assert_eq!(mesh(vec![[0.5; 3], [f32::NAN; 3], [-1.0; 3]]).len(), 2);
}
