//! The proofs of the crate: shapes against slow, independent arithmetic, the tree against the list, and closed surfaces
//! that no ray leaves. Seeds are fixed, so a result never changes without the code.

mod apart;
mod build;
mod callbacks;
mod instances;
mod limits;
mod motion;
mod random;
mod reference;
mod regressions;
mod same_as_list;
mod shapes;
mod watertight;
