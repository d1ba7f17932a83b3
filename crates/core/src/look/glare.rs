//! Bloom: light that the lens or the eye scatters on its way to the picture, as a glow around what is bright.
//!
//! The picture L becomes (1 − share) L + share · L ∗ g with a glare point spread function g that falls off as that of the human eye:
//! Spencer, Shirley, Zimmerman & Greenberg, "Physically-Based Glare Effects for Digital Images", 1995,
//! doi:10.1145/218380.218466, find terms in θ⁻³ and θ⁻² of energy 0.478 and 0.138. Here they are sums of round Gaussians
//! whose widths σ double from 1/512 to 1/8 of the picture's height, so that a glow is the same at every resolution:
//!
//! ```text
//! g = Σ w(σ) G(σ),   w ∝ 0.776 · (1/σ) / Σ (1/σ) + 0.224 · 1/7
//! ```
//!
//! as Gaussians of energy w have the height w / σ² at the distance σ. No light is lost: what would leave the picture is
//! mirrored at its edge. A Gaussian is three boxes with fractional edges one after the other (Gwosdek, Grewenig, Bruhn &
//! Weickert, "Theoretical Foundations of Gaussian Convolution by Extended Box Filtering", 2011,
//! doi:10.1007/978-3-642-24785-9_38), each a running sum whose cost does not depend on its width.

use crate::film::{Image, Wrap};

/// How many Gaussians.
const LEVELS: usize = 7;
/// The narrowest, in heights of the picture.
const NARROWEST: f64 = 1.0 / 512.0;
/// The share of light in the steeper term.
const STEEP: f64 = 0.478 / (0.478 + 0.138);
/// Boxes of a Gaussian.
const BOXES: u32 = 3;

type Pixel = [f32; 3];

/// Scatters a share of the light; alpha stays.
pub(super) fn scatter(image: &mut Image, share: f32) {
    let size = [image.width() as usize, image.height() as usize];
    if size[0] * size[1] == 0 {
        return;
    }
    let mut blurred = image.pixels().to_vec();
    let mut spare = blurred.clone();
    image.pixels_mut().as_flattened_mut().iter_mut().for_each(|c| *c *= 1.0 - share);
    let mut variance = 0.0;
    for (sigma, weight) in gaussians(size[1]) {
        // The wider ones are made of the narrower ones.
        let spread = Spread::new((sigma * sigma - variance) / f64::from(BOXES));
        variance = sigma * sigma;
        for _ in 0..BOXES {
            spread.along_rows(&mut blurred, size[0]);
            spread.along_columns(&blurred, size, &mut spare);
            std::mem::swap(&mut blurred, &mut spare);
        }
        let weight = share * weight as f32;
        let sums = image.pixels_mut().as_flattened_mut().iter_mut();
        sums.zip(blurred.as_flattened()).for_each(|(sum, c)| *sum += weight * c);
    }
}

/// The widths, in pixels, and shares of energy.
fn gaussians(height: usize) -> [(f64, f64); LEVELS] {
    let relative = |level: usize| (1_u32 << level) as f64;
    let steep_sum: f64 = (0..LEVELS).map(|level| 1.0 / relative(level)).sum();
    std::array::from_fn(|level| {
        let weight = STEEP / relative(level) / steep_sum + (1.0 - STEEP) / LEVELS as f64;
        (relative(level) * NARROWEST * height as f64, weight)
    })
}

/// A box: the mean of pixels up to `radius` away, and of those one farther with weight `edge`.
struct Spread {
    radius: i64,
    edge: f64,
    /// 1 over the sum of all weights.
    norm: f64,
}

impl Spread {
    /// The box of this variance, pixels².
    fn new(variance: f64) -> Self {
        let radius = ((0.5 * ((1.0 + 12.0 * variance).sqrt() - 1.0)).floor()).max(0.0);
        let (full, next) = (2.0 * radius + 1.0, (radius + 1.0) * (radius + 1.0));
        let edge = full * (variance - radius * (radius + 1.0) / 3.0) / (2.0 * (next - variance));
        Self { radius: radius as i64, edge, norm: 1.0 / (full + 2.0 * edge) }
    }

    /// The sum of pixels up to `radius` from the one at `center`, which `pixel` tells by its place.
    fn sum(&self, center: i64, pixel: impl Fn(i64) -> Pixel) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for i in center - self.radius..=center + self.radius {
            sum.iter_mut().zip(pixel(i)).for_each(|(sum, c)| *sum += f64::from(c));
        }
        sum
    }

    /// The mean, from the sum within and the two pixels at the edges.
    #[inline]
    fn mean(&self, sum: [f64; 3], edges: [Pixel; 2]) -> Pixel {
        let edge = |i: usize| f64::from(edges[0][i]) + f64::from(edges[1][i]);
        // Rounding must not make the sum of black pixels negative.
        std::array::from_fn(|i| ((sum[i] + self.edge * edge(i)) * self.norm).max(0.0) as f32)
    }

    fn along_rows(&self, pixels: &mut [Pixel], width: usize) {
        let reach = self.radius + 1;
        let mut line = Vec::new();
        for row in pixels.chunks_exact_mut(width) {
            line.clear();
            let places = -reach..width as i64 + reach;
            line.extend(places.map(|i| row[Wrap::Mirror.index(i, width as i64)]));
            // Place 0 of the row.
            let at = |i: i64| line[(i + reach) as usize];
            let mut sum = self.sum(0, at);
            for (x, pixel) in (0..).zip(row) {
                *pixel = self.mean(sum, [at(x - reach), at(x + reach)]);
                step(&mut sum, at(x - self.radius), at(x + reach));
            }
        }
    }

    fn along_columns(&self, pixels: &[Pixel], [width, height]: [usize; 2], into: &mut [Pixel]) {
        let reach = self.radius + 1;
        let row = |y: i64| &pixels[Wrap::Mirror.index(y, height as i64) * width..][..width];
        let mut sums = vec![[0.0; 3]; width];
        for y in -self.radius..=self.radius {
            for (sum, pixel) in sums.iter_mut().zip(row(y)) {
                step(sum, [0.0; 3], *pixel);
            }
        }
        for (y, line) in (0..).zip(into.chunks_exact_mut(width)) {
            let (above, below, last) = (row(y - reach), row(y + reach), row(y - self.radius));
            for (x, (pixel, sum)) in line.iter_mut().zip(&mut sums).enumerate() {
                *pixel = self.mean(*sum, [above[x], below[x]]);
                step(sum, last[x], below[x]);
            }
        }
    }
}

