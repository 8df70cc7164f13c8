//! The header of a PLY file.

use crate::files::error::{MeshFileError, Problem};
use crate::files::format::MeshFormat;
use crate::files::source::{At, Source, clip};

/// Number types of PLY.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn of_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes in binary.
    pub(super) fn size(self) -> u64 {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// One number, or a list led by its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Type),
    List { length: Type, item: Type },
}

/// What becomes of a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Skip,
    Coordinate(usize),
    Indices,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<(Kind, Use)>,
}

impl Element {
    /// Bytes that `count` items take at least; in text each number takes a digit and a separator, but for the
    /// end of the file.
    pub(super) fn least_len(&self, format: MeshFormat) -> u64 {
        if format == MeshFormat::PlyText {
            return self.count.saturating_mul(2 * self.properties.len() as u64).saturating_sub(1);
        }
        let size = |&(kind, _): &(Kind, Use)| match kind {
            Kind::Scalar(number) | Kind::List { length: number, .. } => number.size(),
        };
        self.count.saturating_mul(self.properties.iter().map(size).sum())
    }

    /// The coarsest number type of a coordinate, when all three are there.
    pub(super) fn coordinate_type(&self) -> Option<Type> {
        let types = [0, 1, 2].map(|k| {
            self.properties.iter().find_map(|&(kind, used)| match kind {
                Kind::Scalar(number) if used == Use::Coordinate(k) => Some(number),
                _ => None,
            })
        });
        let [Some(x), Some(y), Some(z)] = types else { return None };
        [x, y, z].into_iter().find(|&number| number == Type::F32).or(Some(x))
    }

    fn has(&self, wanted: Use) -> bool {
        self.properties.iter().any(|&(_, used)| used == wanted)
    }
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) format: MeshFormat,
    pub(super) elements: Vec<Element>,
    pub(super) n_vertices: u64,
    pub(super) coordinates: Type,
}

pub(super) fn read_header(source: &mut Source<'_>) -> Result<Header, MeshFileError> {
    let (at, magic) = source.needed_line("ply")?;
    if magic.trim_end() != "ply" {
        return Err(at.expected("ply", magic));
    }
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let (at, line) = source.needed_line("end_header")?;
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("comment" | "obj_info") => {}
            Some("format") => format = Some(encoding(at, words.next(), words.next())?),
            Some("element") => elements.push(element(at, words, &elements)?),
            Some("property") => {
                let element =
                    elements.last_mut().ok_or_else(|| at.expected("an element first", "property"))?;
                let property = property(at, words, &element.name)?;
                if property.1 != Use::Skip && element.has(property.1) {
                    return Err(
                        at.error(Problem::Unsupported { what: "a property twice", found: clip(line) })
                    );
                }
                element.properties.push(property);
            }
            Some("end_header") => return complete(at, format, elements),
            word => return Err(at.expected("a header line", word.unwrap_or(""))),
        }
    }
}

fn complete(at: At<'_>, format: Option<MeshFormat>, elements: Vec<Element>) -> Result<Header, MeshFileError> {
    let format = format.ok_or_else(|| at.expected("format", "end_header"))?;
    let vertex = elements.iter().find(|e| e.name == "vertex");
    let coordinates = vertex
        .and_then(Element::coordinate_type)
        .ok_or_else(|| at.expected("an element vertex with x, y, z", "end_header"))?;
    if !elements.iter().any(|e| e.name == "face" && e.has(Use::Indices)) {
        return Err(at.expected("an element face with vertex_indices", "end_header"));
    }
    let n_vertices = vertex.map_or(0, |e| e.count);
    Ok(Header { format, elements, n_vertices, coordinates })
}

fn encoding(at: At<'_>, name: Option<&str>, version: Option<&str>) -> Result<MeshFormat, MeshFileError> {
    if version != Some("1.0") {
        let found = clip(version.unwrap_or(""));
        return Err(at.error(Problem::Unsupported { what: "a version other than 1.0", found }));
    }
    match name {
        Some("ascii") => Ok(MeshFormat::PlyText),
        Some("binary_little_endian") => Ok(MeshFormat::PlyLittleEndian),
        Some("binary_big_endian") => Ok(MeshFormat::PlyBigEndian),
        name => Err(at.expected("ascii, binary_little_endian or binary_big_endian", name.unwrap_or(""))),
    }
}

fn element<'w>(
    at: At<'_>,
    mut words: impl Iterator<Item = &'w str>,
    before: &[Element],
) -> Result<Element, MeshFileError> {
    let name = words.next().ok_or_else(|| at.expected("the name of an element", ""))?.to_owned();
    let count = at.count(words.next(), "the number of items")?;
    if matches!(name.as_str(), "vertex" | "face") && before.iter().any(|e| e.name == name) {
        return Err(at.error(Problem::Unsupported { what: "an element twice", found: name }));
    }
    Ok(Element { name, count, properties: Vec::new() })
}

fn property<'w>(
    at: At<'_>,
    mut words: impl Iterator<Item = &'w str>,
    element: &str,
) -> Result<(Kind, Use), MeshFileError> {
    let number = |word: Option<&str>| {
        let word = word.unwrap_or("");
        Type::of_name(word).ok_or_else(|| at.expected("a number type", word))
    };
    let first = words.next();
    let kind = if first == Some("list") {
        let (length, item) = (number(words.next())?, number(words.next())?);
        if !length.is_integer() {
            return Err(at.expected("an integer type for the length of a list", &format!("{length:?}")));
        }
        Kind::List { length, item }
    } else {
        Kind::Scalar(number(first)?)
    };
    let name = words.next().ok_or_else(|| at.expected("the name of a property", ""))?;
    let used = match (element, name, kind) {
        ("vertex", "x", Kind::Scalar(_)) => Use::Coordinate(0),
        ("vertex", "y", Kind::Scalar(_)) => Use::Coordinate(1),
        ("vertex", "z", Kind::Scalar(_)) => Use::Coordinate(2),
        ("face", "vertex_indices" | "vertex_index", Kind::List { item, .. }) if item.is_integer() => {
            Use::Indices
        }
        _ => Use::Skip,
    };
    Ok((kind, used))
}
