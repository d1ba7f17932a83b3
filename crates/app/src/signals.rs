//! Signals: asked to end, a render finishes its units of work and writes the picture; asked twice, it leaves at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

/// What the process has been asked for since it began to listen.
#[derive(Default)]
pub(crate) struct Signals {
    /// The signal that asks to end; 0 if none came.
    end: Arc<AtomicUsize>,
    write: Arc<AtomicBool>,
}

impl Signals {
    /// Begins to listen to SIGINT, SIGTERM, SIGHUP and SIGUSR1.
    #[cfg(unix)]
    pub(crate) fn listen() -> std::io::Result<Self> {
        use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1};
        use signal_hook::flag;
        let signals = Self::default();
        let asked = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            // The order matters: the second signal finds `asked` set, the first does not.
            flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&asked))?;
            flag::register(signal, Arc::clone(&asked))?;
            flag::register_usize(signal, Arc::clone(&signals.end), signal as usize)?;
        }
        for signal in [SIGHUP, SIGUSR1] {
            flag::register(signal, Arc::clone(&signals.write))?;
        }
        Ok(signals)
    }

    /// Begins to listen to Ctrl-C.
    #[cfg(not(unix))]
    pub(crate) fn listen() -> std::io::Result<Self> {
        use signal_hook::consts::SIGINT;
        let signals = Self::default();
        signal_hook::flag::register_usize(SIGINT, Arc::clone(&signals.end), SIGINT as usize)?;
        Ok(signals)
    }

    /// The number of the signal that asks to end.
    pub(crate) fn end(&self) -> Option<u8> {
        Some(self.end.load(Relaxed) as u8).filter(|&signal| signal != 0)
    }

    /// Whether anything was asked that needs the render to pause.
    pub(crate) fn any(&self) -> bool {
        self.end().is_some() || self.write.load(Relaxed)
    }

    /// Whether the picture as it is was asked for, since this was last called.
    pub(crate) fn take_write(&self) -> bool {
        self.write.swap(false, Relaxed)
    }
}
