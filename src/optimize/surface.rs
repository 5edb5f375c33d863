//! The surface on which nodes are kept: patches that meet at curves. It is the boundary of a mesh, and what lies between
//! the materials in it.
//!
//! 1. Faces that meet at less than the ridge angle and are of the same kind belong to one patch.
//! 2. The other edges are curves, one for each pair of patches (a patch with itself at a crease that ends inside it), or
//!    for each set of patches where materials meet.
//! 3. A patch whose normals all agree is a plane, a curve whose edges all agree is straight: there nothing is looked
//!    up, and nodes stay to the last bits. On the others a node goes to the nearest point (`piece`).

use std::collections::BTreeMap;

use super::piece::{PatchFacet, Piece, triangles_of};
use crate::geometry::{NearestTriangle, Point, area_vector};
use crate::mesh::topology::{Sets, disagrees, edge_ids};
use crate::mesh::{EdgeId, Edges, Faces, topology::EdgeUses};
use crate::{Cancelled, Monitor, Silent, parallel};

/// Edges between two questions whether to stop.
const SILENT: usize = 1 << 16;

/// What a face of the surface parts, and the group that it is in. Patches end where this changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FaceKind {
    /// The number of its group, `u32::MAX` for none.
    pub group: u32,
    /// The materials on its two sides, ascending; the second is [`FaceKind::OUTSIDE`] on the boundary.
    pub materials: [u32; 2],
}

impl FaceKind {
    /// What is beyond the boundary.
    pub const OUTSIDE: u32 = u32::MAX;

    /// A boundary face of a material.
    pub fn boundary(group: u32, material: u32) -> Self {
        Self { group, materials: [material, Self::OUTSIDE] }
    }

    /// A face between two materials; none if they are one.
    pub fn between([a, b]: [u32; 2], group: impl FnOnce() -> u32) -> Option<Self> {
        (a != b).then(|| Self { group: group(), materials: [a.min(b), a.max(b)] })
    }

    /// Is it between two materials?
    pub fn is_inner(&self) -> bool {
        self.materials[1] != Self::OUTSIDE
    }
}

/// A surface in patches and curves.
#[derive(Debug, Default)]
pub struct BoundarySurface {
    patches: Vec<Piece>,
    curves: Vec<Piece>,
    /// The triangles of each kind, where there are several.
    of_kind: BTreeMap<FaceKind, PatchTriangles>,
    /// The curve between two patches, the lesser first.
    curve_between: BTreeMap<[u32; 2], u32>,
    /// The curve where materials meet, by the patches there, ascending.
    curve_among: BTreeMap<Vec<u32>, u32>,
    /// The patches that end at each curve.
    ends_at: Vec<Vec<u32>>,
    /// All triangles.
    all: Option<PatchTriangles>,
}

/// Triangles, and the patch of each.
#[derive(Debug)]
struct PatchTriangles {
    nearest: NearestTriangle,
    patch: Vec<u32>,
}

impl PatchTriangles {
    /// Where two are equally near the first counts.
    fn new(triangles: impl IntoIterator<Item = (u32, [Point; 3])>) -> Self {
        let (patch, triangles): (Vec<u32>, Vec<[Point; 3]>) = triangles.into_iter().unzip();
        Self { nearest: NearestTriangle::of(triangles), patch }
    }

    /// The patch nearest to `p`.
    fn patch_at(&self, p: Point) -> Option<u32> {
        self.nearest.nearest(p).map(|nearest| self.patch[nearest.facet])
    }
}

impl BoundarySurface {
    /// Patches of a surface; edges at which faces meet at more than `ridge_degrees` are curves, as are edges of any
    /// other number of faces than two. Node ids are in range, positions finite.
    pub fn new(surface: &impl Faces, ridge_degrees: f64) -> Self {
        let kind = |_| FaceKind::boundary(0, 0);
        Self::of_kinds(surface, ridge_degrees, kind, &Silent).expect("nobody stops it")
    }

