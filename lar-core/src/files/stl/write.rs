//! Writing STL. Checked before: all faces are triangles, all coordinates finite (in 32 bits for binary).

use super::{FACET, HEADER};
use crate::files::polygons::{PolygonMesh, polygons};
use crate::files::text::TextWriter;
use crate::measure::{cross, dot, sub, xyz};
use std::io::{self, Write};

/// The header does not begin with `solid`, so that no reader takes the file for a text.
pub(crate) fn write_binary(mesh: &impl PolygonMesh, out: &mut dyn Write) -> io::Result<()> {
    let mut header = [b' '; HEADER];
    let title = b"binary STL";
    header[..title.len()].copy_from_slice(title);
    out.write_all(&header)?;
    let n = u32::try_from(mesh.n_faces()).expect("checked: fewer than 2^32 faces");
    out.write_all(&n.to_le_bytes())?;
    for triangle in polygons(mesh) {
        let [a, b, c] = corners(mesh, triangle);
        let mut facet = [0; FACET];
        let vectors = [normal([a, b, c]), a, b, c];
        for (bytes, &x) in facet.as_chunks_mut().0.iter_mut().zip(vectors.as_flattened()) {
            *bytes = (x as f32).to_le_bytes();
        }
        out.write_all(&facet)?;
    }
    Ok(())
}

/// Coordinates in the shortest form that reads back as the same `f64`.
pub(crate) fn write_text(mesh: &impl PolygonMesh, out: &mut dyn Write) -> io::Result<()> {
    let mut out = TextWriter::new(out);
    out.push("solid\n");
    for triangle in polygons(mesh) {
        let corners = corners(mesh, triangle);
        write_vector(&mut out, "facet normal", normal(corners))?;
        out.push("outer loop\n");
        corners.into_iter().try_for_each(|corner| write_vector(&mut out, "vertex", corner))?;
        out.push("endloop\nendfacet\n");
    }
    out.push("endsolid\n");
    out.finish()
}

fn write_vector(out: &mut TextWriter<'_>, keyword: &str, vector: [f64; 3]) -> io::Result<()> {
    out.push(keyword);
    for x in vector {
        out.push(" ");
        out.number(x);
    }
    out.end_line()
}

fn corners(mesh: &impl PolygonMesh, triangle: &[u32]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|k| xyz(mesh.points(), triangle[k] as usize))
}

/// The unit normal; zero, which readers take as "work it out", when the triangle has no area in `f64`.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let normal = cross(sub(b, a), sub(c, a));
    let length = dot(normal, normal).sqrt();
    if length.is_normal() { normal.map(|x| x / length) } else { [0.; 3] }
}
