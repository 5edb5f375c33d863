//! Which components of a shell lie within others: voids, and bodies within voids.

use crate::geometry::{Aabb, area_vector};
use crate::solid::search::{Sides, TriangleSearch};
use crate::solid::shell::{Shell, Triangles};
use crate::solid::surfaces::components;
use crate::{Cancelled, Monitor};

/// The bodies of a shell.
pub(super) struct Nesting {
    /// The body of each triangle.
    pub body_of: Vec<u32>,
    /// How many components are voids.
    pub voids: usize,
    /// For each triangle whether it is part of a void.
    pub in_void: Vec<bool>,
}

/// A connected part of a shell.
struct Component {
    triangles: Vec<u32>,
    bounds: Aabb,
    /// The components around it.
    around: Vec<usize>,
}

/// Tells voids from bodies: a component within an odd number of others is a void of the innermost of them. All components
/// look outward, as if each were a body.
pub(super) fn nesting(shell: &Shell, monitor: &dyn Monitor) -> Result<Nesting, Cancelled> {
    let component_of = components(shell);
    let mut all = gather(shell, &component_of);
    let normals: Vec<_> = if all.len() > 1 {
        (0..component_of.len()).map(|t| area_vector(&shell.mesh.at(t)).normalize_or_zero()).collect()
    } else {
        Vec::new()
    };
    let sides = (all.len() > 1).then(|| Sides::new(shell, &normals, monitor)).transpose()?;
    for (j, sides) in (0..all.len()).flat_map(|j| sides.as_ref().map(|s| (j, s))) {
        monitor.proceed()?;
        let within = |i: &usize| *i != j && all[*i].bounds.is_within(&all[j].bounds);
        let candidates: Vec<usize> = (0..all.len()).filter(within).collect();
        if candidates.is_empty() {
            continue;
        }
        let search = TriangleSearch::new(shell, [&*all[j].triangles], monitor)?;
        for i in candidates {
            let p = shell.mesh.at(all[i].triangles[0] as usize)[0];
            let nearest = search.nearest(p);
            if sides.signed(shell, &normals, nearest.facet, nearest.point, p) < 0.0 {
                all[i].around.push(j);
            }
        }
    }
    let is_body = |component: &Component| component.around.len().is_multiple_of(2);
    let mut body = vec![0; all.len()];
    for (number, (i, _)) in all.iter().enumerate().filter(|(_, c)| is_body(c)).enumerate() {
        body[i] = number as u32;
    }
    for (i, component) in all.iter().enumerate().filter(|(_, c)| !is_body(c)) {
        let innermost = component.around.iter().max_by_key(|&&j| all[j].around.len());
        body[i] = innermost.map_or(0, |&j| body[j]);
    }
    Ok(Nesting {
        voids: all.iter().filter(|c| !is_body(c)).count(),
        in_void: component_of.iter().map(|&c| !is_body(&all[c as usize])).collect(),
        body_of: component_of.iter().map(|&c| body[c as usize]).collect(),
    })
}

fn gather(shell: &Shell, component_of: &[u32]) -> Vec<Component> {
    let count = component_of.iter().max().map_or(0, |&c| c as usize + 1);
    let mut all: Vec<Component> = (0..count)
        .map(|_| Component { triangles: Vec::new(), bounds: Aabb::EMPTY, around: Vec::new() })
        .collect();
    for (t, &c) in component_of.iter().enumerate() {
        let component = &mut all[c as usize];
        component.triangles.push(t as u32);
        component.bounds = shell.mesh.at(t).into_iter().fold(component.bounds, Aabb::with);
    }
    all
}

/// Turns the triangles of voids, so that they look away from the solid.
pub(super) fn turn_voids(mesh: &mut Triangles, nesting: &Nesting) {
    for (triangle, _) in mesh.triangles.iter_mut().zip(&nesting.in_void).filter(|(_, in_void)| **in_void) {
        triangle.swap(1, 2);
    }
}
