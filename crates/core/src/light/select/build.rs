//! Sharing lights out: the surface area orientation heuristic.
//!
//! A group is split by a plane so that Kᵣ (cost(left) + cost(right)) is least, where
//! cost = intensity · solid angle of the emission · size, and Kᵣ, the group's longest extent over that along the
//! plane's axis, keeps groups from getting thin. Along each axis twelve bins are tried. O(n log n).
//!
//! Conty Estevez & Kulla 2018, doi:10.1145/3233305, §4.1; Pharr, Jakob & Humphreys 2023, §12.6.3.

use super::emitter::Cluster;
use super::tree::{Link, Node, Tree};

/// A light on its way into the tree.
struct Item {
    cluster: Cluster,
    index: u32,
}

/// A tree of the lights that have a cluster.
pub(super) fn tree(lights: impl Iterator<Item = Option<Cluster>>) -> Tree {
    let mut tree = Tree { root: None, pairs: Vec::new(), trails: Vec::new() };
    let mut items = Vec::new();
    for (index, cluster) in (0..).zip(lights) {
        tree.trails.push(Tree::NOWHERE);
        items.extend(cluster.map(|cluster| Item { cluster, index }));
    }
    if !items.is_empty() {
        tree.pairs.reserve_exact(items.len() - 1);
        tree.root = Some(grow(&mut tree, &mut items, 0, 0));
    }
    tree
}

/// The node of some lights, one at least. Recursion ends at [`Tree::MAX_DEPTH`].
fn grow(tree: &mut Tree, items: &mut [Item], trail: u64, depth: u32) -> Node {
    let emitter = around(items.iter().map(|item| item.cluster)).emitter();
    if let [item] = items {
        tree.trails[item.index as usize] = trail;
        return Node { emitter, link: Link::Light(item.index) };
    }
    let (left, right) = split(items, Tree::MAX_DEPTH - depth - 1);
    let children = [grow(tree, left, trail, depth + 1), grow(tree, right, trail | 1 << depth, depth + 1)];
    tree.pairs.push(children);
    Node { emitter, link: Link::Pair(tree.pairs.len() as u32 - 1) }
}

fn around(clusters: impl Iterator<Item = Cluster>) -> Cluster {
    clusters.reduce(Cluster::union).expect("a node has a light")
}

/// Two parts, neither of them empty, that fit into trees of `levels` levels.
fn split(items: &mut [Item], levels: u32) -> (&mut [Item], &mut [Item]) {
    let plane = if items.len() as u64 <= 1 << levels { cheapest(items) } else { None };
    let middle = match plane {
        Some((axis, bin)) => partition(items, |item| axis.bin(item) < bin),
        None => halve(items),
    };
    items.split_at_mut(middle)
}

/// Sorts half of the lights before the other, along the longest axis; returns where the second half begins.
fn halve(items: &mut [Item]) -> usize {
    let middle = items.len() / 2;
    let axes = Axis::all(items);
    let longest = axes[1..].iter().fold(&axes[0], |a, b| if b.hi - b.lo > a.hi - a.lo { b } else { a }).axis;
    items.select_nth_unstable_by(middle, |a, b| {
        a.cluster.center2(longest).total_cmp(&b.cluster.center2(longest)).then(a.index.cmp(&b.index))
    });
    middle
}

/// Brings what `is_first` to the front; returns how many that are.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let mut first = 0;
    for i in 0..items.len() {
        if is_first(&items[i]) {
            items.swap(first, i);
            first += 1;
        }
    }
    first
}

const BINS: usize = 12;

/// The range of the (doubled) centres along an axis, to be cut into bins.
#[derive(Clone, Copy)]
struct Axis {
    axis: usize,
    lo: f32,
    hi: f32,
}

impl Axis {
    fn all(items: &[Item]) -> [Self; 3] {
        let mut axes = [0, 1, 2].map(|axis| Self { axis, lo: f32::INFINITY, hi: f32::NEG_INFINITY });
        for item in items {
            for axis in &mut axes {
                let center = item.cluster.center2(axis.axis);
                (axis.lo, axis.hi) = (axis.lo.min(center), axis.hi.max(center));
            }
        }
        axes
    }

    fn bin(&self, item: &Item) -> usize {
        let share = (item.cluster.center2(self.axis) - self.lo) / (self.hi - self.lo);
        ((share * BINS as f32) as usize).min(BINS - 1)
    }
}

