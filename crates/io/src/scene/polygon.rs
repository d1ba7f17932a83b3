//! Polygons as triangles: fans of convex ones, ears cut off the others.
//!
//! Meisters 1975, "Polygons Have Ears", doi:10.1080/00029890.1975.11993898. The polygon is looked at along the axis that its
//! normal is nearest to; the normal is that of Newell (Sutherland, Sproull & Schumacker 1974, doi:10.1145/356625.356626).

use glam::{DVec2, DVec3};

/// Steps for each corner; polygons that take more become fans in what is left of them.
const STEPS: usize = 1024;

/// Appends triangles, as numbers of corners. Fewer than three corners make none.
pub(super) fn triangulate(corners: &[DVec3], triangles: &mut Vec<[usize; 3]>) {
    let n = corners.len();
    if n == 3 {
        return triangles.push([0, 1, 2]);
    }
    if let &[a, b, c, d] = corners
        && is_convex([a, b, c, d])
    {
        return triangles.extend([[0, 1, 2], [0, 2, 3]]);
    }
    let flat = flatten(corners);
    let turn = |[a, b, c]: [usize; 3]| match (flat.get(a), flat.get(b), flat.get(c)) {
        (Some(&a), Some(&b), Some(&c)) => (b - a).perp_dot(c - b),
        _ => 0.0,
    };
    let mut ring: Vec<usize> = (0..n).collect();
    if (0..n).any(|i| turn([i, (i + 1) % n, (i + 2) % n]) < 0.0) {
        let mut steps = n.saturating_mul(STEPS);
        // Corners looked at since an ear was cut off.
        let (mut at, mut idle) = (0, 0);
        while ring.len() > 3 && idle < ring.len() && steps > 0 {
            steps = steps.saturating_sub(ring.len());
            let m = ring.len();
            at %= m;
            let ear = [(at + m - 1) % m, at, (at + 1) % m].map(|i| ring.get(i).copied().unwrap_or_default());
            let is_free = |&p: &usize| {
                let edges = [[ear[0], ear[1]], [ear[1], ear[2]], [ear[2], ear[0]]];
                let same = ear.iter().any(|&e| flat.get(e) == flat.get(p));
                same || edges.iter().any(|&[a, b]| turn([a, b, p]) < 0.0)
            };
            if turn(ear) > 0.0 && ring.iter().all(is_free) {
                triangles.push(ear);
                ring.remove(at);
                idle = 0;
            } else {
                at += 1;
                idle += 1;
            }
        }
    }
    if let Some((&first, rest)) = ring.split_first() {
        triangles.extend(rest.iter().zip(rest.iter().skip(1)).map(|(&a, &b)| [first, a, b]));
    }
}

/// Whether all corners turn the same way. Most polygons are such quads.
fn is_convex(quad: [DVec3; 4]) -> bool {
    let normal = (quad[2] - quad[0]).cross(quad[3] - quad[1]);
    (0..4).all(|i| (quad[(i + 1) % 4] - quad[i]).cross(quad[(i + 2) % 4] - quad[(i + 1) % 4]).dot(normal) > 0.0)
}

/// Seen so that they turn counter-clockwise.
fn flatten(corners: &[DVec3]) -> Vec<DVec2> {
    let next = corners.iter().cycle().skip(1);
    let normal = corners
        .iter()
        .zip(next)
        .map(|(a, b)| DVec3::new((a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y)));
    let normal: DVec3 = normal.sum();
    let size = normal.abs();
    let see = |p: &DVec3| {
        if size.z >= size.x && size.z >= size.y {
            (DVec2::new(p.x, p.y), normal.z)
        } else if size.x >= size.y {
            (DVec2::new(p.y, p.z), normal.x)
        } else {
            (DVec2::new(p.z, p.x), normal.y)
        }
    };
    let seen = corners.iter().map(see);
    seen.map(|(p, side)| if side < 0.0 { DVec2::new(-p.x, p.y) } else { p }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn areas(corners: &[[f64; 2]]) -> (usize, f64, f64) {
        let corners: Vec<_> = corners.iter().map(|&[x, y]| DVec3::new(x, 0.25 * x, -y)).collect();
        let mut triangles = Vec::new();
        triangulate(&corners, &mut triangles);
        let normals = triangles.iter().map(|t| {
            let [a, b, c] = t.map(|i| corners[i]);
            -0.5 * (b - a).cross(c - a).y
        });
        let normals: Vec<_> = normals.collect();
        (triangles.len(), normals.iter().sum(), normals.iter().map(|a| a.abs()).sum())
    }

    /// No triangle lies over another: their areas add up to that of the polygon, and none is turned over.
    #[test]
    fn concave_polygons_are_covered_once() {
        let arrow = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]];
        let comb = [[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [4.0, 3.0], [4.0, 1.0], [3.0, 1.0], [3.0, 3.0], [2.0, 3.0]];
        let comb = [&comb[..], &[[2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]]].concat();
        for (polygon, area) in [(&arrow[..], 1.5), (&comb, 11.0)] {
            for turn in 0..polygon.len() {
                let turned = [&polygon[turn..], &polygon[..turn]].concat();
                let (count, signed, all) = areas(&turned);
                assert_eq!(count, polygon.len() - 2);
                assert!((signed.abs() - area).abs() < 1e-9 && (all - area).abs() < 1e-9, "{signed} {all}");
            }
        }
    }

    #[test]
    fn degenerate_polygons_end() {
        for polygon in [vec![], vec![[1.0, 1.0]; 2], vec![[1.0, 1.0]; 9], [[0.0, 0.0], [1.0, 1.0]].repeat(500)] {
            assert!(areas(&polygon).0 <= polygon.len());
        }
    }
}
