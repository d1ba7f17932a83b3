//! Lamps without size over a floor: what arrives is known in closed form, and without noise.

use std::f32::consts::PI;
use std::sync::Arc;

use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::light::{IesLight, IesProfile, LightsDesc, PointLight, ProjectorLight, SpotLight};
use eyebeam_core::render::Settings;
use glam::Vec3;

use crate::setup::*;

const ALBEDO: f32 = 0.8;

/// Radiance of the floor at (x, 0, z) in the light of these lamps alone.
fn lit(light: &LightsDesc, x: f32, z: f32) -> [f32; 3] {
    let mut desc = scene(DARK, matte(ALBEDO), look([x, 1.0, z], [x, 0.0, z], 0.001));
    desc.shape.quad.push(floor(0.0, 60.0));
    desc.light = light.clone();
    let settings = Settings { integrator: IntegratorKind::Path, ..settings(1, 16, 2) };
    render(&desc, settings).develop().pixel(0, 0)
}

/// That at (x, 0, z) an intensity, W / sr, arrives from `position`.
#[track_caller]
fn assert_intensity(light: &LightsDesc, position: Vec3, [x, z]: [f32; 2], intensity: [f32; 3]) {
    let to = position - Vec3::new(x, 0.0, z);
    let factor = ALBEDO / PI * to.normalize().y / to.length_squared();
    for (found, expected) in lit(light, x, z).into_iter().zip(intensity.map(|i| i * factor)) {
        let error = (found - expected).abs();
        assert!(error <= 2e-4 * expected, "at {x}, {z}: {found}, not {expected}");
    }
}

#[test]
fn a_point() {
    let point = PointLight { position: [0.5, 2.0, -1.0], intensity: Rgb([10.0, 20.0, 0.0]) };
    let light = LightsDesc { point: vec![point.clone()], ..LightsDesc::default() };
    for at in [[0.5, -1.0], [3.0, 4.0], [-50.0, 20.0]] {
        assert_intensity(&light, point.position.into(), at, point.intensity.0);
    }
}

#[test]
fn a_spot() {
    let spot = SpotLight {
        position: [0.0, 2.0, 0.0],
        look_at: [0.0; 3],
        intensity: Rgb::grey(10.0),
        inner: Some(30.0),
        outer: 60.0,
    };
    let light = LightsDesc { spot: vec![spot], ..LightsDesc::default() };
    for (degrees, share) in [(0.0_f32, 1.0), (29.0, 1.0), (61.0, 0.0)] {
        assert_intensity(&light, Vec3::Y * 2.0, [2.0 * degrees.to_radians().tan(), 0.0], [10.0 * share; 3]);
    }
    // Half of the light where the cosine is half way.
    let cos = 0.5 * (30_f32.to_radians().cos() + 60_f32.to_radians().cos());
    assert_intensity(&light, Vec3::Y * 2.0, [0.0, 2.0 * cos.acos().tan()], [5.0; 3]);
}

/// Candela over 202.7 lm / W; an even profile is a point light.
#[test]
fn an_ies_lamp() {
    let lamp = |profile: IesProfile| IesLight {
        file: String::new(),
        position: [0.5, 2.0, -1.0],
        direction: [0.0, -1.0, 0.0],
        rotation: 0.0,
        scale: 2.0,
        color: Rgb([1.0, 0.5, 0.0]),
        profile: Some(Arc::new(profile)),
    };
    let lights = |ies| LightsDesc { ies: vec![ies], ..LightsDesc::default() };
    let watts = |candela: f32| candela / (683.0 * 106.86 / 360.0);
    let position = Vec3::new(0.5, 2.0, -1.0);

    let even = lights(lamp(IesProfile::new(vec![0.0, 180.0], vec![0.0], vec![500.0; 2]).unwrap()));
    for at in [[0.5, -1.0], [3.0, 4.0], [-50.0, 20.0]] {
        assert_intensity(&even, position, at, [watts(1000.0), watts(500.0), 0.0]);
    }

    // 100 cd towards +x, 200 towards −z, 300 towards −x, 400 towards +z: where they fall, and how they turn.
    let candela = [100.0, 200.0, 300.0, 400.0].iter().flat_map(|&c| [c; 2]).collect();
    let profile = IesProfile::new(vec![0.0, 180.0], vec![0.0, 90.0, 180.0, 270.0], candela).unwrap();
    let ways = [[2.0, 0.0], [0.0, -2.0], [-2.0, 0.0], [0.0, 2.0]];
    for quarter in 0..4 {
        let light =
            lights(IesLight { rotation: 90.0 * quarter as f32, color: Rgb::grey(1.0), ..lamp(profile.clone()) });
        for (i, [x, z]) in ways.into_iter().enumerate() {
            let candela = 200.0 * (1 + (i + 4 - quarter) % 4) as f32;
            assert_intensity(&light, position, [0.5 + x, -1.0 + z], [watts(candela); 3]);
        }
    }
}

