//! The camera as a scene states it.
//!
//! All kinds have an eye and a direction; the kind is a key, and without one the camera is perspective.
//!
//! ```toml
//! [camera]
//! look_from = [0, 1.6, 0]
//! look_at = [0, 1.6, -1]
//! [camera.fisheye]
//! fov = 180
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::camera::{BokehDesc, CameraKey, FisheyeDesc, OrthographicDesc, PanoramaDesc};
use crate::validate::Checker;

/// Where the eye is, where it looks, and through what: a perspective lens, or `[camera.KIND]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraDesc {
    /// The eye, metres.
    #[serde(deserialize_with = "array")]
    pub look_from: [f32; 3],
    /// A point in the middle of the picture, metres.
    #[serde(deserialize_with = "array")]
    pub look_at: [f32; 3],
    /// What is upwards in the picture.
    #[serde(deserialize_with = "array")]
    pub up: [f32; 3],
    /// Vertical field of view of a perspective camera, degrees, 0..180; 40 if absent.
    #[schemars(range(min = 0.001, max = 179.0))]
    pub vfov: Option<f32>,
    /// Diameter of a perspective camera's lens, metres; 0 is a pinhole, with which everything is sharp.
    #[schemars(range(min = 0.0))]
    pub aperture: Option<f32>,
    /// The lens as the angle of the cone of rays that meet in a point in focus, degrees; instead of `aperture`.
    #[schemars(range(min = 0.0, max = 179.0))]
    pub defocus_angle: Option<f32>,
    /// Distance from the eye to the plane in focus, metres; that of `look_at` if absent.
    pub focus_distance: Option<f32>,
    /// Shape of the lens's aperture, which highlights out of focus show; a disk if absent.
    pub bokeh: Option<BokehDesc>,
    /// Parallel rays instead of perspective: sizes do not shrink with distance.
    pub orthographic: Option<OrthographicDesc>,
    /// All directions in one picture instead of perspective, equirectangular.
    pub panorama: Option<PanoramaDesc>,
    /// A circle of directions instead of perspective.
    pub fisheye: Option<FisheyeDesc>,
    /// Where it is at some times; it rests if absent.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<CameraKey>,
}

impl Default for CameraDesc {
    fn default() -> Self {
        Self {
            look_from: [0.0, 1.0, 6.0],
            look_at: [0.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            vfov: None,
            aperture: None,
            defocus_angle: None,
            focus_distance: None,
            bokeh: None,
            orthographic: None,
            panorama: None,
            fisheye: None,
            motion: Vec::new(),
        }
    }
}

impl CameraDesc {
    /// Vertical field of view of a perspective camera that states none, degrees.
    pub const DEFAULT_VFOV: f32 = 40.0;

    /// From the eye to the plane in focus, metres.
    pub(super) fn focus(&self) -> f32 {
        let [from, at] = [self.look_from, self.look_at].map(|p| Vec3::from(p).as_dvec3());
        self.focus_distance.unwrap_or(at.distance(from) as f32)
    }

    pub(crate) fn check(&self, c: &mut Checker) {
        Self::check_pose(self.look_from, self.look_at, self.up, c);
        self.check_motion(c);
        if let Some(vfov) = self.vfov {
            c.in_range("vfov", vfov, 0.001, 179.0);
        }
        self.check_lens(c);
        if let Some(bokeh) = &self.bokeh {
            c.within("bokeh", |c| bokeh.check(c));
        }
        if let Some(orthographic) = &self.orthographic {
            c.within("orthographic", |c| orthographic.check(c));
        }
        if let Some(fisheye) = &self.fisheye {
            c.within("fisheye", |c| fisheye.check(c));
        }
        self.check_kind(c);
    }

    pub(super) fn check_pose(look_from: [f32; 3], look_at: [f32; 3], up: [f32; 3], c: &mut Checker) {
        c.line_of_sight("look_from", look_from, look_at, "the camera looks");
        c.up(up, look_from, look_at);
    }

    fn check_lens(&self, c: &mut Checker) {
        /// So wide is a lens in focus distances with the widest `defocus_angle`.
        const WIDEST: f32 = 230.0;
        if let Some(aperture) = self.aperture.filter(|&a| a != 0.0) {
            c.positive("aperture", aperture);
            if aperture > WIDEST * self.focus() {
                c.problem(
                    "aperture",
                    format!("the lens is more than {WIDEST} times as wide as the plane in focus is far"),
                    Some("use a smaller `aperture` or a larger `focus_distance`, both in metres".to_owned()),
                );
            }
        }
        if let Some(angle) = self.defocus_angle {
            c.in_range("defocus_angle", angle, 0.0, 179.0);
        }
        if self.aperture.is_some() && self.defocus_angle.is_some() {
            c.problem(
                "defocus_angle",
                "`aperture` and `defocus_angle` both say how wide the lens is",
                Some("keep one of them".to_owned()),
            );
        }
        if let Some(distance) = self.focus_distance {
            c.positive("focus_distance", distance);
        }
    }

