//! The meshes of nodes where they stand. One that stands in many places is there once, with copies.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::rc::Rc;
use std::sync::Arc;

use eyebeam_core::shape::MeshDesc;
use glam::{DAffine3, DMat4};

use crate::error::FileError;
use crate::scene::model::Model;
use crate::scene::model::gltf::accessor::{Buffers, missing};
use crate::scene::model::gltf::closed::is_closed;
use crate::scene::model::gltf::document::{Document, Material, Mesh, Node, Primitive};
use crate::scene::model::gltf::material::{Materials, Painted};
use crate::scene::model::gltf::{mesh, node, tangents};
use crate::warning::Warning;

/// Triangles of all copies of a mesh that are few enough to be meshes of their own: rays find these faster, and copies take less
/// memory.
const FEW: u64 = 1 << 16;

/// A mesh in a pose, and where it stands.
struct Group<'a> {
    /// The first node that has it.
    node: usize,
    mesh: &'a Mesh,
    /// How much there is of each morph target.
    weights: &'a [f32],
    /// Where each joint has moved since the skin was bound, in the world.
    joints: Option<Rc<[DAffine3]>>,
    /// To the world; meshes with joints are there already.
    places: Vec<DAffine3>,
}

/// Adds the meshes of nodes, of which the transforms to the world are known.
pub(super) fn read(
    buffers: &Buffers<'_>,
    placed: &[(usize, DAffine3)],
    materials: &mut Materials<'_>,
    model: &mut Model,
) -> Result<(), FileError> {
    let groups = groups(buffers, placed)?;
    for (group, primitive) in groups.iter().flat_map(|group| group.mesh.primitives.iter().map(move |p| (group, p))) {
        let joints = group.joints.as_deref().filter(|_| primitive.attributes.contains_key("JOINTS_0"));
        let Some(mut data) = mesh::read(buffers, primitive, group.weights, joints)? else {
            let warning = Warning::new("points and lines are left out");
            model.warnings.push(warning.part(format!("node {}", group.node)));
            continue;
        };
        let default = Material::default();
        let said = primitive.material.and_then(|index| buffers.document.materials.get(index)).unwrap_or(&default);
        if !said.uses_alpha() {
            data.alphas.clear();
        }
        match materials.directions(primitive.material) {
            None => data.tangents.clear(),
            Some(mapping) if data.tangents.is_empty() => tangents::make(&mut data, &mapping),
            Some(_) => {}
        }
        let is_open = (said.is_one_sided() || said.shines()) && !is_closed(&data);
        let painted = Painted {
            colors: !data.colors.is_empty(),
            alphas: !data.alphas.is_empty(),
            both_sides: is_open && said.double_sided,
        };
        let mut material = materials.name(primitive.material, painted, &mut model.desc, &mut model.warnings);
        if is_open && said.is_one_sided() {
            material = materials.front(&mut model.desc, &material);
        }
        if group.weights.iter().zip(&primitive.targets).any(|(weight, target)| *weight != 0.0 && moves_more(target)) {
            let warning = Warning::new("of what morph targets change, places, normals and tangents are read");
            model.warnings.push(warning.part(format!("node {}", group.node)));
        }
        let file = format!("{}#node{}", materials.file, group.node);
        let places = if joints.is_some() { &[DAffine3::IDENTITY] } else { &group.places[..] };
        let mesh = |data, instances| {
            let (file, material) = (Some(file.clone()), Some(material.clone()));
            MeshDesc { file, material, instances, data: Some(Arc::new(data)), ..MeshDesc::default() }
        };
        let meshes = &mut model.desc.shape.mesh;
        if is_shared(buffers.document, primitive, places.len() as u64, data.triangles.len() as u64) {
            meshes.push(mesh(data, places.iter().map(rows).collect()));
            continue;
        }
        for place in places {
            let mut data = data.clone();
            mesh::place(&mut data, place);
            meshes.push(mesh(data, Vec::new()));
        }
    }
    Ok(())
}

