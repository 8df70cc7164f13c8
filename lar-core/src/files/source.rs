//! A file read from front to end: lines of text and runs of bytes, with the place of each.

use super::error::{MeshFileError, Place, Problem};
use super::precision::Digits;
use super::words::Words;
use crate::FileError;
use crate::obj::is_utf16;
use std::io::{self, BufRead, Read};
use std::path::Path;
use std::string::FromUtf8Error;

/// Where something was read: what errors say.
#[derive(Clone, Copy, Debug)]
pub(crate) struct At<'a> {
    pub(crate) file: &'a Path,
    pub(crate) place: Place,
}

impl At<'_> {
    pub(crate) fn error(self, problem: Problem) -> MeshFileError {
        MeshFileError::Malformed { file: self.file.to_owned(), place: self.place, problem }
    }

    pub(crate) fn expected(self, expected: &'static str, found: &str) -> MeshFileError {
        self.error(Problem::Expected { expected, found: clip(found) })
    }

    /// A finite coordinate; its digits are noted.
    pub(crate) fn coordinate(self, words: &mut Words<'_>, digits: &mut Digits) -> Result<f64, MeshFileError> {
        let before = words.clone();
        let x = digits.next(words).map_err(|word| self.expected("a coordinate", word))?;
        if !x.is_finite() {
            return Err(self.error(Problem::NonFinite { value: clip(before.first()) }));
        }
        // Minus zero is where zero is: equal points have equal coordinates.
        Ok(x + 0.)
    }

    /// A whole number from 0.
    pub(crate) fn count(self, word: Option<&str>, expected: &'static str) -> Result<u64, MeshFileError> {
        let word = word.unwrap_or("");
        word.parse().map_err(|_| self.expected(expected, word))
    }

    /// The index of a vertex, known to be below `n_vertices`.
    pub(crate) fn vertex(self, index: i64, n_vertices: usize) -> Result<u32, MeshFileError> {
        match (usize::try_from(index), u32::try_from(index)) {
            (Ok(i), Ok(vertex)) if i < n_vertices => Ok(vertex),
            _ => Err(self.error(Problem::VertexOutOfRange { index, n_vertices })),
        }
    }

    /// Refuses what `u32` cannot number.
    pub(crate) fn check_size(self, n: usize) -> Result<(), MeshFileError> {
        if n < u32::MAX as usize { Ok(()) } else { Err(self.error(Problem::TooLarge)) }
    }
}

/// What some editors put before UTF-8 text.
pub(crate) const MARK: &[u8] = b"\xef\xbb\xbf";

/// No line of a surface comes near this many bytes; a file without line ends must not be gathered whole.
const LONGEST_LINE: u64 = 1 << 28;

/// The first characters of what may be a line of megabytes.
pub(crate) fn clip(text: &str) -> String {
    const KEPT: usize = 60;
    match text.char_indices().nth(KEPT) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// A file on its way through a reader. `len` is the number of bytes that it has in all.
pub(crate) struct Source<'a> {
    file: &'a Path,
    input: &'a mut dyn BufRead,
    len: u64,
    offset: u64,
    line: u64,
    /// The line with its end.
    text: String,
    /// Whether it is the first line of UTF-16.
    is_utf16: bool,
}

impl<'a> Source<'a> {
    pub(crate) fn new(file: &'a Path, input: &'a mut dyn BufRead, len: u64) -> Self {
        Self { file, input, len, offset: 0, line: 0, text: String::new(), is_utf16: false }
    }

    /// Length of the file in bytes.
    pub(crate) fn len(&self) -> u64 {
        self.len
    }

    /// Bytes not read yet.
    pub(crate) fn rest(&self) -> u64 {
        self.len.saturating_sub(self.offset)
    }

