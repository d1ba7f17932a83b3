//! The air around a round planet, and how much of the sun comes through it.
//!
//! Three things are in it, each with a density over the height h and an extinction over the wavelength λ (µm):
//!
//! - air molecules, exp(-h / 8 km), vertical optical thickness of Bodhaine et al. 1999,
//!   doi:10.1175/1520-0426(1999)016<1854:ORODC>2.0.CO;2;
//! - aerosol, exp(-h / 1.2 km), Ångström's β λ^-1.3 with β = 0.04608 T - 0.04586 for the turbidity T (Preetham, Shirley
//!   & Smits 1999, doi:10.1145/311535.311545), nine tenths of it scattered;
//! - ozone, a tent from 10 to 40 km (Bruneton 2017, doi:10.1109/TVCG.2016.2622272), 300 Dobson units; it only absorbs.
//!
//! Transmittance along a ray is exp(-Σ k(λ) c), where c is the column of each along it. Columns up to the sun depend on
//! the height and the sun's zenith angle only, and lie in a table with the coordinates of Bruneton & Neyret 2008,
//! doi:10.1111/j.1467-8659.2008.01245.x. All lengths are km.

use std::f64::consts::PI;

use super::bands::{Bands, OZONE};

/// The planet's radius.
pub(super) const GROUND: f64 = 6360.0;
/// The radius at which the air ends.
pub(super) const TOP: f64 = 6460.0;

/// Scale heights.
const MOLECULES_SCALE: f64 = 8.0;
const AEROSOL_SCALE: f64 = 1.2;
/// Middle and half width of the layer of ozone.
const OZONE_MIDDLE: f64 = 25.0;
const OZONE_HALF: f64 = 15.0;
/// Share of what aerosol takes from a ray that it scatters.
const AEROSOL_ALBEDO: f64 = 0.9;
/// The sun's angular radius, whose edge makes the edge of the planet's shadow soft; radians.
const SUN_RADIUS: f64 = 0.5 * 0.533 * PI / 180.0;

/// Amounts of molecules, aerosol and ozone: densities relative to the most, or columns of them (km).
pub(super) type Amounts = [f64; 3];

/// What the air does to light, per km where each is densest.
pub(super) struct Atmosphere {
    pub(super) molecules: Bands,
    pub(super) aerosol: Bands,
    aerosol_extinction: Bands,
    ozone: Bands,
    /// Columns from a radius towards a zenith angle, to the top; zenith angles run fastest.
    columns: Vec<Amounts>,
}

impl Atmosphere {
    const ANGLES: usize = 256;
    const RADII: usize = 64;
    const COLUMN_STEPS: usize = 48;

    pub(super) fn new(turbidity: f64) -> Self {
        let molecules = Bands::of_micrometres(|l| {
            let l_sq = l * l;
            let thickness = 0.002_152_0 * (1.045_599_6 - 341.290_61 / l_sq - 0.902_308_5 * l_sq)
                / (1.0 + 0.002_705_988_9 / l_sq - 85.968_563 * l_sq);
            thickness / MOLECULES_SCALE
        });
        let beta = 0.046_08 * turbidity - 0.045_86;
        let aerosol_extinction = Bands::of_micrometres(|l| beta * libm::pow(l, -1.3) / AEROSOL_SCALE);
        // 300 Dobson units of 2.687e20 molecules per m² and 1e-25 m² each; the tent's area is its half width.
        let ozone = OZONE * (300.0 * 2.687e20 * 1e-25 / OZONE_HALF);
        let columns = (0..Self::RADII * Self::ANGLES).map(|i| {
            let (r, mu) = Self::place(i / Self::ANGLES, i % Self::ANGLES);
            column(r, mu, Self::COLUMN_STEPS)
        });
        let columns = columns.collect();
        Self { molecules, aerosol: aerosol_extinction * AEROSOL_ALBEDO, aerosol_extinction, ozone, columns }
    }

    /// Extinction for densities (1/km), optical thickness for columns.
    #[inline]
    pub(super) fn extinction(&self, [molecules, aerosol, ozone]: Amounts) -> Bands {
        self.molecules * molecules + self.aerosol_extinction * aerosol + self.ozone * ozone
    }

