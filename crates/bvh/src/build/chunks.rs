//! The top of the tree has few nodes of many items: there, threads share the work on one node. Chunks have a fixed size and
//! are merged in order, so results do not depend on the number of threads.

use rayon::prelude::*;

use crate::build::bins::{Bins, Grid};
use crate::build::bounds::Bounds;
use crate::build::item::Item;

/// Items that a thread looks at in one go.
const CHUNK: usize = 1 << 14;

/// The box around the centres.
pub(super) fn centers(items: &[Item]) -> Bounds {
    let serial = |items: &[Item]| items.iter().fold(Bounds::EMPTY, |b, item| b.with_point(item.bounds().center()));
    if items.len() <= 2 * CHUNK {
        return serial(items);
    }
    let parts: Vec<_> = items.par_chunks(CHUNK).map(serial).collect();
    parts.into_iter().fold(Bounds::EMPTY, Bounds::union)
}

/// The box around the items.
pub(super) fn bounds(items: &[Item]) -> Bounds {
    let serial = |items: &[Item]| items.iter().fold(Bounds::EMPTY, |b, item| b.union(item.bounds()));
    if items.len() <= 2 * CHUNK {
        return serial(items);
    }
    let parts: Vec<_> = items.par_chunks(CHUNK).map(serial).collect();
    parts.into_iter().fold(Bounds::EMPTY, Bounds::union)
}

/// The items in their bins.
pub(super) fn bins<const N: usize>(items: &[Item], grid: &Grid<N>) -> Bins<N> {
    if items.len() <= 2 * CHUNK {
        return Bins::new(items, grid);
    }
    let parts: Vec<_> = items.par_chunks(CHUNK).map(|chunk| Bins::new(chunk, grid)).collect();
    let mut parts = parts.into_iter();
    let first = parts.next().unwrap_or_else(|| Bins::new(&[], grid));
    parts.fold(first, |mut all, part| {
        all.merge(&part);
        all
    })
}

/// Moves those that go left to the front; returns how many.
pub(super) fn partition(items: &mut [Item], goes_left: impl Fn(Item) -> bool + Sync) -> usize {
    if items.len() <= 2 * CHUNK {
        return partition_serially(items, &goes_left);
    }
    let lengths: Vec<_> = items.par_chunks_mut(CHUNK).map(|chunk| partition_serially(chunk, &goes_left)).collect();
    let middle = lengths.iter().sum();
    swap_misplaced(items, &lengths, middle);
    middle
}

/// Without branches: the first item that goes right is swapped with every item, and only moves on if that one goes left.
fn partition_serially(items: &mut [Item], goes_left: &impl Fn(Item) -> bool) -> usize {
    let mut left = 0;
    for i in 0..items.len() {
        let item = items[i];
        items.swap(left, i);
        left += usize::from(goes_left(item));
    }
    left
}

/// Each chunk has its left items in front: brings those behind `middle` to the places of right items before it.
fn swap_misplaced(items: &mut [Item], lengths: &[usize], middle: usize) {
    let (mut front, mut back) = (Vec::new(), Vec::new());
    let mut start = 0;
    let (mut before, mut behind) = items.split_at_mut(middle);
    let (mut before_at, mut behind_at) = (0, middle);
    for &length in lengths {
        let end = (start + CHUNK).min(middle + behind.len() + behind_at - middle);
        let right = start + length;
        // Right items before the middle.
        if right < middle {
            let to = end.min(middle);
            front.push(take(&mut before, &mut before_at, right, to));
        }
        // Left items behind it.
        if right > middle {
            let from = start.max(middle);
            back.push(take(&mut behind, &mut behind_at, from, right));
        }
        start = end;
    }
    let mut pairs = Vec::new();
    let (mut front, mut back) = (front.into_iter(), back.into_iter());
    let (mut a, mut b) = (front.next(), back.next());
    while let (Some(x), Some(y)) = (a.take(), b.take()) {
        let n = x.len().min(y.len());
        let (x, x_rest) = x.split_at_mut(n);
        let (y, y_rest) = y.split_at_mut(n);
        pairs.push((x, y));
        a = if x_rest.is_empty() { front.next() } else { Some(x_rest) };
        b = if y_rest.is_empty() { back.next() } else { Some(y_rest) };
    }
    pairs.into_par_iter().for_each(|(x, y)| x.swap_with_slice(y));
}

/// Cuts `from..to` out of a list whose first element has the index `at`.
fn take<'a>(list: &mut &'a mut [Item], at: &mut usize, from: usize, to: usize) -> &'a mut [Item] {
    let (_, rest) = std::mem::take(list).split_at_mut(from - *at);
    let (taken, rest) = rest.split_at_mut(to - from);
    (*list, *at) = (rest, to);
    taken
}
