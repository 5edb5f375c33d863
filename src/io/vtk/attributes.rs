//! Attributes of points and cells in a legacy VTK file.

use super::file::LegacyFile;
use crate::io::ReadError;
use crate::io::refusal::{code, excerpt};
use crate::io::scalars::{Column, Scalar};

/// An array of an attribute.
pub(super) struct Array {
    pub name: String,
    /// The line of its name.
    pub line: Option<u64>,
    /// The numbers, if it has one a point or cell. Others are stepped over.
    pub numbers: Option<Column>,
}

type Arrays = Vec<Array>;

/// Reads the attribute after its keyword, for `count` points or cells: its arrays, without tables of colours. `None` if the
/// keyword is none of an attribute.
pub(super) fn read_attribute(
    file: &mut LegacyFile<'_>,
    keyword: &[u8],
    count: usize,
) -> Result<Option<Arrays>, ReadError> {
    let arrays = match keyword {
        b"SCALARS" => read_scalars(file, count)?,
        b"FIELD" => read_field(file)?,
        b"GLOBAL_IDS" | b"PEDIGREE_IDS" | b"EDGE_FLAGS" => read_array(file, count, 1)?,
        b"VECTORS" | b"NORMALS" => read_array(file, count, 3)?,
        b"TENSORS" => read_array(file, count, 9)?,
        b"TENSORS6" => read_array(file, count, 6)?,
        b"TEXTURE_COORDINATES" => {
            let array = read_name(file)?;
            let dimension = file.number("the dimension of the texture")?;
            read_typed(file, array, count, dimension)?
        }
        b"COLOR_SCALARS" => {
            let array = read_name(file)?;
            let components = file.number("the number of colours")?;
            read_colours(file, count.saturating_mul(components))?;
            vec![array]
        }
        b"LOOKUP_TABLE" => {
            read_name(file)?;
            let size = file.number("the size of the table")?;
            read_colours(file, size.saturating_mul(4))?;
            Vec::new()
        }
        _ => return Ok(None),
    };
    Ok(Some(arrays))
}

fn read_scalars(file: &mut LegacyFile<'_>, count: usize) -> Result<Arrays, ReadError> {
    let array = read_name(file)?;
    let kind = file.tokens.expect("a type of numbers")?;
    let components = match file.tokens.rest_of_line() {
        [] => 1,
        word => std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()).ok_or_else(|| {
            let message = format!("{} stands where a number of components should", excerpt(word));
            file.tokens.refuse(code::BAD_NUMBER, message)
        })?,
    };
    if file.line_begins_with(b"LOOKUP_TABLE") {
        file.tokens.expect("LOOKUP_TABLE")?;
        file.tokens.rest_of_line();
    }
    read_data(file, array, kind, count, components)
}

fn read_field(file: &mut LegacyFile<'_>) -> Result<Arrays, ReadError> {
    read_name(file)?;
    let mut arrays = Vec::new();
    for _ in 0..file.number("the number of arrays")? {
        let mut array = read_name(file)?;
        while array.name == "METADATA" {
            file.skip_metadata();
            array = read_name(file)?;
        }
        let components = file.number("the number of components")?;
        let tuples = file.number("the number of tuples")?;
        arrays.extend(read_typed(file, array, tuples, components)?);
    }
    Ok(arrays)
}

fn read_array(file: &mut LegacyFile<'_>, count: usize, components: usize) -> Result<Arrays, ReadError> {
    let array = read_name(file)?;
    read_typed(file, array, count, components)
}

/// The type and the data of an array.
fn read_typed(
    file: &mut LegacyFile<'_>,
    array: Array,
    count: usize,
    components: usize,
) -> Result<Arrays, ReadError> {
    let kind = file.tokens.expect("a type of numbers")?;
    file.start_data();
    read_data(file, array, kind, count, components)
}

fn read_data(
    file: &mut LegacyFile<'_>,
    array: Array,
    kind: &[u8],
    count: usize,
    components: usize,
) -> Result<Arrays, ReadError> {
    let size = count.saturating_mul(components);
    let Some(scalar) = Scalar::from_legacy_name(kind) else {
        file.skip_column(kind, size)?;
        return Ok(vec![array]);
    };
    let column = file.column(size, scalar, "an attribute")?;
    Ok(vec![Array { numbers: (components == 1).then_some(column), ..array }])
}

/// Colours: bytes in a binary file, numbers from 0 to 1 in words.
fn read_colours(file: &mut LegacyFile<'_>, size: usize) -> Result<(), ReadError> {
    file.start_data();
    let scalar = if file.is_binary() { Scalar::Unsigned(1) } else { Scalar::Float(4) };
    file.column(size, scalar, "colours")?;
    Ok(())
}

/// An array by its name alone, in which VTK writes what would break a word as `%` and two hexadecimal digits.
fn read_name(file: &mut LegacyFile<'_>) -> Result<Array, ReadError> {
    let word = file.tokens.expect("a name")?;
    let line = file.tokens.line();
    let mut name = Vec::with_capacity(word.len());
    let mut at = 0;
    while at < word.len() {
        let digits = word.get(at + 1..at + 3).and_then(|digits| std::str::from_utf8(digits).ok());
        let escaped = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        match escaped.filter(|_| word[at] == b'%') {
            Some(byte) => {
                name.push(byte);
                at += 3;
            }
            None => {
                name.push(word[at]);
                at += 1;
            }
        }
    }
    Ok(Array { name: String::from_utf8_lossy(&name).into_owned(), line, numbers: None })
}
