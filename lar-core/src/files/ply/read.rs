//! Reading the elements of a PLY file.

use super::header::{Element, Header, Kind, Type, Use, read_header};
use crate::files::error::{MeshFileError, Problem};
use crate::files::format::{MeshFormat, SurfaceFile};
use crate::files::precision::{Digits, Precision};
use crate::files::source::{At, Source};
use crate::files::words::words_of;
use crate::{Cells, Points, Surface};

pub(crate) fn read(source: &mut Source<'_>) -> Result<SurfaceFile, MeshFileError> {
    let header = read_header(source)?;
    let mut items = Items::new(&header);
    for element in &header.elements {
        let (needed, found) = (element.least_len(header.format), source.rest());
        if needed > found {
            let (what, announced) = ("items of an element", element.count);
            return Err(source.at_byte().error(Problem::Length { what, announced, needed, found }));
        }
        items.make_room(source, element)?;
        // Items without properties take no bytes, however many are announced.
        let count = if element.properties.is_empty() { 0 } else { element.count };
        for _ in 0..count {
            items.read(source, element)?;
        }
    }
    if items.polygons.is_empty() {
        return Err(source.at_byte().error(Problem::NoFaces));
    }
    let precision = items.precision(header.coordinates);
    let points = Points::from_columns(3, items.coords);
    let mut surface = Surface::from_polygons(source.stem(), points, items.polygons);
    surface.precision = precision;
    Ok(SurfaceFile { surface, format: header.format, weld: None })
}

/// The items read so far.
struct Items {
    format: MeshFormat,
    n_vertices: usize,
    coords: Vec<f64>,
    polygons: Cells,
    digits: Digits,
    point: [f64; 3],
    polygon: Vec<u32>,
}

impl Items {
    fn new(header: &Header) -> Self {
        Self {
            format: header.format,
            n_vertices: usize::try_from(header.n_vertices).unwrap_or(usize::MAX),
            coords: Vec::new(),
            polygons: Cells::new(),
            digits: Digits::default(),
            point: [0.; 3],
            polygon: Vec::new(),
        }
    }

    /// Room for the vertices, whose number the length of the file has vouched for.
    fn make_room(&mut self, source: &Source<'_>, element: &Element) -> Result<(), MeshFileError> {
        match element.name.as_str() {
            "vertex" => source.make_room(&mut self.coords, self.n_vertices.saturating_mul(3)),
            _ => Ok(()),
        }
    }

    fn read(&mut self, source: &mut Source<'_>, element: &Element) -> Result<(), MeshFileError> {
        self.polygon.clear();
        let at = if self.format == MeshFormat::PlyText {
            if self.quick(source, element).is_none() {
                self.polygon.clear();
                let (at, line) = source.needed_line("an item")?;
                self.text_item(at, line, element)?;
            }
            source.at_line()
        } else {
            let at = source.at_byte();
            self.binary_item(source, element)?;
            at
        };
        match element.name.as_str() {
            "vertex" => {
                at.check_size(self.coords.len() / 3 + 1)?;
                self.coords.extend(self.point);
            }
            "face" if self.polygon.len() < 3 => {
                let found = i64::try_from(self.polygon.len()).unwrap_or(i64::MAX);
                return Err(at.error(Problem::FaceSize { found }));
            }
            "face" => {
                at.check_size(self.polygons.indices().len() + self.polygon.len())?;
                self.polygons.push(&self.polygon);
            }
            _ => {}
        }
        Ok(())
    }

    /// Reads an item that is a point first of all, or a polygon, from its line in the usual form.
    fn quick(&mut self, source: &mut Source<'_>, element: &Element) -> Option<()> {
        const POINT: [Use; 3] = [Use::Coordinate(0), Use::Coordinate(1), Use::Coordinate(2)];
        let scalar = |property: &(Kind, Use)| matches!(property.0, Kind::Scalar(_));
        match element.properties[..] {
            [x, y, z, ref others @ ..] if [x.1, y.1, z.1] == POINT && others.iter().all(scalar) => {
                self.point = source.quick(|scan| {
                    let point = scan.numbers(&mut self.digits)?;
                    others.iter().try_for_each(|_| scan.skip_number())?;
                    scan.end_line()?;
                    Some(point.map(|x| x + 0.))
                })?;
                Some(())
            }
            [(_, Use::Indices)] => source.quick(|scan| scan.polygon(self.n_vertices, &mut self.polygon)),
            _ => None,
        }
    }

