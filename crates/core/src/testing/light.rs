//! What a light promises.

use std::f64::consts::TAU;

use glam::{UVec2, Vec2, Vec3};

use super::SIGNIFICANCE;
use super::cells::{Cell, Point};
use super::chi2::chi2_at;
use super::image::Estimate;
use crate::color::{Rgb, Spectrum};
use crate::light::LightSample;
use crate::math::Frame;
use crate::sampler::Independent;

/// A light as a point sees it.
pub trait LightSampling: Sync {
    /// Draws a direction from which it shines on `p`; none if it does not, or if it is never sampled.
    fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample>;

    /// The density per solid angle with which [`sample`](Self::sample) draws the unit direction `wi`, 1/sr; 0 for a light
    /// without size.
    fn pdf(&self, p: Vec3, wi: Vec3) -> f32;

    /// Radiance that it sends to `p` from the unit direction `wi` if nothing is in between; 0 for a light without size.
    fn le(&self, p: Vec3, wi: Vec3) -> Spectrum;
}

/// All that a light with a size promises, as seen from each of some points: directions follow the density per solid angle
/// (chi²), which integrates to the chance that any is drawn; a sample knows its density and radiance; and what samples
/// find, radiance / density, is what uniform directions find.
///
/// # Errors
/// The first promise that is broken.
pub fn check_light(light: &dyn LightSampling, points: &[Vec3]) -> Result<(), String> {
    for &p in points {
        let seen = View::new(light, p);
        let check = || {
            seen.check_samples()?;
            seen.check_density(SIGNIFICANCE / points.len() as f64)?;
            seen.check_light_found(2 * points.len() as u32)
        };
        check().map_err(|e| format!("from {p}: {e}"))?;
    }
    Ok(())
}

/// A light from a point. In its frame x is the middle of the light and z the way in which it is least wide, so that cosine
/// and azimuth box it in tightly, also where it is a strip.
struct View<'l> {
    light: &'l dyn LightSampling,
    p: Vec3,
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

impl<'l> View<'l> {
    fn new(light: &'l dyn LightSampling, p: Vec3) -> Self {
        let directions: Vec<_> = (0..200).filter_map(|i| light.sample(p, numbers(20, i))).map(|s| s.wi).collect();
        let middle = directions.iter().sum::<Vec3>().try_normalize().unwrap_or(Vec3::X);
        let across = Frame::from_z(middle);
        // The axes of the ellipse that the directions fill: its angle is half that of the sum of squares.
        let squares = directions.iter().map(|&w| {
            let w = across.to_local(w);
            Vec2::new(w.x * w.x - w.y * w.y, 2.0 * w.x * w.y)
        });
        let square = squares.sum::<Vec2>();
        let (sin, cos) = (0.5 * square.y.atan2(square.x)).sin_cos();
        let y = across.to_world(Vec3::new(cos, sin, 0.0));
        Self { light, p, x: middle, y, z: middle.cross(y) }
    }

    fn samples(&self, seed: u64, count: u32) -> impl Iterator<Item = LightSample> {
        (0..count).filter_map(move |i| self.light.sample(self.p, numbers(seed, i)))
    }

    fn point(&self, w: Vec3) -> Point {
        let [x, y, z] = [self.x, self.y, self.z].map(|axis| f64::from(w.dot(axis)));
        [z.clamp(-1.0, 1.0), y.atan2(x) / TAU]
    }

    fn direction(&self, [z, turn]: Point) -> Vec3 {
        let r = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (turn * TAU).sin_cos();
        ((r * cos) as f32 * self.x + (r * sin) as f32 * self.y + z as f32 * self.z).normalize()
    }

    fn check_samples(&self) -> Result<(), String> {
        let close = |a: f32, b: f32| (a - b).abs() <= 0.02 * a.abs().max(b.abs());
        let (mut count, mut unseen) = (0.0, 0.0);
        for s in self.samples(21, 2000) {
            if (s.wi.length() - 1.0).abs() > 1e-5 || !(s.pdf > 0.0 && s.pdf.is_finite()) || s.delta {
                return Err(format!("{s:?} is no sample of a light with a size"));
            }
            count += 1.0;
            let (pdf, le) = (self.light.pdf(self.p, s.wi), self.light.le(self.p, s.wi));
            // Rounded, a direction to the edge may be one past it.
            if pdf == 0.0 {
                unseen += 1.0;
            } else if !close(pdf, s.pdf) {
                return Err(format!("sample says density {}, pdf says {pdf}", s.pdf));
            } else if !close(luminance(le), luminance(s.l)) {
                return Err(format!("sample says radiance {:?}, le says {le:?}", s.l));
            }
        }
        if unseen > 0.01 * count { Err(format!("{unseen} of {count} directions miss the light")) } else { Ok(()) }
    }

