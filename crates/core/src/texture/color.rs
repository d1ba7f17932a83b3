//! A colour, or the texture that it comes from.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, IntoDeserializer, SeqAccess, Visitor};
use serde::{Serialize, Serializer};

use crate::color::{Rgb, Spectrum};
use crate::names::Name;
use crate::texture::Textures;
use crate::validate::Checker;

/// What a material takes for a colour: `[0.8, 0.4, 0.1]`, `0.5`, `"#e6b450"`, or the name of a texture.
#[derive(Clone, Debug, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Rgb(Rgb),
    /// That of a texture.
    Texture(Name),
}

impl Color {
    /// The colour at a point, from nothing to the brightest.
    #[inline]
    pub(crate) fn at(&self, textures: &impl Textures) -> Spectrum {
        match self {
            Self::Rgb(rgb) => (*rgb).into(),
            Self::Texture(name) => textures.color(name.index()),
        }
    }

    /// The share of light at a point, 0..1 in each channel, whatever a texture says.
    #[inline]
    pub(crate) fn share_at(&self, textures: &impl Textures) -> Spectrum {
        match self {
            Self::Rgb(rgb) => (*rgb).into(),
            Self::Texture(name) => textures.color(name.index()).clamp(0.0, 1.0),
        }
    }

    /// This and a share of another, of which only what counts is looked up.
    #[inline]
    pub(super) fn mixed(&self, other: &Self, share: f32, textures: &impl Textures) -> Spectrum {
        match share {
            0.0 => self.at(textures),
            1.0 => other.at(textures),
            _ => self.at(textures).lerp(other.at(textures), share),
        }
    }

    /// The amount of light at a point, from nothing to the brightest that the film holds, whatever a texture says.
    #[inline]
    pub(crate) fn amount_at(&self, textures: &impl Textures) -> Spectrum {
        match self {
            Self::Rgb(rgb) => (*rgb).into(),
            Self::Texture(name) => textures.color(name.index()).clamp(0.0, Checker::BRIGHTEST),
        }
    }

    /// The colour, if it is the same everywhere.
    pub fn rgb(&self) -> Option<Rgb> {
        match self {
            Self::Rgb(rgb) => Some(*rgb),
            Self::Texture(_) => None,
        }
    }

    /// The texture, if it is one.
    pub(crate) fn texture(&mut self) -> Option<&mut Name> {
        match self {
            Self::Rgb(_) => None,
            Self::Texture(name) => Some(name),
        }
    }

    /// Notes an albedo that is not from 0 to 1; what textures hold is limited where it is looked up.
    pub(crate) fn check_share(&self, key: &str, c: &mut Checker) {
        if let Self::Rgb(rgb) = self {
            c.albedo(key, *rgb);
        }
    }

    /// Notes a colour that is no amount of light.
    pub(crate) fn check_amount(&self, key: &str, c: &mut Checker) {
        if let Self::Rgb(rgb) = self {
            c.radiance(key, *rgb);
        }
    }
}

impl From<Rgb> for Color {
    fn from(rgb: Rgb) -> Self {
        Self::Rgb(rgb)
    }
}

impl Serialize for Color {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Rgb(rgb) => rgb.serialize(serializer),
            Self::Texture(name) => name.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ColorVisitor;
        impl<'de> Visitor<'de> for ColorVisitor {
            type Value = Color;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a colour: [red, green, blue], a number for grey, \"#rrggbb\", or the name of a texture")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Color, E> {
                Ok(Rgb::grey(value as f32).into())
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Color, E> {
                Ok(Rgb::grey(value as f32).into())
            }

            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Color, E> {
                Ok(Rgb::grey(value as f32).into())
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Color, E> {
                if text.starts_with('#') {
                    return Rgb::deserialize(text.into_deserializer()).map(Color::Rgb);
                }
                Ok(Color::Texture(Name::new(text)))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Color, A::Error> {
                Rgb::deserialize(de::value::SeqAccessDeserializer::new(seq)).map(Color::Rgb)
            }
        }
        deserializer.deserialize_any(ColorVisitor)
    }
}

impl JsonSchema for Color {
    fn schema_name() -> Cow<'static, str> {
        "Color".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A colour, or the name of a texture.",
            "anyOf": [
                generator.subschema_for::<Rgb>(),
                { "type": "string", "description": "The name of a texture.", "pattern": "^[^#]" }
            ]
        })
    }
}
