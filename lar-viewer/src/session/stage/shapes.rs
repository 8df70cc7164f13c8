//! Cells as drawables.

use crate::{CellData, CellRef, Drawable, INK};
use lar_core::{Points, TriangleMesh};

/// The triangles of faces of a unit, turned outwards.
pub(super) fn fill(data: &CellData, unit: CellRef, faces: &[u32]) -> Drawable {
    let (mut triangles, mut cells) = (Vec::new(), Vec::new());
    for &face in faces {
        let own = data.triangles(face);
        triangles.extend_from_slice(own);
        cells.extend(own.iter().map(|_| CellRef { dim: 2, index: face }));
    }
    let mut used = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let corners: Vec<[f64; 3]> = used.iter().filter_map(|&v| data.position(v)).collect();
    for v in triangles.as_flattened_mut() {
        *v = used.partition_point(|u| u < v) as u32;
    }
    let mesh = TriangleMesh { points: Points::from_xyz(&corners), triangles };
    Drawable::mesh(unit.to_string(), mesh).element_cells(cells)
}

pub(super) fn lines(data: &CellData, edges: &[u32]) -> Drawable {
    let ends = |&e: &u32| Some((e, data.segment(e)?));
    let (cells, segments): (Vec<u32>, Vec<_>) = edges.iter().filter_map(ends).unzip();
    let cells = cells.into_iter().map(|index| CellRef { dim: 1, index });
    Drawable::edges("edges", segments).element_cells(cells)
}

/// An edge that stands out, however short it is.
pub(super) fn stroke(data: &CellData, edge: u32) -> Drawable {
    let cell = data.segment(edge).map(|_| CellRef { dim: 1, index: edge });
    Drawable::lines("edge", data.segment(edge)).element_cells(cell)
}

pub(super) fn dots(data: &CellData, vertices: &[u32]) -> Drawable {
    let points = vertices.iter().filter_map(|&v| data.position(v));
    Drawable::points("vertices", points)
        .color(INK)
        .element_cells(vertices.iter().map(|&index| CellRef { dim: 0, index }))
}
