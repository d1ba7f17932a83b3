//! Primitives that a ray is said not to meet.

use std::sync::Arc;

use eyebeam_bvh::{Affine, Bvh, Geometry, Hit, Instance, Isa, Primitive, Quality, Ray, Slot, Sphere};
use glam::Vec3;

use crate::random::Random;

fn bits(hit: Option<Hit>) -> Option<[u32; 4]> {
    hit.map(|h| [h.t.to_bits(), h.prim, h.u.to_bits(), h.v.to_bits()])
}

fn soup(r: &mut Random, n: usize) -> Vec<Primitive> {
    (0..n)
        .map(|_| {
            let center = r.in_cube();
            r.shape(center, 0.5)
        })
        .collect()
}

/// Whatever is left out but the nearest hit, the hit is the same.
#[test]
fn what_is_not_met_is_not_missed() {
    let mut r = Random::new(70);
    for n in [1, 4, 8, 20, 300] {
        let shapes = soup(&mut r, n);
        let list = Bvh::list(&shapes).unwrap();
        let plain = Bvh::build(&shapes, Quality::Balanced).unwrap().with_isa(Isa::Scalar);
        let trees = Quality::ALL.map(|quality| Bvh::build(&shapes, quality).unwrap());
        for bvh in trees.iter().chain([&list, &plain]) {
            let slots = bvh.slots();
            let mut hits = 0;
            for _ in 0..2000 {
                let ray = r.ray(&shapes, 1.0);
                let hit = bvh.intersect(&ray);
                let mut other = || {
                    let prim = r.below(n);
                    let is_met = hit.is_some_and(|h| h.prim as usize == prim);
                    if is_met { Slot::NONE } else { slots.get(prim).copied().unwrap_or(Slot::NONE) }
                };
                let apart = Ray { apart: [other(), other()], ..ray };
                assert_eq!(bits(bvh.intersect(&apart)), bits(hit), "{apart:?}");
                assert_eq!(bvh.occluded(&apart), hit.is_some(), "{apart:?}");
                hits += usize::from(hit.is_some());
            }
            assert!(hits > 100);
        }
    }
}

/// What is met but left out is as if it were not there, where the tree keeps it in one place.
#[test]
fn what_is_left_out_is_not_tested() {
    let mut r = Random::new(71);
    for n in [1, 4, 8, 20, 300] {
        let shapes = soup(&mut r, n);
        let bvh = Bvh::build(&shapes, Quality::Balanced).unwrap();
        let slots = bvh.slots();
        for _ in 0..3000 {
            let ray = r.ray(&shapes, 1.0);
            let Some(hit) = bvh.intersect(&ray) else { continue };
            assert_eq!(slots[hit.prim as usize], hit.slot());
            let behind = bvh.intersect_where(&ray, |h| h.prim != hit.prim);
            let apart = Ray { apart: [Slot::NONE, hit.slot()], ..ray };
            assert_eq!(bits(bvh.intersect(&apart)), bits(behind), "{apart:?}");
            assert_eq!(bvh.occluded(&apart), behind.is_some(), "{apart:?}");
        }
    }
}

struct Shown(Arc<Bvh>);

impl Geometry for Shown {
    fn len(&self) -> usize {
        1
    }

    fn primitive(&self, _: usize) -> Primitive {
        Primitive::Instance(Instance::new(0, Affine::IDENTITY))
    }

    fn objects(&self) -> &[Arc<Bvh>] {
        std::slice::from_ref(&self.0)
    }
}

/// An object's primitives have no place of their own in the outer tree.
#[test]
fn within_instances_nothing_is_left_out() {
    let ball = Primitive::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 });
    let object = Arc::new(Bvh::build(&vec![ball], Quality::Balanced).unwrap());
    let ray = Ray::new(3.0 * Vec3::Z, Vec3::NEG_Z);
    let of_object = object.intersect(&ray).unwrap().slot();
    let bvh = Bvh::build(&Shown(object), Quality::Balanced).unwrap();
    assert_eq!(bvh.intersect(&ray).unwrap().slot(), Slot::NONE);
    assert!(bvh.occluded(&Ray { apart: [of_object; 2], ..ray }));
}
