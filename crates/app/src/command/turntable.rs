//! `eyebeam turntable`: a model from all around.
//!
//! It is read and built once; from picture to picture the camera goes on about the model, and with it the light from outside, so that the
//! model seems to turn before a camera and lamps at rest.

use std::path::Path;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::setup::View;

use crate::args::TurntableArgs;
use crate::command::render::{Frame, Job, Outcome, stem};
use crate::command::target::Target;
use crate::error::Error;
use crate::signals::Signals;

pub(super) fn run(args: &TurntableArgs) -> Result<(), Error> {
    let model = stem(&args.scene).to_string_lossy().into_owned();
    let mut target = target(args, &model, 0)?;
    let mut job = Job::load(&args.picture, &args.scene, &mut target, true)?;
    let Some(turntable) = job.turntable.take() else {
        return Err(Error::Usage(format!("`{}` has nothing that could be turned", args.scene.display())));
    };
    let mut scene = job.build()?;
    let view = View { camera: job.desc.camera.clone(), environment: job.desc.environment.clone() };
    let signals = Signals::listen().map_err(Error::Listen)?;
    let (mut all, mut ended, mut encoding) = (Vec::new(), None, target.encoding);
    for frame in 0..args.frames {
        if frame > 0 {
            let View { camera, environment } = turntable.turned(&view, frame as f32 / args.frames as f32);
            let desc = SceneDesc { camera, environment, ..job.desc.clone() };
            scene = scene.seen(&desc).map_err(|mut problems| Error::Scene(problems.remove(0)))?;
        }
        let target = Target { encoding, ..self::target(args, &model, frame)? };
        encoding = target.encoding.clone();
        let Outcome { stats, exposure, signal } =
            job.picture(&scene, target, &signals, Some(Frame { frame, of: args.frames }))?;
        encoding.look.exposure = exposure;
        all.push(stats.trim_end().to_owned());
        ended = signal.or_else(|| signals.end().filter(|_| frame + 1 < args.frames));
        if ended.is_some() {
            break;
        }
    }
    let frames = all.join(",\n");
    job.write_stats(&format!("{{\"schema\": \"eyebeam-turntable-1\", \"frames\": [\n{frames}\n]}}\n"))?;
    ended.map_or(Ok(()), |signal| Err(Error::Signal(signal)))
}

/// Where a picture goes; its folder is made if there is none.
fn target(args: &TurntableArgs, model: &str, frame: u32) -> Result<Target, Error> {
    let target = Target::new(args.output.fill(model, frame), args.picture.look.encoding())?;
    let folder = target.path.parent().filter(|folder| *folder != Path::new(""));
    if let Some(folder) = folder {
        let refused = |source| eyebeam_io::Error::Io { action: "write", path: folder.to_owned(), source };
        std::fs::create_dir_all(folder).map_err(refused)?;
    }
    Ok(target)
}
