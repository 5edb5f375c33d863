//! A part of a mesh as a mesh of its own, so that what is asked of it again and again takes no look at the rest.

use super::stage::StageMesh;
use crate::mesh::NodeId;
use crate::mesh::topology::Side;
use crate::{Cancelled, Monitor};

/// Some hexes of a mesh.
pub(super) struct Part {
    /// The hexes, with their nodes alone, both in the order of the whole mesh.
    pub(super) mesh: StageMesh,
    /// The hex of the whole mesh that each is.
    hexes: Vec<u32>,
}

impl Part {
    /// The part of these hexes, which ascend, of a mesh before its first stage.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub(super) fn of(whole: &StageMesh, hexes: Vec<u32>, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let nodes_of = |&hex: &u32| whole.hexes[hex as usize];
        let mut nodes: Vec<NodeId> = hexes.iter().flat_map(nodes_of).collect();
        nodes.sort_unstable();
        nodes.dedup();
        monitor.proceed()?;
        let local = |node: NodeId| NodeId::new(nodes.binary_search(&node).expect("a node of the part"));
        let positions = nodes.iter().map(|n| whole.positions[n.index()]).collect();
        let mut mesh =
            StageMesh::of_input(positions, hexes.iter().map(|hex| nodes_of(hex).map(local)).collect());
        monitor.proceed()?;
        for (k, &hex) in (0..).zip(&hexes) {
            let first = whole.labels.partition_point(|&(side, _)| side < 6 * hex);
            let of_hex = whole.labels[first..].iter().take_while(|&&(side, _)| side < 6 * (hex + 1));
            mesh.labels.extend(of_hex.map(|&(side, label)| (side - 6 * hex + 6 * k as Side, label)));
        }
        if !whole.materials.is_empty() {
            mesh.materials = hexes.iter().map(|&hex| whole.materials[hex as usize]).collect();
        }
        Ok(Self { mesh, hexes })
    }

    /// What is so for each hex of the whole mesh, for those of the part.
    pub(super) fn flags(&self, of_whole: &[bool]) -> Vec<bool> {
        self.hexes.iter().map(|&hex| of_whole[hex as usize]).collect()
    }

    /// Gives hexes of the part their numbers in the whole mesh.
    pub(super) fn number_as_whole(&self, hexes: &mut [u32]) {
        hexes.iter_mut().for_each(|hex| *hex = self.hexes[*hex as usize]);
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use proptest::prelude::*;

    use super::super::grouping::Grouping;
    use super::super::stage::{Joining, joining};
    use super::*;
    use crate::Silent;
    use crate::geometry::{Aabb, Point};
    use crate::mesh::{FaceGroups, GridOptions, HexMesh, TagSet, Tags, hex_grid};

    /// Six cubes a side, of two materials, with the faces of every third one in a group.
    fn cubes() -> HexMesh {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1000 };
        let mut mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(6.0) }, &options).unwrap();
        let set = |name: &str| TagSet { groups: vec![name.into()], ..TagSet::default() };
        let below = |hex: &[NodeId; 8]| u32::from(mesh.positions[hex[0].index()].z < 3.0);
        let of_element: Vec<u32> = mesh.hexes.iter().map(below).collect();
        mesh.tags = Tags { sets: vec![set("above"), set("below")], of_element };
        let sides: Vec<Side> = (0..mesh.hexes.len() as u32).step_by(3).map(|hex| 6 * hex + 4).collect();
        let of_element = vec![0; sides.len()];
        mesh.groups = FaceGroups::new(sides, Tags { sets: vec![set("lids")], of_element }).unwrap();
        mesh
    }

    proptest! {
        /// Hexes at the nodes of the refined ones tell all.
        #[test]
        fn a_part_is_joined_like_the_whole(refined in prop::collection::btree_set(0..216u32, 1..40)) {
            let whole = StageMesh::of_mesh(&cubes(), &Silent).unwrap();
            let refined: Vec<u32> = refined.into_iter().collect();
            let mut is_refined = vec![false; whole.hexes.len()];
            refined.iter().for_each(|&hex| is_refined[hex as usize] = true);
            let around = Grouping::of(whole.positions.len(), &whole.hexes, &Silent).unwrap().around(&refined);
            let part = Part::of(&whole, around, &Silent).unwrap();
            let told = |joined: Joining| match joined {
                Joining::Possible => ("possible", Vec::new()),
                Joining::Conflict(hexes) => ("conflict", hexes),
                Joining::Ungrouped(hexes) => ("ungrouped", hexes),
            };
            let expected = told(joining(&whole, &is_refined, &Silent).unwrap());
            let mut found = told(joining(&part.mesh, &part.flags(&is_refined), &Silent).unwrap());
            part.number_as_whole(&mut found.1);
            prop_assert_eq!(found, expected);
        }
    }
}
