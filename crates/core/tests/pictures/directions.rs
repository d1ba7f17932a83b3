//! What follows the directions on a surface in which coordinates grow: normals of textures, and coats with normals of their own.

use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::interaction::SurfaceInteraction;
use eyebeam_core::material::{MaterialDesc, NormalMap, Principled};
use eyebeam_core::math::reflect_at;
use eyebeam_core::names::Name;
use eyebeam_core::scene::{Ray, Scene};
use eyebeam_core::shape::MeshDesc;
use glam::Vec3;

/// A triangle on the ground, seen from above, whose u grows along x and v to the back.
fn tile() -> MeshDesc {
    MeshDesc {
        vertices: vec![[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [-1.0, 0.0, -1.0]],
        triangles: vec![[0, 1, 2]],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        ..MeshDesc::default()
    }
}

/// With normals that lean by the tangent (x, y).
fn leaning(of: Principled, [x, y]: [f32; 2], mesh: MeshDesc) -> Scene {
    let mut desc = SceneDesc::default();
    let n = 0.5 * Vec3::new(x, y, 1.0).normalize() + 0.5;
    let map = NormalMap { of: Name::new("inner"), map: Rgb(n.into()).into(), strength: 1.0 };
    desc.material.insert("inner".to_owned(), MaterialDesc::Principled(Box::new(of)));
    desc.material.insert(SceneDesc::DEFAULT_MATERIAL.to_owned(), MaterialDesc::NormalMap(map));
    desc.shape.mesh.push(mesh);
    Scene::build(&desc).unwrap()
}

fn hit(scene: &Scene, x: f32) -> SurfaceInteraction<'_> {
    scene.intersect(&Ray::new(Vec3::new(x, 5.0, 0.3), Vec3::NEG_Y)).unwrap()
}

/// Where the normal leans.
fn lean(by: [f32; 2], mesh: MeshDesc, x: f32) -> [f32; 2] {
    let ns = hit(&leaning(Principled::default(), by, mesh), x).point().ns;
    [ns.x / ns.y, ns.z / ns.y]
}

fn is_near(a: [f32; 2], b: [f32; 2]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4)
}

#[test]
fn normals_lean_as_tangents_say() {
    let said = |tangent: [f32; 4]| MeshDesc { tangents: vec![tangent; 3], ..tile() };
    for (mesh, along_u, along_v) in [
        (tile(), [0.1, 0.0], [0.0, -0.1]),
        (said([0.0, 0.0, 3.0, 1.0]), [0.0, 0.1], [0.1, 0.0]),
        (said([0.0, 0.0, 3.0, -1.0]), [0.0, 0.1], [-0.1, 0.0]),
        (said([0.0; 4]), [0.1, 0.0], [0.0, -0.1]),
    ] {
        assert!(is_near(lean([0.1, 0.0], mesh.clone(), -0.5), along_u));
        assert!(is_near(lean([0.0, 0.1], mesh.clone(), -0.5), along_v));
        // A copy that is mirrored in x leans the other way.
        let mirror = [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let copy = MeshDesc { instances: vec![mirror], ..mesh };
        assert!(is_near(lean([0.1, 0.0], copy.clone(), 0.5), [-along_u[0], along_u[1]]));
        assert!(is_near(lean([0.0, 0.1], copy, 0.5), [-along_v[0], along_v[1]]));
    }
}

/// Tangents are interpolated; one for each vertex, and finite.
#[test]
fn tangents_are_checked() {
    let problems = |tangents| {
        let desc = SceneDesc {
            shape: eyebeam_core::shape::ShapesDesc {
                mesh: vec![MeshDesc { tangents, ..tile() }],
                ..Default::default()
            },
            ..SceneDesc::default()
        };
        desc.check().into_iter().map(|p| p.message).collect::<Vec<_>>()
    };
    assert_eq!(problems(vec![[0.0; 4]; 2]), ["there are 2 tangents for 3 vertices"]);
    assert_eq!(problems(vec![[f32::NAN; 4], [0.0; 4], [0.0; 4]]).len(), 1);
    let turning = vec![[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [0.0, 0.0, -1.0, 1.0]];
    let [x, z] = lean([0.1, 0.0], MeshDesc { tangents: turning, ..tile() }, -0.9);
    assert!(x > 0.01 && z < -0.01, "{x} {z}");
}

/// A coat shines as its own normals say, over the shape and not over what is below.
#[test]
fn a_coat_has_normals_of_its_own() {
    let coat = |normal: Option<[f32; 2]>| Principled {
        base_weight: 0.0.into(),
        specular_weight: 0.0.into(),
        coat_weight: 1.0.into(),
        coat_roughness: 0.2.into(),
        geometry_coat_normal: normal.map(|[x, y]| Rgb((0.5 * Vec3::new(x, y, 1.0).normalize() + 0.5).into()).into()),
        ..Principled::default()
    };
    let wo = Vec3::new(0.3, 1.0, 0.2).normalize();
    for (normal, expected) in
        [(None, Vec3::new(0.2, 1.0, 0.0)), (Some([0.0, 0.0]), Vec3::Y), (Some([0.0, 0.2]), Vec3::new(0.0, 1.0, -0.2))]
    {
        let scene = leaning(coat(normal), [0.2, 0.0], tile());
        let si = scene.intersect(&Ray::new(Vec3::new(-0.5, 0.0, 0.3) + 5.0 * wo, -wo)).unwrap();
        let shine = |n: Vec3| si.eval_pdf(&si.bsdf(), reflect_at(wo, n.normalize())).0.to_rgb()[0];
        let brightest = shine(expected);
        for away in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z] {
            assert!(brightest > 1.2 * shine(expected + 0.02 * away), "{normal:?}: {brightest}, {away}");
        }
    }
}
