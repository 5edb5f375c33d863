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

/// A group for each surface that has one of these boundary faces, named `surface-1` for the first, and groups for the names
/// that the surfaces have besides: none if there are none for it. The faces are 6 times the hex and the number there. `None` if they do not ascend.
pub fn surface_groups(sides: &[(u32, SurfaceId)], names: &[Vec<String>]) -> Option<FaceGroups> {
    let mut tags = tags("surface", sides.iter().map(|(_, surface)| surface.0));
    for set in &mut tags.sets {
        let surface = set.number.map_or(0, |number| number as usize - 1);
        set.groups.extend(names.get(surface).into_iter().flatten().map(|name| Group::from(&**name)));
    }
    FaceGroups::new(sides.iter().map(|&(side, _)| side).collect(), tags)
}

/// A group of hexes for each body that has some, named `body-1` for the first, from the body of each hex.
pub fn body_tags(body_of: &[u32]) -> Tags {
    tags("body", body_of.iter().copied())
}

/// A group for each number that an element has, named `what` and a number more, in the order in which they come.
fn tags(what: &str, of_element: impl Iterator<Item = u32>) -> Tags {
    let mut set_of = BTreeMap::new();
    let mut sets = Vec::new();
    let of_element = of_element.map(|of| {
        *set_of.entry(of).or_insert_with(|| {
            let number = i64::from(of) + 1;
            let group = Group::new(format!("{what}-{number}"), number);
            sets.push(TagSet { groups: vec![group], number: Some(number), ..TagSet::default() });
            sets.len() as u32 - 1
        })
    });
    let of_element = of_element.collect();
    Tags { sets, of_element }
}
