//! The numbers of a VTU array, whatever its encoding.

use std::borrow::Cow;
use std::cell::Cell;

use super::base64_stream::{Base64Stream, StreamError};
use super::xml::{DataArray, Place, XmlFile, line_at, refuse_at};
use crate::io::refusal::{code, excerpt};
use crate::io::scalars::{Column, Scalar};
use crate::io::tokens::{Tokens, not_a_number, parse_float, parse_integer};
use crate::io::{Format, ReadError};

/// Bytes that the numbers of all arrays may take for each byte of the file. Deflate packs a thousand into one, and
/// many arrays may be made of the same bytes, so that a small file could ask for any amount of memory. Meshes are far
/// below: the cells' nodes alone are other numbers in each cell, which pack by ten at best.
const BYTES_PER_BYTE: usize = 64;
/// So many bytes are fine in any file.
const BYTES_ALWAYS: usize = 1 << 20;

/// Decodes the arrays of a file.
pub(super) struct Decoder<'a> {
    bytes: &'a [u8],
    file: &'a XmlFile<'a>,
    /// How many bytes the numbers yet to be decoded may take.
    left: Cell<usize>,
}

/// How many numbers an array has to hold: the value of an attribute, times the numbers for each.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    pub attribute: &'static str,
    pub count: u64,
    pub each: usize,
}

/// Binary data, plain or in base64.
enum Source<'a> {
    Raw(&'a [u8]),
    Base64(Base64Stream<'a>),
}

impl<'a> Source<'a> {
    fn take(&mut self, size: usize) -> Result<Cow<'a, [u8]>, StreamError> {
        match self {
            Self::Base64(stream) => stream.take(size).map(Cow::Owned),
            Self::Raw(data) => {
                let (taken, rest) = data.split_at_checked(size).ok_or(StreamError::Ended)?;
                *data = rest;
                Ok(Cow::Borrowed(taken))
            }
        }
    }
}

impl<'a> Decoder<'a> {
    /// A decoder of the arrays of `file`, which `bytes` hold.
    pub fn new(bytes: &'a [u8], file: &'a XmlFile<'a>) -> Self {
        let left = bytes.len().saturating_mul(BYTES_PER_BYTE).saturating_add(BYTES_ALWAYS);
        Self { bytes, file, left: Cell::new(left) }
    }

    /// The numbers of `array`: as many as are wanted, if that is known.
    pub fn decode(&self, array: &DataArray<'a>, wanted: Option<Wanted>) -> Result<Column, ReadError> {
        let scalar = array.scalar.ok_or_else(|| {
            self.refuse(array, code::UNSUPPORTED_ENCODING, "has a type that is none of VTK's numbers")
        })?;
        let data = match array.place {
            Place::Ascii => {
                let column = self.decode_words(array, scalar)?;
                self.check_count(array, column.len(), wanted)?;
                return Ok(column);
            }
            Place::Binary => {
                let text = without_white_space(array.text);
                self.binary(array, scalar, wanted, Source::Base64(Base64Stream::new(&text)))?
            }
            Place::Appended(offset) => {
                let Some((data, base64)) = self.file.appended else {
                    let message = "is appended, but the file has no appended data — it is cut short";
                    return Err(self.refuse(array, code::TRUNCATED, message));
                };
                let data = data.get(offset..).ok_or_else(|| {
                    self.refuse(array, code::TRUNCATED, "starts after the end of the appended data")
                })?;
                let source = if base64 { Source::Base64(Base64Stream::new(data)) } else { Source::Raw(data) };
                self.binary(array, scalar, wanted, source)?
            }
        };
        Ok(scalar.decode(&data, self.file.order))
    }

    /// The whole numbers of `array`.
    pub fn integers(&self, array: &DataArray<'a>, wanted: Option<Wanted>) -> Result<Vec<i64>, ReadError> {
        self.decode(array, wanted)?
            .into_integers()
            .ok_or_else(|| self.refuse(array, code::BAD_NUMBER, "has numbers that are not whole"))
    }

    /// An error about `array`, whose name and line are put before the message.
    pub fn refuse(&self, array: &DataArray<'_>, code: &'static str, message: &str) -> ReadError {
        let name = excerpt(array.name.as_bytes());
        refuse_at(self.bytes, array.at, code, format!("the array {name} {message}"))
    }

    /// The line of a number of the array, if it stands in words; else that of the array.
    pub fn line_of(&self, array: &DataArray<'_>, place: usize) -> u64 {
        match array.place {
            Place::Ascii => {
                let mut words =
                    Tokens::new(Format::Vtu, array.text, line_at(self.bytes, array.text_at), None);
                for _ in 0..=place {
                    words.next();
                }
                words.line().unwrap_or_default()
            }
            Place::Binary | Place::Appended(_) => line_at(self.bytes, array.at),
        }
    }