    /// The same, with curves also between faces of different kinds.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn of_kinds(
        surface: &impl Faces,
        ridge_degrees: f64,
        kind: impl Fn(usize) -> FaceKind,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let edges = Edges::monitored(surface, monitor)?;
        let uses = EdgeUses::monitored(&edges, monitor)?;
        let positions = surface.positions();
        let corners =
            |f: usize| -> Vec<Point> { surface.nodes_of(f).iter().map(|n| positions[n.index()]).collect() };
        let normal = |f: usize| area_vector(&corners(f)).normalize_or_zero();
        let normals: Vec<Point> = parallel::try_collect(surface.face_count(), monitor, normal)?;
        let ridge_cosine = libm::cos(ridge_degrees.to_radians());
        let faces_at = |e: EdgeId| uses.at(e).iter().map(|&k| surface.face_of(k as usize));
        let is_smooth = |e: EdgeId| {
            let faces: Vec<usize> = faces_at(e).collect();
            let &[f, g] = faces.as_slice() else { return false };
            let cosine = normals[f].dot(normals[g]);
            kind(f) == kind(g) && (if disagrees(surface, &uses, e) { -cosine } else { cosine }) > ridge_cosine
        };
        let mut sets = Sets::new(surface.face_count());
        let mut ridges = Vec::new();
        for (k, e) in edge_ids(&edges).enumerate() {
            if k % SILENT == 0 {
                monitor.proceed()?;
            }
            if is_smooth(e) {
                let faces: Vec<usize> = faces_at(e).collect();
                sets.join(faces[0] as u32, faces[1] as u32, false);
            } else {
                ridges.push(e);
            }
        }
        let patch_of_face = sets.numbers();
        monitor.proceed()?;
        let patch_count = patch_of_face.iter().max().map_or(0, |&p| p as usize + 1);
        let mut by_patch = vec![Vec::new(); patch_count];
        let mut by_kind: BTreeMap<FaceKind, Vec<(u32, [Point; 3])>> = BTreeMap::new();
        let mut triangles = Vec::new();
        for (f, &patch) in patch_of_face.iter().enumerate() {
            let corners = corners(f);
            PatchFacet::of_face(&corners, &mut by_patch[patch as usize]);
            let first = triangles.len();
            triangles.extend(triangles_of(&corners).map(|t| (patch, t)));
            by_kind.entry(kind(f)).or_default().extend_from_slice(&triangles[first..]);
        }
        monitor.proceed()?;
        if by_kind.len() == 1 {
            by_kind.clear();
        }
        let mut of_kind = BTreeMap::new();
        for (kind, mut triangles) in by_kind {
            monitor.proceed()?;
            triangles.sort_by_key(|&(patch, _)| patch);
            of_kind.insert(kind, PatchTriangles::new(triangles));
        }
        let mut by_pair: BTreeMap<[u32; 2], Vec<[Point; 2]>> = BTreeMap::new();
        let mut by_set: BTreeMap<Vec<u32>, Vec<[Point; 2]>> = BTreeMap::new();
        for e in ridges {
            let ends = edges.ends[e.index()].map(|n| positions[n.index()]);
            let patches = || faces_at(e).map(|f| patch_of_face[f]);
            let of_curve = if uses.at(e).len() > 2 && faces_at(e).any(|f| kind(f).is_inner()) {
                by_set.entry(ascending(patches())).or_default()
            } else {
                by_pair.entry(pair(patches())).or_default()
            };
            of_curve.push(ends);
        }
        let (mut curve_between, mut curve_among) = (BTreeMap::new(), BTreeMap::new());
        for (pair, curve) in by_pair.keys().zip(0..) {
            curve_between.insert(*pair, curve);
        }
        for (set, curve) in by_set.keys().zip(by_pair.len() as u32..) {
            curve_among.insert(set.clone(), curve);
        }
        let ends_at = by_pair.keys().map(|pair| pair.to_vec()).chain(by_set.keys().cloned()).collect();
        let told = |piece| monitor.proceed().map(|()| piece);
        let patches = by_patch.into_iter().map(|facets| told(Piece::patch(facets)));
        let patches = patches.collect::<Result<Vec<Piece>, _>>()?;
        let curves =
            by_pair.into_values().chain(by_set.into_values()).map(|edges| told(Piece::curve(&edges)));
        let curves = curves.collect::<Result<Vec<Piece>, _>>()?;
        let all = Some(PatchTriangles::new(triangles));
        Ok(Self { patches, curves, of_kind, curve_between, curve_among, ends_at, all })
    }

    /// The patch nearest to `p`; `None` if the surface has no faces.
    pub fn patch_at(&self, p: Point) -> Option<u32> {
        self.all.as_ref()?.patch_at(p)
    }

    /// The patch nearest to `p` of those of a kind; `None` if there is none.
    pub fn patch_of(&self, kind: FaceKind, p: Point) -> Option<u32> {
        if self.of_kind.is_empty() {
            return self.patch_at(p);
        }
        self.of_kind.get(&kind)?.patch_at(p)
    }

    /// The curve between two patches, or within one.
    pub(super) fn curve_between(&self, patches: [u32; 2]) -> Option<u32> {
        self.curve_between.get(&pair(patches.into_iter())).copied()
    }

    /// The curve where materials meet and these patches are all that meet.
    pub(super) fn curve_among(&self, patches: impl Iterator<Item = u32>) -> Option<u32> {
        self.curve_among.get(&ascending(patches)).copied()
    }

    /// Does a patch end at a curve?
    pub(super) fn is_at_curve(&self, patch: u32, curve: u32) -> bool {
        self.ends_at[curve as usize].contains(&patch)
    }

    /// Is a patch in a plane?
    pub(super) fn is_planar(&self, patch: u32) -> bool {
        self.patches[patch as usize].constant.is_some()
    }

    /// Is a curve straight?
    pub(super) fn is_straight(&self, curve: u32) -> bool {
        self.curves[curve as usize].constant.is_some()
    }

    /// Are all patches that end at a curve planar? Then it is straight, or these are in one plane.
    pub(super) fn is_in_plane(&self, curve: u32) -> bool {
        self.ends_at[curve as usize].iter().all(|&patch| self.is_planar(patch))
    }

    /// The point of a curve nearest to `p`.
    pub(super) fn closest_on_curve(&self, curve: u32, p: Point) -> Point {
        self.curves[curve as usize].closest(p)
    }

    /// The point of a patch nearest to `p`.
    pub(super) fn closest_on_patch(&self, patch: u32, p: Point) -> Point {
        self.patches[patch as usize].closest(p)
    }

    /// How far `p` is from a curve.
    pub(super) fn distance_to_curve(&self, curve: u32, p: Point) -> f64 {
        self.closest_on_curve(curve, p).distance(p)
    }

    /// How far `p` is from a patch.
    pub(super) fn distance_to_patch(&self, patch: u32, p: Point) -> f64 {
        self.closest_on_patch(patch, p).distance(p)
    }

    /// The unit normal of a patch where `p` is nearest to it.
    pub(super) fn normal(&self, patch: u32, p: Point) -> Point {
        self.patches[patch as usize].direction(p)
    }

    /// The unit direction of a curve where `p` is nearest to it.
    pub(super) fn tangent(&self, curve: u32, p: Point) -> Point {
        self.curves[curve as usize].direction(p)
    }

    /// The point of a patch to which `p` belongs, for a node that was at `anchor` at first.
    pub(super) fn onto_patch(&self, patch: u32, anchor: Point, p: Point) -> Point {
        let piece = &self.patches[patch as usize];
        match piece.constant {
            Some(normal) => p - normal * normal.dot(p - anchor),
            None => piece.closest(p),
        }
    }

    /// The point of a curve to which `p` belongs, for a node that was at `anchor` at first.
    pub(super) fn onto_curve(&self, curve: u32, anchor: Point, p: Point) -> Point {
        let piece = &self.curves[curve as usize];
        match piece.constant {
            Some(direction) => anchor + direction * direction.dot(p - anchor),
            None => piece.closest(p),
        }
    }
}

/// The least and the greatest of some patches.
fn pair(patches: impl Iterator<Item = u32>) -> [u32; 2] {
    patches.fold([u32::MAX, 0], |[low, high], p| [low.min(p), high.max(p)])
}

/// Each of some patches once, ascending.
fn ascending(patches: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut patches: Vec<u32> = patches.collect();
    patches.sort_unstable();
    patches.dedup();
    patches
}
