//! Reading STL.

use super::{FACET, HEADER};
use crate::files::error::{MeshFileError, Problem};
use crate::files::format::{MeshFormat, SurfaceFile};
use crate::files::precision::{Digits, Precision};
use crate::files::scan::Scan;
use crate::files::source::{At, MARK, Source};
use crate::files::weld::{Bits, Corners, Weld};
use crate::files::words::{Words, words_of};
use crate::{Cells, Surface};

/// The number of facets that a binary header announces; `None` when the file is too short to have one.
pub(crate) fn announced(head: &[u8]) -> Option<u64> {
    let count = head.get(HEADER..HEADER + 4)?;
    Some(u32::from_le_bytes([count[0], count[1], count[2], count[3]]).into())
}

/// Length in bytes of a binary file of `n` facets.
pub(crate) fn binary_len(n: u64) -> u64 {
    (HEADER + 4) as u64 + n * FACET as u64
}

/// Text or binary: binary when the length fits the number announced or the beginning is no text.
pub(crate) fn form(head: &[u8], len: u64) -> MeshFormat {
    let fits = announced(head).is_some_and(|n| binary_len(n) == len);
    let head = head.strip_prefix(MARK).unwrap_or(head);
    if !fits && head.trim_ascii_start().starts_with(b"solid") && !head.contains(&0) {
        MeshFormat::StlText
    } else {
        MeshFormat::StlBinary
    }
}

/// Some exporters write several solids one behind the other, each with a header; they make one surface.
pub(crate) fn read_binary(source: &mut Source<'_>) -> Result<SurfaceFile, MeshFileError> {
    let mut facets = Facets::<f32>::new();
    while facets.corners.len() == 0 || source.rest() > 0 {
        let announced = header(source)?;
        // The length of the file has vouched for them.
        facets.corners.make_room(source, 3 * announced as usize)?;
        source.records(announced.into(), "a facet of 50 bytes", |at, facet: &[u8; FACET]| {
            facets.push(at, corners(at, facet)?)
        })?;
        if announced == 0 {
            break;
        }
    }
    facets.finish(source, MeshFormat::StlBinary, Precision::F32)
}

/// The number of facets of the next solid. They fill the file, or leave room for one more header at least.
fn header(source: &mut Source<'_>) -> Result<u32, MeshFileError> {
    let begin = source.len() - source.rest();
    source.bytes::<HEADER>("an STL header of 84 bytes")?;
    let at = source.at_byte();
    let announced = u32::from_le_bytes(source.bytes("an STL header of 84 bytes")?);
    let (needed, found) = (begin + binary_len(announced.into()), source.len());
    let another = announced > 0 && needed.saturating_add(binary_len(1)) <= found;
    if needed == found || another {
        return Ok(announced);
    }
    Err(at.error(Problem::Length { what: "facets", announced: announced.into(), needed, found }))
}

/// The corners of a facet, behind its normal.
fn corners(at: At<'_>, facet: &[u8; FACET]) -> Result<[[f32; 3]; 3], MeshFileError> {
    let (coordinates, _) = facet[12..].as_chunks();
    // Minus zero is where zero is.
    let corners = [0, 3, 6].map(|c| [c, c + 1, c + 2].map(|i| f32::from_le_bytes(coordinates[i]) + 0.));
    match corners.as_flattened().iter().find(|x| !x.is_finite()) {
        None => Ok(corners),
        Some(x) => Err(at.error(Problem::NonFinite { value: x.to_string() })),
    }
}

/// Words in any arrangement on lines; keywords in either case; normals are read and forgotten. Several solids
/// in one file make one surface.
pub(crate) fn read_text(source: &mut Source<'_>) -> Result<SurfaceFile, MeshFileError> {
    let mut text = TextReader { state: State::Outside, corners: Vec::new(), digits: Digits::default() };
    let mut facets = Facets::<f64>::new();
    loop {
        while text.state == State::Solid && facets.has_room() {
            let Some(corners) = source.quick(|scan| facet(scan, &mut text.digits)) else { break };
            facets.push(source.at_line(), corners)?;
        }
        let Some((at, line)) = source.line()? else { break };
        text.line(at, line, &mut facets)?;
    }
    if text.state != State::Outside {
        return Err(source.at_line().error(Problem::Ends { expected: text.state.expected() }));
    }
    let precision = text.digits.precision();
    facets.finish(source, MeshFormat::StlText, precision)
}

/// A facet in seven lines.
fn facet(scan: &mut Scan<'_>, digits: &mut Digits) -> Option<[[f64; 3]; 3]> {
    scan.keyword("facet")?;
    scan.keyword("normal")?;
    for _ in 0..3 {
        scan.skip_number()?;
    }
    scan.end_line()?;
    scan.keyword("outer")?;
    scan.keyword("loop")?;
    scan.end_line()?;
    let mut corners = [[0.; 3]; 3];
    for corner in &mut corners {
        scan.keyword("vertex")?;
        *corner = scan.coordinates(digits)?;
    }
    for keyword in ["endloop", "endfacet"] {
        scan.keyword(keyword)?;
        scan.end_line()?;
    }
    Some(corners)
}

