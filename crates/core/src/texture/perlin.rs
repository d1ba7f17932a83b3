//! Gradient noise, and sums of it.
//!
//! Perlin 2002, "Improving Noise", doi:10.1145/566570.566636: at each point of a lattice a gradient is drawn, and the planes
//! that these span are mixed by a polynomial whose first two derivatives vanish at the ends. The gradients are drawn by a
//! hash of the lattice point, so the pattern never repeats.

use glam::{FloatExt, Vec3};

use crate::math::{GAMMA, mix};

/// Noise about 0, within -1..1, with features of size 1; 0 at every lattice point.
pub(super) fn noise(p: Vec3) -> f32 {
    let cell = p.floor();
    let rest = p - cell;
    let weight = rest * rest * rest * (rest * (rest * 6.0 - 15.0) + 10.0);
    let corner = |i: u32| {
        let step = Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32);
        gradient(cell + step).dot(rest - step)
    };
    let along_x = |i: u32| corner(i).lerp(corner(i + 1), weight.x);
    let along_y = |i: u32| along_x(i).lerp(along_x(i + 2), weight.y);
    along_y(0).lerp(along_y(4), weight.z)
}

/// One of the twelve directions to the middles of a cube's edges.
fn gradient(lattice: Vec3) -> Vec3 {
    const EDGES: [[f32; 3]; 12] = [
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
        [1.0, -1.0, 0.0],
        [-1.0, -1.0, 0.0],
        [1.0, 0.0, 1.0],
        [-1.0, 0.0, 1.0],
        [1.0, 0.0, -1.0],
        [-1.0, 0.0, -1.0],
        [0.0, 1.0, 1.0],
        [0.0, -1.0, 1.0],
        [0.0, 1.0, -1.0],
        [0.0, -1.0, -1.0],
    ];
    let [x, y, z] = lattice.to_array().map(|c| c as i32 as u32);
    let hash = mix(mix(u64::from(x) << 32 | u64::from(y)) ^ u64::from(z).wrapping_mul(GAMMA));
    EDGES[(((hash >> 32) * 12) >> 32) as usize].into()
}

/// Layers of noise, each finer and weaker than the one before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layers {
    pub(super) octaves: u32,
    /// How many times finer.
    pub(super) lacunarity: f32,
    /// How many times as strong.
    pub(super) gain: f32,
}

impl Layers {
    /// Each twice as fine and half as strong as the one before.
    pub(super) const fn halves(octaves: u32) -> Self {
        Self { octaves, lacunarity: 2.0, gain: 0.5 }
    }

    /// Their sum: about 0, mostly within -1..1.
    pub(super) fn fbm(self, p: Vec3) -> f32 {
        self.sum(p, |x| x)
    }

    /// The sum of their absolute values: creases, from 0, mostly below 1.
    pub(super) fn turbulence(self, p: Vec3) -> f32 {
        self.sum(p, f32::abs)
    }

    fn sum(self, mut p: Vec3, of: impl Fn(f32) -> f32) -> f32 {
        // Finer layers are moved, so that their lattices do not meet at 0.
        const STEP: Vec3 = Vec3::new(37.17, 17.71, 71.37);
        let (mut sum, mut strength) = (0.0, 1.0);
        for _ in 0..self.octaves {
            sum += strength * of(noise(p));
            p = self.lacunarity * p + STEP;
            strength *= self.gain;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use glam::UVec2;

    fn points(n: u32) -> impl Iterator<Item = Vec3> {
        (0..n).map(|i| {
            let mut numbers = Independent::new(3, UVec2::ZERO, i);
            200.0 * (numbers.get_2d().extend(numbers.get_1d()) - 0.5)
        })
    }

    #[test]
    fn zero_on_the_lattice_and_smooth_between() {
        for p in points(2000) {
            assert_eq!(noise(p.floor()), 0.0);
            let value = noise(p);
            assert!(value.abs() <= 1.0);
            assert!((noise(p + Vec3::splat(1e-3)) - value).abs() < 0.01, "{p}");
        }
    }

    /// Mean 0; a variance that is worth the name; neighbours far apart have nothing in common.
    #[test]
    fn balanced_and_varied() {
        const N: u32 = 50_000;
        let (mut sum, mut squares, mut products) = (0.0, 0.0, 0.0);
        for p in points(N) {
            let (a, b) = (f64::from(noise(p)), f64::from(noise(p + Vec3::new(5.0, 0.0, 0.0))));
            (sum, squares, products) = (sum + a, squares + a * a, products + a * b);
        }
        let [mean, variance, covariance] = [sum, squares, products].map(|x| x / f64::from(N));
        assert!(mean.abs() < 0.01 && (0.04..0.12).contains(&variance), "{mean} {variance}");
        assert!(covariance.abs() < 0.05 * variance, "{covariance}");
    }
}
