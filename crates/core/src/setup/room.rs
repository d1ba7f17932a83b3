//! Rooms: scenes whose outermost surfaces look inwards.
//!
//! A wall is a side of the box around everything that is covered, to a good part, by surfaces that face the middle. A floor and two
//! walls are a room. If a side is open, the eye looks in from there, as into a doll's house; if none is, it stands in a corner, where
//! it sees most.
//!
//! Walls that are thick have an outside, too, which may be what is to be seen: of a house, a crate, the housing of a machine. So the eye
//! stands inside of them only if lamps are in there, and what is open is shown like anything else, but from an open side. Walls without
//! an outside around nothing are a thing that is turned inside out, as many files have them.

use std::f32::consts::FRAC_1_SQRT_2;

use glam::Vec3;

use crate::camera::CameraDesc;
use crate::setup::extent::{Extent, Faces};
use crate::setup::eye;

/// Outwards through the sides of a box.
const SIDES: [Vec3; 6] = [Vec3::NEG_X, Vec3::X, Vec3::NEG_Y, Vec3::Y, Vec3::NEG_Z, Vec3::Z];
const FLOOR: usize = 2;
const CEILING: usize = 3;
const WALLS: [usize; 4] = [0, 1, 4, 5];

/// Which sides of a box are walls, the floor or the ceiling of a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Room {
    is_wall: [bool; 6],
    /// Whether walls have an outside.
    is_thick: bool,
}

impl Room {
    /// None if what there is, is seen from outside; `is_lit` tells of lamps.
    pub(super) fn find(faces: &impl Faces, extent: &Extent, is_lit: bool) -> Option<Self> {
        /// So near to a side, in lengths of the box across it, is what belongs to it.
        const NEAR: f32 = 0.08;
        /// The least part of a side that a wall with its doors and windows covers.
        const COVERED: f32 = 0.4;
        /// How much of the outside of a thin wall there may be for each part of its inside.
        const OUTSIDE: f32 = 0.5;
        let size = extent.max - extent.min;
        /// The least of what stands in a room, for each part of its floor.
        const FURNISHED: f32 = 0.02;
        let (mut inwards, mut outwards, mut within) = ([0.0; 6], [0.0; 6], 0.0);
        for [a, b, c] in faces.clone() {
            let area = 0.5 * (b - a).cross(c - a);
            let middle = (a + b + c) / 3.0;
            let mut is_within = true;
            for (side, out) in SIDES.iter().enumerate() {
                let depth = (extent.side(side) - middle.dot(*out)) / size.dot(out.abs());
                let facing = area.dot(*out);
                is_within &= depth > NEAR;
                if depth.abs() < NEAR && facing.abs() > FRAC_1_SQRT_2 * area.length() {
                    if facing < 0.0 { inwards[side] -= facing } else { outwards[side] += facing }
                }
            }
            within += if is_within { area.length() } else { 0.0 };
        }
        let whole = |side: usize| {
            let across = size - size * SIDES[side].abs();
            across.x * across.y + across.y * across.z + across.z * across.x
        };
        let of = |is_thick: bool| {
            let is_wall = [0, 1, 2, 3, 4, 5]
                .map(|i| inwards[i] > COVERED * whole(i) && (is_thick || outwards[i] < OUTSIDE * inwards[i]));
            let walls = WALLS.iter().filter(|&&side| is_wall[side]).count();
            (is_wall[FLOOR] && walls >= 2).then_some(Self { is_wall, is_thick })
        };
        let has_inside = is_lit || within > FURNISHED * whole(FLOOR);
        let thin = of(false).filter(|room| !room.is_closed() || has_inside);
        thin.or_else(|| of(true).filter(|room| if room.is_closed() { is_lit } else { room.open() != Vec3::ZERO }))
    }

    /// Whether light can come in from nowhere.
    pub(super) fn is_closed(&self) -> bool {
        self.is_wall.iter().all(|&is_wall| is_wall)
    }

    /// Whether it stands on something, as other things do.
    pub(super) fn stands(&self) -> bool {
        self.is_thick && !self.is_closed()
    }

    /// Outwards through the open sides.
    fn open(&self) -> Vec3 {
        WALLS.iter().filter(|&&side| !self.is_wall[side]).map(|&side| SIDES[side]).sum()
    }

