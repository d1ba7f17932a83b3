//! Models: scenes of other programs, and meshes.
//!
//! A model becomes a [`SceneDesc`] whose meshes and pictures are loaded. It seldom has a camera or light;
//! [`Given`] tells what it has, and [`setup`](eyebeam_core::setup) makes the rest.

mod choose;
mod files;
mod folder;
mod gltf;
mod lines;
mod obj;
mod ply;
mod skipped;
mod stl;
mod up;

use std::path::Path;

use eyebeam_core::color::Rgb;
use eyebeam_core::desc::{RenderDesc, SceneDesc};
use eyebeam_core::light::{EnvironmentDesc, NoLight};
use eyebeam_core::material::{Lambertian, Mask, MaterialDesc};
use eyebeam_core::names::Name;
use eyebeam_core::setup::Given;
use eyebeam_core::texture::{Color, Scalar, TextureDesc, VertexColor};
use glam::Vec3;

use crate::error::{Diagnostic, Error, Fault, FileError};
use crate::memory::Memory;
use crate::scene::source::Sources;
use crate::scene::{Contents, NamedCamera, Override, ReadOptions, SceneFile, toml};
use crate::warning::Warning;
use choose::choose;

pub use files::Files;
pub(super) use files::Input;
pub use up::Up;

/// A kind of file that models are in.
pub struct ModelFormat {
    /// Its name.
    pub name: &'static str,
    /// How names of such files end, in lower case, without a dot.
    pub endings: &'static [&'static str],
    /// What is up in files that do not say; none if the format tells.
    pub up: Option<Up>,
    read: fn(&Input<'_>, &ReadOptions<'_>, &Memory) -> Result<Model, Error>,
}

/// Every kind.
pub const MODEL_FORMATS: &[ModelFormat] = &[
    ModelFormat { name: "glTF", endings: &["gltf", "glb"], up: None, read: gltf::read },
    ModelFormat { name: "OBJ", endings: &["obj"], up: Some(Up::Y), read: obj::read },
    ModelFormat { name: "PLY", endings: &["ply"], up: Some(Up::Y), read: ply::read },
    ModelFormat { name: "STL", endings: &["stl"], up: Some(Up::Z), read: stl::read },
];

/// What a file holds.
#[derive(Debug, Default)]
struct Model {
    /// Shapes, materials, textures, and maybe a camera and lights.
    desc: SceneDesc,
    given: Given,
    /// What could not be kept.
    warnings: Vec<Warning>,
    /// What else there is.
    contents: Contents,
}

impl Model {
    /// Nothing yet, and no light.
    fn new() -> Self {
        let desc = SceneDesc { environment: EnvironmentDesc::None(NoLight::default()), ..SceneDesc::default() };
        Self { desc, ..Self::default() }
    }

    /// Takes the camera that is wanted, or the first. What a format knows nothing of cannot be wanted.
    fn choose(&mut self, options: &ReadOptions<'_>) -> Result<(), FileError> {
        let Contents { scenes, cameras, animations, variants, .. } = &self.contents;
        if let Some(wanted) = options.scene {
            choose("scene", wanted, scenes.iter().map(String::as_str))?;
        }
        if let Some(wanted) = options.animation {
            choose("animation", wanted, animations.iter().map(|animation| animation.name.as_str()))?;
        }
        if let Some(wanted) = options.variant {
            choose("variant", wanted, variants.iter().map(String::as_str))?;
        }
        let index = match options.camera {
            None => 0,
            Some(wanted) => {
                let by = |name: fn(&NamedCamera) -> &str| cameras.iter().position(|camera| name(camera) == wanted);
                match by(|camera| &camera.name).or_else(|| by(|camera| &camera.lens)) {
                    Some(index) => index,
                    None => choose("camera", wanted, cameras.iter().map(|camera| camera.name.as_str()))?,
                }
            }
        };
        if let Some(camera) = cameras.get(index) {
            self.desc.camera = camera.desc.clone();
            self.given.camera = true;
        }
        Ok(())
    }

