//! A file read from front to end: lines of text and runs of bytes, with the place of each.

use super::error::{MeshFileError, Place, Problem};
use super::precision::Digits;
use super::scan::Scan;
use super::words::Words;
use crate::FileError;
use crate::obj::is_utf16;
use memchr::memchr;
use std::io::{self, BufRead, Read};
use std::mem;
use std::path::Path;

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
    /// Length of the line with its end, as far as it stands at the beginning of the input's buffer.
    lent: usize,
    /// The line with its end where it does not stand there whole.
    gathered: Vec<u8>,
    /// The line where it is not UTF-8.
    lossy: String,
}

impl<'a> Source<'a> {
    pub(crate) fn new(file: &'a Path, input: &'a mut dyn BufRead, len: u64) -> Self {
        Self { file, input, len, offset: 0, line: 0, lent: 0, gathered: Vec::new(), lossy: String::new() }
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

    /// What a form reads that the next line begins and a line end ends; `None`, and nothing read, where the text has
    /// another form or the buffer ends before.
    #[inline]
    pub(crate) fn quick<T>(&mut self, form: impl FnOnce(&mut Scan<'_>) -> Option<T>) -> Option<T> {
        /// More is no usual line, and what is no usual line is not looked through in vain.
        const LONGEST: usize = 1 << 12;
        self.input.consume(mem::take(&mut self.lent));
        // An error comes again.
        let ahead = fill(self.input).ok()?;
        let ahead = &ahead[..ahead.len().min(LONGEST)];
        let mut scan = Scan::new(ahead);
        let read = form(&mut scan)?;
        let (n, lines) = (ahead.len() - scan.rest().len(), scan.lines);
        self.input.consume(n);
        self.offset += n as u64;
        self.line += lines;
        Some(read)
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
        while self.advance()? {
            let failed = |source| failure(self.file, source);
            let line = self.bytes_of_line().map_err(failed)?;
            if !matches!(line.trim_ascii_start().first(), None | Some(b'#')) {
                let (at, line) = self.text()?;
                return Ok((at, memchr(b'#', line.as_bytes()).map_or(line, |end| &line[..end])));
            }
        }
        Err(self.at_line().error(Problem::Ends { expected }))
    }

    /// Goes on to the next line; false at the end of the file.
    fn advance(&mut self) -> Result<bool, MeshFileError> {
        self.input.consume(mem::take(&mut self.lent));
        let n = self.find_line().map_err(|source| self.failure(source))? as u64;
        if n >= LONGEST_LINE {
            return Err(self.at_line().error(Problem::LongLine { limit: LONGEST_LINE }));
        }
        self.offset += n;
        self.line += u64::from(n > 0);
        Ok(n > 0)
    }

    /// Length of the next line with its end. It stays in the buffer if it stands there whole.
    fn find_line(&mut self) -> io::Result<usize> {
        self.gathered.clear();
        let ahead = fill(self.input)?;
        match memchr(b'\n', ahead) {
            Some(n) => self.lent = n + 1,
            None if ahead.is_empty() => {}
            None => return self.gather_line(),
        }
        Ok(self.lent)
    }

    /// Reads up to the end of the line, or as much as a line may have. What is too long for the memory is an error.
    fn gather_line(&mut self) -> io::Result<usize> {
        const CHUNK: usize = 1 << 16;
        let (longest, bytes) = (LONGEST_LINE as usize, &mut self.gathered);
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

    /// The line read last, without its end and without the mark before the first.
    fn bytes_of_line(&mut self) -> io::Result<&[u8]> {
        line_in(self.input, self.lent, &self.gathered, self.line == 1)
    }

    /// The line read last as text. Names and comments may be in any encoding that agrees with ASCII: what is not UTF-8
    /// in them reads as U+FFFD.
    fn text(&mut self) -> Result<(At<'a>, &str), MeshFileError> {
        let (at, first) = (self.at_line(), self.line == 1);
        let bytes = line_in(self.input, self.lent, &self.gathered, first)
            .map_err(|source| failure(self.file, source))?;
        if first && is_utf16(bytes) {
            return Err(at.error(Problem::NotUtf8));
        }
        if let Ok(text) = str::from_utf8(bytes) {
            return Ok((at, text));
        }
        self.lossy = String::from_utf8_lossy(bytes).into_owned();
        Ok((at, &self.lossy))
    }

    /// The next bytes, or the error that `expected` is missing.
    pub(crate) fn bytes<const N: usize>(&mut self, expected: &'static str) -> Result<[u8; N], MeshFileError> {
        if self.lent > 0 {
            self.input.consume(mem::take(&mut self.lent));
        }
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

    /// Gives `each` the next `n` records with the place where each begins, or the error that `expected` is missing. They
    /// are read where they stand in the buffer: what was copied in pieces of one size and is read in pieces of another
    /// makes a processor wait.
    pub(crate) fn records<const N: usize>(
        &mut self,
        n: u64,
        expected: &'static str,
        mut each: impl FnMut(At<'a>, &[u8; N]) -> Result<(), MeshFileError>,
    ) -> Result<(), MeshFileError> {
        self.input.consume(mem::take(&mut self.lent));
        let mut left = n;
        while left > 0 {
            let ahead = fill(self.input).map_err(|source| failure(self.file, source))?;
            let (whole, _) = ahead.as_chunks();
            let whole = &whole[..whole.len().min(usize::try_from(left).unwrap_or(usize::MAX))];
            for record in whole {
                each(At { file: self.file, place: Place::Byte(self.offset) }, record)?;
                self.offset += N as u64;
            }
            let n_whole = whole.len();
            self.input.consume(n_whole * N);
            left -= n_whole as u64;
            if n_whole == 0 {
                let at = self.at_byte();
                each(at, &self.bytes(expected)?)?;
                left -= 1;
            }
        }
        Ok(())
    }

    /// Makes room for `n` more items, or says that there is none.
    pub(crate) fn make_room<T>(&self, items: &mut Vec<T>, n: usize) -> Result<(), MeshFileError> {
        items.try_reserve_exact(n).map_err(|_| self.failure(io::ErrorKind::OutOfMemory.into()))
    }

    fn failure(&self, source: io::Error) -> MeshFileError {
        failure(self.file, source)
    }
}

fn failure(file: &Path, source: io::Error) -> MeshFileError {
    FileError { path: file.to_owned(), action: "read", source }.into()
}

/// What the buffer holds, filled where it is empty; nothing at the end.
fn fill(input: &mut dyn BufRead) -> io::Result<&[u8]> {
    loop {
        match input.fill_buf() {
            Ok([]) => return Ok(&[]),
            Ok(_) => return input.fill_buf(),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// A line without its end: so much of the buffer, or what was gathered. Before the first line there may be a mark.
fn line_in<'l>(
    input: &'l mut dyn BufRead,
    lent: usize,
    gathered: &'l [u8],
    first: bool,
) -> io::Result<&'l [u8]> {
    let line = if lent > 0 { &input.fill_buf()?[..lent] } else { gathered };
    let line = if first { line.strip_prefix(MARK).unwrap_or(line) } else { line };
    let ends = line.iter().rev().take_while(|byte| matches!(byte, b'\n' | b'\r')).count();
    Ok(&line[..line.len() - ends])
}