    /// Share of the sun's light that arrives at radius `r`, if the cosine of its zenith angle is `mu`.
    pub(super) fn sunlight(&self, r: f64, mu: f64) -> Bands {
        let visible = visible_sun(r, mu);
        if visible == 0.0 {
            return Bands::ZERO;
        }
        self.extinction(self.column(r, mu)).transmittance() * visible
    }

    /// Radius and cosine of the zenith angle of a table's entry: even in the distance to the horizon, and between the
    /// shortest and the longest way out of the air.
    fn place(radius: usize, angle: usize) -> (f64, f64) {
        let rho = longest_in_air() * radius as f64 / (Self::RADII - 1) as f64;
        let r = (rho * rho + GROUND * GROUND).sqrt();
        let (shortest, longest) = (TOP - r, rho + longest_in_air());
        let way = shortest + (longest - shortest) * angle as f64 / (Self::ANGLES - 1) as f64;
        let mu = if way > 0.0 { (TOP * TOP - r * r - way * way) / (2.0 * r * way) } else { 1.0 };
        (r, mu.clamp(horizon(r), 1.0))
    }

    /// The table, interpolated; the planet is not in the way.
    fn column(&self, r: f64, mu: f64) -> Amounts {
        let rho = (r * r - GROUND * GROUND).max(0.0).sqrt();
        let (shortest, longest) = (TOP - r, rho + longest_in_air());
        let share = (way_to_top(r, mu.max(horizon(r))) - shortest) / (longest - shortest);
        let ([r0, r1], rt) = between(rho / longest_in_air(), Self::RADII);
        let ([a0, a1], at) = between(share, Self::ANGLES);
        let at_radius = |radius: usize| {
            let (a, b) = (self.columns[radius * Self::ANGLES + a0], self.columns[radius * Self::ANGLES + a1]);
            mix(a, b, at)
        };
        mix(at_radius(r0), at_radius(r1), rt)
    }
}

/// Densities at a height, relative to the most.
pub(super) fn density(height: f64) -> Amounts {
    let ozone = (1.0 - (height - OZONE_MIDDLE).abs() / OZONE_HALF).max(0.0);
    [libm::exp(-height / MOLECULES_SCALE), libm::exp(-height / AEROSOL_SCALE), ozone]
}

/// The column from a radius to the top.
fn column(r: f64, mu: f64, count: usize) -> Amounts {
    steps(r, mu, way_to_top(r, mu), count).fold([0.0; 3], |sum, (t, length)| {
        let at = density(radius_after(r, mu, t) - GROUND);
        std::array::from_fn(|i| sum[i] + length * at[i])
    })
}

/// Steps along a ray that are short where the air is dense: even in the square root of the distance from the ray's
/// lowest point. Each is the place of its middle and its length.
pub(super) fn steps(r: f64, mu: f64, length: f64, count: usize) -> impl Iterator<Item = (f64, f64)> {
    let lowest = (-r * mu).clamp(0.0, length);
    let (start, end) = (-lowest.sqrt(), (length - lowest).sqrt());
    let place = move |s: f64| lowest + s * s.abs();
    let at = move |i: f64| start + (end - start) * i / count as f64;
    (0..count).map(move |i| {
        let i = i as f64;
        (place(at(i + 0.5)), place(at(i + 1.0)) - place(at(i)))
    })
}

/// The radius at distance `t` along a ray from radius `r`.
pub(super) fn radius_after(r: f64, mu: f64, t: f64) -> f64 {
    (r * r + t * (t + 2.0 * r * mu)).sqrt().max(GROUND)
}

/// Distance to where a ray leaves the air, through the planet if it is in the way.
pub(super) fn way_to_top(r: f64, mu: f64) -> f64 {
    ((TOP * TOP - r * r * (1.0 - mu * mu)).max(0.0).sqrt() - r * mu).max(0.0)
}

/// Distance to the ground, if a ray meets it.
pub(super) fn way_to_ground(r: f64, mu: f64) -> Option<f64> {
    let under_root = GROUND * GROUND - r * r * (1.0 - mu * mu);
    (mu < 0.0 && under_root >= 0.0).then(|| (-r * mu - under_root.sqrt()).max(0.0))
}

