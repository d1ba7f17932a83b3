//! What can be wrong with geometry.

/// Why no tree was built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A number of a primitive is infinite or not a number.
    #[error("primitive {index} has a coordinate that is not finite")]
    NotFinite {
        /// The primitive.
        index: usize,
    },
    /// There are more primitives than a tree holds.
    #[error("{count} primitives, more than the {most} that a tree holds")]
    TooMany {
        /// How many there are.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// The primitives need more leaves than a tree holds: many kinds of them lie among each other, or far apart.
    #[error("{count} leaves of a kind, more than the {most} that a tree holds")]
    TooManyLeaves {
        /// How many there would be.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// An instance shows an object that is not in the list.
    #[error("instance {index} shows object {object}, and there are {count}")]
    NoObject {
        /// The instance.
        index: usize,
        /// The object that it names.
        object: u32,
        /// How many there are.
        count: usize,
    },
    /// Instances lie too deep within each other.
    #[error("instance {index} is one too many within each other: at most {most} are possible")]
    TooDeep {
        /// The outermost instance.
        index: usize,
        /// The most instances within each other.
        most: usize,
    },
}