/// Whether a morph target changes more than is read.
fn moves_more(target: &BTreeMap<String, usize>) -> bool {
    target.keys().any(|name| !matches!(&**name, "POSITION" | "NORMAL" | "TANGENT"))
}

/// Nodes with the same mesh in the same pose together.
fn groups<'a>(buffers: &Buffers<'a>, placed: &[(usize, DAffine3)]) -> Result<Vec<Group<'a>>, FileError> {
    let document = buffers.document;
    let in_world: BTreeMap<usize, DAffine3> = placed.iter().copied().collect();
    let mut groups: Vec<Group<'_>> = Vec::new();
    let (mut group_of, mut skins) = (BTreeMap::new(), BTreeMap::new());
    for &(index, to_world) in placed {
        let Some(node) = document.nodes.get(index) else { continue };
        let Some(number) = node.mesh else { continue };
        let mesh = document.meshes.get(number).ok_or_else(|| missing("mesh", number))?;
        let places = node::copies(buffers, node)?.into_iter().map(|copy| to_world * copy);
        let is_plain = is_plain(node);
        if let Some(group) = group_of.get(&number).and_then(|&g: &usize| groups.get_mut(g)).filter(|_| is_plain) {
            group.places.extend(places);
            continue;
        }
        if is_plain {
            group_of.insert(number, groups.len());
        }
        if let Some(skin) = node.skin
            && let Entry::Vacant(entry) = skins.entry(skin)
        {
            entry.insert(Rc::from(joints(buffers, skin, &in_world)?));
        }
        let joints = node.skin.and_then(|skin| skins.get(&skin).cloned());
        let weights = if node.weights.is_empty() { &mesh.weights } else { &node.weights };
        groups.push(Group { node: index, mesh, weights, joints, places: places.collect() });
    }
    Ok(groups)
}

/// The rows of a 3×4 matrix.
fn rows(place: &DAffine3) -> [f32; 12] {
    let columns = [place.matrix3.x_axis, place.matrix3.y_axis, place.matrix3.z_axis, place.translation];
    std::array::from_fn(|i| columns[i % 4][i / 4] as f32)
}

/// Whether a node's mesh is in the same pose wherever it is.
pub(super) fn is_plain(node: &Node) -> bool {
    node.skin.is_none() && node.weights.is_empty()
}

/// Whether copies of a primitive of so many triangles share its memory. Those that shine would hardly be found.
pub(super) fn is_shared(document: &Document, primitive: &Primitive, copies: u64, triangles: u64) -> bool {
    let material = primitive.material.and_then(|index| document.materials.get(index));
    copies > 1 && copies.saturating_mul(triangles) > FEW && !material.is_some_and(Material::shines)
}

/// From where the joints of a skin were when it was bound to where they are in the world.
fn joints(
    buffers: &Buffers<'_>,
    index: usize,
    in_world: &BTreeMap<usize, DAffine3>,
) -> Result<Vec<DAffine3>, FileError> {
    let skin = buffers.document.skins.get(index).ok_or_else(|| missing("skin", index))?;
    let bound = skin.inverse_bind_matrices.map(|i| buffers.floats::<16>(i, 0.0)).transpose()?;
    // Joints need not be in the scene that is shown.
    let is_elsewhere = skin.joints.iter().any(|joint| !in_world.contains_key(joint));
    let elsewhere = if is_elsewhere { node::in_world(buffers.document, node::EVERYWHERE)? } else { Vec::new() };
    let elsewhere: BTreeMap<_, _> = elsewhere.into_iter().collect();
    let joint = |(i, joint): (usize, &usize)| {
        let to_world = in_world.get(joint).or_else(|| elsewhere.get(joint));
        let to_world = *to_world.ok_or_else(|| missing("joint", *joint))?;
        let bound = match &bound {
            Some(matrices) => matrices.get(i).ok_or_else(|| missing("inverse bind matrix", i))?.map(f64::from),
            None => return Ok(to_world),
        };
        Ok(to_world * DAffine3::from_mat4(DMat4::from_cols_array(&bound)))
    };
    skin.joints.iter().enumerate().map(joint).collect()
}
