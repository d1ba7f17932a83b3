//! Things without thickness: panes of glass, and sheets of paper.

use super::KnownScene;
use super::build::*;
use super::glass::reflectance;
use crate::color::Rgb;
use crate::light::{EnvironmentDesc, Gradient};
use crate::material::{DiffuseTransmission, MaterialDesc, ThinDielectric};

pub(super) fn scenes() -> Vec<KnownScene> {
    let panes = [0.0, 45.0, 75.0, 120.0].map(pane);
    panes.into_iter().chain([white_sheet(), paper(1.0), paper(-1.0)]).collect()
}

/// A sky above, darker ground below.
fn sky() -> EnvironmentDesc {
    EnvironmentDesc::Gradient(Gradient { bottom: Rgb::grey(0.0), top: Rgb::grey(1.0) })
}

/// A pane between them, seen at an angle from above or below. 2R / (1 + R) is reflected, half of the rest goes through.
fn pane(degrees: f64) -> KnownScene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut desc = empty(sky(), stare([0.3 + 2.0 * sin as f32, 2.0 * cos as f32, 0.1], [0.3, 0.0, 0.1]));
    let glass = ThinDielectric { eta: 1.5, color: Rgb::grey(0.5).into() };
    add_quad(&mut desc, floor(0.0), "pane", MaterialDesc::ThinDielectric(glass));
    let r = reflectance(cos.abs(), 1.5);
    let [mirrored, behind] = [0.5 * (1.0 + cos), 0.5 * (1.0 - cos)];
    let expected = 2.0 * r / (1.0 + r) * mirrored + 0.5 * (1.0 - r) / (1.0 + r) * behind;
    KnownScene::new(format!("pane of glass at {degrees} degrees"), desc, 2, expected)
}

/// In the white furnace a ball of what absorbs nothing cannot be told from the background.
fn white_sheet() -> KnownScene {
    let mut desc = empty(WHITE, stare([0.3, 0.0, 3.0], [0.3, 0.4, 0.0]));
    let sheet = DiffuseTransmission { reflectance: Rgb::grey(0.25).into(), transmittance: Rgb::grey(0.75).into() };
    add_sphere(&mut desc, [0.0; 3], 1.0, "ball", MaterialDesc::DiffuseTransmission(sheet));
    KnownScene::new("white furnace, ball of a sheet", desc, 1000, 1.0)
}

/// A sheet between sky and ground, seen from above (side 1) or below. The mean of (1 + y) / 2, weighed with the cosine,
/// is 5/6 in the upper hemisphere and 1/6 in the lower.
fn paper(side: f32) -> KnownScene {
    let (reflectance, transmittance) = (0.6, 0.3);
    let mut desc = empty(sky(), stare([3.0, 0.4 * side, 0.0], [0.0; 3]));
    let sheet = DiffuseTransmission {
        reflectance: Rgb::grey(reflectance).into(),
        transmittance: Rgb::grey(transmittance).into(),
    };
    add_quad(&mut desc, floor(0.0), "paper", MaterialDesc::DiffuseTransmission(sheet));
    let [here, there] = if side > 0.0 { [5.0, 1.0] } else { [1.0, 5.0] };
    let expected = (f64::from(reflectance) * here + f64::from(transmittance) * there) / 6.0;
    KnownScene::new(format!("paper from {}", if side > 0.0 { "above" } else { "below" }), desc, 2, expected)
}
