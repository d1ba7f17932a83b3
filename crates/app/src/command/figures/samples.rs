//! Figure 1: what the number of samples per pixel does.
//!
//! The samples of a pixel are independent, so the root mean square error of its mean falls as n^(-1/2).
//!
//! The reference is the mean of two halves a and b with seeds of their own. It has an error too, which adds to what is
//! measured: the variance of a mean of two is MSE(a, b) / 4, and is subtracted.

use eyebeam_core::film::Image;
use eyebeam_core::render::Settings;
use eyebeam_core::scene::Scene;
use plotters::chart::SeriesLabelPosition;

use super::fit::Fit;
use super::page;
use super::plot::{COLORS, Plot, Series, curve};
use super::sheet::Sheet;
use super::table::Table;
use super::{Study, build, render, scene};
use crate::error::Error;

pub(super) const NAME: &str = "samples";

const PLOT_HEIGHT: u32 = 440;
const MIN_WIDTH: u32 = 640;

pub(super) fn make(study: &Study<'_>) -> Result<(), Error> {
    let desc = scene("spheres.toml", include_str!("../../../../../scenes/spheres.toml"))?;
    let scene = build(&desc)?;
    let (width, height) = study.pick((280, 158), (128, 72));
    let settings = Settings { width, height, ..Settings::from(&desc.render.plain()) };
    let reference = Reference::render(&scene, &settings, study.pick(2048, 256));
    study.say("samples: the reference is rendered");

    let counts = study.pick(&[1, 4, 16, 64, 256, 1024][..], &[1, 4, 16, 64][..]);
    let (mut tiles, mut points) = (Vec::new(), Vec::new());
    for &n in counts {
        let image = render(&scene, Settings { spp: n, seed: u64::from(n), ..settings.clone() });
        points.push((f64::from(n), reference.rmse(&image)));
        tiles.push((format!("n = {n}"), image));
        study.say(&format!("samples: n = {n}"));
    }
    let fit = Fit::power(&points);
    study.write(NAME, &draw(tiles, &points, &fit, &reference)?, &table(&points, &fit, &reference))
}

/// A converged picture.
struct Reference {
    image: Image,
    /// Samples per pixel.
    spp: u32,
    /// Mean over pixels and channels of its own variance.
    variance: f64,
}

impl Reference {
    /// From two renders of `half` samples per pixel, whose seeds no other render of this figure has.
    fn render(scene: &Scene, settings: &Settings, half: u32) -> Self {
        let part = |seed| render(scene, Settings { spp: half, seed, ..settings.clone() });
        let (a, b) = (part(1_000_001), part(1_000_002));
        let mut image = Image::new(a.width(), a.height());
        for y in 0..a.height() {
            for x in 0..a.width() {
                let (a, b) = (a.pixel(x, y), b.pixel(x, y));
                image.set_pixel(x, y, [0, 1, 2].map(|c| 0.5 * (a[c] + b[c])));
            }
        }
        Self { image, spp: 2 * half, variance: mse(&a, &b) / 4.0 }
    }

    /// Root mean square error of a picture in linear radiance, over all pixels and channels.
    fn rmse(&self, image: &Image) -> f64 {
        (mse(image, &self.image) - self.variance).max(0.0).sqrt()
    }
}

/// Mean square difference over pixels and channels.
fn mse(a: &Image, b: &Image) -> f64 {
    let values = |image: &'_ Image| image.pixels().iter().flatten().map(|&c| f64::from(c)).collect::<Vec<_>>();
    let (a, b) = (values(a), values(b));
    a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64
}

fn draw(
    tiles: Vec<(String, Image)>,
    points: &[(f64, f64)],
    fit: &Fit,
    reference: &Reference,
) -> Result<Vec<u8>, Error> {
    let sheet = Sheet::new(tiles.len().div_ceil(2) as u32, tiles);
    let plot = Plot {
        title: format!("Error against a reference of {} samples per pixel", reference.spp),
        x_label: "samples per pixel n".to_owned(),
        y_label: "RMSE (linear radiance)".to_owned(),
        x_base: 4.0,
        series: vec![
            Series {
                label: "measured; the reference's own variance is subtracted".to_owned(),
                color: COLORS[1],
                points: points.to_vec(),
                curve: Vec::new(),
                dashed: false,
            },
            Series {
                label: format!("least squares: slope {:.3}, R² = {:.5}", fit.slope, fit.r2),
                color: COLORS[0],
                points: Vec::new(),
                curve: curve(fit, points),
                dashed: false,
            },
        ],
        legend: SeriesLabelPosition::UpperRight,
    };
    let (width, sheet_height) = sheet.size();
    page::draw((width.max(MIN_WIDTH), sheet_height + PLOT_HEIGHT), |area| {
        let (top, bottom) = area.split_vertically(sheet_height);
        sheet.draw(&top)?;
        plot.draw(&bottom)
    })
}

fn table(points: &[(f64, f64)], fit: &Fit, reference: &Reference) -> Table {
    let columns = [
        "samples_per_pixel",
        "rmse",
        "fitted_rmse",
        "slope",
        "r2",
        "reference_samples_per_pixel",
        "subtracted_variance",
    ];
    let mut table = Table::new(&columns);
    for &(n, rmse) in points {
        let fitted = fit.at(n);
        table.push([
            n.into(),
            rmse.into(),
            fitted.into(),
            fit.slope.into(),
            fit.r2.into(),
            reference.spp.into(),
            reference.variance.into(),
        ]);
    }
    table
}
