//! What is still to be visited.

use std::mem::MaybeUninit;

use crate::build::MAX_DEPTH;
use crate::wide::Child;

/// A child and the distance before which the ray is not in its box, in one number that sorts by distance.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Entry(u64);

impl Entry {
    #[inline(always)]
    pub(super) fn new(t: f32, child: Child) -> Self {
        Self(u64::from(t.to_bits()) << 32 | u64::from(child.bits()))
    }

    #[inline(always)]
    fn t(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    pub(super) fn child(self) -> Child {
        Child::from_bits(self.0 as u32)
    }
}

/// A level of the tree leaves seven entries at most, or eight while they are sorted.
const CAPACITY: usize = 7 * MAX_DEPTH + 8;

/// A stack of children, the next one on top. Its height is kept by the caller, so that it can stay in a register.
pub(super) struct Stack([MaybeUninit<Entry>; CAPACITY]);

impl Stack {
    #[inline(always)]
    pub(super) const fn new() -> Self {
        Self([const { MaybeUninit::uninit() }; CAPACITY])
    }

    #[inline(always)]
    pub(super) fn push(&mut self, height: &mut usize, entry: Entry) {
        self.set(*height, entry);
        *height += 1;
    }

    /// Puts an entry where it belongs among those above `base`, of which the nearest is on top.
    #[inline(always)]
    pub(super) fn insert(&mut self, base: usize, height: &mut usize, entry: Entry) {
        let mut at = *height;
        while at > base {
            let below = self.get(at - 1);
            if below >= entry {
                break;
            }
            self.set(at, below);
            at -= 1;
        }
        self.set(at, entry);
        *height += 1;
    }

    /// The entry on top that is not farther than `t_max`.
    #[inline(always)]
    pub(super) fn pop(&mut self, height: &mut usize, t_max: f32) -> Option<Child> {
        while *height > 0 {
            *height -= 1;
            let entry = self.get(*height);
            if entry.t() <= t_max {
                return Some(entry.child());
            }
        }
        None
    }

    #[inline(always)]
    fn get(&self, at: usize) -> Entry {
        debug_assert!(at < CAPACITY);
        // SAFETY: entries below a height that the stack has had were written, and `set` has kept that height in bounds.
        unsafe { self.0.get_unchecked(at).assume_init() }
    }

    #[inline(always)]
    fn set(&mut self, at: usize, entry: Entry) {
        debug_assert!(at < CAPACITY);
        // SAFETY: no tree is deeper than `MAX_DEPTH` (builders keep to it, `Bvh::validate` checks it), and a walk goes down
        // from each node once; so there are never more entries than the capacity.
        unsafe { self.0.get_unchecked_mut(at).write(entry) };
    }
}
