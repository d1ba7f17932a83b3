//! Thin film: a layer so thin that light from its two sides interferes, such as soap, oil on water, oxide on hot steel.
//!
//! Between the outside (1), the film (2) and what it lies on (3), with the amplitudes a = r₁₂ and r₂₃ that Fresnel's equations give
//! for one polarisation, all that goes to and fro adds up to (Airy 1833; Born & Wolf, Principles of Optics, 7th ed. 1999, §7.6)
//!
//! r = (a + r₂₃ e^iδ) / (1 + a r₂₃ e^iδ), δ = 2π D / λ, D = 2 eta thickness cos θ₂,
//!
//! where |r|² = 1 − T (1 + 2 Re Σ qᵐ e^imδ), q = −a r₂₃, T = (1 − a²) (1 − |r₂₃|²) / (1 − |q|²), m = 1, 2, … What a
//! channel of a colour sees of e^imδ is its mean over the wavelengths that it is sensitive to, a function of m D alone: it is kept
//! in a table, and no wavelengths are drawn. Belcour & Barla 2017, doi:10.1145/3072959.3073620, do so with Gaussians for the
//! channels. What is outside of Rec. 709 is cut off at 0 and 1, so the rest of the light goes through.
//!
//! ```toml
//! [material.bubble.dielectric]
//! eta = 1.0
//! thin_film = { thickness = 400, eta = 1.33 }
//!
//! [material.steel.conductor]
//! metal = "iron"
//! roughness = 0.3
//! thin_film = { thickness = 50, eta = 2.4 }
//! ```

use std::array::from_fn;
use std::sync::LazyLock;

use glam::{FloatExt, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum, XYZ_TO_RGB, x_bar, y_bar, z_bar};
use crate::math::sin_cos_turns;
use crate::validate::Checker;

/// A film of one thickness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ThinFilm {
    /// Nanometres, 0..2000; 0 is no film.
    #[schemars(range(min = 0.0, max = 2000.0))]
    pub thickness: f32,
    /// Index of refraction over that outside, 1..5: soap and water 1.33, oil 1.5, oxides of iron and titanium 2.4 to 2.9.
    #[schemars(range(min = 1.0, max = 5.0))]
    pub eta: f32,
}

impl Default for ThinFilm {
    fn default() -> Self {
        Self { thickness: 400.0, eta: 1.33 }
    }
}

/// Amplitudes that what lies below a film reflects, of light polarised across and along the plane of incidence. As a complex
/// number each: x is the real part.
type Amplitudes = [Vec2; 2];

