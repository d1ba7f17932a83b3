//! Fresnel's equations: how much light a smooth boundary reflects.
//!
//! For unpolarised light, the mean of both polarisations. Born & Wolf, Principles of Optics, 7th ed. 1999, §1.5 (clear)
//! and §14.2 (metal). Squares of sines are written by cosines, and differences of near numbers are avoided, so
//! single precision suffices up to the horizon.

use crate::color::{Rgb, Spectrum};

/// What happens to unpolarised light at the smooth boundary of something clear.
#[derive(Clone, Copy, Debug)]
pub struct Fresnel {
    /// Share that is reflected, 0..1.
    pub reflectance: f32,
    /// Cosine of the refracted angle; 0 if all is reflected.
    pub cos_t: f32,
}

impl Fresnel {
    /// `cos_i` in 0..=1 is the cosine of the angle of incidence, `eta` the index behind over before.
    #[inline]
    pub fn dielectric(cos_i: f32, eta: f32) -> Self {
        let cos_sq_t = ((eta - 1.0) * (eta + 1.0) + cos_i * cos_i) / (eta * eta);
        if cos_sq_t <= 0.0 {
            return Self { reflectance: 1.0, cos_t: 0.0 };
        }
        let cos_t = cos_sq_t.sqrt().min(1.0);
        Self { reflectance: Self::between(cos_i, cos_t, eta), cos_t }
    }

    /// The share that is reflected, from the cosines of both angles. Near the critical angle one of them does not tell
    /// the other to many digits, so it is better to know both.
    #[inline]
    pub fn between(cos_i: f32, cos_t: f32, eta: f32) -> f32 {
        let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        0.5 * (parallel * parallel + perpendicular * perpendicular)
    }
}

/// The share, 0..1, that a metal of the complex index `eta` + i `k` (over that of the medium before it) reflects;
/// `cos_i` in 0..=1 is the cosine of the angle of incidence, `eta` is above 0, `k` not negative.
///
/// With a + i b = √((eta + i k)² − sin²), the perpendicular share is |(cos − a − i b) / (cos + a + i b)|², and the
/// parallel one is that times |((a + i b) cos − sin²) / ((a + i b) cos + sin²)|².
#[inline]
pub fn fresnel_conductor(cos_i: f32, eta: f32, k: f32) -> f32 {
    // Nearer to the horizon the share is 1 to all digits, but for an index of 1, which would be 0 / 0.
    let c = cos_i.max(1e-6);
    let sin_sq = ((1.0 - c) * (1.0 + c)).max(0.0);
    // a² − b² and (a b)² give a² and b²: the larger one first, as the other would be the difference of near numbers.
    let difference = (eta - 1.0) * (eta + 1.0) + c * c - k * k;
    let product = (eta * k) * (eta * k);
    let larger = 0.5 * (difference.abs() + (difference * difference + 4.0 * product).sqrt());
    let smaller = product / larger.max(f32::MIN_POSITIVE);
    let (a_sq, b_sq) = if difference >= 0.0 { (larger, smaller) } else { (smaller, larger) };
    let a = a_sq.sqrt();
    let sq = |x: f32| x * x;
    let perpendicular = (sq(a - c) + b_sq) / (sq(a + c) + b_sq);
    let ratio = (sq(a * c - sin_sq) + b_sq * c * c) / (sq(a * c + sin_sq) + b_sq * c * c);
    0.5 * perpendicular * (1.0 + ratio)
}

/// What a facet of metal reflects: the same at all angles, or by its index of refraction.
#[derive(Clone, Copy, Debug)]
pub(super) enum Reflectance {
    Constant(Rgb),
    Fresnel { eta: Rgb, k: Rgb },
}

impl Reflectance {
    /// The mean over an evenly lit surface, ∫ F cos θ / π dw, by Gauss's two points: within 0.006 for metals.
    pub(super) fn mean(self) -> Spectrum {
        match self {
            Self::Constant(reflectance) => reflectance.into(),
            Self::Fresnel { .. } => Self::mean_of(|cos| self.at(cos)),
        }
    }

    /// The same of another function of the cosine.
    pub(super) fn mean_of(at: impl Fn(f32) -> Spectrum) -> Spectrum {
        at(0.355_051).lerp(at(0.844_949), 0.636_082_8)
    }