/// Cosine of the horizon's zenith angle.
fn horizon(r: f64) -> f64 {
    -(1.0 - (GROUND / r) * (GROUND / r)).max(0.0).sqrt()
}

/// The longest way from the ground out of the air: along the horizon.
fn longest_in_air() -> f64 {
    (TOP * TOP - GROUND * GROUND).sqrt()
}

/// Share of the sun's disk above the horizon, whose zenith angle has the sine GROUND / r: there that is the slope of
/// the cosine, and the sun is small.
fn visible_sun(r: f64, mu: f64) -> f64 {
    let x = (mu - horizon(r)) / (SUN_RADIUS * GROUND / r);
    if x.abs() >= 1.0 {
        return if x > 0.0 { 1.0 } else { 0.0 };
    }
    0.5 + (x * (1.0 - x * x).sqrt() + libm::asin(x)) / PI
}

/// The two entries of a table of `count` that lie around `u` in 0..1, and how far it is from the first to the second.
pub(super) fn between(u: f64, count: usize) -> ([usize; 2], f64) {
    let place = u.clamp(0.0, 1.0) * (count - 1) as f64;
    let first = (place as usize).min(count - 2);
    ([first, first + 1], place - first as f64)
}

fn mix(a: Amounts, b: Amounts, t: f64) -> Amounts {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_known() {
        // Straight up, an exponential holds its scale height, less what lies above the top; the tent its half width.
        let [molecules, aerosol, ozone] = column(GROUND, 1.0, Atmosphere::COLUMN_STEPS);
        assert!((molecules / MOLECULES_SCALE - 1.0).abs() < 1e-3, "{molecules}");
        assert!((aerosol / AEROSOL_SCALE - 1.0).abs() < 1e-2, "{aerosol}");
        assert!((ozone / OZONE_HALF - 1.0).abs() < 5e-3, "{ozone}");
        // Along the horizon, Chapman's function for r / H = 795: (pi r / 2H)^1/2 times that, and 1 + 3H/8r.
        let chapman = (0.5 * PI * GROUND / MOLECULES_SCALE).sqrt() * (1.0 + 3.0 * MOLECULES_SCALE / (8.0 * GROUND));
        let [molecules, ..] = column(GROUND, 0.0, Atmosphere::COLUMN_STEPS);
        assert!((molecules / MOLECULES_SCALE / chapman - 1.0).abs() < 2e-3, "{molecules}");
    }

    #[test]
    fn the_table_agrees_with_integration() {
        let air = Atmosphere::new(3.0);
        for height in [0.0, 0.3, 2.0, 11.0, 40.0, 99.0] {
            let r = GROUND + height;
            for step in 0..=40 {
                let mu = horizon(r) + (1.0 - horizon(r)) * (f64::from(step) / 40.0).powi(2);
                let slow = air.extinction(column(r, mu, 4000));
                let close = |fast: f64, slow: f64| ((-fast).exp() - (-slow).exp()).abs();
                let off = air.extinction(air.column(r, mu)).zip(slow, close);
                let most = off.map(|o| if o < 5e-3 { 0.0 } else { 1.0 });
                assert_eq!(most, Bands::ZERO, "height {height}, cosine {mu}: {off:?}");
            }
        }
    }

    #[test]
    fn less_comes_through_the_lower_the_sun() {
        for turbidity in [1.0, 2.5, 10.0] {
            let air = Atmosphere::new(turbidity);
            let mut before = Bands::ONE;
            for degrees in 0..=91 {
                let light = air.sunlight(GROUND, f64::from(degrees).to_radians().cos());
                let less = light.zip(before, |now, before| if now < before || now == 0.0 { 0.0 } else { 1.0 });
                assert_eq!(less, Bands::ZERO, "turbidity {turbidity}, zenith angle {degrees}");
                before = light;
            }
            assert_eq!(before, Bands::ZERO);
        }
    }

    #[test]
    fn half_the_sun_stands_on_the_horizon() {
        assert_eq!(visible_sun(GROUND, 0.0), 0.5);
        assert_eq!((visible_sun(GROUND, 0.01), visible_sun(GROUND, -0.01)), (1.0, 0.0));
        assert_eq!(visible_sun(TOP, -0.1), 1.0);
    }
}
