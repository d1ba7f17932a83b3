//! The shape of a lens's aperture, which highlights out of focus show: a disk, or a regular polygon of blades.
//!
//! A polygon is n triangles between its centre and a side: the first number chooses the triangle and, by what is left of
//! it, the distance from the centre, √u as areas grow with its square; the second number chooses the place across. The corners
//! lie on the disk's rim, and the middle of the first side to the right, as in Blender's Cycles: fewer blades make a
//! smaller opening. An anamorphic lens is narrower by its ratio.
//!
//! ```toml
//! [camera]
//! aperture = 0.2
//! [camera.bokeh]
//! blades = 6
//! rotation = 15
//! ratio = 1.5
//! ```

use glam::Vec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::sin_cos_turns;
use crate::sampling::uniform_disk;
use crate::validate::Checker;

/// What a point out of focus looks like: `[camera.bokeh]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BokehDesc {
    /// Blades of the aperture, and corners of its opening: 3 to 100; 0 is a disk.
    #[schemars(range(min = 0, max = 100))]
    pub blades: u32,
    /// How far the blades are turned, degrees, counter-clockwise in what lies behind the plane in focus.
    pub rotation: f32,
    /// How many times as high as wide the opening is, 0.01..100, as in an anamorphic lens. The height stays.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub ratio: f32,
}

impl Default for BokehDesc {
    /// A disk.
    fn default() -> Self {
        Self { blades: 0, rotation: 0.0, ratio: 1.0 }
    }
}

impl BokehDesc {
    const MAX_BLADES: u32 = 100;

    pub(super) fn check(&self, c: &mut Checker) {
        if self.blades != 0 && !(3..=Self::MAX_BLADES).contains(&self.blades) {
            c.problem(
                "blades",
                format!("`blades` must be 0 or from 3 to {}, not {}", Self::MAX_BLADES, self.blades),
                Some("6 blades make a hexagon, 0 a disk".to_owned()),
            );
        }
        c.finite("rotation", &[self.rotation]);
        c.in_range("ratio", self.ratio, 0.01, 100.0);
    }
}

/// The opening within the unit circle, x to the right and y down.
#[derive(Clone, Copy, Debug)]
pub(super) enum Aperture {
    Disk,
    Polygon {
        blades: f32,
        /// From the right to the middle of the first side, clockwise in turns, less than one side.
        rotation: f32,
        /// From the centre to the middle of a side.
        apothem: f32,
        half_side: f32,
    },
}

impl Aperture {
    pub(super) fn new(desc: &BokehDesc) -> Self {
        if desc.blades == 0 {
            return Self::Disk;
        }
        let side = 1.0 / f64::from(desc.blades);
        let (half_side, apothem) = sin_cos_turns(0.5 * side as f32);
        let rotation = (-f64::from(desc.rotation) / 360.0).rem_euclid(side) as f32;
        Self::Polygon { blades: desc.blades as f32, rotation, apothem, half_side }
    }

