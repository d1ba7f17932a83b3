//! What the choice of a light promises.

use glam::{UVec2, Vec3};

use super::chi2_counts;
use crate::light::select::{LightSelector, SelectedLight};
use crate::sampler::Independent;

/// How one of many lights is chosen: what [`LightSelector`] does.
pub trait LightChoice {
    /// Chooses a light for the point `p` with unit normal `n`; none if that light cannot reach it.
    fn sample(&self, p: Vec3, n: Vec3, uc: f32) -> Option<SelectedLight>;

    /// The chance that [`sample`](Self::sample) chooses this light.
    fn pmf(&self, p: Vec3, n: Vec3, index: u32) -> f32;
}

impl LightChoice for LightSelector {
    fn sample(&self, p: Vec3, n: Vec3, uc: f32) -> Option<SelectedLight> {
        self.sample(p, n, uc)
    }

    fn pmf(&self, p: Vec3, n: Vec3, index: u32) -> f32 {
        self.pmf(p, n, index)
    }
}

/// Lights are chosen as often as their chances say (chi²), what is chosen knows its own, and the rest of the number is
/// uniform: for a point of a choice among `count` lights.
///
/// # Errors
/// The first promise that is broken.
pub fn check_selection(choice: &dyn LightChoice, count: u32, p: Vec3, n: Vec3) -> Result<(), String> {
    const SAMPLES: u32 = 20_000;
    const BINS: usize = 16;
    let chances: Vec<f64> = (0..count).map(|i| f64::from(choice.pmf(p, n, i))).collect();
    let sum: f64 = chances.iter().sum();
    if sum > 1.0 + 1e-4 {
        return Err(format!("chances sum to {sum}"));
    }
    // The last is that of no light.
    let mut expected: Vec<f64> = chances.into_iter().chain([(1.0 - sum).max(0.0)]).collect();
    expected.iter_mut().for_each(|chance| *chance *= f64::from(SAMPLES));
    let (mut observed, mut rests, mut chosen) = (vec![0; expected.len()], [0; BINS], 0_u32);
    for i in 0..SAMPLES {
        let Some(light) = choice.sample(p, n, Independent::new(40, UVec2::ZERO, i).get_1d()) else {
            observed[count as usize] += 1;
            continue;
        };
        let (own, pmf) = (light.pmf, choice.pmf(p, n, light.index));
        if own != pmf {
            return Err(format!("light {} was chosen with chance {own}, and has {pmf}", light.index));
        }
        observed[light.index as usize] += 1;
        rests[((light.uc * BINS as f32) as usize).min(BINS - 1)] += 1;
        chosen += 1;
    }
    chi2_counts(&observed, &expected)?;
    chi2_counts(&rests, &[f64::from(chosen) / BINS as f64; BINS]).map_err(|e| format!("rest of the number: {e}"))
}
