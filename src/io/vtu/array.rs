//! The numbers of a VTU array, whatever its encoding.

use std::borrow::Cow;

use super::base64_stream::{Base64Stream, StreamError};
use super::xml::{DataArray, Place, XmlFile, line_at, refuse_at};
use crate::io::refusal::{code, excerpt};
use crate::io::scalars::{Column, Scalar};
use crate::io::tokens::{Tokens, parse_float, parse_integer};
use crate::io::{Format, ReadError};

/// Decodes the arrays of a file.
pub(super) struct Decoder<'a> {
    pub bytes: &'a [u8],
    pub file: &'a XmlFile<'a>,
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
    /// The numbers of `array`.
    pub fn decode(&self, array: &DataArray<'a>) -> Result<Column, ReadError> {
        let scalar = array.scalar.ok_or_else(|| {
            self.refuse(array, code::UNSUPPORTED_ENCODING, "has a type that is none of VTK's numbers")
        })?;
        let data = match array.place {
            Place::Ascii => return self.decode_words(array, scalar),
            Place::Binary => {
                let text = without_white_space(array.text);
                self.binary(array, Source::Base64(Base64Stream::new(&text)))?
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
                self.binary(array, source)?
            }
        };
        if !data.len().is_multiple_of(scalar.size()) {
            return Err(self.refuse(array, code::INCONSISTENT, "has data that end within a number"));
        }
        Ok(scalar.decode(&data, self.file.order))
    }

    /// The whole numbers of `array`.
    pub fn integers(&self, array: &DataArray<'a>) -> Result<Vec<i64>, ReadError> {
        self.decode(array)?
            .into_integers()
            .ok_or_else(|| self.refuse(array, code::BAD_NUMBER, "has numbers that are not whole"))
    }

    /// An error about `array`, whose name and line are put before the message.
    pub fn refuse(&self, array: &DataArray<'_>, code: &'static str, message: &str) -> ReadError {
        let name = excerpt(array.name.as_bytes());
        refuse_at(self.bytes, array.at, code, format!("the array {name} {message}"))
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

    /// The bytes of binary data: after their size, or in compressed blocks.
    fn binary(&self, array: &DataArray<'_>, mut source: Source<'_>) -> Result<Vec<u8>, ReadError> {
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
            return Ok(source.take(size).map_err(told)?.into_owned());
        }
        if size == 0 {
            return Ok(Vec::new());
        }
        let [block, last] = self.sizes(&mut source, 2).map_err(told)?[..] else { unreachable!("two sizes") };
        let compressed = self.sizes(&mut source, size).map_err(told)?;
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
    words.refuse(code::BAD_NUMBER, format!("{} stands where a number should", excerpt(word)))
}

fn without_white_space(text: &[u8]) -> Cow<'_, [u8]> {
    let text = text.trim_ascii();
    if text.iter().any(u8::is_ascii_whitespace) {
        Cow::Owned(text.iter().copied().filter(|b| !b.is_ascii_whitespace()).collect())
    } else {
        Cow::Borrowed(text)
    }
}
