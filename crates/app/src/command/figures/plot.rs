//! A plot of points and fitted curves on logarithmic axes.

use plotters::chart::{ChartBuilder, SeriesLabelPosition};
use plotters::coord::combinators::{BindKeyPoints, IntoLogRange};
use plotters::element::{Circle, EmptyElement, PathElement};
use plotters::prelude::{RGBColor, WHITE};
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::Color;

use super::fit::Fit;
use super::page::{Area, DrawError, INK, text, title};

/// Colours that differ for every kind of eye: Okabe & Ito's vermillion and blue.
pub(super) const COLORS: [RGBColor; 2] = [RGBColor(213, 94, 0), RGBColor(0, 114, 178)];

/// A plot with both axes logarithmic.
pub(super) struct Plot {
    pub(super) title: String,
    pub(super) x_label: String,
    pub(super) y_label: String,
    /// Labels of the x axis stand at the powers of this.
    pub(super) x_base: f64,
    pub(super) series: Vec<Series>,
    pub(super) legend: SeriesLabelPosition,
}

/// Measured points, a curve that goes with them, or both.
pub(super) struct Series {
    pub(super) label: String,
    pub(super) color: RGBColor,
    pub(super) points: Vec<(f64, f64)>,
    pub(super) curve: Vec<(f64, f64)>,
    pub(super) dashed: bool,
}

/// A fitted law over the range of x that it was fitted to.
pub(super) fn curve(fit: &Fit, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let xs = || points.iter().map(|p| p.0);
    let (from, to) = (xs().fold(f64::INFINITY, f64::min), xs().fold(0.0, f64::max));
    // What is straight on logarithmic axes needs no more than its ends.
    let steps = if fit.is_power() { 1 } else { 24 };
    (0..=steps).map(|i| from * (to / from).powf(f64::from(i) / f64::from(steps))).map(|x| (x, fit.at(x))).collect()
}

impl Series {
    /// The lines that stand for the curve in a legend, from the middle of its left edge.
    fn strokes(&self) -> [[(i32, i32); 2]; 2] {
        let stroke = |from, to| [(from, -2), (to, -2)];
        match (self.curve.is_empty(), self.dashed) {
            (true, _) => [stroke(12, 12); 2],
            (false, true) => [stroke(0, 9), stroke(15, 24)],
            (false, false) => [stroke(0, 12), stroke(12, 24)],
        }
    }
}

impl Plot {
    pub(super) fn draw(&self, area: &Area<'_>) -> Result<(), DrawError> {
        let [(x_min, x_max), (y_min, y_max)] = self.extent();
        let x_margin = (x_max / x_min).powf(0.04);
        let (x_min, x_max) = (x_min / x_margin, x_max * x_margin);
        let (y_min, y_max) = (y_min / 1.3, y_max * (y_max / y_min).powf(0.12));
        let x = (x_min..x_max).log_scale().with_key_points(powers(self.x_base, x_min, x_max));
        let y = (y_min..y_max)
            .log_scale()
            .with_key_points(powers(10.0, y_min, y_max))
            .with_light_points(between_decades(y_min, y_max));
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, title(23))
            .margin(14)
            .margin_right(26)
            .x_label_area_size(58)
            .y_label_area_size(84)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_desc(&self.x_label)
            .y_desc(&self.y_label)
            .x_label_formatter(&|x| tick(*x))
            .y_label_formatter(&|y| tick(*y))
            .label_style(text(18))
            .axis_desc_style(text(20))
            .axis_style(INK)
            .bold_line_style(INK.mix(0.18))
            .light_line_style(INK.mix(0.06))
            .draw()?;
        for series in &self.series {
            let color = series.color;
            let drawn = if series.dashed {
                let line = series.curve.iter().copied();
                chart.draw_series(DashedLineSeries::new(line, 9, 6, color.stroke_width(2)))?
            } else {
                chart.draw_series(LineSeries::new(series.curve.iter().copied(), color.stroke_width(2)))?
            };
            let (has_points, strokes) = (!series.points.is_empty(), series.strokes());
            drawn.label(&series.label).legend(move |at| {
                EmptyElement::at(at)
                    + PathElement::new(strokes[0], color.stroke_width(2))
                    + PathElement::new(strokes[1], color.stroke_width(2))
                    + Circle::new((12, -2), if has_points { 5 } else { 0 }, color.filled())
            });
            chart.draw_series(series.points.iter().map(|&p| Circle::new(p, 5, color.filled())))?;
        }
        chart
            .configure_series_labels()
            .position(self.legend.clone())
            .margin(12)
            .legend_area_size(32)
            .label_font(text(18))
            .background_style(WHITE.mix(0.85))
            .border_style(INK.mix(0.3))
            .draw()
    }

    /// Smallest and largest x, and y.
    fn extent(&self) -> [(f64, f64); 2] {
        let all = || self.series.iter().flat_map(|s| s.points.iter().chain(&s.curve));
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)))
        };
        [range(&mut all().map(|p| p.0)), range(&mut all().map(|p| p.1))]
    }
}

/// The whole powers of `base` in a range; every other one, or fewer, where they are many.
fn powers(base: f64, from: f64, to: f64) -> Vec<f64> {
    const MOST: i32 = 9;
    let exponent = |x: f64| x.ln() / base.ln();
    let (first, last) = (exponent(from).ceil() as i32, exponent(to).floor() as i32);
    let step = ((last - first) / MOST + 1).max(1);
    (first..=last).filter(|e| e.rem_euclid(step) == 0).map(|e| base.powi(e)).collect()
}

/// 2, 3, ... 9 times the powers of ten.
fn between_decades(from: f64, to: f64) -> Vec<f64> {
    let decades = from.log10().floor() as i32..=to.log10().floor() as i32;
    let all = decades.flat_map(|decade| (2..10).map(move |k| f64::from(k) * 10.0_f64.powi(decade)));
    all.filter(|x| (from..to).contains(x)).collect()
}

/// `0.01`, `16`, `65 536`.
fn tick(x: f64) -> String {
    let text = if x >= 1.0 { format!("{x:.0}") } else { format!("{}", (x * 1e9).round() / 1e9) };
    if x < 1e4 {
        return text;
    }
    let groups = text.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
    groups.collect::<Vec<_>>().join("\u{2009}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks() {
        assert_eq!(powers(4.0, 0.9, 70.0), [1.0, 4.0, 16.0, 64.0]);
        assert_eq!(between_decades(1.5, 4.0), [2.0, 3.0]);
        assert_eq!([0.001, 1.0, 1024.0, 65536.0].map(tick), ["0.001", "1", "1024", "65\u{2009}536"]);
    }
}