    /// One kind at most, and what is said of a perspective lens only without one.
    fn check_kind(&self, c: &mut Checker) {
        let kinds = [
            ("orthographic", self.orthographic.is_some()),
            ("panorama", self.panorama.is_some()),
            ("fisheye", self.fisheye.is_some()),
        ];
        let mut said = kinds.into_iter().filter_map(|(kind, said)| said.then_some(kind));
        let Some(kind) = said.next() else {
            if self.bokeh.is_some() && self.aperture.is_none() && self.defocus_angle.is_none() {
                c.problem(
                    "bokeh",
                    "everything is sharp with a pinhole, so nothing shows the `bokeh`",
                    Some("give the camera a lens, such as aperture = 0.1".to_owned()),
                );
            }
            return;
        };
        for other in said {
            let message = format!("a camera is of one kind, and this one is `{kind}` already");
            c.problem(other, message, Some(format!("keep `{kind}` or `{other}`")));
        }
        let perspective = [
            ("vfov", self.vfov.is_some()),
            ("aperture", self.aperture.is_some()),
            ("defocus_angle", self.defocus_angle.is_some()),
            ("focus_distance", self.focus_distance.is_some()),
            ("bokeh", self.bokeh.is_some()),
        ];
        for (key, _) in perspective.into_iter().filter(|(_, said)| *said) {
            let hint = match (key, kind) {
                ("vfov", "orthographic") => "take it out; `height` in `orthographic` says how much is seen".to_owned(),
                ("vfov", "fisheye") => "take it out; `fov` in `fisheye` says how much is seen".to_owned(),
                _ => format!("take it out, or `{kind}`"),
            };
            c.problem(key, format!("`{key}` is of a perspective camera, and this one is `{kind}`"), Some(hint));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::FisheyeProjection;

    /// Keys of all problems.
    fn problems(desc: &CameraDesc) -> Vec<String> {
        let mut c = Checker::default();
        desc.check(&mut c);
        let problems = c.into_problems();
        assert!(problems.iter().all(|p| p.hint.is_some()), "{problems:?}");
        problems.iter().map(|p| p.path.join(".")).collect()
    }

    fn desc() -> CameraDesc {
        CameraDesc::default()
    }

    #[test]
    fn kinds_are_taken() {
        let bokeh = Some(BokehDesc { blades: 3, rotation: -1e6, ratio: 0.01 });
        let fisheye = Some(FisheyeDesc { fov: 360.0, projection: FisheyeProjection::Equisolid });
        for good in [
            desc(),
            CameraDesc { vfov: Some(179.0), aperture: Some(0.0), ..desc() },
            CameraDesc { aperture: Some(0.1), bokeh: bokeh.clone(), ..desc() },
            CameraDesc { defocus_angle: Some(1.0), bokeh, ..desc() },
            CameraDesc { orthographic: Some(OrthographicDesc::default()), ..desc() },
            CameraDesc { panorama: Some(PanoramaDesc {}), ..desc() },
            CameraDesc { fisheye, ..desc() },
        ] {
            assert_eq!(problems(&good), [""; 0], "{good:?}");
        }
    }

    #[test]
    fn numbers_have_ranges() {
        for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            let orthographic = Some(OrthographicDesc { height: bad });
            assert_eq!(problems(&CameraDesc { orthographic, ..desc() }), ["orthographic.height"]);
            let fisheye = Some(FisheyeDesc { fov: bad, ..FisheyeDesc::default() });
            assert_eq!(problems(&CameraDesc { fisheye, ..desc() }), ["fisheye.fov"]);
            assert_eq!(problems(&CameraDesc { vfov: Some(bad), ..desc() }), ["vfov"]);
            let bokeh = Some(BokehDesc { ratio: bad, ..BokehDesc::default() });
            assert_eq!(problems(&CameraDesc { aperture: Some(0.1), bokeh, ..desc() }), ["bokeh.ratio"]);
        }
        let fisheye = Some(FisheyeDesc { fov: 360.5, ..FisheyeDesc::default() });
        assert_eq!(problems(&CameraDesc { fisheye, ..desc() }), ["fisheye.fov"]);
        for blades in [1, 2, 101, u32::MAX] {
            let bokeh = Some(BokehDesc { blades, rotation: f32::NAN, ratio: 1.0 });
            let said = problems(&CameraDesc { aperture: Some(0.1), bokeh, ..desc() });
            assert_eq!(said, ["bokeh.blades", "bokeh.rotation"]);
        }
        let wide = CameraDesc { aperture: Some(1.0), focus_distance: Some(1e-3), ..desc() };
        assert_eq!(problems(&wide), ["aperture"]);
    }

    #[test]
    fn what_does_not_go_together() {
        let bokeh = Some(BokehDesc { blades: 6, ..BokehDesc::default() });
        assert_eq!(problems(&CameraDesc { bokeh: bokeh.clone(), ..desc() }), ["bokeh"], "a pinhole");
        let lens = CameraDesc { vfov: Some(30.0), aperture: Some(0.1), focus_distance: Some(3.0), bokeh, ..desc() };
        let keys = ["vfov", "aperture", "focus_distance", "bokeh"];
        assert_eq!(problems(&CameraDesc { panorama: Some(PanoramaDesc {}), ..lens.clone() }), keys);
        assert_eq!(problems(&CameraDesc { fisheye: Some(FisheyeDesc::default()), ..lens.clone() }), keys);
        assert_eq!(problems(&CameraDesc { orthographic: Some(OrthographicDesc::default()), ..lens }), keys);
        let two = CameraDesc { panorama: Some(PanoramaDesc {}), fisheye: Some(FisheyeDesc::default()), ..desc() };
        assert_eq!(problems(&two), ["fisheye"]);
    }

    #[test]
    fn poses_that_look_nowhere() {
        assert_eq!(problems(&CameraDesc { look_from: [1.0; 3], look_at: [1.0; 3], ..desc() }), ["look_at"]);
        let panorama = Some(PanoramaDesc {});
        let along = CameraDesc { look_from: [0.0; 3], look_at: [0.0, -3.0, 0.0], panorama, ..desc() };
        assert_eq!(problems(&along), ["up"]);
        assert_eq!(problems(&CameraDesc { look_from: [0.0, f32::NAN, 0.0], ..desc() }), ["look_from"]);
    }
}
