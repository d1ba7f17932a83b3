//! What a clear boundary of facets reflects: the share of the light that lies below must go without.
//!
//! Seen from w outside, facets (see [`Ggx`]) of an index of refraction send the share
//!
//! E(w) = ∫ F D G₂ / (4 cos θ) dwᵢ
//!
//! back at once. What facets reflect on to other facets is hardly reflected again: for glass it is below 0.3 % of the light, and
//! counts as going in. There is no formula for E, so E over Fresnel's share at w, which is near to 1 but where facets
//! hide one another, is computed for a grid of indices, roughnesses and angles when it is first needed (about a tenth of a second).
//! The grid is that of `lost.rs`, where no light goes in.

use std::array::from_fn;
use std::sync::LazyLock;

use glam::{FloatExt, Vec2, Vec3};

use crate::color::Spectrum;
use crate::material::Fresnel;
use crate::material::microfacet::{Ggx, reflect_at};
use crate::math::{interpolate, place};

/// A clear boundary, seen from where light is faster.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boundary {
    alpha: f32,
    eta: f32,
}

impl Boundary {
    /// The largest index; nothing clear has more.
    pub(super) const MAX_ETA: f32 = 3.0;

    /// Facets of a width 0..=1, and the index inside over outside, 1..=[`MAX_ETA`](Self::MAX_ETA).
    #[inline]
    pub(super) fn new(alpha: f32, eta: f32) -> Self {
        Self { alpha, eta }
    }

    /// The index inside over outside.
    #[inline]
    pub(super) fn eta(self) -> f32 {
        self.eta
    }

    /// The facets.
    #[inline]
    pub(super) fn ggx(self) -> Ggx {
        Ggx::from_alpha(self.alpha)
    }

    /// Whether it reflects as a mirror does.
    #[inline]
    pub(super) fn is_smooth(self) -> bool {
        self.alpha < Ggx::MIN_ALPHA
    }

    /// What a facet reflects, 0..=1; the cosine is that of the light to the facet's normal.
    #[inline]
    pub(super) fn fresnel(self, cos: f32) -> f32 {
        Fresnel::dielectric(cos.min(1.0), self.eta).reflectance
    }

    /// E for a direction above the surface of this cosine, 0..=1.
    #[inline(never)]
    pub(super) fn share(self, cos: f32) -> f32 {
        if self.is_smooth() {
            self.fresnel(cos)
        } else {
            (self.fresnel(self.cos_of_facets(cos)) * TABLE.ratio(self, cos)).min(1.0)
        }
    }

    /// About the same where `reflectance` says what a facet reflects: nearly as much as without a film, for one.
    #[inline]
    pub(super) fn share_of(self, cos: f32, reflectance: impl Fn(f32) -> Spectrum) -> Spectrum {
        if self.is_smooth() {
            reflectance(cos)
        } else {
            (reflectance(self.cos_of_facets(cos)) * TABLE.ratio(self, cos)).clamp(0.0, 1.0)
        }
    }

    /// About the cosine at which facets are seen: the area of them that is.
    #[inline]
    fn cos_of_facets(self, cos: f32) -> f32 {
        let sin_sq = (1.0 - cos) * (1.0 + cos);
        0.5 * (cos + (cos * cos + self.alpha * self.alpha * sin_sq).sqrt())
    }

    /// The mean of E over an evenly lit surface, ∫ E cos θ / π dw.
    #[inline(never)]
    pub(super) fn mean_share(self) -> f32 {
        let (layer, between) = place(Table::layer(self.eta), Table::LAYERS);
        let [near, far] = [layer, layer + 1].map(|layer| interpolate(&TABLE.means[layer], Table::row(self.alpha)));
        near.lerp(far, between)
    }

    /// The share of light from all around inside that is reflected back inside. As much light goes either way through a
    /// boundary: eta² (1 − this) = 1 − Ē.
    #[inline]
    pub(super) fn mean_share_inside(self) -> f32 {
        1.0 - (1.0 - self.mean_share()) / (self.eta * self.eta)
    }
}

