//! A clear sky with its sun.
//!
//! The sun's direction is given, or follows from place and time (`solar`). The light that the air scatters is computed
//! once, at twelve wavelengths: single scattering by ray marching and the rest by Hillaire's table (`scattering`,
//! `atmosphere`); Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020,
//! doi:10.1111/cgf.14050. The result is a picture (`bake`) and, as a light of its own, the sun's disk.
//!
//! ```toml
//! [environment.sky]
//! latitude = 48.2
//! longitude = 16.37
//! time = "2026-06-21T18:30:00+02:00"
//! turbidity = 3
//! ```

mod atmosphere;
mod bake;
mod bands;
mod scattering;
mod solar;
mod time;

use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::optional_array;
use crate::validate::Checker;

pub use bake::{Sky, SunDisk};

/// A clear sky. The sun stands where one of `sun_direction`, `sun_elevation` with `sun_azimuth`, or `latitude`,
/// `longitude` and `time` says; without any, 45° high in the south-east.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SkyDesc {
    /// Towards the sun, of any length; +Y is up.
    #[serde(deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub sun_direction: Option<[f32; 3]>,
    /// Angle of the sun above the horizon, degrees, -90..90; 45 if absent.
    #[schemars(range(min = -90.0, max = 90.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sun_elevation: Option<f32>,
    /// Direction of the sun along the horizon, degrees, -360..360: 0 is north (-Z), 90 east (+X); 135 if absent.
    #[schemars(range(min = -360.0, max = 360.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sun_azimuth: Option<f32>,
    /// Latitude of the place, degrees north, -90..90.
    #[schemars(range(min = -90.0, max = 90.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latitude: Option<f32>,
    /// Longitude of the place, degrees east, -180..180.
    #[schemars(range(min = -180.0, max = 180.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub longitude: Option<f32>,
    /// Date and time as RFC 3339 with an offset from UTC: "2026-06-21T12:00:00Z", "2026-06-21T14:00:00+02:00".
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<String>,
    /// How hazy the air is, 1..10: 2 is clear, 3 a little hazy, 6 hazy.
    #[schemars(range(min = 1.0, max = 10.0))]
    pub turbidity: f32,
    /// Share of light that the planet's ground reflects, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub ground_albedo: f32,
    /// Factor on the radiance of sky and sun. At 1, radiance 1 is a luminance of 10 000 cd / m²; at 49.3 it is 1 W /
    /// (m² sr) of light that is even over the visible 370 to 730 nm.
    #[schemars(range(min = 0.0))]
    pub scale: f32,
    /// Factor on the radiance of the sun's disk alone; 0 leaves only the sky.
    #[schemars(range(min = 0.0))]
    pub sun: f32,
    /// Angle that the sun fills, degrees, 0.05..90. A larger sun has softer shadows and is as much less bright.
    #[schemars(range(min = 0.05, max = 90.0))]
    pub sun_size: f32,
}

impl Default for SkyDesc {
    fn default() -> Self {
        Self {
            sun_direction: None,
            sun_elevation: None,
            sun_azimuth: None,
            latitude: None,
            longitude: None,
            time: None,
            turbidity: 2.0,
            ground_albedo: 0.3,
            scale: 1.0,
            sun: 1.0,
            sun_size: 0.533,
        }
    }
}

impl SkyDesc {
    /// Elevation and azimuth of a sun that nothing is said about, degrees.
    const SUN: (f32, f32) = (45.0, 135.0);

    pub(crate) fn check(&self, c: &mut Checker) {
        self.check_ways(c);
        self.check_sun(c);
        c.in_range("turbidity", self.turbidity, 1.0, 10.0);
        c.in_range("ground_albedo", self.ground_albedo, 0.0, 1.0);
        c.in_range("scale", self.scale, 0.0, 1e6);
        c.in_range("sun", self.sun, 0.0, 1e6);
        c.in_range("sun_size", self.sun_size, 0.05, 90.0);
        // The sun's irradiance outside of the air is 16 units in the brightest channel, over π α².
        let radius = 0.5 * self.sun_size.to_radians();
        if radius > 0.0 && self.scale * self.sun * 16.0 > 1e9 * std::f32::consts::PI * radius * radius {
            let hint = "make `scale` or `sun` smaller, or `sun_size` larger".to_owned();
            c.problem("scale", "the sun's disk is brighter than 1e9, too bright for a picture", Some(hint));
        }
    }

