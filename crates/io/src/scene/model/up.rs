//! What is up.

use std::str::FromStr;
use std::sync::Arc;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::shape::MeshData;

/// The axis that points upwards in a file. Inside it is +Y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// +X
    X,
    /// +Y
    Y,
    /// +Z
    Z,
    /// −X
    MinusX,
    /// −Y
    MinusY,
    /// −Z
    MinusZ,
}

impl Up {
    /// Every axis by its name.
    pub const NAMES: &[(&str, Self)] = &[
        ("+X", Self::X),
        ("+Y", Self::Y),
        ("+Z", Self::Z),
        ("-X", Self::MinusX),
        ("-Y", Self::MinusY),
        ("-Z", Self::MinusZ),
    ];

    /// The same vector with this axis upwards: turned about the third axis by a quarter or a half, not mirrored.
    pub fn to_y_up(self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        match self {
            Self::X => [-y, x, z],
            Self::Y => [x, y, z],
            Self::Z => [x, z, -y],
            Self::MinusX => [y, -x, z],
            Self::MinusY => [x, -y, -z],
            Self::MinusZ => [x, -z, y],
        }
    }

    /// Turns all meshes.
    pub(super) fn turn(self, desc: &mut SceneDesc) {
        if self == Self::Y {
            return;
        }
        for mesh in desc.shape.mesh.iter_mut().filter_map(|mesh| mesh.data.as_mut()) {
            let MeshData { vertices, normals, tangents, .. } = Arc::make_mut(mesh);
            vertices.iter_mut().chain(normals).for_each(|v| *v = self.to_y_up(*v));
            for [x, y, z, _] in tangents {
                [*x, *y, *z] = self.to_y_up([*x, *y, *z]);
            }
        }
    }
}

impl FromStr for Up {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = text.trim_start_matches('+');
        let found = Self::NAMES.iter().find(|(name, _)| name.trim_start_matches('+').eq_ignore_ascii_case(wanted));
        found.map(|&(_, up)| up).ok_or_else(|| "use +X, +Y, +Z, -X, -Y or -Z".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use eyebeam_core::shape::MeshDesc;
    use glam::Vec3;

    use super::*;

    /// The axis goes upwards, and right hands stay right hands.
    #[test]
    fn turns_and_does_not_mirror() {
        for (name, up) in Up::NAMES {
            let turn = |v: Vec3| Vec3::from(up.to_y_up(v.into()));
            let axis = match &name[1..] {
                "X" => Vec3::X,
                "Y" => Vec3::Y,
                _ => Vec3::Z,
            };
            let axis = if name.starts_with('-') { -axis } else { axis };
            assert_eq!(turn(axis), Vec3::Y, "{name}");
            assert_eq!(turn(Vec3::X).cross(turn(Vec3::Y)), turn(Vec3::Z), "{name}");
            assert_eq!(name.parse(), Ok(*up));
        }
        let mut desc = SceneDesc::default();
        let frame = [[0.0, 0.0, 2.0]];
        let data = MeshData {
            vertices: frame.into(),
            normals: frame.into(),
            tangents: vec![[0.0, 0.0, 2.0, -1.0]],
            ..MeshData::default()
        };
        desc.shape.mesh.push(MeshDesc { data: Some(Arc::new(data)), ..MeshDesc::default() });
        Up::Z.turn(&mut desc);
        let turned = desc.shape.mesh[0].data.as_ref().unwrap();
        assert_eq!((turned.vertices[0], turned.normals[0]), ([0.0, 2.0, 0.0], [0.0, 2.0, 0.0]));
        assert_eq!(turned.tangents[0], [0.0, 2.0, 0.0, -1.0]);
        assert_eq!("z".parse(), Ok(Up::Z));
        assert!("W".parse::<Up>().is_err());
    }
}
