//! Textures: colours that change over a surface.
//!
//! `[texture.NAME.KIND]` says what a texture is, and its name can stand wherever a material or another texture takes a
//! colour. Each kind is a pure function of the point of the surface: its place in the world and its coordinates on the shape.
//!
//! ```toml
//! [texture.squares.checker]
//! even = 0.8
//! odd = "#264653"
//!
//! [material.floor.lambertian]
//! albedo = "squares"
//! ```

mod channel;
mod checker;
mod color;
mod gradient;
mod image;
mod invert;
mod mapping;
mod marble;
mod mix;
mod multiply;
mod noise;
mod perlin;
mod pixels;
mod ramp;
mod scalar;
mod vertex_color;
mod wood;

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::names::{self, Named, Nesting, Numbers};
use crate::validate::Checker as Check;

pub use channel::{Channel, ChannelOf};
pub use checker::Checker;
pub use color::Color;
pub use gradient::Gradient;
pub use image::ImageTexture;
pub use invert::Invert;
pub use mapping::{Mapping, Space};
pub use marble::Marble;
pub use mix::Mix;
pub use multiply::Multiply;
pub use noise::Noise;
pub use pixels::{Encoding, Filter, Pixels, Samples};
pub use ramp::{Interpolation, Ramp, Stop};
pub use scalar::Scalar;
pub use vertex_color::VertexColor;
pub use wood::Wood;

/// A texture as a scene states it: `[texture.NAME.KIND]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TextureDesc {
    /// A picture.
    Image(ImageTexture),
    /// Two colours in turn.
    Checker(Checker),
    /// Clouds.
    Noise(Noise),
    /// Veins.
    Marble(Marble),
    /// Rings.
    Wood(Wood),
    /// From one colour to another.
    Gradient(Gradient),
    /// The colours of vertices.
    VertexColor(VertexColor),
    /// Colours for numbers.
    Ramp(Ramp),
    /// Two textures in shares.
    Mix(Mix),
    /// The product of two textures.
    Multiply(Multiply),
    /// The opposite of a texture.
    Invert(Invert),
    /// A part of a texture.
    Channel(ChannelOf),
}

/// Where a texture is looked up.
#[derive(Clone, Copy, Debug, Default)]
pub struct TexturePoint {
    /// Coordinates on the shape.
    pub uv: Vec2,
    /// The second ones of a mesh that has them.
    pub uv_1: Option<Vec2>,
    /// Place in the world, metres.
    pub p: Vec3,
    /// Place from the shape's own origin, metres; where the shape is without motion.
    pub p_object: Vec3,
    /// Unit shading normal.
    pub n: Vec3,
    /// The same on the shape, where that is without motion.
    pub n_object: Vec3,
    /// What the vertices of a mesh say.
    pub vertex_color: Option<Rgb>,
    /// The share that they say besides.
    pub vertex_alpha: Option<f32>,
}

/// What materials ask for what they do not hold themselves: colours, and how coordinates lie on the shape.
pub trait Textures {
    /// The colour of a texture at the point where the material is.
    fn color(&self, texture: u32) -> Spectrum;

    /// The unit direction in the plane of the surface, in the material's frame, in which the first coordinate on the shape grows.
    fn u_axis(&self) -> Vec2 {
        Vec2::X
    }

    /// Whether the second coordinate grows to the right of that, seen from above, instead of to the left.
    fn is_mirrored(&self) -> bool {
        false
    }

    /// A unit direction of growing u, growing v and the shape's own normal, without what textures do to it, in the material's frame; a normal
    /// that is bent until the view sees its mirror image.
    fn above_smooth(&self, w: Vec3) -> Vec3 {
        w
    }
}

/// There are none: every name is black.
#[derive(Clone, Copy, Debug)]
pub struct NoTextures;

impl Textures for NoTextures {
    fn color(&self, _: u32) -> Spectrum {
        Spectrum::BLACK
    }
}

/// All textures of a scene, at one point.
#[derive(Clone, Copy, Debug)]
pub struct TexturesAt<'t> {
    /// In the order of their numbers.
    pub textures: &'t [TextureDesc],
    /// Where.
    pub at: TexturePoint,
}

impl TexturesAt<'_> {
    /// The same at a point that is a little off, by so many metres in the world and on the shape, and coordinates.
    pub(crate) fn moved(&self, by: Vec3, by_object: Vec3, [uv, uv_1]: [Vec2; 2]) -> Self {
        let [p, p_object] = [self.at.p + by, self.at.p_object + by_object];
        let at = TexturePoint { uv: self.at.uv + uv, uv_1: self.at.uv_1.map(|at| at + uv_1), p, p_object, ..self.at };
        Self { at, ..*self }
    }
}

