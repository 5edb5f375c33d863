//! Fills small holes.

use super::Soup;
use crate::geometry::{Aabb, Point, triangulate};
use crate::mesh::{EdgeId, FaceId};
use crate::solid::options::FilledHole;
use crate::solid::shell::{EdgeTable, triangle_of};

/// Fills the holes whose rims fit into a box with a diagonal of at most `size`. The rim is taken for a polygon; rims that
/// meet themselves or others are left open. No edge has more than two triangles.
pub(super) fn fill(soup: &mut Soup, table: &EdgeTable, size: f64) -> Vec<FilledHole> {
    let mut filled = Vec::new();
    for (rim, face) in rims(soup, table) {
        let points: Vec<Point> = rim.iter().map(|&v| soup.mesh.points[v as usize]).collect();
        let bounds = Aabb::around(&points);
        if bounds.diagonal() > size {
            continue;
        }
        let mut triangles = Vec::new();
        triangulate(&points, &mut triangles);
        soup.mesh.triangles.extend(triangles.iter().map(|t| t.map(|i| rim[i as usize])));
        soup.face_of.resize(soup.mesh.triangles.len(), face);
        filled.push(FilledHole { at: bounds.center(), edges: rim.len() });
    }
    filled
}

/// The simple rims of holes, each by its vertices in order and a face beside it. They run against the triangles there,
/// if these agree.
fn rims(soup: &Soup, table: &EdgeTable) -> Vec<(Vec<u32>, FaceId)> {
    let open: Vec<EdgeId> = table.with_uses(|n| n == 1);
    let mut ends: Vec<(u32, usize)> = Vec::new();
    for (i, e) in open.iter().enumerate() {
        ends.extend(table.edges.ends[e.index()].map(|n| (n.0, i)));
    }
    ends.sort_unstable();
    let at = |v: u32| {
        let first = ends.partition_point(|&(w, _)| w < v);
        ends[first..].iter().take_while(move |&&(w, _)| w == v).map(|&(_, i)| i)
    };
    let mut walked = vec![false; open.len()];
    let mut rims = Vec::new();
    for first in 0..open.len() {
        // The edge runs as its triangle does; its end comes first.
        let [mut start, mut to] = table.edges.ends[open[first].index()].map(|n| n.0);
        std::mem::swap(&mut start, &mut to);
        let (mut rim, mut edge, mut is_simple) = (Vec::new(), first, true);
        while !std::mem::replace(&mut walked[edge], true) {
            let [a, b] = table.edges.ends[open[edge].index()].map(|n| n.0);
            rim.push(if a == to { b } else { a });
            is_simple &= at(to).count() == 2;
            let Some(next) = at(to).find(|&i| !walked[i]) else { break };
            edge = next;
            let [a, b] = table.edges.ends[open[edge].index()].map(|n| n.0);
            to = if a == to { b } else { a };
        }
        if is_simple && to == start && rim.len() > 2 {
            rims.push((rim, soup.face_of[triangle_of(table.uses.at(open[first])[0])]));
        }
    }
    rims
}
