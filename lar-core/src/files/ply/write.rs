//! Writing PLY: coordinates as `double`, so that they read back exactly.

use crate::files::format::MeshFormat;
use crate::files::polygons::{PolygonMesh, polygons, write_line, write_point};
use crate::measure::xyz;
use std::io::{self, Write};

pub(crate) fn write(mesh: &impl PolygonMesh, format: MeshFormat, out: &mut dyn Write) -> io::Result<()> {
    let longest = polygons(mesh).map(<[u32]>::len).max().unwrap_or(0);
    write_header(mesh, format, longest > usize::from(u8::MAX), out)?;
    for point in (0..mesh.points().len()).map(|v| xyz(mesh.points(), v)) {
        write_coordinates(point, format, out)?;
    }
    polygons(mesh).try_for_each(|polygon| write_polygon(polygon, format, longest, out))
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

fn write_coordinates(point: [f64; 3], format: MeshFormat, out: &mut dyn Write) -> io::Result<()> {
    match format {
        MeshFormat::PlyLittleEndian => point.iter().try_for_each(|x| out.write_all(&x.to_le_bytes())),
        MeshFormat::PlyBigEndian => point.iter().try_for_each(|x| out.write_all(&x.to_be_bytes())),
        _ => write_point(out, point),
    }
}

fn write_polygon(polygon: &[u32], format: MeshFormat, longest: usize, out: &mut dyn Write) -> io::Result<()> {
    if format == MeshFormat::PlyText {
        return write_line(out, polygon);
    }
    let bytes = |x: u32| match format {
        MeshFormat::PlyBigEndian => x.to_be_bytes(),
        _ => x.to_le_bytes(),
    };
    match u8::try_from(longest) {
        Ok(_) => out.write_all(&[polygon.len() as u8])?,
        Err(_) => out.write_all(&bytes(polygon.len() as u32))?,
    }
    polygon.iter().try_for_each(|&v| out.write_all(&bytes(v)))
}
