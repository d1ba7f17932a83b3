//! No curve: linear light as it is, clipped at 1.
//!
//! ```text
//! s = min(c, 1)
//! ```
//!
//! For measurements, and for textures that are no colours. Screens show it too dark: it is no signal of theirs.

pub(super) fn signal(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(|c| c.min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_as_they_are() {
        assert_eq!(signal([0.25, 1.0, 7.0]), [0.25, 1.0, 1.0]);
    }
}
