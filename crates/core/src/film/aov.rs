//! What a picture tells besides light: arbitrary output variables, as channels of numbers.
//!
//! Names of channels are those that readers of OpenEXR know.

use glam::{Vec2, Vec3};

use crate::film::Film;

/// A quantity that is known of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aov {
    /// Share of the light that the surface scatters back, 0..1: `albedo.R`, `.G`, `.B`.
    Albedo,
    /// Shading normal, in the world: `N.X`, `.Y`, `.Z`.
    Normal,
    /// Normal of the shape itself, in the world: `Ng.X`, `.Y`, `.Z`.
    GeometricNormal,
    /// Distance from the camera's plane, along its axis, metres: `Z`.
    Depth,
    /// Distance along the ray, metres: `distance.Z`.
    Distance,
    /// The point in the world, metres: `P.X`, `.Y`, `.Z`.
    Position,
    /// The point on the shape, 0..1: `uv.U`, `.V`.
    Uv,
    /// Numbers of shape, material and instance, from 1; 0 is nothing: `id.object`, `id.material`, `id.instance`.
    Id,
    /// The square of the standard error of each channel of the picture: `variance.R`, `.G`, `.B`.
    Variance,
    /// Samples that the pixel was made of: `spp.Y`.
    Spp,
}

impl Aov {
    /// Every quantity by its name.
    pub const NAMES: &[(&str, Self)] = &[
        ("albedo", Self::Albedo),
        ("normal", Self::Normal),
        ("geometric-normal", Self::GeometricNormal),
        ("depth", Self::Depth),
        ("distance", Self::Distance),
        ("position", Self::Position),
        ("uv", Self::Uv),
        ("id", Self::Id),
        ("variance", Self::Variance),
        ("spp", Self::Spp),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, aov)| *aov == self).map_or("", |(name, _)| name)
    }

    /// Whether it is what a [`FirstHit`] says; else the film knows it.
    pub fn is_of_first_hit(self) -> bool {
        !matches!(self, Self::Variance | Self::Spp)
    }

    /// The number of its channels.
    pub fn channel_count(self) -> usize {
        match self {
            Self::Depth | Self::Distance | Self::Spp => 1,
            Self::Uv => 2,
            _ => 3,
        }
    }
}

/// What the camera sees first through a pixel.
///
/// Ids are those at its centre. All else is a mean over the pixel's samples by the weights of its filter, where those below
/// zero count as zero: of albedo and normals over all samples, where nothing is 0, as light is; of places only over the
/// samples that hit, so that they stay on surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// See [`Aov::Albedo`].
    pub albedo: [f32; 3],
    /// See [`Aov::Normal`]. Shorter than 1 where normals differ.
    pub ns: Vec3,
    /// See [`Aov::GeometricNormal`].
    pub n: Vec3,
    /// See [`Aov::Depth`]. Infinite where nothing is.
    pub depth: f32,
    /// See [`Aov::Distance`]. Infinite where nothing is.
    pub distance: f32,
    /// See [`Aov::Position`]. 0 where nothing is.
    pub p: Vec3,
    /// See [`Aov::Uv`]. 0 where nothing is.
    pub uv: Vec2,
    /// See [`Aov::Id`].
    pub ids: Ids,
}

/// Numbers of what is seen, from 1; 0 is nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ids {
    /// Of the shape.
    pub object: u32,
    /// Of its material.
    pub material: u32,
    /// Of the instance that it is part of.
    pub instance: u32,
}

impl FirstHit {
    /// Nothing is there.
    pub const NOTHING: Self = Self {
        albedo: [0.0; 3],
        ns: Vec3::ZERO,
        n: Vec3::ZERO,
        depth: f32::INFINITY,
        distance: f32::INFINITY,
        p: Vec3::ZERO,
        uv: Vec2::ZERO,
        ids: Ids { object: 0, material: 0, instance: 0 },
    };
}

/// One number of every pixel, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// As it is called in a file.
    pub name: &'static str,
    /// The numbers.
    pub values: Values,
}

/// The numbers of a channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Quantities.
    Float(Vec<f32>),
    /// Names for something, which must not be mixed.
    Id(Vec<u32>),
}

/// The channels of some quantities; `hits` is there if one of them is [of the first hit](Aov::is_of_first_hit).
pub fn channels(aovs: &[Aov], hits: &[FirstHit], film: &Film) -> Vec<Channel> {
    let of_hits = |aov: Aov| match aov {
        Aov::Albedo => floats(["albedo.R", "albedo.G", "albedo.B"], hits, |h| h.albedo),
        Aov::Normal => floats(["N.X", "N.Y", "N.Z"], hits, |h| h.ns.into()),
        Aov::GeometricNormal => floats(["Ng.X", "Ng.Y", "Ng.Z"], hits, |h| h.n.into()),
        Aov::Depth => floats(["Z"], hits, |h| [h.depth]),
        Aov::Distance => floats(["distance.Z"], hits, |h| [h.distance]),
        Aov::Position => floats(["P.X", "P.Y", "P.Z"], hits, |h| h.p.into()),
        Aov::Uv => floats(["uv.U", "uv.V"], hits, |h| h.uv.into()),
        Aov::Id => ids(hits),
        Aov::Variance => floats(["variance.R", "variance.G", "variance.B"], &film.variance(), |&v| v),
        Aov::Spp => floats(["spp.Y"], &film.counts(), |&count| [count as f32]),
    };
    aovs.iter().copied().flat_map(of_hits).collect()
}

fn floats<T, const N: usize>(names: [&'static str; N], pixels: &[T], f: impl Fn(&T) -> [f32; N]) -> Vec<Channel> {
    let channel = |(i, name)| Channel { name, values: Values::Float(pixels.iter().map(|pixel| f(pixel)[i]).collect()) };
    names.into_iter().enumerate().map(channel).collect()
}

fn ids(hits: &[FirstHit]) -> Vec<Channel> {
    let channel = |name, f: fn(&Ids) -> u32| {
        let values = hits.iter().map(|hit| f(&hit.ids)).collect();
        Channel { name, values: Values::Id(values) }
    };
    vec![
        channel("id.object", |ids| ids.object),
        channel("id.material", |ids| ids.material),
        channel("id.instance", |ids| ids.instance),
    ]
}
