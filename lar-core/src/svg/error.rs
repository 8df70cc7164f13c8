//! Why an SVG file cannot be read or written.

use crate::{FileError, Violation};
use std::path::PathBuf;

/// Why an SVG file cannot be read or written. Errors in the text name the file and the line, counted from 1.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SvgError {
    /// The file could not be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not UTF-8.
    #[error("{}:{line}: not UTF-8 text", .file.display())]
    NotUtf8 {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
    },
    /// The text is no XML.
    #[error("{}:{line}: {message}", .file.display())]
    Xml {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// What the XML parser says.
        message: String,
    },
    /// The document is not an SVG drawing.
    #[error("{}: the outermost element is {found:?}, not \"svg\"", .file.display())]
    NotSvg {
        /// The file.
        file: PathBuf,
        /// The outermost element.
        found: String,
    },
    /// An attribute does not hold what it should.
    #[error("{}:{line}: attribute {attribute} of {element}: {found:?} where {expected} is needed", .file.display())]
    Attribute {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The element.
        element: String,
        /// The attribute.
        attribute: String,
        /// Its value.
        found: String,
        /// What it should hold.
        expected: &'static str,
    },
    /// A part of SVG that is not read and cannot be passed over.
    #[error("{}:{line}: {what} is not supported: {found:?}", .file.display())]
    Unsupported {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// What it is.
        what: &'static str,
        /// What stands there.
        found: String,
    },
    /// A transformed point is infinite or not a number.
    #[error("{}:{line}: {element} has a point at ({x}, {y})", .file.display())]
    NonFinite {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The element.
        element: String,
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
    },
    /// Curves need more points, or `use` elements more copies, than a file of this size is allowed.
    #[error("{}:{line}: more than {limit} {what} at a tolerance of {tolerance}", .file.display())]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// The line at which the limit is passed.
        line: usize,
        /// What is counted.
        what: &'static str,
        /// The limit.
        limit: usize,
        /// The tolerance of flattening.
        tolerance: f64,
    },
    /// The tolerance of flattening must be positive and finite.
    #[error("a tolerance of {value} where a positive number is needed")]
    Tolerance {
        /// The value given.
        value: f64,
    },
    /// Only complexes in the plane are drawn.
    #[error("a complex of dimension {dim} with points of {space} coordinates where 1 or 2 and 2 are needed")]
    NotPlanar {
        /// Dimension of the complex.
        dim: usize,
        /// Coordinates per point.
        space: usize,
    },
    /// The complex breaks laws.
    #[error("not a chain complex: {}", crate::listing::first_few(.0))]
    Invalid(Vec<Violation>),
}
