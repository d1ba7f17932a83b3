//! A hundred million triangles, and ten million instances: `make test-huge`, on a machine with 12 GB of memory.

use std::sync::Arc;
use std::time::Instant;

use eyebeam_bvh::{Affine, Bvh, Geometry, Instance, Mesh, Primitive, Quality, Ray, Triangle};
use glam::Vec3;

/// Two triangles for each unit square of a landscape, computed when they are asked for.
struct Landscape {
    squares: usize,
}

impl Landscape {
    fn corner(x: usize, z: usize) -> Vec3 {
        let height = (x.wrapping_mul(0x9e37) ^ z.wrapping_mul(0x85eb)) % 64;
        Vec3::new(x as f32, height as f32 / 64.0, z as f32)
    }
}

impl Geometry for Landscape {
    fn len(&self) -> usize {
        2 * self.squares * self.squares
    }

    fn primitive(&self, index: usize) -> Primitive {
        let (x, z) = (index / 2 % self.squares, index / 2 / self.squares);
        let (a, c) = (Self::corner(x, z), Self::corner(x + 1, z + 1));
        let b = if index.is_multiple_of(2) { Self::corner(x + 1, z) } else { Self::corner(x, z + 1) };
        Primitive::Triangle(Triangle { a, b, c })
    }
}

/// Places all over a square of integers.
fn places(squares: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..100_000_usize).map(move |i| (i.wrapping_mul(0x9e37_79b1) % squares, i.wrapping_mul(0x85eb_ca77) % squares))
}

/// Down from above.
fn down(x: f32, z: f32) -> Ray {
    Ray::new(Vec3::new(x, 10.0, z), Vec3::NEG_Y)
}

fn built(geometry: &impl Geometry) -> Bvh {
    let start = Instant::now();
    let bvh = Bvh::build(geometry, Quality::Balanced).unwrap();
    let (seconds, stats) = (start.elapsed().as_secs_f32(), bvh.stats());
    println!("{seconds:.1} s, {} bytes for {} primitives", stats.bytes, stats.primitives);
    bvh
}

#[test]
#[ignore = "takes 12 GB of memory"]
fn a_hundred_million_triangles() {
    let land = Landscape { squares: 7072 };
    assert!(land.len() > 100_000_000);
    let bvh = built(&land);
    bvh.validate().unwrap();
    for (x, z) in places(land.squares) {
        for (side, [dx, dz]) in [[0.75, 0.25], [0.25, 0.75]].into_iter().enumerate() {
            let hit = bvh.intersect(&down(x as f32 + dx, z as f32 + dz)).unwrap();
            assert_eq!(hit.prim as usize, 2 * (z * land.squares + x) + side);
        }
    }
}

#[test]
#[ignore = "takes 4 GB of memory"]
fn ten_million_instances() {
    /// One triangle, shown in each unit square.
    struct Tiles {
        squares: usize,
        object: [Arc<Bvh>; 1],
    }
    impl Geometry for Tiles {
        fn len(&self) -> usize {
            self.squares * self.squares
        }
        fn primitive(&self, index: usize) -> Primitive {
            let at = Vec3::new((index % self.squares) as f32, 0.0, (index / self.squares) as f32);
            Primitive::Instance(Instance::new(0, Affine::from_translation(at)))
        }
        fn objects(&self) -> &[Arc<Bvh>] {
            &self.object
        }
    }
    let mesh = Mesh { vertices: &[Vec3::ZERO, Vec3::X, Vec3::Z], triangles: &[[0, 1, 2]] };
    let tiles = Tiles { squares: 3163, object: [Arc::new(Bvh::build(&mesh, Quality::Balanced).unwrap())] };
    assert!(tiles.len() > 10_000_000);
    let bvh = built(&tiles);
    assert!(bvh.stats().bytes < 200 * tiles.len());
    bvh.validate().unwrap();
    for (x, z) in places(tiles.squares) {
        let hit = bvh.intersect(&down(x as f32 + 0.25, z as f32 + 0.25)).unwrap();
        assert_eq!((hit.t, hit.prim, hit.instances[0] as usize), (10.0, 0, z * tiles.squares + x));
        assert!(bvh.intersect(&down(x as f32 + 0.75, z as f32 + 0.75)).is_none());
    }
}
