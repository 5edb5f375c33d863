//! Turns triangles so that they agree, and look outward.

use super::Soup;
use crate::mesh::topology::{Sets, disagrees, edge_ids};
use crate::solid::error::SolidError;
use crate::solid::shell::{EdgeTable, triangle_of};

/// Makes the triangles of each component agree and enclose a positive volume. Returns which were turned.
///
/// # Errors
/// If a component is one-sided, or nowhere thicker than `tolerance`.
pub(super) fn orient(soup: &mut Soup, table: &EdgeTable, tolerance: f64) -> Result<Vec<bool>, SolidError> {
    let count = soup.face_of.len();
    let mut sides = Sets::new(count);
    for e in edge_ids(&table.edges) {
        let [k, l] = [table.uses.at(e)[0], table.uses.at(e)[1]];
        if !sides.join(k / 3, l / 3, disagrees(&soup.mesh, &table.uses, e)) {
            let t = triangle_of(k);
            return Err(SolidError::OneSided { at: soup.mesh.at(t)[0], face: soup.face_of[t] });
        }
    }
    // Volumes about a point of the component itself, so that they are exact however far off it is.
    let (mut volume, mut area) = (vec![0.0; count], vec![0.0; count]);
    for t in 0..count {
        let (root, odd) = sides.root(t as u32);
        let origin = soup.mesh.at(root as usize)[0];
        let [a, b, c] = soup.mesh.at(t).map(|p| p - origin);
        let share = a.dot(b.cross(c)) / 6.0;
        volume[root as usize] += if odd { -share } else { share };
        area[root as usize] += (b - a).cross(c - a).length() / 2.0;
    }
    // A plate has its area twice.
    let is_thin = |r: u32| 2.0 * volume[r as usize].abs() <= tolerance * area[r as usize];
    if let Some(root) = sides.roots().find(|&r| is_thin(r)) {
        let t = root as usize;
        return Err(SolidError::NoVolume { at: soup.mesh.at(t)[0], face: soup.face_of[t] });
    }
    let is_inward = |t: usize| {
        let (root, odd) = sides.root(t as u32);
        odd != (volume[root as usize] < 0.0)
    };
    let turned: Vec<bool> = (0..count).map(is_inward).collect();
    for (triangle, _) in soup.mesh.triangles.iter_mut().zip(&turned).filter(|(_, turned)| **turned) {
        triangle.swap(1, 2);
    }
    Ok(turned)
}
