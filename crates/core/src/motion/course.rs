//! From keys to the straight pieces that rays know.

use eyebeam_bvh::{Affine, Instance};
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec3};

use crate::math::sin_cos_turns;
use crate::motion::{MotionDesc, MotionKey};

/// The way of a shape, in double precision.
pub(crate) struct Course {
    pivot: DVec3,
    /// From key to key; one leg that rests if there is one key, none without.
    legs: Vec<Leg>,
}

/// The way from one key to the next.
struct Leg {
    time: [f64; 2],
    offset: [DVec3; 2],
    scale: [f64; 2],
    /// How it is turned in the beginning.
    from: DQuat,
    /// About what it turns from there on, and how often.
    axis: DVec3,
    turns: f64,
}

/// The turn about a unit axis.
fn turn(axis: DVec3, turns: f64) -> DQuat {
    let half = 0.5 * turns;
    let (sin, cos) = sin_cos_turns((half - half.round()) as f32);
    let v = axis * f64::from(sin);
    DQuat::from_xyzw(v.x, v.y, v.z, cos.into()).normalize()
}

/// Axis and turns of a key, if it says any.
fn rotation(key: &MotionKey) -> Option<(DVec3, f64)> {
    let rotation = key.rotation.as_ref()?;
    let axis = Vec3::from(rotation.axis).as_dvec3().normalize_or(DVec3::Y);
    Some((axis, f64::from(rotation.angle) / 360.0))
}

impl Leg {
    fn new(a: &MotionKey, b: &MotionKey) -> Self {
        let either = rotation(a).or(rotation(b)).map_or(DVec3::Y, |(axis, _)| axis);
        let [(axis, from), (other, to)] = [a, b].map(|key| rotation(key).unwrap_or((either, 0.0)));
        /// So parallel are axes that are the same but for rounding.
        const SAME: f64 = 1e-6;
        let start = turn(axis, from);
        let (axis, turns) = if axis.cross(other).length() < SAME {
            (axis, to * 1.0_f64.copysign(axis.dot(other)) - from)
        } else {
            shortest(start, turn(other, to))
        };
        Self {
            time: [a, b].map(|key| key.time.into()),
            offset: [a, b].map(|key| Vec3::from(key.offset).as_dvec3()),
            scale: [a, b].map(|key| key.scale.into()),
            from: start,
            axis,
            turns,
        }
    }

    /// The part of a leg while the shutter is open.
    fn open(&self, shutter: [f32; 2]) -> [f64; 2] {
        let [open, close] = shutter.map(f64::from);
        [self.time[0].max(open), self.time[1].min(close)]
    }

    /// Straight pieces of that part.
    fn pieces(&self, shutter: [f32; 2]) -> f64 {
        /// Of at most 5 degrees.
        const PIECES_PER_TURN: f64 = 72.0;
        let [start, end] = self.open(shutter);
        if start >= end {
            return 0.0;
        }
        let share = (end - start) / (self.time[1] - self.time[0]);
        (PIECES_PER_TURN * share * self.turns.abs()).ceil().max(1.0)
    }

    fn at(&self, time: f32, pivot: DVec3) -> Affine {
        let [start, end] = self.time;
        let share = if start < end { ((f64::from(time) - start) / (end - start)).clamp(0.0, 1.0) } else { 0.0 };
        let [from, to] = self.scale;
        let turned = turn(self.axis, share * self.turns) * self.from;
        let matrix = DMat3::from_quat(turned) * (from + (to - from) * share);
        let offset = pivot + self.offset[0] + (self.offset[1] - self.offset[0]) * share - matrix * pivot;
        Affine { axes: [0, 1, 2].map(|i| matrix.col(i).as_vec3()), offset: offset.as_vec3() }
    }
}

/// Axis and turns of the shortest way from one orientation to another.
fn shortest(from: DQuat, to: DQuat) -> (DVec3, f64) {
    let way = to * from.conjugate();
    let way = if way.w < 0.0 { -way } else { way };
    let v = DVec3::new(way.x, way.y, way.z);
    let turns = libm::atan2(v.length(), way.w) / std::f64::consts::PI;
    (v.normalize_or(DVec3::Y), turns)
}

impl Course {
    /// Turns and grows about the shape's own origin if it says no pivot.
    pub(crate) fn new(desc: &MotionDesc<'_>, origin: Vec3) -> Self {
        let legs = match desc.keys {
            [only] => vec![Leg::new(only, only)],
            keys => keys.windows(2).filter_map(|pair| Some(Leg::new(pair.first()?, pair.last()?))).collect(),
        };
        Self { pivot: desc.pivot.map_or(origin, Vec3::from).as_dvec3(), legs }
    }

