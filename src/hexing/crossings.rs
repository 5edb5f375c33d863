//! Where the boundary of a mesh goes through itself: parts of solids, or bodies, that are nearer to each other than cells are long
//! may be shown by cells that reach into each other. Each cell is positive all the same.

use super::report::LostFeature;
use crate::geometry::area_vector;
use crate::mesh::{HexMesh, NodeId, crossings};
use crate::solid::SurfaceId;
use crate::{Cancelled, Monitor};

/// What is shorter than this share of the solid's diagonal is nothing.
const NOTHING: f64 = 1e-6;

/// The surfaces whose faces go through others with which they share no node: each with a place, and the square root of the area of
/// these faces.
///
/// # Errors
/// [`Cancelled`] when the monitor says so.
pub(super) fn crossing_surfaces(
    mesh: &HexMesh,
    faces: &[([NodeId; 4], SurfaceId)],
    diagonal: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<LostFeature>, Cancelled> {
    let halves = |quad: [NodeId; 4]| {
        let [a, b, c, d] = quad.map(|n| n.0);
        [[a, b, c], [a, c, d]]
    };
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(|&(quad, _)| halves(quad)).collect();
    let found = crossings(&mesh.positions, &triangles, NOTHING * diagonal, monitor)?;
    let mut of_surface: Vec<LostFeature> = Vec::new();
    let mut is_counted = vec![false; faces.len()];
    for crossing in found {
        let [a, b] = crossing.triangles.map(|t| t as usize / 2);
        if faces[a].0.iter().any(|n| faces[b].0.contains(n)) {
            continue;
        }
        for face in [a, b] {
            if std::mem::replace(&mut is_counted[face], true) {
                continue;
            }
            let (quad, SurfaceId(id)) = faces[face];
            let area = area_vector(&quad.map(|n| mesh.positions[n.index()])).length();
            match of_surface.iter_mut().find(|lost| lost.id == id) {
                Some(lost) => lost.size += area,
                None => of_surface.push(LostFeature { id, place: crossing.at.to_array(), size: area }),
            }
        }
    }
    of_surface.iter_mut().for_each(|lost| lost.size = lost.size.sqrt());
    Ok(of_surface)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::geometry::{Aabb, Point};
    use crate::mesh::topology::hex_boundary;
    use crate::mesh::{GridOptions, hex_grid};

    /// Of two blocks of cubes, the second so far along x and half a cube aside, what goes through each other.
    fn crossing(along: f64) -> Vec<LostFeature> {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100 };
        let mut mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(2.0) }, &options).unwrap();
        let (nodes, hexes) = (mesh.positions.len(), mesh.hexes.len());
        let other: Vec<_> = mesh.positions.iter().map(|&p| p + Point::new(along, 0.5, 0.5)).collect();
        mesh.positions.extend(other);
        let other: Vec<_> =
            mesh.hexes.iter().map(|hex| hex.map(|n| NodeId::new(n.index() + nodes))).collect();
        mesh.hexes.extend(other);
        let boundary = hex_boundary(&mesh.hexes).into_iter();
        let faces: Vec<_> =
            boundary.map(|(quad, hex)| (quad, SurfaceId::new(usize::from(hex.index() >= hexes)))).collect();
        crossing_surfaces(&mesh, &faces, 5.0, &Silent).unwrap()
    }

    #[test]
    fn blocks_that_reach_into_each_other_are_told() {
        assert_eq!(crossing(2.1), []);
        let found = crossing(1.75);
        assert_eq!(found.iter().map(|surface| surface.id).collect::<Vec<_>>(), [0, 1]);
        for LostFeature { place, size, .. } in found {
            let [x, y, z] = place;
            assert!((1.75..=2.0).contains(&x) && y.min(z) >= 0.5 && y.max(z) <= 2.0, "{place:?}");
            // Some of the squares of each.
            assert!(size > 1.0 && size * size <= 24.0, "{size}");
        }
    }
}
