//! Light from all around as a picture of latitude and longitude, looked up and sampled as one function.
//!
//! Pixel (x, y) of w × h is the radiance from the direction of u = (x + ½) / w, v = (y + ½) / h:
//!
//! d = (sin φ sin θ, cos θ, −cos φ sin θ), φ = 2π u, θ = π v.
//!
//! Row 0 is straight above, and u = 0 looks along −z. Between pixels radiance is interpolated bilinearly, and directions are
//! drawn from the same bilinear patches: a patch by its integral, a place in it by its four corners (Pharr, Jakob &
//! Humphreys, Physically Based Rendering, 4th ed. 2023, §A.5.1 and §12.5), so that a sun in a single pixel is sampled as it
//! is looked up.
//!
//! What is sampled is not the radiance L but max(0, L − mean L): what is left is found well enough by surfaces' own
//! directions. MIS compensation: Karlík et al. 2019, doi:10.1145/3355089.3356565.

use std::f32::consts::{FRAC_1_PI, PI, TAU};
use std::sync::Arc;

use glam::{Vec2, Vec3};

use crate::color::{Rgb, Spectrum};
use crate::film::Image;
use crate::math::{BELOW_ONE, sin_cos_turns};

/// How light from all around is found. The picture is the same, the noise is not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EnvironmentSampling {
    /// Compensated if it is uneven, never if it is even.
    #[default]
    Auto,
    /// Directions in proportion to max(0, L − mean L).
    Compensated,
    /// Directions in proportion to L.
    Proportional,
    /// By the surfaces' own directions alone.
    Never,
}

/// A picture of the surroundings.
#[derive(Clone, Debug)]
pub(crate) struct LatLong {
    image: Arc<Image>,
    scale: f32,
    /// Sine and cosine of the angle about +y by which the picture is turned.
    turn: (f32, f32),
    /// Mean radiance over the sphere, not scaled.
    mean: Spectrum,
    distribution: Option<Distribution>,
}

/// Chances of the patches between the pixels' centres, and above the first and below the last row.
#[derive(Clone, Debug)]
struct Distribution {
    /// What is subtracted from luminances.
    floor: f32,
    /// For each row, what the weight at a place over sin θ is multiplied with to get the density there.
    density: Vec<f32>,
    /// Chance of all rows before each.
    rows: Vec<f32>,
    /// For each row, the chance in it of all patches before each.
    columns: Vec<f32>,
}

impl LatLong {
    /// The picture, turned about +y by `rotation` (radians, counter-clockwise seen from above).
    pub(crate) fn new(image: Arc<Image>, rotation: f32, scale: f32, sampling: EnvironmentSampling) -> Self {
        let turn = (libm::sinf(rotation), libm::cosf(rotation));
        let mut map = Self { image, scale, turn, mean: Spectrum::BLACK, distribution: None };
        let (mean, variance) = map.moments();
        map.mean = mean;
        let mean_luminance = Rgb(mean.to_rgb()).luminance();
        map.distribution = match sampling {
            EnvironmentSampling::Auto if variance <= Self::EVEN * mean_luminance * mean_luminance => None,
            EnvironmentSampling::Auto | EnvironmentSampling::Compensated => map.distribution(mean_luminance),
            EnvironmentSampling::Proportional => map.distribution(0.0),
            EnvironmentSampling::Never => None,
        };
        map
    }

    /// Light whose relative variance over the sphere is less is found as well by the surfaces' own directions: it is not
    /// sampled.
    const EVEN: f32 = 0.3;

    /// Whether [`sample`](Self::sample) draws anything.
    pub(crate) fn is_sampled(&self) -> bool {
        self.distribution.is_some()
    }

    /// Irradiance of a surface in the mean over all directions that it may face.
    pub(crate) fn mean_irradiance(&self) -> Spectrum {
        self.mean * (self.scale * PI)
    }

    /// Radiance from the unit direction `w`.
    #[inline]
    pub(crate) fn le(&self, w: Vec3) -> Spectrum {
        let (patch, f) = self.locate(self.uv(w));
        let [a, b, c, d] = self.corners(patch).map(Spectrum::from_rgb);
        a.lerp(b, f.x).lerp(c.lerp(d, f.x), f.y) * self.scale
    }

