//! Points at which several fans of triangles meet.

use crate::solid::shell::Shell;

/// Gives each fan of triangles a vertex of its own. Returns for each new vertex, in order, the one it stands beside.
pub(super) fn split(shell: &mut Shell) -> Vec<u32> {
    let mut seen = vec![false; shell.len()];
    let mut used = vec![false; shell.mesh.points.len()];
    let mut copies: Vec<u32> = Vec::new();
    for k in 0..shell.len() as u32 {
        if seen[k as usize] {
            continue;
        }
        let fan: Vec<u32> = shell.fan(k).collect();
        fan.iter().for_each(|&l| seen[l as usize] = true);
        let vertex = shell.from(k);
        if std::mem::replace(&mut used[vertex as usize], true) {
            let copy = shell.mesh.points.len() as u32;
            shell.mesh.points.push(shell.mesh.points[vertex as usize]);
            fan.iter().for_each(|&l| shell.mesh.triangles.as_flattened_mut()[l as usize] = copy);
            copies.push(vertex);
        }
    }
    copies
}

/// How many vertices were split.
pub(super) fn distinct(mut copies: Vec<u32>) -> usize {
    copies.sort_unstable();
    copies.dedup();
    copies.len()
}
