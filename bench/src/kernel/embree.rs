//! Embree 4, loaded when the program runs: the kernel that ours is measured against.
//!
//! Only what the measurement needs is declared here, after `rtcore.h` of Embree 4.4 (Apache-2.0). The library is looked for
//! at the path in `EMBREE_LIB`, then below `target/embree`, where `make bench-kernel` unpacks it.
//!
//! This is the one file of the program with unsafe code.
#![allow(unsafe_code)]

use std::env;
use std::ffi::{CString, c_char, c_uint, c_void};
use std::fs;
use std::path::{Path, PathBuf};
use std::ptr;
use std::sync::atomic::{AtomicIsize, Ordering::Relaxed};

use eyebeam_bvh::Ray;
use glam::Vec3;
use libloading::Library;

use super::meshes::Model;
use super::tracer::Tracer;

type Handle = *mut c_void;
type MemoryMonitor = unsafe extern "C" fn(Handle, isize, bool) -> bool;

/// No primitive, geometry or instance.
const INVALID_ID: c_uint = c_uint::MAX;
const GEOMETRY_TYPE_TRIANGLE: c_uint = 0;
const BUFFER_TYPE_INDEX: c_uint = 0;
const BUFFER_TYPE_VERTEX: c_uint = 1;
/// Rays pass between no two triangles that share an edge.
const SCENE_FLAG_ROBUST: c_uint = 4;
const FORMAT_UINT3: c_uint = 0x5003;
const FORMAT_FLOAT3: c_uint = 0x9003;

/// How much time a build takes for a better tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum BuildQuality {
    Low = 0,
    Medium = 1,
    High = 2,
}

/// `RTCRay`.
#[repr(C, align(16))]
struct RtcRay {
    org: Vec3,
    tnear: f32,
    dir: Vec3,
    time: f32,
    tfar: f32,
    mask: c_uint,
    id: c_uint,
    flags: c_uint,
}

impl From<&Ray> for RtcRay {
    #[inline]
    fn from(ray: &Ray) -> Self {
        Self { org: ray.o, tnear: 0.0, dir: ray.d, time: 0.0, tfar: ray.t_max, mask: !0, id: 0, flags: 0 }
    }
}

/// `RTCRayHit`, of a library that is built for one level of instances, as it is by default.
#[repr(C, align(16))]
struct RtcRayHit {
    ray: RtcRay,
    normal: Vec3,
    u: f32,
    v: f32,
    prim_id: c_uint,
    geom_id: c_uint,
    instances: [c_uint; 2],
}

