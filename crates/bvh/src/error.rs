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
}
