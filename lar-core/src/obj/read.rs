//! Reading OBJ.
//!
//! Read are `v`, `f`, `g`, `o`, comments and lines continued by a backslash; other statements (normals,
//! textures, materials, lines, curves) say nothing about polygons and are passed over. Corners keep their
//! vertex only. A face may name vertices that come further down. Names and comments may be in any encoding that
//! agrees with ASCII: what is not UTF-8 in them reads as U+FFFD.

use super::ObjError;
use crate::atomic_write::read;
use crate::files::{Digits, MARK, Scan, Words, words_of};
use crate::{Cells, Points, Surface};
use memchr::memchr;
use rustc_hash::FxHashMap;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// How the faces of an OBJ file are shared out to surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ObjGrouping {
    /// One surface of all faces, named by the file.
    #[default]
    Whole,
    /// One surface for each name that a `g` or `o` statement gives, in the order of their first faces; faces
    /// before the first such statement make a surface named by the file. Each keeps only the vertices that it
    /// uses.
    Groups,
}

/// Reads an OBJ file. All faces have coefficient +1. O(size of the file).
///
/// # Errors
/// When the file cannot be read, is UTF-16, has no faces or a malformed line; see [`ObjError`].
pub fn read_obj(path: impl AsRef<Path>, grouping: ObjGrouping) -> Result<Vec<Surface>, ObjError> {
    let path = path.as_ref();
    parse(&read(path)?, path, grouping)
}

/// Whether the bytes begin with the byte-order mark of UTF-16.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
}

/// Reads the text of an OBJ file; `file` is for names and messages. O(size).
///
/// # Errors
/// As [`read_obj`].
///
/// ```
/// use lar_core::{ObjGrouping, parse_obj};
/// let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf -1 -2 -3\n";
/// let surfaces = parse_obj(text, "square.obj", ObjGrouping::Whole)?;
/// assert_eq!((surfaces[0].name.as_str(), surfaces[0].n_faces()), ("square", 2));
/// # Ok::<(), lar_core::ObjError>(())
/// ```
pub fn parse_obj(
    text: &str,
    file: impl AsRef<Path>,
    grouping: ObjGrouping,
) -> Result<Vec<Surface>, ObjError> {
    parse(text.as_bytes(), file.as_ref(), grouping)
}

/// Reads the bytes of an OBJ file. UTF-16, which has other bytes for `v` and `f`, is refused.
pub(crate) fn parse(bytes: &[u8], file: &Path, grouping: ObjGrouping) -> Result<Vec<Surface>, ObjError> {
    if is_utf16(bytes) {
        return Err(ObjError::NotUtf8 { file: file.to_owned(), line: 1 });
    }
    let mut reader = Reader::new(file);
    let mut lines = Lines { number: 1, rest: bytes.strip_prefix(MARK).unwrap_or(bytes) };
    while !lines.rest.is_empty() {
        let line = lines.number;
        if !reader.quick(&mut lines)? {
            reader.statement(line, &lines.statement())?;
        }
    }
    reader.check_faces()?;
    let precision = reader.digits.precision();
    let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let mut surfaces = match grouping {
        ObjGrouping::Whole => vec![reader.whole(name)],
        ObjGrouping::Groups => reader.groups(&name),
    };
    surfaces.iter_mut().for_each(|surface| surface.precision = precision);
    Ok(surfaces)
}

/// The lines of a text that are left.
struct Lines<'t> {
    /// Of the next line, from 1.
    number: usize,
    rest: &'t [u8],
}

impl<'t> Lines<'t> {
    /// The next line, lossily as text; empty at the end.
    fn line(&mut self) -> Cow<'t, str> {
        let end = memchr(b'\n', self.rest).unwrap_or(self.rest.len());
        let line = &self.rest[..end];
        self.rest = self.rest.get(end + 1..).unwrap_or_default();
        self.number += 1;
        String::from_utf8_lossy(line)
    }

    /// The next statement: comments cut off, continued lines joined.
    fn statement(&mut self) -> Cow<'t, str> {
        let line = self.line();
        let Some(start) = continued(&line) else {
            return match line {
                Cow::Borrowed(line) => uncommented(line).into(),
                Cow::Owned(line) => uncommented(&line).to_owned().into(),
            };
        };
        let mut joined = start.to_owned();
        while !self.rest.is_empty() {
            let line = self.line();
            joined.push(' ');
            if let Some(part) = continued(&line) {
                joined.push_str(part);
            } else {
                joined.push_str(uncommented(&line));
                break;
            }
        }
        joined.into()
    }
}

