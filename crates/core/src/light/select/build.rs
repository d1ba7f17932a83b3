//! Sharing lights out: the surface area orientation heuristic.
//!
//! Each group is shared out among four, by three splits, of which each takes the part of most lights: such trees are the
//! least deep, and have the fewest nodes. A group is split by a plane so that Kᵣ (cost(left) + cost(right)) is least, where
//! cost = intensity · solid angle of the emission · size, and Kᵣ, the group's longest extent over that along the
//! plane's axis, keeps groups from getting thin. Along each axis twelve bins are tried. Of a large group some lights
//! stand for all in the bins, so the time goes to sorting the lights from plane to plane: O(n log n).
//!
//! Conty Estevez & Kulla 2018, doi:10.1145/3233305, §4.1; Pharr, Jakob & Humphreys 2023, §12.6.3.

use std::mem;

use super::cluster::Cluster;
use super::emitter::Emitters;
use super::tree::{Node, Tree};

/// A light on its way into the tree.
struct Item {
    cluster: Cluster,
    index: u32,
}

/// A tree of the lights that have a cluster.
pub(super) fn tree(lights: impl Iterator<Item = Option<Cluster>>) -> Tree {
    let mut tree = Tree { nodes: Vec::new(), trails: Vec::new() };
    let mut items = Vec::new();
    for (index, cluster) in (0..).zip(lights) {
        tree.trails.push(Tree::NOWHERE);
        items.extend(cluster.map(|cluster| Item { cluster, index }));
    }
    if !items.is_empty() {
        grow(&mut tree, &mut items, 0, 0);
        tree.nodes.shrink_to_fit();
    }
    tree
}

/// Adds the node of some lights, one at least; returns its index and bounds. Recursion ends at [`Tree::MAX_DEPTH`].
fn grow(tree: &mut Tree, items: &mut [Item], trail: u64, depth: u32) -> (u32, Cluster) {
    let mut links = [0; 4];
    let mut clusters = Vec::with_capacity(4);
    for (side, part) in share_out(items, Tree::MAX_DEPTH - depth - 1).into_iter().enumerate() {
        let trail = trail | (side as u64) << (2 * depth);
        let (link, cluster) = match *part {
            [Item { cluster, index }] => {
                tree.trails[index as usize] = trail;
                (!index, cluster)
            }
            _ => grow(tree, part, trail, depth + 1),
        };
        links[side] = link;
        clusters.push(cluster);
    }
    let brightest = clusters.iter().map(|cluster| cluster.intensity).fold(0.0, f64::max);
    tree.nodes.push(Node { emitters: Emitters::new(&clusters, brightest), links });
    (tree.nodes.len() as u32 - 1, clusters[1..].iter().copied().fold(clusters[0], Cluster::union))
}

/// Up to four parts, none of them empty, that fit into trees of `levels` levels. Time and again the part of most lights
/// is split, so that there are four if there can be.
fn share_out(items: &mut [Item], levels: u32) -> Vec<&mut [Item]> {
    let even = items.len() as u64 > 1 << (2 * levels);
    let mut parts = Vec::with_capacity(4);
    parts.push(items);
    while parts.len() < 4 {
        let most = (1..parts.len()).fold(0, |most, i| if parts[i].len() > parts[most].len() { i } else { most });
        if parts[most].len() == 1 {
            break;
        }
        let (left, right) = split(mem::take(&mut parts[most]), even);
        parts[most] = left;
        parts.insert(most + 1, right);
    }
    parts
}

/// Two parts, neither of them empty; halves if it must be `even`.
fn split(items: &mut [Item], even: bool) -> (&mut [Item], &mut [Item]) {
    let plane = if even { None } else { cheapest(items) };
    let middle = match plane {
        Some((axis, bin)) => partition(items, |item| axis.bin(item) < bin),
        None => halve(items),
    };
    items.split_at_mut(middle)
}

