//! Segments of the plane as text: `x1 y1 x2 y2` a line, `#` begins a comment.

use super::error::{MeshFileError, Problem};
use super::precision::Digits;
use super::source::{At, Source};
use super::words::words_of;
use crate::FileError;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// Reads a file of segments: four numbers x1, y1, x2, y2 a line, separated by spaces or tabs. Lines without a number
/// and what follows `#` are passed over. The file is read once from front to end, so a pipe will do. O(size of the
/// file) time, 32 bytes of memory a segment.
///
/// # Errors
/// When the file cannot be read, is not UTF-8, or a line holds anything but four finite numbers; the line is named.
///
/// ```
/// let path = std::env::temp_dir().join(format!("lar-cross-{}.seg", std::process::id()));
/// std::fs::write(&path, "# a cross\n0 0 2 2\n0 2 2 0  # downwards\n").unwrap();
/// assert_eq!(lar_core::read_segments(&path)?, [[0., 0., 2., 2.], [0., 2., 2., 0.]]);
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), lar_core::MeshFileError>(())
/// ```
pub fn read_segments(path: impl AsRef<Path>) -> Result<Vec<[f64; 4]>, MeshFileError> {
    const BUFFER: usize = 1 << 18;
    let path = path.as_ref();
    let file =
        File::open(path).map_err(|source| FileError { path: path.to_owned(), action: "read", source })?;
    read(path, &mut BufReader::with_capacity(BUFFER, file))
}

/// Reads segments from the text of a file; `file` is for messages. O(size).
///
/// # Errors
/// As [`read_segments`].
///
/// ```
/// let refused = lar_core::parse_segments(b"0 0 1 1\n0 1 1\n", "a.seg").unwrap_err();
/// assert_eq!(refused.to_string(), "a.seg: line 2: 3 numbers where the 4 of a segment are needed");
/// ```
pub fn parse_segments(text: &[u8], file: impl AsRef<Path>) -> Result<Vec<[f64; 4]>, MeshFileError> {
    read(file.as_ref(), &mut &*text)
}

fn read(file: &Path, input: &mut dyn BufRead) -> Result<Vec<[f64; 4]>, MeshFileError> {
    let mut source = Source::new(file, input, 0);
    let mut segments = Vec::new();
    let mut digits = Digits::default();
    loop {
        if let Some(segment) = source.quick(|scan| scan.coordinates(&mut digits)) {
            source.at_line().check_size(2 * segments.len() + 2)?;
            segments.push(segment);
            continue;
        }
        let Some((at, line)) = source.line()? else { return Ok(segments) };
        let numbers = line.split('#').next().unwrap_or_default();
        if let Some(segment) = segment(at, numbers)? {
            at.check_size(2 * segments.len() + 2)?;
            segments.push(segment);
        }
    }
}

/// The segment of a line; `None` when the line is blank.
fn segment(at: At<'_>, line: &str) -> Result<Option<[f64; 4]>, MeshFileError> {
    const NEEDED: usize = 4;
    let mut segment = [0.; NEEDED];
    let (mut found, mut words) = (0, words_of(line));
    while !words.clone().first().is_empty() {
        let number = at.coordinate(&mut words, &mut Digits::default())?;
        if let Some(place) = segment.get_mut(found) {
            *place = number;
        }
        found += 1;
    }
    match found {
        0 => Ok(None),
        NEEDED => Ok(Some(segment)),
        _ => Err(at.error(Problem::NumberCount { found, needed: NEEDED, what: "a segment" })),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(text: &str, expected: Result<&[[f64; 4]], &str>) {
        let found = parse_segments(text.as_bytes(), "a.seg").map_err(|e| e.to_string());
        assert_eq!(found, expected.map(<[_]>::to_vec).map_err(str::to_owned), "{text:?}");
    }

    #[test]
    fn lines() {
        check("", Ok(&[]));
        check("# nothing\n\n   \n", Ok(&[]));
        check("1 2 3 4", Ok(&[[1., 2., 3., 4.]]));
        check(
            "\t-1e-3 +2. .5 -0 # end\r\n#1 2 3\n5 6 7 8\r\n",
            Ok(&[[-0.001, 2., 0.5, 0.], [5., 6., 7., 8.]]),
        );
    }

    #[test]
    fn refusals() {
        check("1 2 3", Err("a.seg: line 1: 3 numbers where the 4 of a segment are needed"));
        check("\n1 2 3 4 5", Err("a.seg: line 2: 5 numbers where the 4 of a segment are needed"));
        check("1 2 3 4\n1, 2, 3, 4", Err("a.seg: line 2: \"1,\" where a coordinate is needed"));
        check("1 2 x 4", Err("a.seg: line 1: \"x\" where a coordinate is needed"));
        check("1 2 3 nan", Err("a.seg: line 1: coordinate nan is not finite"));
        check("1 2 3 1e999", Err("a.seg: line 1: coordinate 1e999 is not finite"));
        let binary = parse_segments(b"1 2 3 4\n\xff\n", "a.seg").unwrap_err();
        assert_eq!(binary.to_string(), "a.seg: line 2: \"\u{fffd}\" where a coordinate is needed");
        let wide = parse_segments(b"\xff\xfe1\0 \0", "a.seg").unwrap_err();
        assert_eq!(wide.to_string(), "a.seg: line 1: not UTF-8 text");
        let missing = read_segments("no/such.seg").unwrap_err().to_string();
        assert!(missing.starts_with("cannot read no/such.seg: "), "{missing}");
    }

    proptest! {
        #[test]
        fn what_is_written_is_read(segments in prop::collection::vec(prop::array::uniform4(-1e9..1e9_f64), 0..20)) {
            let line = |s: &[f64; 4]| format!("{} {} {:e} {}\n", s[0], s[1], s[2], s[3]);
            let text: String = segments.iter().map(line).collect();
            prop_assert_eq!(parse_segments(text.as_bytes(), "a.seg").unwrap(), segments);
        }

        #[test]
        fn usual_lines_are_read_like_others(text in "([0-9]{1,3} |-?[0-9].[0-9]{0,3} |\n|\r\n|[0-9 .e#\t-]){0,40}") {
            // Nothing usual has a vertical tab.
            let [found, expected] = [text.clone(), text.replace(' ', "\u{b}")]
                .map(|text| parse_segments(text.as_bytes(), "a.seg").map_err(|e| e.to_string()));
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn no_text_panics(text in "[0-9 .e#\n-]{0,40}|\\PC{0,40}") {
            let _ = parse_segments(text.as_bytes(), "a.seg");
        }
    }
}