fn uncommented(line: &str) -> &str {
    memchr(b'#', line.as_bytes()).map_or(line, |end| &line[..end])
}

/// The line without the backslash that continues it; `None` when it ends here. A comment does not continue.
fn continued(line: &str) -> Option<&str> {
    line.trim_end().strip_suffix('\\').filter(|start| !start.contains('#'))
}

struct Reader<'a> {
    file: &'a Path,
    coords: Vec<f64>,
    /// What the coordinates are worth.
    digits: Digits,
    faces: Cells,
    /// The face being read.
    face: Vec<u32>,
    /// Faces that name vertices further down, with their lines.
    forward: Vec<(u32, usize)>,
    /// The first face of each run of faces of one group, and the group.
    runs: Vec<(u32, u32)>,
    /// Names of groups in first-seen order; group 0 is the file itself.
    names: Vec<String>,
    group_of: FxHashMap<String, u32>,
    group: u32,
}

impl<'a> Reader<'a> {
    fn new(file: &'a Path) -> Self {
        Self {
            file,
            coords: Vec::new(),
            digits: Digits::default(),
            faces: Cells::new(),
            face: Vec::new(),
            forward: Vec::new(),
            runs: Vec::new(),
            names: vec![String::new()],
            group_of: FxHashMap::default(),
            group: 0,
        }
    }

    fn path(&self) -> PathBuf {
        self.file.to_owned()
    }

    fn n_vertices(&self) -> usize {
        self.coords.len() / 3
    }

    fn statement(&mut self, line: usize, statement: &str) -> Result<(), ObjError> {
        let mut words = words_of(statement);
        match words.next() {
            Some("v") => self.vertex(line, words),
            Some("f") => self.face(line, words),
            Some("g" | "o") => self.open_group(line, words.collect::<Vec<_>>().join(" ")),
            _ => Ok(()),
        }
    }

    /// Reads the next line if it is a vertex or a face in the usual form.
    fn quick(&mut self, lines: &mut Lines<'_>) -> Result<bool, ObjError> {
        let mut scan = Scan::new(lines.rest);
        match lines.rest {
            [b'v', b' ' | b'\t', ..] => {
                let Some(point) = point(&mut scan, &mut self.digits) else { return Ok(false) };
                self.coords.extend(point);
                self.check_size(lines.number, self.n_vertices())?;
            }
            [b'f', b' ' | b'\t', ..] => {
                if self.corners(&mut scan, lines.number).is_none() {
                    return Ok(false);
                }
                self.close_face(lines.number)?;
            }
            _ => return Ok(false),
        }
        *lines = Lines { number: lines.number + 1, rest: scan.rest() };
        Ok(true)
    }

    /// Takes the corners of a face from its line.
    fn corners(&mut self, scan: &mut Scan<'_>, line: usize) -> Option<()> {
        scan.keyword("f")?;
        self.face.clear();
        while let Some(index) = scan.corner() {
            self.face.push(self.resolve(line, index).ok()?);
        }
        scan.end_line()
    }

    fn vertex(&mut self, line: usize, mut words: Words<'_>) -> Result<(), ObjError> {
        for found in 0..3 {
            let before = words.clone();
            let value = || before.clone().first().to_owned();
            match self.digits.next(&mut words) {
                Ok(x) if x.is_finite() => self.coords.push(x),
                Ok(_) => return Err(ObjError::NonFinite { file: self.path(), line, value: value() }),
                Err("") => return Err(ObjError::ShortVertex { file: self.path(), line, found }),
                Err(_) => return Err(ObjError::NotANumber { file: self.path(), line, value: value() }),
            }
        }
        self.check_size(line, self.n_vertices())
    }

    fn face(&mut self, line: usize, words: Words<'_>) -> Result<(), ObjError> {
        self.face.clear();
        for word in words {
            let Some(index) = corner(word) else {
                return Err(ObjError::NotACorner { file: self.path(), line, value: word.to_owned() });
            };
            self.face.push(self.resolve(line, index)?);
        }
        self.close_face(line)
    }