/// Sorts half of the lights before the other, along the longest axis; returns where the second half begins.
fn halve(items: &mut [Item]) -> usize {
    let middle = items.len() / 2;
    let [x, y, z] = Axis::all(items);
    let longest = [y, z].into_iter().fold(x, |a, b| if b.extent() > a.extent() { b } else { a }).axis;
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
/// So many lights at most decide on a plane.
const DELEGATES: usize = 256;

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

    fn extent(&self) -> f32 {
        self.hi - self.lo
    }

    fn bin(&self, item: &Item) -> usize {
        let share = (item.cluster.center2(self.axis) - self.lo) / self.extent();
        ((share * BINS as f32) as usize).min(BINS - 1)
    }
}

/// The plane of least cost: the axis, and the first bin behind it. `None` where all lights have the same centre, and for
/// two, which have only one way to go.
fn cheapest(items: &[Item]) -> Option<(Axis, usize)> {
    if items.len() == 2 {
        return None;
    }
    let axes = Axis::all(items);
    let longest = axes.iter().map(Axis::extent).fold(0.0, f32::max);
    let mut best = (f64::INFINITY, None);
    for axis in axes.into_iter().filter(|axis| axis.hi > axis.lo) {
        let mut bins = [None; BINS];
        for item in items.iter().step_by(items.len().div_ceil(DELEGATES)) {
            add(&mut bins[axis.bin(item)], &item.cluster);
        }
        let thinness = f64::from(longest) / f64::from(axis.extent());
        for (bin, cost) in costs(&bins) {
            if thinness * cost < best.0 {
                best = (thinness * cost, Some((axis, bin)));
            }
        }
    }
    best.1
}

fn add(bin: &mut Option<Cluster>, cluster: &Cluster) {
    match bin {
        Some(bin) => *bin = bin.union(*cluster),
        None => *bin = Some(*cluster),
    }
}

/// For each bin that can be the first of the right part, the cost of both parts.
fn costs(bins: &[Option<Cluster>; BINS]) -> impl Iterator<Item = (usize, f64)> {
    let mut right = [0.0; BINS];
    let mut behind = None;
    for i in (1..BINS).rev() {
        // An empty bin changes nothing: a plane behind it is the same as one before it.
        if let Some(bin) = &bins[i] {
            add(&mut behind, bin);
            right[i] = behind.map_or(0.0, |cluster| cluster.cost());
        }
    }
    let mut left = bins[0];
    (1..BINS).filter_map(move |i| {
        let bin = bins[i].as_ref()?;
        let cost = left.map(|left| (i, left.cost() + right[i]));
        add(&mut left, bin);
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
            let mut node = tree.nodes.last().unwrap();
            let mut depth = 1;
            loop {
                let link = node.links[(trail >> (2 * (depth - 1)) & 3) as usize];
                let Some(child) = tree.nodes.get(link as usize) else {
                    assert_eq!(!link as usize, index);
                    return depth;
                };
                node = child;
                depth += 1;
            }
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
        let tree = grown(&(0..100_000).map(light).collect::<Vec<_>>());
        let depths = depths(&tree);
        // log₄ 100,000 = 8.3.
        assert!(mean(&depths) < 10.0 && depths.iter().all(|&d| d < 17), "{} {:?}", mean(&depths), depths.iter().max());
        let bytes = size_of_val(&tree.nodes[..]) / depths.len();
        assert!(bytes < 128, "{bytes} for each light");
    }

    #[test]
    fn the_same_place_is_quartered() {
        let depths = depths(&grown(&[LightBounds::sphere(Vec3::ONE, 0.5, 1.0); 1000]));
        assert!(depths.iter().all(|&d| d == 5));
    }

    /// To four sides, each crowd twelve times as far as the one before: bins cut off one at a time, and halving must
    /// step in.
    #[test]
    fn depth_is_limited() {
        let sides = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y];
        let at = |crowd: i32, side: Vec3| LightBounds::sphere(side * 12_f32.powi(crowd - 33), 0.0, 1.0);
        let crowd = |crowd| sides.map(|side| [at(crowd, side); 25]).concat();
        let lights: Vec<_> = (0..67).flat_map(crowd).collect();
        assert_eq!(depths(&grown(&lights)).into_iter().max(), Some(Tree::MAX_DEPTH));
    }
}
