//! The choice of one of many lights.
//!
//! Direct light is a sum over all lights; one of them, chosen with chance P, estimates it by its contribution / P. The
//! nearer P is to the share of the contribution, the less noise. [`LightSelection`] lists the ways to choose.
//!
//! Shirley, Wang & Zimmerman 1996, "Monte Carlo Techniques for Direct Lighting Calculations", doi:10.1145/226150.226151,
//! and for the tree Conty Estevez & Kulla 2018, doi:10.1145/3233305.

mod bounds;
mod build;
mod cluster;
mod cone;
mod discrete;
mod emitter;
mod tree;

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use bounds::LightBounds;
use cluster::Cluster;
use discrete::Discrete;
use emitter::Emitters;
use tree::Tree;

use crate::math::{BELOW_ONE, mix};

/// How one of the lights is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LightSelection {
    /// Each with the same chance.
    Uniform,
    /// In proportion to its power.
    Power,
    /// By what it may send to the point, as its power, distance and directions tell: a tree of lights.
    #[default]
    Tree,
}

/// The lights of a scene, ready to choose from.
#[derive(Clone, Debug)]
pub struct LightSelector {
    /// All of the lights together: the first of four.
    all: Option<Emitters>,
    choice: Choice,
}

#[derive(Clone, Debug)]
enum Choice {
    /// There is but one.
    Only(u32),
    Discrete(Discrete),
    Tree(Tree),
}

/// A light that was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelectedLight {
    /// Which of the lights.
    pub index: u32,
    /// The chance of it, above 0.
    pub pmf: f32,
    /// What is left of the random number: uniform in [0, 1), whatever was chosen.
    pub uc: f32,
}

impl LightSelector {
    /// Lights of power 0 are never chosen.
    pub fn new(selection: LightSelection, lights: &[LightBounds]) -> Self {
        let clusters = || lights.iter().map(|light| (light.power > 0.0).then(|| Cluster::new(light)));
        let mut on = (0..).zip(lights).filter(|(_, light)| light.power > 0.0).map(|(index, _)| index);
        let only = on.next().filter(|_| on.next().is_none());
        let choice = match (only, selection) {
            (Some(only), _) => Choice::Only(only),
            (None, LightSelection::Uniform) => {
                Choice::Discrete(Discrete::new(lights.iter().map(|light| f32::from(u8::from(light.power > 0.0)))))
            }
            (None, LightSelection::Power) => Choice::Discrete(Discrete::new(lights.iter().map(|light| light.power))),
            (None, LightSelection::Tree) => Choice::Tree(Tree::new(clusters())),
        };
        let all = clusters().flatten().reduce(Cluster::union);
        Self { all: all.map(|all| Emitters::new(&[all], 1.0)), choice }
    }

    /// Chooses a light for the point `p` with unit normal `n` by the random number `uc` in [0, 1).
    ///
    /// Which way the normal points does not matter, as light may go through a surface. A point without a surface has
    /// `Vec3::ZERO`. `None` means that the light of the scene that `uc` stands for cannot reach `p`: it counts as 0.
    #[inline]
    pub fn sample(&self, p: Vec3, n: Vec3, uc: f32) -> Option<SelectedLight> {
        let u = || refine(uc, p);
        let (index, pmf, rest) = match &self.choice {
            Choice::Only(index) => return Some(SelectedLight { index: *index, pmf: 1.0, uc }),
            Choice::Discrete(discrete) => discrete.sample(u())?,
            Choice::Tree(tree) => tree.sample(p, n, u())?,
        };
        let pmf = pmf as f32;
        (pmf > 0.0).then_some(SelectedLight { index, pmf, uc: (rest as f32).clamp(0.0, BELOW_ONE) })
    }

    /// The chance that [`sample`](Self::sample) chooses this light, to the bit; 0 where it cannot reach `p`.
    #[inline]
    pub fn pmf(&self, p: Vec3, n: Vec3, index: u32) -> f32 {
        match &self.choice {
            Choice::Only(only) => f32::from(u8::from(index == *only)),
            Choice::Discrete(discrete) => discrete.pmf(index) as f32,
            Choice::Tree(tree) => tree.pmf(p, n, index) as f32,
        }
    }

    /// An estimate of the irradiance that all lights send to `p`, in the unit of their power per square metre (W / m²).
    ///
    /// For one small light it is what arrives if nothing is in between; for many, seen as one from where they
    /// are, it tends to be more. It is 0 only where nothing can arrive. An environment of radiance L sends π L.
    #[inline]
    pub fn importance(&self, p: Vec3, n: Vec3) -> f32 {
        self.all.map_or(0.0, |all| all.irradiance(p, n).min(f64::from(f32::MAX)) as f32)
    }
}