    fn text_item(&mut self, at: At<'_>, line: &str, element: &Element) -> Result<(), MeshFileError> {
        let mut words = words_of(line);
        for &(kind, used) in &element.properties {
            match kind {
                Kind::Scalar(_) => match used {
                    Use::Coordinate(k) => self.point[k] = at.coordinate(&mut words, &mut self.digits)?,
                    _ if words.next().is_none() => return Err(at.expected("a number", "")),
                    _ => {}
                },
                Kind::List { .. } => {
                    for _ in 0..at.count(words.next(), "the length of a list")? {
                        let word = words.next().ok_or_else(|| at.expected("an item of a list", ""))?;
                        if used == Use::Indices {
                            let index = word.parse().map_err(|_| at.expected("a vertex", word))?;
                            self.polygon.push(at.vertex(index, self.n_vertices)?);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn binary_item(&mut self, source: &mut Source<'_>, element: &Element) -> Result<(), MeshFileError> {
        let format = self.format;
        for &(kind, used) in &element.properties {
            let at = source.at_byte();
            match kind {
                Kind::Scalar(number) => {
                    let x = scalar(source, number, format)?;
                    if let Use::Coordinate(k) = used {
                        if !x.is_finite() {
                            return Err(at.error(Problem::NonFinite { value: x.to_string() }));
                        }
                        self.point[k] = x + 0.;
                    }
                }
                Kind::List { length, item } => {
                    for _ in 0..list_length(source, length, item, format)? {
                        let at = source.at_byte();
                        let index = scalar(source, item, format)?;
                        if used == Use::Indices {
                            self.polygon.push(at.vertex(index as i64, self.n_vertices)?);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// A text can print no more than the type that it declares holds.
    fn precision(&self, declared: Type) -> Precision {
        /// Digits that tell any two 32-bit numbers apart.
        const DIGITS_OF_F32: u32 = 9;
        let single = declared == Type::F32;
        match self.digits.precision() {
            _ if self.format != MeshFormat::PlyText && single => Precision::F32,
            _ if self.format != MeshFormat::PlyText => Precision::F64,
            Precision::Decimal { significant, .. } if single && significant >= DIGITS_OF_F32 => {
                Precision::F32
            }
            Precision::F64 if single => Precision::F32,
            printed => printed,
        }
    }
}

fn list_length(
    source: &mut Source<'_>,
    length: Type,
    item: Type,
    format: MeshFormat,
) -> Result<u64, MeshFileError> {
    let at = source.at_byte();
    let announced = scalar(source, length, format)?;
    if announced < 0. {
        return Err(at.expected("the length of a list", &announced.to_string()));
    }
    let announced = announced as u64;
    let (needed, found) = (announced * item.size(), source.rest());
    if needed > found {
        return Err(at.error(Problem::Length { what: "items of a list", announced, needed, found }));
    }
    Ok(announced)
}

/// The next number; every type but `double` fits `f64` exactly, and that is one.
fn scalar(source: &mut Source<'_>, number: Type, format: MeshFormat) -> Result<f64, MeshFileError> {
    macro_rules! number {
        ($type:ty) => {{
            let bytes = source.bytes("a number")?;
            f64::from(match format {
                MeshFormat::PlyBigEndian => <$type>::from_be_bytes(bytes),
                _ => <$type>::from_le_bytes(bytes),
            })
        }};
    }
    Ok(match number {
        Type::I8 => number!(i8),
        Type::U8 => number!(u8),
        Type::I16 => number!(i16),
        Type::U16 => number!(u16),
        Type::I32 => number!(i32),
        Type::U32 => number!(u32),
        Type::F32 => number!(f32),
        Type::F64 => number!(f64),
    })
}
