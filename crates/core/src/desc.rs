//! What a file or a program said: plain data, names instead of indices.
//!
//! A reader promises: lengths in metres, +Y up, right-handed; colours linear Rec. 709; radiance in W / (m² sr); angles in
//! degrees where the name of the field says so here. It does not promise that the numbers make sense or that names
//! exist: [`SceneDesc::check`] tells what does not, and [`Scene::build`](crate::scene::Scene::build) refuses it.

use std::collections::BTreeMap;
use std::iter;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::camera::CameraDesc;
use crate::film::{BoxFilter, FilterDesc};
use crate::integrator::IntegratorKind;
use crate::light::select::LightSelection;
use crate::light::{EnvironmentDesc, LightsDesc};
use crate::material::{self, MaterialDesc};
use crate::motion::check_shutter;
use crate::sampler::SamplerKind;
use crate::shape::ShapesDesc;
use crate::texture::{self, TextureDesc};
use crate::validate::{Checker, Problem};

/// A scene and how to render it. Everything has a default.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SceneDesc {
    /// Scene files, beside this one or below, that are read first; what this file says wins, and shapes and lights add up.
    #[serde(skip_serializing)]
    pub include: Vec<String>,
    /// Size and quality of the picture.
    pub render: RenderDesc,
    /// The eye.
    pub camera: CameraDesc,
    /// Light from outside.
    pub environment: EnvironmentDesc,
    /// Light from what is no shape.
    pub light: LightsDesc,
    /// Textures by name: colours that change over a surface.
    pub texture: BTreeMap<String, TextureDesc>,
    /// Materials by name.
    pub material: BTreeMap<String, MaterialDesc>,
    /// Everything that can be seen.
    pub shape: ShapesDesc,
}

/// Size and quality of the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RenderDesc {
    /// Pixels in a row.
    #[schemars(range(min = 1))]
    pub width: u32,
    /// Rows of pixels.
    #[schemars(range(min = 1))]
    pub height: u32,
    /// Samples per pixel.
    #[schemars(range(min = 1))]
    pub spp: u32,
    /// The most edges of a path: 1 draws only what shines, 2 what it lights, and so on; 0 is black.
    pub max_depth: u32,
    /// Another seed is another picture with other noise.
    pub seed: u64,
    /// How light is traced.
    pub integrator: IntegratorKind,
    /// Which random numbers.
    pub sampler: SamplerKind,
    /// How a pixel is made of the places around it.
    pub filter: FilterDesc,
    /// How one of many lights is chosen.
    pub light_selection: LightSelection,
    /// Whether the background is left out where the camera sees it, directly or through smooth glass: the picture has an
    /// alpha. It lights the scene and shows in mirrors as ever.
    pub transparent: bool,
    /// Samples of higher luminance are darkened to this one, which takes away bright specks, and light; 0 is off.
    #[schemars(range(min = 0.0))]
    pub clamp: f32,
    /// When the shutter opens and closes, from 0, in the time of the keys that move shapes and the camera: what moves in between
    /// is blurred. Twice the same time freezes it.
    #[serde(deserialize_with = "array")]
    pub shutter: [f32; 2],
}

impl Default for RenderDesc {
    fn default() -> Self {
        Self {
            width: 800,
            height: 450,
            spp: 128,
            max_depth: 50,
            seed: 0,
            integrator: IntegratorKind::default(),
            sampler: SamplerKind::default(),
            filter: FilterDesc::default(),
            light_selection: LightSelection::default(),
            transparent: false,
            clamp: 0.0,
            shutter: [0.0, 1.0],
        }
    }
}

impl RenderDesc {
    /// The most pixels along a side.
    pub const MAX_SIDE: u32 = 1 << 24;
    /// The most samples per pixel: so many squares fit into the film's sums.
    pub const MAX_SPP: u32 = 1 << 24;
    /// The most edges of a path.
    pub const MAX_DEPTH: u32 = 1_000_000;
    /// The highest luminance to clamp to: that of the brightest lamp.
    pub const MAX_CLAMP: f32 = 1e9;

    /// The same picture by the plainest means: `weekend`, independent numbers, a box for a pixel, nothing clamped. What
    /// theory is about.
    pub fn plain(&self) -> Self {
        Self {
            integrator: IntegratorKind::Weekend,
            sampler: SamplerKind::Independent,
            filter: FilterDesc::Box(BoxFilter::default()),
            clamp: 0.0,
            ..self.clone()
        }
    }

    fn check(&self, c: &mut Checker) {
        c.count("width", self.width, Self::MAX_SIDE);
        c.count("height", self.height, Self::MAX_SIDE);
        c.count("spp", self.spp, Self::MAX_SPP);
        c.within("filter", |c| self.filter.check(c));
        c.in_range("clamp", self.clamp, 0.0, Self::MAX_CLAMP);
        check_shutter(self.shutter, c);
        if self.max_depth > Self::MAX_DEPTH {
            let hint = format!("use a whole number from 0 to {}", Self::MAX_DEPTH);
            c.problem(
                "max_depth",
                format!("`max_depth` must be at most {}, not {}", Self::MAX_DEPTH, self.max_depth),
                Some(hint),
            );
        }
    }
}

impl SceneDesc {
    /// The material of shapes that name none. A scene may define it.
    pub const DEFAULT_MATERIAL: &str = "default";

    /// The most straight pieces of all motion while the shutter is open.
    const MOST_PIECES: f64 = 4e6;

    /// Everything that is wrong; a scene can be built if nothing is.
    pub fn check(&self) -> Vec<Problem> {
        let mut c = Checker::default();
        c.within("render", |c| self.render.check(c));
        c.within("camera", |c| self.camera.check(c));
        c.within("environment", |c| self.environment.check(c));
        c.within("light", |c| self.light.check(c));
        let mut textures = texture::nesting(&self.texture);
        c.within("texture", |c| texture::check(&self.texture, &mut textures, c));
        c.within("material", |c| material::check(&self.material, &textures, c));
        c.within("shape", |c| {
            self.shape.check_count(c);
            let mut pieces = 0.0;
            for (kind, index, shape) in self.shape.iter() {
                c.within(kind, |c| {
                    c.within(index, |c| {
                        shape.check(c);
                        pieces += shape.motion().check(self.render.shutter, c);
                        if pieces > Self::MOST_PIECES {
                            let hint = format!("at most {} are allowed", Self::MOST_PIECES);
                            c.problem("motion", "all motion has too many straight pieces up to here", Some(hint));
                            pieces = 0.0;
                        }
                        self.check_material_name(shape.material(), c);
                    });
                });
            }
        });
        c.into_problems()
    }

    /// Names of all shapes, such as `sphere.0`: the first is that of id 1 in a picture.
    pub fn object_names(&self) -> impl Iterator<Item = String> {
        self.shape.iter().map(|(kind, index, _)| format!("{kind}.{index}"))
    }

    /// Names of all materials: the first is that of id 1 in a picture, what shapes without a material are made of.
    pub fn material_names(&self) -> impl Iterator<Item = &str> {
        iter::once(Self::DEFAULT_MATERIAL).chain(self.material.keys().map(String::as_str))
    }

    fn check_material_name(&self, name: Option<&str>, c: &mut Checker) {
        let Some(name) = name.filter(|&name| name != Self::DEFAULT_MATERIAL && !self.material.contains_key(name))
        else {
            return;
        };
        let words = ["material", "materials", "add one as [material.NAME.KIND]"];
        c.no_such("material", words, name, self.material.keys().map(String::as_str));
    }
}
