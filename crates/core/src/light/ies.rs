//! How brightly a luminaire shines in each direction, as a goniophotometer measured it.
//!
//! A table of luminous intensities (candela) over two angles, of photometric type C. In the luminaire's own frame the
//! vertical angle is 0° straight down (−Y, the nadir) and 180° straight up; the horizontal angle is 0° towards +X and
//! grows counterclockwise as seen from above, so 90° is −Z. Between the angles intensity is interpolated linearly in
//! both, below the first and above the last vertical angle it is 0.
//!
//! The last horizontal angle tells the symmetry: 0 around the axis, 90 in each quadrant, 180 about the plane of 0°, 270
//! (from 90) about that of 90°; otherwise the table goes all the way round.
//! ANSI/IES LM-63-19, 2019.

use std::f32::consts::PI;

use glam::Vec3;

use crate::validate::Problem;

/// Luminous intensity by direction.
#[derive(Clone, Debug, PartialEq)]
pub struct IesProfile {
    /// Degrees from straight down, ascending, 0..180.
    vertical: Vec<f32>,
    /// Degrees around the axis, ascending, 0..360.
    horizontal: Vec<f32>,
    /// All vertical angles of the first horizontal one, then those of the next.
    candela: Vec<f32>,
    symmetry: Symmetry,
    max: f32,
}

/// How a table that does not go all the way round is continued.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Symmetry {
    /// The same at all horizontal angles.
    Axial,
    /// 0..90 is mirrored into the other quadrants.
    Quadrants,
    /// 0..180 is mirrored at the plane of 0° and 180°.
    AtZero,
    /// 90..270 is mirrored at the plane of 90° and 270°.
    AtNinety,
    /// The last angle is next to the first.
    None,
}

impl Symmetry {
    fn of(horizontal: &[f32]) -> Option<Self> {
        match (*horizontal.first()?, *horizontal.last()?) {
            _ if horizontal.len() == 1 => Some(Self::Axial),
            (0.0, 90.0) => Some(Self::Quadrants),
            (0.0, 180.0) => Some(Self::AtZero),
            (90.0, 270.0) => Some(Self::AtNinety),
            (0.0, last) if last > 180.0 => Some(Self::None),
            _ => None,
        }
    }

    /// The angle in the table at which the intensity is the same, degrees.
    fn fold(self, phi: f32) -> f32 {
        match self {
            Self::Axial | Self::None => phi,
            Self::AtZero => phi.min(360.0 - phi),
            Self::Quadrants => {
                let half = phi.min(360.0 - phi);
                half.min(180.0 - half)
            }
            Self::AtNinety if phi < 90.0 => 180.0 - phi,
            Self::AtNinety if phi > 270.0 => 540.0 - phi,
            Self::AtNinety => phi,
        }
    }
}

impl IesProfile {
    /// Larger tables are refused.
    pub const MAX_VALUES: usize = 1_000_000;

    /// A table of intensities, candela: all `vertical` angles of the first `horizontal` one, then those of the next.
    ///
    /// # Errors
    /// If angles do not ascend or leave their range, numbers do not match, or an intensity is negative or not finite.
    pub fn new(vertical: Vec<f32>, horizontal: Vec<f32>, candela: Vec<f32>) -> Result<Self, Problem> {
        check_angles("vertical", &vertical, 180.0)?;
        check_angles("horizontal", &horizontal, 360.0)?;
        let values = vertical.len().saturating_mul(horizontal.len());
        if values > Self::MAX_VALUES {
            return Err(problem("candela", format!("{values} intensities are more than {}", Self::MAX_VALUES)));
        }
        if candela.len() != values {
            return Err(problem("candela", format!("there are {} intensities, not {values}", candela.len())));
        }
        if let Some(bad) = candela.iter().find(|&&c| !(0.0..f32::INFINITY).contains(&c)) {
            return Err(problem("candela", format!("an intensity is {bad}: it must be finite and not negative")));
        }
        let symmetry = Symmetry::of(&horizontal).ok_or_else(|| Problem {
            hint: Some("they must go from 0 to 0, 90, 180 or 360, or from 90 to 270".to_owned()),
            ..problem("horizontal", "the horizontal angles leave out a part of the directions".to_owned())
        })?;
        let max = candela.iter().copied().fold(0.0, f32::max);
        Ok(Self { vertical, horizontal, candela, symmetry, max })
    }

