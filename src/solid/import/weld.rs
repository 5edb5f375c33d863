//! Makes one what is in one place.

use super::Soup;
use super::doubles::{Doubles, drop_doubles};
use crate::geometry::{Aabb, Point};
use crate::mesh::topology::Sets;
use crate::parallel::greatest_first;
use crate::solid::options::SolidReport;
use crate::solid::shell::NONE;
use crate::{Cancelled, Monitor};

/// A unit direction that no model is aligned with.
const ASKEW: Point = Point::new(0.534_522_483_824_849, 0.267_261_241_912_424, 0.801_783_725_737_273);

/// Welds points, exactly as `first` says which are the same, and then within `tolerance`, and drops the triangles that have no
/// area left by this or lie on others.
pub(super) fn weld(
    soup: &mut Soup,
    first: &[u32],
    tolerance: f64,
    report: &mut SolidReport,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    report.welded_points = (0..).zip(first).filter(|&(v, &first)| first != v).count();
    renumber(soup, first);
    monitor.proceed()?;
    report.close_points = weld_close(soup, tolerance);
    monitor.proceed()?;
    let triangles = &soup.mesh.triangles;
    let keeps: Vec<bool> = triangles.iter().map(|&[a, b, c]| a != b && b != c && c != a).collect();
    report.degenerate_triangles = soup.retain(|t| keeps[t]);
    let Doubles { duplicates, walls } = drop_doubles(soup);
    (report.duplicate_triangles, report.wall_triangles) = (duplicates, walls);
    if report.degenerate_triangles + duplicates + walls > 0 {
        // Points of these alone go too.
        let all: Vec<u32> = (0..soup.mesh.points.len() as u32).collect();
        renumber(soup, &all);
    }
    Ok(())
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
    points.shrink_to_fit();
    soup.mesh.points = points;
    for v in soup.vertex_of.iter_mut().filter(|v| **v != NONE) {
        *v = new[stands_for[*v as usize] as usize];
    }
}