    #[inline]
    pub(super) fn at(self, cos: f32) -> Spectrum {
        match self {
            Self::Constant(reflectance) => reflectance.into(),
            Self::Fresnel { eta, k } => {
                Spectrum::from_rgb(std::array::from_fn(|i| fresnel_conductor(cos, eta.0[i], k.0[i])))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::NamedMetal;

    /// Known values: 4 % at normal incidence on glass; 0 for the parallel half at Brewster's angle; total at the end.
    #[test]
    fn dielectric_values() {
        assert!((Fresnel::dielectric(1.0, 1.5).reflectance - 0.04).abs() < 1e-6);
        assert!((Fresnel::dielectric(1.0, 1.0 / 1.5).reflectance - 0.04).abs() < 1e-6);
        let brewster = 1.5_f32.atan();
        let r = Fresnel::dielectric(brewster.cos(), 1.5).reflectance;
        let perpendicular = (2.0 * brewster).cos().powi(2);
        assert!((r - 0.5 * perpendicular).abs() < 1e-6);
        assert!((Fresnel::dielectric(0.0, 1.5).reflectance - 1.0).abs() < 1e-6);
        assert_eq!(Fresnel::dielectric(0.7, 1.0 / 1.5).reflectance, 1.0);
        for cos in [1.0, 0.3, 1e-3, 1e-6, 1e-12] {
            assert_eq!(Fresnel::dielectric(cos, 1.0).reflectance, 0.0, "no boundary");
        }
    }

    /// The textbook's complex numbers, in double precision.
    fn slow_conductor(cos: f64, eta: f64, k: f64) -> f64 {
        let sin_sq = 1.0 - cos * cos;
        let (re, im) = (eta * eta - k * k - sin_sq, 2.0 * eta * k);
        let (a, b) = ((0.5 * (re.hypot(im) + re)).max(0.0).sqrt(), (0.5 * (re.hypot(im) - re)).max(0.0).sqrt());
        let share =
            |near: [f64; 2], far: [f64; 2]| (near[0].powi(2) + near[1].powi(2)) / (far[0].powi(2) + far[1].powi(2));
        let s = share([cos - a, b], [cos + a, b]);
        // The parallel share: n² cos − √(n² − sin²) over the sum.
        let (n_re, n_im) = ((eta * eta - k * k) * cos, im * cos);
        let p = share([n_re - a, n_im - b], [n_re + a, n_im + b]);
        0.5 * (s + p)
    }

    #[test]
    fn conductor_agrees_with_the_textbook() {
        for eta in [0.05_f32, 0.2, 0.9, 1.0, 1.5, 7.0, 100.0] {
            for k in [0.0_f32, 1e-3, 0.5, 3.9, 100.0] {
                for cos in [1.0_f32, 0.9, 0.5, 0.1, 1e-2, 1e-3] {
                    let (fast, slow) =
                        (fresnel_conductor(cos, eta, k), slow_conductor(f64::from(cos), f64::from(eta), f64::from(k)));
                    assert!((f64::from(fast) - slow).abs() < 2e-5, "eta {eta}, k {k}, cos {cos}: {fast}, not {slow}");
                }
                let horizon = fresnel_conductor(0.0, eta, k);
                assert!((0.0..=1.0).contains(&horizon), "eta {eta}, k {k}: {horizon} at the horizon");
                assert!(horizon > 0.999 || (eta, k) == (1.0, 0.0) || (eta, k) == (1.0, 1e-3));
            }
        }
    }

    /// Without absorption a metal is something clear; straight on there is a formula; gold is as the tables say.
    #[test]
    fn conductor_values() {
        for eta in [0.6_f32, 1.0, 1.3, 2.4] {
            for cos in [1.0_f32, 0.8, 0.4, 0.05] {
                let clear = Fresnel::dielectric(cos, eta).reflectance;
                assert!((fresnel_conductor(cos, eta, 0.0) - clear).abs() < 2e-6, "eta {eta}, cos {cos}");
            }
        }
        let straight = |eta: f32, k: f32| ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
        for (eta, k) in [(0.143, 3.983), (2.9, 3.1), (1.5, 0.0)] {
            assert!((fresnel_conductor(1.0, eta, k) - straight(eta, k)).abs() < 1e-6);
        }
        // Johnson & Christy 1972, doi:10.1103/PhysRevB.6.4370, at 1.88 eV (659 nm): 0.14 + 3.697 i reflects 96.3 %.
        assert!((fresnel_conductor(1.0, 0.14, 3.697) - 0.963).abs() < 1e-3);
    }

    /// Two points are enough for the mean of Fresnel's share.
    #[test]
    fn mean_of_fresnel() {
        for metal in [NamedMetal::Gold, NamedMetal::Aluminium, NamedMetal::Iron, NamedMetal::Tungsten] {
            let (eta, k) = metal.eta_k();
            let reflectance = Reflectance::Fresnel { eta, k };
            let midpoints = (0..1000).map(|i| (i as f32 + 0.5) / 1000.0);
            let mean = midpoints.fold([0.0; 3], |sum, cos| {
                let f = reflectance.at(cos).to_rgb();
                std::array::from_fn(|i| sum[i] + f[i] * 2.0 * cos / 1000.0)
            });
            for (mean, two) in mean.into_iter().zip(reflectance.mean().to_rgb()) {
                assert!((mean - two).abs() < 6e-3, "{metal:?}: {two}, not {mean}");
            }
        }
    }
}
