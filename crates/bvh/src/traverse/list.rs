//! Without a tree: every primitive, exactly.

use crate::search::{Accept, Search, Slot};
use crate::traverse::leaf::test_instance;
use crate::wide::{Kind, Tree};

/// Tests everything; whether something is hit, if `ANY`.
#[cold]
pub(super) fn test_all<const ANY: bool>(tree: &Tree, search: &mut Search, accept: impl Accept) -> bool {
    for (kind, blocks) in tree.blocks() {
        for (block, lane) in (0..blocks).flat_map(|block| (0..kind.lanes()).map(move |lane| (block, lane))) {
            if kind == Kind::Instance {
                if test_instance::<ANY>(tree, block, search, accept) {
                    return true;
                }
            } else if tree.is_used(kind, block, lane) && search.apart(kind, block) >> lane & 1 == 0 {
                search.test(tree, Slot::new(kind, block, lane), accept);
                if ANY && search.found() {
                    return true;
                }
            }
        }
    }
    false
}
