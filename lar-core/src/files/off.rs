//! OFF: numbers of vertices, faces and edges, then vertices and faces, one a line.
//!
//! The letters before `OFF` in the first line announce texture coordinates (ST), colours (C), normals (N) after
//! the three coordinates; they are passed over, as are the colours after the corners of a face. Points of
//! another dimension (4OFF, nOFF) and binary files are refused.
//!
//! Reference: Geomview manual, section "OFF: Object File Format".

use super::error::{MeshFileError, Problem};
use super::format::{MeshFormat, SurfaceFile};
use super::polygons::{PolygonMesh, polygons, write_line, write_point};
use super::precision::Digits;
use super::source::{At, Source, clip};
use super::text::TextWriter;
use super::words::words_of;
use crate::measure::xyz;
use crate::{Cells, Points, Surface};
use std::io::{self, Write};

/// True when a file begins like an OFF file.
pub(crate) fn is_header(head: &[u8]) -> bool {
    let first = head.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    first.ends_with(b"OFF") && first.len() <= b"STCN4nOFF".len()
}

pub(crate) fn read(source: &mut Source<'_>) -> Result<SurfaceFile, MeshFileError> {
    let [n_vertices, n_faces] = read_counts(source)?;
    let (mut coords, mut digits) = (Vec::new(), Digits::default());
    for _ in 0..n_vertices {
        let point = match source.quick(|scan| scan.coordinates(&mut digits)) {
            Some(point) => point,
            None => read_vertex(source, &mut digits)?,
        };
        source.at_line().check_size(coords.len() / 3 + 1)?;
        coords.extend(point);
    }
    let points = Points::from_columns(3, coords);
    let (mut polygons, mut polygon) = (Cells::new(), Vec::new());
    for _ in 0..n_faces {
        if source.quick(|scan| scan.polygon(points.len(), &mut polygon)).is_none() {
            let (at, line) = source.statement("a face")?;
            read_face(at, line, points.len(), &mut polygon)?;
        }
        source.at_line().check_size(polygons.indices().len() + polygon.len())?;
        polygons.push(&polygon);
    }
    if polygons.is_empty() {
        return Err(source.at_line().error(Problem::NoFaces));
    }
    let mut surface = Surface::from_polygons(source.stem(), points, polygons);
    surface.precision = digits.precision();
    Ok(SurfaceFile { surface, format: MeshFormat::Off, weld: None })
}

/// The header, whose counts may stand on its own line or the next.
fn read_counts(source: &mut Source<'_>) -> Result<[u64; 2], MeshFileError> {
    let (at, line) = source.statement("OFF")?;
    let mut words = words_of(line);
    let keyword = words.next().unwrap_or("");
    let extras = keyword.strip_suffix("OFF").ok_or_else(|| at.expected("OFF", keyword))?;
    let extras = extras.strip_prefix("ST").unwrap_or(extras);
    let extras = extras.strip_prefix('C').unwrap_or(extras);
    let extras = extras.strip_prefix('N').unwrap_or(extras);
    if !extras.is_empty() {
        return Err(at.error(Problem::Unsupported { what: "this kind of OFF", found: clip(keyword) }));
    }
    match words.next() {
        Some("BINARY") => Err(at.error(Problem::Unsupported { what: "OFF in binary", found: clip(line) })),
        Some(first) => counts(at, std::iter::once(first).chain(words)),
        None => {
            let (at, line) = source.statement("the numbers of vertices and faces")?;
            counts(at, words_of(line))
        }
    }
}

fn counts<'w>(at: At<'_>, mut words: impl Iterator<Item = &'w str>) -> Result<[u64; 2], MeshFileError> {
    Ok([at.count(words.next(), "the number of vertices")?, at.count(words.next(), "the number of faces")?])
}

fn read_vertex(source: &mut Source<'_>, digits: &mut Digits) -> Result<[f64; 3], MeshFileError> {
    let (at, line) = source.statement("a vertex")?;
    let (mut point, mut words) = ([0.; 3], words_of(line));
    for x in &mut point {
        *x = at.coordinate(&mut words, digits)?;
    }
    Ok(point)
}

fn read_face(at: At<'_>, line: &str, n_vertices: usize, polygon: &mut Vec<u32>) -> Result<(), MeshFileError> {
    let mut words = words_of(line);
    let size = at.count(words.next(), "the number of corners")?;
    if size < 3 {
        return Err(at.error(Problem::FaceSize { found: size as i64 }));
    }
    polygon.clear();
    for _ in 0..size {
        let word = words.next().unwrap_or("");
        let index = word.parse().map_err(|_| at.expected("a vertex", word))?;
        polygon.push(at.vertex(index, n_vertices)?);
    }
    Ok(())
}

pub(crate) fn write(mesh: &impl PolygonMesh, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "OFF\n{} {} 0", mesh.points().len(), mesh.n_faces())?;
    let mut out = TextWriter::new(out);
    (0..mesh.points().len()).try_for_each(|v| write_point(&mut out, xyz(mesh.points(), v)))?;
    polygons(mesh).try_for_each(|polygon| write_line(&mut out, polygon))?;
    out.finish()
}