/// What has been opened and not closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Outside,
    Solid,
    Facet,
    Loop,
    LoopDone,
}

impl State {
    fn expected(self) -> &'static str {
        match self {
            Self::Outside => "solid",
            Self::Solid => "facet or endsolid",
            Self::Facet => "outer loop",
            Self::Loop => "vertex or endloop",
            Self::LoopDone => "endfacet",
        }
    }
}

struct TextReader {
    state: State,
    corners: Vec<[f64; 3]>,
    digits: Digits,
}

impl TextReader {
    fn line(&mut self, at: At<'_>, line: &str, facets: &mut Facets<f64>) -> Result<(), MeshFileError> {
        let mut words = words_of(line);
        while let Some(word) = words.next() {
            let is = |keyword| word.eq_ignore_ascii_case(keyword);
            match self.state {
                // The name, all that follows, is free.
                State::Outside if is("solid") => return self.enter(State::Solid),
                State::Solid if is("endsolid") => return self.enter(State::Outside),
                State::Solid if is("facet") => {
                    keep(at, words.next(), "normal")?;
                    for _ in 0..3 {
                        number(at, &mut words)?;
                    }
                    self.state = State::Facet;
                }
                State::Facet if is("outer") => {
                    keep(at, words.next(), "loop")?;
                    self.state = State::Loop;
                }
                State::Loop if is("vertex") => self.vertex(at, &mut words)?,
                State::Loop if is("endloop") => self.close(at, facets)?,
                State::LoopDone if is("endfacet") => self.state = State::Solid,
                _ => return Err(at.expected(self.state.expected(), word)),
            }
        }
        Ok(())
    }

    fn enter(&mut self, state: State) -> Result<(), MeshFileError> {
        self.state = state;
        Ok(())
    }

    fn vertex(&mut self, at: At<'_>, words: &mut Words<'_>) -> Result<(), MeshFileError> {
        let mut corner = [0.; 3];
        for x in &mut corner {
            *x = at.coordinate(words, &mut self.digits)?;
        }
        self.corners.push(corner);
        Ok(())
    }

    fn close(&mut self, at: At<'_>, facets: &mut Facets<f64>) -> Result<(), MeshFileError> {
        let found = i64::try_from(self.corners.len()).unwrap_or(i64::MAX);
        let corners: [[f64; 3]; 3] =
            self.corners[..].try_into().map_err(|_| at.error(Problem::FaceSize { found }))?;
        self.corners.clear();
        self.state = State::LoopDone;
        facets.push(at, corners)
    }
}

fn keep(at: At<'_>, word: Option<&str>, expected: &'static str) -> Result<(), MeshFileError> {
    match word {
        Some(word) if word.eq_ignore_ascii_case(expected) => Ok(()),
        word => Err(at.expected(expected, word.unwrap_or(""))),
    }
}

/// A part of a normal; NaN is what exporters write for facets without area.
fn number(at: At<'_>, words: &mut Words<'_>) -> Result<(), MeshFileError> {
    if words.decimal().is_some() {
        return Ok(());
    }
    let word = words.next().unwrap_or("");
    word.parse::<f64>().map(|_| ()).map_err(|_| at.expected("a number", word))
}

struct Facets<T> {
    corners: Corners<T, 3>,
}

impl<T: Bits> Facets<T> {
    fn new() -> Self {
        Self { corners: Corners::new() }
    }

    /// Whether one more facet fits.
    fn has_room(&self) -> bool {
        self.corners.len() + 3 < u32::MAX as usize
    }

    fn push(&mut self, at: At<'_>, corners: [[T; 3]; 3]) -> Result<(), MeshFileError> {
        at.check_size(self.corners.len() + 3)?;
        corners.into_iter().for_each(|corner| self.corners.push(corner));
        Ok(())
    }

    fn finish(
        self,
        source: &Source<'_>,
        format: MeshFormat,
        precision: Precision,
    ) -> Result<SurfaceFile, MeshFileError> {
        let corners = self.corners.len();
        let (points, mut indices) = self.corners.weld();
        keep_triangles(&mut indices);
        if indices.is_empty() {
            return Err(source.at_byte().error(Problem::NoFaces));
        }
        let weld = Weld { corners, vertices: points.len(), collapsed: (corners - indices.len()) / 3 };
        let mut surface = Surface::from_polygons(source.stem(), points, Cells::uniform(3, indices));
        surface.precision = precision;
        Ok(SurfaceFile { surface, format, weld: Some(weld) })
    }
}

/// Leaves out the facets that have not three different vertices.
fn keep_triangles(indices: &mut Vec<u32>) {
    let mut kept = 0;
    let facets = indices.as_chunks_mut::<3>().0;
    for i in 0..facets.len() {
        let [a, b, c] = facets[i];
        facets[kept] = [a, b, c];
        kept += usize::from(a != b && b != c && c != a);
    }
    indices.truncate(3 * kept);
}