impl ThinFilm {
    pub(crate) const MAX_THICKNESS: f32 = 2000.0;
    pub(crate) const MAX_ETA: f32 = 5.0;

    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("thickness", self.thickness, 0.0, Self::MAX_THICKNESS);
        c.in_range("eta", self.eta, 1.0, Self::MAX_ETA);
    }

    /// There is no film.
    pub(super) const NONE: Self = Self { thickness: 0.0, eta: 1.0 };

    /// Whether there is one.
    #[inline]
    pub(super) fn is_there(self) -> bool {
        self.thickness > 0.0
    }

    /// What a film on something clear reflects of unpolarised light, 0..1. `cos_i` and `cos_t` are the cosines outside of
    /// both, before and behind, `eta` the index behind over before. `outside` tells whether before is where the film's index is
    /// one over. As nothing is absorbed, the same share is reflected either way.
    #[inline(never)]
    pub(super) fn on_clear(self, [cos_i, cos_t]: [f32; 2], eta: f32, outside: bool) -> Spectrum {
        // From the side where light is faster, all angles are possible in the film.
        let (cos, slow, film) = match (eta >= 1.0, outside) {
            (true, true) => (cos_i, eta, self.eta),
            (true, false) => (cos_i, eta, self.eta * eta),
            (false, true) => (cos_t, 1.0 / eta, self.eta / eta),
            (false, false) => (cos_t, 1.0 / eta, self.eta),
        };
        let root = |x: f32| x.max(0.0).sqrt();
        let sin_sq = (1.0 - cos) * (1.0 + cos);
        let (in_film, below) = (root(film * film - sin_sq), root(slow * slow - sin_sq));
        let across = ratio(in_film - below, in_film + below);
        let along = ratio(slow * slow * in_film - film * film * below, slow * slow * in_film + film * film * below);
        let amplitudes = [Vec2::new(across, 0.0), Vec2::new(along, 0.0)];
        self.reflectance(cos, film, |_| amplitudes)
    }

    /// The same on metal of the complex index `eta` + i `k` over that outside.
    #[inline(never)]
    pub(super) fn on_metal(self, cos: f32, eta: Rgb, k: Rgb) -> Spectrum {
        let sin_sq = (1.0 - cos) * (1.0 + cos);
        let in_film = Vec2::new((self.eta * self.eta - sin_sq).max(0.0).sqrt(), 0.0);
        self.reflectance(cos, self.eta, |channel| {
            let index = Vec2::new(eta.0[channel], k.0[channel]);
            let index_sq = index.rotate(index);
            let below = complex_root(index_sq - Vec2::new(sin_sq, 0.0));
            let (above, film_sq) = (index_sq.rotate(in_film), self.eta * self.eta);
            [
                complex_ratio(in_film - below, in_film + below),
                complex_ratio(above - film_sq * below, above + film_sq * below),
            ]
        })
    }

    /// The same on a mirror that reflects a share of each channel, and turns light's phase as perfect metal does.
    #[inline(never)]
    pub(super) fn on_mirror(self, cos: f32, share: Spectrum) -> Spectrum {
        let amplitudes = share.to_rgb().map(|share| share.clamp(0.0, 1.0).sqrt());
        self.reflectance(cos, self.eta, |channel| {
            let amplitude = amplitudes[channel];
            [Vec2::new(-amplitude, 0.0), Vec2::new(amplitude, 0.0)]
        })
    }

    /// |r|² for a cosine outside, an index of the film over that there, and what is below in each channel.
    #[inline]
    fn reflectance(self, cos: f32, film: f32, below: impl Fn(usize) -> Amplitudes) -> Spectrum {
        let sin_sq = (1.0 - cos) * (1.0 + cos);
        // eta cos θ₂, by the film's index over that outside.
        let in_film = (film * film - sin_sq).max(0.0).sqrt();
        let above =
            [ratio(cos - in_film, cos + in_film), ratio(film * film * cos - in_film, film * film * cos + in_film)];
        let way = 2.0 * self.thickness * self.eta * (in_film / film);
        Spectrum::from_rgb(from_fn(|channel| {
            let amplitudes = below(channel);
            let share = |i: usize| share(channel, way, above[i], amplitudes[i]);
            (0.5 * (share(0) + share(1))).clamp(0.0, 1.0)
        }))
    }
}

/// |r|² of one polarisation, seen by a channel.
#[inline]
fn share(channel: usize, way: f32, above: f32, below: Vec2) -> f32 {
    /// Terms that are smaller are left out.
    const LEAST: f32 = 1e-3;
    const MOST_TERMS: u8 = 64;
    let q = -above * below;
    let (above_sq, q_sq) = (above * above, q.length_squared());
    let through = ratio((1.0 - above_sq) * (1.0 - below.length_squared()).max(0.0), 1.0 - q_sq);
    let mut sum = 0.0;
    let (mut power, mut total) = (q, way);
    for _ in 0..MOST_TERMS {
        if power.length_squared() < LEAST * LEAST || total >= Table::END {
            break;
        }
        sum += power.rotate(TABLE.seen(channel, total)).x;
        power = power.rotate(q);
        total += way;
    }
    1.0 - through * (1.0 + 2.0 * sum)
}

/// A ratio of which the lower end is not negative; 0 over 0 is 0.
#[inline]
fn ratio(a: f32, b: f32) -> f32 {
    a / b.max(f32::MIN_POSITIVE)
}

#[inline]
fn complex_ratio(a: Vec2, b: Vec2) -> Vec2 {
    a.rotate(Vec2::new(b.x, -b.y)) / b.length_squared().max(f32::MIN_POSITIVE)
}

/// The root that has no negative part.
#[inline]
fn complex_root(z: Vec2) -> Vec2 {
    let length = z.length();
    // The larger part first, as the other would be the difference of near numbers.
    let larger = (0.5 * (length + z.x.abs())).sqrt();
    let smaller = 0.5 * z.y.abs() / larger.max(f32::MIN_POSITIVE);
    if z.x >= 0.0 { Vec2::new(larger, smaller) } else { Vec2::new(smaller, larger) }
}

static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

/// What channels see of e^(2πi D / λ), at even steps of D; an even spectrum is white.
struct Table([Vec<Vec2>; 3]);

impl Table {
    /// Nanometres. Of longer ways nothing is seen.
    const STEP: f32 = 10.0;
    const STEPS: u16 = 1400;
    const END: f32 = Self::STEP * (Self::STEPS - 1) as f32;

