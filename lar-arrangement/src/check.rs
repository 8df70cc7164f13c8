//! Post-conditions of the stages, as functions that a test (or `Checks::EveryStage`) runs after each.

use crate::arrangement::Arrangement;
use crate::kernel::{Geometry, Sign, Support, Vertex};
use crate::skeleton::Skeleton;
use crate::soup::Soup;
use crate::split::Cuts;
use lar_core::FaceId;

/// A post-condition that does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failure {
    pub stage: &'static str,
    pub what: String,
}

fn fail(stage: &'static str, what: String) -> Result<(), Failure> {
    Err(Failure { stage, what })
}

/// Stage 2c: the points inside each edge lie on the planes of both its facets and strictly rise along it.
pub(crate) fn cuts(soup: &Soup, cuts: &Cuts, vertices: &[Vertex]) -> Result<(), Failure> {
    let stage = "contacts";
    for facet in 0..soup.n_facets() as u32 {
        let on_plane =
            |v: u32| soup.geometry.side(&vertices[v as usize], Support::Facet(facet)) == Sign::Zero;
        for &edge in &soup.facet_edges[facet as usize] {
            if let Some(v) = cuts.inner.of(edge / 2).iter().find(|&&v| !on_plane(v)) {
                return fail(
                    stage,
                    format!("vertex {v} of edge {} is off the plane of facet {facet}", edge / 2),
                );
            }
        }
        for s in cuts.segments(facet) {
            if let Some(v) = s.ends.iter().find(|&&v| !on_plane(v)) {
                return fail(stage, format!("the end {v} of a segment is off the plane of facet {facet}"));
            }
            if s.ends[0] == s.ends[1] {
                return fail(
                    stage,
                    format!("facet {facet} has a segment of no length at vertex {}", s.ends[0]),
                );
            }
        }
    }
    for &edge in cuts.inner.keys() {
        let ([a, b], inner) = (soup.edges[edge as usize], cuts.inner.of(edge));
        let chain: Vec<u32> = [a].into_iter().chain(inner.iter().copied()).chain([b]).collect();
        let turns: Vec<_> = chain
            .windows(2)
            .map(|w| {
                (0..3)
                    .map(|k| {
                        soup.geometry.cmp_coordinate(&vertices[w[0] as usize], &vertices[w[1] as usize], k)
                    })
                    .collect::<Vec<_>>()
            })
            .collect();
        if turns.iter().any(|t| *t != turns[0] || t.iter().all(|o| o.is_eq())) {
            return fail(stage, format!("the points {chain:?} do not rise along their edge"));
        }
    }
    Ok(())
}

/// Stage 3: vertices are distinct, loops closed (so ∂1∂2 = 0), faces lie in their planes, no face is there twice.
pub(crate) fn skeleton(skeleton: &Skeleton, geometry: &Geometry) -> Result<(), Failure> {
    let stage = "congruence";
    let mut order: Vec<u32> = (0..skeleton.vertices.len() as u32).collect();
    let key = |v: &u32| skeleton.vertices[*v as usize].at.map(|x| (x + 0.0).to_bits());
    order.sort_by_key(key);
    for same in order.chunk_by(|a, b| key(a) == key(b)) {
        // Vertices of equal rounded position are few.
        for (i, &a) in same.iter().enumerate() {
            for &b in &same[i + 1..] {
                if geometry.coincide(&skeleton.vertices[a as usize], &skeleton.vertices[b as usize]) {
                    return fail(stage, format!("vertices {a} and {b} are one point"));
                }
            }
        }
    }
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for face in 0..skeleton.n_faces() as u32 {
        let support = Support::Facet(skeleton.facet(face));
        for l in skeleton.face_loops[face as usize]..skeleton.face_loops[face as usize + 1] {
            let cycle = &skeleton.loops[l as usize];
            for (i, &h) in cycle.iter().enumerate() {
                let next = cycle[(i + 1) % cycle.len()];
                if skeleton.ends(h)[1] != skeleton.ends(next)[0] {
                    return fail(stage, format!("loop {l} of face {face} is broken after half-edge {h}"));
                }
                let tail = skeleton.ends(h)[0];
                if geometry.side(&skeleton.vertices[tail as usize], support) != Sign::Zero {
                    return fail(stage, format!("vertex {tail} is off the plane of face {face}"));
                }
            }
        }
        let mut edges: Vec<u32> = skeleton.half_edges(face).map(|h| h / 2).collect();
        edges.sort_unstable();
        faces.push(edges);
    }
    faces.sort_unstable();
    match faces.windows(2).find(|w| w[0] == w[1]) {
        Some(w) => fail(stage, format!("two faces have the edges {:?}", w[0])),
        None => Ok(()),
    }
}