    /// Where the sun stands can be said in one way only, and must be said completely.
    fn check_ways(&self, c: &mut Checker) {
        let place = [
            ("latitude", self.latitude.is_some()),
            ("longitude", self.longitude.is_some()),
            ("time", self.time.is_some()),
        ];
        let direction = self.sun_direction.map(|_| "sun_direction");
        let angles = self.sun_elevation.map(|_| "sun_elevation").or(self.sun_azimuth.map(|_| "sun_azimuth"));
        let of_place = place.iter().find(|(_, there)| *there).map(|(key, _)| *key);
        let mut said = [direction, angles, of_place].into_iter().flatten();
        if let (Some(first), Some(second)) = (said.next(), said.next()) {
            let hint =
                "keep `sun_direction`, or `sun_elevation` and `sun_azimuth`, or `latitude`, `longitude` and `time`";
            let message = format!("`{first}` and `{second}` both say where the sun stands");
            return c.problem(second, message, Some(hint.to_owned()));
        }
        if let Some(key) = of_place {
            for (missing, _) in place.iter().filter(|(_, there)| !there) {
                let hint = format!("add `{missing}`, or give `sun_elevation` and `sun_azimuth` instead");
                c.problem(
                    key,
                    format!("`{key}` alone does not say where the sun stands: `{missing}` is missing"),
                    Some(hint),
                );
            }
        }
    }

    fn check_sun(&self, c: &mut Checker) {
        if let Some(direction) = self.sun_direction {
            c.nonzero("sun_direction", direction);
        }
        let angles = [
            ("sun_elevation", self.sun_elevation, 90.0),
            ("sun_azimuth", self.sun_azimuth, 360.0),
            ("latitude", self.latitude, 90.0),
            ("longitude", self.longitude, 180.0),
        ];
        for (key, angle, most) in angles {
            if let Some(angle) = angle {
                c.in_range(key, angle, -most, most);
            }
        }
        if let Some(Err(message)) = self.time.as_deref().map(time::days_since_j2000) {
            let hint = "write it as \"2026-06-21T12:00:00Z\" or \"2026-06-21T14:00:00+02:00\"";
            c.problem("time", format!("`time` is not a date and time: {message}"), Some(hint.to_owned()));
        }
    }

    /// The unit vector to the sun, in double precision.
    fn sun(&self) -> DVec3 {
        if let Some(direction) = self.sun_direction {
            return Vec3::from(direction).as_dvec3().normalize_or(DVec3::Y);
        }
        if let (Some(latitude), Some(longitude), Some(time)) = (self.latitude, self.longitude, &self.time) {
            let days = time::days_since_j2000(time).unwrap_or(0.0);
            return solar::direction(days, f64::from(latitude), f64::from(longitude));
        }
        let (elevation, azimuth) = Self::SUN;
        let (up, across) = solar::sin_cos_deg(f64::from(self.sun_elevation.unwrap_or(elevation)));
        let (east, north) = solar::sin_cos_deg(f64::from(self.sun_azimuth.unwrap_or(azimuth)));
        DVec3::new(across * east, up, -across * north)
    }

    /// The unit vector to the sun.
    pub fn direction_to_sun(&self) -> Vec3 {
        self.sun().as_vec3()
    }

    /// What may surprise about a correct description: that the sun has set.
    pub fn warning(&self) -> Option<String> {
        let below = -libm::asin(self.sun().y.clamp(-1.0, 1.0)).to_degrees();
        (below > 0.27).then(|| {
            let light = if below < 18.0 { "twilight" } else { "night" };
            format!(
                "the sun stands {below:.1} degrees below the horizon: it is {light}, and the sun's disk gives no light"
            )
        })
    }
}

#[cfg(test)]
mod tests;
