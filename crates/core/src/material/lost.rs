//! What microfacets lose: the share of the light that is reflected from facet to facet, which single scattering leaves out.
//!
//! If facets reflect all light, those that are seen from w send the share
//!
//! E(w) = ∫ D G₂ / (4 cos θ) dwᵢ
//!
//! on at once, and 1 − E(w) meets further facets. There is no formula for it, so E is the mean of G₂ / G₁ over visible
//! normals ([`Ggx::sample`]), on a grid of angles and roughnesses, computed when it is first needed (a tenth of a second,
//! and some more for brushed metal), and interpolated. The grid is finest where cos θ is about alpha, where facets hide one another most;
//! smooth surfaces are alike there, if one counts in cos θ / alpha. Kulla & Conty 2017, "Revisiting Physically Based
//! Shading at Imageworks".
//!
//! Brushed metal has a grid for each of a few aspects and azimuths.

use std::array::from_fn;
use std::sync::LazyLock;

use glam::{FloatExt, Vec2, Vec3};

use crate::material::microfacet::{Ggx, reflect_at};
use crate::math::{interpolate, place, sin_cos_turns};

/// 1 − E(w) for a `w` above the surface, 0..1.
#[inline(never)]
pub(super) fn lost(ggx: Ggx, w: Vec3) -> f32 {
    if ggx.is_isotropic() { ISOTROPIC.grid.at(ggx.alpha(), ggx.alpha(), w.z) } else { ANISOTROPIC.lost(ggx, w) }
}

/// The mean of 1 − E(w) over an evenly lit surface: ∫ (1 − E) cos θ / π dw.
#[inline(never)]
pub(super) fn mean_lost(ggx: Ggx) -> f32 {
    let alpha = ggx.alpha();
    let mean_over_alpha = if ggx.is_isotropic() {
        interpolate(&ISOTROPIC.mean, alpha.sqrt())
    } else {
        let (aspect, between) = place(ANISOTROPIC.aspect(ggx), ASPECTS);
        let [near, far] = [aspect, aspect + 1].map(|i| interpolate(&ANISOTROPIC.mean[i], alpha.sqrt()));
        near.lerp(far, between)
    };
    mean_over_alpha * alpha
}

/// Steps of alpha and of the angle.
const FINE: usize = 32;
const COARSE: usize = 20;
/// Steps of the aspect and of the azimuth.
const ASPECTS: usize = 5;
const AZIMUTHS: usize = 4;

static ISOTROPIC: LazyLock<Isotropic> = LazyLock::new(Isotropic::new);
static ANISOTROPIC: LazyLock<Anisotropic> = LazyLock::new(Anisotropic::new);

/// Step `i` of `count` over 0..=1.
fn step(i: usize, count: usize) -> f32 {
    i as f32 / (count - 1) as f32
}

/// The alphas of a grid's rows: even in roughness, from the smoothest that is not a mirror.
fn row_alpha(i: usize, count: usize) -> f32 {
    (step(i, count) * step(i, count)).max(Ggx::MIN_ALPHA)
}

/// What is lost for one aspect and azimuth: rows of roughness, columns of the angle.
struct Grid<const N: usize>([[f32; N]; N]);

impl<const N: usize> Grid<N> {
    /// `facets` are those of an alpha, `azimuth` the direction (cos, sin) of their views.
    fn new(facets: impl Fn(f32) -> Ggx, azimuth: impl Fn(Ggx) -> Vec2) -> Self {
        Self(from_fn(|row| {
            let ggx = facets(row_alpha(row, N));
            let azimuth = azimuth(ggx);
            from_fn(|column| {
                let cos = Self::cos(step(column, N), along(ggx, azimuth)).clamp(1e-6, 1.0);
                integrate(ggx, (azimuth * ((1.0 - cos) * (1.0 + cos)).sqrt()).extend(cos))
            })
        }))
    }

    /// The cosine at a column (0..=1), for the width `along` the azimuth.
    fn cos(column: f32, along: f32) -> f32 {
        along * column / (1.0 + along - column)
    }

    /// Interpolated, for the width `along` the azimuth.
    #[inline]
    fn at(&self, alpha: f32, along: f32, cos: f32) -> f32 {
        let (row, between) = place(alpha.sqrt(), N);
        let column = cos * (1.0 + along) / (cos + along);
        let [near, far] = [row, row + 1].map(|row| interpolate(&self.0[row], column));
        near.lerp(far, between)
    }
}

/// The width of the slopes along an azimuth.
#[inline]
fn along(ggx: Ggx, azimuth: Vec2) -> f32 {
    (ggx.alphas() * azimuth).length()
}

