//! A number, or the texture that it comes from.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Visitor};
use serde::{Serialize, Serializer};

use crate::color::Rgb;
use crate::names::Name;
use crate::texture::Textures;
use crate::validate::Checker;

/// What a material takes for a number: `0.5`, or the name of a texture, whose luminance it is.
#[derive(Clone, Debug, PartialEq)]
pub enum Scalar {
    /// The same everywhere.
    Number(f32),
    /// That of a texture.
    Texture(Name),
}

impl Scalar {
    /// The number at a point, in a range, whatever a texture says.
    #[inline]
    pub(crate) fn at(&self, textures: &impl Textures, lo: f32, hi: f32) -> f32 {
        match self {
            Self::Number(number) => *number,
            Self::Texture(name) => Rgb(textures.color(name.index()).to_rgb()).luminance().clamp(lo, hi),
        }
    }

    /// The number, if it is the same everywhere.
    pub fn number(&self) -> Option<f32> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Texture(_) => None,
        }
    }

    /// The texture, if it is one.
    pub(crate) fn texture(&mut self) -> Option<&mut Name> {
        match self {
            Self::Number(_) => None,
            Self::Texture(name) => Some(name),
        }
    }

    /// Notes a number out of range; what textures hold is limited where it is looked up.
    pub(crate) fn check_range(&self, key: &str, lo: f32, hi: f32, c: &mut Checker) {
        if let Self::Number(number) = self {
            c.in_range(key, *number, lo, hi);
        }
    }
}

impl From<f32> for Scalar {
    fn from(number: f32) -> Self {
        Self::Number(number)
    }
}

impl Serialize for Scalar {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => number.serialize(serializer),
            Self::Texture(name) => name.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ScalarVisitor;
        impl Visitor<'_> for ScalarVisitor {
            type Value = Scalar;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a number, or the name of a texture")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Scalar, E> {
                Ok(Scalar::Number(value as f32))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Scalar, E> {
                Ok(Scalar::Number(value as f32))
            }

            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Scalar, E> {
                Ok(Scalar::Number(value as f32))
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<Scalar, E> {
                Ok(Scalar::Texture(Name::new(name)))
            }
        }
        deserializer.deserialize_any(ScalarVisitor)
    }
}

impl JsonSchema for Scalar {
    fn schema_name() -> Cow<'static, str> {
        "Scalar".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or the name of a texture.",
            "anyOf": [{ "type": "number" }, { "type": "string", "description": "The name of a texture." }]
        })
    }
}
