//! Charlie: a layer of fibres that stand upright, such as the nap of velvet.
//!
//! Facets whose normals lie rather across the surface than along its normal, with θ the angle between them,
//!
//! D = (2 + 1/α) sin^(1/α) θ / 2π, shadowed by V = G / (4 cos θₒ cos θᵢ), G = 1 / (1 + Λ(θₒ) + Λ(θᵢ)),
//!
//! where Λ has no closed form; the source fits it. Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF",
//! Physically Based Shading in Theory and Practice (SIGGRAPH courses). Without its softer terminator, which is not
//! reciprocal.
//!
//! The share E(θ) of light that D V scatters, which what lies below must go without, is integrated once for a grid of
//! roughness and √cos θ.

use std::f32::consts::TAU;
use std::sync::LazyLock;

use glam::{FloatExt, Vec3};

use crate::math::{interpolate, place, sin_cos_turns};

/// Fibres of one roughness. Directions are above the surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Charlie {
    roughness: f32,
    /// 1 / α.
    exponent: f32,
    /// [a, b, c, d, e] of the source: ln Λ = a / (1 + b xᶜ) + d x + e for x = cos θ up to 1/2.
    fit: [f32; 5],
}

impl Charlie {
    /// Of straighter fibres, the fit of Λ would let more light come back than comes in.
    pub(crate) const MIN_ROUGHNESS: f32 = 0.3;
    /// Cosines closer to the horizon are taken for this one in V, as the fit of Λ does not grow as 1 / cos there.
    const MIN_COS: f32 = 0.01;

    /// `roughness` 0..1; α is its square.
    pub(crate) fn from_roughness(roughness: f32) -> Self {
        const STRAIGHT: [f32; 5] = [25.3245, 3.324_35, 0.168_01, -1.273_93, -4.859_67];
        const TANGLED: [f32; 5] = [21.5473, 3.829_87, 0.198_23, -1.9776, -4.320_54];
        let roughness = roughness.max(Self::MIN_ROUGHNESS);
        let alpha = roughness * roughness;
        let straight = (1.0 - alpha) * (1.0 - alpha);
        let fit = std::array::from_fn(|i| STRAIGHT[i] * straight + TANGLED[i] * (1.0 - straight));
        Self { roughness, exponent: 1.0 / alpha, fit }
    }

    /// D V.
    pub(crate) fn eval(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.d(wo + wi) * Self::v([wo.z, wi.z], self.lambda(wo.z) + self.lambda(wi.z))
    }

    /// D of the facet whose normal is along `h`.
    fn d(&self, h: Vec3) -> f32 {
        let sin_sq = h.truncate().length_squared() / h.length_squared().max(f32::MIN_POSITIVE);
        (2.0 + self.exponent) / TAU * libm::powf(sin_sq.min(1.0), 0.5 * self.exponent)
    }

    fn v(cosines: [f32; 2], lambda: f32) -> f32 {
        let [cos_o, cos_i] = cosines.map(|cos| cos.max(Self::MIN_COS));
        1.0 / ((1.0 + lambda) * 4.0 * cos_o * cos_i)
    }

    fn lambda(&self, cos: f32) -> f32 {
        let [a, b, c, d, e] = self.fit;
        let ln = |x: f32| a / (1.0 + b * libm::powf(x, c)) + d * x + e;
        let cos = cos.clamp(Self::MIN_COS, 1.0);
        libm::expf(if cos < 0.5 { ln(cos) } else { 2.0 * ln(0.5) - ln(1.0 - cos) })
    }

    /// E: the share of the light at an angle that is scattered.
    pub(crate) fn share(&self, cos: f32) -> f32 {
        let (row, rest) = self.row();
        let at = |row: usize| interpolate(&TABLE.shares[row], cos.clamp(0.0, 1.0).sqrt());
        at(row).lerp(at(row + 1), rest)
    }

    /// Ē: the mean of E, ∫ E cos θ dω / π.
    pub(crate) fn mean_share(&self) -> f32 {
        let (row, rest) = self.row();
        TABLE.means[row].lerp(TABLE.means[row + 1], rest)
    }

    fn row(&self) -> (usize, f32) {
        place((self.roughness - Self::MIN_ROUGHNESS) / (1.0 - Self::MIN_ROUGHNESS), Table::ROWS)
    }

    /// The shares at the columns of the table, by midpoints in √cos θᵢ and the azimuth.
    fn integrate(&self) -> [f32; Table::COLUMNS] {
        const N: usize = 48;
        const TURNS: usize = 32;
        let middles: [f32; N] = std::array::from_fn(|i| (i as f32 + 0.5) / N as f32);
        let lambdas = middles.map(|x| self.lambda(x * x));
        std::array::from_fn(|column| {
            let wo = direction(column as f32 / (Table::COLUMNS - 1) as f32, 0.0);
            let lambda_o = self.lambda(wo.z);
            let ring = |(x, lambda): (f32, f32)| {
                let ds = (0..TURNS).map(|j| self.d(wo + direction(x, 0.5 * (j as f32 + 0.5) / TURNS as f32)));
                // dω = d(cos θ) dφ = 2x dx dφ
                Self::v([wo.z, x * x], lambda_o + lambda) * x * x * 2.0 * x * ds.sum::<f32>()
            };
            middles.into_iter().zip(lambdas).map(ring).sum::<f32>() * TAU / (N * TURNS) as f32
        })
    }
}

