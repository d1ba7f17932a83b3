//! The picture of the sky, and the sun's disk in front of it.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

use super::SkyDesc;
use super::atmosphere::{GROUND, between};
use super::bands::{Bands, Observer, SOLAR};
use super::scattering::{Inscatter, Scattering, cornette_shanks, rayleigh};
use crate::color::Rgb;
use crate::film::Image;

/// A sky ready to give light.
#[derive(Clone, Debug)]
pub struct Sky {
    /// Radiance of all directions without the sun's disk, by latitude and longitude: the middle of pixel (x, y) of
    /// w × h is the direction (sin φ sin θ, cos θ, -cos φ sin θ) with φ = 2π (x + ½) / w and θ = π (y + ½) / h. Row 0
    /// is straight above, the first column looks along -Z, a quarter further is +X. The horizon lies between two rows.
    pub image: Image,
    /// The sun, unless it has set or is switched off.
    pub sun: Option<SunDisk>,
}

/// The sun: an evenly bright disk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunDisk {
    /// Unit vector to its middle.
    pub direction: Vec3,
    /// Half the angle that it fills, radians.
    pub angular_radius: f32,
    /// Radiance of the disk, reddened by the air. Times its [`projected_solid_angle`](Self::projected_solid_angle) it is
    /// irradiance.
    pub radiance: Rgb,
}

impl SunDisk {
    /// What the disk counts for on a surface that faces its middle, sr: the integral of cos θ over it, π sin² α for a
    /// radius α.
    pub fn projected_solid_angle(&self) -> f32 {
        let sin = libm::sinf(self.angular_radius);
        std::f32::consts::PI * sin * sin
    }
}

impl Sky {
    /// Size of the picture.
    pub const WIDTH: u32 = 512;
    /// Rows; an even number, so that no pixel lies on the horizon.
    pub const HEIGHT: u32 = 256;

    /// Computes the sky of a description that passed its check.
    pub fn bake(desc: &SkyDesc) -> Self {
        Self::bake_size(desc, Self::WIDTH, Self::HEIGHT)
    }

    /// As [`bake`](Self::bake), with another size of the picture; `height` is even.
    pub(super) fn bake_size(desc: &SkyDesc, width: u32, height: u32) -> Self {
        let painter = Painter::new(desc);
        let mut image = Image::new(width, height);
        let sky = painter.paint_sky(&mut image);
        painter.paint_ground(&mut image, sky);
        Self { image, sun: painter.sun_disk(desc) }
    }
}

/// Luminance of the unit of radiance at scale 1, cd / m².
const UNIT: f64 = 10_000.0;

struct Painter {
    scattering: Scattering,
    observer: Observer,
    sun: DVec3,
    /// The unit of light.
    scale: f64,
    ground_albedo: f64,
}

impl Painter {
    /// Azimuths from the sun's to the opposite at which light is computed; it is mixed between.
    const AZIMUTHS: usize = 65;

    fn new(desc: &SkyDesc) -> Self {
        let ground_albedo = f64::from(desc.ground_albedo);
        let sun = desc.sun();
        Self {
            scattering: Scattering::new(f64::from(desc.turbidity), ground_albedo, sun.y),
            observer: Observer::new(),
            sun,
            scale: f64::from(desc.scale) / UNIT,
            ground_albedo,
        }
    }

    /// The colour of light from a sun of unit irradiance.
    fn rgb(&self, light: Bands) -> [f64; 3] {
        self.observer.rgb(light * SOLAR * self.scale)
    }

