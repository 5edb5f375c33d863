//! A part of a mesh as a mesh of its own, so that what is asked of it again and again takes no look at the rest.

use super::labels::Label;
use super::stage::StageMesh;
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::topology::Side;
use crate::{Cancelled, Monitor};

/// A part is looked at alone if it has no more than the hexes of the whole over this.
const FEW: usize = 8;

/// All that there is: the hexes of a mesh, or the elements of a level of the trees.
#[derive(Clone, Copy)]
pub(super) struct Whole<'a> {
    pub(super) positions: &'a [Point],
    pub(super) hexes: &'a [[NodeId; 8]],
    /// The labels of their faces, ascending.
    pub(super) labels: &'a [Label],
    /// The input hex of each, and the material of each of these; empty if there is one material.
    pub(super) root: &'a [u32],
    pub(super) materials: &'a [u32],
    /// See [`StageMesh::has_free_boundary`].
    pub(super) has_free_boundary: bool,
}

impl Whole<'_> {
    /// The hexes that share a node with one of these, or are one, ascending.
    fn around(&self, hexes: &[u32]) -> Vec<u32> {
        let mut is_near = vec![false; self.positions.len()];
        for node in hexes.iter().flat_map(|&hex| self.hexes[hex as usize]) {
            is_near[node.index()] = true;
        }
        let is_around = |hex: &u32| self.hexes[*hex as usize].iter().any(|n| is_near[n.index()]);
        (0..self.hexes.len() as u32).filter(is_around).collect()
    }
}

/// Some of the hexes.
pub(super) struct Part {
    /// The hexes, with their nodes alone, both in the order of the whole.
    pub(super) mesh: StageMesh,
    /// Which of the whole each is.
    hexes: Vec<u32>,
}

impl Part {
    /// The hexes at nodes of the refined ones, which tell all about how these meet the rest. None unless they are few.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub(super) fn around(
        whole: Whole<'_>,
        refined: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<Option<Self>, Cancelled> {
        if refined.len() > whole.hexes.len() / FEW {
            return Ok(None);
        }
        let around = whole.around(refined);
        if around.len() > whole.hexes.len() / FEW {
            return Ok(None);
        }
        Self::of(whole, around, monitor).map(Some)
    }

    /// The part of these hexes, which ascend.
    fn of(whole: Whole<'_>, hexes: Vec<u32>, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
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
        mesh.has_free_boundary = whole.has_free_boundary;
        if !whole.materials.is_empty() {
            let material = |&hex: &u32| whole.materials[whole.root[hex as usize] as usize];
            mesh.materials = hexes.iter().map(material).collect();
        }
        Ok(Self { mesh, hexes })
    }

    /// What is so for each hex of the whole, for those of the part.
    pub(super) fn flags(&self, of_whole: &[bool]) -> Vec<bool> {
        self.hexes.iter().map(|&hex| of_whole[hex as usize]).collect()
    }

    /// Gives hexes of the part their numbers in the whole.
    pub(super) fn number_as_whole(&self, hexes: &mut [u32]) {
        hexes.iter_mut().for_each(|hex| *hex = self.hexes[*hex as usize]);
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use proptest::prelude::*;

    use super::super::interface::Interface;
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
            let around = whole.whole().around(&refined);
            let part = Part::of(whole.whole(), around, &Silent).unwrap();
            let flags = part.flags(&is_refined);
            let told = |joined: Joining| match joined {
                Joining::Possible => ("possible", Vec::new()),
                Joining::Conflict(hexes) => ("conflict", hexes),
                Joining::Ungrouped(hexes) => ("ungrouped", hexes),
            };
            let expected = told(joining(&whole, &is_refined, &Silent).unwrap());
            let mut found = told(joining(&part.mesh, &flags, &Silent).unwrap());
            part.number_as_whole(&mut found.1);
            prop_assert_eq!(found, expected);
            let faces = |whole: Whole<'_>, refined: &[bool]| {
                Interface::new(whole, refined, &Silent).unwrap().faces(&Silent).unwrap().len()
            };
            prop_assert_eq!(faces(part.mesh.whole(), &flags), faces(whole.whole(), &is_refined));
        }
    }

    #[test]
    fn a_part_is_looked_at_alone_where_it_is_small() {
        let cubes = StageMesh::of_mesh(&cubes(), &Silent).unwrap();
        let around = |refined: &[u32]| Part::around(cubes.whole(), refined, &Silent).unwrap();
        assert_eq!(around(&[0]).map(|part| part.hexes), Some(vec![0, 1, 6, 7, 36, 37, 42, 43]));
        assert!(around(&[0, 5]).is_some() && around(&[0, 5, 30, 35]).is_none());
        assert!(around(&(0..28).collect::<Vec<u32>>()).is_none());
    }
}
