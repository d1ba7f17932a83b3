//! Figure 2: what the maximum recursion depth does.
//!
//! The numbers are mean colours of regions that are given in metres on the ground and found in the picture by rays: the
//! disc below each sphere, and a disc of open ground far from both. The sphere behind the eye and its shadow are seen in
//! the mirror of the yellow one, which colours them, so they are compared with open ground in that mirror.

use eyebeam_core::color::luminance;
use eyebeam_core::film::Image;
use eyebeam_core::render::Settings;
use glam::{UVec2, Vec3};

use super::page;
use super::probe::{Probe, Seen, mean};
use super::sheet::Sheet;
use super::table::Table;
use super::{Study, build, render, scene};
use crate::error::Error;

pub(super) const NAME: &str = "depth";

const DEPTHS: [u32; 4] = [1, 2, 3, 50];

// Places of the spheres in the file.
const GROUND: usize = 0;
const YELLOW: usize = 1;
const SILVER: usize = 2;

pub(super) fn make(study: &Study<'_>) -> Result<(), Error> {
    let desc = scene("two-spheres.toml", include_str!("../../../../../scenes/two-spheres.toml"))?;
    let scene = build(&desc)?;
    let (width, height, spp) = study.pick((480, 360, 400), (160, 120, 64));
    let settings = Settings { width, height, spp, ..Settings::from(&desc.render.plain()) };
    let regions = regions(&Probe { desc: &desc, scene: &scene, width, height });

    let (mut table, mut tiles) = (Table::new(&COLUMNS), Vec::new());
    for max_depth in DEPTHS {
        let image = render(&scene, Settings { max_depth, ..settings.clone() });
        measure(&image, max_depth, &regions, &mut table);
        tiles.push((format!("maximum depth d = {max_depth}"), image));
        study.say(&format!("depth: d = {max_depth}"));
    }
    let sheet = Sheet::new(2, tiles);
    study.write(NAME, &page::draw(sheet.size(), |area| sheet.draw(area))?, &table)
}

/// Some pixels, and those of another region whose yellowness counts as none.
struct Region {
    name: &'static str,
    pixels: Vec<UVec2>,
    neutral: Option<Vec<UVec2>>,
}

fn regions(probe: &Probe<'_>) -> Vec<Region> {
    /// Metres; well inside each sphere's shadow, and well outside.
    const SHADOW_RADIUS: f32 = 0.7;
    const OPEN: (Vec3, f32) = (Vec3::new(5.0, 0.0, -5.0), 1.5);
    const OPEN_BEHIND: (Vec3, f32) = (Vec3::new(5.0, 0.0, 5.0), 2.5);

    let below = |sphere: usize| (Vec3::from(probe.desc.shape.sphere[sphere].center), SHADOW_RADIUS);
    let on_disc = |seen: Seen, (center, radius): (Vec3, f32)| {
        let aside = (seen.p - center) * Vec3::new(1.0, 0.0, 1.0);
        seen.sphere == GROUND && aside.length() < radius
    };
    let seen = |disc| probe.pixels(|seen| seen.is_some_and(|seen| on_disc(seen, disc)));
    let mirrored = |disc| probe.pixels_mirrored(YELLOW, |seen| on_disc(seen, disc));
    let (open, open_behind) = (seen(OPEN), mirrored(OPEN_BEHIND));
    let region = |name, pixels, neutral| Region { name, pixels, neutral };
    vec![
        region("sky", probe.pixels(|seen| seen.is_none()), None),
        region("all_surfaces", probe.pixels(|seen| seen.is_some()), None),
        region("ground_below_yellow", seen(below(YELLOW)), Some(open.clone())),
        region("open_ground", open.clone(), Some(open)),
        region("ground_below_other_mirrored", mirrored(below(SILVER)), Some(open_behind.clone())),
        region("open_ground_mirrored", open_behind.clone(), Some(open_behind)),
    ]
}

const COLUMNS: [&str; 9] =
    ["region", "max_depth", "red", "green", "blue", "luminance", "yellowness", "relative_yellowness", "pixels"];

/// Adds a row for each region; yellowness is (R + G) / 2B, and there is none without light.
fn measure(image: &Image, max_depth: u32, regions: &[Region], table: &mut Table) {
    let yellowness = |[r, g, b]: [f64; 3]| (b > 0.0).then(|| (r + g) / (2.0 * b));
    for Region { name, pixels, neutral } in regions {
        let color = mean(image, pixels);
        let neutral = neutral.as_ref().and_then(|pixels| yellowness(mean(image, pixels)));
        let [r, g, b] = color;
        table.push([
            (*name).into(),
            max_depth.into(),
            r.into(),
            g.into(),
            b.into(),
            luminance(color).into(),
            yellowness(color).into(),
            yellowness(color).zip(neutral).map(|(y, neutral)| y / neutral).into(),
            (pixels.len() as u64).into(),
        ]);
    }
}