    fn check_density(&self, significance: f64) -> Result<(), String> {
        const SAMPLES: u32 = 20_000;
        let layout = self.samples(22, 5000).map(|s| self.point(s.wi)).collect();
        let points: Vec<_> = self.samples(23, SAMPLES).map(|s| self.point(s.wi)).collect();
        let drawn = points.len() as f64;
        let density = |point: Point| TAU * f64::from(self.light.pdf(self.p, self.direction(point)));
        let bins = Cell::SPHERE.divide(layout, points, 1e-4, &density);
        let chance: f64 = bins.iter().map(|bin| bin.1).sum();
        let noise = (chance * (1.0 - chance).max(0.0) / f64::from(SAMPLES)).sqrt();
        if (drawn / f64::from(SAMPLES) - chance).abs() > 5.0 * noise + 5e-3 {
            return Err(format!("{drawn} of {SAMPLES} samples are drawn, but the density integrates to {chance}"));
        }
        let (observed, expected): (Vec<_>, Vec<_>) =
            bins.into_iter().map(|(count, integral)| (count, integral / chance.max(1e-9) * drawn)).unzip();
        chi2_at(&observed, &expected, significance)
    }

    /// Irradiance of a surface that faces the light, as far as the light can be sampled: by its samples, and by uniform
    /// directions around all of them.
    fn check_light_found(&self, tests: u32) -> Result<(), String> {
        const GROUPS: u32 = 100;
        const SIZE: u32 = 400;
        let [lo, hi] = self.bounds();
        let facing = |w: Vec3| f64::from(w.dot(self.x).max(0.0));
        let led = |u: Vec2| {
            let sample = self.light.sample(self.p, u);
            sample.map_or(0.0, |s| luminance64(s.l) * facing(s.wi) / f64::from(s.pdf))
        };
        let solid_angle = (hi[0] - lo[0]) * (hi[1] - lo[1]) * TAU;
        let uniform = |u: Vec2| {
            let at = |axis: usize| lo[axis] + f64::from(u[axis]) * (hi[axis] - lo[axis]);
            let w = self.direction([at(0), at(1)]);
            let found = if self.light.pdf(self.p, w) > 0.0 { self.light.le(self.p, w) } else { Spectrum::BLACK };
            luminance64(found) * facing(w) * solid_angle
        };
        let mean = |seed: u64, f: &dyn Fn(Vec2) -> f64| {
            let group = |g| (0..SIZE).map(|i| f(numbers(seed, g * SIZE + i))).sum::<f64>() / f64::from(SIZE);
            Estimate::new(&(0..GROUPS).map(group).collect::<Vec<_>>())
        };
        let (led, uniform) = (mean(25, &led), mean(26, &uniform));
        let both = Estimate { standard_error: led.standard_error.hypot(uniform.standard_error), ..led };
        both.z_test(uniform.mean, 1e-3, tests).map_err(|e| format!("irradiance by samples: {e}, by uniform directions"))
    }

    /// A box of directions around all samples, a fifth larger to each side.
    fn bounds(&self) -> [Point; 2] {
        let points = self.samples(24, 2000).map(|s| self.point(s.wi));
        let [lo, hi] = points.fold([[1.0, 0.5], [-1.0, -0.5]], |[lo, hi], p| {
            [[0, 1].map(|i: usize| p[i].min(lo[i])), [0, 1].map(|i: usize| p[i].max(hi[i]))]
        });
        let margin = [0, 1].map(|i: usize| 0.2 * (hi[i] - lo[i]).max(0.0));
        let lo = [(lo[0] - margin[0]).max(-1.0), (lo[1] - margin[1]).max(-0.5)];
        [lo, [(hi[0] + margin[0]).min(1.0), (hi[1] + margin[1]).min(0.5)]]
    }
}

fn numbers(seed: u64, i: u32) -> Vec2 {
    Independent::new(seed, UVec2::ZERO, i).get_2d()
}

fn luminance(l: Spectrum) -> f32 {
    Rgb(l.to_rgb()).luminance()
}

fn luminance64(l: Spectrum) -> f64 {
    f64::from(luminance(l))
}
