//! Figure 3: what the roughness of a metal does, beside a lambertian.
//!
//! Blur is measured on the horizon that every sphere mirrors: along the vertical line through the middle of a sphere, the
//! luminance changes from that of the ground to that of the sky over some width. Width here is the whole range of the
//! luminance over its steepest slope, in radii of the sphere.

use eyebeam_core::color::luminance;
use eyebeam_core::film::Image;
use eyebeam_core::render::Settings;
use glam::UVec2;

use super::page::{self, text, write_below};
use super::probe::{Probe, mean};
use super::sheet::draw_image;
use super::table::Table;
use super::{Study, build, render, scene};
use crate::error::Error;

pub(super) const NAME: &str = "roughness";

/// The spheres' names, in the order of the scene file after the ground.
const LABELS: [(&str, &str); 5] =
    [("0", "r = 0"), ("1/3", "r = 1/3"), ("2/3", "r = 2/3"), ("1", "r = 1"), ("lambertian", "lambertian")];

const LABEL_HEIGHT: u32 = 44;

pub(super) fn make(study: &Study<'_>) -> Result<(), Error> {
    let desc = scene("roughness.toml", include_str!("../../../../../scenes/roughness.toml"))?;
    let scene = build(&desc)?;
    let (width, height, spp) = study.pick((1240, 280, 512), (620, 140, 32));
    let image = render(&scene, Settings { width, height, spp, ..Settings::from(&desc.render.plain()) });
    let probe = Probe { desc: &desc, scene: &scene, width, height };

    let mut table = Table::new(&["roughness", "mean_luminance", "deviation_of_luminance", "horizon_width"]);
    let mut columns = Vec::new();
    for (i, (roughness, label)) in (1..).zip(LABELS) {
        let pixels = probe.pixels(|seen| seen.is_some_and(|seen| seen.sphere == i));
        let disc = Disc::around(&pixels);
        let (mean, deviation) = spread(&image, &pixels);
        table.push([roughness.into(), mean.into(), deviation.into(), disc.horizon_width(&image).into()]);
        columns.push((label, disc.center.x));
    }
    let png = page::draw((width, height + LABEL_HEIGHT), |area| {
        draw_image(area, &image, (0, 0))?;
        columns.iter().try_for_each(|&(label, x)| write_below(area, label, &text(22), (x as i32, height as i32 + 10)))
    })?;
    study.write(NAME, &png, &table)
}

/// Mean and standard deviation of the luminance of some pixels.
fn spread(image: &Image, pixels: &[UVec2]) -> (f64, f64) {
    let mean_luminance = luminance(mean(image, pixels));
    let square = |p: &UVec2| (luminance(image.pixel(p.x, p.y).map(f64::from)) - mean_luminance).powi(2);
    (mean_luminance, (pixels.iter().map(square).sum::<f64>() / pixels.len().max(1) as f64).sqrt())
}

/// A sphere in the picture, in pixels.
struct Disc {
    center: UVec2,
    radius: u32,
}

impl Disc {
    fn around(pixels: &[UVec2]) -> Self {
        let low = pixels.iter().fold(UVec2::MAX, |low, &p| low.min(p));
        let high = pixels.iter().fold(UVec2::ZERO, |high, &p| high.max(p));
        Self { center: (low + high) / 2, radius: high.y.saturating_sub(low.y) / 2 }
    }

    /// Range of the luminance over its steepest slope along the vertical line through the middle, in radii.
    fn horizon_width(&self, image: &Image) -> f64 {
        // A strip this wide and slopes over this height keep the noise out; the ends are the sphere's own rim and shadow.
        let (half_strip, rise) = (self.radius / 6, (self.radius / 16).max(1));
        let (x, reach) = (self.center.x, self.radius * 3 / 5);
        let profile: Vec<f64> = (self.center.y - reach..=self.center.y + reach)
            .map(|y| (x - half_strip..=x + half_strip).map(|x| UVec2::new(x, y)).collect::<Vec<_>>())
            .map(|strip| luminance(mean(image, &strip)))
            .collect();
        let low = profile.iter().copied().fold(f64::INFINITY, f64::min);
        let high = profile.iter().copied().fold(0.0, f64::max);
        let steepest = profile.windows(rise as usize + 1).map(|w| (w[0] - w[rise as usize]).abs()).fold(0.0, f64::max);
        (high - low) / steepest * f64::from(rise) / f64::from(self.radius)
    }
}
