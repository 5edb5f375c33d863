//! From the polygons of a file to a closed, manifold, outward shell of triangles.
//!
//! 1. Polygons are checked and cut into triangles.
//! 2. Points at the same place are welded; triangles that lose a corner go.
//! 3. Every edge must have two triangles.
//! 4. The triangles of each component are made to agree, and then to look outward, by the sign of its volume.
//! 5. Where fans of triangles share a point alone, each gets its own.

use super::error::SolidError;
use super::options::SolidReport;
use super::shell::{EdgeTable, Shell, Triangles};
use crate::geometry::{Point, triangulate};
use crate::mesh::topology::{Sets, disagrees, edge_ids};
use crate::mesh::{FaceId, PolygonMesh, check_polygons};
use crate::{Monitor, parallel};

/// Triangles, and for each the face of the file that it is part of.
struct Soup {
    mesh: Triangles,
    face_of: Vec<FaceId>,
}

/// Makes a shell of a surface; what was mended is added to `report`.
pub(super) fn import(
    surface: &PolygonMesh,
    report: &mut SolidReport,
    monitor: &dyn Monitor,
) -> Result<Shell, SolidError> {
    let mut soup = triangles(surface)?;
    report.welded_points = weld_exactly(&mut soup.mesh);
    report.degenerate_triangles = drop_degenerate(&mut soup);
    if soup.face_of.is_empty() {
        return Err(SolidError::Empty);
    }
    monitor.proceed()?;
    let table = EdgeTable::new(&soup.mesh, monitor)?;
    refuse_open(&soup, &table)?;
    report.turned_triangles = orient(&mut soup, &table)?;
    // Which half-edges are twins does not depend on their order, but their numbers do.
    let table = EdgeTable::new(&soup.mesh, monitor)?;
    let mut shell = Shell::new(soup.mesh, &table);
    report.split_points = split_points(&mut shell);
    Ok(shell)
}

fn triangles(surface: &PolygonMesh) -> Result<Soup, SolidError> {
    if surface.face_count() == 0 {
        return Err(SolidError::Empty);
    }
    use crate::mesh::Defect::{BrokenOffsets, NodeOutOfRange, NotFinite, TooFewNodes};
    let broken = check_polygons(surface).into_iter().find(|defect| {
        matches!(defect, BrokenOffsets { .. } | NodeOutOfRange { .. } | NotFinite { .. } | TooFewNodes { .. })
    });
    if let Some(defect) = broken {
        return Err(SolidError::Broken(defect));
    }
    let mut soup = Soup {
        mesh: Triangles { points: surface.positions.clone(), triangles: Vec::new() },
        face_of: Vec::new(),
    };
    let (mut corners, mut local) = (Vec::new(), Vec::new());
    for (f, nodes) in surface.faces().enumerate() {
        corners.clear();
        corners.extend(nodes.iter().map(|n| surface.positions[n.index()]));
        local.clear();
        triangulate(&corners, &mut local);
        soup.mesh.triangles.extend(local.iter().map(|t| t.map(|i| nodes[i as usize].0)));
        soup.face_of.resize(soup.mesh.triangles.len(), FaceId::new(f));
    }
    Ok(soup)
}

/// Makes points with the same coordinates one, and drops those that no triangle uses. Returns how many were one with
/// another.
fn weld_exactly(mesh: &mut Triangles) -> usize {
    // Adding 0 makes of -0 a 0, whose bits differ.
    let key = |v: u32| (mesh.points[v as usize] + 0.0).to_array().map(f64::to_bits);
    let mut order: Vec<u32> = (0..mesh.points.len() as u32).collect();
    order.sort_by_cached_key(|&v| (key(v), v));
    let mut first: Vec<u32> = (0..mesh.points.len() as u32).collect();
    let mut welded = 0;
    for pair in order.windows(2) {
        if key(pair[0]) == key(pair[1]) {
            first[pair[1] as usize] = first[pair[0] as usize];
            welded += 1;
        }
    }
    renumber(mesh, &first);
    welded
}

