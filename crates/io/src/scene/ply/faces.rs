//! The faces of a PLY file as triangles.

use glam::{DVec3, Vec3};

use crate::error::{At, FileError};
use crate::scene::ply::header::{Element, Kind, Scalar};
use crate::scene::ply::values::Values;
use crate::scene::ply::{read_count, skip_property};
use crate::scene::polygon::triangulate;

/// Polygons of more corners become fans, so that they take no more memory than the file is long, about.
const MOST_CORNERS: usize = 1 << 18;

/// What is made of faces.
#[derive(Debug, Default)]
pub(super) struct Faces {
    pub(super) triangles: Vec<[u32; 3]>,
    /// Faces of fewer than three corners.
    pub(super) dropped: usize,
    /// Those of more than [`MOST_CORNERS`].
    pub(super) fans: usize,
}

impl Faces {
    /// Appends the faces of `face` or `tristrips`, whose corners are these vertices.
    pub(super) fn read(
        &mut self,
        element: &Element,
        values: &mut impl Values,
        vertices: &[[f32; 3]],
    ) -> Result<(), FileError> {
        let are_strips = element.name == "tristrips";
        let corners = Self::corners(element)?;
        self.triangles.reserve(element.count);
        let mut indices = Vec::new();
        for _ in 0..element.count {
            for (k, property) in element.properties.iter().enumerate() {
                match property.kind {
                    Kind::List(count, item) if k == corners => {
                        read_indices(values, count, item, vertices.len(), are_strips, &mut indices)?;
                    }
                    kind => skip_property(values, kind)?,
                }
            }
            if are_strips {
                let strips = indices.split(|&index| index == END_OF_STRIP);
                strips.for_each(|strip| self.triangles.extend(triangles_of_strip(strip)));
            } else {
                self.polygon(&indices, vertices);
            }
        }
        Ok(())
    }

    /// Index of the list of corners.
    pub(super) fn corners(element: &Element) -> Result<usize, FileError> {
        element.corners().ok_or_else(|| {
            let message = format!("the element `{}` has no list `vertex_indices`", element.name);
            FileError::new(message).at(At::Line(element.line))
        })
    }

    fn polygon(&mut self, corners: &[u32], vertices: &[[f32; 3]]) {
        match *corners {
            [] | [_] | [_, _] => self.dropped += 1,
            [a, b, c] => self.triangles.push([a, b, c]),
            [first, ref rest @ ..] if corners.len() > MOST_CORNERS => {
                self.fans += 1;
                self.triangles.extend(rest.iter().zip(rest.iter().skip(1)).map(|(&b, &c)| [first, b, c]));
            }
            _ => {
                let place = |&i: &u32| vertices.get(i as usize).copied().unwrap_or_default();
                let places: Vec<DVec3> = corners.iter().map(|i| Vec3::from(place(i)).as_dvec3()).collect();
                let mut triangles = Vec::with_capacity(corners.len());
                triangulate(&places, &mut triangles);
                let corner = |i: usize| corners.get(i).copied().unwrap_or_default();
                self.triangles.extend(triangles.into_iter().map(|triangle| triangle.map(corner)));
            }
        }
    }
}

/// Stands for -1.
const END_OF_STRIP: u32 = u32::MAX;

fn read_indices(
    values: &mut impl Values,
    count: Scalar,
    item: Scalar,
    vertices: usize,
    are_strips: bool,
    indices: &mut Vec<u32>,
) -> Result<(), FileError> {
    indices.clear();
    for _ in 0..read_count(values, count)? {
        let at = values.at();
        let index = values.next(item)?;
        if (0.0..vertices as f64).contains(&index) && index.fract() == 0.0 {
            indices.push(index as u32);
        } else if are_strips && index == -1.0 {
            indices.push(END_OF_STRIP);
        } else {
            return Err(FileError::new(format!("there is no vertex {index}: the file has {vertices}")).at(at));
        }
    }
    Ok(())
}

/// Every other triangle of a strip is turned over; those without area only join its parts.
fn triangles_of_strip(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let triangles = corners.windows(3).zip([false, true].into_iter().cycle());
    let triangles = triangles.map(|(t, turned)| if turned { [t[1], t[0], t[2]] } else { [t[0], t[1], t[2]] });
    triangles.filter(|[a, b, c]| a != b && b != c && c != a)
}
