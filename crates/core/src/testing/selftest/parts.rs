//! Checks of the parts: numbers, filters, cameras, lobes, lights.

use std::sync::Arc;

use glam::Vec3;

use super::{Check, Implementation};
use crate::camera::{CameraDesc, FisheyeDesc, FisheyeProjection, OrthographicDesc, PanoramaDesc};
use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::film::{BlackmanHarris, BoxFilter, FilterDesc, Gaussian, Image, Mitchell, Tent};
use crate::light::select::{LightBounds, LightSelection};
use crate::light::{DirectionalLight, EnvironmentDesc, ImageEnvironment, NoLight};
use crate::material::{
    Conductor, Dielectric, DiffuseTransmission, Emissive, Lambertian, MaterialDesc, Metal, OrenNayar, Plastic,
    Principled, Sheen,
};
use crate::sampler::SamplerKind;
use crate::shape::{MeshDesc, QuadDesc, SphereDesc};
use crate::testing::{
    Reciprocal, check_camera, check_filter, check_light, check_lobe, check_numbers, check_refraction, check_selection,
};

pub(super) fn checks() -> Vec<Check> {
    let mut checks = vec![
        Check::new("random numbers", "they are uniform and independent", numbers),
        Check::new("pixel filters", "samples follow the filter, which is where the pixel is", filters),
        Check::new("cameras", "rays go where the description says", cameras),
        Check::new("smooth glass", "Fresnel's shares, Snell's directions", smooth_glass),
        Check::new("choice of lights", "lights are chosen as often as their chances say", choices),
    ];
    checks.extend(lobes().map(|(name, material, reciprocal)| {
        let test = move |i: &dyn Implementation| check_lobe(&*i.lobe(&material), reciprocal);
        Check::new(format!("lobe of {name}"), "directions follow their density; no light is made", test)
    }));
    checks.extend(lights().map(|(name, desc, points)| {
        let test = move |i: &dyn Implementation| check_light(&*i.lights(&desc).swap_remove(0), &points);
        Check::new(format!("light of {name}"), "directions follow their density, and find all the light", test)
    }));
    checks
}

fn numbers(i: &dyn Implementation) -> Result<(), String> {
    for (name, kind) in SamplerKind::NAMES {
        let samples = kind.samples(5, 0..16);
        check_numbers(&|pixel, sample| i.numbers(&samples, pixel, sample)).map_err(|e| format!("{name}: {e}"))?;
    }
    Ok(())
}

fn filters(i: &dyn Implementation) -> Result<(), String> {
    let filters = [
        FilterDesc::Box(BoxFilter::default()),
        FilterDesc::Tent(Tent::default()),
        FilterDesc::Gaussian(Gaussian::default()),
        FilterDesc::Mitchell(Mitchell::default()),
        FilterDesc::BlackmanHarris(BlackmanHarris::default()),
    ];
    filters.iter().try_for_each(|desc| check_filter(&*i.filter(desc)).map_err(|e| format!("{desc:?}: {e}")))
}

fn cameras(i: &dyn Implementation) -> Result<(), String> {
    let pose = CameraDesc { look_from: [3.0, 2.0, 5.0], look_at: [-1.0, 0.5, 0.2], ..CameraDesc::default() };
    let fisheye = |fov, projection| CameraDesc { fisheye: Some(FisheyeDesc { fov, projection }), ..pose.clone() };
    let cameras = [
        pose.clone(),
        CameraDesc { vfov: Some(100.0), ..pose.clone() },
        CameraDesc { aperture: Some(0.3), focus_distance: Some(4.0), ..pose.clone() },
        CameraDesc { orthographic: Some(OrthographicDesc { height: 3.0 }), ..pose.clone() },
        CameraDesc { panorama: Some(PanoramaDesc {}), ..pose.clone() },
        fisheye(180.0, FisheyeProjection::Equidistant),
        fisheye(220.0, FisheyeProjection::Equisolid),
    ];
    let (width, height) = (300, 200);
    let check = |desc| check_camera(&*i.camera(desc, width, height), desc, width, height);
    cameras.iter().try_for_each(|desc| check(desc).map_err(|e| format!("{desc:?}: {e}")))
}

