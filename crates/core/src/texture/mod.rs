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

mod checker;
mod color;
mod image;
mod mapping;
mod marble;
mod noise;
mod perlin;
mod pixels;
mod wood;

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::validate::Checker as Check;

pub use checker::Checker;
pub use color::{Color, TextureName};
pub use image::ImageTexture;
pub use mapping::{Mapping, Space};
pub use marble::Marble;
pub use noise::Noise;
pub use pixels::{Encoding, Filter, Pixels, Samples};
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
}

/// Where a texture is looked up.
#[derive(Clone, Copy, Debug, Default)]
pub struct TexturePoint {
    /// Coordinates on the shape.
    pub uv: Vec2,
    /// Place in the world, metres.
    pub p: Vec3,
    /// Place from the shape's own origin, metres.
    pub p_object: Vec3,
    /// Unit shading normal.
    pub n: Vec3,
    /// What the vertices of a mesh say.
    pub vertex_color: Option<Rgb>,
}

/// What materials ask for the colours that they do not hold themselves.
pub trait Textures {
    /// The colour of a texture at the point where the material is.
    fn color(&self, texture: u32) -> Spectrum;
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
        }
    }

    pub(crate) fn check(&self, c: &mut Check) {
        match self {
            Self::Image(t) => c.within("image", |c| t.check(c)),
            Self::Checker(t) => c.within("checker", |c| t.check(c)),
            Self::Noise(t) => c.within("noise", |c| t.check(c)),
            Self::Marble(t) => c.within("marble", |c| t.check(c)),
            Self::Wood(t) => c.within("wood", |c| t.check(c)),
        }
    }

    /// The key of its kind, and the colours that it is made of, by their keys.
    fn colors(&mut self) -> (&'static str, Vec<(&'static str, &mut Color)>) {
        match self {
            Self::Image(_) => ("image", vec![]),
            Self::Checker(t) => ("checker", vec![("even", &mut t.even), ("odd", &mut t.odd)]),
            Self::Noise(t) => ("noise", vec![("dark", &mut t.dark), ("light", &mut t.light)]),
            Self::Marble(t) => ("marble", vec![("dark", &mut t.dark), ("light", &mut t.light)]),
            Self::Wood(t) => ("wood", vec![("dark", &mut t.dark), ("light", &mut t.light)]),
        }
    }
}

/// The numbers of textures, by their names.
#[derive(Clone, Debug)]
pub(crate) struct Numbers<'d>(BTreeMap<&'d str, u32>);

impl<'d> Numbers<'d> {
    pub(crate) fn new(textures: &'d BTreeMap<String, TextureDesc>) -> Self {
        Self(textures.keys().map(String::as_str).zip(0..).collect())
    }

    /// Notes in colours which textures they name.
    pub(crate) fn resolve<'c>(&self, colors: impl IntoIterator<Item = (&'static str, &'c mut Color)>) {
        for (_, color) in colors {
            if let Color::Texture(name) = color {
                name.index = self.0.get(name.name.as_str()).copied().unwrap_or(u32::MAX);
            }
        }
    }
}

/// Textures by their numbers, that name each other by these.
pub(crate) fn compile(textures: &BTreeMap<String, TextureDesc>) -> Vec<TextureDesc> {
    let numbers = Numbers::new(textures);
    let mut compiled: Vec<_> = textures.values().cloned().collect();
    compiled.iter_mut().for_each(|texture| numbers.resolve(texture.colors().1));
    compiled
}

/// Notes names that do not exist, and textures that are made of themselves.
pub(crate) fn check(textures: &BTreeMap<String, TextureDesc>, c: &mut Check) {
    let mut nesting = Nesting::new(textures);
    for (name, texture) in textures {
        c.within(name, |c| {
            texture.check(c);
            check_names(texture.clone().colors(), textures, c);
            nesting.check(name, texture.clone().colors().0, c);
        });
    }
}