/// `uc` in double precision. Its 24 bits are too few to choose among millions of lights and leave anything over, so
/// the bits below are made up, from it and the point.
#[inline]
fn refine(uc: f32, p: Vec3) -> f64 {
    const SCALE: f64 = 1.0 / (1_u64 << 52) as f64;
    let [a, b, c, d] = [uc, p.x, p.y, p.z].map(|x| u64::from(x.to_bits()));
    let hash = mix(mix(a << 32 | b) ^ (c << 32 | d));
    f64::from(uc) + (hash >> 36) as f64 * SCALE
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::sampling::uniform_sphere;
    use crate::testing::chi2_counts;
    use glam::UVec2;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;
    use std::f32::consts::PI;

    const SELECTIONS: [LightSelection; 3] = [LightSelection::Uniform, LightSelection::Power, LightSelection::Tree];

    fn numbers(seed: u64, i: u32) -> Independent {
        Independent::new(seed, UVec2::ZERO, i)
    }

    /// A light of any kind, in a room of 10 m; one in eight is off.
    fn light(seed: u64, i: u32) -> LightBounds {
        let mut numbers = numbers(seed, i);
        let (p, axis) = (5.0 * uniform_sphere(numbers.get_2d()) * numbers.get_1d(), uniform_sphere(numbers.get_2d()));
        let (size, power) = (numbers.get_1d().powi(3), numbers.get_1d() * 10.0);
        let power = if i % 8 == 7 { 0.0 } else { power };
        match i % 4 {
            0 => LightBounds::sphere(p, size, power),
            1 => LightBounds::flat_two_sided(p, p + size, axis, power),
            2 => LightBounds { cos_theta_e: 0.5, ..LightBounds::flat(p, p + size, axis, power) },
            _ => LightBounds::flat(p, p + size, axis, power),
        }
    }

    fn lights(seed: u64, n: u32) -> Vec<LightBounds> {
        (0..n).map(|i| light(seed, i)).collect()
    }

    /// The sum of all chances.
    fn sum(selector: &LightSelector, n: u32, p: Vec3, normal: Vec3) -> f64 {
        (0..n).map(|i| f64::from(selector.pmf(p, normal, i))).sum()
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        /// Chances are fair, and a sample knows its own to the bit.
        #[test]
        fn chances_sum_to_1(
            seed in 0_u64..1000,
            n in 2_u32..60,
            p in prop::array::uniform3(-8.0f32..8.0),
            normal in prop::array::uniform3(-1.0f32..1.0),
            uc in prop::collection::vec(0_u32..1 << 24, 20),
        ) {
            let (p, normal) = (Vec3::from(p), Vec3::from(normal).normalize_or_zero());
            let lights = lights(seed, n);
            for selection in SELECTIONS {
                let selector = LightSelector::new(selection, &lights);
                let sum = sum(&selector, n, p, normal);
                // The tree may end where no light of a group shines.
                prop_assert!(sum < 1.0 + 1e-5 && (sum > 1.0 - 1e-5 || selection == LightSelection::Tree), "{}", sum);
                for &uc in &uc {
                    let Some(s) = selector.sample(p, normal, uc as f32 / (1 << 24) as f32) else { continue };
                    prop_assert_eq!(s.pmf.to_bits(), selector.pmf(p, normal, s.index).to_bits());
                    prop_assert!(s.pmf > 0.0 && lights[s.index as usize].power > 0.0 && (0.0..1.0).contains(&s.uc));
                }
            }
        }

        /// Lamps that shine in all directions are never ruled out, so nothing is lost on the way down the tree.
        #[test]
        fn the_tree_loses_nothing(seed in 0_u64..1000, n in 1_u32..60, p in prop::array::uniform3(-8.0f32..8.0)) {
            let all = |i| LightBounds { power: 1.0, ..light(seed, 4 * i) };
            let selector = LightSelector::new(LightSelection::Tree, &(0..n).map(all).collect::<Vec<_>>());
            prop_assert!((sum(&selector, n, p.into(), Vec3::Y) - 1.0).abs() < 1e-5);
        }
    }

    /// Chi² of lights and of the rest of the number, together: what is left says nothing about what was chosen.
    #[test]
    fn samples_follow_the_chances() {
        const BINS: usize = 4;
        const N: u32 = 200_000;
        let lights = lights(3, 100);
        for selection in SELECTIONS {
            let selector = LightSelector::new(selection, &lights);
            for (p, n) in [(Vec3::new(1.0, -2.0, 3.0), Vec3::Y), (Vec3::new(-40.0, 9.0, 0.0), Vec3::ZERO)] {
                let mut counts = vec![0_u64; BINS * lights.len() + 1];
                for i in 0..N {
                    let bin = match selector.sample(p, n, numbers(4, i).get_1d()) {
                        Some(s) => s.index as usize * BINS + (s.uc * BINS as f32) as usize,
                        None => BINS * lights.len(),
                    };
                    counts[bin] += 1;
                }
                let chance = |i| f64::from(selector.pmf(p, n, i as u32)) * f64::from(N);
                let mut expected: Vec<f64> = (0..BINS * lights.len()).map(|k| chance(k / BINS) / BINS as f64).collect();
                expected.push(f64::from(N) - expected.iter().sum::<f64>());
                expected.iter_mut().for_each(|e| *e = e.max(0.0));
                chi2_counts(&counts, &expected).unwrap();
            }
        }
    }

    /// To the last bits, though the choice among many lights takes half of those that a number has.
    #[test]
    fn what_is_left_is_uniform() {
        let lights: Vec<_> = (0..4096).map(|i| LightBounds { power: 1.0, ..light(6, 4 * i) }).collect();
        for selection in SELECTIONS {
            let selector = LightSelector::new(selection, &lights);
            let mut counts = [[0_u64; 64]; 2];
            for i in 0..50_000 {
                let s = selector.sample(Vec3::new(1.0, 2.0, 3.0), Vec3::Y, numbers(7, i).get_1d()).unwrap();
                counts[0][(s.uc * 64.0) as usize] += 1;
                counts[1][((s.uc * 65536.0).fract() * 64.0) as usize] += 1;
            }
            counts.iter().for_each(|counts| chi2_counts(counts, &[50_000.0 / 64.0; 64]).unwrap());
        }
    }

    #[test]
    fn degenerate_scenes() {
        let (p, n) = (Vec3::new(1.0, 2.0, 3.0), Vec3::Y);
        let off = LightBounds::sphere(Vec3::ZERO, 1.0, 0.0);
        let on = LightBounds { power: 2.0, ..off };
        for selection in SELECTIONS {
            for dark in [&[][..], &[off, off]] {
                let selector = LightSelector::new(selection, dark);
                assert!(selector.sample(p, n, 0.3).is_none() && selector.importance(p, n) == 0.0);
                assert_eq!(selector.pmf(p, n, 0), 0.0);
            }
            let one = LightSelector::new(selection, &[off, on, off]);
            let sample = one.sample(p, n, 0.25).unwrap();
            assert!(sample.index == 1 && sample.pmf == 1.0 && (sample.uc - 0.25).abs() < 1e-6);
            let same = LightSelector::new(selection, &[on; 8]);
            for at in [p, Vec3::ZERO, 1e15 * p, -1e30 * p] {
                assert!((0..8).all(|i| same.pmf(at, n, i) == 0.125), "{selection:?} at {at}");
            }
        }
        let away = [LightBounds::flat(Vec3::ZERO, Vec3::X, Vec3::NEG_Y, 1.0); 2];
        let away = LightSelector::new(LightSelection::Tree, &away);
        assert!(away.sample(9.0 * Vec3::Y, n, 0.5).is_none() && away.pmf(9.0 * Vec3::Y, n, 0) == 0.0);
    }

    /// A floor under a thousand small lamps, some of them a thousand times as strong as others: the variance of
    /// contribution / pmf, exactly, as a sum over all lamps.
    #[test]
    fn the_tree_has_much_less_noise() {
        let lamps: Vec<LightBounds> = (0..1000)
            .map(|i| {
                let mut numbers = numbers(8, i);
                let place = 20.0 * numbers.get_2d() - 10.0;
                let corner = Vec3::new(place.x, 0.5 + 3.0 * numbers.get_1d(), place.y);
                let power = 1000_f32.powf(numbers.get_1d());
                LightBounds::flat(corner, corner + Vec3::new(0.05, 0.0, 0.05), Vec3::NEG_Y, power)
            })
            .collect();
        let irradiance = |lamp: &LightBounds, p: Vec3| {
            let to_lamp = 0.5 * (lamp.lo + lamp.hi) - p;
            f64::from(lamp.power / PI * to_lamp.y * to_lamp.y / to_lamp.length_squared().powi(2))
        };
        let variance = |selection| -> f64 {
            let selector = LightSelector::new(selection, &lamps);
            let at = |p: Vec3| {
                let contributions: Vec<f64> = lamps.iter().map(|lamp| irradiance(lamp, p)).collect();
                let pmf = |i: usize| f64::from(selector.pmf(p, Vec3::Y, i as u32));
                let second: f64 = contributions.iter().enumerate().map(|(i, c)| c * c / pmf(i)).sum();
                // Relative to what is seen, as an eye would.
                second / contributions.iter().sum::<f64>().powi(2) - 1.0
            };
            (0..100).map(|i| at(Vec3::new((i % 10) as f32 * 2.0 - 9.0, 0.0, (i / 10) as f32 * 2.0 - 9.0))).sum()
        };
        let [uniform, power, tree] = SELECTIONS.map(variance);

        assert!(uniform > 5.0 * tree && power > 5.0 * tree, "{uniform}, {power}, {tree}");
    }
}
