//! `eyebeam info`: what is in a scene or a model.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::setup;
use eyebeam_core::shape::MeshDesc;
use eyebeam_core::texture::TextureDesc;
use eyebeam_io::error::visible;
use eyebeam_io::scene::{Contents, SceneFile, read_with};
use serde::Serialize;

use crate::args::InfoArgs;
use crate::command::report::{self, Told};
use crate::command::write;
use crate::error::{Error, bytes};

pub(super) fn run(args: &InfoArgs) -> Result<(), Error> {
    let file = read_with(&args.file, &args.model.options(&args.set))?;
    let info = Info::new(args.file.display().to_string(), &file);
    let text = if args.json { serde_json::to_string_pretty(&info).unwrap_or_default() + "\n" } else { info.text() };
    write(Path::new("-"), text.as_bytes())
}

/// All of it.
#[derive(Debug, Serialize)]
struct Info<'f> {
    schema: &'static str,
    file: String,
    format: &'static str,
    generator: Option<&'f str>,
    meshes: usize,
    triangles: usize,
    vertices: usize,
    spheres: usize,
    quads: usize,
    /// None if there is nothing.
    bounds: Option<Bounds>,
    /// Of meshes and pictures, before anything is built of them.
    memory_bytes: usize,
    materials: Vec<Named<'f>>,
    textures: Vec<Texture<'f>>,
    cameras: Vec<Camera<'f>>,
    lights: Lights,
    /// Names of all scenes.
    scenes: &'f [String],
    /// Which of them this is.
    scene: Option<usize>,
    animations: Vec<Animation<'f>>,
    /// Of the materials.
    variants: &'f [String],
    warnings: Vec<Told<'f>>,
}

/// A box around all shapes where they rest, metres.
#[derive(Debug, Serialize)]
struct Bounds {
    min: [f32; 3],
    max: [f32; 3],
    size: [f32; 3],
}

/// Something with a name and a kind.
#[derive(Debug, Serialize)]
struct Named<'f> {
    name: &'f str,
    kind: String,
}

#[derive(Debug, Serialize)]
struct Texture<'f> {
    #[serde(flatten)]
    named: Named<'f>,
    /// Of a picture.
    picture: Option<Picture<'f>>,
}

#[derive(Debug, Serialize)]
struct Picture<'f> {
    file: &'f str,
    width: u32,
    height: u32,
    channels: usize,
    bytes: usize,
}

#[derive(Debug, Serialize)]
struct Camera<'f> {
    name: &'f str,
    kind: &'static str,
    look_from: [f32; 3],
    look_at: [f32; 3],
}

/// How many of each kind.
#[derive(Debug, Serialize)]
struct Lights {
    point: usize,
    spot: usize,
    directional: usize,
    ies: usize,
    projector: usize,
    /// The kind of what is around.
    environment: String,
}

#[derive(Debug, Serialize)]
struct Animation<'f> {
    name: &'f str,
    seconds: f32,
}

impl<'f> Info<'f> {
    fn new(file: String, SceneFile { desc, warnings, contents, given, .. }: &'f SceneFile) -> Self {
        let Contents { format, generator, scenes, scene, cameras, animations, variants } = contents;
        let shape = &desc.shape;
        let named = cameras.iter().map(|camera| Camera::new(&camera.name, &camera.desc));
        let own = (cameras.is_empty() && given.camera).then(|| Camera::new("", &desc.camera));
        let light = &desc.light;
        Self {
            schema: "eyebeam-info-1",
            file,
            format,
            generator: generator.as_deref(),
            meshes: shape.mesh.len(),
            triangles: shape.mesh.iter().map(MeshDesc::triangle_count).sum(),
            vertices: shape.mesh.iter().map(|mesh| mesh.vertices().len()).sum(),
            spheres: shape.sphere.len(),
            quads: shape.quad.len(),
            bounds: Bounds::of(desc),
            memory_bytes: memory(desc),
            materials: desc.material.iter().map(|(name, material)| Named { name, kind: kind(material) }).collect(),
            textures: desc.texture.iter().map(|(name, texture)| Texture::new(name, texture)).collect(),
            cameras: named.chain(own).collect(),
            lights: Lights {
                point: light.point.len(),
                spot: light.spot.len(),
                directional: light.directional.len(),
                ies: light.ies.len(),
                projector: light.projector.len(),
                environment: kind(&desc.environment),
            },
            scenes,
            scene: *scene,
            animations: animations.iter().map(|a| Animation { name: &a.name, seconds: a.seconds }).collect(),
            variants,
            warnings: report::told(warnings),
        }
    }