    fn new() -> Self {
        let wavelengths = || (0..420_u16).map(|i| 370.5 + f64::from(i));
        Self(XYZ_TO_RGB.map(|[x, y, z]| {
            let weights: Vec<f64> = wavelengths().map(|nm| x * x_bar(nm) + y * y_bar(nm) + z * z_bar(nm)).collect();
            let all: f64 = weights.iter().sum();
            let at = |step: u16| {
                let way = f64::from(step) * f64::from(Self::STEP);
                let (mut re, mut im) = (0.0, 0.0);
                for (nm, weight) in wavelengths().zip(&weights) {
                    let turns = way / nm;
                    let (sin, cos) = sin_cos_turns((turns - turns.floor()) as f32);
                    re += weight * f64::from(cos);
                    im += weight * f64::from(sin);
                }
                Vec2::new((re / all) as f32, (im / all) as f32)
            };
            (0..Self::STEPS).map(at).collect()
        }))
    }

    #[inline]
    fn seen(&self, channel: usize, way: f32) -> Vec2 {
        let at = way / Self::STEP;
        let step = (at as usize).min(usize::from(Self::STEPS) - 2);
        let between = at - step as f32;
        let values = &self.0[channel];
        let (near, far) = (values[step], values[step + 1]);
        Vec2::new(near.x.lerp(far.x, between), near.y.lerp(far.y, between))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Fresnel, NamedMetal, fresnel_conductor};

    /// A complex number in double precision.
    type C = (f64, f64);

    fn add(a: C, b: C) -> C {
        (a.0 + b.0, a.1 + b.1)
    }