    /// The number of straight pieces while the shutter is open.
    pub(crate) fn pieces(&self, shutter: [f32; 2]) -> f64 {
        self.legs.iter().map(|leg| leg.pieces(shutter)).sum()
    }

    fn at(&self, time: f32) -> Affine {
        let next = self.legs.partition_point(|leg| leg.time[0] <= f64::from(time));
        self.legs.get(next.saturating_sub(1)).map_or(Affine::IDENTITY, |leg| leg.at(time, self.pivot))
    }

    /// When pieces begin and end, each later than the one before.
    fn times(&self, shutter: [f32; 2]) -> Vec<f32> {
        let [mut last, close] = shutter;
        let mut times = vec![last];
        for leg in &self.legs {
            let ([start, end], count) = (leg.open(shutter), leg.pieces(shutter));
            for i in 0..=count as u32 {
                let time = (start + (end - start) * (f64::from(i) / count)) as f32;
                if last < time && time < close {
                    times.push(time);
                    last = time;
                }
            }
        }
        times.extend((last < close).then_some(close));
        times
    }

    /// The motion of an object while the shutter is open; none if that rests where it is.
    pub(crate) fn motion(&self, shutter: [f32; 2], object: u32) -> Option<Motion> {
        let at: Vec<_> = self.times(shutter).into_iter().map(|time| (time, self.at(time))).collect();
        let &(_, first) = at.first()?;
        if at.iter().all(|&(_, at)| at == first) {
            return (first != Affine::IDENTITY).then(|| Motion { pieces: vec![Instance::new(object, first)] });
        }
        let pieces = at.iter().zip(at.iter().skip(1));
        let piece = |(a, b): (&(f32, Affine), &(f32, Affine))| Instance { object, at: [a.1, b.1], time: [a.0, b.0] };
        Some(Motion { pieces: pieces.map(piece).collect() })
    }
}

/// Where an object of a scene is while the shutter is open.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// Each from where and when the one before it ends.
    pieces: Vec<Instance>,
}

impl Motion {
    /// What rays meet.
    pub(crate) fn pieces(&self) -> &[Instance] {
        &self.pieces
    }

    /// Whether it is not at the same place all the time.
    pub(crate) fn is_moving(&self) -> bool {
        self.pieces.iter().any(|piece| piece.at[0] != piece.at[1])
    }