    /// Where the eye is put, for pictures so many times as wide as high; `points` and `faces` are those of everything.
    pub(super) fn eye(&self, points: &[Vec3], faces: &impl Faces, extent: &Extent, aspect: f32) -> CameraDesc {
        let (open, has_ceiling) = (self.open(), self.is_wall[CEILING]);
        if self.stands() {
            let front = eye::in_front(points, faces, extent, aspect);
            let back = Vec3::from(front.look_from) - Vec3::from(front.look_at);
            // It is open to several sides, or to one, which is seen from a little aside.
            let aside = 0.4 * open.cross(Vec3::Y);
            return if back.dot(open) > 0.0 {
                front
            } else {
                eye::from_side(points, extent, aspect, (open + aside).normalize() + 0.4 * Vec3::Y)
            };
        }
        if open != Vec3::ZERO {
            let up = if has_ceiling { 0.05 } else { 0.5 };
            return eye::from_side(points, extent, aspect, (open.normalize() + up * Vec3::Y).normalize());
        }
        if has_ceiling {
            corner(faces, extent)
        } else {
            eye::from_side(points, extent, aspect, Vec3::new(0.4, 1.0, 0.6))
        }
    }
}

/// An eye in the corner from which most is seen.
fn corner(faces: &impl Faces, extent: &Extent) -> CameraDesc {
    /// Vertical angle of view, degrees: that of a wide lens.
    const VFOV: f32 = 58.0;
    /// From the middle to the walls, of their distance.
    const AWAY: f32 = 0.84;
    let half = 0.5 * (extent.max - extent.min);
    let standing = |[x, z]: [f32; 2]| {
        let from = extent.center() + half * Vec3::new(AWAY * x, 0.05, AWAY * z);
        let at = extent.center() + half * Vec3::new(-0.6 * x, -0.25, -0.6 * z);
        (seen(faces, from, at), from, at)
    };
    let corners = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].map(standing);
    let best = corners.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a });
    let (_, from, at) = best.unwrap_or_default();
    CameraDesc { look_from: from.into(), look_at: at.into(), vfov: Some(VFOV), ..CameraDesc::default() }
}

/// How far rays from an eye get, in the mean; those that meet the back of something count as none.
fn seen(faces: &impl Faces, from: Vec3, at: Vec3) -> f32 {
    /// Of the directions beside the middle one.
    const SPREAD: f32 = 0.35;
    let ahead = (at - from).normalize();
    let right = ahead.cross(Vec3::Y).normalize();
    let up = right.cross(ahead);
    let across = [-SPREAD, 0.0, SPREAD];
    let directions = across.iter().flat_map(|&x| across.iter().map(move |&y| ahead + x * right + y * up));
    directions.map(|d| clear(faces, from, d).max(0.0)).sum()
}

