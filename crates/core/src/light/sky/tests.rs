//! The sky as a whole: descriptions, colours and amounts of light.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::color::luminance;
use crate::validate::Problem;

fn eastern(elevation: f32, turbidity: f32) -> SkyDesc {
    SkyDesc { sun_elevation: Some(elevation), sun_azimuth: Some(90.0), turbidity, ..SkyDesc::default() }
}

/// A small picture, as tests make many.
fn sky(elevation: f32, turbidity: f32) -> Sky {
    Sky::bake_size(&eastern(elevation, turbidity), 64, 32)
}

fn pixel(sky: &Sky, x: u32, y: u32) -> [f64; 3] {
    sky.image.pixel(x, y).map(f64::from)
}

/// Irradiance of the upper half on the ground, by midpoints.
fn diffuse(sky: &Sky) -> [f64; 3] {
    let (width, height) = (sky.image.width(), sky.image.height());
    let mut sum = [0.0; 3];
    for y in 0..height / 2 {
        let theta = PI * (f64::from(y) + 0.5) / f64::from(height);
        let weight = theta.sin() * theta.cos() * (PI / f64::from(height)) * (TAU / f64::from(width));
        for x in 0..width {
            let l = pixel(sky, x, y);
            sum = std::array::from_fn(|i| sum[i] + weight * l[i]);
        }
    }
    sum
}

/// Irradiance of the sun's disk on a plane that faces it: cos θ over the disk.
fn direct(sky: &Sky) -> [f64; 3] {
    sky.sun.map_or([0.0; 3], |sun| {
        let projected = PI * f64::from(sun.angular_radius).sin().powi(2);
        sun.radiance.0.map(|c| f64::from(c) * projected)
    })
}

fn problems(desc: &SkyDesc) -> Vec<Problem> {
    let mut c = Checker::default();
    desc.check(&mut c);
    c.into_problems()
}

#[test]
fn as_much_light_as_measured() {
    // A clear sky with the sun at 60°: about 900 W/m² directly and 60 to 120 W/m² from the sky over all wavelengths. In
    // light, at the efficacies of Perez et al. 1990, doi:10.1016/0038-092X(90)90055-H, about 105 lm/W for the beam of a
    // clear day and 140 lm/W for its sky, that is 95 klx and 8 to 17 klx; a tenth more or less is allowed.
    let desc = SkyDesc { sun_elevation: Some(60.0), ground_albedo: 0.2, ..SkyDesc::default() };
    let sky = Sky::bake(&desc);
    let beam = luminance(direct(&sky)) * 10.0;
    assert!((95.0 * 0.9..95.0 * 1.1).contains(&beam), "direct {beam} klx");
    let diffuse = luminance(diffuse(&sky)) * 10.0;
    assert!((8.0 * 0.9..17.0 * 1.1).contains(&diffuse), "diffuse {diffuse} klx");
    // Below is the ground: a lambertian reflector of both.
    let ground = luminance(pixel(&sky, 7, 200)) * 10.0;
    let expected = 0.2 / PI * (beam * 60_f64.to_radians().sin() + diffuse);
    assert!((ground / expected - 1.0).abs() < 1e-3, "{ground} {expected}");
}

#[test]
fn half_of_what_the_sun_loses_comes_down() {
    // Without haze, on black ground and in blue, where ozone takes little: molecules scatter as much forward as back,
    // and of what goes up a little more escapes than of what comes down.
    let desc = SkyDesc { ground_albedo: 0.0, ..eastern(60.0, 1.0) };
    let sky = Sky::bake(&desc);
    let outside = bands::Observer::new().rgb(bands::SOLAR)[2] / 10_000.0;
    let lost = (outside - direct(&sky)[2]) * 60_f64.to_radians().sin();
    let share = diffuse(&sky)[2] / lost;
    assert!((0.45..0.52).contains(&share), "{share}");
}

