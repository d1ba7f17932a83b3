//! How much memory the files of a scene may take.

use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

use crate::error::{Fault, FileError};

/// What they may take if nothing is said.
const USUAL: u64 = 16 << 30;

/// Counts what is about to be allocated.
#[derive(Debug)]
pub(crate) struct Memory {
    allowed: u64,
    taken: AtomicU64,
}

impl Memory {
    /// Of so many bytes, or of as many as are usual.
    pub(crate) fn new(allowed: Option<u64>) -> Self {
        Self { allowed: allowed.unwrap_or(USUAL), taken: AtomicU64::new(0) }
    }

    /// Counts memory that is about to be used.
    ///
    /// # Errors
    /// If there is not so much left; then it is not counted.
    pub(crate) fn take(&self, bytes: u64) -> Result<(), FileError> {
        self.check(bytes)?;
        self.taken.fetch_add(bytes, Relaxed);
        Ok(())
    }

    /// As [`take`](Self::take), without counting.
    ///
    /// # Errors
    /// If there is not so much left.
    pub(crate) fn check(&self, bytes: u64) -> Result<(), FileError> {
        let needed = self.taken.load(Relaxed).saturating_add(bytes);
        if needed <= self.allowed {
            return Ok(());
        }
        let (needed, allowed) = (mebibytes(needed), self.allowed >> 20);
        let message = format!("it would take {needed} MiB of memory, and {allowed} MiB are allowed");
        Err(FileError {
            fault: Fault::Memory,
            ..FileError::new(message).hint("allow more (--memory), or make it smaller")
        })
    }

    /// Bytes that were counted.
    pub(crate) fn taken(&self) -> u64 {
        self.taken.load(Relaxed)
    }
}

fn mebibytes(bytes: u64) -> u64 {
    bytes.div_ceil(1 << 20)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_refused_is_not_counted() {
        let memory = Memory::new(Some(3 << 20));
        memory.take(2 << 20).unwrap();
        let error = memory.take(u64::MAX).unwrap_err();
        assert_eq!(error.fault, Fault::Memory);
        let error = memory.take((1 << 20) + 1).unwrap_err();
        assert_eq!(error.message, "it would take 4 MiB of memory, and 3 MiB are allowed");
        memory.take(1 << 20).unwrap();
        assert_eq!(memory.taken(), 3 << 20);
    }
}
