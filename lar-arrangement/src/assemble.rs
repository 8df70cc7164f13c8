//! Stage 5c: the arrangement put together: final numbers, positions, winding numbers.

use crate::arrangement::{Arrangement, FaceParents, SolidInfo};
use crate::dissolve::Dissolved;
use crate::fragment::FacetParent;
use crate::kernel::Vertex;
use crate::operators::{boundary_1, boundary_2, boundary_3};
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::skeleton::Skeleton;
use crate::soup::{Parent, Parents, Soup};
use crate::stats::Stats;
use crate::winding::{Walls, Windings};
use lar_core::{ChainComplex, Points, Surface};
use std::mem::take;

/// The shells of the faces, and the cells that they bound.
pub(crate) struct Shells<'a> {
    pub of_side: &'a [u32],
    pub n: u32,
    pub cell_of: &'a [u32],
    pub n_cells: u32,
}

/// Which operators the complex of an arrangement has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operators {
    All,
    /// Only ∂1: the arrangement is on the way to a surface, which has operators of its own.
    Edges,
}

/// The final numbering, positions and matrices.
pub(crate) fn assemble(
    surfaces: &[Surface],
    mut soup: Soup,
    mut skeleton: Skeleton,
    mut dissolved: Dissolved,
    shells: &Shells,
    operators: Operators,
    (mut stats, course): (Stats, &Course),
) -> Result<Arrangement, Cancelled> {
    // What follows fits into the memory of what is not needed any more.
    soup.drop_edges();
    skeleton.drop_edges();
    let n_faces = dissolved.n_faces();
    let shells_of_face = parallel::map_light(n_faces, |face| {
        let old = dissolved.old_face(face as u32);
        [0, 1].map(|side| shells.of_side[(2 * old + side) as usize])
    });
    let cells_of_face =
        parallel::map_light(n_faces, |face| shells_of_face[face].map(|shell| shells.cell_of[shell as usize]));
    let parents = FaceParents::new(&soup, &skeleton, &dissolved);
    let walls = Walls::of_faces(n_faces, |walls, face| {
        walls.push_face(cells_of_face[face], parents.crossed(face).iter().map(|p| (p.solid, soup.jump(p))));
    });
    let windings = Windings::new(shells.n_cells as usize, surfaces.len(), &walls);
    course.begin("complex", &mut stats)?;
    let vertices = match &dissolved.origins {
        Some(origins) => origins.vertices.iter().map(|&v| skeleton.vertices[v as usize]).collect(),
        None => take(&mut skeleton.vertices),
    };
    let edges = take(&mut dissolved.edges);
    let n_edges = edges.len();
    let of_faces = || boundary_2(n_edges, &dissolved.loops, &dissolved.face_loops);
    let of_cells = || boundary_3(&cells_of_face, shells.n_cells as usize);
    let of_vertices_and_faces = || {
        let facet_of_face =
            parallel::map_light(n_faces, |face| skeleton.facet(dissolved.old_face(face as u32)));
        let plane_of_face = parallel::map_light(n_faces, |face| soup.plane_class(facet_of_face[face]));
        (facet_of_face, plane_of_face, positions(&soup, &vertices))
    };
    let of_others = || parallel::join(|| boundary_1(vertices.len(), edges), of_vertices_and_faces);
    // One thread looks through ∂1, and through ∂2 at last, and makes ∂3; the others have the rest to do meanwhile.
    let (more, (boundary_1, (facet_of_face, plane_of_face, points))) = match operators {
        Operators::Edges => (Vec::new(), of_others()),
        Operators::All => {
            let (two, (three, others)) = parallel::join(of_faces, || (of_cells(), of_others()));
            (vec![two, three], others)
        }
    };
    let boundaries = std::iter::once(boundary_1).chain(more).collect();
    let complex = ChainComplex::new(points, boundaries);
    stats.grid_step = soup.grid.step();
    stats.facets = soup.n_facets() as u64;
    stats.triangulated_polygons = u64::from(soup.triangulated);
    stats.degenerate_faces = u64::from(soup.degenerate);
    stats.exact_fallbacks = soup.geometry.counters.exact();
    Ok(Arrangement {
        complex,
        loops: dissolved.loops,
        face_loops: dissolved.face_loops,
        rings: dissolved.rings,
        cells_of_face,
        shells_of_face,
        n_shells: shells.n,
        parents,
        facet_of_face,
        plane_of_face,
        windings,
        solids: surfaces
            .iter()
            .zip(soup.coefficients)
            .map(|(s, coefficients)| SolidInfo { name: s.name.clone(), coefficients })
            .collect(),
        vertices,
        bend: soup.bend,
        geometry: soup.geometry,
        grid: soup.grid,
        stats,
    })
}

impl FaceParents {
    /// Of the new faces, in terms of input faces.
    fn new(soup: &Soup, skeleton: &Skeleton, dissolved: &Dissolved) -> Self {
        let n = dissolved.n_faces();
        if dissolved.origins.is_none() && skeleton.has_single_parents() && soup.has_single_parents() {
            let parent = |face: usize| {
                let piece = &skeleton.parents[face];
                seen_from(piece, soup.only_parent(piece.facet))
            };
            let all = Parents::single(parallel::map_light(n, parent));
            return Self { all, of_first_pieces: Vec::new() };
        }
        let mut parents: Vec<Parent> = Vec::with_capacity(n);
        let (mut offsets, mut of_first_pieces) = (vec![0], Vec::with_capacity(n));
        let mut rest = dissolved.others();
        for new in 0..n as u32 {
            let begin = parents.len();
            parents.extend(of_piece(soup, skeleton, dissolved.old_face(new)));
            let end = parents.len();
            of_first_pieces.push((end - begin) as u32);
            let n = rest.iter().take_while(|piece| piece.0 == new).count();
            rest[..n].iter().for_each(|piece| parents.extend(of_piece(soup, skeleton, piece.1)));
            keep_new(&mut parents, begin, end);
            rest = &rest[n..];
            offsets.push(parents.len() as u32);
        }
        Self { all: Parents::listed(parents, offsets), of_first_pieces }
    }
}

/// Of the parents from `end` on keeps each once, in order, that is not between `begin` and `end`.
fn keep_new(parents: &mut Vec<Parent>, begin: usize, end: usize) {
    if parents.len() == end {
        return;
    }
    let mut more = parents.split_off(end);
    let mut known = parents[begin..].to_vec();
    known.sort_unstable();
    more.sort_unstable();
    more.dedup();
    more.retain(|p| known.binary_search(p).is_err());
    parents.append(&mut more);
}

/// The parents of an old face.
fn of_piece<'a>(soup: &'a Soup, skeleton: &'a Skeleton, face: u32) -> impl Iterator<Item = Parent> + 'a {
    let pieces = skeleton.face_parents(face).iter();
    pieces.flat_map(|piece| soup.parents(piece.facet).iter().map(|parent| seen_from(piece, parent)))
}

/// A parent of the facet that a face is a piece of, as one of the face.
fn seen_from(piece: &FacetParent, parent: &Parent) -> Parent {
    parent.turned(if piece.same_way { 1 } else { -1 })
}

fn positions(soup: &Soup, vertices: &[Vertex]) -> Points {
    let offset = soup.grid.offset();
    let coords = parallel::map_light(vertices.len(), |i| {
        let v = &vertices[i];
        let steps = if offset == [0; 3] { v.at } else { soup.geometry.rounded_after(v, offset) };
        steps.map(|x| soup.grid.length(x))
    });
    Points::from_columns(3, coords.into_flattened())
}
