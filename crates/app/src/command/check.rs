//! `eyebeam check`: every problem of a scene, without rendering it.

use crate::args::CheckArgs;
use crate::error::Error;
use crate::progress::say;

pub(super) fn run(args: &CheckArgs) -> Result<(), Error> {
    let desc = eyebeam_io::scene::read(&args.scene, &args.set)?;
    let shapes = &desc.shape;
    let triangles: usize = shapes.mesh.iter().map(|m| m.triangles.len()).sum();
    say(&format!(
        "{}: fine ({} spheres, {} quads, {triangles} triangles, {} materials)",
        args.scene.display(),
        shapes.sphere.len(),
        shapes.quad.len(),
        desc.material.len()
    ));
    Ok(())
}
