//! What a tree is made of.

/// Counts and sizes of a tree, for comparison and for people. Objects that its instances show are not counted in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stats {
    /// Primitives that rays can hit.
    pub primitives: usize,
    /// Primitives that were left out, since nothing can hit them: without area, never there, or an instance of nothing.
    pub degenerate: usize,
    /// Inner nodes.
    pub nodes: usize,
    /// Leaves.
    pub leaves: usize,
    /// References from leaves to primitives: spatial splits make them more than the primitives.
    pub references: usize,
    /// Share of the places in leaves that are in use, 0..1.
    pub fill: f32,
    /// Expected cost of a ray that meets the box around everything, in tests of a node or a leaf (the surface area heuristic).
    pub sah_cost: f32,
    /// Memory that the tree holds, without the objects that its instances show.
    pub bytes: usize,
}
