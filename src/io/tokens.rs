//! Words of a text file, with the line of each; and steps over binary data between them.

use super::refusal::{code, excerpt, refuse};
use super::{Format, ReadError};

/// Reads words separated by white space. In the formats with comments, `comment` begins one that
/// lasts to the end of its line.
pub(super) struct Tokens<'a> {
    format: Format,
    bytes: &'a [u8],
    at: usize,
    line: u64,
    /// False once binary data were passed over, in which nobody counts lines.
    line_is_known: bool,
    comment: Option<u8>,
}

impl<'a> Tokens<'a> {
    /// Words of `bytes`, whose first line has number `line`.
    pub fn new(format: Format, bytes: &'a [u8], line: u64, comment: Option<u8>) -> Self {
        Self { format, bytes, at: 0, line, line_is_known: true, comment }
    }

    /// The line that the last word came from; `None` after binary data.
    pub fn line(&self) -> Option<u64> {
        self.line_is_known.then_some(self.line)
    }

    /// Number of bytes not yet read.
    pub fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The bytes not yet read.
    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// An error at the line of the last word.
    pub fn refuse(&self, code: &'static str, message: impl Into<String>) -> ReadError {
        refuse(self.format, self.line(), code, message)
    }

    fn skip_space(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte == b'\n' {
                self.line += 1;
            } else if Some(byte) == self.comment {
                self.skip_to_line_end();
                continue;
            } else if !byte.is_ascii_whitespace() {
                return;
            }
            self.at += 1;
        }
    }

    fn skip_to_line_end(&mut self) {
        self.at += memchr::memchr(b'\n', self.rest()).unwrap_or(self.remaining());
    }

    /// The next word, which stays unread.
    pub fn peek(&mut self) -> Option<&'a [u8]> {
        self.skip_space();
        let rest = self.rest();
        let comment = self.comment;
        let length = rest.iter().position(|&b| b.is_ascii_whitespace() || Some(b) == comment);
        let word = &rest[..length.unwrap_or(rest.len())];
        (!word.is_empty()).then_some(word)
    }

    /// The next word, if any is left.
    pub fn next(&mut self) -> Option<&'a [u8]> {
        let word = self.peek()?;
        self.at += word.len();
        Some(word)
    }

    /// The next word; `what` says in an error what was to come.
    pub fn expect(&mut self, what: &str) -> Result<&'a [u8], ReadError> {
        self.next().ok_or_else(|| {
            self.refuse(code::TRUNCATED, format!("the file ends where {what} should stand — it is cut short"))
        })
    }

    /// What is left of the current line, without its end; the next word is of the next line.
    pub fn rest_of_line(&mut self) -> &'a [u8] {
        let rest = self.rest();
        let end = memchr::memchr(b'\n', rest);
        self.at += end.map_or(rest.len(), |e| e + 1);
        self.line += u64::from(end.is_some());
        rest[..end.unwrap_or(rest.len())].trim_ascii()
    }

    /// The next `size` bytes as they are: binary data.
    pub fn take(&mut self, size: usize, what: &str) -> Result<&'a [u8], ReadError> {
        let Some(data) = self.rest().get(..size) else {
            let message = format!(
                "{what} should take {size} bytes, but {} are left — the file is cut short or damaged",
                self.remaining()
            );
            return Err(refuse(self.format, None, code::TRUNCATED, message));
        };
        self.at += size;
        self.line_is_known = false;
        Ok(data)
    }

    /// A number of any kind that `parse` knows.
    fn number<T>(&mut self, what: &str, parse: fn(&[u8]) -> Option<T>) -> Result<T, ReadError> {
        let word = self.expect(what)?;
        parse(word).ok_or_else(|| self.refuse(code::BAD_NUMBER, not_a_number(word, what)))
    }

    /// A real number.
    pub fn float(&mut self, what: &str) -> Result<f64, ReadError> {
        self.number(what, parse_float)
    }

    /// A whole number.
    pub fn integer(&mut self, what: &str) -> Result<i64, ReadError> {
        self.number(what, parse_integer)
    }

    /// A count of items of which each takes at least `bytes_each` bytes of the rest of the file: a
    /// count that the file cannot hold is refused before anything is allocated for it.
    pub fn count(&mut self, what: &str, bytes_each: usize) -> Result<usize, ReadError> {
        let count = self.integer(what)?;
        let most = self.remaining() / bytes_each.max(1) + 1;
        if count < 0 {
            return Err(self.refuse(code::BAD_NUMBER, format!("{what} is {count}; it cannot be negative")));
        }
        usize::try_from(count).ok().filter(|&fits| fits <= most).ok_or_else(|| {
            let message = format!(
                "{what} is {count}, but the rest of the file has room for {most} at most — it is cut short or damaged"
            );
            self.refuse(code::TRUNCATED, message)
        })
    }
}

/// A real number in any notation of C, or with Fortran's `D` exponent.
pub(super) fn parse_float(word: &[u8]) -> Option<f64> {
    let word = std::str::from_utf8(word).ok()?;
    word.parse().ok().or_else(|| word.replace(['d', 'D'], "e").parse().ok())
}

/// What is wrong with a word that does not parse as the number `what`.
pub(super) fn not_a_number(word: &[u8], what: &str) -> String {
    let digits = word.strip_prefix(b"-").or_else(|| word.strip_prefix(b"+")).unwrap_or(word);
    if !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) {
        return format!("{} stands where {what} should; the number is too large", excerpt(word));
    }
    format!("{} stands where {what} should: a number", excerpt(word))
}

/// A whole number with an optional sign.
pub(super) fn parse_integer(word: &[u8]) -> Option<i64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}