    /// A direction with its radiance and density (1/sr); none if nothing is drawn.
    #[inline]
    pub(crate) fn sample(&self, u: Vec2) -> Option<(Vec3, Spectrum, f32)> {
        let distribution = self.distribution.as_ref()?;
        let (row, v) = search(&distribution.rows, u.y);
        let (column, u) = search(distribution.row(row, self.width()), u.x);
        let [a, b, c, d] = self.weights(distribution, [column, row]);
        // The first and the last row are half as high, and even from top to bottom.
        let clipped = row == 0 || row == self.height();
        let y = if clipped { 0.5 * v + if row == 0 { 0.5 } else { 0.0 } } else { sample_linear(a + b, c + d, v) };
        let x = sample_linear(a + (c - a) * y, b + (d - b) * y, u);
        let uv =
            Vec2::new((column as f32 + 0.5 + x) / self.width() as f32, (row as f32 - 0.5 + y) / self.height() as f32);
        let w = self.direction(uv);
        let pdf = self.pdf(w);
        (pdf > 0.0).then(|| (w, self.le(w), pdf))
    }

    /// The density with which [`sample`](Self::sample) draws the unit direction `w`, 1/sr.
    #[inline]
    pub(crate) fn pdf(&self, w: Vec3) -> f32 {
        let Some(distribution) = &self.distribution else {
            return 0.0;
        };
        let (patch, f) = self.locate(self.uv(w));
        let [a, b, c, d] = self.weights(distribution, patch);
        let weight = (a + (b - a) * f.x) * (1.0 - f.y) + (c + (d - c) * f.x) * f.y;
        let sin_theta = (w.x * w.x + w.z * w.z).sqrt().max(1e-6);
        distribution.density[patch[1]] * weight / sin_theta
    }

    fn width(&self) -> usize {
        self.image.width() as usize
    }

    fn height(&self) -> usize {
        self.image.height() as usize
    }

    #[inline]
    fn uv(&self, w: Vec3) -> Vec2 {
        let (sin, cos) = self.turn;
        let (x, z) = (cos * w.x - sin * w.z, sin * w.x + cos * w.z);
        let turns = libm::atan2f(x, -z) * (0.5 * FRAC_1_PI);
        // Of the pole's angle, the arc sine of the distance to the axis keeps more digits.
        let sin_theta = (w.x * w.x + w.z * w.z).sqrt();
        let theta = libm::atan2f(sin_theta, w.y);
        Vec2::new(if turns < 0.0 { turns + 1.0 } else { turns }, theta * FRAC_1_PI)
    }

    #[inline]
    fn direction(&self, uv: Vec2) -> Vec3 {
        let ((sin_phi, cos_phi), (sin_theta, cos_theta)) = (sin_cos_turns(uv.x - 1.0), sin_cos_turns(0.5 * uv.y));
        let (x, z) = (sin_phi * sin_theta, -cos_phi * sin_theta);
        let (sin, cos) = self.turn;
        Vec3::new(cos * x + sin * z, cos_theta, cos * z - sin * x).normalize()
    }

    /// The patch at a place, and the place in it.
    #[inline]
    fn locate(&self, uv: Vec2) -> ([usize; 2], Vec2) {
        let x = uv.x * self.width() as f32 - 0.5;
        let y = uv.y * self.height() as f32 + 0.5;
        let (column, row) = (x.floor(), y.floor().clamp(0.0, self.height() as f32));
        let wrapped = if column < 0.0 { self.width() - 1 } else { (column as usize).min(self.width() - 1) };
        ([wrapped, row as usize], Vec2::new(x - column, (y - row).clamp(0.0, 1.0)))
    }

    /// The pixels at the corners of a patch: upper left, upper right, lower left, lower right.
    #[inline]
    fn corners(&self, [column, row]: [usize; 2]) -> [[f32; 3]; 4] {
        let (width, pixels) = (self.width(), self.image.pixels());
        let right = if column + 1 == width { 0 } else { column + 1 };
        let (above, below) = (row.saturating_sub(1) * width, row.min(self.height() - 1) * width);
        [pixels[above + column], pixels[above + right], pixels[below + column], pixels[below + right]]
    }

    #[inline]
    fn weights(&self, distribution: &Distribution, patch: [usize; 2]) -> [f32; 4] {
        self.corners(patch).map(|rgb| (Rgb(rgb).luminance() - distribution.floor).max(0.0))
    }

    /// Solid angle of a row of patches over 2π.
    fn row_angle(&self, row: usize) -> f32 {
        let edge = |k: f32| libm::cosf(PI * (k / self.height() as f32).clamp(0.0, 1.0));
        edge(row as f32 - 0.5) - edge(row as f32 + 0.5)
    }