static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

/// E over Fresnel's share: layers of the index, rows of the roughness, columns of the angle; and Ē.
struct Table {
    ratios: [[[f32; Table::COLUMNS]; Table::ROWS]; Table::LAYERS],
    means: [[f32; Table::ROWS]; Table::LAYERS],
}

impl Table {
    const LAYERS: usize = 14;
    const ROWS: usize = 16;
    const COLUMNS: usize = 32;
    /// The root of [`Ggx::MIN_ALPHA`].
    const MIN_ROUGHNESS: f32 = 0.022_360_68;

    fn new() -> Self {
        let mut table = Self {
            ratios: [[[0.0; Self::COLUMNS]; Self::ROWS]; Self::LAYERS],
            means: [[0.0; Self::ROWS]; Self::LAYERS],
        };
        let etas: [f32; Self::LAYERS] = from_fn(|layer| Self::eta(step(layer, Self::LAYERS)));
        for row in 0..Self::ROWS {
            let alpha = Self::alpha(step(row, Self::ROWS));
            for column in 0..Self::COLUMNS {
                let cos = Self::cos(step(column, Self::COLUMNS), alpha).clamp(1e-6, 1.0);
                let shares = integrate(Ggx::from_alpha(alpha), cos, &etas);
                for (layer, share) in shares.into_iter().enumerate() {
                    let boundary = Boundary::new(alpha, etas[layer]);
                    let fresnel = boundary.fresnel(boundary.cos_of_facets(cos));
                    table.ratios[layer][row][column] = share / fresnel.max(f32::MIN_POSITIVE);
                }
            }
        }
        table.means =
            from_fn(|layer| from_fn(|row| table.mean(Boundary::new(Self::alpha(step(row, Self::ROWS)), etas[layer]))));
        table
    }

    /// Where an index is among the layers, 0..=1: even in the fourth root of Fresnel's share straight on, twice as large.
    #[inline]
    fn layer(eta: f32) -> f32 {
        (2.0 * (eta - 1.0) / (eta + 1.0)).max(0.0).sqrt()
    }

    /// Where an alpha is among the rows: even in roughness, from the smoothest that is not a mirror.
    #[inline]
    fn row(alpha: f32) -> f32 {
        (alpha.sqrt() - Self::MIN_ROUGHNESS) / (1.0 - Self::MIN_ROUGHNESS)
    }

    /// The alpha at a place.
    fn alpha(row: f32) -> f32 {
        let roughness = Self::MIN_ROUGHNESS + (1.0 - Self::MIN_ROUGHNESS) * row;
        roughness * roughness
    }

    /// The index at a place; not 1, where nothing is reflected.
    fn eta(layer: f32) -> f32 {
        ((2.0 + layer * layer) / (2.0 - layer * layer)).max(1.0 + 1e-4)
    }

    /// The cosine at a column (0..=1).
    fn cos(column: f32, alpha: f32) -> f32 {
        alpha * column / (1.0 + alpha - column)
    }

    #[inline]
    fn ratio(&self, boundary: Boundary, cos: f32) -> f32 {
        let Boundary { alpha, eta } = boundary;
        let (layer, between_layers) = place(Self::layer(eta), Self::LAYERS);
        let (row, between_rows) = place(Self::row(alpha), Self::ROWS);
        let column = cos * (1.0 + alpha) / (cos + alpha);
        let [near, far] = [layer, layer + 1].map(|layer| {
            let [near, far] = [row, row + 1].map(|row| interpolate(&self.ratios[layer][row], column));
            near.lerp(far, between_rows)
        });
        near.lerp(far, between_layers)
    }