    /// For people: a line for each thing.
    fn text(&self) -> String {
        let mut text = visible(&format!("{}: {}", self.file, self.format));
        if let Some(generator) = self.generator {
            text += &format!(", written by {}", visible(generator));
        }
        text.push('\n');
        let mut line = |name: &str, said: &str| {
            // Writing to a string does not fail.
            let _ = writeln!(text, "  {name:<11}{}", visible(said));
        };
        let Self { meshes, triangles, vertices, spheres, quads, .. } = *self;
        let mut shapes = Vec::new();
        if meshes > 0 {
            let meshes = counted(meshes, "mesh", "meshes");
            shapes.push(format!("{triangles} triangles with {vertices} vertices in {meshes}"));
        }
        let others = [(spheres, "sphere", "spheres"), (quads, "quad", "quads")];
        shapes.extend(others.iter().filter(|s| s.0 > 0).map(|&(count, one, many)| counted(count, one, many)));
        line("shapes", &if shapes.is_empty() { "none".to_owned() } else { shapes.join(", ") });
        if let Some(Bounds { min, max, size }) = &self.bounds {
            let vector = |v: &[f32; 3]| format!("{} {} {}", v[0], v[1], v[2]);
            line("bounds", &format!("{} to {}, metres", vector(min), vector(max)));
            line("size", &format!("{} x {} x {} m", size[0], size[1], size[2]));
        }
        line("memory", &bytes(self.memory_bytes as u64));
        for Named { name, kind } in &self.materials {
            line("material", &format!("{name} ({kind})"));
        }
        for Texture { named: Named { name, kind }, picture } in &self.textures {
            let picture = picture.as_ref().map(|p| {
                format!(": {}, {} x {} x {}, {}", p.file, p.width, p.height, p.channels, bytes(p.bytes as u64))
            });
            line("texture", &format!("{name} ({kind}){}", picture.unwrap_or_default()));
        }
        for (i, Camera { name, kind, look_from: [x, y, z], .. }) in self.cameras.iter().enumerate() {
            line("camera", &format!("{i} {name} ({kind}, at {x} {y} {z})"));
        }
        let Lights { point, spot, directional, ies, projector, environment } = &self.lights;
        let kinds =
            [("point", point), ("spot", spot), ("directional", directional), ("ies", ies), ("projector", projector)];
        for (kind, count) in kinds.iter().filter(|(_, count)| **count > 0) {
            line("lights", &format!("{count} {kind}"));
        }
        line("around", environment);
        for (i, name) in self.scenes.iter().enumerate() {
            line("scene", &format!("{i} {name}{}", if self.scene == Some(i) { " (this one)" } else { "" }));
        }
        for (i, Animation { name, seconds }) in self.animations.iter().enumerate() {
            line("animation", &format!("{i} {name} ({seconds} s)"));
        }
        for (i, name) in self.variants.iter().enumerate() {
            line("variant", &format!("{i} {name}"));
        }
        self.warnings.iter().for_each(|told| {
            let _ = writeln!(text, "{}", told.whole());
        });
        text
    }
}

impl Bounds {
    fn of(desc: &SceneDesc) -> Option<Self> {
        let [min, max] = setup::bounds(desc)?;
        Some(Self { min: min.into(), max: max.into(), size: (max - min).into() })
    }
}

impl<'f> Texture<'f> {
    fn new(name: &'f str, texture: &'f TextureDesc) -> Self {
        let picture = match texture {
            TextureDesc::Image(image) => image.pixels.as_ref().map(|pixels| Picture {
                file: &image.file,
                width: pixels.width(),
                height: pixels.height(),
                channels: pixels.channels(),
                bytes: pixels.bytes(),
            }),
            _ => None,
        };
        Self { named: Named { name, kind: kind(texture) }, picture }
    }
}

impl<'f> Camera<'f> {
    fn new(name: &'f str, desc: &CameraDesc) -> Self {
        let kind = match desc {
            CameraDesc { orthographic: Some(_), .. } => "orthographic",
            CameraDesc { panorama: Some(_), .. } => "panorama",
            CameraDesc { fisheye: Some(_), .. } => "fisheye",
            _ => "perspective",
        };
        Self { name, kind, look_from: desc.look_from, look_at: desc.look_at }
    }
}

/// `1 mesh`, `2 meshes`.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// The key that says the kind of a thing in a scene file.
fn kind(thing: &impl Serialize) -> String {
    let key = |value: serde_json::Value| value.as_object()?.keys().next().cloned();
    serde_json::to_value(thing).ok().and_then(key).unwrap_or_default()
}

/// Of meshes and pictures; what is shared counts once.
fn memory(desc: &SceneDesc) -> usize {
    let mut known = BTreeSet::new();
    let mut is_new = |address: usize| known.insert(address);
    let mut sum = 0;
    for mesh in &desc.shape.mesh {
        let is_known = mesh.data.as_ref().is_some_and(|data| !is_new(Arc::as_ptr(data).addr()));
        sum += if is_known { 0 } else { mesh.bytes() };
    }
    for texture in desc.texture.values() {
        let TextureDesc::Image(image) = texture else { continue };
        let new = image.pixels.as_ref().filter(|pixels| is_new(Arc::as_ptr(pixels).addr()));
        sum += new.map_or(0, |pixels| pixels.bytes());
    }
    let around = match &desc.environment {
        EnvironmentDesc::Image(map) => map.image.as_ref(),
        _ => None,
    };
    let images = around.into_iter().chain(desc.light.projector.iter().filter_map(|light| light.image.as_ref()));
    sum + images
        .filter(|image| is_new(Arc::as_ptr(image).addr()))
        .map(|image| size_of_val(image.pixels()))
        .sum::<usize>()
}
