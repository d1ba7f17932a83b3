//! Files that are damaged, or made to do harm: an error with the name of the file, soon, and in little memory.

mod bad;
mod codecs;
#[path = "../shared/corpus.rs"]
mod corpus;
mod damage;
#[path = "../shared/glb.rs"]
mod glb;
mod memory;
mod names;
#[path = "../shared/pictures.rs"]
mod pictures;
mod samples;

use std::alloc::{GlobalAlloc, Layout, System};
use std::collections::BTreeMap;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::mpsc::channel;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use eyebeam_io::Error;
use eyebeam_io::ies::read_ies_bytes;
use eyebeam_io::image::{pixels_size, read_image_bytes, read_linear_bytes, read_pixels_bytes};
use eyebeam_io::scene::{Files, ReadOptions, read_bytes};

/// Reading anything here takes a moment; whatever takes so long hangs.
const HANGS: Duration = Duration::from_secs(60);

/// The system's allocator, which counts.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

// SAFETY: the system's allocator does it all.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let now = NOW.fetch_add(layout.size(), Relaxed) + layout.size();
        PEAK.fetch_max(now, Relaxed);
        // SAFETY: the caller's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller's.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What is allocated counts for all threads, so one test runs at a time: each holds this.
fn alone() -> MutexGuard<'static, ()> {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Does something that must end; returns what comes out, and the most bytes that it has had at once.
fn watched<T: Send>(what: &str, work: impl FnOnce() -> T + Send) -> (T, usize) {
    let (done, is_done) = channel();
    thread::scope(|scope| {
        let watcher = scope.spawn(move || is_done.recv_timeout(HANGS).is_err());
        let before = NOW.load(Relaxed);
        PEAK.store(before, Relaxed);
        let result = work();
        let peak = PEAK.load(Relaxed).saturating_sub(before);
        let is_told = done.send(()).is_ok();
        assert!(!watcher.join().unwrap_or(true) && is_told, "{what} took longer than {HANGS:?}");
        (result, peak)
    })
}

/// Reads bytes as the file whose name they have. A library of materials is that of a triangle.
fn read_as(name: &str, bytes: &[u8], options: &ReadOptions<'_>) -> Result<(), Error> {
    match name.rsplit_once('.').unwrap_or_default().1 {
        "exr" | "hdr" | "png" | "jpg" | "webp" | "ktx2" => {
            let image = read_image_bytes(name, bytes).map(drop);
            let pixels = read_pixels_bytes(name, bytes);
            assert_eq!(image.is_ok(), pixels.is_ok());
            if let Ok((pixels, _)) = &pixels {
                assert!(pixels_size(name, bytes).unwrap() >= pixels.bytes() as u64);
            }
            assert!(read_linear_bytes(name, bytes).is_err() || image.is_ok());
            image
        }
        "ies" => read_ies_bytes(name, bytes).map(drop),
        "mtl" => {
            let files = BTreeMap::from([("a.mtl".to_owned(), bytes.to_vec())]);
            read_bytes("a.obj", samples::OBJ.as_bytes(), Files::Given(&files), options).map(drop)
        }
        _ => {
            let file = read_bytes(name, bytes, Files::None, options)?;
            for data in file.desc.shape.mesh.iter().filter_map(|mesh| mesh.data.as_ref()) {
                assert!(data.triangles.iter().flatten().all(|&i| (i as usize) < data.vertices.len()));
            }
            Ok(())
        }
    }
}

/// Reads bytes, posed where they have an animation: they are read or refused by their name, in time. What is said, if anything.
fn attempt(name: &str, bytes: &[u8]) -> Option<String> {
    // What has none has nothing to choose.
    let animation = Some("0").filter(|_| name.starts_with("model.gl"));
    let options = ReadOptions { animation, at: 0.25, ..ReadOptions::default() };
    let error = watched(name, || read_as(name, bytes, &options)).0.err()?.to_string();
    assert!(error.contains(name.trim_end_matches(".mtl")), "{name}: {error}");
    Some(error)
}

/// The next of a row of numbers that are as if by chance. Steele et al. 2014, doi:10.1145/2714064.2660195.
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