#[test]
fn haze_moves_light_from_the_sun_to_the_sky() {
    let [clear, hazy] = [sky(30.0, 2.0), sky(30.0, 6.0)];
    assert!(luminance(direct(&hazy)) < 0.6 * luminance(direct(&clear)));
    assert!(luminance(diffuse(&hazy)) > 1.5 * luminance(diffuse(&clear)));
}

#[test]
fn the_zenith_is_blue_and_the_setting_sun_red() {
    let noon = sky(60.0, 2.5);
    let [r, g, b] = pixel(&noon, 0, 0);
    assert!(b > g && g > r && b > 1.5 * r, "{r} {g} {b}");
    let evening = sky(2.0, 2.5);
    let redness = |sky: &Sky| direct(sky)[0] / direct(sky)[2];
    assert!(redness(&noon) < 1.6, "{}", redness(&noon));
    assert!(redness(&evening) > 8.0 * redness(&noon), "{}", redness(&evening));
}

#[test]
fn it_gets_darker_until_it_is_night() {
    let mut before = f64::INFINITY;
    for elevation in [10.0, 3.0, 0.0, -2.0, -5.0, -9.0, -13.0, -18.0] {
        let light = luminance(diffuse(&sky(elevation, 2.5)));
        assert!(light < before && light > 0.0, "elevation {elevation}: {light} after {before}");
        before = light;
    }
    let day = luminance(diffuse(&sky(60.0, 2.5)));
    assert!(before < 1e-6 * day, "night {before}, day {day}");
}

#[test]
fn finite_everywhere() {
    for elevation in [-90.0, -5.0, -0.1, 0.0, 45.0, 90.0] {
        for turbidity in [1.0, 10.0] {
            let sky = sky(elevation, turbidity);
            let all = sky.image.pixels().iter().chain(sky.sun.iter().map(|sun| &sun.radiance.0)).flatten();
            assert!(
                all.into_iter().all(|c| c.is_finite() && *c >= 0.0),
                "elevation {elevation}, turbidity {turbidity}"
            );
            assert_eq!(sky.sun.is_some(), elevation > -0.2);
        }
    }
}

#[test]
fn symmetric_about_the_suns_meridian() {
    // The sun is in the east, between the columns 127 and 128.
    let sky = Sky::bake(&eastern(20.0, 2.5));
    for (x, y) in (0..256).flat_map(|x| [0, 40, 100, 127].map(|y| (x, y))) {
        let (left, right) = (pixel(&sky, (127 + 512 - x) % 512, y), pixel(&sky, (128 + x) % 512, y));
        for (l, r) in left.into_iter().zip(right) {
            assert!((l - r).abs() <= 1e-5 * r, "{x} {y}: {l} {r}");
        }
    }
    let brightest = |&x: &u32| (sky.image.pixel(x, 99)[1] * 1e6) as u64;
    assert!((126..=129).contains(&(0..512).max_by_key(brightest).unwrap()));
}

#[test]
fn a_larger_sun_gives_the_same_light() {
    let desc = SkyDesc::default();
    let bake = |desc: SkyDesc| Sky::bake_size(&desc, 64, 32);
    let [small, large] = [0.1, 20.0].map(|sun_size| bake(SkyDesc { sun_size, ..desc.clone() }));
    for (s, l) in direct(&small).into_iter().zip(direct(&large)) {
        assert!((s / l - 1.0).abs() < 1e-5, "{s} {l}");
    }
    assert_eq!(small.image, large.image);
    let half = bake(SkyDesc { scale: 0.5, sun: 3.0, sun_size: 0.1, ..desc.clone() });
    assert!((direct(&half)[1] / direct(&small)[1] - 1.5).abs() < 1e-5);
    assert!((half.image.pixel(3, 3)[1] / small.image.pixel(3, 3)[1] - 0.5).abs() < 1e-5);
    assert_eq!(bake(SkyDesc { sun: 0.0, ..desc }).sun, None);
}