    /// The material that has the colours of vertices, of which it is made unless the file has one of this name.
    fn vertex_color(&mut self) -> String {
        let name = "vertex-color".to_owned();
        let albedo = Color::Texture(Name::new(&name));
        self.desc.texture.insert(name.clone(), TextureDesc::VertexColor(VertexColor::default()));
        self.desc.material.entry(name.clone()).or_insert(MaterialDesc::Lambertian(Lambertian { albedo }));
        name
    }

    /// The material that is there by the alphas of vertices.
    fn vertex_alpha(&mut self, of: &str) -> String {
        let name = format!("{of} with alpha");
        let alphas = VertexColor { otherwise: Rgb::grey(1.0), alpha: true };
        self.desc.texture.insert("vertex-alpha".to_owned(), TextureDesc::VertexColor(alphas));
        let mask = Mask::new(Name::new(of), Scalar::Texture(Name::new("vertex-alpha")));
        self.desc.material.insert(name.clone(), MaterialDesc::Mask(mask));
        name
    }
}

/// The format of a file by the end of its name.
pub(super) fn format_of(path: &Path) -> Option<&'static ModelFormat> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    MODEL_FORMATS.iter().find(|format| format.endings.contains(&ending.as_str()))
}

/// Reads a model.
///
/// # Errors
/// If it cannot be read, or a setting is not of `render`.
pub(super) fn read(format: &ModelFormat, input: &Input<'_>, options: &ReadOptions<'_>) -> Result<SceneFile, Error> {
    let render = render_settings(options.overrides)?;
    let memory = Memory::new(options.memory);
    let mut model = (format.read)(input, options, &memory)?;
    model.contents.format = format.name;
    model.choose(options).map_err(|e| e.of(&input.name))?;
    let Model { mut desc, given, mut warnings, contents } = model;
    desc.render = render;
    match (options.up, format.up) {
        (given, Some(default)) => given.unwrap_or(default).turn(&mut desc),
        (Some(_), None) => {
            warnings.push(Warning::new(format!("{} files say what is up: `--up` is not used", format.name)))
        }
        (None, None) => {}
    }
    warnings.extend(rounded(&desc));
    let problems = desc.check();
    if problems.is_empty() {
        let warnings = warnings.into_iter().map(|warning| warning.of(&input.name)).collect();
        return Ok(SceneFile { desc, warnings, given, contents, memory: memory.taken() });
    }
    let diagnostic = |message, hint| Diagnostic {
        message: format!("in `{}`: {message}", input.name),
        place: None,
        hint,
        fault: Fault::File,
    };
    Err(Error::Scene(problems.into_iter().map(|problem| diagnostic(problem.message, problem.hint)).collect()))
}

/// Tells of places so far from the origin that single precision moves them by what can be seen.
fn rounded(desc: &SceneDesc) -> Option<Warning> {
    /// Of the size of the model.
    const SEEN: f32 = 1e-4;
    let mut vertices = desc.shape.mesh.iter().filter_map(|mesh| mesh.data.as_ref()).flat_map(|data| &data.vertices);
    let first = Vec3::from(*vertices.next()?);
    let [min, max] = vertices.fold([first; 2], |[min, max], &p| [min.min(p.into()), max.max(p.into())]);
    let step = f32::EPSILON * min.abs().max(max.abs()).max_element();
    let size = (max - min).max_element();
    (step > SEEN * size && size > 0.0).then(|| {
        let part = (size / step).round().max(1.0);
        let message = format!("it is so far from the origin that places are rounded to 1/{part} of its size");
        Warning::new(message).hint("move it to the origin")
    })
}

/// The settings that a model can have: those of the picture.
fn render_settings(overrides: &[Override]) -> Result<RenderDesc, Error> {
    if let Some(other) = overrides.iter().find(|setting| !setting.path.starts_with("render.")) {
        return Err(Error::Scene(vec![Diagnostic {
            message: format!("`-D {}` changes a scene file, and this is a model", other.path),
            place: None,
            hint: Some("of models only `render` can be changed".to_owned()),
            fault: Fault::File,
        }]));
    }
    let options = ReadOptions { overrides, ..ReadOptions::default() };
    Ok(toml::read(Sources::from_text("settings", "")?, &options)?.desc.render)
}
