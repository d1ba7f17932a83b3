//! How much care a build takes.

use std::fmt;
use std::str::FromStr;

/// Which builder makes the tree. The hits are the same, bit by bit; the time to build and to trace differs, and the memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// Sorted along a space-filling curve and merged: for viewers and animation.
    Fast,
    /// The binned surface area heuristic.
    #[default]
    Balanced,
    /// As balanced, and large primitives are split between leaves: for long renders.
    Best,
}

impl Quality {
    /// All, from the fastest build to the fastest rays.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Balanced, Self::Best];

    /// The quality that takes the least time in all, for a number of rays that is known roughly beforehand: samples times
    /// pixels times the length of paths.
    pub fn auto(rays: u64, primitives: usize) -> Self {
        // A better tree saves some tenths of the time of a ray, and costs about as much per primitive as a ray or two.
        let per_primitive = rays / (primitives as u64).max(1);
        match per_primitive {
            0 => Self::Fast,
            1..=19 => Self::Balanced,
            _ => Self::Best,
        }
    }

    /// The name, as in options: `fast`, `balanced` or `best`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Balanced => "balanced",
            Self::Best => "best",
        }
    }
}

impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Quality {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|quality| quality.name() == name);
        found.ok_or_else(|| format!("no quality is called `{name}`: there are fast, balanced and best"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_takes_more_care_the_more_rays_there_are() {
        const TRIANGLES: usize = 1_000_000;
        let auto = |rays_per_triangle: f64| Quality::auto((rays_per_triangle * TRIANGLES as f64) as u64, TRIANGLES);
        assert_eq!([0.0, 0.5].map(auto), [Quality::Fast; 2], "a glance at a large model");
        assert_eq!([1.0, 10.0].map(auto), [Quality::Balanced; 2]);
        assert_eq!([20.0, 1e6].map(auto), [Quality::Best; 2], "a long render");
        assert_eq!((Quality::auto(0, 0), Quality::auto(u64::MAX, 0)), (Quality::Fast, Quality::Best));
    }

    #[test]
    fn names_are_read_as_they_are_written() {
        assert!(Quality::ALL.into_iter().all(|quality| quality.to_string().parse() == Ok(quality)));
        assert!("auto-ish".parse::<Quality>().is_err());
    }
}