    fn close_face(&mut self, line: usize) -> Result<(), ObjError> {
        let found = self.face.len();
        if found < 3 {
            return Err(ObjError::ShortFace { file: self.path(), line, found });
        }
        self.check_size(line, self.faces.indices().len() + found)?;
        let number = u32::try_from(self.faces.len()).expect("there are fewer faces than corners");
        let n_vertices = self.n_vertices();
        if self.face.iter().any(|&v| v as usize >= n_vertices) {
            self.forward.push((number, line));
        }
        if self.runs.last().is_none_or(|run| run.1 != self.group) {
            self.runs.push((number, self.group));
        }
        self.faces.push(&self.face);
        Ok(())
    }

    /// The vertex from 0 of an index from 1 or, counted back from the last vertex above the line, from −1.
    fn resolve(&self, line: usize, index: i64) -> Result<u32, ObjError> {
        let n_vertices = self.n_vertices();
        let vertex =
            if index > 0 { index - 1 } else { i64::try_from(n_vertices).unwrap_or(i64::MAX) + index };
        match u32::try_from(vertex) {
            Ok(vertex) if index != 0 => Ok(vertex),
            _ => Err(ObjError::VertexOutOfRange { file: self.path(), line, index, n_vertices }),
        }
    }

    fn open_group(&mut self, line: usize, name: String) -> Result<(), ObjError> {
        self.check_size(line, self.names.len())?;
        let name = if name.is_empty() { "default".to_owned() } else { name };
        let next = u32::try_from(self.names.len()).unwrap_or(u32::MAX);
        self.group = *self.group_of.entry(name.clone()).or_insert(next);
        if self.group == next {
            self.names.push(name);
        }
        Ok(())
    }

    fn check_size(&self, line: usize, n: usize) -> Result<(), ObjError> {
        if u32::try_from(n).is_ok() { Ok(()) } else { Err(ObjError::TooLarge { file: self.path(), line }) }
    }

    /// There are faces, and they name vertices of the file, which may come after them.
    fn check_faces(&self) -> Result<(), ObjError> {
        if self.faces.is_empty() {
            return Err(ObjError::NoFaces { file: self.path() });
        }
        let n_vertices = self.n_vertices();
        for &(face, line) in &self.forward {
            if let Some(&v) = self.faces[face as usize].iter().find(|&&v| v as usize >= n_vertices) {
                let index = i64::from(v) + 1;
                return Err(ObjError::VertexOutOfRange { file: self.path(), line, index, n_vertices });
            }
        }
        Ok(())
    }

    fn whole(self, name: String) -> Surface {
        Surface::from_polygons(name, Points::from_columns(3, self.coords), self.faces)
    }

    fn groups(mut self, file_name: &str) -> Vec<Surface> {
        file_name.clone_into(&mut self.names[0]);
        let points = Points::from_columns(3, self.coords);
        let mut place = vec![None; self.names.len()];
        let mut groups: Vec<(Surface, FxHashMap<u32, u32>)> = Vec::new();
        let ends = self.runs.iter().skip(1).map(|run| run.0 as usize).chain([self.faces.len()]);
        let runs = self.runs.iter().zip(ends).map(|(&(first, group), end)| (first as usize..end, group));
        for (face, group) in runs.flat_map(|(faces, group)| faces.map(move |face| (face, group))) {
            let face = &self.faces[face];
            let at = *place[group as usize].get_or_insert_with(|| {
                groups
                    .push((Surface::new(&*self.names[group as usize], Points::new(3)), FxHashMap::default()));
                groups.len() - 1
            });
            let (surface, new_from_old) = &mut groups[at];
            let mut local = Vec::with_capacity(face.len());
            for &v in face {
                let next =
                    u32::try_from(new_from_old.len()).expect("a group has no more vertices than the file");
                let new = *new_from_old.entry(v).or_insert(next);
                if new == next {
                    surface.points.push(points.point(v as usize));
                }
                local.push(new);
            }
            surface.push_face([&local[..]], 1);
        }
        groups.into_iter().map(|(surface, _)| surface).collect()
    }
}

/// A vertex in its line; what follows the coordinates are numbers.
fn point(scan: &mut Scan<'_>, digits: &mut Digits) -> Option<[f64; 3]> {
    scan.keyword("v")?;
    let point = scan.numbers(digits)?;
    if scan.end_line().is_none() {
        while scan.skip_number().is_some() {}
        scan.end_line()?;
    }
    Some(point)
}

