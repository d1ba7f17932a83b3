//! `eyebeam check`: every problem of a scene, without rendering it.

use eyebeam_core::shape::MeshDesc;
use eyebeam_io::scene::{ReadOptions, read_with};

use crate::args::CheckArgs;
use crate::command::report::{self, Talk};
use crate::error::Error;
use crate::progress::say;

pub(super) fn run(args: &CheckArgs) -> Result<(), Error> {
    let options = ReadOptions { memory: Some(args.memory), ..args.model.options(&args.set) };
    let desc = report::say_of(read_with(&args.scene, &options)?, args.strict, Talk::All)?.desc;
    let shapes = &desc.shape;
    let triangles: usize = shapes.mesh.iter().map(MeshDesc::triangle_count).sum();
    say(&format!(
        "{}: fine ({} spheres, {} quads, {triangles} triangles, {} materials)",
        args.scene.display(),
        shapes.sphere.len(),
        shapes.quad.len(),
        desc.material.len()
    ));
    Ok(())
}
