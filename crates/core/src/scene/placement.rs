//! Where shapes are that rays do not meet where they say they are: those that move, and copies.

use eyebeam_bvh::{Affine, Instance};
use glam::{Affine3A, DAffine3};

use crate::motion::Motion;

/// From the space of a shape to the world.
#[derive(Clone, Debug)]
pub(super) enum Placement {
    /// It is at one place after the other.
    Motion(Motion),
    /// It is at many places.
    Copies(Vec<Instance>),
}

impl Placement {
    /// Of copies of an object; none if there are none.
    pub(super) fn of_copies(copies: &[Affine3A], object: u32) -> Option<Self> {
        let instance = |copy: &Affine3A| {
            let m = copy.matrix3;
            let axes = [m.x_axis, m.y_axis, m.z_axis].map(Into::into);
            Instance::new(object, Affine { axes, offset: copy.translation.into() })
        };
        (!copies.is_empty()).then(|| Self::Copies(copies.iter().map(instance).collect()))
    }

    /// What rays meet.
    pub(super) fn instances(&self) -> &[Instance] {
        match self {
            Self::Motion(motion) => motion.pieces(),
            Self::Copies(copies) => copies,
        }
    }

    /// Whether it is not at the same place all the time.
    pub(super) fn is_moving(&self) -> bool {
        matches!(self, Self::Motion(motion) if motion.is_moving())
    }

    /// To the world, from the space of what one of its instances shows.
    pub(super) fn to_world(&self, instance: u32, time: f32) -> DAffine3 {
        match self {
            Self::Motion(motion) => motion.to_world(time),
            Self::Copies(copies) => {
                copies.get(instance as usize).and_then(|copy| copy.to_world(time)).unwrap_or(DAffine3::IDENTITY)
            }
        }
    }
}
