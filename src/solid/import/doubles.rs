//! What is there twice.
//!
//! Of triangles on each other that look the same way one stays. Two that look opposite ways are a wall with solid on both sides,
//! or part of a sheet without thickness, and both go; or a face that was given again the other way round, and one stays: so that
//! as many edges as possible have an even number of triangles.

use std::ops::Range;

use super::Soup;
use crate::parallel;

/// How many triangles went.
#[derive(Debug, PartialEq)]
pub(super) struct Doubles {
    /// Those of which another stayed.
    pub duplicates: usize,
    /// Those of walls and sheets.
    pub walls: usize,
}

/// A triangle: its vertices in ascending order, the last one twice, and one more if the order turned it around; and its number.
type Key = ([u64; 3], u32);

fn is_odd(key: &Key) -> bool {
    key.0[2] % 2 == 1
}

fn vertices(&([a, b, c], _): &Key) -> [u32; 3] {
    [a, b, c / 2].map(|v| v as u32)
}

/// Drops triangles on other triangles.
pub(super) fn drop_doubles(soup: &mut Soup) -> Doubles {
    let mut keys: Vec<Key> = (0..).zip(&soup.mesh.triangles).map(key).collect();
    parallel::sort(&mut keys);
    let is_wall = |same: &[Key]| same.iter().any(|k| is_odd(k) != is_odd(&same[0]));
    let same = keys.chunk_by(|a, b| vertices(a) == vertices(b));
    let all: Vec<&[Key]> = same.filter(|same| same.len() > 1).collect();
    let mut keeps = vec![true; keys.len()];
    all.iter().flat_map(|same| *same).for_each(|k| keeps[k.1 as usize] = false);
    let (walls, others): (Vec<&[Key]>, Vec<&[Key]>) = all.into_iter().partition(|same| is_wall(same));
    others.iter().for_each(|same| keeps[same[0].1 as usize] = true);
    let stays = Walls::new(&walls, soup, &keeps).decided();
    for (same, _) in walls.iter().zip(&stays).filter(|(_, stays)| **stays) {
        let first = same.iter().map(|k| k.1).min().expect("there are two or more");
        keeps[first as usize] = true;
    }
    let walls = walls.iter().zip(&stays).filter(|(_, stays)| !**stays).map(|(same, _)| same.len()).sum();
    let gone = soup.retain(|t| keeps[t]);
    Doubles { duplicates: gone - walls, walls }
}

fn key((t, &[a, b, c]): (u32, &[u32; 3])) -> Key {
    let mut sorted = [a, b, c];
    sorted.sort_unstable();
    let is_odd = [[a, b, c], [b, c, a], [c, a, b]].iter().all(|turn| *turn != sorted);
    let [a, b, c] = sorted.map(u64::from);
    ([a, b, 2 * c + u64::from(is_odd)], t)
}

/// The edges of a triangle, by their vertices.
fn edges([a, b, c]: [u32; 3]) -> [u64; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| u64::from(a.min(b)) << 32 | u64::from(a.max(b)))
}

/// Triangles that may stay or go, and their edges.
struct Walls {
    /// Of each the places of its edges.
    edges: Vec<[usize; 3]>,
    /// The triangles at each edge, in a row.
    at: Vec<Range<usize>>,
    walls: Vec<u32>,
    /// Is the number of triangles that stay at an edge odd?
    is_odd: Vec<bool>,
    has_others: bool,
}

impl Walls {
    fn new(walls: &[&[Key]], soup: &Soup, keeps: &[bool]) -> Self {
        let of_wall = |(k, same): (u32, &&[Key])| edges(vertices(&same[0])).map(|edge| ([edge, 0, 0], k));
        let mut uses: Vec<([u64; 3], u32)> = (0..).zip(walls).flat_map(of_wall).collect();
        parallel::sort(&mut uses);
        let (mut all, mut at) = (Vec::new(), Vec::new());
        for same in uses.chunk_by(|a, b| a.0 == b.0) {
            let start = at.last().map_or(0, |range: &Range<usize>| range.end);
            all.push(same[0].0[0]);
            at.push(start..start + same.len());
        }
        let place = |edge: u64| all.binary_search(&edge).ok();
        let mut is_odd = vec![false; all.len()];
        let others = soup.mesh.triangles.iter().zip(keeps).filter(|(_, keeps)| **keeps);
        if !all.is_empty() {
            for place in others.clone().flat_map(|(t, _)| edges(*t)).filter_map(place) {
                is_odd[place] ^= true;
            }
        }
        let of_wall =
            |same: &&[Key]| edges(vertices(&same[0])).map(|edge| place(edge).expect("an edge of a wall"));
        Self {
            edges: walls.iter().map(of_wall).collect(),
            at,
            walls: uses.into_iter().map(|(_, wall)| wall).collect(),
            is_odd,
            has_others: others.count() > 0,
        }
    }

    /// Which of them stay: where one alone is left to decide at an edge, it makes the number there even. Closed surfaces of such
    /// triangles alone have no such edge: they go, unless nothing else is there.
    fn decided(mut self) -> Vec<bool> {
        let mut stays: Vec<Option<bool>> = vec![None; self.edges.len()];
        let mut open: Vec<usize> = self.at.iter().map(Range::len).collect();
        let mut next: Vec<usize> = (0..open.len()).rev().filter(|&edge| open[edge] == 1).collect();
        while let Some(edge) = next.pop() {
            let undecided = |wall: &&u32| stays[**wall as usize].is_none();
            let Some(&wall) = self.walls[self.at[edge].clone()].iter().find(undecided) else { continue };
            let stay = self.is_odd[edge];
            stays[wall as usize] = Some(stay);
            for edge in self.edges[wall as usize] {
                self.is_odd[edge] ^= stay;
                open[edge] -= 1;
                if open[edge] == 1 {
                    next.push(edge);
                }
            }
        }
        stays.into_iter().map(|stays| stays.unwrap_or(!self.has_others)).collect()
    }
}
