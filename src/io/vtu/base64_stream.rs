//! Base64 text as a stream of bytes. VTK encodes the header of an array and its data apart, each with
//! its own padding; meshio in one piece. Both are read: padding ends a piece, and the next one follows.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Why bytes could not be taken.
#[derive(Debug, PartialEq)]
pub(super) enum StreamError {
    /// The text ends too early.
    Ended,
    /// The text holds what base64 does not.
    NotBase64,
}

/// Bytes that come out of a text of base64 without white space.
pub(super) struct Base64Stream<'a> {
    text: &'a [u8],
    /// Decoded, but not yet asked for: two bytes at most.
    ahead: Vec<u8>,
}

impl<'a> Base64Stream<'a> {
    /// The bytes of `text`.
    pub fn new(text: &'a [u8]) -> Self {
        Self { text, ahead: Vec::new() }
    }

    /// The next `size` bytes.
    pub fn take(&mut self, size: usize) -> Result<Vec<u8>, StreamError> {
        if size > self.ahead.len() + self.text.len() / 4 * 3 {
            return Err(StreamError::Ended);
        }
        let mut bytes = std::mem::take(&mut self.ahead);
        bytes.reserve(size.saturating_sub(bytes.len()) + 3);
        while bytes.len() < size {
            let wanted = (size - bytes.len()).div_ceil(3) * 4;
            let chunk = &self.text[..wanted.min(self.text.len())];
            let padding = memchr::memchr(b'=', chunk);
            let piece = padding.map_or(chunk, |at| &chunk[..chunk.len().min(at / 4 * 4 + 4)]);
            if piece.is_empty() {
                return Err(StreamError::Ended);
            }
            STANDARD.decode_vec(piece, &mut bytes).map_err(|_| StreamError::NotBase64)?;
            self.text = &self.text[piece.len()..];
        }
        self.ahead = bytes.split_off(size);
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, sizes: &[usize], expected: &[&[u8]]) {
        let mut stream = Base64Stream::new(text.as_bytes());
        for (&size, &bytes) in sizes.iter().zip(expected) {
            assert_eq!(stream.take(size).as_deref(), Ok(bytes), "{text}");
        }
        assert_eq!(stream.take(1), Err(StreamError::Ended), "{text}");
    }

    #[test]
    fn pieces_with_their_own_padding_are_one_stream() {
        check("YWJjZA==ZWZn", &[4, 3], &[b"abcd", b"efg"]);
        check("YWJjZGVmZw==", &[4, 3], &[b"abcd", b"efg"]);
        check("YQ==Yg==", &[1, 1], &[b"a", b"b"]);
        check("YQ==Yg==", &[2], &[b"ab"]);
    }

    #[test]
    fn what_is_not_base64_is_told() {
        assert_eq!(Base64Stream::new(b"Y?Jj").take(3), Err(StreamError::NotBase64));
        assert_eq!(Base64Stream::new(b"YWJjZ").take(4), Err(StreamError::Ended));
    }
}
