//! Lines of an Abaqus input deck: keywords with their parameters, and data.

use crate::io::refusal::{code, refuse};
use crate::io::tokens::{not_a_number, parse_float, parse_integer};
use crate::io::{Format, ReadError};

/// The lines of a file that say something: comments and empty lines are left out.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u64,
}

/// A line with its number.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub text: &'a [u8],
    pub number: u64,
}

/// A keyword line, with the lines that continue it.
pub(super) struct Keyword {
    /// In capitals, such as `END PART`.
    pub name: String,
    /// Names in capitals, and values as they are written.
    parameters: Vec<(String, String)>,
    pub line: u64,
}

impl<'a> Lines<'a> {
    /// The lines of `bytes`.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), number: 0 }
    }

    /// The next line that is neither empty nor a comment.
    fn next_line(&mut self) -> Option<Line<'a>> {
        while !self.rest.is_empty() {
            let end = memchr::memchr(b'\n', self.rest).unwrap_or(self.rest.len());
            let text = self.rest[..end].trim_ascii();
            self.rest = self.rest.get(end + 1..).unwrap_or_default();
            self.number += 1;
            if !text.is_empty() && !text.starts_with(b"**") {
                return Some(Line { text, number: self.number });
            }
        }
        None
    }

    /// The next data line of the current keyword; `None` before the next keyword and at the end.
    pub fn next_data(&mut self) -> Option<Line<'a>> {
        let before = (self.rest, self.number);
        let line = self.next_line()?;
        if line.text.starts_with(b"*") {
            (self.rest, self.number) = before;
            return None;
        }
        Some(line)
    }

    /// Is an element that may end here, and lacks `missing` of the nodes that it may have, continued after `line`? It is
    /// after a comma, or where the next line has just these nodes.
    pub fn continue_element(&self, line: Line<'_>, missing: usize) -> bool {
        let next = Self { ..*self }.next_data();
        next.is_some_and(|next| line.text.ends_with(b",") || next.fields().count() == missing)
    }

    /// The next keyword; data lines before it are stepped over.
    pub fn next_keyword(&mut self) -> Option<Keyword> {
        loop {
            let line = self.next_line()?;
            if line.text.starts_with(b"*") {
                let mut text = line.text[1..].to_vec();
                while text.ends_with(b",")
                    && let Some(more) = self.next_data()
                {
                    text.extend_from_slice(more.text);
                }
                return Some(Keyword::parse(&String::from_utf8_lossy(&text), line.number));
            }
        }
    }
}

impl Keyword {
    fn parse(text: &str, line: u64) -> Self {
        let mut words = text.split(',').map(str::trim);
        let name = words.next().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ");
        let parameters = words
            .filter(|word| !word.is_empty())
            .map(|word| {
                let (name, value) = word.split_once('=').unwrap_or((word, ""));
                (name.trim().to_ascii_uppercase(), value.trim().trim_matches('"').to_owned())
            })
            .collect();
        Self { name: name.to_ascii_uppercase(), parameters, line }
    }

    /// The value of a parameter; empty if it is there without one.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.parameters.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// The value of a parameter that must be there.
    pub fn require(&self, name: &str) -> Result<&str, ReadError> {
        self.get(name)
            .filter(|value| !value.is_empty())
            .ok_or_else(|| self.refuse(code::SYNTAX, format!("*{} lacks its parameter {name}", self.name)))
    }

    /// An error at the keyword's line.
    pub fn refuse(&self, code: &'static str, message: String) -> ReadError {
        refuse(Format::Inp, self.line, code, message)
    }
}

impl<'a> Line<'a> {
    /// The fields between the commas, without the empty one after a comma at the end.
    pub fn fields(self) -> impl Iterator<Item = &'a [u8]> {
        let text = self.text.strip_suffix(b",").unwrap_or(self.text);
        text.split(|&byte| byte == b',').map(<[u8]>::trim_ascii)
    }

    /// A whole number in a field.
    pub fn integer(self, field: &[u8], what: &str) -> Result<i64, ReadError> {
        parse_integer(field).ok_or_else(|| self.bad_number(field, what))
    }

    /// A real number in a field; an empty field is 0.
    pub fn float(self, field: &[u8], what: &str) -> Result<f64, ReadError> {
        if field.is_empty() {
            return Ok(0.0);
        }
        parse_float(field).ok_or_else(|| self.bad_number(field, what))
    }

    /// An error at this line.
    pub fn refuse(self, code: &'static str, message: String) -> ReadError {
        refuse(Format::Inp, self.number, code, message)
    }

    fn bad_number(self, field: &[u8], what: &str) -> ReadError {
        self.refuse(code::BAD_NUMBER, not_a_number(field, what))
    }
}
