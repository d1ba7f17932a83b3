//! A lamp for a room that has none.

use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::material::{Emissive, MaterialDesc};
use crate::setup::extent::Extent;
use crate::setup::unused;
use crate::shape::QuadDesc;

/// A pane of light under the ceiling.
pub(super) fn add(desc: &mut SceneDesc, extent: &Extent) {
    /// Of the shorter side of the room.
    const WIDTH: f32 = 0.3;
    /// Under the ceiling, of the height of the room.
    const UNDER: f32 = 0.02;
    let (size, center) = (extent.max - extent.min, extent.center());
    let half = 0.5 * WIDTH * size.x.min(size.z);
    let name = unused(desc, "lamp");
    let light = Emissive { radiance: Rgb::grey(10.0).into(), albedo: Rgb::grey(0.0).into(), two_sided: false };
    desc.material.insert(name.clone(), MaterialDesc::Emissive(light));
    desc.shape.quad.push(QuadDesc {
        corner: [center.x - half, extent.max.y - UNDER * size.y, center.z - half],
        // It looks down.
        u: [2.0 * half, 0.0, 0.0],
        v: [0.0, 0.0, 2.0 * half],
        material: Some(name),
        ..QuadDesc::default()
    });
}