/// How far a ray gets, in lengths of its direction; less than nothing if it meets the back of something (Möller & Trumbore 1997,
/// doi:10.1080/10867651.1997.10487468).
fn clear(faces: &impl Faces, o: Vec3, d: Vec3) -> f32 {
    let mut nearest = (f32::INFINITY, false);
    for [a, b, c] in faces.clone() {
        let [e1, e2] = [b - a, c - a];
        let p = d.cross(e2);
        let det = e1.dot(p);
        let s = o - a;
        let (u, q) = (s.dot(p) / det, s.cross(e1));
        let (v, t) = (d.dot(q) / det, e2.dot(q) / det);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest.0 {
            nearest = (t, det > 0.0);
        }
    }
    match nearest {
        (t, true) => t,
        (_, false) => -1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::desc::SceneDesc;
    use crate::setup::extent::{faces, points};
    use crate::shape::QuadDesc;

    /// Sides of a box, as quads that look inwards or outwards.
    fn boxed(sides: &[usize], inwards: bool, size: Vec3) -> SceneDesc {
        let mut desc = SceneDesc::default();
        for &side in sides {
            let out = SIDES[side];
            let u = Vec3::new(out.y.abs(), out.z.abs(), out.x.abs());
            let v = (if inwards { -out } else { out }).cross(u);
            let corner = 0.5 * (out - u - v) * size;
            let [corner, u, v] = [corner, u * size, v * size].map(Into::into);
            desc.shape.quad.push(QuadDesc { corner, u, v, ..QuadDesc::default() });
        }
        desc
    }

    fn room(desc: &SceneDesc) -> Option<Room> {
        Room::find(&faces(desc), &Extent::of(&points(desc)).unwrap(), false)
    }

    #[test]
    fn what_looks_inwards_is_a_room() {
        let size = Vec3::new(5.0, 2.5, 4.0);
        let mut closed = boxed(&[0, 1, 2, 3, 4, 5], true, size);
        assert_eq!(room(&closed), None, "a box inside out");
        closed.shape.quad.extend(boxed(&[0, 1, 2, 3, 4, 5], false, 0.2 * size).shape.quad);
        assert!(room(&closed).unwrap().is_closed());
        assert!(!room(&boxed(&[0, 1, 2, 3, 4], true, size)).unwrap().is_closed());
        assert_eq!(room(&boxed(&[0, 1, 2, 3, 4, 5], false, size)), None);
        // A tray, a terrain.
        assert_eq!(room(&boxed(&[1, 2], true, size)), None);
        assert_eq!(room(&boxed(&[2], true, size)), None);
    }

    /// With an outside, such as a house.
    fn thick(sides: &[usize], size: Vec3) -> SceneDesc {
        let mut house = boxed(sides, true, size);
        house.shape.quad.extend(boxed(sides, false, 1.05 * size).shape.quad);
        house
    }

    #[test]
    fn thick_walls_are_a_room_if_lamps_are_inside() {
        let size = Vec3::new(5.0, 2.5, 4.0);
        let house = thick(&[0, 1, 2, 3, 4, 5], size);
        assert_eq!(room(&house), None);
        let (points, faces) = (points(&house), faces(&house));
        let extent = Extent::of(&points).unwrap();
        let lit = Room::find(&faces, &extent, true).unwrap();
        assert!(lit.is_closed() && !lit.stands());
        let from = Vec3::from(lit.eye(&points, &faces, &extent, 1.5).look_from);
        assert!(from.abs().cmplt(0.5 * size).all(), "{from}");
        // A crate without a lid is seen as it is.
        assert_eq!(room(&thick(&[0, 1, 2, 4, 5], size)), None);
    }

    #[test]
    fn thick_walls_are_seen_from_their_open_side() {
        let size = Vec3::new(5.0, 2.5, 4.0);
        for open in WALLS {
            let sides: Vec<_> = (0..6).filter(|&side| side != open).collect();
            let shelf = thick(&sides, size);
            let (points, faces) = (points(&shelf), faces(&shelf));
            let extent = Extent::of(&points).unwrap();
            let room = Room::find(&faces, &extent, false).unwrap();
            let camera = room.eye(&points, &faces, &extent, 1.5);
            let back = (Vec3::from(camera.look_from) - Vec3::from(camera.look_at)).normalize();
            assert!(room.stands() && back.dot(SIDES[open]) > 0.2 && back.y > 0.1, "side {open}: {back}");
        }
    }

    #[test]
    fn the_eye_looks_through_the_open_side_or_stands_inside() {
        let size = Vec3::new(5.0, 2.5, 4.0);
        let eye = |desc: &SceneDesc| {
            let (points, faces) = (points(desc), faces(desc));
            let extent = Extent::of(&points).unwrap();
            let room = Room::find(&faces, &extent, false).unwrap();
            let camera = room.eye(&points, &faces, &extent, 1.5);
            (Vec3::from(camera.look_from), Vec3::from(camera.look_at), extent)
        };
        for open in WALLS {
            let sides: Vec<_> = (0..6).filter(|&side| side != open).collect();
            let (from, at, extent) = eye(&boxed(&sides, true, size));
            let ahead = (at - from).normalize();
            assert!(ahead.dot(SIDES[open]) < -0.99 && !extent.holds(from), "side {open}: {from} to {at}");
        }
        // Behind a cupboard in a corner nothing is seen.
        let mut furnished = boxed(&[0, 1, 2, 3, 4, 5], true, size);
        let mut cupboard = boxed(&[0, 1, 2, 3, 4, 5], false, Vec3::splat(1.0));
        for quad in &mut cupboard.shape.quad {
            quad.corner = (Vec3::from(quad.corner) + Vec3::new(2.0, 0.0, 1.5)).into();
        }
        furnished.shape.quad.extend(cupboard.shape.quad);
        let (from, _, extent) = eye(&furnished);
        assert!(extent.holds(from) && !(from.x > 0.0 && from.z > 0.0), "{from}");
    }
}