    /// Degrees from straight down, ascending.
    pub fn vertical(&self) -> &[f32] {
        &self.vertical
    }

    /// Degrees around the axis, ascending.
    pub fn horizontal(&self) -> &[f32] {
        &self.horizontal
    }

    /// Candela: all vertical angles of the first horizontal one, then those of the next.
    pub fn candela(&self) -> &[f32] {
        &self.candela
    }

    /// The highest intensity, candela.
    pub fn max(&self) -> f32 {
        self.max
    }

    /// Intensity towards the unit direction `w` of the luminaire's frame, candela.
    pub fn eval(&self, w: Vec3) -> f32 {
        const DEGREES: f32 = 180.0 / PI;
        let theta = libm::atan2f((w.x * w.x + w.z * w.z).sqrt(), -w.y) * DEGREES;
        let Some((i, s)) = interval(&self.vertical, theta.min(180.0)) else { return 0.0 };
        let row = |j: usize| {
            let row = &self.candela[j * self.vertical.len()..];
            if s > 0.0 { lerp(row[i], row[i + 1], s) } else { row[i] }
        };
        if self.symmetry == Symmetry::Axial {
            return row(0);
        }
        let phi = libm::atan2f(-w.z, w.x) * DEGREES;
        let phi = self.symmetry.fold(if phi < 0.0 { phi + 360.0 } else { phi });
        let (j, k, t) = self.columns(phi);
        if t > 0.0 { lerp(row(j), row(k), t) } else { row(j) }
    }

    /// Luminous flux: the integral of the intensity over all directions, lumens.
    pub fn flux(&self) -> f32 {
        // ∫ (a + (b − a) (θ − θ₀) / (θ₁ − θ₀)) sin θ dθ between neighbours, along each column.
        let vertical: Vec<f64> = self.vertical.iter().map(|&v| f64::from(v).to_radians()).collect();
        let slice = |theta: &[f64], candela: &[f32]| {
            let [a, b] = [candela[0], candela[1]].map(f64::from);
            let [(sin_0, cos_0), (sin_1, cos_1)] = [theta[0], theta[1]].map(libm::sincos);
            a * cos_0 - b * cos_1 + (b - a) * (sin_1 - sin_0) / (theta[1] - theta[0])
        };
        let columns = self.candela.chunks(vertical.len());
        let columns = columns.map(|column| vertical.windows(2).zip(column.windows(2)).map(|(t, c)| slice(t, c)).sum());
        let columns: Vec<f64> = columns.collect();
        // Trapezoids between columns, as often as symmetry repeats them.
        let between = |a: f64, b: f64, degrees: f32| 0.5 * (a + b) * f64::from(degrees).to_radians();
        let angles = self.horizontal.windows(2).zip(columns.windows(2));
        let table: f64 = angles.map(|(phi, c)| between(c[0], c[1], phi[1] - phi[0])).sum();
        let (first, last) = (columns[0], columns[columns.len() - 1]);
        let flux = match self.symmetry {
            Symmetry::Axial => between(first, first, 360.0),
            Symmetry::Quadrants => 4.0 * table,
            Symmetry::AtZero | Symmetry::AtNinety => 2.0 * table,
            Symmetry::None => table + between(first, last, 360.0 - self.horizontal[self.horizontal.len() - 1]),
        };
        flux.clamp(0.0, f64::from(f32::MAX)) as f32
    }

    /// The two horizontal angles around `phi`, and where it is between them, 0..1.
    fn columns(&self, phi: f32) -> (usize, usize, f32) {
        let (first, last) = (self.horizontal[0], self.horizontal[self.horizontal.len() - 1]);
        match interval(&self.horizontal, phi) {
            Some((j, t)) => (j, j + 1, t),
            // The gap from the last angle to the first of the next turn; without one, folding was inexact.
            None if self.symmetry == Symmetry::None => {
                (self.horizontal.len() - 1, 0, ((phi - last) / (360.0 + first - last)).clamp(0.0, 1.0))
            }
            None if phi < first => (0, 0, 0.0),
            None => (self.horizontal.len() - 1, 0, 0.0),
        }
    }
}

fn problem(key: &str, message: String) -> Problem {
    Problem { path: vec![key.to_owned()], message, hint: None }
}

