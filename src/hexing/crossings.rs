//! Where the boundary of a mesh goes through itself: parts of solids, or bodies, that are nearer to each other than cells are long
//! may be shown by cells that reach into each other. Each cell is positive all the same. Parts of a body are drawn apart
//! (`separate`); what is told is of several, for the most part.

use super::report::LostFeature;
use crate::geometry::{Aabb, BoxIndex, Point, area_vector};
use crate::mesh::{HexMesh, NodeId, meeting};
use crate::solid::SurfaceId;
use crate::{Cancelled, Monitor, parallel};

/// What is shorter than this share of the mesh's diagonal is nothing.
const NOTHING: f64 = 1e-6;

/// All pairs of faces of the boundary that go through each other and share no node, each with a place, ascending.
///
/// # Errors
/// [`Cancelled`] when the monitor says so.
pub(super) fn crossing_faces(
    mesh: &HexMesh,
    faces: &[([NodeId; 4], SurfaceId)],
    monitor: &dyn Monitor,
) -> Result<Vec<([usize; 2], Point)>, Cancelled> {
    let tolerance = NOTHING * mesh.bounds().diagonal();
    let corners = |f: usize| faces[f].0.map(|n| mesh.positions[n.index()]);
    let halves = |f: usize| {
        let [a, b, c, d] = corners(f);
        [[a, b, c], [a, c, d]]
    };
    let bounds: Vec<Aabb> = (0..faces.len()).map(|f| Aabb::around(&corners(f))).collect();
    let index = BoxIndex::within(bounds, monitor)?;
    parallel::try_gather(faces.len(), monitor, |f, found| {
        let around = Aabb::around(&corners(f)).grown(tolerance);
        let is_apart = |&other: &usize| faces[f].0.iter().all(|n| !faces[other].0.contains(n));
        let later = index.touching(&around).filter(|&other| other > f).filter(is_apart);
        let mut others: Vec<u32> = later.map(|other| other as u32).collect();
        parallel::sort(&mut others);
        for other in others.into_iter().map(|other| other as usize) {
            let pairs = halves(f).map(|a| halves(other).map(|b| [a, b]));
            let place = pairs.as_flattened().iter().find_map(|&[a, b]| meeting(a, b, false, tolerance));
            found.extend(place.map(|at| ([f, other], at)));
        }
    })
}

/// The surfaces whose faces go through others with which they share no node: each with a place, and the square root of the area of
/// these faces.
///
/// # Errors
/// [`Cancelled`] when the monitor says so.
pub(super) fn crossing_surfaces(
    mesh: &HexMesh,
    faces: &[([NodeId; 4], SurfaceId)],
    monitor: &dyn Monitor,
) -> Result<Vec<LostFeature>, Cancelled> {
    let mut of_surface: Vec<LostFeature> = Vec::new();
    let mut is_counted = vec![false; faces.len()];
    for (pair, at) in crossing_faces(mesh, faces, monitor)? {
        for face in pair {
            if std::mem::replace(&mut is_counted[face], true) {
                continue;
            }
            let (quad, SurfaceId(id)) = faces[face];
            let area = area_vector(&quad.map(|n| mesh.positions[n.index()])).length();
            match of_surface.iter_mut().find(|lost| lost.id == id) {
                Some(lost) => lost.size += area,
                None => of_surface.push(LostFeature { id, place: at.to_array(), size: area }),
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
    use crate::geometry::Aabb;
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
        crossing_surfaces(&mesh, &faces, &Silent).unwrap()
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
