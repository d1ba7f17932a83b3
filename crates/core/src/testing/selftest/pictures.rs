//! Checks of pictures: scenes that are known beforehand, integrators against each other, threads.

use std::num::NonZeroUsize;

use super::{Check, Implementation};
use crate::camera::CameraDesc;
use crate::color::Rgb;
use crate::desc::{RenderDesc, SceneDesc};
use crate::film::{BoxFilter, Film, FilterDesc};
use crate::integrator::IntegratorKind;
use crate::light::{DirectionalLight, EnvironmentDesc};
use crate::material::{Dielectric, Emissive, Lambertian, MaterialDesc, Metal};
use crate::render::{Monitor, Render, Settings};
use crate::sampler::SamplerKind;
use crate::scene::Scene;
use crate::shape::{QuadDesc, SphereDesc};
use crate::testing::scenes::{self, KnownScene};
use crate::testing::z_test_films;

pub(super) fn checks() -> Vec<Check> {
    let known = scenes::all().into_iter().map(|scene| {
        let name = scene.name.clone();
        Check::new(name, "the picture is as bright as its formula says", move |i| known(i, &scene))
    });
    let last = [
        Check::new("integrators agree", "they make the same picture of a room, a ball of glass and a sun", agreement),
        Check::new("threads agree", "any number of threads makes the same bits", threads),
    ];
    known.chain(last).collect()
}

/// By every integrator that can see the light, with every sampler.
fn known(i: &dyn Implementation, scene: &KnownScene) -> Result<(), String> {
    const SPP: u32 = 64;
    for (integrator, kind) in IntegratorKind::NAMES {
        if !scene.by_chance && *kind == IntegratorKind::Weekend {
            continue;
        }
        for (sampler, numbers) in SamplerKind::NAMES {
            let build = || i.integrator(*kind, scene.max_depth, &scene.desc);
            scene.check(build, *numbers, SPP).map_err(|e| format!("{integrator} with {sampler} numbers: {e}"))?;
        }
    }
    Ok(())
}

/// Matte, metal and glass under a lamp, a large sun and a sky.
fn still_life() -> SceneDesc {
    let materials = [
        ("floor", MaterialDesc::Lambertian(Lambertian { albedo: Rgb([0.7, 0.6, 0.5]).into() })),
        ("metal", MaterialDesc::Metal(Metal { albedo: Rgb([0.9, 0.7, 0.4]).into(), roughness: 0.4.into() })),
        ("glass", MaterialDesc::Dielectric(Dielectric { roughness: 0.4.into(), ..Dielectric::default() })),
        ("lamp", MaterialDesc::Emissive(Emissive { radiance: Rgb::grey(5.0).into(), ..Emissive::default() })),
    ];
    let mut desc = SceneDesc {
        environment: EnvironmentDesc::default(),
        camera: CameraDesc { look_from: [0.0, 1.2, 4.0], look_at: [0.0, 0.5, 0.0], ..CameraDesc::default() },
        material: materials.map(|(name, material)| (name.to_owned(), material)).into(),
        ..SceneDesc::default()
    };
    let floor = Some("floor".to_owned());
    desc.shape.quad.push(QuadDesc {
        corner: [-8.0, 0.0, 8.0],
        u: [16.0, 0.0, 0.0],
        v: [0.0, 0.0, -16.0],
        material: floor,
        ..QuadDesc::default()
    });
    for (center, name) in [([-1.1, 0.5, 0.0], "metal"), ([0.1, 0.5, 0.4], "glass"), ([1.3, 0.5, 0.0], "lamp")] {
        desc.shape.sphere.push(SphereDesc {
            center,
            radius: 0.5,
            material: Some(name.to_owned()),
            ..SphereDesc::default()
        });
    }
    let irradiance = Rgb([3.0, 2.5, 2.0]);
    desc.light.directional.push(DirectionalLight { direction: [0.6, 0.7, 0.3], irradiance, angle: 25.0 });
    desc
}

fn settings(integrator: IntegratorKind, seed: u64, spp: u32, threads: NonZeroUsize) -> Settings {
    let (width, height, filter) = (32, 24, FilterDesc::Box(BoxFilter::default()));
    let desc = RenderDesc {
        width,
        height,
        spp,
        seed,
        integrator,
        filter,
        sampler: SamplerKind::Independent,
        ..RenderDesc::default()
    };
    Settings { threads, ..Settings::from(&desc) }
}

fn render(i: &dyn Implementation, desc: &SceneDesc, settings: Settings) -> Result<Film, String> {
    let scene = Scene::build(desc).map_err(|problems| format!("{problems:?}"))?;
    let integrator = i.integrator(settings.integrator, settings.max_depth, desc);
    let mut render = Render::with_integrator(&scene, settings, integrator);
    render.finish(&Monitor::default());
    Ok(render.film().clone())
}

fn agreement(i: &dyn Implementation) -> Result<(), String> {
    const SPP: u32 = 256;
    let desc = still_life();
    let (one, all) = (NonZeroUsize::MIN, 32);
    let weekend = render(i, &desc, settings(IntegratorKind::Weekend, 3, SPP, one))?;
    for (seed, (name, kind)) in (4..).zip(IntegratorKind::NAMES).filter(|(_, (_, k))| *k != IntegratorKind::Weekend) {
        let film = render(i, &desc, settings(*kind, seed, SPP, one))?;
        for block in [8, all] {
            z_test_films(&film, &weekend, block).map_err(|e| format!("{name} against weekend: {e}"))?;
        }
    }
    Ok(())
}

fn threads(i: &dyn Implementation) -> Result<(), String> {
    let desc = still_life();
    let picture = |threads: usize| {
        let threads = NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN);
        Ok::<_, String>(render(i, &desc, settings(IntegratorKind::default(), 1, 20, threads))?.develop())
    };
    let one = picture(1)?;
    for count in [2, 7] {
        if picture(count)? != one {
            return Err(format!("{count} threads make another picture than one"));
        }
    }
    Ok(())
}
