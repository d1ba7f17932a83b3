//! What a camera ray brings: its light, with what it saw of the background kept apart.

use crate::color::Spectrum;

/// The light that a camera ray brings.
///
/// A ray sees the background directly, or through smooth clear glass. What mirrors show of it is light of the scene: nothing
/// could be put behind it later.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Light from the scene, and of the background what its surfaces reflect.
    pub l: Spectrum,
    /// Light of the background that the ray saw; none if it ended at a surface.
    pub background: Option<Spectrum>,
}

impl Seen {
    /// A place of the film to which no light comes.
    pub const NOTHING: Self = Self { l: Spectrum::BLACK, background: Some(Spectrum::BLACK) };

    /// Light of a path that ended at a surface.
    #[inline]
    pub fn surface(l: Spectrum) -> Self {
        Self { l, background: None }
    }

    /// Light of a path that left the scene: `l` from its surfaces, `le` from outside. It is `clear` if it was only ever
    /// refracted.
    #[inline]
    pub fn outside(l: Spectrum, le: Spectrum, clear: bool) -> Self {
        if clear { Self { l, background: Some(le) } } else { Self::surface(l + le) }
    }

    /// All of it.
    #[inline]
    pub fn light(&self) -> Spectrum {
        self.background.map_or(self.l, |background| self.l + background)
    }
}