fn smooth_glass(i: &dyn Implementation) -> Result<(), String> {
    [1.5, 2.42, 0.75].into_iter().try_for_each(|eta| {
        let glass = MaterialDesc::Dielectric(Dielectric { eta, ..Dielectric::default() });
        check_refraction(&*i.lobe(&glass), eta)
    })
}

fn lobes() -> impl Iterator<Item = (&'static str, MaterialDesc, Reciprocal)> {
    let gold = Conductor {
        eta: Some(Rgb([0.143, 0.375, 1.44])),
        k: Some(Rgb([3.98, 2.39, 1.60])),
        roughness: 0.3.into(),
        ..Conductor::default()
    };
    let leaf =
        DiffuseTransmission { reflectance: Rgb([0.1, 0.3, 0.05]).into(), transmittance: Rgb([0.2, 0.5, 0.0]).into() };
    let velvet =
        Sheen { color: Rgb([0.9, 0.4, 0.2]).into(), roughness: 0.4.into(), albedo: Rgb([0.2, 0.1, 0.0]).into() };
    let layers = Principled {
        base_metalness: 0.3.into(),
        transmission_weight: 0.4.into(),
        coat_weight: 0.5.into(),
        fuzz_weight: 0.5.into(),
        ..Principled::default()
    };
    [
        ("matte", MaterialDesc::Lambertian(Lambertian { albedo: Rgb([0.9, 0.5, 0.1]).into() }), Reciprocal::Yes),
        (
            "rough matte",
            MaterialDesc::OrenNayar(OrenNayar { albedo: Rgb::grey(1.0).into(), roughness: 0.8.into() }),
            Reciprocal::Yes,
        ),
        ("a leaf", MaterialDesc::DiffuseTransmission(leaf), Reciprocal::Yes),
        ("velvet", MaterialDesc::Sheen(velvet), Reciprocal::Yes),
        (
            "fuzzy metal",
            MaterialDesc::Metal(Metal { albedo: Rgb::grey(0.9).into(), roughness: 0.4.into() }),
            Reciprocal::No,
        ),
        ("rough metal", MaterialDesc::Conductor(gold), Reciprocal::Yes),
        ("plastic", MaterialDesc::Plastic(Plastic { roughness: 0.4.into(), ..Plastic::default() }), Reciprocal::Yes),
        ("layers", MaterialDesc::Principled(layers.into()), Reciprocal::No),
        (
            "rough glass",
            MaterialDesc::Dielectric(Dielectric { eta: 1.5, roughness: 0.5.into(), ..Dielectric::default() }),
            Reciprocal::Yes,
        ),
    ]
    .into_iter()
}

