//! Writing PLY: coordinates as `double`, so that they read back exactly.

use crate::files::format::MeshFormat;
use crate::files::polygons::{PolygonMesh, polygons, write_line, write_point};
use crate::files::text::TextWriter;
use crate::measure::xyz;
use std::io::{self, Write};

pub(crate) fn write(mesh: &impl PolygonMesh, format: MeshFormat, out: &mut dyn Write) -> io::Result<()> {
    let longest = polygons(mesh).map(<[u32]>::len).max().unwrap_or(0);
    write_header(mesh, format, longest > usize::from(u8::MAX), out)?;
    let mut points = (0..mesh.points().len()).map(|v| xyz(mesh.points(), v));
    match format {
        MeshFormat::PlyText => {
            let mut out = TextWriter::new(out);
            points.try_for_each(|point| write_point(&mut out, point))?;
            polygons(mesh).try_for_each(|polygon| write_line(&mut out, polygon))?;
            out.finish()
        }
        MeshFormat::PlyBigEndian => {
            points.try_for_each(|point| out.write_all(point.map(f64::to_be_bytes).as_flattened()))?;
            polygons(mesh).try_for_each(|polygon| write_polygon(polygon, u32::to_be_bytes, longest, out))
        }
        _ => {
            points.try_for_each(|point| out.write_all(point.map(f64::to_le_bytes).as_flattened()))?;
            polygons(mesh).try_for_each(|polygon| write_polygon(polygon, u32::to_le_bytes, longest, out))
        }
    }
}

fn write_header(
    mesh: &impl PolygonMesh,
    format: MeshFormat,
    long: bool,
    out: &mut dyn Write,
) -> io::Result<()> {
    let encoding = match format {
        MeshFormat::PlyLittleEndian => "binary_little_endian",
        MeshFormat::PlyBigEndian => "binary_big_endian",
        _ => "ascii",
    };
    let length = if long { "uint" } else { "uchar" };
    let (vertices, faces) = (mesh.points().len(), mesh.n_faces());
    write!(
        out,
        "ply\nformat {encoding} 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\n\
         property double z\nelement face {faces}\nproperty list {length} uint vertex_indices\nend_header\n"
    )
}

fn write_polygon(
    polygon: &[u32],
    bytes: fn(u32) -> [u8; 4],
    longest: usize,
    out: &mut dyn Write,
) -> io::Result<()> {
    match u8::try_from(longest) {
        Ok(_) => out.write_all(&[polygon.len() as u8])?,
        Err(_) => out.write_all(&bytes(polygon.len() as u32))?,
    }
    polygon.iter().try_for_each(|&v| out.write_all(&bytes(v)))
}