/// The plane of least cost: the axis, and the first bin behind it. `None` where all lights have the same centre.
fn cheapest(items: &[Item]) -> Option<(Axis, usize)> {
    if items.len() == 2 {
        return None;
    }
    let (lo, hi) = items.iter().fold((items[0].cluster.lo, items[0].cluster.hi), |(lo, hi), item| {
        (lo.min(item.cluster.lo), hi.max(item.cluster.hi))
    });
    let extent = hi - lo;
    let mut best = (f64::INFINITY, None);
    for axis in Axis::all(items).into_iter().filter(|axis| axis.hi > axis.lo) {
        let mut bins = [None; BINS];
        for item in items {
            let bin = &mut bins[axis.bin(item)];
            *bin = join(*bin, Some(item.cluster));
        }
        let thinness = f64::from(extent.max_element()) / f64::from(extent[axis.axis]);
        for (bin, cost) in costs(&bins) {
            if thinness * cost < best.0 {
                best = (thinness * cost, Some((axis, bin)));
            }
        }
    }
    best.1
}

fn join(a: Option<Cluster>, b: Option<Cluster>) -> Option<Cluster> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        _ => a.or(b),
    }
}

/// For each bin that can be the first of the right part, the cost of both parts.
fn costs(bins: &[Option<Cluster>; BINS]) -> impl Iterator<Item = (usize, f64)> {
    let mut right = [None; BINS];
    let mut behind = None;
    for i in (1..BINS).rev() {
        // An empty bin changes nothing: a plane behind it is the same as one before it.
        if bins[i].is_some() {
            behind = join(bins[i], behind);
            right[i] = behind.map(|cluster| cluster.cost());
        }
    }
    let mut left = bins[0];
    (1..BINS).filter_map(move |i| {
        let cost = right[i].zip(left).map(|(right, left)| (i, left.cost() + right));
        left = join(left, bins[i]);
        cost
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::select::LightBounds;
    use crate::sampler::Independent;
    use glam::{UVec2, Vec3};

    fn grown(lights: &[LightBounds]) -> Tree {
        tree(lights.iter().map(|light| Some(Cluster::new(light))))
    }

    /// The depth of each light, found by walking down; every light is found where its trail leads.
    fn depths(tree: &Tree) -> Vec<u32> {
        let depth = |(index, &trail): (usize, &u64)| {
            let mut node = tree.root.as_ref().unwrap();
            let mut depth = 0;
            while let Link::Pair(pair) = node.link {
                node = &tree.pairs[pair as usize][(trail >> depth & 1) as usize];
                depth += 1;
            }
            assert!(matches!(node.link, Link::Light(i) if i as usize == index));
            depth
        };
        tree.trails.iter().enumerate().map(depth).collect()
    }

    fn mean(depths: &[u32]) -> f64 {
        depths.iter().map(|&d| f64::from(d)).sum::<f64>() / depths.len() as f64
    }

    #[test]
    fn a_hundred_thousand_lights_are_a_short_walk() {
        let light = |i| {
            let mut numbers = Independent::new(1, UVec2::ZERO, i);
            let (a, b, c) = (numbers.get_2d(), numbers.get_2d(), numbers.get_1d());
            let p = Vec3::new(a.x, 0.1 * a.y, c);
            LightBounds::flat(p, p + 1e-3, crate::sampling::uniform_sphere(b), 1.0 + c)
        };
        let depths = depths(&grown(&(0..100_000).map(light).collect::<Vec<_>>()));
        // log₂ 100,000 = 16.6.
        assert!(mean(&depths) < 20.0 && depths.iter().all(|&d| d < 34), "{} {:?}", mean(&depths), depths.iter().max());
    }

    #[test]
    fn the_same_place_is_halved() {
        let depths = depths(&grown(&[LightBounds::sphere(Vec3::ONE, 0.5, 1.0); 1000]));
        assert!(depths.iter().all(|&d| d == 9 || d == 10));
    }

    /// Each crowd twelve times as far as the one before: bins cut off one at a time, and halving must step in.
    #[test]
    fn depth_is_limited() {
        let at = |crowd: i32| LightBounds::sphere(Vec3::X * 12_f32.powi(crowd - 33), 0.0, 1.0);
        let lights: Vec<_> = (0..67).flat_map(|crowd| [at(crowd); 100]).collect();
        assert_eq!(depths(&grown(&lights)).into_iter().max(), Some(Tree::MAX_DEPTH));
    }
}
