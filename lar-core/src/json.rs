//! Chain complexes as JSON.
//!
//! ```text
//! {"format": "lar-chain-complex", "version": 1, "dim": 2, "space": 2,
//!  "points": [[0.0, 0.0], …],
//!  "boundaries": [{"rows": 4, "columns": [[[0, -1], [1, 1]], …]}, …]}
//! ```
//!
//! `space` is the number of coordinates of a point; `boundaries[p − 1]` is ∂p, each column the list of its
//! entries [row, sign] in rising order of rows. Numbers are written in the shortest form that reads back as
//! the same `f64`, and one complex always gives the same bytes.
//!
//! Version 2 has the exact positions of the points as well, as [`ExactPoints`]:
//!
//! ```text
//!  "exact": {"step": 9.094947017729282e-13, "origin": [0.0, 0.0, 0.0], "points": [["X", "Y", "Z", "W"], …]}
//! ```

use crate::atomic_write::{FileError, atomic_write, read};
use crate::complex::sign_columns;
use crate::listing::first_few;
use crate::{ChainComplex, Operator, Points, VertexId, Violation};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

const FORMAT: &str = "lar-chain-complex";
const VERSION: u64 = 1;
/// With exact points.
const EXACT_VERSION: u64 = 2;

/// Rational points on a grid: point i is origin + step · (X, Y, Z) / W for `points[i]` = [X, Y, Z, W].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExactPoints {
    /// Distance of neighbouring grid points, a power of two.
    pub step: f64,
    /// The grid point with the coordinates 0.
    pub origin: [f64; 3],
    /// Homogeneous coordinates X, Y, Z, W of each point, integers in decimal digits of any length; W is positive.
    pub points: Vec<[String; 4]>,
}

/// Why a text is no chain complex, or a complex cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum JsonError {
    /// The text is not JSON of the expected form.
    #[error("not a chain complex in JSON: {0}")]
    Syntax(#[from] serde_json::Error),
    /// `format` names something else.
    #[error("format is {found:?}, not \"lar-chain-complex\"")]
    Format {
        /// The format found.
        found: String,
    },
    /// The version is not one that can be read.
    #[error("version {found} cannot be read, only versions 1 and 2")]
    Version {
        /// The version found.
        found: u64,
    },
    /// `dim` is not the number of boundary operators.
    #[error("dim is {dim}, but there are {boundaries} boundary operators")]
    Dimension {
        /// The dimension stated.
        dim: usize,
        /// The number of operators.
        boundaries: usize,
    },
    /// A point has not `space` coordinates.
    #[error("point {vertex} has {found} coordinates, not {expected}")]
    PointSize {
        /// The point.
        vertex: VertexId,
        /// The coordinates stated.
        expected: usize,
        /// The coordinates found.
        found: usize,
    },
    /// An operator states another number of rows than there are cells one dimension below.
    #[error("∂{p} has {found} rows, but there are {expected} {}-cells", .p - 1)]
    Rows {
        /// Which operator.
        p: usize,
        /// The number of (p−1)-cells.
        expected: usize,
        /// The rows stated.
        found: usize,
    },
    /// A column names a row that does not exist.
    #[error("column {column} of ∂{p} names row {row} of {rows}")]
    RowOutOfRange {
        /// Which operator.
        p: usize,
        /// The column.
        column: usize,
        /// The row named.
        row: u32,
        /// The number of rows.
        rows: usize,
    },
    /// A column does not name its rows in rising order, or names one twice.
    #[error("column {column} of ∂{p} names row {row} after row {previous}; rows rise")]
    RowOrder {
        /// Which operator.
        p: usize,
        /// The column.
        column: usize,
        /// The row named.
        row: u32,
        /// The row named before it.
        previous: u32,
    },
    /// The complex breaks laws; all violations are listed.
    #[error("not a chain complex: {}", first_few(.0))]
    Invalid(Vec<Violation>),
    /// The matrices would have more entries or columns than `u32` can number.
    #[error("∂{p} has 2^32 entries or more")]
    TooLarge {
        /// Which operator.
        p: usize,
    },
    /// The exact points are not as many as the points.
    #[error("{found} exact points for {expected} points")]
    ExactCount {
        /// The number of points.
        expected: usize,
        /// The exact ones.
        found: usize,
    },
    /// An exact point is no homogeneous point of integers.
    #[error("exact point {vertex}: {found:?} where {} is needed", if *.denominator { "a positive integer" } else { "an integer" })]
    Exact {
        /// The point.
        vertex: VertexId,
        /// What is found instead.
        found: String,
        /// Whether it is the denominator.
        denominator: bool,
    },
    /// Version 2 is version 1 with exact points.
    #[error("exact points belong to version 2, and to no other; this is version {found}")]
    ExactVersion {
        /// The version found.
        found: u64,
    },
    /// The file could not be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// What is wrong with the text of a file.
    #[error("{}: {source}", .path.display())]
    In {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: Box<JsonError>,
    },
}