    /// From the space of the object to the world.
    pub(crate) fn to_world(&self, time: f32) -> DAffine3 {
        let piece = self.pieces.partition_point(|piece| piece.time[1] < time);
        self.pieces.get(piece).and_then(|piece| piece.to_world(time)).unwrap_or(DAffine3::IDENTITY)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Rotation;

    fn key(time: f32, offset: [f32; 3], axis: [f32; 3], angle: f32, scale: f32) -> MotionKey {
        MotionKey { time, offset, rotation: Some(Rotation { axis, angle }), scale }
    }

    fn course(keys: &[MotionKey], pivot: [f32; 3]) -> Course {
        Course::new(&MotionDesc { keys, pivot: Some(pivot) }, Vec3::ZERO)
    }

    fn near(a: DVec3, b: [f64; 3]) {
        assert!((a - DVec3::from(b)).length() < 2e-6, "{a}, not {b:?}");
    }

    const Z: [f32; 3] = [0.0, 0.0, 3.0];

    /// Turned about the pivot, grown from it, then moved.
    #[test]
    fn a_key_turns_grows_and_moves() {
        let keys = [key(0.0, [0.0, 0.0, 5.0], Z, 90.0, 2.0)];
        let motion = course(&keys, [1.0, 0.0, 0.0]).motion([0.0, 1.0], 3).unwrap();
        assert!(!motion.is_moving() && motion.pieces().len() == 1 && motion.pieces()[0].object == 3);
        for time in [-3.0, 0.0, 0.4, 9.0] {
            near(motion.to_world(time).transform_point3(DVec3::new(2.0, 0.0, 0.0)), [1.0, 2.0, 5.0]);
        }
    }

    /// Pieces follow each other in time and place, and are small; points keep their distance from the pivot.
    #[test]
    fn turns_are_cut_into_pieces() {
        let keys = [key(0.0, [0.0; 3], Z, 0.0, 1.0), key(2.0, [0.0; 3], Z, 720.0, 1.0)];
        let course = course(&keys, [0.0; 3]);
        for (shutter, pieces) in [([0.0, 2.0], 144), ([0.5, 1.0], 36), ([0.0, 0.01], 1), ([1.0, 9.0], 72)] {
            let motion = course.motion(shutter, 0).unwrap();
            // What rests after the last key is a piece, too.
            let rests = usize::from(shutter[1] > 2.0);
            assert_eq!((motion.pieces().len(), course.pieces(shutter)), (pieces + rests, pieces as f64), "{shutter:?}");
            assert_eq!(motion.pieces()[0].time[0], shutter[0]);
            assert_eq!(motion.pieces().last().unwrap().time[1], shutter[1]);
            for pair in motion.pieces().windows(2) {
                assert_eq!((pair[0].time[1], pair[0].at[1]), (pair[1].time[0], pair[1].at[0]));
            }
        }
        let motion = course.motion([0.0, 2.0], 0).unwrap();
        for i in 0..=1000 {
            let time = i as f32 / 500.0;
            let p = motion.to_world(time).transform_point3(DVec3::X);
            let (sin, cos) = (f64::from(time) * std::f64::consts::TAU).sin_cos();
            assert!((p.length() - 1.0).abs() < 1e-3 && (p - DVec3::new(cos, sin, 0.0)).length() < 1e-3, "{time}: {p}");
        }
    }

    #[test]
    fn axes_and_the_shortest_way() {
        let x = [2.0, 0.0, 0.0];
        let at = |keys: &[MotionKey], time| {
            let affine = course(keys, [0.0; 3]).at(time);
            affine.axes[1].as_dvec3()
        };
        // The other way round about the opposite axis is the same.
        let keys = [key(0.0, [0.0; 3], x, 20.0, 1.0), key(1.0, [0.0; 3], [-1.0, 0.0, 0.0], -100.0, 1.0)];
        near(at(&keys, 0.5), [0.0, 0.5, 0.75_f64.sqrt()]);
        // Without a rotation, a key is turned by 0 about the other's axis.
        let keys = [MotionKey::default(), key(1.0, [0.0; 3], x, 360.0, 1.0)];
        near(at(&keys, 0.25), [0.0, 0.0, 1.0]);
        near(at(&keys, 0.5), [0.0, -1.0, 0.0]);
        // From a quarter about x to none, said about another axis: back the same way.
        let keys = [key(0.0, [0.0; 3], x, 90.0, 1.0), key(1.0, [0.0; 3], Z, 360.0, 1.0)];
        near(at(&keys, 0.5), [0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()]);
        near(at(&keys, 1.0), [0.0, 1.0, 0.0]);
    }

    #[test]
    fn what_rests_in_its_place_does_not_move() {
        let keys = [MotionKey::default(), MotionKey { time: 1.0, offset: [1.0, 0.0, 0.0], ..MotionKey::default() }];
        let course = course(&keys, [5.0; 3]);
        assert!(course.motion([0.0, 0.0], 0).is_none());
        let moved = course.motion([0.25, 0.25], 0).unwrap();
        assert!(!moved.is_moving());
        near(moved.to_world(0.0).translation, [0.25, 0.0, 0.0]);
        assert!(course.motion([0.0, 0.1], 0).unwrap().is_moving());
        let later = course.motion([7.0, 8.0], 0).unwrap();
        assert!(!later.is_moving());
        near(later.to_world(7.5).translation, [1.0, 0.0, 0.0]);
    }

    /// However close together keys are, and however large numbers.
    #[test]
    fn pieces_have_times_of_their_own() {
        let keys: Vec<_> = (0..2000)
            .map(|i| key(f32::from_bits(1.0_f32.to_bits() + i), [1e15, 0.0, -1e15], [1e-20, 0.0, 1e15], 1e6, 1e6))
            .collect();
        let motion = course(&keys, [1e15; 3]).motion([0.0, 3.0], 0).unwrap();
        assert!(motion.pieces().iter().all(|p| p.time[0] < p.time[1] && p.at.iter().all(|at| at.offset.is_finite())));
        let broken = [key(1.0, [f32::NAN; 3], [0.0; 3], f32::NAN, 0.0), key(f32::NAN, [0.0; 3], Z, 1e38, 1.0)];
        assert!(
            course(&broken, [0.0; 3]).pieces([0.0, 1.0]).is_nan()
                || course(&broken, [0.0; 3]).pieces([0.0, 1.0]) >= 0.0
        );
    }
}
