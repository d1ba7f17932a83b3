//! Sine and cosine of full turns, the same bits on every machine.
//!
//! The system's `sinf` differs between libraries; this one is a handful of multiplications and additions, each
//! rounded as IEEE 754 says. Taylor polynomials on an eighth of a turn; the error is below 2e-7.

/// (sin 2πu, cos 2πu) for u in -1..1.
#[inline]
pub fn sin_cos_turns(u: f32) -> (f32, f32) {
    /// A sum with this has no room for a fraction: it is rounded to a whole number, which its last bits show.
    const WHOLE: f32 = 12_582_912.0;
    // u = quarter / 4 + rest with |rest| <= 1/8.
    let quarter = u * 4.0 + WHOLE;
    let (sin, cos) = sin_cos_eighth(u - (quarter - WHOLE) * 0.25);
    match quarter.to_bits() & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The sine and the cosine of an angle of any size, degrees.
#[inline]
pub fn sin_cos_degrees(degrees: f32) -> (f32, f32) {
    let turns = degrees / 360.0;
    sin_cos_turns(turns - turns.floor())
}

/// (sin 2πu, cos 2πu) for u in -1/8..=1/8.
#[inline]
pub fn sin_cos_eighth(u: f32) -> (f32, f32) {
    let x = u * std::f32::consts::TAU;
    let x_sq = x * x;
    let sin =
        x * (1.0 + x_sq * (-1.0 / 6.0 + x_sq * (1.0 / 120.0 + x_sq * (-1.0 / 5040.0 + x_sq * (1.0 / 362_880.0)))));
    let cos = 1.0 + x_sq * (-0.5 + x_sq * (1.0 / 24.0 + x_sq * (-1.0 / 720.0 + x_sq * (1.0 / 40320.0))));
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_double_precision() {
        for i in -100_000..100_000 {
            let u = i as f32 / 100_000.0;
            let (sin, cos) = (f64::from(u) * std::f64::consts::TAU).sin_cos();
            let (s, c) = sin_cos_turns(u);
            assert!((f64::from(s) - sin).abs() < 3e-7 && (f64::from(c) - cos).abs() < 3e-7, "u = {u}");
        }
    }
}