/// 1 − E(wo): one minus the mean of G₂ / G₁ over visible normals, of which steep ones, that send light down, are looked at
/// more closely.
fn integrate(ggx: Ggx, wo: Vec3) -> f32 {
    const N: u8 = 32;
    let midpoint = |i: u8| (f32::from(i) + 0.5) / f32::from(N);
    let mut sum = 0.0;
    for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
        let rest = 1.0 - midpoint(j);
        let wi = reflect_at(wo, ggx.sample(wo, Vec2::new(midpoint(i), 1.0 - rest * rest)));
        let kept = if wi.z > 0.0 { ggx.g2_over_g1(wo, wi) } else { 0.0 };
        sum += f64::from((1.0 - kept) * 2.0 * rest);
    }
    (sum / f64::from(u32::from(N).pow(2))) as f32
}

/// The mean of what is lost, over alpha, in steps of roughness.
fn means<const N: usize>(facets: impl Fn(f32) -> Ggx, lost: impl Fn(Ggx, Vec3) -> f32, azimuths: u8) -> [f32; N] {
    const COLUMNS: u16 = 512;
    from_fn(|row| {
        let ggx = facets(row_alpha(row, N));
        let mut sum = 0.0;
        for i in 0..azimuths {
            // Quarters are alike.
            let (sin, cos) = sin_cos_turns((f32::from(i) + 0.5) / f32::from(azimuths) * 0.25);
            let azimuth = Vec2::new(cos, sin);
            for j in 0..COLUMNS {
                let [near, middle, far] = [0.0, 0.5, 1.0].map(|t| {
                    let root = (f32::from(j) + t) / f32::from(COLUMNS);
                    root * root
                });
                let w = (azimuth * ((1.0 - middle) * (1.0 + middle)).sqrt()).extend(middle);
                sum += f64::from(lost(ggx, w) * (far - near) * (far + near));
            }
        }
        (sum / f64::from(azimuths)) as f32 / ggx.alpha()
    })
}

struct Isotropic {
    grid: Grid<FINE>,
    mean: [f32; FINE],
}

impl Isotropic {
    fn new() -> Self {
        let grid = Grid::new(Ggx::from_alpha, |_| Vec2::X);
        let mean = means(Ggx::from_alpha, |ggx, w| grid.at(ggx.alpha(), ggx.alpha(), w.z), 1);
        Self { grid, mean }
    }
}

/// Grids for aspects from 1 to the narrowest, and for azimuths from across, where the facets are smoothest, to along.
struct Anisotropic {
    grids: [[Grid<COARSE>; AZIMUTHS]; ASPECTS],
    mean: [[f32; COARSE]; ASPECTS],
}

impl Anisotropic {
    fn new() -> Self {
        let aspect = |i| 1.0 + step(i, ASPECTS) * (Ggx::MIN_ASPECT - 1.0);
        let facets = |i| move |alpha| Ggx::from_alpha(alpha).with_aspect(aspect(i));
        let grids = from_fn(|i| {
            from_fn(|j| {
                let azimuth = |ggx: Ggx| {
                    let alphas = ggx.alphas();
                    let along = alphas.y + (alphas.x - alphas.y) * step(j, AZIMUTHS);
                    let range = (alphas.x - alphas.y) * (alphas.x + alphas.y);
                    let cos_sq = if range > 0.0 { (along - alphas.y) * (along + alphas.y) / range } else { 1.0 };
                    let cos_sq = cos_sq.clamp(0.0, 1.0);
                    Vec2::new(cos_sq.sqrt(), (1.0 - cos_sq).sqrt())
                };
                Grid::new(facets(i), azimuth)
            })
        });
        let mut all = Self { grids, mean: [[0.0; COARSE]; ASPECTS] };
        all.mean = from_fn(|i| means(facets(i), |ggx, w| all.lost(ggx, w), 16));
        all
    }

    /// Where the aspect is among the steps, 0..=1.
    #[inline]
    fn aspect(&self, ggx: Ggx) -> f32 {
        (1.0 - ggx.alphas().y / ggx.alpha()) / (1.0 - Ggx::MIN_ASPECT)
    }

    fn lost(&self, ggx: Ggx, w: Vec3) -> f32 {
        let alphas = ggx.alphas();
        let azimuth = w.truncate().try_normalize().unwrap_or(Vec2::X);
        let along = along(ggx, azimuth);
        let (aspect, between_aspects) = place(self.aspect(ggx), ASPECTS);
        let range = (alphas.x - alphas.y).max(f32::MIN_POSITIVE);
        let (turn, between_turns) = place((along - alphas.y) / range, AZIMUTHS);
        let [near, far] = [aspect, aspect + 1].map(|i| {
            let [near, far] = [turn, turn + 1].map(|j| self.grids[i][j].at(ggx.alpha(), along, w.z));
            near.lerp(far, between_turns)
        });
        near.lerp(far, between_aspects)
    }
}

/// A direction whose cosine is about alpha: the density of t = cos (1 + alpha) / (cos + alpha) is 2 t.
#[inline]
pub(super) fn near_horizon(alpha: f32, u: Vec2) -> Vec3 {
    let t = u.y.sqrt();
    let cos = (alpha * t / (1.0 - t + alpha)).min(1.0);
    let (y, x) = sin_cos_turns(u.x);
    (Vec2::new(x, y) * ((1.0 - cos) * (1.0 + cos)).sqrt()).extend(cos)
}

