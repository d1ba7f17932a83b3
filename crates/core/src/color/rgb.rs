//! Colours as people write them, and the sRGB transfer function.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use serde::{Serialize, Serializer};

use crate::color::Spectrum;

/// A colour in a scene: linear red, green and blue.
///
/// Written as `[0.8, 0.4, 0.1]` (linear), `0.5` (grey) or `"#e6b450"` (sRGB, as colour pickers show it).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rgb(pub [f32; 3]);

impl Rgb {
    /// The same in all three.
    pub const fn grey(value: f32) -> Self {
        Self([value; 3])
    }

    /// Rec. 709 luminance.
    pub fn luminance(self) -> f32 {
        let [r, g, b] = self.0;
        let [wr, wg, wb] = LUMINANCE.map(|w| w as f32);
        wr * r + wg * g + wb * b
    }

    fn from_hex(text: &str) -> Option<Self> {
        let hex = text.strip_prefix('#').filter(|h| h.len() == 6 && h.bytes().all(|b| b.is_ascii_hexdigit()))?;
        let value = u32::from_str_radix(hex, 16).ok()?;
        Some(Self([16, 8, 0].map(|shift| srgb_decode((value >> shift & 255) as f32 / 255.0))))
    }
}

/// Share of each channel in Rec. 709 luminance.
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Rec. 709 luminance of a linear colour, in double precision.
pub fn luminance(rgb: [f64; 3]) -> f64 {
    rgb.iter().zip(LUMINANCE).map(|(c, weight)| c * weight).sum()
}

impl From<Rgb> for Spectrum {
    fn from(rgb: Rgb) -> Self {
        Self::from_rgb(rgb.0)
    }
}

impl Serialize for Rgb {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Rgb {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct RgbVisitor;
        impl<'de> Visitor<'de> for RgbVisitor {
            type Value = Rgb;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a colour: [red, green, blue], a number for grey, or \"#rrggbb\"")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Rgb, E> {
                Ok(Rgb::grey(value as f32))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Rgb, E> {
                Ok(Rgb::grey(value as f32))
            }

            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Rgb, E> {
                Ok(Rgb::grey(value as f32))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Rgb, E> {
                Rgb::from_hex(text).ok_or_else(|| E::invalid_value(de::Unexpected::Str(text), &self))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Rgb, A::Error> {
                let mut rgb = [0.0; 3];
                for (i, lane) in rgb.iter_mut().enumerate() {
                    *lane = seq.next_element()?.ok_or_else(|| de::Error::invalid_length(i, &self))?;
                }
                match seq.next_element::<f32>()? {
                    None => Ok(Rgb(rgb)),
                    Some(_) => Err(de::Error::invalid_length(4, &self)),
                }
            }
        }
        deserializer.deserialize_any(RgbVisitor)
    }
}

impl JsonSchema for Rgb {
    fn schema_name() -> Cow<'static, str> {
        "Rgb".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A colour: linear [red, green, blue], a number for grey, or \"#rrggbb\" in sRGB.",
            "oneOf": [
                { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
                { "type": "number" },
                { "type": "string", "pattern": "^#[0-9a-fA-F]{6}$" }
            ]
        })
    }
}

/// Linear light 0..1 to the sRGB signal 0..1 (IEC 61966-2-1).
pub fn srgb_encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055 }
}

/// The sRGB signal 0..1 to linear light 0..1: the inverse of [`srgb_encode`].
pub fn srgb_decode(signal: f32) -> f32 {
    if signal <= 0.040_45 { signal / 12.92 } else { libm::powf((signal + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_round_trips_every_byte() {
        for byte in 0..=255_u32 {
            let signal = byte as f32 / 255.0;
            assert_eq!((srgb_encode(srgb_decode(signal)) * 255.0).round() as u32, byte);
        }
        // The standard's own worked value: linear 0.5 is 188 of 255.
        assert_eq!((srgb_encode(0.5) * 255.0).round(), 188.0);
    }

    #[test]
    fn hex_is_srgb() {
        assert_eq!(Rgb::from_hex("#ffffff").unwrap().0, [1.0; 3]);
        assert!((Rgb::from_hex("#bc0000").unwrap().0[0] - 0.5).abs() < 0.005);
        for bad in ["ffffff", "#fff", "#gggggg", "#ééé"] {
            assert!(Rgb::from_hex(bad).is_none(), "{bad}");
        }
    }
}
