//! The pixels of a picture as its file has them: a byte of the file stays a byte in memory, and becomes light where it is
//! looked up.
//!
//! Bytes and words are signals: of the sRGB curve (IEC 61966-2-1) if they are colours, linear if they are data such as
//! roughness. Floating-point numbers are linear light.

use std::fmt;
use std::sync::LazyLock;

use glam::Vec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Spectrum, srgb_decode};
use crate::film::{Image, Wrap, bilinear, nearest};
use crate::math::half_to_f32;

/// A picture: row by row from the top left, the channels of a pixel side by side.
#[derive(Clone, PartialEq)]
pub struct Pixels {
    width: u32,
    height: u32,
    /// Grey, grey and alpha, colour, colour and alpha.
    channels: usize,
    samples: Samples,
}

/// Numbers of a picture.
#[derive(Clone, PartialEq)]
pub enum Samples {
    /// Signals in 256 steps.
    Byte(Vec<u8>),
    /// Signals in 65 536 steps.
    Word(Vec<u16>),
    /// Light in 16 bits (IEEE 754 binary16).
    Half(Vec<u16>),
    /// Light in 32 bits.
    Float(Vec<f32>),
}

impl Samples {
    /// How many.
    pub fn len(&self) -> usize {
        match self {
            Self::Byte(s) => s.len(),
            Self::Word(s) | Self::Half(s) => s.len(),
            Self::Float(s) => s.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bytes of one.
    fn size(&self) -> usize {
        match self {
            Self::Byte(_) => 1,
            Self::Word(_) | Self::Half(_) => 2,
            Self::Float(_) => 4,
        }
    }
}

impl fmt::Debug for Pixels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { width, height, channels, samples } = self;
        write!(f, "Pixels({width} x {height}, {channels} channels of {} bytes)", samples.size())
    }
}

/// What the numbers of a picture mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Encoding {
    /// Linear in OpenEXR and Radiance HDR, sRGB in all others.
    #[default]
    Auto,
    /// Colours as screens show them; not for OpenEXR and Radiance HDR.
    Srgb,
    /// Amounts: normals, roughness, shares.
    Linear,
}

/// How a picture is looked up between its pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// Interpolated in both directions between the middles of pixels.
    #[default]
    Bilinear,
    /// Each pixel is a square of one colour.
    Nearest,
}

/// How a picture is looked up.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lookup {
    /// At the sides, above and below.
    pub(super) wrap: [Wrap; 2],
    pub(super) filter: Filter,
    pub(super) encoding: Encoding,
    /// Alpha, and not the colour.
    pub(super) alpha: bool,
}

