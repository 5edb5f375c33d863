//! A place in the bytes of an OBJ file: blanks, words, numbers and ends of lines.
//!
//! Every byte is looked at a bounded number of times, so that reading is linear in the length of the
//! file whatever its lines, words and numbers are like.

use memchr::memchr2;

use crate::io::{Format, ReadError};

/// Bytes of a word that an error message shows.
const QUOTED: usize = 40;

pub(super) type Result<T> = std::result::Result<T, ReadError>;

/// An error of the OBJ reader.
pub(super) fn error(line: u64, code: &'static str, message: impl Into<String>) -> ReadError {
    ReadError { format: Format::Obj, line: Some(line), code, message: message.into() }
}

/// `word` as an error message shows it: in quotes, escaped, and cut if it is long.
pub(super) fn quoted(word: &[u8]) -> String {
    let shown = match std::str::from_utf8(word) {
        Ok(text) if text.chars().count() <= QUOTED => text.escape_debug().to_string(),
        Ok(text) => format!("{}…", text.chars().take(QUOTED).collect::<String>().escape_debug()),
        Err(_) if word.len() <= QUOTED => word.escape_ascii().to_string(),
        Err(_) => format!("{}…", word[..QUOTED].escape_ascii()),
    };
    format!("'{shown}'")
}

/// Reads a file from its first byte to its last.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
    line: u64,
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0B | 0x0C)
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes: bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes), position: 0, line: 1 }
    }

    /// The line of the file at which the cursor stands, from 1.
    pub(super) fn line(&self) -> u64 {
        self.line
    }

    /// Bytes from here to the end of the file.
    pub(super) fn remaining(&self) -> usize {
        self.bytes.len() - self.position
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.position).copied()
    }

    /// Length of the end of line at `position`: 0 if there is none.
    fn line_end_at(&self, position: usize) -> usize {
        match self.bytes.get(position) {
            Some(b'\n') => 1,
            Some(b'\r') if self.bytes.get(position + 1) == Some(&b'\n') => 2,
            Some(b'\r') => 1,
            _ => 0,
        }
    }

    /// True if the line goes on after the `\` at `position`.
    fn continues_at(&self, position: usize) -> bool {
        self.bytes[position] == b'\\' && self.line_end_at(position + 1) > 0
    }

    /// Skips blanks and continued ends of lines.
    pub(super) fn skip_blanks(&mut self) {
        while let Some(byte) = self.peek() {
            if is_blank(byte) {
                self.position += 1;
            } else if self.continues_at(self.position) {
                self.position += 1 + self.line_end_at(self.position + 1);
                self.line += 1;
            } else {
                return;
            }
        }
    }

    /// Skips to the first word of the next statement; `false` at the end of the file.
    pub(super) fn next_statement(&mut self) -> bool {
        loop {
            self.skip_blanks();
            match self.peek() {
                None => return false,
                Some(b'#') => self.skip_comment(),
                Some(b'\n' | b'\r') => self.skip_line_end(),
                Some(_) => return true,
            }
        }
    }

    fn skip_line_end(&mut self) {
        self.position += self.line_end_at(self.position);
        self.line += 1;
    }

    /// Moves to the end of this line. A `\` does not continue a comment.
    fn skip_comment(&mut self) {
        let rest = &self.bytes[self.position..];
        self.position += memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
    }

    /// Moves to the end of this statement.
    pub(super) fn skip_statement(&mut self) {
        self.rest_of_statement();
    }

    /// What stands between here and the end of the statement, and moves there. Continued lines are
    /// returned with their `\` and ends of lines.
    pub(super) fn rest_of_statement(&mut self) -> &'a [u8] {
        let start = self.position;
        loop {
            self.skip_comment();
            let end = self.position;
            if end == start || end == self.bytes.len() || self.bytes[end - 1] != b'\\' {
                return &self.bytes[start..end];
            }
            self.skip_line_end();
        }
    }

    /// True if nothing more stands in this statement.
    pub(super) fn at_end(&mut self) -> bool {
        self.skip_blanks();
        matches!(self.peek(), None | Some(b'\n' | b'\r' | b'#'))
    }

    /// True if a word that reaches up to here ends here.
    fn at_word_end(&self) -> bool {
        match self.peek() {
            None | Some(b'\n' | b'\r') => true,
            Some(byte) => is_blank(byte) || self.continues_at(self.position),
        }
    }

    /// The next word of the statement.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        if self.at_end() {
            return None;
        }
        let start = self.position;
        while !self.at_word_end() {
            self.position += 1;
        }
        Some(&self.bytes[start..self.position])
    }

    /// The word that starts at `start`, which is on this line and not after the cursor.
    fn word_from(&mut self, start: usize) -> &'a [u8] {
        self.position = start;
        self.word().unwrap_or_default()
    }

    /// The next number of the statement, rounded correctly.
    pub(super) fn number(&mut self) -> Result<Option<f64>> {
        if self.at_end() {
            return Ok(None);
        }
        let start = self.position;
        let text = &self.bytes[start..];
        let digits = if matches!(text[0], b'+' | b'-') { &text[1..] } else { text };
        // The parser would also take "inf" and "nan".
        if matches!(digits.first(), Some(b'0'..=b'9' | b'.'))
            && let Ok((number, length)) = fast_float2::parse_partial::<f64, _>(text)
        {
            self.position += length;
            if length <= ENOUGH_DIGITS && self.at_word_end() && number.is_finite() {
                return Ok(Some(number));
            }
        }
        let word = self.word_from(start);
        odd_number(word)
            .map(Some)
            .map_err(|(code, what)| error(self.line, code, format!("{} {what}", quoted(word))))
    }

    /// The next whole number of the statement, held at the ends of `i64` if it is beyond them.
    pub(super) fn integer(&mut self) -> Result<Option<i64>> {
        if self.at_end() {
            return Ok(None);
        }
        let start = self.position;
        match self.digits() {
            Some(number) if self.at_word_end() => Ok(Some(number)),
            _ => {
                let word = quoted(self.word_from(start));
                Err(error(
                    self.line,
                    "obj-bad-integer",
                    format!("{word} is not a whole number: write digits only"),
                ))
            }
        }
    }

    /// The next corner `v`, `v/vt`, `v//vn` or `v/vt/vn` of the statement: its `v`, held at the ends of
    /// `i64` if it is beyond them.
    pub(super) fn corner(&mut self) -> Result<Option<i64>> {
        if self.at_end() {
            return Ok(None);
        }
        let start = self.position;
        if let Some(vertex) = self.digits()
            && self.skip_slashed()
        {
            return Ok(Some(vertex));
        }
        let word = quoted(self.word_from(start));
        let message = format!("{word} is not a corner: write v, v/vt, v//vn or v/vt/vn in whole numbers");
        Err(error(self.line, "obj-bad-index", message))
    }

    /// Skips `/vt`, `//vn` and `/vt/vn`; false if something else stands there.
    fn skip_slashed(&mut self) -> bool {
        for _ in 0..2 {
            if self.at_word_end() {
                return true;
            }
            if self.peek() != Some(b'/') {
                return false;
            }
            self.position += 1;
            if !(self.at_word_end() || self.peek() == Some(b'/')) && self.digits().is_none() {
                return false;
            }
        }
        self.at_word_end()
    }

    /// Reads a sign and digits; `None` if there are no digits.
    fn digits(&mut self) -> Option<i64> {
        let negative = self.peek() == Some(b'-');
        if matches!(self.peek(), Some(b'+' | b'-')) {
            self.position += 1;
        }
        let start = self.position;
        let mut value = 0_i64;
        while let Some(digit @ b'0'..=b'9') = self.peek() {
            value = value.saturating_mul(10).saturating_add(i64::from(digit - b'0'));
            self.position += 1;
        }
        (self.position > start).then_some(if negative { -value } else { value })
    }
}

