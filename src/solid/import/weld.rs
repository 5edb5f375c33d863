//! Makes one what is in one place.

use super::Soup;
use crate::geometry::{Aabb, Point};
use crate::mesh::first_of_same;
use crate::mesh::topology::Sets;
use crate::parallel::greatest_first;
use crate::solid::options::SolidReport;
use crate::solid::shell::NONE;
use crate::{Cancelled, Monitor};

/// A unit direction that no model is aligned with.
const ASKEW: Point = Point::new(0.534_522_483_824_849, 0.267_261_241_912_424, 0.801_783_725_737_273);

/// Welds points, exactly and then within `tolerance`, and drops the triangles that have no area left by this or lie on
/// others.
pub(super) fn weld(
    soup: &mut Soup,
    tolerance: f64,
    report: &mut SolidReport,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    report.welded_points = weld_exactly(soup);
    monitor.proceed()?;
    report.close_points = weld_close(soup, tolerance);
    monitor.proceed()?;
    let triangles = &soup.mesh.triangles;
    let keeps: Vec<bool> = triangles.iter().map(|&[a, b, c]| a != b && b != c && c != a).collect();
    report.degenerate_triangles = soup.retain(|t| keeps[t]);
    (report.duplicate_triangles, report.wall_triangles) = drop_duplicates(soup);
    Ok(())
}

/// Makes points with the same coordinates one. Returns how many were one with another.
fn weld_exactly(soup: &mut Soup) -> usize {
    let first = first_of_same(&soup.mesh.points);
    let welded = first.iter().zip(0..).filter(|&(&first, v)| first != v).count();
    renumber(soup, &first);
    welded
}

/// Makes points that are less than `tolerance` apart one. Returns how many were one with another.
fn weld_close(soup: &mut Soup, tolerance: f64) -> usize {
    let points = &soup.mesh.points;
    let origin = Aabb::around(points).min;
    let along = |p: Point| (p - origin).dot(ASKEW);
    let order = greatest_first(points.iter().map(|&p| -along(p)));
    let order: Vec<(f64, u32)> = order.map(|v| (along(points[v]), v as u32)).collect();
    let mut sets = Sets::new(points.len());
    let mut welded = 0;
    for (i, &(along, v)) in order.iter().enumerate() {
        let close = order[i + 1..].iter().take_while(|(other, _)| other - along < tolerance);
        for &(_, w) in close.filter(|(_, w)| points[v as usize].distance(points[*w as usize]) < tolerance) {
            let apart = sets.root(v).0 != sets.root(w).0;
            sets.join(v, w, false);
            welded += usize::from(apart);
        }
    }
    if welded > 0 {
        let stands_for: Vec<u32> = (0..points.len() as u32).map(|v| sets.root(v).0).collect();
        renumber(soup, &stands_for);
    }
    welded
}

/// Gives each corner the vertex that stands for it, and drops the vertices that no triangle uses then.
fn renumber(soup: &mut Soup, stands_for: &[u32]) {
    let mut new = vec![NONE; soup.mesh.points.len()];
    let mut points = Vec::new();
    for v in soup.mesh.triangles.as_flattened_mut() {
        let old = stands_for[*v as usize] as usize;
        if new[old] == NONE {
            new[old] = points.len() as u32;
            points.push(soup.mesh.points[old]);
        }
        *v = new[old];
    }
    soup.mesh.points = points;
    for v in soup.vertex_of.iter_mut().filter(|v| **v != NONE) {
        *v = new[stands_for[*v as usize] as usize];
    }
}

/// Drops triangles on other triangles. Of those that look the same way one stays; two that look opposite ways are a wall
/// with solid on both sides, or a sheet without thickness, and both go. Returns how many went for either reason.
fn drop_duplicates(soup: &mut Soup) -> (usize, usize) {
    // The vertices in ascending order, and whether sorting them turned the triangle around.
    let key = |(t, &[a, b, c]): (usize, &[u32; 3])| {
        let mut sorted = [a, b, c];
        sorted.sort_unstable();
        let is_odd = [[a, b, c], [b, c, a], [c, a, b]].iter().all(|turn| *turn != sorted);
        (sorted, is_odd, t as u32)
    };
    let mut keys: Vec<_> = soup.mesh.triangles.iter().enumerate().map(key).collect();
    crate::parallel::sort(&mut keys);
    let (mut duplicates, mut walls) = (0, 0);
    let mut keeps = vec![true; keys.len()];
    for same in keys.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        let even = same.iter().filter(|k| !k.1).count();
        let is_wall = even > 0 && even < same.len();
        // The first of those that look the same way.
        same.iter().skip(usize::from(!is_wall)).for_each(|k| keeps[k.2 as usize] = false);
        if is_wall {
            walls += same.len();
        } else {
            duplicates += same.len() - 1;
        }
    }
    if duplicates + walls > 0 {
        soup.retain(|t| keeps[t]);
    }
    (duplicates, walls)
}
