//! Why a command ended early, and the exit code that says so.

use eyebeam_io::Fault;

/// The exit code of a bug.
pub(crate) const INTERNAL: u8 = 1;

#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    #[error(transparent)]
    Io(#[from] eyebeam_io::Error),
    /// A scene that was read is refused by the renderer, which a reader's check should have found.
    #[error("error: {0}")]
    Scene(eyebeam_core::validate::Problem),
    #[error("error: {0}")]
    Usage(String),
    #[error("error: the picture would need {}, and {} are allowed\nhint: make it smaller (-r), or allow more (--memory)", bytes(*.needed), bytes(*.allowed))]
    Memory { needed: u64, allowed: u64 },
    #[error("error: cannot listen to signals: {0}")]
    Listen(std::io::Error),
    #[error(
        "error: {failures} of {count} checks failed\nhint: pictures of this program on this machine are not to be trusted; please report it"
    )]
    Selftest { failures: usize, count: usize },
    #[error("error: cannot write to standard output: {0}")]
    Stdout(std::io::Error),
    /// Ended by a signal; what there was of the picture is written.
    #[error("")]
    Signal(u8),
}

impl Error {
    /// What to say about it; nothing if it has been said.
    pub(crate) fn message(&self) -> Option<String> {
        match self {
            Self::Signal(_) => None,
            other => Some(other.to_string()),
        }
    }

    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) | Self::Io(eyebeam_io::Error::UnknownFormat { .. }) => 2,
            Self::Io(eyebeam_io::Error::Scene(all)) if all.iter().all(|d| d.fault == Fault::FileSystem) => 4,
            Self::Io(eyebeam_io::Error::Scene(all)) if all.iter().all(|d| d.fault == Fault::Memory) => 5,
            Self::Io(eyebeam_io::Error::File(e)) if e.fault == Fault::Memory => 5,
            Self::Io(eyebeam_io::Error::Scene(_) | eyebeam_io::Error::File(_)) | Self::Scene(_) => 3,
            Self::Io(eyebeam_io::Error::Io { .. }) | Self::Stdout(_) => 4,
            Self::Memory { .. } => 5,
            Self::Io(eyebeam_io::Error::Encode(_)) | Self::Listen(_) | Self::Selftest { .. } => INTERNAL,
            Self::Signal(number) => 128 + number,
        }
    }
}

/// `12.3 GiB`
pub(crate) fn bytes(n: u64) -> String {
    let units = ["B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"];
    let power = (n.max(1).ilog2() / 10) as usize;
    format!("{:.1} {}", n as f64 / (1_u64 << (10 * power)) as f64, units[power])
}
