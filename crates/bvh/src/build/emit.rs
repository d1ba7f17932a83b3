//! From the planned binary tree to the tree that rays walk.
//!
//! The nodes above subtrees are written first, by one thread. What each subtree takes is counted, so that threads can
//! write subtrees to places known beforehand.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use crate::aabb::Aabb;
use crate::build::binary::{Forest, Node as Binary, Subtree, children, show};
use crate::build::item::Item;
use crate::bvh::Bvh;
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::wide::{Child, Node, Room, Sizes, Tree};

/// The tree, and how many references its leaves hold; an error if these are too many.
pub(super) fn emit(forest: &Forest, geometry: &(impl Geometry + ?Sized)) -> Result<(Tree, usize), BuildError> {
    let mut top = Top { forest, nodes: Vec::new(), jobs: Vec::new() };
    let root = top.place(0, 1, None);
    let Top { nodes, jobs, .. } = top;
    let sizes: Vec<Sizes> = jobs.par_iter().map(|job| job.sizes(forest)).collect();
    let mut tree = Tree::with_sizes(sizes.iter().fold(Sizes::nodes(nodes.len()), |sum, size| sum + *size).checked()?);
    let mut room = tree.room();
    for node in &nodes {
        let place = room.place_node();
        room.put_node(place, node.clone());
    }
    let rooms: Vec<_> = sizes.iter().map(|size| room.take(size)).collect();
    let written = jobs.par_iter().zip(rooms).map(|(job, room)| job.write(forest, geometry, room));
    let written: Vec<(Vec<Child>, usize)> = written.collect();
    tree.root = root;
    for (job, (entries, _)) in jobs.iter().zip(&written) {
        match job.parent {
            Some((node, lane)) => tree.nodes[node].child[lane..lane + entries.len()].copy_from_slice(entries),
            None => tree.root = entries[0],
        }
    }
    Ok((tree, written.iter().map(|(_, references)| references).sum()))
}

/// A subtree to be written, or the parts of one that are shown in several lanes of a node.
struct Job {
    subtree: usize,
    entries: Vec<usize>,
    /// The node and the lane of the first entry; none for the root.
    parent: Option<(usize, usize)>,
}

/// The nodes above the subtrees.
struct Top<'a> {
    forest: &'a Forest<'a>,
    nodes: Vec<Node>,
    jobs: Vec<Job>,
}

impl Top<'_> {
    /// Writes the node, if it is not for a job.
    fn place(&mut self, index: usize, places: usize, parent: Option<(usize, usize)>) -> Child {
        let top = &self.forest.top;
        let Some([left, right]) = children(top, index) else {
            let subtree = top[index].first as usize;
            let mut entries = Vec::with_capacity(places);
            show(&self.forest.subtrees[subtree].nodes, 0, places, &mut |entry, _| entries.push(entry));
            self.jobs.push(Job { subtree, entries, parent });
            return Child::NONE;
        };
        let mut shown = Vec::with_capacity(LANES);
        let left_places = top[index].choices.left_of_node();
        show(top, left, left_places, &mut |index, places| shown.push((index, places)));
        show(top, right, LANES - left_places, &mut |index, places| shown.push((index, places)));
        let wide = self.nodes.len();
        self.nodes.push(Node::new(&[]));
        let mut lanes: Vec<(Child, Aabb)> = Vec::with_capacity(LANES);
        for (index, places) in shown {
            let jobs = self.jobs.len();
            let child = self.place(index, places, Some((wide, lanes.len())));
            match self.jobs.get(jobs).filter(|_| children(&self.forest.top, index).is_none()) {
                Some(job) => {
                    let nodes = &self.forest.subtrees[job.subtree].nodes;
                    lanes.extend(job.entries.iter().map(|&entry| (Child::NONE, nodes[entry].bounds().into())));
                }
                None => lanes.push((child, self.forest.top[index].bounds().into())),
            }
        }
        self.nodes[wide] = Node::new(&lanes);
        Child::node(wide)
    }
}