    /// A uniform point of it.
    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> Vec2 {
        match *self {
            Self::Disk => uniform_disk(u),
            Self::Polygon { blades, rotation, apothem, half_side } => {
                let blade = (u.x * blades).floor();
                let r = (u.x * blades - blade).sqrt();
                let p = r * Vec2::new(apothem, half_side * (2.0 * u.y - 1.0));
                let (sin, cos) = sin_cos_turns(blade / blades + rotation);
                Vec2::new(cos, sin).rotate(p)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;
    use glam::UVec2;

    const N: u32 = 100_000;

    fn points(blades: u32, rotation: f32) -> impl Iterator<Item = Vec2> {
        let aperture = Aperture::new(&BokehDesc { blades, rotation, ratio: 1.0 });
        (0..N).map(move |i| aperture.sample(Independent::new(5, UVec2::ZERO, i).get_2d()))
    }

    /// How far a point lies beyond the nearest side of a polygon.
    fn beyond(p: Vec2, blades: u32, rotation: f32) -> f32 {
        let angle = |side: u32| (360.0 * side as f32 / blades as f32 + rotation).to_radians();
        let sides = (0..blades).map(angle).map(|a| p.dot(Vec2::new(a.cos(), -a.sin())));
        sides.fold(-1.0, f32::max) - (std::f32::consts::PI / blades as f32).cos()
    }

    /// Counts in the cells of a grid over the square around the unit circle.
    fn histogram(points: impl Iterator<Item = Vec2>, cells: usize) -> Vec<u64> {
        let mut counts = vec![0; cells * cells];
        for p in points {
            let cell = ((p * 0.5 + 0.5) * cells as f32).clamp(Vec2::ZERO, Vec2::splat(cells as f32 - 1.0)).as_uvec2();
            counts[cell.y as usize * cells + cell.x as usize] += 1;
        }
        counts
    }

    /// Against the share of a fine grid's points that lie inside.
    #[test]
    fn polygons_are_filled_uniformly() {
        const CELLS: usize = 20;
        const FINE: usize = 30 * CELLS;
        for (blades, rotation) in [(3, 0.0), (4, 45.0), (5, 90.0), (6, -20.0), (9, 1000.0), (100, 7.0)] {
            assert!(points(blades, rotation).all(|p| beyond(p, blades, rotation) < 1e-5), "{blades} blades");
            let fine = (0..FINE * FINE).map(|i| Vec2::new((i % FINE) as f32 + 0.5, (i / FINE) as f32 + 0.5));
            let inside = fine.map(|p| p * 2.0 / FINE as f32 - 1.0).filter(|&p| beyond(p, blades, rotation) < 0.0);
            let inside = histogram(inside, CELLS);
            let scale = f64::from(N) / inside.iter().sum::<u64>() as f64;
            let expected: Vec<_> = inside.iter().map(|&n| n as f64 * scale).collect();
            chi2_counts(&histogram(points(blades, rotation), CELLS), &expected)
                .unwrap_or_else(|e| panic!("{blades} blades: {e}"));
        }
    }

    /// A triangle's side stands at its right; a quarter turn counter-clockwise brings it to the top.
    #[test]
    fn rotation_is_counter_clockwise() {
        let [lo, hi] = [f32::min, f32::max].map(|pick| points(3, 0.0).map(|p| p.x).reduce(pick).unwrap());
        assert!((lo + 1.0).abs() < 0.02 && (hi - 0.5).abs() < 0.01, "{lo}..{hi}");
        let [top, bottom] = [f32::min, f32::max].map(|pick| points(3, 90.0).map(|p| p.y).reduce(pick).unwrap());
        assert!((top + 0.5).abs() < 0.01 && (bottom - 1.0).abs() < 0.02, "{top}..{bottom}");
    }

    #[test]
    fn neighbours_stay_together() {
        let aperture = Aperture::new(&BokehDesc { blades: 5, ..BokehDesc::default() });
        for i in 0..1000 {
            let (u, blade) = (Independent::new(6, UVec2::ZERO, i).get_2d(), (i % 5) as f32);
            let at = |x: f32, y: f32| aperture.sample(Vec2::new((blade + x) / 5.0, y));
            let (x, y) = (0.01 + 0.98 * u.x, 0.99 * u.y);
            assert!(at(x, y).distance(at(x + 1e-3, y + 1e-3)) < 1e-2);
        }
    }

    #[test]
    fn no_blades_are_a_disk() {
        for i in 0..100 {
            let u = Independent::new(7, UVec2::ZERO, i).get_2d();
            assert_eq!(Aperture::new(&BokehDesc::default()).sample(u), uniform_disk(u));
        }
    }

    /// The largest numbers below 1 leave no polygon.
    #[test]
    fn ends_of_the_unit_square() {
        let last = 1.0_f32.next_down();
        for blades in 3..=BokehDesc::MAX_BLADES {
            let aperture = Aperture::new(&BokehDesc { blades, ..BokehDesc::default() });
            for u in [Vec2::ZERO, Vec2::splat(last), Vec2::new(0.0, last), Vec2::new(last, 0.0)] {
                assert!(beyond(aperture.sample(u), blades, 0.0) < 1e-5, "{blades} blades, {u}");
            }
        }
    }
}