impl Pixels {
    /// A picture; none unless it has one to four channels and as many numbers as it should.
    pub fn new(width: u32, height: u32, channels: usize, samples: Samples) -> Option<Self> {
        let count = (width as usize).checked_mul(height as usize)?.checked_mul(channels)?;
        ((1..=4).contains(&channels) && count == samples.len()).then_some(Self { width, height, channels, samples })
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Numbers of a pixel, 1..=4: grey, grey and alpha, colour, colour and alpha.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// All numbers.
    pub fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The memory that they take.
    pub fn bytes(&self) -> usize {
        self.samples.len() * self.samples.size()
    }

    /// Whether they are light already, and no signals.
    pub fn is_light(&self) -> bool {
        matches!(self.samples, Samples::Half(_) | Samples::Float(_))
    }

    /// The picture in single precision, without alpha.
    pub fn to_image(&self) -> Image {
        let mut image = Image::new(self.width, self.height);
        let light = |i: usize| match &self.samples {
            Samples::Byte(s) => SRGB_BYTES[usize::from(s[i])],
            Samples::Word(s) => SRGB_WORDS[usize::from(s[i])],
            Samples::Half(s) => half_to_f32(s[i]),
            Samples::Float(s) => s[i],
        };
        let color = if self.channels < 3 { [0, 0, 0] } else { [0, 1, 2] };
        for (i, pixel) in image.pixels_mut().iter_mut().enumerate() {
            *pixel = color.map(|channel| light(i * self.channels + channel));
        }
        image
    }

    /// The colour at a place, each coordinate 0..1 from the left and from the top; alpha as grey, 1 if there is none.
    pub(super) fn at(&self, place: Vec2, lookup: Lookup) -> Spectrum {
        let is_srgb = !lookup.alpha && lookup.encoding != Encoding::Linear;
        match &self.samples {
            Samples::Byte(s) if is_srgb => self.filtered(place, lookup, s, by_table(&SRGB_BYTES)),
            Samples::Byte(s) => self.filtered(place, lookup, s, by_table(&LINEAR_BYTES)),
            Samples::Word(s) if is_srgb => self.filtered(place, lookup, s, by_table(&SRGB_WORDS)),
            Samples::Word(s) => self.filtered(place, lookup, s, |word| f32::from(word) / f32::from(u16::MAX)),
            Samples::Half(s) => self.filtered(place, lookup, s, half_to_f32),
            Samples::Float(s) => self.filtered(place, lookup, s, |c| c),
        }
    }

    #[inline]
    fn filtered<T: Copy>(&self, place: Vec2, lookup: Lookup, samples: &[T], light: impl Fn(T) -> f32) -> Spectrum {
        let width = self.width as usize;
        let pixel = |x: usize, y: usize| {
            let first = (y * width + x) * self.channels;
            match (&samples[first..first + self.channels], lookup.alpha) {
                (&[_, alpha] | &[_, _, _, alpha], true) => Spectrum::from_rgb([light(alpha); 3]),
                (_, true) => Spectrum::ONE,
                (&[r, g, b] | &[r, g, b, _], false) => Spectrum::from_rgb([light(r), light(g), light(b)]),
                (&[grey] | &[grey, _], false) => Spectrum::from_rgb([light(grey); 3]),
                _ => Spectrum::BLACK,
            }
        };
        let size = [self.width, self.height];
        match lookup.filter {
            Filter::Bilinear => bilinear(size, lookup.wrap, place, pixel),
            Filter::Nearest => nearest(size, lookup.wrap, place, pixel),
        }
    }
}

/// Light by signal.
type Table = LazyLock<Vec<f32>>;

static SRGB_BYTES: Table = LazyLock::new(|| table(u8::MAX.into(), srgb_decode));
static LINEAR_BYTES: Table = LazyLock::new(|| table(u8::MAX.into(), |signal| signal));
static SRGB_WORDS: Table = LazyLock::new(|| table(u16::MAX, srgb_decode));

fn table(max: u16, light: fn(f32) -> f32) -> Vec<f32> {
    (0..=max).map(|signal| light(f32::from(signal) / f32::from(max))).collect()
}

#[inline]
fn by_table<T: Into<usize>>(table: &'static Table) -> impl Fn(T) -> f32 {
    let table = table.as_slice();
    move |signal| table[signal.into()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(pixels: &Pixels, u: f32, lookup: Lookup) -> [f32; 3] {
        pixels.at(Vec2::new(u, 0.5), lookup).to_rgb()
    }

    #[test]
    fn signals_become_light_by_their_encoding() {
        let linear = Lookup { encoding: Encoding::Linear, ..Lookup::default() };
        for (samples, signal) in
            [(Samples::Byte(vec![51]), 0.2), (Samples::Word(vec![13107]), 0.2), (Samples::Byte(vec![255]), 1.0)]
        {
            let pixels = Pixels::new(1, 1, 1, samples).unwrap();
            assert_eq!(at(&pixels, 0.5, Lookup::default()), [srgb_decode(signal); 3]);
            assert_eq!(at(&pixels, 0.5, linear), [signal; 3]);
        }
        for samples in [Samples::Half(vec![0x4100, 0, 0x3c00]), Samples::Float(vec![2.5, 0.0, 1.0])] {
            let pixels = Pixels::new(1, 1, 3, samples).unwrap();
            assert!(pixels.is_light());
            assert_eq!(at(&pixels, 0.5, Lookup::default()), [2.5, 0.0, 1.0]);
        }
    }

    #[test]
    fn alpha_is_an_amount() {
        let alpha = Lookup { alpha: true, ..Lookup::default() };
        let leaf = Pixels::new(1, 1, 4, Samples::Byte(vec![255, 0, 255, 51])).unwrap();
        assert_eq!((at(&leaf, 0.5, alpha), at(&leaf, 0.5, Lookup::default())), ([0.2; 3], [1.0, 0.0, 1.0]));
        let grey = Pixels::new(1, 1, 2, Samples::Byte(vec![255, 51])).unwrap();
        assert_eq!((at(&grey, 0.5, alpha), at(&grey, 0.5, Lookup::default())), ([0.2; 3], [1.0; 3]));
        let opaque = Pixels::new(1, 1, 3, Samples::Byte(vec![0, 0, 0])).unwrap();
        assert_eq!(at(&opaque, 0.5, alpha), [1.0; 3]);
    }

    #[test]
    fn nearest_has_squares() {
        let pixels = Pixels::new(2, 1, 1, Samples::Float(vec![0.0, 1.0])).unwrap();
        let values = |filter| {
            let lookup = Lookup { filter, ..Lookup::default() };
            [0.1, 0.25, 0.45, 0.55, 0.75, 0.9, -0.1].map(|u| at(&pixels, u, lookup)[0])
        };
        assert_eq!(values(Filter::Nearest), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
        let [_, first, almost, _, last, ..] = values(Filter::Bilinear);
        assert!(first == 0.0 && last == 1.0 && (almost - 0.4).abs() < 1e-6);
    }

    #[test]
    fn as_many_numbers_as_there_should_be() {
        for (width, height, channels, count) in [(2, 3, 3, 17), (2, 3, 5, 30), (2, 3, 0, 0), (u32::MAX, u32::MAX, 4, 0)]
        {
            assert!(Pixels::new(width, height, channels, Samples::Byte(vec![0; count])).is_none());
        }
        let none = Pixels::new(0, 3, 1, Samples::Byte(vec![])).unwrap();
        assert!(none.samples().is_empty());
        for filter in [Filter::Bilinear, Filter::Nearest] {
            assert_eq!(at(&none, 0.5, Lookup { filter, ..Lookup::default() }), [0.0; 3]);
        }
    }

    #[test]
    fn an_image_of_each_pixel() {
        let pixels = Pixels::new(3, 2, 1, Samples::Byte((0..6).map(|i| 40 * i).collect())).unwrap();
        let light = (0..6).map(|i: u8| [srgb_decode(f32::from(40 * i) / 255.0); 3]);
        assert_eq!(pixels.to_image().pixels(), light.collect::<Vec<_>>());
        assert_eq!((pixels.bytes(), Pixels::new(3, 2, 1, Samples::Word(vec![0; 6])).unwrap().bytes()), (6, 12));
    }
}
