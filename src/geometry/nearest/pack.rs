//! Packs facets into a tree of boxes: each leaf and branch is full but for the last of a group.

use std::ops::Range;

use super::super::boxes::{Boxes, Cube};
use super::super::lanes::SINGLES;
use super::super::{Aabb, Point};
use super::{Below, Branch, Facet, NearestFacet, NearestTriangle, Numbered, Part, Tree};
use crate::{Cancelled, Monitor, Silent};

/// The monitor is asked before more facets than this are split.
const MANY: usize = 1 << 14;

impl<F: Facet<Shared = ()>> NearestFacet<F> {
    /// An index of facets with finite corners that share nothing.
    ///
    /// # Panics
    /// If there are more than 2^31 facets.
    pub(crate) fn new(facets: impl IntoIterator<Item = F>) -> Self {
        Self::sharing((), facets, &Silent).expect("nobody stops it")
    }
}

impl NearestTriangle {
    /// An index of triangles with finite corners, each with points of its own.
    ///
    /// # Panics
    /// If they have more than 2^31 points.
    pub(crate) fn of(triangles: impl IntoIterator<Item = [Point; 3]>) -> Self {
        let points: Vec<Point> = triangles.into_iter().flatten().collect();
        let count = i32::try_from(points.len()).expect("no more than 2^31 points") as u32 / 3;
        let corners = (0..count).map(|t| [0, 1, 2].map(|k| 3 * t + k));
        Self::sharing(points, corners, &Silent).expect("nobody stops it")
    }
}

impl<F: Facet> NearestFacet<F> {
    /// As [`new`](Self::new), of facets that share something, unless a monitor stops it.
    ///
    /// # Errors
    /// If the monitor stops it.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub(crate) fn sharing(
        shared: F::Shared,
        facets: impl IntoIterator<Item = F>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let facets: Vec<_> = (0..).zip(facets).map(|(k, facet)| Numbered::new(k, facet)).collect();
        let all = 0..facets.len();
        Self::packed(shared, facets, &[all], monitor)
    }

    /// An index of groups of facets, each with its number, which may be searched by themselves too. Numbers ascend in a group.
    ///
    /// # Errors
    /// If the monitor stops it.
    ///
    /// # Panics
    /// If there are more than 2^31 facets, or none in a group.
    pub(crate) fn of_groups<G: IntoIterator<Item = (usize, F)>>(
        shared: F::Shared,
        groups: impl IntoIterator<Item = G>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mut facets = Vec::new();
        let mut add = |group: G| {
            let start = facets.len();
            facets.extend(group.into_iter().map(|(number, facet)| Numbered::new(number, facet)));
            assert!(start < facets.len(), "a group has facets");
            start..facets.len()
        };
        let places: Vec<_> = groups.into_iter().map(&mut add).collect();
        facets.shrink_to_fit();
        Self::packed(shared, facets, &places, monitor)
    }

    fn packed(
        shared: F::Shared,
        mut facets: Vec<Numbered<F>>,
        groups: &[Range<usize>],
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        for places in groups {
            rearrange(&shared, &mut facets[places.clone()], monitor)?;
        }
        let shelves = Shelves {
            count: facets.len(),
            together: F::TOGETHER,
            around: &|places| around(&shared, &facets[places]),
            monitor,
        };
        Ok(Self { tree: Tree::packed(groups, &shelves)?, facets, shared })
    }
}

/// Facets in the order of a tree.
struct Shelves<'a> {
    count: usize,
    /// How many are in a leaf.
    together: usize,
    /// The box around those at some places.
    around: &'a dyn Fn(Range<usize>) -> Aabb,
    monitor: &'a dyn Monitor,
}

impl Tree {
    fn packed(groups: &[Range<usize>], facets: &Shelves<'_>) -> Result<Self, Cancelled> {
        let bounds = (facets.around)(0..facets.count);
        let mut tree = Self {
            all: Part { root: Below::leaf(0), leaves: 0..0 },
            groups: Vec::new(),
            branches: Vec::new(),
            leaves: Vec::new(),
            cube: Cube::around(&bounds),
            extent: bounds.min.abs().max(bounds.max.abs()).max_element(),
        };
        let mut roots = Vec::new();
        for places in groups {
            let first = tree.leaves.len() as u32;
            let (root, bounds) = tree.add(places.clone(), facets)?;
            roots.push((root, bounds));
            tree.groups.push(Part { root, leaves: first..tree.leaves.len() as u32 });
        }
        let middle = |(index, (_, bounds)): (u32, &(Below, Aabb))| Middle { at: bounds.center(), index };
        let mut order: Vec<Middle> = (0..).zip(&roots).map(middle).collect();
        sort(&mut order, 1, facets.monitor)?;
        let in_order: Vec<_> = order.into_iter().map(|root| roots[root.index as usize]).collect();
        let (root, _) = tree.join(&in_order);
        tree.all = Part { root, leaves: 0..tree.leaves.len() as u32 };
        tree.leaves.push(facets.count as u32);
        tree.branches.shrink_to_fit();
        tree.leaves.shrink_to_fit();
        Ok(tree)
    }