/// The direction of √cos θ and of an azimuth in turns.
fn direction(x: f32, turns: f32) -> Vec3 {
    let (sin, cos) = sin_cos_turns(turns);
    let across = (1.0 - x.powi(4)).max(0.0).sqrt();
    Vec3::new(across * cos, across * sin, x * x)
}

/// E at even steps of roughness from [`Charlie::MIN_ROUGHNESS`] to 1 and of √cos θ from 0 to 1; linear in between.
struct Table {
    shares: [[f32; Table::COLUMNS]; Table::ROWS],
    means: [f32; Table::ROWS],
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let shares = std::array::from_fn(|row| {
        let step = (1.0 - Charlie::MIN_ROUGHNESS) / (Table::ROWS - 1) as f32;
        Charlie::from_roughness(Charlie::MIN_ROUGHNESS + row as f32 * step).integrate()
    });
    Table { shares, means: shares.map(|row| Table::mean(&row)) }
});

impl Table {
    const ROWS: usize = 16;
    const COLUMNS: usize = 32;

    /// ∫ E 2 cos θ d(cos θ) = ∫ E 4x³ dx of what is linear in x from column to column.
    fn mean(row: &[f32; Self::COLUMNS]) -> f32 {
        const STEP: f32 = 1.0 / (Table::COLUMNS - 1) as f32;
        // With x = x₀ + STEP t, E = E₀ + (E₁ − E₀) t; Simpson's rule is off by 1e-7.
        let piece = |(i, pair): (usize, &[f32])| {
            let at = |t: f32| pair[0].lerp(pair[1], t) * 4.0 * ((i as f32 + t) * STEP).powi(3);
            (at(0.0) + 4.0 * at(0.5) + at(1.0)) * STEP / 6.0
        };
        row.windows(2).enumerate().map(piece).sum()
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use super::*;

    /// E by midpoints in θᵢ.
    fn share(charlie: Charlie, cos: f32) -> f64 {
        const N: u32 = 160;
        let wo = direction(cos.sqrt(), 0.3);
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(N);
        let values = (0..N).flat_map(|i| (0..N).map(move |j| (middle(i), middle(j)))).map(|(x, turn)| {
            let (theta, phi) = (x * f64::from(PI) / 2.0, turn * f64::from(TAU));
            let wi = Vec3::new((theta.sin() * phi.cos()) as f32, (theta.sin() * phi.sin()) as f32, theta.cos() as f32);
            f64::from(charlie.eval(wo, wi)) * theta.cos() * theta.sin()
        });
        values.sum::<f64>() * f64::from(PI * PI) / f64::from(N * N)
    }

    /// Also between its nodes, and never above 1.
    #[test]
    fn table_is_the_integral() {
        for roughness in [0.0, 0.3, 0.33, 0.5, 0.71, 1.0] {
            let charlie = Charlie::from_roughness(roughness);
            for cos in [0.0, 0.004, 0.012, 0.1, 0.5, 0.9, 1.0] {
                let (table, exact) = (charlie.share(cos), share(charlie, cos));
                assert!((f64::from(table) - exact).abs() < 5e-3, "{table}, not {exact}: {roughness}, cosine {cos}");
                assert!(exact < 1.0 && table < 1.0);
            }
        }
    }

    /// The mean over directions of the shares between nodes.
    #[test]
    fn means_are_of_the_shares() {
        const N: u32 = 20_000;
        for roughness in [0.3, 0.45, 1.0] {
            let charlie = Charlie::from_roughness(roughness);
            let cosines = (0..N).map(|i| ((i as f32 + 0.5) / N as f32).sqrt());
            let mean = cosines.map(|cos| f64::from(charlie.share(cos))).sum::<f64>() / f64::from(N);
            assert!((f64::from(charlie.mean_share()) - mean).abs() < 1e-4, "{mean} at {roughness}");
        }
    }

    /// The facets' projections cover the surface: ∫ D cos θ dω = 1.
    #[test]
    fn facets_cover_the_surface() {
        for roughness in [0.3, 1.0 / 3.0, 0.7, 1.0] {
            let charlie = Charlie::from_roughness(roughness);
            let sum: f32 = (0..10_000)
                .map(|i| (i as f32 + 0.5) * PI / 20_000.0)
                .map(|theta| charlie.d(3.0 * Vec3::new(theta.sin(), 0.0, theta.cos())) * theta.sin() * theta.cos())
                .sum();
            assert!((sum * TAU * PI / 20_000.0 - 1.0).abs() < 1e-4, "{sum}");
        }
    }

    /// Both branches meet, and the lower the light, the more of it is shadowed.
    #[test]
    fn shadowing_is_continuous() {
        for roughness in [0.3, 0.6, 1.0] {
            let charlie = Charlie::from_roughness(roughness);
            assert!((charlie.lambda(0.499_999) / charlie.lambda(0.5) - 1.0).abs() < 1e-4);
            assert!(charlie.lambda(0.0).is_finite() && charlie.lambda(1.0) < charlie.lambda(0.1));
        }
    }
}