fn check_angles(key: &str, angles: &[f32], largest: f32) -> Result<(), Problem> {
    if angles.is_empty() {
        return Err(problem(key, format!("there are no {key} angles")));
    }
    if let Some(bad) = angles.iter().find(|a| !(0.0..=largest).contains(*a)) {
        return Err(problem(key, format!("a {key} angle is {bad}: it must be from 0 to {largest}")));
    }
    match angles.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => Err(problem(key, format!("the {key} angles must ascend: {} comes before {}", pair[0], pair[1]))),
        None => Ok(()),
    }
}

/// The last angle that is not above `x`, and how far `x` is on the way to the next, 0..1. None outside all of them.
fn interval(angles: &[f32], x: f32) -> Option<(usize, f32)> {
    let i = angles.partition_point(|&a| a <= x).checked_sub(1)?;
    match angles.get(i + 1) {
        Some(next) => Some((i, (x - angles[i]) / (next - angles[i]))),
        None => (x == angles[i]).then_some((i, 0.0)),
    }
}

fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a * (1.0 - t) + b * t
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The direction of two angles, degrees.
    fn direction(theta: f32, phi: f32) -> Vec3 {
        let (theta, phi) = (theta.to_radians(), phi.to_radians());
        Vec3::new(theta.sin() * phi.cos(), -theta.cos(), -theta.sin() * phi.sin())
    }

    fn close(profile: &IesProfile, theta: f32, phi: f32, expected: f32) {
        let found = profile.eval(direction(theta, phi));
        assert!((found - expected).abs() <= 1e-4 * profile.max(), "{found}, not {expected}, at {theta}°, {phi}°");
    }

    /// 100 at the first horizontal angle, 200 at the second and so on, at all vertical ones.
    fn by_angle(horizontal: &[f32]) -> IesProfile {
        let candela = (1..=horizontal.len()).flat_map(|i| [i as f32 * 100.0; 3]).collect();
        IesProfile::new(vec![0.0, 90.0, 180.0], horizontal.to_vec(), candela).unwrap()
    }

    #[test]
    fn axial() {
        let profile = IesProfile::new(vec![0.0, 45.0, 90.0], vec![0.0], vec![1000.0, 500.0, 0.0]).unwrap();
        assert_eq!(profile.max(), 1000.0);
        assert_eq!(profile.eval(Vec3::NEG_Y), 1000.0);
        assert_eq!(profile.eval(Vec3::Y), 0.0);
        for phi in [0.0, 77.0, 180.0, 301.0] {
            close(&profile, 45.0, phi, 500.0);
            close(&profile, 22.5, phi, 750.0);
            close(&profile, 67.5, phi, 250.0);
            close(&profile, 91.0, phi, 0.0);
        }
    }

    #[test]
    fn upwards_only() {
        let profile = IesProfile::new(vec![90.0, 180.0], vec![0.0], vec![10.0, 20.0]).unwrap();
        assert_eq!(profile.eval(Vec3::NEG_Y), 0.0);
        assert_eq!(profile.eval(Vec3::Y), 20.0);
        close(&profile, 135.0, 50.0, 15.0);
    }

    #[test]
    fn symmetries() {
        let cases: [(&[f32], [f32; 8]); 5] = [
            // At 0, 45, 90, 135, 180, 225, 270, 315.
            (&[0.0, 90.0], [100.0, 150.0, 200.0, 150.0, 100.0, 150.0, 200.0, 150.0]),
            (&[0.0, 90.0, 180.0], [100.0, 150.0, 200.0, 250.0, 300.0, 250.0, 200.0, 150.0]),
            (&[90.0, 180.0, 270.0], [200.0, 150.0, 100.0, 150.0, 200.0, 250.0, 300.0, 250.0]),
            (&[0.0, 90.0, 180.0, 270.0, 360.0], [100.0, 150.0, 200.0, 250.0, 300.0, 350.0, 400.0, 450.0]),
            (&[0.0, 90.0, 180.0, 270.0], [100.0, 150.0, 200.0, 250.0, 300.0, 350.0, 400.0, 250.0]),
        ];
        for (horizontal, expected) in cases {
            let profile = by_angle(horizontal);
            for (i, expected) in (0..8).zip(expected) {
                // At 0° of a full table both ends meet, and a file has the same there.
                if i > 0 || horizontal.last() != Some(&360.0) {
                    close(&profile, 60.0, 45.0 * i as f32, expected);
                }
            }
        }
    }

    #[test]
    fn axes() {
        let profile = by_angle(&[0.0, 90.0, 180.0, 270.0]);
        for (w, expected) in [(Vec3::X, 100.0), (Vec3::NEG_Z, 200.0), (Vec3::NEG_X, 300.0), (Vec3::Z, 400.0)] {
            assert!((profile.eval(w) - expected).abs() < 0.01, "{w}");
        }
    }

    #[test]
    fn every_direction_has_an_intensity_of_the_table() {
        let tables: [&[f32]; 6] =
            [&[0.0], &[0.0, 90.0], &[0.0, 180.0], &[90.0, 270.0], &[0.0, 200.0, 345.0], &[0.0, 180.0, 360.0]];
        for horizontal in tables {
            let profile = by_angle(horizontal);
            for theta in 0..=180 {
                for phi in 0..=720 {
                    let found = profile.eval(direction(theta as f32, phi as f32 * 0.5));
                    assert!(
                        (99.99..=profile.max() * 1.0001).contains(&found),
                        "{found} at {theta}, {phi}: {horizontal:?}"
                    );
                }
            }
            for w in [Vec3::ZERO, Vec3::new(1.0, 1.0, 1.0), Vec3::new(-0.0, -1.0, -0.0), Vec3::new(-1.0, 0.0, -0.0)] {
                assert!(profile.eval(w).is_finite());
            }
        }
    }

    /// Against the sum over a fine grid of directions.
    #[test]
    fn flux_is_the_integral() {
        let uneven = |horizontal: &[f32]| {
            let candela = (0..horizontal.len() * 4).map(|i| (i * i % 17) as f32 * 10.0).collect();
            IesProfile::new(vec![10.0, 40.0, 90.0, 160.0], horizontal.to_vec(), candela).unwrap()
        };
        let even = IesProfile::new(vec![0.0, 90.0, 180.0], vec![0.0], vec![3.0; 3]).unwrap();
        assert!((even.flux() - 12.0 * PI).abs() < 1e-4);
        let tables: [&[f32]; 5] =
            [&[0.0], &[0.0, 90.0], &[0.0, 70.0, 180.0], &[90.0, 200.0, 270.0], &[0.0, 100.0, 330.0]];
        for profile in tables.map(uneven) {
            let (rows, columns) = (360, 720);
            let mut sum = 0.0;
            for (i, j) in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
                let [theta, phi] = [(i, rows, 180.0), (j, columns, 360.0)]
                    .map(|(k, n, range)| (f64::from(k) + 0.5) / f64::from(n) * range);
                let candela = f64::from(profile.eval(direction(theta as f32, phi as f32)));
                sum += candela * theta.to_radians().sin();
            }
            let expected = sum * 2.0 * std::f64::consts::PI.powi(2) / f64::from(rows * columns);
            assert!((f64::from(profile.flux()) / expected - 1.0).abs() < 1e-3, "{}, not {expected}", profile.flux());
        }
    }

    #[test]
    fn refusals() {
        let (nan, inf) = (f32::NAN, f32::INFINITY);
        for (vertical, horizontal, candela) in [
            (vec![], vec![0.0], vec![]),
            (vec![0.0], vec![], vec![]),
            (vec![0.0, 0.0], vec![0.0], vec![1.0; 2]),
            (vec![0.0, nan], vec![0.0], vec![1.0; 2]),
            (vec![-90.0, 90.0], vec![0.0], vec![1.0; 2]),
            (vec![0.0, 181.0], vec![0.0], vec![1.0; 2]),
            (vec![0.0, 90.0], vec![0.0, 45.0], vec![1.0; 4]),
            (vec![0.0, 90.0], vec![0.0, 361.0], vec![1.0; 4]),
            (vec![0.0, 90.0], vec![0.0], vec![1.0; 3]),
            (vec![0.0, 90.0], vec![0.0], vec![1.0, -1.0]),
            (vec![0.0, 90.0], vec![0.0], vec![1.0, inf]),
            (vec![0.0, 90.0], vec![0.0], vec![1.0, nan]),
        ] {
            let said = format!("{vertical:?} {horizontal:?} {candela:?}");
            assert!(IesProfile::new(vertical, horizontal, candela).is_err(), "{said}");
        }
    }
}