impl Job {
    fn sizes(&self, forest: &Forest) -> Sizes {
        let subtree = &forest.subtrees[self.subtree];
        self.entries.iter().fold(Sizes::default(), |sum, &entry| sum + subtree.sizes(entry))
    }

    fn write(&self, forest: &Forest, geometry: &(impl Geometry + ?Sized), room: Room) -> (Vec<Child>, usize) {
        let subtree = &forest.subtrees[self.subtree];
        // All at once, so that the processor waits for many of them at a time.
        let primitives = subtree.items.iter().map(|item| geometry.primitive(item.prim() as usize)).collect();
        let mut writer = Writer { subtree, primitives, objects: geometry.objects(), room, references: 0 };
        (self.entries.iter().map(|&entry| writer.write(entry)).collect(), writer.references)
    }
}

impl Subtree<'_> {
    /// The nodes shown in the lanes of a wide node.
    fn lanes(&self, index: usize, mut shown: impl FnMut(usize)) {
        if let Some([left, right]) = children(&self.nodes, index) {
            let left_places = self.nodes[index].choices.left_of_node();
            show(&self.nodes, left, left_places, &mut |index, _| shown(index));
            show(&self.nodes, right, LANES - left_places, &mut |index, _| shown(index));
        }
    }

    /// What it takes in the tree that rays walk.
    fn sizes(&self, index: usize) -> Sizes {
        if self.nodes[index].choices.is_leaf() {
            let items = &self.items[self.leaf(index)];
            return Sizes::leaf(items[0].kind().for_leaf(distinct(items).count()));
        }
        let mut sizes = Sizes::nodes(1);
        self.lanes(index, |index| sizes = sizes + self.sizes(index));
        sizes
    }

    /// The items below a node.
    fn leaf(&self, mut index: usize) -> Range<usize> {
        let first = self.nodes[index].first as usize;
        while let Some([_, right]) = children(&self.nodes, index) {
            index = right;
        }
        let last: &Binary = &self.nodes[index];
        first..(last.first + last.count) as usize
    }
}

struct Writer<'a> {
    subtree: &'a Subtree<'a>,
    /// Of the subtree's items.
    primitives: Vec<Primitive>,
    objects: &'a [Arc<Bvh>],
    room: Room<'a>,
    references: usize,
}

impl Writer<'_> {
    /// Writes a part of the subtree; parents come first.
    fn write(&mut self, index: usize) -> Child {
        if self.subtree.nodes[index].choices.is_leaf() {
            return self.write_leaf(index);
        }
        let place = self.room.place_node();
        let (mut shown, mut lanes) = ([0; LANES], 0);
        self.subtree.lanes(index, |index| {
            shown[lanes] = index;
            lanes += 1;
        });
        let mut children = [(Child::NONE, Aabb::EMPTY); LANES];
        for (child, &index) in children.iter_mut().zip(&shown[..lanes]) {
            *child = (self.write(index), self.subtree.nodes[index].bounds().into());
        }
        self.room.put_node(place, Node::new(&children));
        Child::node(place)
    }

    fn write_leaf(&mut self, index: usize) -> Child {
        let range = self.subtree.leaf(index);
        let items = &self.subtree.items[range.clone()];
        let primitives = distinct(items).map(|i| (items[i].prim(), self.primitives[range.start + i]));
        let bounds = primitives.clone().fold(Aabb::EMPTY, |b, (_, primitive)| b.union(primitive.bounds(self.objects)));
        let count = primitives.clone().count();
        self.references += count;
        self.room.push_leaf(
            items[0].kind().for_leaf(count),
            primitives,
            (bounds.hi - bounds.lo).max_element().next_up(),
        )
    }
}

/// The indices of items, without further parts of the same primitive: they may have come together again.
fn distinct(items: &[Item]) -> impl Iterator<Item = usize> + Clone {
    (0..items.len()).filter(|&i| items[..i].iter().all(|other| other.prim() != items[i].prim()))
}