/// Two metres above the floor, with the picture's top towards −z: it is 4 wide, and each pixel's centre is where it should be.
#[test]
fn a_projector() {
    let mut image = Image::new(4, 2);
    for (x, y) in (0..2).flat_map(|y| (0..4).map(move |x| (x, y))) {
        image.set_pixel(x, y, [1.0 + x as f32, 3.0 - y as f32, 1.0]);
    }
    let projector = ProjectorLight {
        file: String::new(),
        position: [0.0, 2.0, 0.0],
        look_at: [0.0; 3],
        up: [0.0, 0.0, -1.0],
        fov: 90.0,
        scale: 3.0,
        image: Some(Arc::new(image)),
    };
    let light = LightsDesc { projector: vec![projector], ..LightsDesc::default() };
    for (x, y) in (0..2).flat_map(|y| (0..4).map(move |x| (x, y))) {
        let at = [x as f32 - 1.5, y as f32 - 0.5];
        assert_intensity(&light, Vec3::Y * 2.0, at, [3.0 + 3.0 * x as f32, 9.0 - 3.0 * y as f32, 3.0]);
    }
    for outside in [[2.01, 0.0], [-2.01, 0.0], [0.0, 1.01], [0.0, -1.01]] {
        assert_eq!(lit(&light, outside[0], outside[1]), [0.0; 3]);
    }
}

/// Among other lamps each still gives what it gives alone.
#[test]
fn all_together() {
    let file = String::new();
    let profile = IesProfile::new(vec![0.0, 90.0], vec![0.0], vec![3000.0, 0.0]).unwrap();
    let mut image = Image::new(2, 2);
    image.set_pixel(0, 0, [1.0; 3]);
    let mut light = LightsDesc::default();
    light.point.push(PointLight { position: [-1.0, 2.0, 0.0], intensity: Rgb([5.0, 0.0, 0.0]) });
    light.spot.push(SpotLight {
        position: [1.0, 2.0, 0.0],
        look_at: [0.0; 3],
        intensity: Rgb([0.0, 9.0, 0.0]),
        inner: None,
        outer: 40.0,
    });
    light.ies.push(IesLight {
        file: file.clone(),
        position: [0.0, 2.0, 1.0],
        direction: [0.0, -1.0, -0.5],
        rotation: 0.0,
        scale: 1.0,
        color: Rgb([1.0; 3]),
        profile: Some(Arc::new(profile)),
    });
    light.projector.push(ProjectorLight {
        file,
        position: [0.0, 2.0, -1.0],
        look_at: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        fov: 60.0,
        scale: 20.0,
        image: Some(Arc::new(image)),
    });
    let alone = [
        LightsDesc { point: light.point.clone(), ..LightsDesc::default() },
        LightsDesc { spot: light.spot.clone(), ..LightsDesc::default() },
        LightsDesc { ies: light.ies.clone(), ..LightsDesc::default() },
        LightsDesc { projector: light.projector.clone(), ..LightsDesc::default() },
    ];
    let mut desc: SceneDesc = scene(DARK, matte(ALBEDO), look([0.0, 6.0, 0.1], [0.0; 3], 40.0));
    desc.shape.quad.push(floor(0.0, 60.0));
    let mean = |light: &LightsDesc, spp: u32| {
        let desc = SceneDesc { light: light.clone(), ..desc.clone() };
        let image = render(&desc, Settings { integrator: IntegratorKind::Path, ..settings(32, spp, 2) }).develop();
        let sum = image.pixels().iter().fold([0.0_f64; 3], |s, p| std::array::from_fn(|i| s[i] + f64::from(p[i])));
        sum.map(|s| s / 1024.0)
    };
    let apart = alone.iter().map(|light| mean(light, 16)).collect::<Vec<_>>();
    assert!(apart.iter().all(|rgb| rgb.iter().any(|&c| c > 1e-3)), "{apart:?}");
    let together = mean(&light, 256);
    for channel in 0..3 {
        let expected: f64 = apart.iter().map(|rgb| rgb[channel]).sum();
        assert!((together[channel] / expected - 1.0).abs() < 0.01, "{together:?}, not {expected}");
    }
}
