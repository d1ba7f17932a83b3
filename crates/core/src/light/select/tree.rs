//! A tree of lights, and the walk down it.
//!
//! Every node is a group of lights that its two children share out. From the root on, a child is chosen in proportion to
//! its [importance](super::emitter) for the point, until the group is one light. A light's chance is the product of
//! those of the choices; the path of each light is kept, left and right as bits, so that the chance of any light takes
//! a walk as long. Where no child of a group can send light to the point, nothing is chosen.
//!
//! Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", doi:10.1145/3233305.

use glam::Vec3;

use super::build;
use super::emitter::{Cluster, Emitter};

/// The lights of the scene, sorted by where they are and whereto they shine.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// `None` if there is no light.
    pub(super) root: Option<Node>,
    /// Children, side by side.
    pub(super) pairs: Vec<[Node; 2]>,
    /// For each light the way from the root: bit k is 1 where it goes to the right at depth k.
    pub(super) trails: Vec<u64>,
}

/// A group of lights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) emitter: Emitter,
    pub(super) link: Link,
}

const _: () = assert!(size_of::<Node>() <= 64, "a node fits a line of the cache");

/// What is below a node.
#[derive(Clone, Copy, Debug)]
pub(super) enum Link {
    /// It is this light.
    Light(u32),
    /// Its children are this pair.
    Pair(u32),
}

impl Tree {
    /// The longest way down: every trail has a bit for each step, and one to spare.
    pub(super) const MAX_DEPTH: u32 = 63;
    /// The trail of what is not in the tree.
    pub(super) const NOWHERE: u64 = u64::MAX;

    /// A tree of those of the lights that have a cluster.
    pub(super) fn new(lights: impl Iterator<Item = Option<Cluster>>) -> Self {
        build::tree(lights)
    }

    /// From the root to a light: `choose` is told the importance of both children and says which.
    ///
    /// The one walk there is, so that a sample and a question give the same bits.
    #[inline]
    fn walk(&self, p: Vec3, n: Vec3, mut choose: impl FnMut([f64; 2]) -> usize) -> Option<(u32, f64)> {
        let mut node = self.root.as_ref().filter(|root| root.emitter.importance(p, n) > 0.0)?;
        let mut pmf = 1.0;
        loop {
            let pair = match node.link {
                Link::Light(index) => return Some((index, pmf)),
                Link::Pair(pair) => &self.pairs[pair as usize],
            };
            let importance = [pair[0].emitter.importance(p, n), pair[1].emitter.importance(p, n)];
            let sum = importance[0] + importance[1];
            if sum <= 0.0 {
                return None;
            }
            let side = choose(importance);
            pmf *= importance[side] / sum;
            node = &pair[side];
        }
    }

    /// The light chosen by `u` in [0, 1), its chance, and the rest of `u`, again in 0..1.
    #[inline]
    pub(super) fn sample(&self, p: Vec3, n: Vec3, mut u: f64) -> Option<(u32, f64, f64)> {
        let (index, pmf) = self.walk(p, n, |[left, right]| {
            let x = u * (left + right);
            let side = usize::from(x >= left && right > 0.0);
            u = if side == 0 { x / left } else { (x - left) / right };
            side
        })?;
        Some((index, pmf, u))
    }

    /// The chance of a light.
    #[inline]
    pub(super) fn pmf(&self, p: Vec3, n: Vec3, index: u32) -> f64 {
        let mut trail = self.trails.get(index as usize).copied().unwrap_or(Self::NOWHERE);
        if trail == Self::NOWHERE {
            return 0.0;
        }
        let walk = self.walk(p, n, |_| {
            let side = (trail & 1) as usize;
            trail >>= 1;
            side
        });
        walk.map_or(0.0, |(_, pmf)| pmf)
    }
}