impl Textures for TexturesAt<'_> {
    fn color(&self, texture: u32) -> Spectrum {
        // The check has found that names exist and that none leads back to itself.
        self.textures.get(texture as usize).map_or(Spectrum::BLACK, |texture| texture.color(self))
    }
}

impl TextureDesc {
    /// The colour at a point.
    fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        match self {
            Self::Image(t) => t.color(&textures.at),
            Self::Checker(t) => t.color(textures),
            Self::Noise(t) => t.color(textures),
            Self::Marble(t) => t.color(textures),
            Self::Wood(t) => t.color(textures),
            Self::Gradient(t) => t.color(textures),
            Self::VertexColor(t) => t.color(&textures.at),
            Self::Ramp(t) => t.color(textures),
            Self::Mix(t) => t.color(textures),
            Self::Multiply(t) => t.color(textures),
            Self::Invert(t) => t.color(textures),
            Self::Channel(t) => t.color(textures),
        }
    }

    pub(crate) fn check(&self, c: &mut Check) {
        match self {
            Self::Image(t) => c.within("image", |c| t.check(c)),
            Self::Checker(t) => c.within("checker", |c| t.check(c)),
            Self::Noise(t) => c.within("noise", |c| t.check(c)),
            Self::Marble(t) => c.within("marble", |c| t.check(c)),
            Self::Wood(t) => c.within("wood", |c| t.check(c)),
            Self::Gradient(t) => c.within("gradient", |c| t.check(c)),
            Self::VertexColor(t) => c.within("vertex-color", |c| t.check(c)),
            Self::Ramp(t) => c.within("ramp", |c| t.check(c)),
            Self::Mix(t) => c.within("mix", |c| t.check(c)),
            Self::Multiply(t) => c.within("multiply", |c| t.check(c)),
            Self::Invert(t) => c.within("invert", |c| t.check(c)),
            Self::Channel(t) => c.within("channel", |c| t.check(c)),
        }
    }

    /// The key of its kind, and the textures that it is made of, by their keys.
    fn textures(&mut self) -> (&'static str, Named<'_>) {
        match self {
            Self::Image(_) => ("image", vec![]),
            Self::Checker(t) => ("checker", vec![("even", t.even.texture()), ("odd", t.odd.texture())]),
            Self::Noise(t) => ("noise", vec![("dark", t.dark.texture()), ("light", t.light.texture())]),
            Self::Marble(t) => ("marble", vec![("dark", t.dark.texture()), ("light", t.light.texture())]),
            Self::Wood(t) => ("wood", vec![("dark", t.dark.texture()), ("light", t.light.texture())]),
            Self::Gradient(t) => ("gradient", vec![("from", t.from.texture()), ("to", t.to.texture())]),
            Self::VertexColor(_) => ("vertex-color", vec![]),
            Self::Ramp(t) => ("ramp", vec![("input", t.input.texture())]),
            Self::Mix(t) => ("mix", vec![("a", t.a.texture()), ("b", t.b.texture()), ("share", t.share.texture())]),
            Self::Multiply(t) => ("multiply", vec![("a", t.a.texture()), ("b", t.b.texture())]),
            Self::Invert(t) => ("invert", vec![("input", t.input.texture())]),
            Self::Channel(t) => ("channel", vec![("input", t.input.texture())]),
        }
    }
}

/// The names of textures.
pub(crate) fn numbers(textures: &BTreeMap<String, TextureDesc>) -> Numbers<'_> {
    Numbers::new(textures.keys().map(String::as_str))
}

/// Textures by their numbers, that name each other by these.
pub(crate) fn compile(textures: &BTreeMap<String, TextureDesc>) -> Vec<TextureDesc> {
    let numbers = numbers(textures);
    let mut compiled: Vec<_> = textures.values().cloned().collect();
    compiled.iter_mut().for_each(|texture| numbers.resolve(texture.textures().1));
    compiled
}

/// How textures are made of one another.
pub(crate) fn nesting(textures: &BTreeMap<String, TextureDesc>) -> Nesting<'_> {
    let words = ["texture", "textures", "add one as [texture.NAME.KIND], or write a value"];
    let parts = |texture: &TextureDesc| names::words(texture.clone().textures().1);
    Nesting::new(words, textures.iter().map(|(name, texture)| (name.as_str(), parts(texture))))
}

