//! The four plots of time against each variable.

use plotters::chart::SeriesLabelPosition;
use plotters::prelude::RGBColor;

use super::{Sweep, Variable};
use crate::command::figures::page::{self, INK};
use crate::command::figures::plot::{COLORS, Plot, Series, curve};
use crate::error::Error;

const SIZE: (u32, u32) = (1500, 1120);

pub(super) fn draw(sweeps: &[Sweep]) -> Result<Vec<u8>, Error> {
    let panels = [Variable::Pixels, Variable::Samples, Variable::Depth, Variable::Objects];
    page::draw(SIZE, |area| {
        let mut places = area.split_evenly((2, 2)).into_iter().zip(panels);
        places.try_for_each(|(place, variable)| panel(variable, sweeps).draw(&place))
    })
}

fn panel(variable: Variable, sweeps: &[Sweep]) -> Plot {
    let shown: Vec<_> = sweeps.iter().filter(|sweep| sweep.variable == variable).collect();
    let mut series: Vec<_> = shown.iter().zip(COLORS).map(|(sweep, color)| fitted(sweep, color)).collect();
    if variable != Variable::Objects {
        series.extend(shown.first().map(|sweep| bound(sweep, sweeps)));
    }
    let (title, x_label) = match variable {
        Variable::Pixels => ("Size of the picture", "pixels W·H"),
        Variable::Samples => ("Samples", "samples per pixel S"),
        Variable::Depth => ("Recursion depth", "maximum depth D"),
        Variable::Objects => ("Number of objects", "spheres N"),
    };
    Plot {
        title: title.to_owned(),
        x_label: x_label.to_owned(),
        y_label: "time on one thread / ms".to_owned(),
        x_base: if matches!(variable, Variable::Samples | Variable::Depth) { 2.0 } else { 4.0 },
        series,
        legend: SeriesLabelPosition::UpperLeft,
    }
}

/// The measured times and the law that was fitted to them.
fn fitted(sweep: &Sweep, color: RGBColor) -> Series {
    let power = sweep.power();
    let exponent = format!("{}^{:.2}, R² = {:.4}", symbol(sweep.variable), power.slope, power.r2);
    let (fit, label) = match sweep.logarithm() {
        Some(fit) => (fit, format!("BVH: a + b log₂ N, R² = {:.3}; or {exponent}", fit.r2)),
        None => (power, format!("{}: {exponent}", sweep.scene)),
    };
    let in_milliseconds = |points: Vec<(f64, f64)>| points.into_iter().map(|(x, t)| (x, milliseconds(t))).collect();
    Series {
        label,
        color,
        points: in_milliseconds(sweep.seconds()),
        curve: in_milliseconds(curve(&fit, &sweep.fitted_seconds())),
        dashed: false,
    }
}

/// The least c · W·H·S·D that no measured time exceeds, in one panel.
fn bound(of: &Sweep, sweeps: &[Sweep]) -> Series {
    let bounded = sweeps.iter().filter(|sweep| sweep.variable != Variable::Objects);
    let c = bounded.flat_map(|sweep| &sweep.points).map(|p| p.timing.seconds / p.work).fold(0.0, f64::max);
    let ends = of.points.iter().take(1).chain(of.points.last());
    Series {
        label: format!("upper bound c · W·H·S·D, c = {:.0} ns", 1e9 * c),
        color: INK,
        points: Vec::new(),
        curve: ends.map(|p| (p.x, milliseconds(c * p.work))).collect(),
        dashed: true,
    }
}

fn symbol(variable: Variable) -> &'static str {
    match variable {
        Variable::Pixels => "(W·H)",
        Variable::Samples => "S",
        Variable::Depth => "D",
        Variable::Objects => "N",
    }
}

fn milliseconds(seconds: f64) -> f64 {
    1e3 * seconds
}
