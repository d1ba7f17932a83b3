//! A tree of lights, and the walk down it.
//!
//! Every node is a group of lights that its children, four at most, share out. From the root on, a child is chosen in
//! proportion to its [importance](super::emitter) for the point, until it is one light. A light's chance is the product
//! of those of the choices; the path of each light is kept, two bits a choice, so that the chance of any light takes a
//! walk as long. Where no child of a group can send light to the point, nothing is chosen.
//!
//! With four children a walk is half as long as with two, and takes little more for each step, as the four are looked at
//! in one go. And the fewer the choices, the fewer are made by the rough importance of a large group: there is less noise.
//!
//! Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", doi:10.1145/3233305;
//! nodes of four as for rays: Dammertz, Hanika & Keller 2008, "Shallow Bounding Volume Hierarchies for Fast SIMD Ray
//! Tracing of Incoherent Rays", doi:10.1111/j.1467-8659.2008.01261.x.

use glam::Vec3;

use super::build;
use super::cluster::Cluster;
use super::emitter::Emitters;

/// The lights of the scene, sorted by where they are and whereto they shine.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// The last is the root; there is none if there is no light.
    pub(super) nodes: Vec<Node>,
    /// For each light the way from the root: two bits for each step, the first lowest.
    pub(super) trails: Vec<u64>,
}

/// A group of lights: the up to four groups that share it out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) emitters: Emitters,
    /// What each of them is: the index of a node, or, with all bits inverted, that of a light.
    pub(super) links: [u32; 4],
}

impl Tree {
    /// The longest way down: every trail has bits for each step, and some to spare.
    pub(super) const MAX_DEPTH: u32 = 31;
    /// The trail of what is not in the tree.
    pub(super) const NOWHERE: u64 = u64::MAX;

    /// A tree of those of the lights that have a cluster.
    pub(super) fn new(lights: impl Iterator<Item = Option<Cluster>>) -> Self {
        build::tree(lights)
    }

    /// From the root to a light: `choose` is told the importances of the four and where each begins, and all end, if they
    /// are laid end to end; it says which of the four.
    ///
    /// The one walk there is, so that a sample and a question give the same bits.
    #[inline]
    fn walk(&self, p: Vec3, n: Vec3, mut choose: impl FnMut([f64; 4], [f64; 5]) -> usize) -> Option<(u32, f64)> {
        let mut node = self.nodes.last()?;
        let mut pmf = 1.0;
        loop {
            let importances = node.emitters.importances(p, n).to_array().map(f64::from);
            let [a, b, c, d] = importances;
            let sums = [0.0, a, a + b, a + b + c, a + b + c + d];
            if sums[4] <= 0.0 {
                return None;
            }
            let side = choose(importances, sums);
            pmf *= importances[side] / sums[4];
            match self.nodes.get(node.links[side] as usize) {
                Some(child) => node = child,
                None => return Some((!node.links[side], pmf)),
            }
        }
    }

    /// The light chosen by `u` in [0, 1), its chance, and the rest of `u`, again in 0..1.
    #[inline]
    pub(super) fn sample(&self, p: Vec3, n: Vec3, mut u: f64) -> Option<(u32, f64, f64)> {
        let (index, pmf) = self.walk(p, n, |importances, sums| {
            let x = u * sums[4];
            // As many as end before it, and have anything behind them.
            let side = sums[1..4].iter().map(|&end| usize::from(x >= end && end < sums[4])).sum();
            u = (x - sums[side]) / importances[side];
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
        let walk = self.walk(p, n, |_, _| {
            let side = (trail & 3) as usize;
            trail >>= 2;
            side
        });
        walk.map_or(0.0, |(_, pmf)| pmf)
    }
}
