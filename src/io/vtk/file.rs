//! Numbers of a legacy VTK file, in words or in binary.

use crate::io::refusal::{code, excerpt, refuse};
use crate::io::scalars::{ByteOrder, Column, Scalar};
use crate::io::tokens::Tokens;
use crate::io::{Format, ReadError};

/// A file after its header.
pub(super) struct LegacyFile<'a> {
    pub tokens: Tokens<'a>,
    binary: bool,
}

impl<'a> LegacyFile<'a> {
    /// Reads the three lines of the header.
    pub fn open(bytes: &'a [u8]) -> Result<Self, ReadError> {
        let mut tokens = Tokens::new(Format::Vtk, bytes, 1, None);
        let first = tokens.rest_of_line();
        if !first.starts_with(b"# vtk DataFile Version") {
            let message =
                format!("the file begins with {}, not with '# vtk DataFile Version'", excerpt(first));
            return Err(refuse(Format::Vtk, 1, code::NOT_THIS_FORMAT, message));
        }
        tokens.rest_of_line();
        let kind = tokens.expect("ASCII or BINARY")?;
        let binary = kind.eq_ignore_ascii_case(b"BINARY");
        if !binary && !kind.eq_ignore_ascii_case(b"ASCII") {
            let message = format!("{} stands where ASCII or BINARY should", excerpt(kind));
            return Err(tokens.refuse(code::SYNTAX, message));
        }
        Ok(Self { tokens, binary })
    }

    /// True if numbers are in binary.
    pub fn is_binary(&self) -> bool {
        self.binary
    }

    /// A count or size. It may be any number: the data that follow are measured before they are read.
    pub fn number(&mut self, what: &str) -> Result<usize, ReadError> {
        let number = self.tokens.integer(what)?;
        usize::try_from(number).map_err(|_| {
            let wrong = if number < 0 { "it cannot be negative" } else { "it is too large" };
            self.tokens.refuse(code::BAD_NUMBER, format!("{what} is {number}; {wrong}"))
        })
    }

    /// The name of a type of numbers.
    pub fn scalar(&mut self) -> Result<Scalar, ReadError> {
        let name = self.tokens.expect("a type of numbers")?;
        Scalar::from_legacy_name(name).ok_or_else(|| {
            let message = format!("{} is no type of numbers, such as float or int", excerpt(name));
            self.tokens.refuse(code::SYNTAX, message)
        })
    }

    /// Goes to where data begin: in a binary file after the end of the line.
    pub fn start_data(&mut self) {
        if self.binary {
            self.tokens.rest_of_line();
        }
    }

    /// True if the next line begins with `word`.
    pub fn line_begins_with(&mut self, word: &[u8]) -> bool {
        if self.binary {
            return self.tokens.rest().get(..word.len()).is_some_and(|next| next.eq_ignore_ascii_case(word));
        }
        self.tokens.peek().is_some_and(|next| next.eq_ignore_ascii_case(word))
    }

    /// The next `count` numbers.
    pub fn column(&mut self, count: usize, scalar: Scalar, what: &str) -> Result<Column, ReadError> {
        if self.binary {
            let data = self.tokens.take(count.saturating_mul(scalar.size()), what)?;
            return Ok(scalar.decode(data, ByteOrder::Big));
        }
        self.check_words(count, what)?;
        Ok(match scalar {
            Scalar::Float(_) => {
                Column::Floats((0..count).map(|_| self.tokens.float(what)).collect::<Result<_, _>>()?)
            }
            _ => Column::Integers((0..count).map(|_| self.tokens.integer(what)).collect::<Result<_, _>>()?),
        })
    }

    /// The next `count` whole numbers.
    pub fn integers(&mut self, count: usize, scalar: Scalar, what: &str) -> Result<Vec<i64>, ReadError> {
        self.column(count, scalar, what)?
            .into_integers()
            .ok_or_else(|| self.tokens.refuse(code::BAD_NUMBER, format!("{what} are not all whole numbers")))
    }

    /// Steps over data of a type without numbers: bits and strings.
    pub fn skip_column(&mut self, kind: &[u8], count: usize) -> Result<(), ReadError> {
        match kind.to_ascii_lowercase().as_slice() {
            b"bit" if self.binary => drop(self.tokens.take(count.div_ceil(8), "bits")?),
            b"bit" => {
                self.check_words(count, "bits")?;
                for _ in 0..count {
                    self.tokens.expect("a bit")?;
                }
            }
            b"string" => {
                self.check_words(count, "strings")?;
                if !self.binary {
                    self.tokens.rest_of_line();
                }
                for _ in 0..count {
                    self.skip_string()?;
                }
            }
            _ => {
                let message = format!("data of type {} are not read", excerpt(kind));
                return Err(self.tokens.refuse(code::UNSUPPORTED_ENCODING, message));
            }
        }
        Ok(())
    }

    /// Steps over a string: a line of its own, or in a binary file its length in 1, 2, 4 or 8 bytes, of
    /// which the two highest bits say how many, and its bytes.
    fn skip_string(&mut self) -> Result<(), ReadError> {
        if !self.binary {
            self.tokens.rest_of_line();
            return Ok(());
        }
        let first = self.tokens.take(1, "the length of a string")?[0];
        let more = [7, 3, 1, 0][usize::from(first >> 6)];
        let rest = self.tokens.take(more, "the length of a string")?;
        let length = rest.iter().fold(u64::from(first & 63), |length, &byte| length << 8 | u64::from(byte));
        let length = usize::try_from(length).unwrap_or(usize::MAX);
        self.tokens.take(length, "a string").map(drop)
    }

    /// Steps over a block of metadata, which ends with a blank line.
    pub fn skip_metadata(&mut self) {
        self.tokens.rest_of_line();
        while self.tokens.remaining() > 0 && !self.tokens.rest_of_line().is_empty() {}
    }

    /// Refuses counts of words that the rest of the file cannot hold.
    pub fn check_words(&self, count: usize, what: &str) -> Result<(), ReadError> {
        // A word and the space before it take two bytes; the last of a file may lack the space.
        let most = self.tokens.remaining() / 2 + 1;
        if count <= most {
            return Ok(());
        }
        let message = format!(
            "{what} are {count} words, but the rest of the file has room for {most} at most — it is cut short or damaged"
        );
        Err(self.tokens.refuse(code::TRUNCATED, message))
    }
}