    /// Paints what is above the horizon, and returns its irradiance on the ground.
    fn paint_sky(&self, image: &mut Image) -> [f64; 3] {
        let (width, height) = (image.width(), image.height());
        let azimuths: Vec<_> =
            (0..width).map(|x| self.azimuth(TAU * (f64::from(x) + 0.5) / f64::from(width))).collect();
        let mut irradiance = [0.0; 3];
        for y in 0..height / 2 {
            let theta = PI * (f64::from(y) + 0.5) / f64::from(height);
            let (sin, cos) = (libm::sin(theta), libm::cos(theta));
            let row = self.row(sin, cos);
            // The integral of cos θ sin θ over the row is ½ sin 2θ sin dθ, and dθ = π / height.
            let weight = sin * cos * libm::sin(PI / f64::from(height)) * TAU / f64::from(width);
            for (x, &(direction, azimuth)) in (0..).zip(&azimuths) {
                let view = DVec3::new(direction.x * sin, cos, direction.z * sin);
                let rgb = row.light(azimuth, view.dot(self.sun));
                irradiance = std::array::from_fn(|i| irradiance[i] + weight * rgb[i]);
                image.set_pixel(x, y, rgb.map(|c| c as f32));
            }
        }
        irradiance
    }

    /// The horizontal direction at φ, and its angle from the sun's azimuth as a share of half a turn.
    fn azimuth(&self, phi: f64) -> (DVec3, f64) {
        let direction = DVec3::new(libm::sin(phi), 0.0, -libm::cos(phi));
        let across = DVec3::new(self.sun.x, 0.0, self.sun.z);
        let along = across.dot(direction);
        (direction, libm::atan2(across.cross(direction).length(), along) / PI)
    }

    /// The light of a row at zenith angle θ, azimuth by azimuth.
    fn row(&self, sin: f64, cos: f64) -> Row {
        let across = (1.0 - self.sun.y * self.sun.y).max(0.0).sqrt();
        let sun = DVec3::new(across, self.sun.y, 0.0);
        let at = |i: usize| {
            let phi = PI * i as f64 / (Self::AZIMUTHS - 1) as f64;
            let view = DVec3::new(sin * libm::cos(phi), cos, sin * libm::sin(phi));
            let Inscatter { molecules, aerosol, multiple } = self.scattering.inscatter(view, sun);
            [molecules, aerosol, multiple].map(|light| self.rgb(light))
        };
        Row((0..Self::AZIMUTHS).map(at).collect())
    }

    /// The ground below: it scatters evenly what it gets from the sun and the sky.
    fn paint_ground(&self, image: &mut Image, sky: [f64; 3]) {
        let sun = self.rgb(self.sunlight()).map(|c| c.max(0.0) * self.sun.y.max(0.0));
        let radiance: [f64; 3] = std::array::from_fn(|i| self.ground_albedo / PI * (sun[i] + sky[i]));
        for y in image.height() / 2..image.height() {
            for x in 0..image.width() {
                image.set_pixel(x, y, radiance.map(|c| c as f32));
            }
        }
    }

    fn sunlight(&self) -> Bands {
        self.scattering.air.sunlight(GROUND, self.sun.y)
    }

    fn sun_disk(&self, desc: &SkyDesc) -> Option<SunDisk> {
        let irradiance = self.rgb(self.sunlight()).map(|c| c.max(0.0) * f64::from(desc.sun));
        let disk = SunDisk {
            direction: self.sun.as_vec3(),
            angular_radius: 0.5 * desc.sun_size.to_radians(),
            radiance: Rgb([0.0; 3]),
        };
        let radiance = Rgb(irradiance.map(|c| (c / f64::from(disk.projected_solid_angle())) as f32));
        (radiance.0 != [0.0; 3]).then_some(SunDisk { radiance, ..disk })
    }
}

/// Colours of a row without phase functions: molecules, aerosol, multiple; azimuth by azimuth from the sun's.
struct Row(Vec<[[f64; 3]; 3]>);

impl Row {
    /// The radiance at an azimuth, 0..1, and an angle from the sun by its cosine. What Rec. 709 cannot show is cut off.
    fn light(&self, azimuth: f64, cos_gamma: f64) -> [f64; 3] {
        let ([first, second], t) = between(azimuth, self.0.len());
        let phases = [rayleigh(cos_gamma), cornette_shanks(cos_gamma), 1.0];
        std::array::from_fn(|channel| {
            let mix = |kind: usize| self.0[first][kind][channel] * (1.0 - t) + self.0[second][kind][channel] * t;
            (0..3).map(|kind| phases[kind] * mix(kind)).sum::<f64>().max(0.0)
        })
    }
}
