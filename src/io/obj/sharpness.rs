//! OpenSubdiv's `t` statements: `t NAME INTEGERS/REALS/STRINGS integers... reals... strings...`.
//!
//! `t crease 2/1/0 v0 v1 s`, `t corner 1/1/0 v s` and `t interpolateboundary 1/0/0 rule`. A crease may
//! name several edges as pairs of vertices and a corner several vertices, with one sharpness for all of
//! them or one for each. Vertices count from 0. Other tags are skipped.

use super::cursor::{Cursor, Result, error, quoted};
use crate::io::ReadError;
use crate::mesh::{Features, NodeId};

/// Reads the rest of a `t` statement into `features` and returns the largest vertex it names.
pub(super) fn read_tag(cursor: &mut Cursor, features: &mut Features) -> Result<Option<u32>> {
    let line = cursor.line();
    let Some(name) = cursor.word() else {
        return Err(bad_tag(line, "'t' has no name: write it like 't crease 2/1/0 0 1 2.5'"));
    };
    if !matches!(name, b"crease" | b"corner" | b"interpolateboundary") {
        cursor.skip_statement();
        return Ok(None);
    }
    let (integers, reals) = counts(cursor, line)?;
    let integers = list(cursor, integers, line, |c| c.integer())?;
    let reals = list(cursor, reals, line, |c| c.number())?;
    if !cursor.at_end() {
        let word = quoted(cursor.word().unwrap_or_default());
        return Err(bad_tag(
            line,
            format!("{word} is more than the tag's counts announce: correct the counts"),
        ));
    }
    match name {
        b"interpolateboundary" => set_boundary_rule(&integers, line, features).map(|()| None),
        b"crease" => add_creases(&vertices(&integers, line)?, &reals, line, features),
        _ => add_corners(&vertices(&integers, line)?, &reals, line, features),
    }
}

fn bad_tag(line: u64, message: impl Into<String>) -> ReadError {
    error(line, "obj-bad-tag", message)
}

/// Reads `INTEGERS/REALS/STRINGS` and returns the first two; the tags known here have no strings.
fn counts(cursor: &mut Cursor, line: u64) -> Result<(usize, usize)> {
    let word = cursor.word().unwrap_or_default();
    let parse = |part: &[u8]| std::str::from_utf8(part).ok()?.parse::<usize>().ok();
    let parts: Option<Vec<usize>> = word.splitn(4, |&b| b == b'/').map(parse).collect();
    match parts.as_deref() {
        Some(&[integers, reals] | &[integers, reals, 0]) => Ok((integers, reals)),
        _ => Err(bad_tag(line, format!("{} are no counts of a tag: write them like 2/1/0", quoted(word)))),
    }
}

/// Reads `count` values. A count that the rest of the file cannot hold is refused before memory is.
fn list<'a, T>(
    cursor: &mut Cursor<'a>,
    count: usize,
    line: u64,
    mut next: impl FnMut(&mut Cursor<'a>) -> Result<Option<T>>,
) -> Result<Vec<T>> {
    let mut values = Vec::with_capacity(count.min(cursor.remaining() / 2));
    while values.len() < count {
        let Some(value) = next(cursor)? else {
            let message = format!("the tag announces {count} values here but has {}: add them", values.len());
            return Err(bad_tag(line, message));
        };
        values.push(value);
    }
    Ok(values)
}

fn vertices(integers: &[i64], line: u64) -> Result<Vec<NodeId>> {
    let vertex = |&number: &i64| match u32::try_from(number) {
        Ok(id) if id < u32::MAX => Ok(NodeId(id)),
        _ => Err(error(
            line,
            "obj-index-out-of-range",
            format!("the tag names vertex {number}: vertices of 't' count from 0"),
        )),
    };
    integers.iter().map(vertex).collect()
}

fn set_boundary_rule(integers: &[i64], line: u64, features: &mut Features) -> Result<()> {
    match integers.first().map(|&rule| i32::try_from(rule)) {
        Some(Ok(rule)) => {
            features.interpolate_boundary = Some(rule);
            Ok(())
        }
        _ => Err(bad_tag(line, "'t interpolateboundary' needs one small whole number: write 0, 1 or 2")),
    }
}

fn add_creases(
    vertices: &[NodeId],
    reals: &[f64],
    line: u64,
    features: &mut Features,
) -> Result<Option<u32>> {
    if vertices.is_empty() || vertices.len() % 2 == 1 {
        return Err(bad_tag(
            line,
            "'t crease' needs pairs of vertices: write it like 't crease 2/1/0 0 1 2.5'",
        ));
    }
    let edges = vertices.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
    features.creases.extend(edges.zip(sharpness(reals, vertices.len() / 2, line)?));
    Ok(vertices.iter().map(|v| v.0).max())
}

fn add_corners(
    vertices: &[NodeId],
    reals: &[f64],
    line: u64,
    features: &mut Features,
) -> Result<Option<u32>> {
    if vertices.is_empty() {
        return Err(bad_tag(line, "'t corner' needs a vertex: write it like 't corner 1/1/0 0 2.5'"));
    }
    features.corners.extend(vertices.iter().copied().zip(sharpness(reals, vertices.len(), line)?));
    Ok(vertices.iter().map(|v| v.0).max())
}

/// The sharpness of each of `count` features from one number for all of them or one for each.
fn sharpness(reals: &[f64], count: usize, line: u64) -> Result<Vec<f64>> {
    match reals.len() {
        1 => Ok(vec![reals[0]; count]),
        given if given == count => Ok(reals.to_vec()),
        given => Err(bad_tag(
            line,
            format!("the tag has {given} sharpness values for {count} features: give one, or one for each"),
        )),
    }
}
