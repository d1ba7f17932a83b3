//! The picture is a function of scene and settings, whoever computes it in whatever order.

use std::num::NonZeroUsize;
use std::sync::atomic::Ordering::Relaxed;
use std::thread;

use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::material::{Dielectric, MaterialDesc, Metal};
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::scene::{Acceleration, BuildOptions, Scene};

use crate::setup::*;

/// Something of everything, for a picture whose size is no multiple of a tile.
fn medley() -> SceneDesc {
    let mut desc = scene(EnvironmentDesc::default(), matte(0.6), look([0.5, 1.5, 5.0], [0.0, 0.5, 0.0], 45.0));
    desc.camera.aperture = Some(0.1);
    let metal = Metal { albedo: Rgb([0.9, 0.7, 0.4]).into(), roughness: 0.2.into() };
    desc.material.insert("metal".to_owned(), MaterialDesc::Metal(metal));
    desc.material
        .insert("glass".to_owned(), MaterialDesc::Dielectric(Dielectric { eta: 1.5, ..Dielectric::default() }));
    desc.material.insert("lamp".to_owned(), lamp(5.0));
    for (i, name) in ["it", "metal", "glass", "lamp"].into_iter().enumerate() {
        desc.shape.sphere.push(sphere([i as f32 - 1.5, 0.45, 0.0], 0.45));
        desc.shape.sphere[i].material = Some(name.to_owned());
    }
    desc.shape.quad.push(floor(0.0, 30.0));
    desc.shape.mesh.push(box_mesh([-0.4, 0.0, 0.8], [0.3, 0.3, 1.2]));
    desc
}

fn settings_of(threads: usize, spp: u32) -> Settings {
    let threads = NonZeroUsize::new(threads).unwrap();
    Settings { width: 75, height: 41, threads, ..settings(0, spp, 20) }
}

fn picture(scene: &Scene, settings: Settings) -> Image {
    finish(Render::new(scene, settings)).develop()
}

#[test]
fn threads_and_repetition_change_nothing() {
    let scene = Scene::build(&medley()).unwrap();
    let one = picture(&scene, settings_of(1, 40));
    for threads in [1, 2, 7, 64] {
        assert!(picture(&scene, settings_of(threads, 40)) == one, "{threads} threads");
    }
}

#[test]
fn the_tree_changes_nothing() {
    let [tree, list] = [Acceleration::default(), Acceleration::List].map(|acceleration| {
        Scene::build_with(&medley(), BuildOptions { acceleration, ..BuildOptions::default() }).unwrap()
    });
    assert!(picture(&tree, settings_of(2, 20)) == picture(&list, settings_of(2, 20)));
}

#[test]
fn seeds_differ() {
    let scene = Scene::build(&medley()).unwrap();
    let one = picture(&scene, settings_of(2, 2));
    for seed in [0, 2, u64::MAX] {
        let other = picture(&scene, Settings { seed, ..settings_of(2, 2) });
        let same = one.pixels().iter().zip(other.pixels()).filter(|(a, b)| a == b).count();
        // Those of the lamp are always the same.
        assert!(same < one.pixels().len() / 20, "seed {seed}: {same} pixels are the same");
    }
}

/// Stopped after any number of units, and told to stop before it begins: it goes on where it was.
#[test]
fn pauses_change_nothing() {
    let scene = Scene::build(&medley()).unwrap();
    let whole = picture(&scene, settings_of(2, 40));
    let mut steps = 0;
    for threads in [1, 3] {
        for units in [1, 2, 5, 11] {
            let mut render = Render::new(&scene, settings_of(threads, 40));
            let monitor = Monitor::default();
            while !render.is_done() {
                monitor.pause.store(true, Relaxed);
                let before = monitor.units.load(Relaxed);
                render.step(&monitor);
                assert_eq!(monitor.units.load(Relaxed), before, "nothing is done while it is told to pause");
                monitor.pause.store(false, Relaxed);
                thread::scope(|scope| {
                    scope.spawn(|| {
                        let last = before + units;
                        while monitor.units.load(Relaxed) < last {
                            thread::yield_now();
                        }
                        monitor.pause.store(true, Relaxed);
                    });
                    render.step(&monitor);
                    // Lets the other thread go if the step ended by itself.
                    monitor.units.fetch_add(1 << 32, Relaxed);
                });
                monitor.units.fetch_sub(1 << 32, Relaxed);
                steps += 1;
            }
            assert_eq!(monitor.units.load(Relaxed), render.units());
            assert!(render.film().develop() == whole, "{threads} threads, {units} units");
        }
    }
    assert!(steps > 8 * 3, "some passes were stopped");
}

/// A picture with fewer samples is the beginning of one with more.
#[test]
fn samples_are_a_sequence() {
    let scene = Scene::build(&medley()).unwrap();
    let mut long = Render::new(&scene, settings_of(2, 100));
    for passes in 1..4 {
        long.step(&Monitor::default());
        assert!(long.film().develop() == picture(&scene, settings_of(2, passes * Render::SAMPLES_PER_PASS)));
    }
}