/// Moves a running sum on by a pixel.
#[inline]
fn step(sum: &mut [f64; 3], leaves: Pixel, enters: Pixel) {
    for i in 0..3 {
        sum[i] += f64::from(enters[i]) - f64::from(leaves[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use glam::UVec2;

    fn noise(width: u32, height: u32) -> Image {
        let mut image = Image::new(width, height);
        for (i, pixel) in image.pixels_mut().iter_mut().enumerate() {
            let mut numbers = Independent::new(1, UVec2::ZERO, i as u32);
            let bright = if numbers.get_1d() < 0.02 { 1e4 } else { 1.0 };
            *pixel = [(); 3].map(|()| bright * numbers.get_1d());
        }
        image
    }

    fn point(side: u32) -> Image {
        let mut image = Image::new(side, side);
        image.set_pixel(side / 2, side / 2, [1.0, 0.5, 0.0]);
        image
    }

    fn scattered(mut image: Image, share: f32) -> Image {
        scatter(&mut image, share);
        image
    }

    fn sum(image: &Image) -> f64 {
        image.pixels().as_flattened().iter().map(|&c| f64::from(c)).sum()
    }

    #[test]
    fn no_light_is_lost() {
        for (width, height) in [(61, 37), (1, 1), (200, 1), (1, 90), (3, 500), (128, 128)] {
            let image = noise(width, height);
            let (before, after) = (sum(&image), sum(&scattered(image, 0.7)));
            assert!((after / before - 1.0).abs() < 1e-5, "{width} x {height}: {after}, not {before}");
        }
        let mut even = Image::new(40, 30);
        even.pixels_mut().fill([0.25, 1.0, 3.0]);
        let even = scattered(even, 1.0);
        assert!(even.pixels().iter().all(|p| p.iter().zip([0.25, 1.0, 3.0]).all(|(a, b)| (a / b - 1.0).abs() < 1e-5)));
    }

    /// From a point light spreads alike to all four sides, and less the farther it gets.
    #[test]
    fn glow_is_symmetric_and_falls_off() {
        let glow = scattered(point(129), 1.0);
        let at = |x: u32, y: u32| glow.pixel(x, y);
        for (x, y) in (0..=64).flat_map(|y| (0..=64).map(move |x| (x, y))) {
            for (mx, my) in [(128 - x, y), (x, 128 - y), (y, x)] {
                let (a, b) = (at(x, y)[0], at(mx, my)[0]);
                assert!((a - b).abs() <= 1e-5 * a.max(1e-6), "({x}, {y}): {a} and {b}");
            }
            assert!((at(x, y)[1] - 0.5 * at(x, y)[0]).abs() < 1e-7 && at(x, y)[2] == 0.0);
            assert!(x == 0 || at(x, 64)[0] > at(x - 1, 64)[0], "{x}");
        }
    }

    /// In heights of the picture a glow is as wide at every resolution.
    #[test]
    fn glow_grows_with_the_picture() {
        let within = |side: u32, radius: f32| {
            let glow = scattered(point(side), 1.0);
            let is_near = |x: u32, y: u32| {
                let (dx, dy) = (x as f32 - (side / 2) as f32, y as f32 - (side / 2) as f32);
                dx * dx + dy * dy <= (radius * side as f32) * (radius * side as f32)
            };
            let near = (0..side).flat_map(|y| (0..side).map(move |x| (x, y))).filter(|&(x, y)| is_near(x, y));
            near.map(|(x, y)| f64::from(glow.pixel(x, y)[0])).sum::<f64>()
        };
        for radius in [0.02, 0.05, 0.2] {
            let (small, large) = (within(257, radius), within(513, radius));
            assert!((small - large).abs() < 0.02, "{radius}: {small}, {large}");
        }
    }

    /// A box has the variance that it was asked for.
    #[test]
    fn boxes_are_as_wide_as_asked() {
        for variance in [0.0, 0.01, 0.5, 2.0 / 3.0, 1.0, 7.3, 5000.0] {
            let Spread { radius, edge, norm } = Spread::new(variance);
            let inner: f64 = (-radius..=radius).map(|i| (i * i) as f64).sum();
            let found = (inner + 2.0 * edge * ((radius + 1) * (radius + 1)) as f64) * norm;
            assert!((found - variance).abs() < 1e-9 * (1.0 + variance) && (0.0..1.0).contains(&edge), "{variance}");
        }
        let total: f64 = gaussians(100).iter().map(|(_, weight)| weight).sum();
        assert!((total - 1.0).abs() < 1e-12);
    }
}
