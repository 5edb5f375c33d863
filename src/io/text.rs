//! Text output: numbers in their shortest form that reads back as the same bits, formatted in parallel.

use crate::parallel;

/// Lines under construction.
#[derive(Default)]
pub(super) struct Text {
    bytes: Vec<u8>,
    integer: itoa::Buffer,
    float: zmij::Buffer,
}

impl Text {
    /// The finished text.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Adds words as they are.
    pub fn word(&mut self, word: &str) -> &mut Self {
        self.bytes.extend_from_slice(word.as_bytes());
        self
    }

    /// Adds a whole number.
    pub fn integer(&mut self, value: impl itoa::Integer) -> &mut Self {
        self.bytes.extend_from_slice(self.integer.format(value).as_bytes());
        self
    }

    /// Adds a finite real number: the shortest decimal that reads back as the same bits.
    pub fn float(&mut self, value: f64) -> &mut Self {
        self.bytes.extend_from_slice(self.float.format_finite(value).as_bytes());
        self
    }

    /// Adds the text of items `0..count`, formatted in blocks on all threads and put in order, so
    /// that the bytes are the same for any number of threads.
    pub fn items(&mut self, count: usize, format: impl Fn(&mut Self, usize) + Sync) -> &mut Self {
        const BLOCK: usize = 1 << 14;
        let blocks: Vec<Vec<u8>> = parallel::blocks(count, BLOCK, |block| {
            let mut text = Self::default();
            block.for_each(|item| format(&mut text, item));
            text.into_bytes()
        });
        self.bytes.reserve(blocks.iter().map(Vec::len).sum());
        for block in blocks {
            self.bytes.extend_from_slice(&block);
        }
        self
    }
}
