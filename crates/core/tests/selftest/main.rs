//! A test of the selftest: Eyebeam passes, and each of many mistakes, planted by a wrapper around the part in question, is
//! found by the check that is about it.

mod lights;
mod lobes;
mod mistake;
mod reference;
mod views;

use eyebeam_core::testing::selftest::{self, Check, Eyebeam, Implementation};
use mistake::Mistake::{self, *};

#[test]
fn eyebeam_passes() {
    let mut failures = Vec::new();
    let passed = selftest::run(&Eyebeam, &mut |outcome| {
        if let Err(e) = &outcome.result {
            failures.push(format!("{}: {e}", outcome.check.name));
        }
    });
    assert!(passed && failures.is_empty(), "{failures:#?}");
}

fn check(name: &str) -> Check {
    selftest::checks().into_iter().find(|check| check.name == name).unwrap_or_else(|| panic!("there is no `{name}`"))
}

#[track_caller]
fn assert_found(mistakes: &[(Mistake, &str)]) {
    for (mistake, name) in mistakes {
        let result = check(name).run(mistake);
        assert!(result.is_err(), "`{name}` does not find {mistake:?}");
    }
}

#[test]
fn mistakes_of_the_film_are_found() {
    assert_found(&[
        (EqualDimensions, "random numbers"),
        (CoarseNumbers, "random numbers"),
        (FilterOffByHalfAPixel, "pixel filters"),
        (FilterWithoutSign, "pixel filters"),
        (MirroredCamera, "cameras"),
        (LongDirections, "cameras"),
    ]);
}

#[test]
fn mistakes_of_lobes_are_found() {
    assert_found(&[
        (PdfDoubled, "lobe of matte"),
        (EvalWithoutCosine, "lobe of matte"),
        (CosineLost, "lobe of matte"),
        (HalfVectorJacobianLost, "lobe of rough metal"),
        (IndexSwapped, "smooth glass"),
        (FresnelOfTheOtherSide, "smooth glass"),
        (RadianceNotScaled, "smooth glass"),
    ]);
}

#[test]
fn mistakes_of_lights_are_found() {
    assert_found(&[
        (AreaDensityAsSolidAngle, "light of a rectangle"),
        (HalfOfALampSampled, "light of a triangle"),
        (DensityWithoutSine, "light of a picture"),
        (ChanceDoubled, "choice of lights"),
        (ChanceForgotten, "choice of lights"),
    ]);
}

#[test]
fn mistakes_of_integrators_are_found() {
    assert_found(&[
        (LightCountedTwice, "rectangle over a floor"),
        (LightCountedTwice, "five lamps over a floor"),
        (LightCountedTwice, "square 1 below a square lamp"),
        (LightCountedTwice, "integrators agree"),
        (RouletteWithoutWeight, "glowing ball, 40 edges"),
        (OneEdgeTooMany, "glowing ball, 2 edges"),
        (NoShadows, "floor behind a screen"),
        (BothSidesShine, "floor behind a lamp"),
        (GlassInsideOut, "inside glass of index 1.5"),
        (GlassInsideOut, "frosted glass of roughness 0.5 at 150 degrees"),
        (LightsForgotten, "point over a floor"),
        (LightsForgotten, "turned luminaire over a floor"),
        (LightsForgotten, "projector over a floor"),
    ]);
}

/// The integrator that the mistakes are made in has none itself.
#[test]
fn the_reference_passes() {
    let names = [
        "glowing ball, 40 edges",
        "glowing ball, 2 edges",
        "white furnace, hollow glass",
        "plate of glass at 75 degrees",
        "gold of roughness 0.5 at 60 degrees",
        "rectangle over a floor",
        "five lamps over a floor",
        "square 1 below a square lamp",
        "floor behind a screen",
        "floor behind a lamp",
        "floor under a sun of 40 degrees",
        "floor under a picture with bright spots",
        "integrators agree",
    ];
    for name in names {
        check(name).run(&Reference).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
    assert_eq!(Reference.lights(&Default::default()).len(), 1, "the environment");
}