/// Gives each corner the vertex that stands for it, and drops the vertices that are then used no more.
fn renumber(mesh: &mut Triangles, stands_for: &[u32]) {
    let mut new = vec![u32::MAX; mesh.points.len()];
    let mut points = Vec::new();
    for v in mesh.triangles.as_flattened_mut() {
        let old = stands_for[*v as usize] as usize;
        if new[old] == u32::MAX {
            new[old] = points.len() as u32;
            points.push(mesh.points[old]);
        }
        *v = new[old];
    }
    mesh.points = points;
}

/// Drops triangles that have a vertex twice.
fn drop_degenerate(soup: &mut Soup) -> usize {
    let keeps = |[a, b, c]: [u32; 3]| a != b && b != c && c != a;
    let kept = parallel::filter(soup.face_of.len(), |t| keeps(soup.mesh.triangles[t]));
    let dropped = soup.face_of.len() - kept.len();
    soup.mesh.triangles = kept.iter().map(|&t| soup.mesh.triangles[t as usize]).collect();
    soup.face_of = kept.iter().map(|&t| soup.face_of[t as usize]).collect();
    dropped
}

fn refuse_open(soup: &Soup, table: &EdgeTable) -> Result<(), SolidError> {
    let place = |e: crate::mesh::EdgeId| {
        let [a, b] = table.edges.ends[e.index()].map(|n| soup.mesh.points[n.index()]);
        a.midpoint(b)
    };
    let faces = |e| table.uses.at(e).iter().map(|&k| soup.face_of[k as usize / 3]);
    let many = table.with_uses(|n| n > 2);
    if let Some(&e) = many.first() {
        return Err(SolidError::NonManifold { edges: many.len(), at: place(e), faces: faces(e).collect() });
    }
    let open = table.with_uses(|n| n == 1);
    if let Some(&e) = open.first() {
        let face = faces(e).next().expect("one face");
        return Err(SolidError::Open { edges: open.len(), at: place(e), face });
    }
    Ok(())
}

/// Makes the triangles of each component agree and look outward. Returns how many were turned.
fn orient(soup: &mut Soup, table: &EdgeTable) -> Result<usize, SolidError> {
    let count = soup.face_of.len();
    let mut sides = Sets::new(count);
    for e in edge_ids(&table.edges) {
        let [k, l] = [table.uses.at(e)[0], table.uses.at(e)[1]];
        if !sides.join(k / 3, l / 3, disagrees(&soup.mesh, &table.uses, e)) {
            let t = k as usize / 3;
            return Err(SolidError::OneSided { at: soup.mesh.at(t)[0], face: soup.face_of[t] });
        }
    }
    // Volumes about a point of the component itself, so that they are exact however far off it is.
    let mut volume = vec![0.0; count];
    for t in 0..count {
        let (root, odd) = sides.root(t as u32);
        let origin = soup.mesh.at(root as usize)[0];
        let [a, b, c] = soup.mesh.at(t).map(|p| p - origin);
        let share = a.dot(b.cross(c));
        volume[root as usize] += if odd { -share } else { share };
    }
    if let Some(root) = sides.roots().find(|&r| volume[r as usize] == 0.0) {
        let t = root as usize;
        return Err(SolidError::NoVolume { at: soup.mesh.at(t)[0], face: soup.face_of[t] });
    }
    let mut turned = 0;
    for t in 0..count {
        let (root, odd) = sides.root(t as u32);
        if odd != (volume[root as usize] < 0.0) {
            soup.mesh.triangles[t].swap(1, 2);
            turned += 1;
        }
    }
    Ok(turned)
}

/// Gives each fan of triangles a vertex of its own. Returns how many vertices had several.
fn split_points(shell: &mut Shell) -> usize {
    let mut seen = vec![false; shell.len()];
    let mut used = vec![false; shell.mesh.points.len()];
    let mut split: Vec<u32> = Vec::new();
    for k in 0..shell.len() as u32 {
        if seen[k as usize] {
            continue;
        }
        let fan: Vec<u32> = shell.fan(k).collect();
        fan.iter().for_each(|&l| seen[l as usize] = true);
        let vertex = shell.from(k);
        if std::mem::replace(&mut used[vertex as usize], true) {
            let copy = shell.mesh.points.len() as u32;
            let point: Point = shell.mesh.points[vertex as usize];
            shell.mesh.points.push(point);
            fan.iter().for_each(|&l| shell.mesh.triangles.as_flattened_mut()[l as usize] = copy);
            split.push(vertex);
        }
    }
    split.dedup();
    split.len()
}