    /// Adds what is below the box around the facets at these places. That box too.
    fn add(&mut self, places: Range<usize>, facets: &Shelves<'_>) -> Result<(Below, Aabb), Cancelled> {
        if places.len() > MANY {
            facets.monitor.proceed()?;
        }
        if places.len() <= facets.together {
            self.leaves.push(places.start as u32);
            return Ok((Below::leaf(self.leaves.len() - 1), (facets.around)(places)));
        }
        let full = full(places.len(), facets.together);
        let starts = places.clone().step_by(full);
        self.branch(starts, |tree, start| tree.add(start..places.end.min(start + full), facets))
    }

    /// Adds what is above the roots of groups.
    fn join(&mut self, roots: &[(Below, Aabb)]) -> (Below, Aabb) {
        if let &[only] = roots {
            return only;
        }
        let parts = roots.chunks(full(roots.len(), 1));
        self.branch(parts, |tree, part| Ok(tree.join(part))).expect("nobody stops it")
    }

    /// Adds a branch before what is below it.
    fn branch<T>(
        &mut self,
        parts: impl Iterator<Item = T>,
        mut add: impl FnMut(&mut Self, T) -> Result<(Below, Aabb), Cancelled>,
    ) -> Result<(Below, Aabb), Cancelled> {
        let place = self.branches.len();
        self.branches.push(Branch { boxes: Boxes::NONE, below: [Below::branch(place); SINGLES] });
        let mut all = Aabb::EMPTY;
        for (lane, part) in parts.enumerate() {
            let (below, bounds) = add(self, part)?;
            let branch = &mut self.branches[place];
            branch.below[lane] = below;
            branch.boxes.set(lane, &self.cube, &bounds);
            all = all.with(bounds.min).with(bounds.max);
        }
        Ok((Below::branch(place), all))
    }
}

impl<F> Numbered<F> {
    fn new(number: usize, facet: F) -> Self {
        Self { facet, index: i32::try_from(number).expect("no more than 2^31 facets") as u32 }
    }
}

/// The middle of what is put in order, and its place before.
#[derive(Clone, Copy)]
struct Middle {
    at: Point,
    index: u32,
}

/// Puts facets in the order of the tree, where some of them are looked at together.
fn sort(facets: &mut [Middle], together: usize, monitor: &dyn Monitor) -> Result<(), Cancelled> {
    if facets.len() > MANY {
        monitor.proceed()?;
    }
    if facets.len() > together {
        let size = Aabb::around(facets.iter().map(|f| &f.at)).size();
        let axis = (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
        let along = |a: &Middle, b: &Middle| a.at[axis].total_cmp(&b.at[axis]).then(a.index.cmp(&b.index));
        let full = full(facets.len(), together);
        // Half of the parts.
        let left = facets.len().div_ceil(full).div_ceil(2) * full;
        facets.select_nth_unstable_by(left, along);
        let (left, right) = facets.split_at_mut(left);
        sort(left, together, monitor)?;
        sort(right, together, monitor)?;
    }
    Ok(())
}

/// Puts facets in the order of the tree without a second array of them: around one circle of places after the other.
fn rearrange<F: Facet>(
    shared: &F::Shared,
    facets: &mut [Numbered<F>],
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let middle = |facet: &F| {
        let corners = facet.corners(shared);
        corners.as_ref().iter().sum::<Point>() / corners.as_ref().len() as f64
    };
    let at_place = |(index, of): (u32, &Numbered<F>)| Middle { index, at: middle(&of.facet) };
    let mut from: Vec<Middle> = (0..).zip(&*facets).map(at_place).collect();
    sort(&mut from, F::TOGETHER, monitor)?;
    for first in 0..from.len() {
        let mut place = first;
        loop {
            let next = std::mem::replace(&mut from[place].index, place as u32) as usize;
            if next == first || next == place {
                break;
            }
            facets.swap(place, next);
            place = next;
        }
    }
    Ok(())
}

/// How many of so many facets are in each part of a branch, but for the last: what is below it is full.
fn full(count: usize, together: usize) -> usize {
    let mut full = together;
    while SINGLES * full < count {
        full *= SINGLES;
    }
    full
}

/// The box around some facets.
fn around<F: Facet>(shared: &F::Shared, facets: &[Numbered<F>]) -> Aabb {
    let mut all = Aabb::EMPTY;
    for numbered in facets {
        for &corner in numbered.facet.corners(shared).as_ref() {
            all = all.with(corner);
        }
    }
    all
}