#[test]
fn directions() {
    let close = |desc: &SkyDesc, expected: [f32; 3]| {
        assert!((desc.direction_to_sun() - Vec3::from(expected).normalize()).length() < 1e-4, "{desc:?}");
    };
    close(&SkyDesc::default(), [1.0, std::f32::consts::SQRT_2, 1.0]);
    let angles = |elevation, azimuth| SkyDesc {
        sun_elevation: Some(elevation),
        sun_azimuth: Some(azimuth),
        ..SkyDesc::default()
    };
    close(&angles(0.0, 0.0), [0.0, 0.0, -1.0]);
    close(&angles(0.0, 90.0), [1.0, 0.0, 0.0]);
    close(&angles(90.0, 33.0), [0.0, 1.0, 0.0]);
    close(&SkyDesc { sun_direction: Some([0.0, 3.0, 4.0]), ..SkyDesc::default() }, [0.0, 0.6, 0.8]);
    let place = SkyDesc {
        latitude: Some(0.0),
        longitude: Some(0.0),
        time: Some("2026-03-20T18:07:30Z".to_owned()),
        ..SkyDesc::default()
    };
    // Three hours and a third after the equinox, at 0.0165° per hour: 0.055° north of the west.
    let west = place.direction_to_sun();
    assert!((west - Vec3::new(-1.0, 0.0, -0.055_f32.to_radians())).length() < 1e-3, "{west}");
}

#[test]
fn mistakes_are_found() {
    assert_eq!(problems(&SkyDesc::default()), []);
    let time = |time: &str| Some(time.to_owned());
    let (good, desc) = (time("2026-06-21T12:00:00Z"), SkyDesc::default);
    let (lat, lon) = (Some(48.0), Some(16.0));
    for (desc, key, part) in [
        (SkyDesc { turbidity: 0.5, ..desc() }, "turbidity", "from 1 to 10"),
        (SkyDesc { turbidity: f32::NAN, ..desc() }, "turbidity", "from 1 to 10"),
        (SkyDesc { ground_albedo: 1.5, ..desc() }, "ground_albedo", "from 0 to 1"),
        (SkyDesc { scale: 1e5, sun_size: 0.05, ..desc() }, "scale", "too bright"),
        (SkyDesc { sun: -1.0, ..desc() }, "sun", "from 0"),
        (SkyDesc { sun_size: 0.0, ..desc() }, "sun_size", "from 0.05"),
        (SkyDesc { sun_direction: Some([0.0; 3]), ..desc() }, "sun_direction", "[0, 0, 0]"),
        (SkyDesc { sun_elevation: Some(91.0), ..desc() }, "sun_elevation", "from -90 to 90"),
        (SkyDesc { latitude: lat, longitude: lon, ..desc() }, "latitude", "`time` is missing"),
        (SkyDesc { time: good.clone(), longitude: lon, ..desc() }, "longitude", "`latitude` is missing"),
        (SkyDesc { time: time("noon"), latitude: lat, longitude: lon, ..desc() }, "time", "4 digits"),
        (SkyDesc { time: good.clone(), latitude: lat, longitude: Some(190.0), ..desc() }, "longitude", "to 180"),
        (SkyDesc { sun_azimuth: Some(9.0), latitude: lat, ..desc() }, "latitude", "`sun_azimuth` and `latitude` both"),
        (SkyDesc { sun_azimuth: Some(9.0), sun_direction: Some([1.0; 3]), ..desc() }, "sun_azimuth", "both"),
    ] {
        let found = problems(&desc);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].path, [key]);
        assert!(found[0].message.contains(part) && found[0].hint.is_some(), "{found:?}");
    }
    assert_eq!(problems(&SkyDesc { time: good, latitude: lat, longitude: lon, ..desc() }), []);
}

#[test]
fn the_set_sun_is_no_mistake_but_told() {
    let at = |elevation| SkyDesc { sun_elevation: Some(elevation), ..SkyDesc::default() };
    assert_eq!(at(0.0).warning(), None);
    assert!(at(-6.0).warning().unwrap().contains("6.0 degrees below the horizon: it is twilight"));
    assert!(at(-30.0).warning().unwrap().contains("night"));
    assert_eq!(problems(&at(-30.0)), []);
}