    /// The line read last.
    pub(crate) fn at_line(&self) -> At<'a> {
        At { file: self.file, place: Place::Line(self.line.max(1)) }
    }

    /// The byte to be read next.
    pub(crate) fn at_byte(&self) -> At<'a> {
        At { file: self.file, place: Place::Byte(self.offset) }
    }

    /// The name of the file without extension.
    pub(crate) fn stem(&self) -> String {
        self.file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
    }

    /// The next line without its end; `None` at the end of the file.
    pub(crate) fn line(&mut self) -> Result<Option<(At<'a>, &str)>, MeshFileError> {
        if self.advance()? { self.text().map(Some) } else { Ok(None) }
    }

    /// The next line, or the error that `expected` is missing.
    pub(crate) fn needed_line(&mut self, expected: &'static str) -> Result<(At<'a>, &str), MeshFileError> {
        let end = self.at_line();
        self.line()?.ok_or_else(|| end.error(Problem::Ends { expected }))
    }

    /// The next line that holds more than spaces and a comment from `#` on, or the error that `expected` is
    /// missing.
    pub(crate) fn statement(&mut self, expected: &'static str) -> Result<(At<'a>, &str), MeshFileError> {
        let blank = |line: &[u8]| matches!(line.trim_ascii_start().first(), None | Some(b'#'));
        while self.advance()? {
            if !blank(self.text.as_bytes()) {
                let (at, line) = self.text()?;
                return Ok((at, line.split('#').next().unwrap_or_default()));
            }
        }
        Err(self.at_line().error(Problem::Ends { expected }))
    }

    /// Takes the next line into the buffer; false at the end of the file. Names and comments may be in any encoding
    /// that agrees with ASCII: what is not UTF-8 in them reads as U+FFFD.
    fn advance(&mut self) -> Result<bool, MeshFileError> {
        let mut bytes = std::mem::take(&mut self.text).into_bytes();
        bytes.clear();
        let n = self.read_line(&mut bytes).map_err(|source| self.failure(source))?;
        if n as u64 == LONGEST_LINE {
            return Err(self.at_line().error(Problem::LongLine { limit: LONGEST_LINE }));
        }
        self.offset += n as u64;
        self.line += u64::from(n > 0);
        if self.line == 1 && bytes.starts_with(MARK) {
            bytes.drain(..MARK.len());
        }
        self.is_utf16 = self.line == 1 && is_utf16(&bytes);
        let lossy = |error: FromUtf8Error| String::from_utf8_lossy(error.as_bytes()).into_owned();
        self.text = String::from_utf8(bytes).unwrap_or_else(lossy);
        Ok(n > 0)
    }

    /// Reads up to the end of the line, or as much as a line may have. What is too long for the memory is an error.
    fn read_line(&mut self, bytes: &mut Vec<u8>) -> io::Result<usize> {
        const CHUNK: usize = 1 << 16;
        let longest = LONGEST_LINE as usize;
        loop {
            let left = longest - bytes.len();
            if bytes.capacity() - bytes.len() < CHUNK.min(left) {
                let more = bytes.len().max(CHUNK).min(left);
                bytes.try_reserve_exact(more).map_err(|_| io::ErrorKind::OutOfMemory)?;
            }
            let n = (&mut *self.input).take(CHUNK.min(left) as u64).read_until(b'\n', bytes)?;
            if n < CHUNK || bytes.ends_with(b"\n") {
                return Ok(bytes.len());
            }
        }
    }

    fn text(&self) -> Result<(At<'a>, &str), MeshFileError> {
        let at = self.at_line();
        if self.is_utf16 {
            return Err(at.error(Problem::NotUtf8));
        }
        Ok((at, self.text.trim_end_matches(['\n', '\r'])))
    }

    /// The next bytes, or the error that `expected` is missing.
    pub(crate) fn bytes<const N: usize>(&mut self, expected: &'static str) -> Result<[u8; N], MeshFileError> {
        let mut bytes = [0; N];
        match self.input.read_exact(&mut bytes) {
            Ok(()) => {
                self.offset += N as u64;
                Ok(bytes)
            }
            Err(e) if e.kind() == io::ErrorKind::UnexpectedEof => {
                Err(self.at_byte().error(Problem::Ends { expected }))
            }
            Err(source) => Err(self.failure(source)),
        }
    }

    /// Makes room for `n` more items, or says that there is none.
    pub(crate) fn make_room<T>(&self, items: &mut Vec<T>, n: usize) -> Result<(), MeshFileError> {
        items.try_reserve_exact(n).map_err(|_| self.failure(io::ErrorKind::OutOfMemory.into()))
    }

    fn failure(&self, source: io::Error) -> MeshFileError {
        FileError { path: self.file.to_owned(), action: "read", source }.into()
    }
}
