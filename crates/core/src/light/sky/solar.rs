//! Where the sun stands at a place and a time.
//!
//! The sun's apparent ecliptic longitude λ from its mean longitude and the equation of the centre, good to 0.01° for
//! some centuries around 2000; from there by rotations: about the equinox by the obliquity ε to the equator, about the
//! pole by the sidereal time θ to the meridian, about the east by the latitude to the horizon. Meeus, Astronomical
//! Algorithms, 2nd edition 1998, chapters 12, 13, 22 and 25 (low accuracy). Refraction, which lifts the sun by half a
//! degree at the horizon, and parallax are left out.

use glam::DVec3;

/// The unit direction to the sun, +X east, +Y up, -Z north.
///
/// `days` of universal time since J2000.0; `latitude` (north) and `longitude` (east) in degrees.
pub(super) fn direction(days: f64, latitude: f64, longitude: f64) -> DVec3 {
    let (sun, sidereal) = equatorial(days);
    let (sin, cos) = sin_cos_deg(sidereal + longitude);
    let (to_meridian, east) = (cos * sun.x + sin * sun.y, cos * sun.y - sin * sun.x);
    let (sin, cos) = sin_cos_deg(latitude);
    let (up, north) = (cos * to_meridian + sin * sun.z, cos * sun.z - sin * to_meridian);
    DVec3::new(east, up, -north).normalize()
}

/// The sun among the stars, x to the equinox and z to the pole, and Greenwich's apparent sidereal time in degrees.
fn equatorial(days: f64) -> (DVec3, f64) {
    let t = days / 36_525.0;
    let mean_longitude = 280.466_46 + t * (36_000.769_83 + t * 0.000_303_2);
    let anomaly = 357.529_11 + t * (35_999.050_29 - t * 0.000_153_7);
    let center = (1.914_602 - t * (0.004_817 + t * 0.000_014)) * sin_deg(anomaly)
        + (0.019_993 - t * 0.000_101) * sin_deg(2.0 * anomaly)
        + 0.000_289 * sin_deg(3.0 * anomaly);
    // Aberration and nutation; the latter follows the moon's ascending node.
    let (sin_node, cos_node) = sin_cos_deg(125.04 - 1934.136 * t);
    let nutation = -0.004_78 * sin_node;
    let (sin_lambda, cos_lambda) = sin_cos_deg(mean_longitude + center - 0.005_69 + nutation);
    let (sin_eps, cos_eps) = sin_cos_deg(23.439_291 - 0.013_004_2 * t + 0.002_56 * cos_node);
    let sidereal = 280.460_618_37 + 360.985_647_366_29 * days + t * t * 0.000_387_933 + nutation * cos_eps;
    (DVec3::new(cos_lambda, cos_eps * sin_lambda, sin_eps * sin_lambda), sidereal)
}

pub(super) fn sin_cos_deg(degrees: f64) -> (f64, f64) {
    let radians = degrees.rem_euclid(360.0).to_radians();
    (libm::sin(radians), libm::cos(radians))
}

fn sin_deg(degrees: f64) -> f64 {
    sin_cos_deg(degrees).0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::sky::time::days_since_j2000;

    /// Degrees above the horizon, and degrees from north to east.
    fn elevation_azimuth(time: &str, latitude: f64, longitude: f64) -> (f64, f64) {
        let sun = direction(days_since_j2000(time).unwrap(), latitude, longitude);
        (sun.y.asin().to_degrees(), sun.x.atan2(-sun.z).to_degrees().rem_euclid(360.0))
    }

    #[test]
    fn apparent_place_of_meeus() {
        // Example 25.a: 13 October 1992, 0 h TD (59 s ahead of UT): right ascension 198.38083°, declination -7.78507°.
        let (sun, _) = equatorial(days_since_j2000("1992-10-12T23:59:01Z").unwrap());
        assert!((sun.y.atan2(sun.x).to_degrees().rem_euclid(360.0) - 198.380_83).abs() < 2e-3);
        assert!((sun.z.asin().to_degrees() + 7.785_07).abs() < 2e-3);
        // Example 12.a: 10 April 1987, 0 h UT: apparent sidereal time 13 h 10 m 46.1351 s.
        let (_, sidereal) = equatorial(days_since_j2000("1987-04-10T00:00:00Z").unwrap());
        let expected = (13.0 + 10.0 / 60.0 + 46.1351 / 3600.0) * 15.0;
        assert!((sidereal.rem_euclid(360.0) - expected).abs() < 1e-3, "{}", sidereal.rem_euclid(360.0));
    }

    #[test]
    fn case_of_the_solar_position_algorithm() {
        // Reda & Andreas 2004, doi:10.1016/j.solener.2003.12.003, table A5.1: zenith 50.11162° with refraction of
        // 0.016°.
        let (elevation, azimuth) = elevation_azimuth("2003-10-17T12:30:30-07:00", 39.742_476, -105.178_6);
        assert!((elevation - 39.872).abs() < 0.01, "{elevation}");
        assert!((azimuth - 194.340_24).abs() < 0.01, "{azimuth}");
    }

    #[test]
    fn seasons() {
        // Equinox of March 2026, 20th 14:46 UTC: over the equator where it is noon, 2 h 46 min west of Greenwich, less
        // the equation of time, 7.4 minutes.
        let (elevation, _) = elevation_azimuth("2026-03-20T14:46:00Z", 0.0, -41.5 + 1.85);
        assert!(elevation > 89.9, "{elevation}");
        // Solstices of 2026: over the tropics at 23.436°, and due south from London at 90° - 51.48° ± 23.436°.
        for (time, highest) in [("2026-06-21T12:01:50Z", 61.96), ("2026-12-21T11:58:00Z", 15.08)] {
            let (elevation, azimuth) = elevation_azimuth(time, 51.48, 0.0);
            assert!((elevation - highest).abs() < 0.02, "{time}: {elevation}");
            assert!((azimuth - 180.0).abs() < 0.3, "{time}: {azimuth}");
        }
        // At the pole the elevation is the declination, all day long.
        for hour in ["00", "06", "12", "18"] {
            let (elevation, _) = elevation_azimuth(&format!("2026-06-21T{hour}:00:00Z"), 90.0, 0.0);
            assert!((elevation - 23.436).abs() < 0.005, "{elevation}");
        }
    }

    #[test]
    fn rises_in_the_east_and_sets_in_the_west() {
        assert!((elevation_azimuth("2026-03-20T06:07:00Z", 40.0, 0.0).1 - 90.0).abs() < 1.0);
        assert!((elevation_azimuth("2026-03-20T18:07:00Z", 40.0, 0.0).1 - 270.0).abs() < 1.0);
        // Noon in Sydney: the sun is in the north.
        let (_, azimuth) = elevation_azimuth("2026-06-21T12:00:00+10:00", -33.87, 151.2);
        assert!(!(5.0..=355.0).contains(&azimuth), "{azimuth}");
    }
}