    /// Mean radiance, and variance of the luminance, over the sphere.
    fn moments(&self) -> (Spectrum, f32) {
        let (mut sum, mut sum_sq, mut total) = ([0.0_f64; 3], 0.0, 0.0);
        for (y, row) in self.image.pixels().chunks(self.width()).enumerate() {
            let angle = f64::from(libm::sinf(PI * (y as f32 + 0.5) / self.height() as f32));
            for &rgb in row {
                sum.iter_mut().zip(rgb).for_each(|(sum, c)| *sum += f64::from(c) * angle);
                sum_sq += f64::from(Rgb(rgb).luminance()).powi(2) * angle;
            }
            total += angle * row.len() as f64;
        }
        let mean = Spectrum::from_rgb(sum.map(|s| (s / total) as f32));
        let luminance = f64::from(Rgb(mean.to_rgb()).luminance());
        (mean, (sum_sq / total - luminance * luminance).max(0.0) as f32)
    }

    fn distribution(&self, floor: f32) -> Option<Distribution> {
        let mut d = Distribution { floor, density: Vec::new(), rows: Vec::new(), columns: Vec::new() };
        let (mut sums, mut total) = (vec![0.0_f64], 0.0);
        for row in 0..=self.height() {
            let mut sum = 0.0;
            let start = d.columns.len();
            for column in 0..self.width() {
                d.columns.push(sum as f32);
                sum += self.weights(&d, [column, row]).into_iter().map(f64::from).sum::<f64>() / 4.0;
            }
            let scale = if sum > 0.0 { 1.0 / sum as f32 } else { 0.0 };
            d.columns[start..].iter_mut().for_each(|c| *c *= scale);
            total += f64::from(self.row_angle(row)) * sum;
            sums.push(total);
        }
        sums.pop();
        d.rows = sums.iter().map(|s| (s / total) as f32).collect();
        // A patch's chance is (row's angle) · (mean of its weights) / total; its area is that of the square of uv over w · h,
        // and half of that in the first and last row; dω = 2π² sin θ du dv.
        let patches = self.width() as f64 * self.height() as f64;
        let density = |row: usize| {
            let area = if row == 0 || row == self.height() { 0.5 } else { 1.0 } / patches;
            (f64::from(self.row_angle(row)) / (total * area * f64::from(TAU * PI))) as f32
        };
        d.density = (0..=self.height()).map(density).collect();
        (total > 0.0 && d.density.iter().all(|x| x.is_finite())).then_some(d)
    }
}

impl Distribution {
    fn row(&self, row: usize, width: usize) -> &[f32] {
        &self.columns[row * width..(row + 1) * width]
    }
}

/// The interval of a list of ascending chances that `u` falls into, and where in it, in [0, 1).
#[inline]
fn search(before: &[f32], u: f32) -> (usize, f32) {
    let index = before.partition_point(|&b| b <= u).saturating_sub(1);
    let end = before.get(index + 1).copied().unwrap_or(1.0);
    let width = end - before[index];
    (index, if width > 0.0 { ((u - before[index]) / width).clamp(0.0, BELOW_ONE) } else { 0.0 })
}