#[derive(Deserialize)]
struct Header {
    format: String,
    version: u64,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: String,
    version: u64,
    dim: usize,
    space: usize,
    points: Vec<Vec<f64>>,
    boundaries: Vec<Boundary>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    exact: Option<ExactPoints>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Boundary {
    rows: usize,
    columns: Vec<Vec<(u32, i8)>>,
}

impl ChainComplex {
    /// The complex as JSON, one line. Stored zeros are left out. O(size).
    ///
    /// # Errors
    /// When the complex breaks a law of [`validate`](Self::validate): it could not be read back.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    /// let json = cube.to_json()?;
    /// assert_eq!(ChainComplex::from_json(&json)?, cube);
    /// # Ok::<(), lar_core::JsonError>(())
    /// ```
    pub fn to_json(&self) -> Result<String, JsonError> {
        self.written(None)
    }

    /// The complex as JSON of version 2, with the exact positions of its points. O(size).
    ///
    /// # Errors
    /// As [`to_json`](Self::to_json), and when the exact points are not as many as the points or no such points.
    ///
    /// ```
    /// use lar_core::{ChainComplex, ExactPoints, cuboid_grid};
    /// let segment = ChainComplex::from_model(&cuboid_grid(&[1]).embedded(3)?)?;
    /// let third = ["1", "0", "0", "3"].map(String::from);
    /// let exact = ExactPoints { step: 1.0, origin: [0.0; 3], points: vec![third.clone(), third] };
    /// let json = segment.to_json_exact(exact.clone())?;
    /// assert_eq!(ChainComplex::from_json_exact(&json)?, (segment, Some(exact)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_json_exact(&self, exact: ExactPoints) -> Result<String, JsonError> {
        check_exact(&exact, self.points().len())?;
        self.written(Some(exact))
    }

    fn written(&self, exact: Option<ExactPoints>) -> Result<String, JsonError> {
        let violations = self.validate();
        if !violations.is_empty() {
            return Err(JsonError::Invalid(violations));
        }
        let file = File {
            format: FORMAT.to_owned(),
            version: if exact.is_some() { EXACT_VERSION } else { VERSION },
            dim: self.dim(),
            space: self.points().dim(),
            points: self.points().iter().map(<[f64]>::to_vec).collect(),
            boundaries: (1..=self.dim()).map(|p| columns(self.boundary(p))).collect(),
            exact,
        };
        Ok(serde_json::to_string(&file)?)
    }

    /// A complex from its JSON. Memory stays in proportion to the text. O(size · log).
    ///
    /// # Errors
    /// When the text is malformed, of another format or version, or the complex breaks a law of
    /// [`validate`](Self::validate).
    pub fn from_json(text: &str) -> Result<Self, JsonError> {
        Ok(parse(text.as_bytes())?.0)
    }