/// The density of [`near_horizon`] over cos / π.
#[inline]
pub(super) fn horizon_over_cosine(alpha: f32, cos: f32) -> f32 {
    let sum = cos + alpha;
    alpha * (1.0 + alpha) * (1.0 + alpha) / (sum * sum * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::material::Conductor;
    use crate::texture::NoTextures;

    fn white(roughness: f32) -> Conductor {
        Conductor { reflectance: Some(Rgb::grey(1.0).into()), roughness: roughness.into(), ..Conductor::default() }
    }

    /// Without what goes from facet to facet.
    fn once(metal: Conductor) -> Conductor {
        Conductor { compensation: false, ..metal }
    }

    /// The share of light from all around that leaves towards `wo`: visible normals for what is scattered once, and evenly
    /// spaced directions for the rest.
    fn directional_albedo(metal: &Conductor, wo: Vec3) -> f64 {
        const N: u16 = 64;
        let once = once(metal.clone()).bsdf(&NoTextures);
        let midpoint = |i: u16| (f32::from(i) + 0.5) / f32::from(N);
        let mut sum = 0.0;
        for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
            // More closely where the facets are steep, and where the light is grazing.
            let (turn, rest) = (midpoint(i), midpoint(j));
            let weight = once.sample(wo, 0.0, Vec2::new(turn, 1.0 - rest * rest)).map_or(0.0, |s| s.weight.to_rgb()[0]);
            let cos = rest * rest;
            let (sin, radius) = ((1.0 - cos * cos).sqrt(), std::f32::consts::TAU * turn);
            let wi = Vec3::new(sin * radius.cos(), sin * radius.sin(), cos);
            let [all, first] = [metal.bsdf(&NoTextures), once].map(|lobe| lobe.eval_pdf(wo, wi).0.to_rgb()[0]);
            sum += f64::from(weight * 2.0 * rest + (all - first) * std::f32::consts::TAU * 2.0 * rest);
        }
        sum / f64::from(N).powi(2)
    }

    /// A white furnace: nothing is lost, and nothing is won.
    #[test]
    fn white_metal_reflects_all() {
        for roughness in [0.025, 0.05, 0.1, 0.17, 0.3, 0.42, 0.55, 0.7, 0.85, 0.97, 1.0] {
            for cos in [1.0_f32, 0.9, 0.6, 0.35, 0.2, 0.1, 0.05, 0.02, 0.005, 1e-3] {
                let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let share = directional_albedo(&white(roughness), wo);
                assert!((share - 1.0).abs() < 0.01, "{share} at roughness {roughness}, cosine {cos}");
            }
        }
        assert!(directional_albedo(&once(white(1.0)), Vec3::Z) < 0.31);
    }

    /// The same for brushed metal, whose table is coarser.
    #[test]
    fn white_brushed_metal_reflects_nearly_all() {
        for (roughness, anisotropy) in [0.1, 0.3, 0.6, 1.0].into_iter().flat_map(|r| [0.2, 0.6, 0.9].map(|a| (r, a))) {
            for (cos, turn) in
                [1.0_f32, 0.6, 0.2, 0.05].into_iter().flat_map(|c| [0.0_f32, 0.1, 0.18, 0.25].map(|t| (c, t)))
            {
                let (sin, radius) = ((1.0 - cos * cos).sqrt(), std::f32::consts::TAU * turn);
                let wo = Vec3::new(sin * radius.cos(), sin * radius.sin(), cos);
                let share = directional_albedo(&Conductor { anisotropy, ..white(roughness) }, wo);
                assert!(
                    (share - 1.0).abs() < 0.03,
                    "{share}: roughness {roughness}, {anisotropy}, cosine {cos}, turn {turn}"
                );
            }
        }
    }

    /// The table of docs/theory/microfacets.md: the share of the light, in percent, that white metal sends back, without and
    /// with what goes from facet to facet.
    #[test]
    fn documented_shares() {
        let mut table = String::from("| roughness | 0° | 30° | 60° | 80° | 89° |\n|---|---|---|---|---|---|\n");
        for roughness in [0.2, 0.4, 0.6, 0.8, 1.0] {
            let shares = [0.0_f32, 30.0, 60.0, 80.0, 89.0].map(|degrees| {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let wo = Vec3::new(sin, 0.0, cos);
                let [once, all] =
                    [once(white(roughness)), white(roughness)].map(|m| 100.0 * directional_albedo(&m, wo));
                format!("{once:.0} → {all:.0}")
            });
            table += &format!("| {roughness:.1} | {} |\n", shares.join(" | "));
        }
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/theory/microfacets.md");
        let text = std::fs::read_to_string(page).unwrap();
        assert!(text.contains(&table), "the table of {page} should be\n\n{table}");
    }
}
