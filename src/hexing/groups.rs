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
/// that each surface has in the input; `names` may be empty. The faces are 6 times the hex and the number there. `None` if
/// they do not ascend.
pub fn surface_groups(sides: &[(u32, SurfaceId)], names: &[Vec<String>]) -> Option<FaceGroups> {
    let mut tags = tags(SURFACE, sides.iter().map(|(_, surface)| surface.0));
    for set in &mut tags.sets {
        let of_input = set.number.and_then(|number| names.get(number as usize - 1));
        set.groups.extend(of_input.into_iter().flatten().map(|name| named_in_input(name)));
    }
    FaceGroups::new(sides.iter().map(|&(side, _)| side).collect(), tags)
}

const SURFACE: &str = "surface";

/// A group of the input. A name that is one of ours, as in a surface that was taken from a mesh of ours, would be another
/// group's: it stands behind `input:`.
fn named_in_input(name: &str) -> Group {
    let number = name.strip_prefix(SURFACE).and_then(|rest| rest.strip_prefix('-'));
    let is_ours = number.is_some_and(|number| number.parse::<u64>().is_ok());
    if is_ours { format!("input:{name}").into() } else { name.into() }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_of_the_input_are_never_those_of_other_surfaces() {
        let names = [vec!["surface-2", "inlet"], vec![], vec!["surface-", "surface-b", "object:surface-1"]];
        let names = names.map(|names| names.into_iter().map(str::to_owned).collect());
        let sides = [(0, SurfaceId(2)), (3, SurfaceId(0)), (7, SurfaceId(5))];
        let groups = surface_groups(&sides, &names).unwrap();
        let of_side = |k: usize| groups.tags().of(k).unwrap().names();
        assert_eq!(of_side(0), ["surface-3", "surface-", "surface-b", "object:surface-1"]);
        assert_eq!(of_side(1), ["surface-1", "input:surface-2", "inlet"]);
        assert_eq!(of_side(2), ["surface-6"]);
        assert_eq!(surface_groups(&sides, &[]).unwrap().tags().of(1).unwrap().names(), ["surface-1"]);
    }
}