    /// A complex from its JSON, and the exact positions of its points when it has them (version 2). O(size · log).
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json).
    pub fn from_json_exact(text: &str) -> Result<(Self, Option<ExactPoints>), JsonError> {
        parse(text.as_bytes())
    }

    /// Writes the complex as JSON to a file, whole or not at all. O(size).
    ///
    /// # Errors
    /// As [`to_json`](Self::to_json), and when the file cannot be written.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<(), JsonError> {
        write(path.as_ref(), &self.to_json()?)
    }

    /// Writes the complex with exact positions as JSON of version 2 to a file, whole or not at all. O(size).
    ///
    /// # Errors
    /// As [`to_json_exact`](Self::to_json_exact), and when the file cannot be written.
    pub fn write_json_exact(&self, path: impl AsRef<Path>, exact: ExactPoints) -> Result<(), JsonError> {
        write(path.as_ref(), &self.to_json_exact(exact)?)
    }

    /// Reads a complex from a JSON file. O(size).
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json), naming the file, and when it cannot be read.
    pub fn read_json(path: impl AsRef<Path>) -> Result<Self, JsonError> {
        let path = path.as_ref();
        parse(&read(path)?)
            .map(|(complex, _)| complex)
            .map_err(|source| JsonError::In { path: path.to_owned(), source: Box::new(source) })
    }
}

fn write(path: &Path, text: &str) -> Result<(), JsonError> {
    atomic_write(path, |file| {
        file.write_all(text.as_bytes())?;
        file.write_all(b"\n")
    })?;
    Ok(())
}

fn parse(text: &[u8]) -> Result<(ChainComplex, Option<ExactPoints>), JsonError> {
    let Header { format, version } = serde_json::from_slice(text)?;
    if format != FORMAT {
        return Err(JsonError::Format { found: format });
    }
    if ![VERSION, EXACT_VERSION].contains(&version) {
        return Err(JsonError::Version { found: version });
    }
    let mut file: File = serde_json::from_slice(text)?;
    let exact = file.exact.take();
    if exact.is_some() != (version == EXACT_VERSION) {
        return Err(JsonError::ExactVersion { found: version });
    }
    exact.as_ref().map_or(Ok(()), |exact| check_exact(exact, file.points.len()))?;
    let complex = from_file(file)?;
    let violations = complex.validate();
    if violations.is_empty() { Ok((complex, exact)) } else { Err(JsonError::Invalid(violations)) }
}

fn check_exact(exact: &ExactPoints, n_points: usize) -> Result<(), JsonError> {
    if exact.points.len() != n_points {
        return Err(JsonError::ExactCount { expected: n_points, found: exact.points.len() });
    }
    let is_number = |digits: &str| !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    for (point, vertex) in exact.points.iter().zip(0..) {
        for (text, denominator) in point.iter().zip([false, false, false, true]) {
            let digits = if denominator { text } else { text.strip_prefix('-').unwrap_or(text) };
            if !is_number(digits) || (denominator && digits.bytes().all(|b| b == b'0')) {
                let (vertex, found) = (VertexId(vertex), text.clone());
                return Err(JsonError::Exact { vertex, found, denominator });
            }
        }
    }
    Ok(())
}

fn columns(operator: &Operator) -> Boundary {
    let column = |column: sprs::CsVecViewI<'_, i8, u32>| {
        let entries = column.indices().iter().copied().zip(column.data().iter().copied());
        entries.filter(|entry| entry.1 != 0).collect()
    };
    Boundary { rows: operator.rows(), columns: operator.outer_iterator().map(column).collect() }
}

