//! How pictures are shown and written: the same words for every command that writes one.

use clap::Args as ClapArgs;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use eyebeam_core::look::{Exposure, Look, View};
use eyebeam_io::image::{Bits, Encoding};

#[derive(Clone, Debug, ClapArgs)]
#[command(next_help_heading = "Look of .png and .jpg (.exr and .hdr stay linear light)")]
pub(crate) struct LookArgs {
    /// Curve from light to the screen [default: agx; of models in the studio neutral]
    #[arg(long, value_parser = view())]
    pub(crate) view: Option<View>,
    /// Let the lens scatter this share of the light, which glows around what is bright; 0 is off, 0.2 is much
    #[arg(long, value_name = "SHARE", default_value = "0", value_parser = bloom)]
    pub(crate) bloom: f32,
    /// Darken the corners as a lens of this field of view does, degrees from the bottom to the top; 0 is off
    #[arg(long, value_name = "DEG", default_value = "0", value_parser = vignette)]
    pub(crate) vignette: f32,
    /// Make it brighter by 2 to the power of EV; auto makes it as bright as middle grey [default: 0; of models in other light than
    /// the studio's auto]
    #[arg(long, value_name = "EV", allow_negative_numbers = true)]
    pub(crate) exposure: Option<Exposure>,
    /// Temperature of the light that is to look white, kelvin
    #[arg(long, value_name = "K", default_value = "6500", value_parser = white_balance)]
    pub(crate) white_balance: f32,
    /// Slope about middle grey; 1 changes nothing
    #[arg(long, value_name = "C", default_value = "1", value_parser = contrast)]
    pub(crate) contrast: f32,
    /// Distance of colours from grey; 1 changes nothing, 0 is grey
    #[arg(long, value_name = "S", default_value = "1", value_parser = saturation)]
    pub(crate) saturation: f32,
    /// Hide the steps of soft gradients in 8 bit by noise
    #[arg(long)]
    pub(crate) dither: bool,
    /// Bits of each channel of a .png
    #[arg(long, default_value = "8", value_parser = bits(), help_heading = FILES)]
    pub(crate) bits: Bits,
    /// Colours of an .exr in 16 bits instead of 32
    #[arg(long, help_heading = FILES)]
    pub(crate) half: bool,
    /// Quality of a .jpg, 1 to 100
    #[arg(long, value_name = "Q", default_value_t = Encoding::QUALITY, value_parser = clap::value_parser!(u8).range(1..=100),
        help_heading = FILES)]
    pub(crate) quality: u8,
}

const FILES: &str = "Files";

impl LookArgs {
    pub(crate) fn encoding(&self) -> Encoding {
        let Self { view, bloom, vignette, exposure, white_balance, contrast, saturation, dither, .. } = *self;
        let (view, exposure) = (view.unwrap_or(View::FOR_PICTURES), exposure.unwrap_or(Look::default().exposure));
        let look = Look { view, bloom, vignette, exposure, white_balance, contrast, saturation, dither };
        let Self { bits, half, quality, .. } = *self;
        Encoding { look, bits, half, quality }
    }
}

fn view() -> impl TypedValueParser<Value = View> {
    let named = |name: String| View::NAMES.iter().find(|(n, _)| *n == name).map(|(_, view)| *view);
    let told = |(name, view): &(&'static str, View)| PossibleValue::new(*name).help(about(*view));
    PossibleValuesParser::new(View::NAMES.iter().map(told))
        .try_map(move |name| named(name).ok_or("there is no such view"))
}

fn about(view: View) -> &'static str {
    match view {
        View::Standard => "The sRGB curve, clipped at 1",
        View::Filmic => "A soft shoulder on each channel",
        View::Aces => "Contrast and warm highlights as in cinemas",
        View::Agx => "Bright colours fade to white, as in photographs",
        View::AgxBase => "The same without added contrast",
        View::Neutral => "Colours as they are, of products; highlights fade to white",
        View::Raw => "No curve: linear light, clipped at 1",
    }
}

fn bits() -> impl TypedValueParser<Value = Bits> {
    PossibleValuesParser::new(["8", "16"]).map(|bits| if bits == "16" { Bits::Sixteen } else { Bits::Eight })
}

fn bloom(text: &str) -> Result<f32, String> {
    within(text, Look::BLOOM_RANGE)
}

fn vignette(text: &str) -> Result<f32, String> {
    within(text, Look::VIGNETTE_RANGE)
}

fn white_balance(text: &str) -> Result<f32, String> {
    within(text, Look::WHITE_RANGE)
}

fn contrast(text: &str) -> Result<f32, String> {
    within(text, Look::CONTRAST_RANGE)
}

fn saturation(text: &str) -> Result<f32, String> {
    within(text, Look::SATURATION_RANGE)
}

fn within(text: &str, [lo, hi]: [f32; 2]) -> Result<f32, String> {
    let value = text.parse().ok().filter(|value| (lo..=hi).contains(value));
    value.ok_or_else(|| format!("use a number from {lo} to {hi}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_options_nothing_is_changed() {
        #[derive(clap::Parser)]
        struct Only {
            #[command(flatten)]
            look: LookArgs,
        }
        let only: Only = clap::Parser::parse_from(["eyebeam"]);
        let look = Look { view: View::FOR_PICTURES, ..Look::default() };
        assert_eq!(only.look.encoding(), Encoding { look, ..Encoding::default() });
    }
}
