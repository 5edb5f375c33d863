//! Numbers and sections of an MSH file, in words or in binary.

use crate::io::refusal::{code, excerpt, refuse};
use crate::io::scalars::{ByteOrder, Column, Scalar};
use crate::io::tokens::Tokens;
use crate::io::{Format, ReadError};

/// The versions that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Version {
    /// 2.0 to 2.2.
    Two,
    /// 4.1.
    Four,
}

/// How numbers stand in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Ascii,
    /// Binary, with the byte order and the number of bytes of a size.
    Binary(ByteOrder, usize),
}

/// A file after its header.
pub(super) struct MshFile<'a> {
    pub tokens: Tokens<'a>,
    pub version: Version,
    encoding: Encoding,
}

impl<'a> MshFile<'a> {
    /// Reads the header, `$MeshFormat`.
    pub fn open(bytes: &'a [u8]) -> Result<Self, ReadError> {
        let mut tokens = Tokens::new(Format::Msh, bytes, 1, None);
        while let Some(word) = tokens.next() {
            if word == b"$MeshFormat" {
                return Self::header(tokens);
            }
            if word == b"$Comments" {
                skip_section(&mut tokens, word);
                continue;
            }
            let message = if word == b"$NOD" {
                "this is version 1 of the format; save the mesh as version 4.1 or 2.2".to_owned()
            } else {
                format!("the file begins with {}, not with $MeshFormat", excerpt(word))
            };
            return Err(tokens.refuse(code::NOT_THIS_FORMAT, message));
        }
        Err(refuse(Format::Msh, 1, code::NOT_THIS_FORMAT, "the file is empty"))
    }

    fn header(mut tokens: Tokens<'a>) -> Result<Self, ReadError> {
        let number = tokens.expect("the version")?;
        let version = match number {
            b"2" | b"2.0" | b"2.1" | b"2.2" => Version::Two,
            b"4.1" => Version::Four,
            _ => {
                let message = format!(
                    "the file has version {} of the format; save the mesh as version 4.1 or 2.2",
                    excerpt(number)
                );
                return Err(tokens.refuse(code::UNSUPPORTED_VERSION, message));
            }
        };
        let kind = tokens.integer("the file type")?;
        let size = tokens.integer("the data size")?;
        let encoding = match (kind, size) {
            (0, _) => Encoding::Ascii,
            (1, 4 | 8) => {
                tokens.rest_of_line();
                let one = tokens.take(4, "the byte order")?;
                let order = match one {
                    [1, 0, 0, 0] => ByteOrder::Little,
                    [0, 0, 0, 1] => ByteOrder::Big,
                    _ => {
                        return Err(tokens.refuse(code::SYNTAX, "the byte order is not told by the number 1"));
                    }
                };
                Encoding::Binary(order, size as usize)
            }
            _ => {
                let message =
                    format!("file type {kind} with data size {size} is not read; save the mesh as ASCII");
                return Err(tokens.refuse(code::UNSUPPORTED_ENCODING, message));
            }
        };
        let mut file = Self { tokens, version, encoding };
        file.end_section(b"$MeshFormat")?;
        Ok(file)
    }

    /// True if numbers are in binary.
    pub fn is_binary(&self) -> bool {
        self.encoding != Encoding::Ascii
    }

    /// A whole number (`int`).
    pub fn int(&mut self, what: &str) -> Result<i64, ReadError> {
        self.whole(Scalar::Signed(4), what)
    }

    /// A number of a node or element, or a count (`size_t`).
    pub fn size(&mut self, what: &str) -> Result<i64, ReadError> {
        let bytes = match self.encoding {
            Encoding::Ascii => 8,
            Encoding::Binary(_, bytes) => bytes,
        };
        self.whole(Scalar::Unsigned(bytes), what)
    }

    /// A real number (`double`).
    pub fn double(&mut self, what: &str) -> Result<f64, ReadError> {
        match self.encoding {
            Encoding::Ascii => self.tokens.float(what),
            Encoding::Binary(order, _) => {
                let bytes = self.tokens.take(8, what)?.try_into().expect("eight bytes were taken");
                Ok(match order {
                    ByteOrder::Little => f64::from_le_bytes(bytes),
                    ByteOrder::Big => f64::from_be_bytes(bytes),
                })
            }
        }
    }

    fn whole(&mut self, scalar: Scalar, what: &str) -> Result<i64, ReadError> {
        let Encoding::Binary(order, _) = self.encoding else { return self.tokens.integer(what) };
        let bytes = self.tokens.take(scalar.size(), what)?;
        match scalar.decode(bytes, order) {
            Column::Integers(values) => Ok(values[0]),
            Column::Floats(_) => unreachable!("whole numbers were asked for"),
        }
    }

    /// A count of items that take at least `bytes_each` bytes each, in either encoding.
    pub fn checked(&self, count: i64, bytes_each: usize, what: &str) -> Result<usize, ReadError> {
        let most = self.tokens.remaining() / bytes_each + 1;
        usize::try_from(count).ok().filter(|&count| count <= most).ok_or_else(|| {
            let message = format!(
                "{what} is {count}, but the rest of the file has room for {most} at most — it is cut short or damaged"
            );
            self.tokens.refuse(code::TRUNCATED, message)
        })
    }

    /// Goes to where numbers begin: in a binary file after the end of the line.
    pub fn start_data(&mut self) {
        if self.is_binary() {
            self.tokens.rest_of_line();
        }
    }

    /// Reads the end of the section that began with `name`.
    pub fn end_section(&mut self, name: &[u8]) -> Result<(), ReadError> {
        let expected = format!("$End{}", String::from_utf8_lossy(&name[1..]));
        let found = self.tokens.expect(&expected)?;
        if found == expected.as_bytes() {
            return Ok(());
        }
        let message = format!("{} stands where {expected} should", excerpt(found));
        Err(self.tokens.refuse(code::SYNTAX, message))
    }

    /// Steps over the section that began with `name`, to the end of the file if it has no end.
    pub fn skip_section(&mut self, name: &[u8]) {
        skip_section(&mut self.tokens, name);
    }
}

fn skip_section(tokens: &mut Tokens<'_>, name: &[u8]) {
    let end = [b"$End", &name[1..]].concat();
    while tokens.remaining() > 0 && tokens.rest_of_line() != end {}
}
