//! Cuts polygons into triangles.

use super::Soup;
use crate::geometry::{Extent, Point, triangulate};
use crate::mesh::check::check_faces;
use crate::mesh::{FaceId, NodeId, PolygonMesh};
use crate::monitor::batches;
use crate::parallel;
use crate::solid::error::SolidError;
use crate::solid::shell::{NONE, Triangles};
use crate::{Cancelled, Monitor};

/// The triangles of the polygons of a surface that is sound; a polygon that is there again is cut along the same diagonals. `first`
/// tells for each node the first in its place.
pub(super) fn triangles(
    surface: &PolygonMesh,
    first: &[u32],
    monitor: &dyn Monitor,
) -> Result<Soup, SolidError> {
    use crate::mesh::Defect::{BrokenOffsets, NodeOutOfRange, NotFinite, TooFewNodes};
    if surface.face_count() == 0 {
        return Err(SolidError::Empty);
    }
    let broken = check_faces(surface, monitor)?.into_iter().find(|defect| {
        matches!(defect, BrokenOffsets { .. } | NodeOutOfRange { .. } | NotFinite { .. } | TooFewNodes { .. })
    });
    if let Some(defect) = broken {
        return Err(SolidError::Broken(defect));
    }
    let extent = Extent::of(points_of(surface));
    let has_digits = extent.size == 0.0 || extent.has_digits_for(extent.size);
    if !(extent.is_in_range() && has_digits) {
        let Extent { size, reach } = extent;
        return Err(SolidError::Extent { size, reach });
    }
    let again = given_again(surface, first, monitor)?;
    let mut of_face = vec![NONE; if again.is_empty() { 0 } else { surface.face_count() }];
    (0..).zip(&again).for_each(|(k, again)| of_face[again.face] = k);
    let (mut triangles, mut face_of) = (Vec::new(), Vec::new());
    let (mut corners, mut local) = (Vec::new(), Vec::new());
    for batch in batches(surface.face_count(), monitor) {
        for f in batch? {
            let again = of_face.get(f).and_then(|&k| again.get(k as usize));
            let shown = again.map_or(f, |again| again.shown);
            corners.clear();
            corners.extend(surface.face(shown).iter().map(|n| surface.positions[n.index()]));
            local.clear();
            triangulate(&corners, &mut local);
            let nodes = surface.face(f);
            triangles.extend(
                local.iter().map(|&t| again.map_or(t, |again| again.of(t)).map(|i| nodes[i as usize].0)),
            );
            face_of.resize(triangles.len(), FaceId::new(f));
        }
    }
    let vertex_of = (0..surface.positions.len() as u32).collect();
    Ok(Soup { mesh: Triangles { points: surface.positions.clone(), triangles }, face_of, vertex_of })
}

/// Where the corners of the polygons are: a file may have points besides.
pub(super) fn points_of(surface: &PolygonMesh) -> impl Iterator<Item = &Point> {
    surface.corners.iter().map(|n| &surface.positions[n.index()])
}

/// A polygon that is there again.
struct Again {
    face: usize,
    /// The first polygon like it.
    shown: usize,
    corners: u32,
    /// Where the first corner of that one is among its own, and whether it runs the other way.
    start: u32,
    is_turned: bool,
}

impl Again {
    /// A triangle of the first one as that of this.
    fn of(&self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        let corner = |k: u32| {
            let step = if self.is_turned { self.corners - k } else { k };
            (self.start + step) % self.corners
        };
        if self.is_turned { [a, c, b].map(corner) } else { [a, b, c].map(corner) }
    }
}

/// The polygons of four corners and more that are there again.
fn given_again(surface: &PolygonMesh, first: &[u32], monitor: &dyn Monitor) -> Result<Vec<Again>, Cancelled> {
    // Few that differ have the same four least corners.
    let key = |f: usize| {
        let mut least = [u32::MAX; 4];
        for corner in surface.face(f).iter().map(|n| first[n.index()]) {
            if corner < least[3] {
                least[3] = corner;
                least.sort_unstable();
            }
        }
        let [a, b, c, d] = least.map(u64::from);
        ([a << 32 | b, c << 32 | d, 0], f as u32)
    };
    let mut keys: Vec<([u64; 3], u32)> = Vec::new();
    for batch in batches(surface.face_count(), monitor) {
        keys.extend(batch?.filter(|&f| surface.face(f).len() > 3).map(key));
    }
    parallel::sort(&mut keys);
    let mut again = Vec::new();
    for same in keys.chunk_by(|a, b| a.0 == b.0) {
        let others = same[1..].iter().map(|key| key.1 as usize);
        again.extend(others.filter_map(|face| like(surface, first, same[0].1 as usize, face)));
    }
    Ok(again)
}

/// How a polygon is another one, if it is.
fn like(surface: &PolygonMesh, first: &[u32], shown: usize, face: usize) -> Option<Again> {
    let [theirs, ours] = [shown, face].map(|f| surface.face(f));
    let place = |n: NodeId| first[n.index()];
    let start =
        ours.iter().position(|&n| place(n) == place(theirs[0])).filter(|_| theirs.len() == ours.len())?;
    let corners = ours.len() as u32;
    let way = |is_turned| Again { face, shown, corners, start: start as u32, is_turned };
    [false, true].map(way).into_iter().find(|again| {
        (0..corners).all(|k| {
            let [at, ..] = again.of([k, k, k]);
            place(theirs[k as usize]) == place(ours[at as usize])
        })
    })
}