    /// ∫ E 2 cos θ d(cos θ), by midpoints in √cos θ.
    fn mean(&self, boundary: Boundary) -> f32 {
        const N: u16 = 256;
        // There is none.
        if boundary.eta <= Self::eta(0.0) {
            return 0.0;
        }
        let piece = |i: u16| {
            let [near, middle, far] = [0.0, 0.5, 1.0].map(|t| {
                let root = (f32::from(i) + t) / f32::from(N);
                root * root
            });
            let fresnel = boundary.fresnel(boundary.cos_of_facets(middle));
            f64::from((fresnel * self.ratio(boundary, middle)).min(1.0) * (far - near) * (far + near))
        };
        (0..N).map(piece).sum::<f64>() as f32
    }
}

/// Step `i` of `count` over 0..=1.
fn step(i: usize, count: usize) -> f32 {
    i as f32 / (count - 1) as f32
}

/// E for some indices: the mean of F G₂ / G₁ over visible normals, of which steep ones are looked at more closely.
fn integrate<const N: usize>(ggx: Ggx, cos: f32, etas: &[f32; N]) -> [f32; N] {
    const SIDE: u8 = 32;
    let wo = Vec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
    let midpoint = |i: u8| (f32::from(i) + 0.5) / f32::from(SIDE);
    let mut sums = [0.0_f64; N];
    for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
        let rest = 1.0 - midpoint(j);
        let m = ggx.sample(wo, Vec2::new(midpoint(i), 1.0 - rest * rest));
        let wi = reflect_at(wo, m);
        if wi.z > 0.0 {
            let (seen, cos) = (ggx.g2_over_g1(wo, wi) * 2.0 * rest, wo.dot(m).clamp(0.0, 1.0));
            sums.iter_mut()
                .zip(etas)
                .for_each(|(sum, &eta)| *sum += f64::from(seen * Fresnel::dielectric(cos, eta).reflectance));
        }
    }
    sums.map(|sum| (sum / f64::from(u32::from(SIDE).pow(2))) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table between its places, against more and other points.
    #[test]
    fn table_interpolates_shares() {
        const N: u16 = 200;
        let midpoint = |i: u16| (f32::from(i) + 0.5) / f32::from(N);
        for eta in [1.02, 1.05, 1.2, 1.33, 1.5, 1.8, 2.42, 3.0] {
            for roughness in [0.03, 0.1, 0.23, 0.35, 0.5, 0.7, 0.9, 1.0_f32] {
                let boundary = Boundary::new(roughness * roughness, eta);
                for cos in [1.0_f32, 0.8, 0.55, 0.3, 0.15, 0.07, 0.03, 0.01, 1e-3] {
                    let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                    let mut sum = 0.0;
                    for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
                        let rest = midpoint(j);
                        let m = boundary.ggx().sample(wo, Vec2::new(midpoint(i), 1.0 - rest * rest));
                        let wi = reflect_at(wo, m);
                        if wi.z > 0.0 {
                            let seen = boundary.ggx().g2_over_g1(wo, wi) * 2.0 * rest;
                            sum += f64::from(seen * boundary.fresnel(wo.dot(m).max(0.0)));
                        }
                    }
                    let exact = sum / f64::from(N).powi(2);
                    let share = f64::from(boundary.share(cos));
                    assert!(
                        (share - exact).abs() < 5e-3,
                        "{share}, not {exact}, at eta {eta}, roughness {roughness}, cosine {cos}"
                    );
                }
            }
        }
    }

    /// Smooth: the mean of Fresnel's share by its formula (Walsh 1926), 9.178 % for glass of index 1.5 and 6.613 % of 1.33.
    #[test]
    fn known_means() {
        for (eta, mean) in [(1.5, 0.091_78), (4.0 / 3.0, 0.066_2)] {
            let found = Boundary::new(0.0, eta).mean_share();
            assert!((found - mean).abs() < 1e-3, "{found}, not {mean}");
        }
        let inside = Boundary::new(0.0, 1.5).mean_share_inside();
        assert!((inside - 0.596).abs() < 1e-3, "{inside}");
    }
}