/// Declares the functions and where they are looked up.
macro_rules! api {
    ($($name:ident: fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// The functions of the library.
        #[allow(non_snake_case)]
        struct Api {
            $($name: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
        }

        impl Api {
            fn load(path: &Path) -> Result<Self, libloading::Error> {
                // SAFETY: loading Embree runs the initialisers of its globals, which ask nothing of the caller.
                let library = unsafe { Library::new(path) }?;
                // Never unloaded: its threads may run for a while after the last device was released.
                let library: &'static Library = Box::leak(Box::new(library));
                Ok(Self {
                    // SAFETY: the types are those of `rtcore.h`.
                    $($name: *unsafe { library.get(concat!(stringify!($name), "\0").as_bytes()) }?,)*
                })
            }
        }
    };
}

api! {
    rtcNewDevice: fn(*const c_char) -> Handle;
    rtcReleaseDevice: fn(Handle);
    rtcGetDeviceError: fn(Handle) -> c_uint;
    rtcSetDeviceMemoryMonitorFunction: fn(Handle, MemoryMonitor, Handle);
    rtcNewScene: fn(Handle) -> Handle;
    rtcReleaseScene: fn(Handle);
    rtcSetSceneBuildQuality: fn(Handle, c_uint);
    rtcSetSceneFlags: fn(Handle, c_uint);
    rtcCommitScene: fn(Handle);
    rtcNewGeometry: fn(Handle, c_uint) -> Handle;
    rtcReleaseGeometry: fn(Handle);
    rtcSetGeometryBuildQuality: fn(Handle, c_uint);
    rtcSetSharedGeometryBuffer: fn(Handle, c_uint, c_uint, c_uint, *const c_void, usize, usize, usize);
    rtcCommitGeometry: fn(Handle);
    rtcAttachGeometry: fn(Handle, Handle) -> c_uint;
    rtcIntersect1: fn(Handle, *mut RtcRayHit, *const c_void);
    rtcOccluded1: fn(Handle, *mut RtcRay, *const c_void);
}

/// The library.
pub struct Embree {
    api: Api,
}

impl Embree {
    /// Finds and loads the library.
    ///
    /// # Errors
    /// If it is not there, or is not Embree 4: what to do about it.
    pub fn load() -> Result<Self, String> {
        const HINT: &str =
            "`make bench-kernel` gets it from the Python package embreex; or set EMBREE_LIB to libembree4.so";
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../target/embree"));
        let path = env::var_os("EMBREE_LIB").map(PathBuf::from).or_else(|| find(folder));
        let path =
            path.ok_or_else(|| format!("no Embree in target/embree, so there are no columns for it\nhint: {HINT}"))?;
        let api = Api::load(&path).map_err(|e| format!("{} is not Embree 4: {e}\nhint: {HINT}", path.display()))?;
        Ok(Self { api })
    }
}

/// The library, anywhere below a folder.
fn find(folder: &Path) -> Option<PathBuf> {
    let mut paths: Vec<_> = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    paths.into_iter().find_map(|path| {
        let name = path.file_name()?.to_string_lossy().into_owned();
        if path.is_dir() {
            find(&path)
        } else {
            (name.starts_with("libembree4") && name.contains(".so")).then_some(path)
        }
    })
}

/// Adds up what a device has allocated and not yet freed.
///
/// # Safety
/// `bytes_held` points to an [`AtomicIsize`] that outlives the device.
unsafe extern "C" fn count_memory(bytes_held: Handle, change: isize, _is_after: bool) -> bool {
    // SAFETY: as promised by the caller.
    unsafe { &*bytes_held.cast::<AtomicIsize>() }.fetch_add(change, Relaxed);
    true
}

/// A device and on it a scene of one mesh.
///
/// The handles are valid from `new` to `drop`.
pub(crate) struct EmbreeScene<'e> {
    api: &'e Api,
    device: Handle,
    scene: Handle,
    bytes_held: Box<AtomicIsize>,
    /// Embree reads vertices and triangles from here. Vertices are read 16 bytes at once, so one more follows the last.
    _vertices: Vec<Vec3>,
    _triangles: Vec<[u32; 3]>,
}

// SAFETY: once committed, a scene may be asked by any number of threads, says the documentation of Embree; after `commit`, which
// takes `&mut self`, nothing else is done to it before it is dropped.
unsafe impl Sync for EmbreeScene<'_> {}

impl<'e> EmbreeScene<'e> {
    /// Prepares all that [`commit`](Self::commit) needs.
    pub(crate) fn new(
        embree: &'e Embree,
        model: &Model,
        quality: BuildQuality,
        threads: usize,
    ) -> Result<Self, String> {
        let api = &embree.api;
        let mut vertices = model.vertices.clone();
        vertices.push(Vec3::ZERO);
        let triangles = model.triangles.clone();
        let bytes_held = Box::new(AtomicIsize::new(0));
        let config = CString::new(format!("threads={threads}")).map_err(|e| e.to_string())?;
        // SAFETY: `config` is a string that ends with zero.
        let device = unsafe { (api.rtcNewDevice)(config.as_ptr()) };
        if device.is_null() {
            return Err("Embree makes no device".to_owned());
        }
        // SAFETY: the device is valid; the counter is on the heap and freed after the device (see `drop`).
        unsafe {
            (api.rtcSetDeviceMemoryMonitorFunction)(
                device,
                count_memory,
                ptr::from_ref(&*bytes_held).cast_mut().cast(),
            );
        }
        // SAFETY: all handles come from Embree and are valid. The buffers stay where they are, unchanged, until the scene has
        // been released; they hold as many items of 12 bytes as is said here, and vertices the padding that is asked for.
        let scene = unsafe {
            let scene = (api.rtcNewScene)(device);
            (api.rtcSetSceneBuildQuality)(scene, quality as c_uint);
            let geometry = (api.rtcNewGeometry)(device, GEOMETRY_TYPE_TRIANGLE);
            (api.rtcSetGeometryBuildQuality)(geometry, quality as c_uint);
            let set = |kind, format, data: *const c_void, count| {
                (api.rtcSetSharedGeometryBuffer)(geometry, kind, 0, format, data, 0, 12, count);
            };
            set(BUFFER_TYPE_VERTEX, FORMAT_FLOAT3, vertices.as_ptr().cast(), vertices.len() - 1);
            set(BUFFER_TYPE_INDEX, FORMAT_UINT3, triangles.as_ptr().cast(), triangles.len());
            (api.rtcCommitGeometry)(geometry);
            (api.rtcAttachGeometry)(scene, geometry);
            (api.rtcReleaseGeometry)(geometry);
            scene
        };
        Ok(Self { api, device, scene, bytes_held, _vertices: vertices, _triangles: triangles })
    }

    /// Builds the tree. Returns the bytes that it holds.
    pub(crate) fn commit(&mut self) -> Result<usize, String> {
        let before = self.bytes_held.load(Relaxed);
        // SAFETY: the handles are valid.
        let error = unsafe {
            (self.api.rtcCommitScene)(self.scene);
            (self.api.rtcGetDeviceError)(self.device)
        };
        match error {
            0 => Ok(usize::try_from(self.bytes_held.load(Relaxed) - before).unwrap_or(0)),
            code => Err(format!("Embree reports error {code}")),
        }
    }

    /// A scene that is ready for rays, built on one thread.
    pub(crate) fn build(embree: &'e Embree, model: &Model, quality: BuildQuality) -> Result<Self, String> {
        let mut scene = Self::new(embree, model, quality, 1)?;
        scene.commit()?;
        Ok(scene)
    }

    /// As [`build`](Self::build), of high quality, and watertight as our kernel is.
    pub(crate) fn build_robust(embree: &'e Embree, model: &Model) -> Result<Self, String> {
        let mut scene = Self::new(embree, model, BuildQuality::High, 1)?;
        // SAFETY: the handle is valid.
        unsafe { (scene.api.rtcSetSceneFlags)(scene.scene, SCENE_FLAG_ROBUST) };
        scene.commit()?;
        Ok(scene)
    }
}

impl Drop for EmbreeScene<'_> {
    fn drop(&mut self) {
        // SAFETY: the handles are valid and not used again; buffers and counter are dropped after this.
        unsafe {
            (self.api.rtcReleaseScene)(self.scene);
            (self.api.rtcReleaseDevice)(self.device);
        }
    }
}

impl Tracer for EmbreeScene<'_> {
    fn closest(&self, rays: &[Ray], distances: &mut [f32]) {
        for (ray, distance) in rays.iter().zip(distances) {
            let mut query = RtcRayHit {
                ray: RtcRay::from(ray),
                normal: Vec3::ZERO,
                u: 0.0,
                v: 0.0,
                prim_id: INVALID_ID,
                geom_id: INVALID_ID,
                instances: [INVALID_ID; 2],
            };
            // SAFETY: the scene is valid; the query is laid out and aligned as `rtcore.h` says. Null stands for the defaults.
            unsafe { (self.api.rtcIntersect1)(self.scene, &raw mut query, ptr::null()) };
            *distance = if query.geom_id == INVALID_ID { f32::INFINITY } else { query.ray.tfar };
        }
    }

    fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        for (ray, occluded) in rays.iter().zip(occluded) {
            let mut query = RtcRay::from(ray);
            // SAFETY: as in `closest`.
            unsafe { (self.api.rtcOccluded1)(self.scene, &raw mut query, ptr::null()) };
            *occluded = query.tfar < 0.0;
        }
    }
}
