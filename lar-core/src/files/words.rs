//! Words of a line of text.

use super::decimal::Decimal;

/// The words between white space of any kind, as `split_whitespace` has them; quicker where the line is ASCII.
pub(crate) fn words_of(line: &str) -> Words<'_> {
    Words { rest: line, is_ascii: line.is_ascii() }
}

#[derive(Clone, Debug)]
pub(crate) struct Words<'a> {
    rest: &'a str,
    is_ascii: bool,
}

impl<'a> Words<'a> {
    /// The next word, empty when there is none.
    pub(crate) fn first(mut self) -> &'a str {
        self.next().unwrap_or("")
    }

    /// The next word and the number that it is in decimal notation; `None`, with nothing taken, where it is not.
    pub(super) fn decimal(&mut self) -> Option<(Decimal, &'a str)> {
        let bytes = self.rest.as_bytes();
        let begin = bytes.iter().position(|&byte| !is_space(byte))?;
        let (decimal, length) = Decimal::parse(&bytes[begin..])?;
        let end = begin + length;
        if bytes.get(end).is_some_and(|&byte| !is_space(byte)) {
            return None;
        }
        let word = &self.rest[begin..end];
        self.rest = &self.rest[end..];
        Some((decimal, word))
    }
}

/// White space among the ASCII characters: space, tab, line feed, vertical tab, form feed, carriage return.
fn is_space(byte: u8) -> bool {
    byte == b' ' || matches!(byte, b'\t'..=b'\r')
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        let (begin, end) = if self.is_ascii {
            let bytes = self.rest.as_bytes();
            let begin = bytes.iter().position(|&byte| !is_space(byte))?;
            let length = bytes[begin..].iter().position(|&byte| is_space(byte));
            (begin, length.map_or(bytes.len(), |length| begin + length))
        } else {
            let begin = self.rest.find(|c: char| !c.is_whitespace())?;
            let length = self.rest[begin..].find(char::is_whitespace);
            (begin, length.map_or(self.rest.len(), |length| begin + length))
        };
        let word = &self.rest[begin..end];
        self.rest = &self.rest[end..];
        Some(word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn as_the_standard_library_has_them(line in "[ab \t\r\u{b}\u{c}\u{a0}\u{85}\u{2003}é]{0,30}", plain in "[ab \t\r\u{b}\u{c}]{0,30}") {
            for line in [line, plain] {
                prop_assert_eq!(words_of(&line).collect::<Vec<_>>(), line.split_whitespace().collect::<Vec<_>>());
            }
        }
    }
}
