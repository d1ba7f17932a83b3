//! The mistakes, and Eyebeam with one of them.

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::FilterDesc;
use eyebeam_core::integrator::{Integrator, IntegratorKind};
use eyebeam_core::light::select::{LightBounds, LightSelection};
use eyebeam_core::material::MaterialDesc;
use eyebeam_core::sampler::Samples;
use eyebeam_core::testing::selftest::{Eyebeam, Implementation};
use eyebeam_core::testing::{CameraRays, LightChoice, LightSampling, Lobe, Numbers, PixelFilter};
use glam::UVec2;

use crate::reference::{OtherScene, Reference};
use crate::{lights, lobes, views};

/// What somebody may get wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mistake {
    // Numbers, filters, cameras
    EqualDimensions,
    CoarseNumbers,
    FilterOffByHalfAPixel,
    FilterWithoutSign,
    MirroredCamera,
    LongDirections,
    // Lobes
    PdfDoubled,
    EvalWithoutCosine,
    CosineLost,
    HalfVectorJacobianLost,
    IndexSwapped,
    FresnelOfTheOtherSide,
    RadianceNotScaled,
    // Lights
    AreaDensityAsSolidAngle,
    HalfOfALampSampled,
    DensityWithoutSine,
    ChanceDoubled,
    ChanceForgotten,
    // Integrators
    LightCountedTwice,
    RouletteWithoutWeight,
    OneEdgeTooMany,
    NoShadows,
    LightsForgotten,
    BothSidesShine,
    GlassInsideOut,
    /// None: the reference integrator without a mistake.
    Reference,
}

impl Implementation for Mistake {
    fn numbers<'s>(&self, samples: &'s Samples, pixel: UVec2, sample: u32) -> Box<dyn Numbers + 's> {
        views::numbers(*self, Eyebeam.numbers(samples, pixel, sample))
    }

    fn filter(&self, desc: &FilterDesc) -> Box<dyn PixelFilter> {
        Box::new(views::Filter(*self, Eyebeam.filter(desc)))
    }

    fn camera(&self, desc: &CameraDesc, width: u32, height: u32) -> Box<dyn CameraRays> {
        Box::new(views::Camera { mistake: *self, inner: Eyebeam.camera(desc, width, height), width: width as f32 })
    }

    fn lobe(&self, material: &MaterialDesc) -> Box<dyn Lobe> {
        Box::new(lobes::Wrong(*self, Eyebeam.lobe(material)))
    }

    fn lights(&self, desc: &SceneDesc) -> Vec<Box<dyn LightSampling>> {
        lights::wrong(*self, desc)
    }

    fn light_choice(&self, selection: LightSelection, lights: &[LightBounds]) -> Box<dyn LightChoice> {
        Box::new(lights::Choice(*self, Eyebeam.light_choice(selection, lights)))
    }

    /// `weekend` is right in any case: an integrator that disagrees with it is wrong.
    fn integrator(&self, kind: IntegratorKind, max_depth: u32, scene: &SceneDesc) -> Box<dyn Integrator> {
        match self {
            _ if kind == IntegratorKind::Weekend => kind.build(max_depth),
            Self::LightCountedTwice
            | Self::RouletteWithoutWeight
            | Self::OneEdgeTooMany
            | Self::NoShadows
            | Self::LightsForgotten
            | Self::Reference => Box::new(Reference::new(*self, max_depth, scene)),
            Self::BothSidesShine | Self::GlassInsideOut => {
                Box::new(OtherScene::new(*self, scene, kind.build(max_depth)))
            }
            _ => kind.build(max_depth),
        }
    }
}