/// The vertex index of a corner v, v/vt, v//vn or v/vt/vn; the others must be whole numbers where they stand, and
/// exporters write a slash with none behind it.
fn corner(word: &str) -> Option<i64> {
    if let Ok(vertex) = word.parse() {
        return Some(vertex);
    }
    let mut parts = word.splitn(3, '/');
    let vertex = parts.next()?.parse().ok()?;
    let number = |part: &str| part.is_empty() || part.parse::<i64>().is_ok();
    parts.all(number).then_some(vertex)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    fn faces(surface: &Surface) -> Vec<Vec<u32>> {
        (0..surface.n_faces()).flat_map(|f| surface.face(f).map(<[u32]>::to_vec)).collect()
    }

    #[track_caller]
    fn check(lines: &str, expected: &[&[u32]]) {
        let text = format!("{SQUARE}{lines}");
        let surfaces = parse_obj(&text, "dir/a.obj", ObjGrouping::Whole).unwrap();
        assert_eq!((surfaces.len(), surfaces[0].name.as_str()), (1, "a"));
        assert_eq!(faces(&surfaces[0]), expected);
        assert_eq!(surfaces[0].validate(), []);
        let windows = parse_obj(&text.replace('\n', "\r\n"), "dir/a.obj", ObjGrouping::Whole).unwrap();
        assert_eq!(windows, surfaces);
    }

    #[test]
    fn forms_of_faces() {
        check("f 1 2 3 4", &[&[0, 1, 2, 3]]);
        check("f 1/ 2/ 3/\nf 1// 2// 4/7/", &[&[0, 1, 2], &[0, 1, 3]]);
        check(
            "f 1/1 2/2 3/3\nf 1//7 3//7 4//7\nf 1/1/1 2/-2/-2 4/4/4",
            &[&[0, 1, 2], &[0, 2, 3], &[0, 1, 3]],
        );
        check("f -4 -3 -2\nv 9 9 9 1.0\nf -1 -2 -3", &[&[0, 1, 2], &[4, 3, 2]]);
        check("# f 9 9 9\nf 1 2 3 # f 4 4 4\n\n  \t\nf\t2 3\t4  ", &[&[0, 1, 2], &[1, 2, 3]]);
        check("f 1 2 \\\n 3 \\\n4\nf 1 2 4", &[&[0, 1, 2, 3], &[0, 1, 3]]);
        check("f 1 5 2\nv 0 0 1", &[&[0, 4, 1]]);
        check("mtllib a.mtl\nvt 0 0\nvn 0 0 1\ns off\nusemtl m\nl 1 2\nf 1 2 3", &[&[0, 1, 2]]);
        check("f 1 2 3\\", &[&[0, 1, 2]]);
    }

    #[test]
    fn numbers() {
        let text = "v -1.5e-3 +2 .5 0.1 0.2 0.3\nv 3. 0 0\nv 0 1 0\nf 1 2 3";
        let surface = &parse_obj(text, "a.obj", ObjGrouping::Whole).unwrap()[0];
        assert_eq!(surface.points.coords(), [-0.0015, 2., 0.5, 3., 0., 0., 0., 1., 0.]);
    }

    #[test]
    fn groups_become_surfaces() {
        let text = format!(
            "{SQUARE}f 1 2 3\ng left\nf 1 3 4\no right  wing\nf 4 3 2\ng left\nf 2 3 4\ng\nf 1 2 4\n"
        );
        let surfaces = parse_obj(&text, "a.obj", ObjGrouping::Groups).unwrap();
        let found: Vec<_> = surfaces.iter().map(|s| (s.name.as_str(), s.points.len(), faces(s))).collect();
        let expected = [
            ("a", 3, vec![vec![0, 1, 2]]),
            ("left", 4, vec![vec![0, 1, 2], vec![3, 1, 2]]),
            ("right wing", 3, vec![vec![0, 1, 2]]),
            ("default", 3, vec![vec![0, 1, 2]]),
        ];
        assert_eq!(found, expected);
        assert_eq!(surfaces[1].points.point(3), [1., 0., 0.]);
        assert_eq!(parse_obj(&text, "a.obj", ObjGrouping::Whole).unwrap()[0].n_faces(), 5);
    }

    #[track_caller]
    fn check_error(lines: &str, expected: &str) {
        let text = format!("{SQUARE}{lines}");
        for grouping in [ObjGrouping::Whole, ObjGrouping::Groups] {
            assert_eq!(parse_obj(&text, "a.obj", grouping).unwrap_err().to_string(), expected);
        }
    }

    #[test]
    fn errors_name_file_line_and_value() {
        check_error("", "a.obj: no faces");
        check_error("f 1 2 3\nv 1 2", "a.obj:6: a vertex of 2 coordinates where 3 are needed");
        check_error("f 1 2 9", "a.obj:5: vertex 9 of 4");
        check_error("f 1 2 -5", "a.obj:5: vertex -5 of 4");
        check_error("f 1 0 2", "a.obj:5: vertex 0 of 4");
        check_error("f 1 2 4294967297", "a.obj:5: vertex 4294967297 of 4");
        check_error("f 1 2 -9223372036854775808", "a.obj:5: vertex -9223372036854775808 of 4");
        check_error("f 1 2 99999999999999999999", "a.obj:5: \"99999999999999999999\" is no corner of a face");
        check_error("v 0 nan 0", "a.obj:5: coordinate nan is not finite");
        check_error("v 0 0 -inf", "a.obj:5: coordinate -inf is not finite");
        check_error("v 0 0 1e999", "a.obj:5: coordinate 1e999 is not finite");
        check_error("v 0 zero 0", "a.obj:5: \"zero\" is no number");
        check_error("f 1 2", "a.obj:5: a face of 2 vertices where 3 are needed");
        check_error("f", "a.obj:5: a face of 0 vertices where 3 are needed");
        for corner in ["x", "1/x", "1/x/1", "1//x", "1/1/1/1", "1///", "1.5", "/1"] {
            check_error(&format!("f 1 2 {corner}"), &format!("a.obj:5: {corner:?} is no corner of a face"));
        }
        check_error("# a\n\nf 1 2 \\\n3 \\\n x", "a.obj:7: \"x\" is no corner of a face");
    }

    #[test]
    fn files_that_cannot_be_read() {
        let dir = tempfile::tempdir().unwrap();
        let missing = read_obj(dir.path().join("none.obj"), ObjGrouping::Whole).unwrap_err().to_string();
        assert!(missing.starts_with("cannot read") && missing.contains("none.obj"), "{missing}");
        let path = dir.path().join("latin.obj");
        std::fs::write(&path, b"\xff\xfev\0 \0").unwrap();
        let wide = read_obj(&path, ObjGrouping::Whole).unwrap_err().to_string();
        assert_eq!(wide, format!("{}:1: not UTF-8 text", path.display()));
        std::fs::write(&path, b"v 0 0 0\nv 0 \xfc 0\n").unwrap();
        let latin = read_obj(&path, ObjGrouping::Whole).unwrap_err().to_string();
        assert_eq!(latin, format!("{}:2: \"\u{fffd}\" is no number", path.display()));
        std::fs::write(&path, b"").unwrap();
        let empty = read_obj(&path, ObjGrouping::Whole).unwrap_err().to_string();
        assert_eq!(empty, format!("{}: no faces", path.display()));
    }

    /// Names in Latin-1, and the mark that some editors put before UTF-8.
    #[test]
    fn encodings_of_names() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("latin.obj");
        let lines = b"v 0 0 0\nv 1 0 0\n# gr\xfcn\nv 0 1 0\nusemtl gr\xfcn\ng gr\xfcn\nf 1 2 3\n";
        for mark in [&b""[..], b"\xef\xbb\xbf"] {
            std::fs::write(&path, [mark, lines].concat()).unwrap();
            let surfaces = read_obj(&path, ObjGrouping::Groups).unwrap();
            assert_eq!((surfaces[0].name.as_str(), surfaces[0].points.len()), ("gr\u{fffd}n", 3));
        }
    }

    proptest! {
        #[test]
        fn no_text_panics(text in "([vfgo#\\\\/0-9. \n\r-]|1 ){0,200}") {
            let _ = parse_obj(&text, "a.obj", ObjGrouping::Whole);
            let _ = parse_obj(&text, "a.obj", ObjGrouping::Groups);
        }
    }
}