    fn decode_words(&self, array: &DataArray<'_>, scalar: Scalar) -> Result<Column, ReadError> {
        let mut words = Tokens::new(Format::Vtu, array.text, line_at(self.bytes, array.text_at), None);
        if let Scalar::Float(_) = scalar {
            let mut values = Vec::new();
            while let Some(word) = words.next() {
                values.push(parse_float(word).ok_or_else(|| bad_word(&words, word))?);
            }
            return Ok(Column::Floats(values));
        }
        let mut values = Vec::new();
        while let Some(word) = words.next() {
            values.push(parse_integer(word).ok_or_else(|| bad_word(&words, word))?);
        }
        Ok(Column::Integers(values))
    }

    /// Refuses an array of `count` numbers where others are wanted.
    fn check_count(
        &self,
        array: &DataArray<'_>,
        count: usize,
        wanted: Option<Wanted>,
    ) -> Result<(), ReadError> {
        let Some(Wanted { attribute, count: said, each }) = wanted else { return Ok(()) };
        if said.checked_mul(each as u64) == Some(count as u64) {
            return Ok(());
        }
        let message = format!("holds {count} numbers, but {attribute} is {said}, with {each} for each");
        Err(self.refuse(array, code::INCONSISTENT, &message))
    }

    /// Refuses `size` bytes of numbers, before there is memory for them, if they are not those wanted or more than the
    /// file should hold.
    fn check_size(
        &self,
        array: &DataArray<'_>,
        scalar: Scalar,
        size: usize,
        wanted: Option<Wanted>,
    ) -> Result<(), ReadError> {
        if !size.is_multiple_of(scalar.size()) {
            return Err(self.refuse(array, code::INCONSISTENT, "has data that end within a number"));
        }
        let count = size / scalar.size();
        self.check_count(array, count, wanted)?;
        let left = count.checked_mul(size_of::<f64>()).and_then(|bytes| self.left.get().checked_sub(bytes));
        self.left.set(left.ok_or_else(|| {
            let message = format!(
                "unpacks to {count} numbers, with which the arrays hold more than a file of this size should — it is \
                 damaged"
            );
            self.refuse(array, code::TOO_LARGE, &message)
        })?);
        Ok(())
    }

    /// The bytes of binary data: after their size, or in compressed blocks.
    fn binary(
        &self,
        array: &DataArray<'_>,
        scalar: Scalar,
        wanted: Option<Wanted>,
        mut source: Source<'_>,
    ) -> Result<Vec<u8>, ReadError> {
        let told = |error| match error {
            StreamError::Ended => self.refuse(
                array,
                code::TRUNCATED,
                "has less data than it says — the file is cut short or damaged",
            ),
            StreamError::NotBase64 => self.refuse(array, code::SYNTAX, "has data that are not base64"),
        };
        let size = self.sizes(&mut source, 1).map_err(told)?[0];
        if !self.file.compressed {
            // What is cut short is told as such, whatever it claims.
            let data = source.take(size).map_err(told)?;
            self.check_size(array, scalar, size, wanted)?;
            return Ok(data.into_owned());
        }
        if size == 0 {
            self.check_size(array, scalar, 0, wanted)?;
            return Ok(Vec::new());
        }
        let [block, last] = self.sizes(&mut source, 2).map_err(told)?[..] else { unreachable!("two sizes") };
        if block == 0 {
            return Err(self.refuse(
                array,
                code::INCONSISTENT,
                "has blocks of no bytes — the file is damaged",
            ));
        }
        let compressed = self.sizes(&mut source, size).map_err(told)?;
        let total = block.saturating_mul(size - usize::from(last != 0)).saturating_add(last);
        self.check_size(array, scalar, total, wanted)?;
        let mut data = Vec::new();
        for (index, &length) in compressed.iter().enumerate() {
            let expected = if index + 1 == compressed.len() && last != 0 { last } else { block };
            let packed = source.take(length).map_err(told)?;
            let unpacked = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(&packed, expected)
                .ok()
                .filter(|unpacked| unpacked.len() == expected)
                .ok_or_else(|| {
                    self.refuse(
                        array,
                        code::INCONSISTENT,
                        "has a block that zlib cannot unpack to its size — the file is damaged",
                    )
                })?;
            data.extend_from_slice(&unpacked);
        }
        Ok(data)
    }

    /// The next sizes of a header. A size that does not fit becomes one that no data can have.
    fn sizes(&self, source: &mut Source<'_>, count: usize) -> Result<Vec<usize>, StreamError> {
        let header = self.file.header;
        let bytes = source.take(count.checked_mul(header.size()).ok_or(StreamError::Ended)?)?;
        let Column::Integers(sizes) = header.decode(&bytes, self.file.order) else { return Ok(Vec::new()) };
        Ok(sizes.into_iter().map(|size| usize::try_from(size).unwrap_or(usize::MAX)).collect())
    }
}

fn bad_word(words: &Tokens<'_>, word: &[u8]) -> ReadError {
    words.refuse(code::BAD_NUMBER, not_a_number(word, "an entry of an array"))
}

fn without_white_space(text: &[u8]) -> Cow<'_, [u8]> {
    let text = text.trim_ascii();
    if text.iter().any(u8::is_ascii_whitespace) {
        Cow::Owned(text.iter().copied().filter(|b| !b.is_ascii_whitespace()).collect())
    } else {
        Cow::Borrowed(text)
    }
}
