//! What a material of a library says twice, in vain, or beyond what can be: settled, and told of.
//!
//! What exporters write without being asked is not worth a word.

use super::mtl::Mtl;
use crate::scene::model::skipped::Skipped;

/// Greys of `Ka` of exporters that have nothing to say.
const USUAL_AMBIENT: [f32; 3] = [0.0, 0.2, 1.0];
/// Greys of `Ks` of exporters that have nothing to say.
const USUAL_SPECULAR: [f32; 4] = [0.0, 0.2, 0.5, 1.0];
/// Numbers that are shares.
const SHARES: [&str; 8] = ["d", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"];
/// By so much numbers may differ, or be too large, without a word: they were rounded.
const ROUNDED: f32 = 1e-3;

impl Mtl {
    /// To be called when all of the material is read.
    pub(super) fn settle(&mut self, skipped: &mut Skipped) {
        self.clarity(skipped);
        self.ambient(skipped);
        let lines = &self.lines;
        let mut note = |what: &str, key: &str| skipped.note(what, lines.get(key).copied().unwrap_or(1));
        let is_share = |share: f32| (-ROUNDED..=1.0 + ROUNDED).contains(&share);
        let colors = self.colors.iter().filter(|(key, _)| **key != "Ke").map(|(key, color)| (key, color.as_slice()));
        let numbers = self.numbers.iter().filter(|(key, _)| SHARES.contains(key));
        let numbers = numbers.map(|(key, number)| (key, std::slice::from_ref(number)));
        for (key, shares) in colors.chain(numbers) {
            if !shares.iter().all(|&share| is_share(share)) {
                note(&format!("`{key}` outside of 0..1 is clamped"), key);
            }
        }
        match self.numbers.get("Ni") {
            Some(&index) if index > 3.0 + ROUNDED => note("`Ni` above 3 is taken as 3", "Ni"),
            // Exporters that know of none write 0.
            Some(&index) if index < 1.0 - ROUNDED && index != 0.0 => note("`Ni` below 1 is not used", "Ni"),
            _ => {}
        }
        let is_metal = matches!(self.illum(), Some(3 | 5));
        if self.is_pbr() && !is_metal {
            let is_usual = |ks: &[f32; 3]| is_grey(ks, &USUAL_SPECULAR);
            if self.colors.get("Ks").is_some_and(|ks| !is_usual(ks)) {
                note("`Ks` is not used beside `Pr`, `Pm`, `Ps` or `Pc`", "Ks");
            }
            if self.maps.contains_key("ks") {
                note("`map_Ks` is not used beside `Pr`, `Pm`, `Ps` or `Pc`", "ks");
            }
        }
    }

    /// `d` and `Tr` say the same, and of programs that have mixed them up `d` is right more often.
    fn clarity(&mut self, skipped: &mut Skipped) {
        let Some(opacity) = self.numbers.remove("Tr").map(|clear| 1.0 - clear) else { return };
        let line = self.lines.get("Tr").copied().unwrap_or(1);
        if (self.numbers.get("d").copied().unwrap_or(opacity) - opacity).abs() > ROUNDED {
            skipped.note("`Tr` is not 1 - `d`, and not used", line);
        }
        self.numbers.entry("d").or_insert(opacity);
        self.lines.entry("d").or_insert(line);
    }

    /// Nearly all programs write `Ka`, and light that is computed has no use for it: only one that means something is told of.
    fn ambient(&self, skipped: &mut Skipped) {
        let Some((ambient, line)) = self.ambient else { return };
        if !is_grey(&ambient, &USUAL_AMBIENT) && self.colors.get("Kd") != Some(&ambient) {
            skipped.note("`Ka` is not read", line);
        }
    }
}

/// Whether it is one of some greys.
fn is_grey(color: &[f32; 3], greys: &[f32]) -> bool {
    greys.iter().any(|grey| *color == [*grey; 3])
}
