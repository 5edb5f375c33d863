//! The surfaces of the solid as groups of the mesh's boundary faces: where loads and supports go; its bodies as groups of
//! hexes.

use std::collections::BTreeMap;

use crate::mesh::topology::HexFaces;
use crate::mesh::{FaceGroups, Group, HexMesh, NodeId, TagSet, Tags};
use crate::solid::SurfaceId;

/// Boundary faces by their hex and their number there, ascending, each with the surface that it stands for. `faces` are
/// all boundary faces of the mesh, in the order of [`hex_boundary`](crate::mesh::topology::hex_boundary).
pub(super) fn sides_of(mesh: &HexMesh, faces: &[([NodeId; 4], SurfaceId)]) -> Vec<(u32, SurfaceId)> {
    let of_hexes = HexFaces::of(mesh.positions.len(), &mesh.hexes);
    let boundary = of_hexes.ids().filter(|&face| of_hexes.is_boundary(face));
    let mut sides: Vec<(u32, SurfaceId)> =
        boundary.zip(faces).map(|(face, &(_, surface))| (of_hexes.sides(face)[0], surface)).collect();
    sides.sort_unstable();
    sides
}

/// A group for each surface that has one of these boundary faces, named `surface-1` for the first. The faces are 6 times
/// the hex and the number there. `None` if they do not ascend.
pub fn surface_groups(sides: &[(u32, SurfaceId)]) -> Option<FaceGroups> {
    let mut set_of = BTreeMap::new();
    let mut sets = Vec::new();
    let of_element = sides.iter().map(|&(_, surface)| {
        *set_of.entry(surface).or_insert_with(|| {
            let number = i64::from(surface.0) + 1;
            sets.push(named("surface", number));
            sets.len() as u32 - 1
        })
    });
    let of_element = of_element.collect();
    let sides = sides.iter().map(|&(side, _)| side).collect();
    FaceGroups::new(sides, Tags { sets, of_element })
}

/// A group of hexes for each of so many bodies, named `body-1` for the first, from the body of each hex.
pub fn body_tags(bodies: usize, body_of: Vec<u32>) -> Tags {
    Tags { sets: (1..=bodies as i64).map(|number| named("body", number)).collect(), of_element: body_of }
}

/// The tags of a group that is named and numbered.
fn named(what: &str, number: i64) -> TagSet {
    let group = Group::new(format!("{what}-{number}"), number);
    TagSet { groups: vec![group], number: Some(number), ..TagSet::default() }
}
