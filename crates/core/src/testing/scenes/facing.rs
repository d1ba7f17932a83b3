//! A square lamp that faces a matte square: what arrives is the form factor of the two.

use std::f64::consts::PI;

use super::KnownScene;
use super::build::*;

/// From so near that the lamp is sampled by the solid angle that it fills, to so far that it is sampled by its area.
pub(super) fn scenes() -> Vec<KnownScene> {
    [0.25, 1.0, 2.5].map(facing).into()
}

/// Squares of side 1 at a distance. The picture shows the lower one from half way: its mean radiance is albedo · L · F.
fn facing(distance: f32) -> KnownScene {
    const RADIANCE: f32 = 4.0;
    let middle = [0.0, 0.5 * distance, 0.0];
    let mut desc = empty(DARK, parallel(middle, [0.0; 3], 1.0));
    add_quad(&mut desc, [[-0.5, 0.0, 0.5], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]], "floor", matte(ALBEDO));
    add_quad(&mut desc, [[-0.5, distance, -0.5], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], "lamp", lamp(RADIANCE));
    let side = 1.0 / f64::from(distance);
    let expected = f64::from(ALBEDO) * f64::from(RADIANCE) * form_factor(side, side);
    KnownScene::new(format!("square {distance} below a square lamp"), desc, 2, expected)
}

/// Share of the light of a lambertian rectangle, x · y distances large, that arrives at an equal one right opposite (Howell's
/// catalogue, C-11).
fn form_factor(x: f64, y: f64) -> f64 {
    let (x_sq, y_sq) = (1.0 + x * x, 1.0 + y * y);
    let corners = 0.5 * (x_sq * y_sq / (x_sq + y_sq - 1.0)).ln();
    let across = |a: f64, b_sq: f64| a * b_sq.sqrt() * (a / b_sq.sqrt()).atan();
    2.0 / (PI * x * y) * (corners + across(x, y_sq) + across(y, x_sq) - x * x.atan() - y * y.atan())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a unit cube's face, which sees four others as much as one another; near all arrives, far cos² A / (π d²).
    #[test]
    fn known_form_factors() {
        assert!((form_factor(1.0, 1.0) - 0.199_825).abs() < 1e-6);
        assert!((form_factor(1e4, 1e4) - 1.0).abs() < 1e-3);
        assert!((form_factor(0.01, 0.02) * PI / 2e-4 - 1.0).abs() < 1e-3);
    }
}
