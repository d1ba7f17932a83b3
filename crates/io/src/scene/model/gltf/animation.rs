//! Where an animation has nodes at a time.
//!
//! Between two keys: the value of the first (STEP), an even mix, turns along the shortest arc (LINEAR, Shoemake 1985,
//! doi:10.1145/325165.325242), or Hermite's cubic (CUBICSPLINE). Khronos, glTF 2.0 Specification, 2021, §3.11 and appendix C.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use glam::DQuat;

use crate::error::FileError;
use crate::scene;
use crate::scene::model::choose::choose;
use crate::scene::model::gltf::accessor::{Buffers, missing};
use crate::scene::model::gltf::document::{Animation, AnimationSampler, Document};

/// What an animation says of a node.
pub(super) struct Change {
    node: usize,
    to: To,
}

enum To {
    Translation([f64; 3]),
    Rotation([f64; 4]),
    Scale([f64; 3]),
    Weights(Vec<f32>),
}

/// The index of an animation by its name or its number.
///
/// # Errors
/// If there is none; they are listed.
pub(super) fn find(document: &Document, wanted: &str) -> Result<usize, FileError> {
    choose("animation", wanted, document.animations.iter().map(|animation| animation.name.as_str()))
}

/// All animations, with the time of their last keys.
pub(super) fn all(buffers: &Buffers<'_>) -> Vec<scene::Animation> {
    let mut known = BTreeMap::new();
    let mut end = |sampler: &AnimationSampler| {
        let last = || buffers.floats::<1>(sampler.input, 0.0).ok()?.last().map(|[t]| *t);
        *known.entry(sampler.input).or_insert_with(last)
    };
    let told = |Animation { name, samplers, .. }: &Animation| scene::Animation {
        name: name.clone(),
        seconds: samplers.iter().filter_map(&mut end).filter(|t| t.is_finite()).fold(0.0, f32::max),
    };
    buffers.document.animations.iter().map(told).collect()
}

/// What an animation says at a time, seconds.
pub(super) fn sample(buffers: &Buffers<'_>, animation: usize, at: f32) -> Result<Vec<Change>, FileError> {
    let animation = buffers.document.animations.get(animation).ok_or_else(|| missing("animation", animation))?;
    let Animation { channels, samplers, .. } = animation;
    let mut changes = Vec::new();
    let mut known = BTreeMap::new();
    for channel in channels {
        let Some(node) = channel.target.node else { continue };
        let sampler = samplers.get(channel.sampler).ok_or_else(|| missing("sampler", channel.sampler))?;
        let turns = channel.target.path == "rotation";
        for index in [sampler.input, sampler.output] {
            if let Entry::Vacant(entry) = known.entry(index) {
                entry.insert(buffers.flat(index)?);
            }
        }
        let values = value(&known, sampler, at, turns)?;
        let vector = |values: &[f32]| -> Result<[f64; 3], FileError> {
            let vector: Option<[f32; 3]> = values.try_into().ok();
            Ok(vector.ok_or_else(|| FileError::new("an animation moves nodes by what is no vector"))?.map(f64::from))
        };
        let to = match channel.target.path.as_str() {
            "translation" => To::Translation(vector(&values)?),
            "scale" => To::Scale(vector(&values)?),
            "rotation" => {
                let turn: Option<[f32; 4]> = values.as_slice().try_into().ok();
                To::Rotation(
                    turn.ok_or_else(|| FileError::new("an animation turns nodes by what is no turn"))?.map(f64::from),
                )
            }
            "weights" => To::Weights(values),
            _ => continue,
        };
        changes.push(Change { node, to });
    }
    Ok(changes)
}

/// Poses the nodes.
pub(super) fn apply(document: &mut Document, changes: Vec<Change>) {
    for Change { node, to } in changes {
        let Some(node) = document.nodes.get_mut(node) else { continue };
        match to {
            To::Translation(v) => node.translation = Some(v),
            To::Rotation(v) => node.rotation = Some(v),
            To::Scale(v) => node.scale = Some(v),
            To::Weights(v) => node.weights = v,
        }
    }
}

/// The value of a sampler at a time; before its first key and after its last one it is theirs.
fn value(
    known: &BTreeMap<usize, Vec<f32>>,
    sampler: &AnimationSampler,
    at: f32,
    turns: bool,
) -> Result<Vec<f32>, FileError> {
    let numbers_of = |index| known.get(&index).ok_or_else(|| missing("accessor", index));
    let (times, numbers) = (numbers_of(sampler.input)?, numbers_of(sampler.output)?);
    let is_cubic = sampler.interpolation.as_deref() == Some("CUBICSPLINE");
    let parts = times.len() * if is_cubic { 3 } else { 1 };
    let width = numbers.len().checked_div(parts).unwrap_or_default();
    let wrong = || FileError::new(format!("an animation has {} numbers for {} keys", numbers.len(), times.len()));
    if width == 0 || width * parts != numbers.len() {
        return Err(wrong());
    }
    // Of a key of a cubic: the tangent before it, its value, the tangent behind it.
    let part = |key: usize, part: usize| {
        let first = if is_cubic { 3 * key + part } else { key } * width;
        numbers.get(first..first + width).ok_or_else(wrong)
    };
    const VALUE: usize = 1;
    let next = times.partition_point(|&t| t <= at);
    let (Some(before), true) = (next.checked_sub(1), next < times.len()) else {
        return Ok(part(next.min(times.len() - 1), VALUE)?.to_vec());
    };
    let (start, length) = (times[before], times[next] - times[before]);
    let t = if length > 0.0 { (at - start) / length } else { 0.0 };
    let (a, b) = (part(before, VALUE)?, part(next, VALUE)?);
    Ok(match sampler.interpolation.as_deref() {
        Some("STEP") => a.to_vec(),
        Some("CUBICSPLINE") => {
            let tangents = part(before, 2)?.iter().zip(part(next, 0)?);
            let hermite = |((a, b), (m0, m1)): ((&f32, &f32), (&f32, &f32))| {
                let (t2, t3) = (t * t, t * t * t);
                (2.0 * t3 - 3.0 * t2 + 1.0) * a
                    + length * (t3 - 2.0 * t2 + t) * m0
                    + (3.0 * t2 - 2.0 * t3) * b
                    + length * (t3 - t2) * m1
            };
            a.iter().zip(b).zip(tangents).map(hermite).collect()
        }
        _ if turns => shortest(a, b, t),
        _ => a.iter().zip(b).map(|(a, b)| a + (b - a) * t).collect(),
    })
}

/// Between two turns.
fn shortest(a: &[f32], b: &[f32], t: f32) -> Vec<f32> {
    let turn = |v: &[f32]| -> Option<DQuat> {
        let v: [f32; 4] = v.try_into().ok()?;
        Some(DQuat::from_array(v.map(f64::from))).filter(|q| q.length_squared() > 0.0).map(|q| q.normalize())
    };
    match (turn(a), turn(b)) {
        (Some(a), Some(b)) => a.slerp(b, t.into()).to_array().map(|c| c as f32).to_vec(),
        _ => a.to_vec(),
    }
}
