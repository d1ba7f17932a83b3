//! The tree of the second book, Ray Tracing: The Next Week, as its text leads one to write it.
//!
//! A node is a hittable that holds two others behind shared pointers, and a box around both; objects are sorted along the longest
//! axis of their box and parted in the middle. Left always comes before right.
//!
//! Shirley, Black & Hollasch, Ray Tracing: The Next Week, version 4.

use std::sync::Arc;

use eyebeam_core::desc::SceneDesc;

use super::{HitRecord, Hittable, HittableList, Ray, Textbook};
use crate::vec3::Vec3;

/// A box with sides along the axes.
#[derive(Clone, Copy)]
pub(super) struct Aabb {
    pub(super) minimum: Vec3,
    pub(super) maximum: Vec3,
}

impl Aabb {
    /// The box around objects.
    pub(super) fn around(objects: &[Arc<dyn Hittable>]) -> Self {
        let infinity = Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let empty = Self { minimum: infinity, maximum: -infinity };
        objects.iter().fold(empty, |bounds, object| bounds.surrounding(object.bounding_box()))
    }

    fn surrounding(self, other: Self) -> Self {
        let (a, b) = (self.minimum, other.minimum);
        let minimum = Vec3::new(a.x.min(b.x), a.y.min(b.y), a.z.min(b.z));
        let (a, b) = (self.maximum, other.maximum);
        let maximum = Vec3::new(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z));
        Self { minimum, maximum }
    }

    fn longest_axis(self) -> fn(Vec3) -> f64 {
        let size = self.maximum - self.minimum;
        if size.x > size.y && size.x > size.z {
            |v| v.x
        } else if size.y > size.z {
            |v| v.y
        } else {
            |v| v.z
        }
    }

    fn hit(&self, ray: &Ray, mut t_min: f64, mut t_max: f64) -> bool {
        let axes = [
            (self.minimum.x, self.maximum.x, ray.origin.x, ray.direction.x),
            (self.minimum.y, self.maximum.y, ray.origin.y, ray.direction.y),
            (self.minimum.z, self.maximum.z, ray.origin.z, ray.direction.z),
        ];
        for (minimum, maximum, origin, direction) in axes {
            let inverse = 1.0 / direction;
            let (mut t0, mut t1) = ((minimum - origin) * inverse, (maximum - origin) * inverse);
            if inverse < 0.0 {
                std::mem::swap(&mut t0, &mut t1);
            }
            t_min = if t0 > t_min { t0 } else { t_min };
            t_max = if t1 < t_max { t1 } else { t_max };
            if t_max <= t_min {
                return false;
            }
        }
        true
    }
}

struct BvhNode {
    left: Arc<dyn Hittable>,
    right: Arc<dyn Hittable>,
    bounds: Aabb,
}

impl BvhNode {
    /// There is at least one object.
    fn new(objects: &mut [Arc<dyn Hittable>]) -> Self {
        let bounds = Aabb::around(objects);
        let axis = bounds.longest_axis();
        let (left, right): (Arc<dyn Hittable>, Arc<dyn Hittable>) = match objects {
            [one] => (one.clone(), one.clone()),
            [left, right] => (left.clone(), right.clone()),
            _ => {
                let key = |object: &Arc<dyn Hittable>| axis(object.bounding_box().minimum);
                objects.sort_by(|a, b| key(a).total_cmp(&key(b)));
                let (left, right) = objects.split_at_mut(objects.len() / 2);
                (Arc::new(Self::new(left)), Arc::new(Self::new(right)))
            }
        };
        Self { left, right, bounds }
    }
}

impl Hittable for BvhNode {
    fn hit(&self, ray: &Ray, t_min: f64, t_max: f64) -> Option<HitRecord<'_>> {
        if !self.bounds.hit(ray, t_min, t_max) {
            return None;
        }
        let left = self.left.hit(ray, t_min, t_max);
        let right = self.right.hit(ray, t_min, left.as_ref().map_or(t_max, |hit| hit.t));
        right.or(left)
    }

    fn bounding_box(&self) -> Aabb {
        self.bounds
    }
}

impl From<&eyebeam_core::scene::Ray> for Ray {
    fn from(ray: &eyebeam_core::scene::Ray) -> Self {
        Self { origin: ray.o.to_array().into(), direction: ray.d.to_array().into() }
    }
}

/// The book's two ways to find what a ray hits.
pub struct Queries {
    list: HittableList,
    tree: BvhNode,
}

impl Queries {
    /// For the spheres of a scene.
    ///
    /// # Errors
    /// No spheres, and what the book does not know.
    pub fn new(desc: &SceneDesc) -> Result<Self, String> {
        let list = Textbook::new(desc)?.world;
        if list.objects.is_empty() {
            return Err("a tree needs something to hold".to_owned());
        }
        let tree = BvhNode::new(&mut list.objects.clone());
        Ok(Self { list, tree })
    }

    /// The distance to the nearest hit: all are asked.
    pub fn by_list(&self, ray: &Ray) -> Option<f64> {
        nearest(&self.list, ray)
    }

    /// The distance to the nearest hit: the tree is asked.
    pub fn by_tree(&self, ray: &Ray) -> Option<f64> {
        nearest(&self.tree, ray)
    }
}

/// As the book's `ray_color` asks, through a virtual call.
fn nearest(world: &dyn Hittable, ray: &Ray) -> Option<f64> {
    std::hint::black_box(world.hit(ray, 0.001, f64::INFINITY)).map(|hit| hit.t)
}

#[cfg(test)]
mod tests {
    use crate::kernel::few_spheres;

    use super::*;

    #[test]
    fn tree_and_list_agree() {
        let desc = crate::measure::read_scene("weekend").unwrap();
        let queries = Queries::new(&desc).unwrap();
        let rays = few_spheres::record(&desc, 32).unwrap();
        assert!(rays.len() > 1000);
        for ray in rays.iter().map(Ray::from) {
            assert_eq!(queries.by_list(&ray), queries.by_tree(&ray));
        }
    }
}