/// Scenes whose first light is the one in question, and the points that it is seen from: above, aside, far, along its surface,
/// and very near.
fn lights() -> impl Iterator<Item = (&'static str, SceneDesc, Vec<Vec3>)> {
    let points = [[0.1, 1.2, 0.2], [3.0, 2.0, -1.0], [20.0, 15.0, 8.0], [2.5, 0.05, 0.3], [0.2, 0.02, 0.1]];
    let points = points.map(Vec3::from).to_vec();
    let dark = || {
        let mut desc = SceneDesc { environment: EnvironmentDesc::None(NoLight {}), ..SceneDesc::default() };
        let lamp = Emissive { radiance: Rgb([2.0, 3.0, 4.0]).into(), ..Emissive::default() };
        desc.material.insert("lamp".to_owned(), MaterialDesc::Emissive(lamp.clone()));
        desc.material.insert("both".to_owned(), MaterialDesc::Emissive(Emissive { two_sided: true, ..lamp }));
        desc
    };
    let sphere = |material: &str| {
        let mut desc = dark();
        let material = Some(material.to_owned());
        desc.shape.sphere.push(SphereDesc { center: [0.0; 3], radius: 0.7, material, ..SphereDesc::default() });
        desc
    };
    let quad = |u, v| {
        let mut desc = dark();
        desc.shape.quad.push(QuadDesc {
            corner: [-0.5, 0.0, 0.6],
            u,
            v,
            material: Some("lamp".to_owned()),
            ..QuadDesc::default()
        });
        desc
    };
    let mut triangle = dark();
    triangle.shape.mesh.push(MeshDesc {
        vertices: vec![[-0.6, 0.0, 0.7], [0.8, 0.0, 0.4], [0.1, 0.0, -0.9]],
        triangles: vec![[0, 1, 2]],
        material: Some("lamp".to_owned()),
        ..MeshDesc::default()
    });
    let mut sun = dark();
    sun.light.directional.push(DirectionalLight {
        direction: [0.5, 0.6, 0.2],
        irradiance: Rgb::grey(3.0),
        angle: 0.53,
    });
    let sky = SceneDesc { environment: spotted_sky(), ..SceneDesc::default() };
    let anywhere = vec![Vec3::ZERO];
    [
        ("a ball", sphere("lamp"), points.clone()),
        ("a ball from inside", sphere("both"), vec![Vec3::ZERO, Vec3::new(0.3, -0.2, 0.1), Vec3::new(0.0, 0.65, 0.0)]),
        ("a rectangle", quad([1.0, 0.0, 0.0], [0.0, 0.0, -1.2]), points.clone()),
        ("a slanted quad", quad([1.0, 0.0, 0.0], [0.4, 0.0, -1.2]), points.clone()),
        ("a triangle", triangle, points),
        ("the sun", sun, anywhere.clone()),
        ("a picture", sky, anywhere),
    ]
    .into_iter()
}

/// A picture with bright spots, one of them at the zenith.
fn spotted_sky() -> EnvironmentDesc {
    let mut image = Image::new(32, 16);
    for (x, y) in (0..16).flat_map(|y| (0..32).map(move |x| (x, y))) {
        let spot = match (x, y) {
            (9, 4) => 60.0,
            (20..24, 8..11) => 7.0,
            (_, 0) => 3.0,
            _ => 0.0,
        };
        image.set_pixel(x, y, [0.3 + 0.02 * x as f32 + spot, 0.4 + spot, 0.5 + 0.5 * spot]);
    }
    let file = "sky".to_owned();
    EnvironmentDesc::Image(ImageEnvironment { file, rotation: 40.0, scale: 1.5, image: Some(Arc::new(image)) })
}

/// Lamps of all kinds in a room, one of them off.
fn choices(i: &dyn Implementation) -> Result<(), String> {
    let lamp = |k: u8| {
        let k = f32::from(k);
        let (p, axis) =
            (Vec3::new(k - 4.0, 2.0 + 0.3 * k, 1.5 - 0.4 * k), Vec3::new(0.1 * k - 0.4, -1.0, 0.2).normalize());
        let power = if k == 5.0 { 0.0 } else { 1.0 + 3.0 * (k % 3.0) };
        match k as u8 % 3 {
            0 => LightBounds::sphere(p, 0.2, power),
            1 => LightBounds::flat(p, p + 0.4, axis, power),
            _ => LightBounds::flat_two_sided(p, p + 0.6, axis, power),
        }
    };
    let lamps: Vec<_> = (0..9).map(lamp).collect();
    for selection in [LightSelection::Uniform, LightSelection::Power, LightSelection::Tree] {
        let choice = i.light_choice(selection, &lamps);
        for (p, n) in
            [(Vec3::ZERO, Vec3::Y), (Vec3::new(3.0, 2.5, -1.0), Vec3::X), (Vec3::new(-9.0, 9.0, 4.0), Vec3::ZERO)]
        {
            let place = |e| format!("{selection:?} at {p}: {e}");
            check_selection(&*choice, lamps.len() as u32, p, n).map_err(place)?;
        }
    }
    Ok(())
}
