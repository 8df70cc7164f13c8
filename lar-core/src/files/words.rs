//! Words of a line of text.

use super::decimal::Decimal;

/// The words between white space of any kind, as `split_whitespace` has them; quicker where they are ASCII.
pub(crate) fn words_of(line: &str) -> Words<'_> {
    Words { rest: line }
}

#[derive(Clone, Debug)]
pub(crate) struct Words<'a> {
    rest: &'a str,
}

impl<'a> Words<'a> {
    /// The next word, empty when there is none.
    pub(crate) fn first(mut self) -> &'a str {
        self.next().unwrap_or("")
    }

    /// The next word and the number that it is in decimal notation; `None`, with nothing taken, where it is not.
    #[inline]
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

    /// Where the next word begins and ends; `None` where that takes more than ASCII characters to tell.
    #[inline]
    fn ascii(&self) -> Option<(usize, usize)> {
        let bytes = self.rest.as_bytes();
        let begin = bytes.iter().position(|&byte| !is_space(byte))?;
        let length = bytes[begin..].iter().position(|&byte| is_space(byte) || !byte.is_ascii());
        let end = length.map_or(bytes.len(), |length| begin + length);
        bytes.get(end).is_none_or(u8::is_ascii).then_some((begin, end))
    }

    fn unicode(&self) -> Option<(usize, usize)> {
        let begin = self.rest.find(|c: char| !c.is_whitespace())?;
        let length = self.rest[begin..].find(char::is_whitespace);
        Some((begin, length.map_or(self.rest.len(), |length| begin + length)))
    }
}

/// White space among the ASCII characters: space, tab, line feed, vertical tab, form feed, carriage return.
#[inline]
fn is_space(byte: u8) -> bool {
    byte == b' ' || matches!(byte, b'\t'..=b'\r')
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a str;

    #[inline]
    fn next(&mut self) -> Option<&'a str> {
        let (begin, end) = self.ascii().or_else(|| self.unicode())?;
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