/// Notes the names of textures that do not exist, in colours below the key of a kind.
pub(crate) fn check_names(
    (kind, colors): (&str, Vec<(&str, &mut Color)>),
    textures: &BTreeMap<String, TextureDesc>,
    c: &mut Check,
) {
    c.within(kind, |c| colors.into_iter().for_each(|(key, color)| check_name(key, color, textures, c)));
}

/// Notes a name that no texture has.
fn check_name(key: &str, color: &Color, textures: &BTreeMap<String, TextureDesc>, c: &mut Check) {
    let Color::Texture(TextureName { name, .. }) = color else { return };
    if textures.contains_key(name) {
        return;
    }
    let words = ["texture", "textures", "add one as [texture.NAME.KIND], or write a colour"];
    c.no_such(key, words, name, textures.keys());
}

/// How deep textures are made of one another.
struct Nesting<'d> {
    /// What each texture is made of.
    parts: BTreeMap<&'d str, Vec<&'d str>>,
    /// Of those that are known not to lead too deep or back to themselves.
    depth: BTreeMap<&'d str, usize>,
}

impl<'d> Nesting<'d> {
    /// The most textures within each other.
    const MOST: usize = 16;

    fn new(textures: &'d BTreeMap<String, TextureDesc>) -> Self {
        let named = |color: &Color| match color {
            Color::Texture(TextureName { name, .. }) => textures.get_key_value(name).map(|(name, _)| name.as_str()),
            Color::Rgb(_) => None,
        };
        let parts =
            |texture: &TextureDesc| texture.clone().colors().1.iter().filter_map(|(_, color)| named(color)).collect();
        Self {
            parts: textures.iter().map(|(name, texture)| (name.as_str(), parts(texture))).collect(),
            depth: BTreeMap::new(),
        }
    }

    /// Notes that a texture, of a kind, is made of itself, or of too many within each other.
    fn check(&mut self, name: &'d str, kind: &str, c: &mut Check) {
        let Err(way) = self.depth(&mut Vec::new(), name) else { return };
        let Some((last, before)) = way.split_last() else { return };
        if before.first() == Some(last) {
            let message = format!("the texture is made of itself: {}", way.join(" > "));
            c.problem(kind, message, Some("give one of them a colour instead".to_owned()));
        } else if !before.contains(last) {
            let hint = format!("at most {} are allowed", Self::MOST);
            c.problem(kind, "the texture is made of too many textures within each other", Some(hint));
        }
    }

    /// The depth of a texture, itself counted, or the way to it from where one has begun, if that is too long or comes back.
    fn depth(&mut self, way: &mut Vec<&'d str>, name: &'d str) -> Result<usize, Vec<&'d str>> {
        if let Some(&depth) = self.depth.get(name) {
            return if way.len() + depth > Self::MOST { Err([&way[..], &[name]].concat()) } else { Ok(depth) };
        }
        let comes_back = way.contains(&name);
        way.push(name);
        if comes_back || way.len() > Self::MOST {
            return Err(way.clone());
        }
        let mut below = 0;
        for part in self.parts.get(name).cloned().unwrap_or_default() {
            below = below.max(self.depth(way, part)?);
        }
        way.pop();
        self.depth.insert(name, below + 1);
        Ok(below + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn checker(even: Color, odd: Color) -> TextureDesc {
        TextureDesc::Checker(Checker { even, odd, ..Checker::default() })
    }

    fn named(name: &str) -> Color {
        Color::Texture(TextureName::new(name))
    }

    fn problems(textures: &[(&str, TextureDesc)]) -> Vec<String> {
        let textures = textures.iter().map(|(name, texture)| ((*name).to_owned(), texture.clone())).collect();
        let mut c = Check::default();
        check(&textures, &mut c);
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
                (format!("t{i:05}"), checker(inner.clone(), inner))
            };
            let textures: BTreeMap<_, _> = (0..n).map(texture).collect();
            let mut c = Check::default();
            check(&textures, &mut c);
            c.into_problems().len()
        };
        assert_eq!([chain(1), chain(16), chain(17), chain(20)], [0, 0, 1, 4]);
        assert!(chain(20_000) > 0);
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