/// Stage 4: every shell is a cycle: at each edge its sides cancel.
pub(crate) fn shells(skeleton: &Skeleton, shell_of_side: &[u32]) -> Result<(), Failure> {
    let mut uses: Vec<(u32, u32, i32)> = Vec::new();
    for face in 0..skeleton.n_faces() as u32 {
        for h in skeleton.half_edges(face) {
            let sign = if h % 2 == 0 { 1 } else { -1 };
            uses.push((shell_of_side[2 * face as usize], h / 2, sign));
            uses.push((shell_of_side[2 * face as usize + 1], h / 2, -sign));
        }
    }
    uses.sort_unstable();
    for same in uses.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if same.iter().map(|u| u.2).sum::<i32>() != 0 {
            return fail("gift wrapping", format!("shell {} is open at edge {}", same[0].0, same[0].1));
        }
    }
    Ok(())
}

/// Stage 5: the laws of the chain complex, Euler's relation, positive volumes of bounded cells.
pub(crate) fn arrangement(a: &Arrangement) -> Result<(), Failure> {
    let stage = "complex";
    if let Some(violation) = a.complex.validate().first() {
        return fail(stage, violation.to_string());
    }
    if a.euler() != 0 {
        return fail(stage, format!("Euler's relation gives {}", a.euler()));
    }
    if let Some(face) = (0..a.n_faces() as u32).map(FaceId).find(|&f| a.parents(f).is_empty()) {
        return fail(stage, format!("face {face} has no parent"));
    }
    let volumes = a.volumes();
    for (cell, (&volume, slack)) in volumes.iter().zip(volume_slack(a)).enumerate().skip(1) {
        if volume < -slack {
            return fail(stage, format!("cell {cell} has volume {volume:e}"));
        }
    }
    Ok(())
}

/// By how much rounding may change the volume of each cell.
///
/// Faces are moved by less than a grid step, and those put together again from triangles bend by some more,
/// which sweeps their surface and a strip along their border times that. The surface is measured as a fan, because
/// the vector area of a face that folds is too small.
/// The volume is then evaluated as a sum over corners of (difference × difference) · difference, six roundings of
/// 2^-53 each: differences in a face are below its perimeter, those between faces below the model's diameter.
fn volume_slack(a: &Arrangement) -> Vec<f64> {
    let points = a.complex.points();
    let diameter = points.bounds().map_or(0.0, |(lo, hi)| distance(&lo, &hi));
    let step = a.stats.grid_step;
    let mut slack = vec![0.0; a.n_cells()];
    for (face, cells) in (0..).map(FaceId).zip(&a.cells_of_face) {
        let (mut perimeter, mut corners) = (0.0, 0.0);
        for cycle in a.face_vertices(face) {
            for (i, &v) in cycle.iter().enumerate() {
                let w = cycle[(i + 1) % cycle.len()];
                perimeter += distance(points.point(v as usize), points.point(w as usize));
                corners += 1.0;
            }
        }
        let moved = (a.fan_area(face) + perimeter * step) * (4.0 + a.bend) * step;
        let evaluated = corners * perimeter * perimeter * diameter * 2f64.powi(-50);
        cells.iter().for_each(|&c| slack[c as usize] += moved + evaluated);
    }
    slack
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}
