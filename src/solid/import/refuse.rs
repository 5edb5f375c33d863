//! What is no closed manifold surface, with its place.

use super::Soup;
use crate::geometry::Point;
use crate::mesh::{EdgeId, FaceId};
use crate::solid::error::SolidError;
use crate::solid::shell::{EdgeTable, triangle_of};

/// Refuses edges of three or more triangles.
pub(super) fn non_manifold(soup: &Soup, table: &EdgeTable) -> Result<(), SolidError> {
    let edges = table.with_uses(|n| n > 2);
    let Some(&e) = edges.first() else { return Ok(()) };
    Err(SolidError::NonManifold {
        edges: edges.len(),
        at: middle(soup, table, e),
        faces: faces(soup, table, e),
    })
}

/// Refuses edges of one triangle.
pub(super) fn open(soup: &Soup, table: &EdgeTable) -> Result<(), SolidError> {
    let edges = table.with_uses(|n| n == 1);
    let Some(&e) = edges.first() else { return Ok(()) };
    Err(SolidError::Open { edges: edges.len(), at: middle(soup, table, e), face: faces(soup, table, e)[0] })
}

fn middle(soup: &Soup, table: &EdgeTable, e: EdgeId) -> Point {
    let [a, b] = table.edges.ends[e.index()].map(|n| soup.mesh.points[n.index()]);
    a.midpoint(b)
}

fn faces(soup: &Soup, table: &EdgeTable, e: EdgeId) -> Vec<FaceId> {
    table.uses.at(e).iter().map(|&k| soup.face_of[triangle_of(k)]).collect()
}