fn from_file(file: File) -> Result<ChainComplex, JsonError> {
    let boundaries = file.boundaries.len();
    if file.dim != boundaries {
        return Err(JsonError::Dimension { dim: file.dim, boundaries });
    }
    let mut coords = Vec::new();
    for (vertex, point) in (0..).map(VertexId).zip(&file.points) {
        if point.len() != file.space {
            return Err(JsonError::PointSize { vertex, expected: file.space, found: point.len() });
        }
        coords.extend_from_slice(point);
    }
    let mut n_below = file.points.len();
    let mut operators = Vec::with_capacity(boundaries);
    for (p, boundary) in (1..).zip(file.boundaries) {
        if boundary.rows != n_below {
            return Err(JsonError::Rows { p, expected: n_below, found: boundary.rows });
        }
        check_columns(p, &boundary)?;
        n_below = boundary.columns.len();
        operators.push(sign_columns(boundary.rows, boundary.columns.into_iter()));
    }
    Ok(ChainComplex::new(Points::from_columns(file.space, coords), operators))
}

fn check_columns(p: usize, boundary: &Boundary) -> Result<(), JsonError> {
    let entries: usize = boundary.columns.iter().map(Vec::len).sum();
    if u32::try_from(entries.max(boundary.columns.len()).max(boundary.rows)).is_err() {
        return Err(JsonError::TooLarge { p });
    }
    for (column, entries) in boundary.columns.iter().enumerate() {
        let rows = boundary.rows;
        if let Some(&(row, _)) = entries.iter().find(|e| e.0 as usize >= rows) {
            return Err(JsonError::RowOutOfRange { p, column, row, rows });
        }
        if let Some(pair) = entries.windows(2).find(|w| w[1].0 <= w[0].0) {
            return Err(JsonError::RowOrder { p, column, row: pair[1].0, previous: pair[0].0 });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cuboid_grid, r};
    use proptest::prelude::*;

    fn square() -> String {
        ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap().to_json().unwrap()
    }

    #[test]
    fn text_of_a_square() {
        insta::assert_snapshot!(square());
    }

    #[track_caller]
    fn check(from: &str, to: &str, message: &str) {
        let text = square();
        assert!(text.contains(from), "{from}");
        let found = ChainComplex::from_json(&text.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(found.contains(message), "{found}");
    }

    #[test]
    fn refusals() {
        check("lar-chain-complex", "obj", "format is \"obj\", not \"lar-chain-complex\"");
        check("\"version\":1", "\"version\":3", "version 3 cannot be read, only versions 1 and 2");
        check("\"version\":1", "\"version\":2", "exact points belong to version 2");
        check("\"version\":1,", "", "missing field `version`");
        check("\"dim\":2", "\"dim\":3", "dim is 3, but there are 2 boundary operators");
        check("\"space\":2", "\"space\":3", "point v0 has 2 coordinates, not 3");
        check("[0.0,1.0]", "[0.0]", "point v1 has 1 coordinates, not 2");
        check("\"rows\":4", "\"rows\":4000000000", "∂1 has 4000000000 rows, but there are 4 0-cells");
        check("[1,1]]", "[9,1]]", "column 0 of ∂1 names row 9 of 4");
        check("[1,1]]", "[0,1]]", "column 0 of ∂1 names row 0 after row 0; rows rise");
        check("[1,1]]", "[1,7]]", "entry (1, 0) of ∂1 is 7; entries are -1, 0 or 1");
        check("[1,1]]", "[1,-1]]", "edge e0 has entries -1 at v0, -1 at v1");
        check("[1,1]]", "[1,300]]", "invalid value: integer `300`");
        check("0.0", "1e999", "number out of range");
        check("0.0", "NaN", "expected value");
        check("\"dim\"", "\"size\":1,\"dim\"", "unknown field `size`");
        check("]}]}", "", "EOF");
    }

    #[test]
    fn exact_points() {
        let segment = ChainComplex::from_model(&cuboid_grid(&[1])).unwrap();
        let point = |x: &str, w: &str| [x, "-12345678901234567890123", "0", w].map(String::from);
        let of = |points| ExactPoints { step: 0.5, origin: [1.0, -2.0, 1e300], points };
        let exact = of(vec![point("-7", "3"), point("0", "1")]);
        let json = segment.to_json_exact(exact.clone()).unwrap();
        assert!(json.contains("\"version\":2"));
        assert_eq!(ChainComplex::from_json(&json).unwrap(), segment);
        assert_eq!(ChainComplex::from_json_exact(&json).unwrap(), (segment.clone(), Some(exact)));
        let plain = segment.to_json().unwrap();
        assert_eq!(ChainComplex::from_json_exact(&plain).unwrap(), (segment.clone(), None));
        let refused = |points| segment.to_json_exact(of(points)).unwrap_err().to_string();
        assert_eq!(refused(vec![point("1", "1")]), "1 exact points for 2 points");
        for (x, w, message) in [
            ("1.5", "1", "exact point v1: \"1.5\" where an integer is needed"),
            ("-", "1", "exact point v1: \"-\" where an integer is needed"),
            ("1", "00", "exact point v1: \"00\" where a positive integer is needed"),
            ("1", "-1", "exact point v1: \"-1\" where a positive integer is needed"),
        ] {
            assert_eq!(refused(vec![point("1", "1"), point(x, w)]), message);
        }
        let older = json.replace("\"version\":2", "\"version\":1");
        let message = ChainComplex::from_json(&older).unwrap_err().to_string();
        assert_eq!(message, "exact points belong to version 2, and to no other; this is version 1");
    }

    #[test]
    fn broken_complexes_are_not_written() {
        let mut points = Points::new(1);
        points.push(&[f64::NAN]);
        let error = ChainComplex::new(points, Vec::new()).to_json().unwrap_err();
        assert_eq!(error.to_string(), "not a chain complex: coordinate 0 of vertex v0 is NaN");
    }

    #[test]
    fn files() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("cube.json");
        let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
        cube.write_json(&path).unwrap();
        assert_eq!(ChainComplex::read_json(&path).unwrap(), cube);
        let missing = ChainComplex::read_json(dir.path().join("none.json")).unwrap_err().to_string();
        assert!(missing.starts_with("cannot read ") && missing.contains("none.json"), "{missing}");
        for bytes in [&b"{"[..], b"", b"\"\xff\"", b"{\"format\": \"\xc3\x28\"}", b"\xff"] {
            std::fs::write(&path, bytes).unwrap();
            let refused = ChainComplex::read_json(&path).unwrap_err().to_string();
            assert!(refused.contains("cube.json: not a chain complex in JSON"), "{refused}");
        }
    }

    proptest! {
        #[test]
        fn round_trip(
            shape in prop::collection::vec(0..4_usize, 1..4),
            bits in prop::collection::vec(any::<u64>(), 64 * 3),
        ) {
            let grid = ChainComplex::from_model(&cuboid_grid(&shape)).unwrap();
            let coords = (0..grid.points().coords().len()).map(|i| f64::from_bits(bits[i % bits.len()]));
            let coords = coords.map(|x| if x.is_finite() { x } else { -0. }).collect();
            let boundaries = (1..=grid.dim()).map(|p| grid.boundary(p).clone()).collect();
            let complex = ChainComplex::new(Points::from_columns(shape.len(), coords), boundaries);
            let text = complex.to_json().unwrap();
            let back = ChainComplex::from_json(&text).unwrap();
            let bits = |c: &ChainComplex| c.points().coords().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(&back), bits(&complex));
            prop_assert_eq!(back.to_json().unwrap(), text);
        }

        #[test]
        fn no_text_panics(text in "[\\[\\]{}:,\"a-z0-9.-]{0,60}") {
            prop_assert!(ChainComplex::from_json(&text).is_err());
        }

        #[test]
        fn rotated_cubes_keep_their_bits(v in prop::array::uniform3(-3.0..3.0_f64)) {
            let cube = cuboid_grid(&[1, 1, 1]).transformed(&r(v)).unwrap();
            let complex = ChainComplex::from_model(&cube).unwrap();
            prop_assert_eq!(ChainComplex::from_json(&complex.to_json().unwrap()).unwrap(), complex);
        }
    }
}