/// Notes what is wrong with textures, names that do not exist, and textures that are made of themselves.
pub(crate) fn check(textures: &BTreeMap<String, TextureDesc>, nesting: &mut Nesting<'_>, c: &mut Check) {
    for (name, texture) in textures {
        c.within(name, |c| {
            texture.check(c);
            let mut texture = texture.clone();
            let (kind, names) = texture.textures();
            nesting.check_names(kind, names, c);
            nesting.check(name, kind, c);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::names::Name;

    fn checker(even: Color, odd: Color) -> TextureDesc {
        TextureDesc::Checker(Checker { even, odd, ..Checker::default() })
    }

    fn named(name: &str) -> Color {
        Color::Texture(Name::new(name))
    }

    fn problems(textures: &[(&str, TextureDesc)]) -> Vec<String> {
        let textures = textures.iter().map(|(name, texture)| ((*name).to_owned(), texture.clone())).collect();
        let mut c = Check::default();
        check(&textures, &mut nesting(&textures), &mut c);
        c.into_problems().into_iter().map(|p| format!("{}: {}", p.path.join("."), p.message)).collect()
    }

    #[test]
    fn a_texture_can_be_made_of_others() {
        let white = Color::Rgb(Rgb::grey(1.0));
        let textures = BTreeMap::from([
            ("fine".to_owned(), checker(white.clone(), Color::Rgb(Rgb::grey(0.5)))),
            ("coarse".to_owned(), checker(named("fine"), Color::Rgb(Rgb::grey(0.0)))),
        ]);
        let textures = compile(&textures);
        let color = |p: Vec3| {
            let at = TexturePoint { p, ..TexturePoint::default() };
            TexturesAt { textures: &textures, at }.color(0).to_rgb()[0]
        };
        assert_eq!([color(Vec3::splat(0.5)), color(Vec3::new(1.5, 0.5, 0.5))], [1.0, 0.0]);
    }

    #[test]
    fn not_too_many_within_each_other() {
        let chain = |n: usize| {
            let texture = |i: usize| {
                let inner = if i + 1 < n { named(&format!("t{:05}", i + 1)) } else { Color::Rgb(Rgb::grey(0.5)) };
                (format!("t{i:05}"), checker(inner, Color::Rgb(Rgb::grey(0.5))))
            };
            let textures: BTreeMap<_, _> = (0..n).map(texture).collect();
            let mut c = Check::default();
            check(&textures, &mut nesting(&textures), &mut c);
            c.into_problems().len()
        };
        assert_eq!([chain(1), chain(16), chain(17), chain(20)], [0, 0, 1, 4]);
        assert!(chain(20_000) > 0);
    }

    /// Few textures can name each other so often that a lookup would never end.
    #[test]
    fn not_too_many_of_few() {
        let pairs = |n: usize| {
            let both = |i: usize| if i == 0 { Color::Rgb(Rgb::grey(0.5)) } else { named(&format!("t{:02}", i - 1)) };
            let textures = (0..n).map(|i| (format!("t{i:02}"), checker(both(i), both(i)))).collect();
            let mut c = Check::default();
            check(&textures, &mut nesting(&textures), &mut c);
            c.into_problems().into_iter().map(|p| p.message).collect::<Vec<_>>()
        };
        assert_eq!(pairs(9), [""; 0]);
        assert_eq!(pairs(10), ["the texture is made of too many textures"]);
    }

    #[test]
    fn names_that_lead_nowhere_and_in_circles() {
        let grey = || Color::Rgb(Rgb::grey(0.5));
        assert_eq!(problems(&[("a", checker(named("b"), grey())), ("b", checker(grey(), grey()))]), [""; 0]);
        assert_eq!(problems(&[("a", checker(named("x"), grey()))]), ["a.checker.even: there is no texture `x`"]);
        assert_eq!(
            problems(&[("a", checker(grey(), named("a")))]),
            ["a.checker: the texture is made of itself: a > a"]
        );
        let ring = [
            ("a", checker(named("b"), grey())),
            ("b", checker(named("c"), grey())),
            ("c", checker(grey(), named("a"))),
        ];
        assert_eq!(
            problems(&ring),
            [
                "a.checker: the texture is made of itself: a > b > c > a",
                "b.checker: the texture is made of itself: b > c > a > b",
                "c.checker: the texture is made of itself: c > a > b > c",
            ]
        );
    }
}