/// Digits that are enough to round a number correctly, if a digit that is not zero stands for all that
/// follow: the halves between two doubles have 767 digits at most.
const ENOUGH_DIGITS: usize = 800;

/// Reads a number that the fast way refused: one with a Fortran exponent or of very many digits, or else
/// says what is wrong with it.
fn odd_number(word: &[u8]) -> std::result::Result<f64, (&'static str, &'static str)> {
    match decimal(word).and_then(|text| fast_float2::parse::<f64, _>(&text).ok()) {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => {
            Err(("obj-number-too-large", "is beyond what a double holds (about 1.8e308): scale the model"))
        }
        None => Err(what_is_wrong(word)),
    }
}

/// `word` as sign, at most [`ENOUGH_DIGITS`] digits and an exponent, or `None` if it is no number.
///
/// The parser holds exponents at 65536, which is wrong for a word of more digits than that.
fn decimal(word: &[u8]) -> Option<Vec<u8>> {
    let is_marker = |b: &u8| matches!(b, b'e' | b'E' | b'd' | b'D');
    let (mantissa, exponent) = match word.iter().position(is_marker) {
        Some(at) => (&word[..at], whole_number(&word[at + 1..])?),
        None => (word, 0),
    };
    let (sign, mantissa) = match mantissa {
        [sign @ (b'+' | b'-'), rest @ ..] => (*sign, rest),
        _ => (b'+', mantissa),
    };
    let mut parts = mantissa.splitn(2, |&b| b == b'.');
    let (whole, fraction) = (parts.next()?, parts.next().unwrap_or_default());
    let mut digits = whole.iter().chain(fraction).copied().peekable();
    if digits.peek().is_none() || !digits.clone().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let zeros = digits.clone().take_while(|&b| b == b'0').count();
    let mut text = vec![sign, b'0', b'.'];
    text.extend(digits.by_ref().skip(zeros).take(ENOUGH_DIGITS));
    text.push(if digits.any(|b| b != b'0') { b'1' } else { b'0' });
    let point = whole.len() as i64 - zeros as i64;
    text.extend_from_slice(format!("e{}", exponent.saturating_add(point)).as_bytes());
    Some(text)
}

/// A whole number, held at the ends of `i64`.
fn whole_number(text: &[u8]) -> Option<i64> {
    let mut cursor = Cursor { bytes: text, position: 0, line: 0 };
    cursor.digits().filter(|_| cursor.position == text.len())
}

/// Why `word` is no number: a code, and what to do.
fn what_is_wrong(word: &[u8]) -> (&'static str, &'static str) {
    let start: Vec<u8> = word.iter().take(4).map(u8::to_ascii_lowercase).collect();
    match start.strip_prefix(b"-").or(start.strip_prefix(b"+")).unwrap_or(&start) {
        [b'n', b'a', b'n', ..] | [b'i', b'n', b'f', ..] | [b'1', b'.', b'#', ..] => {
            ("obj-not-finite", "is not a finite number: a node needs a place in space")
        }
        [b'0', b'x', ..] => ("obj-bad-number", "is hexadecimal: write it in decimal digits"),
        _ if word.contains(&b',') => ("obj-bad-number", "has a comma: write a decimal point"),
        _ => ("obj-bad-number", "is not a number: write it like 12, -0.5 or 1.5e-3"),
    }
}