/// A place in 0..1 whose density goes linearly from `a` to `b`.
#[inline]
fn sample_linear(a: f32, b: f32, u: f32) -> f32 {
    if a + b <= 0.0 {
        return u;
    }
    let root = (a * a + (b * b - a * a) * u).max(0.0).sqrt();
    (u * (a + b) / (a + root).max(1e-30)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::EnvironmentSampling::{Auto, Compensated, Proportional};
    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;

    fn map(rotation: f32, sampling: EnvironmentSampling) -> LatLong {
        let mut image = Image::new(32, 16);
        for (x, y) in (0..16).flat_map(|y| (0..32).map(move |x| (x, y))) {
            let wave = 0.3 + 0.2 * (x as f32 * 0.4).sin() + y as f32 * 0.02;
            image.set_pixel(x, y, [wave, wave * 1.2, wave * 0.7]);
        }
        image.set_pixel(20, 4, [300.0, 280.0, 200.0]);
        image.set_pixel(3, 0, [20.0; 3]);
        image.set_pixel(31, 15, [30.0; 3]);
        LatLong::new(Arc::new(image), rotation, 2.0, sampling)
    }

    #[test]
    fn pixels_are_where_the_convention_says() {
        let map = map(0.0, Proportional);
        let at = |uv: Vec2| map.le(map.direction(uv)).to_rgb()[0];
        assert!((at(Vec2::new(20.5 / 32.0, 4.5 / 16.0)) - 600.0).abs() < 0.1);
        let mut image = Image::new(4, 3);
        image.set_pixel(1, 1, [1.0; 3]);
        let map = LatLong::new(Arc::new(image), 0.0, 1.0, Proportional);
        // The centre of pixel 1 of 4 is at φ = 135 degrees: +x and +z.
        let w = Vec3::new(1.0, 0.0, 1.0).normalize();
        assert!((map.le(w).to_rgb()[0] - 1.0).abs() < 1e-5);
    }

    /// Turned by 90 degrees, counter-clockwise from above, what was at +x is at −z.
    #[test]
    fn turns() {
        let mut image = Image::new(64, 3);
        (14..18).for_each(|x| image.set_pixel(x, 1, [1.0; 3]));
        let image = Arc::new(image);
        for (degrees, w) in [(0.0_f32, Vec3::X), (90.0, Vec3::NEG_Z), (180.0, Vec3::NEG_X)] {
            let map = LatLong::new(image.clone(), degrees.to_radians(), 1.0, Proportional);
            assert!((map.le(w).to_rgb()[0] - 1.0).abs() < 1e-4, "{degrees}");
            assert!((map.direction(map.uv(w)) - w).length() < 1e-5);
        }
    }

    /// Directions come as often as the density says, and the density integrates to 1.
    #[test]
    fn samples_follow_the_density() {
        const N: u32 = 200_000;
        const BINS: [usize; 2] = [64, 32];
        for (rotation, sampling) in [(0.0, Proportional), (1.0, Compensated)] {
            let map = map(rotation, sampling);
            let mut counts = vec![0_u64; BINS[0] * BINS[1]];
            let bin = |uv: Vec2| {
                let [x, y] = [(uv.x, BINS[0]), (uv.y, BINS[1])].map(|(c, n)| ((c * n as f32) as usize).min(n - 1));
                y * BINS[0] + x
            };
            let mut weight = 0.0;
            for i in 0..N {
                let (w, l, pdf) = map.sample(Independent::new(1, glam::UVec2::ZERO, i).get_2d()).unwrap();
                counts[bin(map.uv(w))] += 1;
                assert!(pdf > 0.0 && l == map.le(w) && (w.length() - 1.0).abs() < 1e-5);
                weight += f64::from(l.to_rgb()[0] / pdf) / f64::from(N);
            }
            // Midpoints of a fine grid.
            let mut expected = vec![0.0; counts.len()];
            let fine = 16;
            for (y, x) in (0..BINS[1] * fine).flat_map(|y| (0..BINS[0] * fine).map(move |x| (y, x))) {
                let uv =
                    Vec2::new((x as f32 + 0.5) / (BINS[0] * fine) as f32, (y as f32 + 0.5) / (BINS[1] * fine) as f32);
                let w = map.direction(uv);
                let area = 2.0 * std::f64::consts::PI.powi(2) * (std::f64::consts::PI * f64::from(uv.y)).sin()
                    / (BINS[0] * BINS[1] * fine * fine) as f64;
                expected[bin(uv)] += f64::from(map.pdf(w)) * area * f64::from(N);
            }
            let sum: f64 = expected.iter().sum::<f64>() / f64::from(N);
            assert!((sum - 1.0).abs() < 1e-3, "the density integrates to {sum}");
            chi2_counts(&counts, &expected).unwrap();
            // Without the floor the radiance over the density is the integral of the radiance.
            let integral = f64::from(map.mean_irradiance().to_rgb()[0]) * 4.0;
            assert!(sampling == Compensated || (weight / integral - 1.0).abs() < 0.02, "{weight}, not {integral}");
        }
    }

    #[test]
    fn even_light_is_not_sampled() {
        let mut image = Image::new(8, 4);
        (0..32).for_each(|i| image.set_pixel(i % 8, i / 8, [1.0 + 0.3 * (i % 3) as f32; 3]));
        let map = LatLong::new(Arc::new(image), 0.0, 1.0, Auto);
        assert!(!map.is_sampled() && map.sample(Vec2::splat(0.5)).is_none() && map.pdf(Vec3::X) == 0.0);
    }

    #[test]
    fn one_pixel_and_black_pictures_work() {
        let mut image = Image::new(1, 1);
        for value in [0.0, 5.0] {
            image.set_pixel(0, 0, [value; 3]);
            let map = LatLong::new(Arc::new(image.clone()), 0.3, 1.0, Auto);
            for w in [Vec3::X, Vec3::Y, Vec3::NEG_Y, Vec3::NEG_Z] {
                assert!((map.le(w).to_rgb()[0] - value).abs() < 1e-6 && map.pdf(w) == 0.0);
            }
        }
    }
}