    fn mul(a: C, b: C) -> C {
        (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
    }

    fn over(a: C, b: C) -> C {
        let (re, im) = mul(a, (b.0, -b.1));
        let length_sq = b.0 * b.0 + b.1 * b.1;
        (re / length_sq, im / length_sq)
    }

    fn root(z: C) -> C {
        let length = z.0.hypot(z.1);
        ((0.5 * (length + z.0)).max(0.0).sqrt(), (0.5 * (length - z.0)).max(0.0).sqrt())
    }

    /// Airy's formula at one wavelength, from an index of 1 through a film to the index `n`; mean of both polarisations.
    fn airy(cos: f64, thickness: f64, film: f64, n: C, nm: f64) -> f64 {
        let sin_sq = 1.0 - cos * cos;
        // Index times cosine in each of the three, which is what counts across; along, it is index² over that.
        let ways = [(cos, 0.0), ((film * film - sin_sq).sqrt(), 0.0), root(add(mul(n, n), (-sin_sq, 0.0)))];
        let squares = [(1.0, 0.0), (film * film, 0.0), mul(n, n)];
        let phase = std::f64::consts::TAU * 2.0 * thickness * ways[1].0 / nm;
        let turn = (phase.cos(), phase.sin());
        let mut sum = 0.0;
        for admittances in [ways, [0, 1, 2].map(|i| over(squares[i], ways[i]))] {
            let r = |i: usize| {
                let (a, b) = (admittances[i], admittances[i + 1]);
                over(add(a, (-b.0, -b.1)), add(a, b))
            };
            let far = mul(r(1), turn);
            let whole = over(add(r(0), far), add((1.0, 0.0), mul(r(0), far)));
            sum += 0.5 * (whole.0 * whole.0 + whole.1 * whole.1);
        }
        sum
    }

    /// Airy's formula, wavelength by wavelength, seen by the channels.
    fn exact(cos: f32, film: ThinFilm, index: impl Fn(usize) -> C) -> [f64; 3] {
        from_fn(|channel| {
            let [x, y, z] = XYZ_TO_RGB[channel];
            let (mut sum, mut all) = (0.0, 0.0);
            for i in 0..4000 {
                let nm = 370.0 + f64::from(i) * 0.1;
                let weight = x * x_bar(nm) + y * y_bar(nm) + z * z_bar(nm);
                all += weight;
                sum += weight * airy(f64::from(cos), film.thickness.into(), film.eta.into(), index(channel), nm);
            }
            (sum / all).clamp(0.0, 1.0)
        })
    }

    const FILMS: [ThinFilm; 7] = [
        ThinFilm { thickness: 5.0, eta: 2.4 },
        ThinFilm { thickness: 60.0, eta: 2.4 },
        ThinFilm { thickness: 120.0, eta: 1.38 },
        ThinFilm { thickness: 300.0, eta: 1.33 },
        ThinFilm { thickness: 550.0, eta: 1.8 },
        ThinFilm { thickness: 1200.0, eta: 1.5 },
        ThinFilm { thickness: 2000.0, eta: 1.33 },
    ];
    const COSINES: [f32; 5] = [1.0, 0.8, 0.5, 0.25, 0.08];

    #[test]
    fn agrees_with_spectral_integration() {
        let gold = NamedMetal::Gold.eta_k();
        for film in FILMS {
            for cos in COSINES {
                let close = |found: Spectrum, exact: [f64; 3], what: &str| {
                    for (found, exact) in found.to_rgb().into_iter().zip(exact) {
                        let off = (f64::from(found) - exact).abs();
                        assert!(off < 4e-3, "{film:?} on {what} at cosine {cos}: {found}, not {exact}");
                    }
                };
                close(
                    film.on_metal(cos, gold.0, gold.1),
                    exact(cos, film, |i| (gold.0.0[i].into(), gold.1.0[i].into())),
                    "gold",
                );
                for eta in [1.0, 1.5, 2.4] {
                    let cos_t = Fresnel::dielectric(cos, eta).cos_t;
                    let seen = exact(cos, film, |_| (eta.into(), 0.0));
                    close(film.on_clear([cos, cos_t], eta, true), seen, "glass");
                    close(film.on_clear([cos_t, cos], 1.0 / eta, false), seen, "glass, from inside");
                }
            }
        }
    }

    /// Thin to nothing, a film is not seen.
    #[test]
    fn nothing_is_no_film() {
        let film = ThinFilm { thickness: 1e-3, eta: 1.4 };
        let (eta, k) = NamedMetal::Copper.eta_k();
        for cos in [1.0, 0.6, 0.3, 0.1] {
            let glass = Fresnel::dielectric(cos, 1.5);
            let clear = film.on_clear([cos, glass.cos_t], 1.5, true).to_rgb();
            assert!(clear.iter().all(|r| (r - glass.reflectance).abs() < 5e-3), "{clear:?} at {cos}");
            let metal = film.on_metal(cos, eta, k).to_rgb();
            for (i, found) in metal.into_iter().enumerate() {
                let bare = fresnel_conductor(cos, eta.0[i], k.0[i]);
                assert!((found - bare).abs() < 5e-3, "{found}, not {bare}, at {cos}");
            }
        }
        assert!(film.is_there() && !ThinFilm::NONE.is_there());
    }

    /// What everybody sees as a soap film drains: from the second order down green, blue, purple, yellow, white, and black just
    /// before it bursts.
    #[test]
    fn soap_has_the_colours_of_newton() {
        let soap = |thickness: f32| ThinFilm { thickness, eta: 1.33 }.on_clear([1.0, 1.0], 1.0, true).to_rgb();
        let [r, g, b] = soap(5.0);
        assert!(r.max(g).max(b) < 2e-3, "black: {r} {g} {b}");
        let [r, g, b] = soap(105.0);
        assert!(r.min(g).min(b) > 0.7 * r.max(g).max(b), "white: {r} {g} {b}");
        let [r, g, b] = soap(150.0);
        assert!(r > g && g > 1.5 * b, "yellow: {r} {g} {b}");
        let [r, g, b] = soap(210.0);
        assert!(b > 2.0 * g && r > 2.0 * g, "purple: {r} {g} {b}");
        let [r, g, b] = soap(245.0);
        assert!(b > 2.0 * r, "blue: {r} {g} {b}");
        let [r, g, b] = soap(300.0);
        assert!(g > r && g > 1.5 * b, "green to yellow: {r} {g} {b}");
    }

    #[test]
    fn shares_are_finite() {
        for film in [ThinFilm { thickness: 2000.0, eta: 5.0 }, ThinFilm { thickness: 1.0, eta: 1.0 }] {
            for cos in [0.0, 1e-42, 1e-20, 1e-5, 1.0] {
                for eta in [0.01, 0.5, 1.0, 1.001, 100.0] {
                    let cos_t = Fresnel::dielectric(cos, eta).cos_t;
                    let rgb = [
                        film.on_clear([cos, cos_t], eta, true),
                        film.on_clear([cos, cos_t], eta, false),
                        film.on_mirror(cos, Spectrum::ONE),
                        film.on_metal(cos, Rgb::grey(eta), Rgb::grey(0.0)),
                    ];
                    assert!(
                        rgb.iter().flat_map(|s| s.to_rgb()).all(|r| (0.0..=1.0).contains(&r)),
                        "{cos} {eta} {rgb:?}"
                    );
                }
            }
        }
    }
}
