//! What a scene's tree is built from: primitives that rest, and a tree of its own for each shape that moves or has copies.

use std::sync::Arc;

use eyebeam_bvh::{BuildError, Bvh, Primitive};

use crate::scene::placement::Placement;
use crate::shape::ShapeDesc;

/// Primitives and what those that are instances show.
#[derive(Default)]
pub(super) struct Geometry {
    pub(super) primitives: Vec<Primitive>,
    pub(super) objects: Vec<Arc<Bvh>>,
    /// Those of the objects counted, and not their instances.
    pub(super) primitive_count: usize,
}

impl eyebeam_bvh::Geometry for Geometry {
    fn len(&self) -> usize {
        self.primitives.len()
    }

    fn primitive(&self, index: usize) -> Primitive {
        self.primitives[index]
    }

    fn objects(&self) -> &[Arc<Bvh>] {
        &self.objects
    }
}

impl Geometry {
    /// Adds a shape; says whether it is a sphere. If it is placed elsewhere, `build` makes the tree that is shown there.
    pub(super) fn add(
        &mut self,
        shape: &dyn ShapeDesc,
        placement: Option<&Placement>,
        build: impl Fn(&Self) -> Result<Bvh, BuildError>,
    ) -> Result<bool, BuildError> {
        let first = self.primitives.len();
        shape.push_primitives(&mut self.primitives);
        self.primitive_count += self.primitives.len() - first;
        let is_round = matches!(self.primitives.get(first), Some(Primitive::Sphere(_)));
        if let Some(placement) = placement {
            let own = Self { primitives: self.primitives.split_off(first), ..Self::default() };
            self.objects.push(Arc::new(build(&own)?));
            self.primitives.extend(placement.instances().iter().copied().map(Primitive::Instance));
        }
        Ok(is_round)
    }
}
