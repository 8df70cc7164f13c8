//! Whether an arrangement is the one that the oracle finds: vertices, edges, faces, components, provenance.

use crate::oracle::{Directed, Oracle, Segment};
use lar_arrangement::planar::{Dangling, Drawing, PlanarArrangement, PlanarArranger};
use lar_core::FaceId;
use std::collections::BTreeSet;

/// A point by the bits of its coordinates.
pub(crate) type Key = [u64; 2];

pub(crate) fn key(p: &[f64]) -> Key {
    [p[0] + 0.0, p[1] + 0.0].map(f64::to_bits)
}

/// A directed edge of the oracle with rounded ends.
pub(crate) fn rounded(edge: &Directed, scale: f64) -> [Key; 2] {
    edge.map(|p| key(&p.map(|x| x.value() * scale)))
}

pub(crate) fn drawing(segments: &[Segment], scale: f64) -> Drawing {
    let scaled: Vec<[f64; 4]> = segments.iter().map(|s| s.map(|x| x as f64 * scale)).collect();
    Drawing::from_segments(&scaled)
}

pub(crate) fn arranged(drawing: &Drawing, dangling: Dangling) -> PlanarArrangement {
    PlanarArranger::new().dangling(dangling).arrange(drawing).unwrap_or_else(|e| panic!("{e}"))
}

/// The directed edges of a face, which is on their left.
pub(crate) fn directed_edges(a: &PlanarArrangement, face: FaceId) -> BTreeSet<[Key; 2]> {
    let at = |v: u32| key(a.complex().points().point(v as usize));
    let edges = |cycle: Vec<u32>| {
        (0..cycle.len()).map(|i| [at(cycle[i]), at(cycle[(i + 1) % cycle.len()])]).collect::<Vec<_>>()
    };
    a.face_vertices(face).flat_map(edges).collect()
}

fn same<T: PartialEq + std::fmt::Debug>(what: &str, found: &T, expected: &T) -> Result<(), String> {
    if found == expected { Ok(()) } else { Err(format!("{what}: {found:?} instead of {expected:?}")) }
}

/// Compares with the oracle; coordinates are those of the oracle times a power of two.
pub(crate) fn compare(a: &PlanarArrangement, oracle: &Oracle, scale: f64) -> Result<(), String> {
    let violations = a.complex().validate_with_exterior();
    same("violations", &violations.len(), &0).map_err(|e| format!("{e}: {violations:?}"))?;
    same("V − E + F − C", &a.euler(), &0)?;
    same("components", &a.n_components(), &oracle.n_components)?;
    same("loops", &a.n_loops(), &oracle.n_loops)?;
    let points = a.complex().points();
    let vertices: BTreeSet<Key> = points.iter().map(key).collect();
    same("distinct vertices", &vertices.len(), &a.n_vertices())?;
    let expected = oracle.vertices.iter().map(|p| key(&p.map(|x| x.value() * scale))).collect();
    same("vertices", &vertices, &expected)?;
    compare_edges(a, oracle, scale)?;
    compare_faces(a, oracle, scale)?;
    compare_provenance(a, oracle, scale)
}

fn undirected([p, q]: [Key; 2]) -> [Key; 2] {
    [p.min(q), p.max(q)]
}

fn edge_ends(a: &PlanarArrangement) -> Vec<[Key; 2]> {
    let at = |v: u32| key(a.complex().points().point(v as usize));
    a.complex().boundary(1).indices().chunks_exact(2).map(|e| [at(e[0]), at(e[1])]).collect()
}

fn compare_edges(a: &PlanarArrangement, oracle: &Oracle, scale: f64) -> Result<(), String> {
    let edges: BTreeSet<[Key; 2]> = edge_ends(a).into_iter().map(undirected).collect();
    same("distinct edges", &edges.len(), &a.n_edges())?;
    let expected = oracle.edges.iter().map(|e| undirected(rounded(e, scale))).collect();
    same("edges", &edges, &expected)
}

fn compare_faces(a: &PlanarArrangement, oracle: &Oracle, scale: f64) -> Result<(), String> {
    let rounded_set = |face: &BTreeSet<Directed>| -> BTreeSet<[Key; 2]> {
        face.iter().map(|e| rounded(e, scale)).collect()
    };
    // Rounded vertices are off by half a unit in the last place, times the perimeter.
    let coordinates = || oracle.vertices.iter().flatten().map(|x| x.value());
    let (low, high) = (coordinates().fold(0.0, f64::min), coordinates().fold(1.0, f64::max));
    let extent = |k: usize| {
        let along = || oracle.vertices.iter().map(|p| p[k].value());
        along().reduce(f64::max).unwrap_or(0.0) - along().reduce(f64::min).unwrap_or(0.0)
    };
    let tolerance = 100.0 * f64::EPSILON * high.max(-low) * extent(0).max(extent(1)).max(1.0);
    same("faces", &a.n_faces(), &oracle.faces.len())?;
    same("exterior", &directed_edges(a, FaceId(0)), &rounded_set(&oracle.exterior))?;
    let mut found: Vec<(BTreeSet<[Key; 2]>, f64)> = (1..=a.n_faces() as u32)
        .map(|f| (directed_edges(a, FaceId(f)), a.area(FaceId(f)) / scale / scale))
        .collect();
    let mut expected: Vec<(BTreeSet<[Key; 2]>, f64)> =
        oracle.faces.iter().map(|(edges, area)| (rounded_set(edges), *area)).collect();
    found.sort_by(|a, b| a.0.cmp(&b.0));
    expected.sort_by(|a, b| a.0.cmp(&b.0));
    for (found, expected) in found.iter().zip(&expected) {
        same("boundary of a face", &found.0, &expected.0)?;
        if (found.1 - expected.1).abs() > tolerance {
            return Err(format!("area {} instead of {}", found.1, expected.1));
        }
    }
    let sum: f64 = (0..=a.n_faces() as u32).map(|f| a.area(FaceId(f)) / scale / scale).sum();
    if sum.abs() > tolerance { Err(format!("the areas of all faces add up to {sum}")) } else { Ok(()) }
}

fn compare_provenance(a: &PlanarArrangement, oracle: &Oracle, scale: f64) -> Result<(), String> {
    let edges = edge_ends(a);
    for (segment, pieces) in oracle.pieces.iter().enumerate() {
        let found: Vec<[Key; 2]> = a
            .edges_of(segment)
            .map(|(edge, sign)| {
                let [p, q] = edges[edge.index()];
                if sign > 0 { [p, q] } else { [q, p] }
            })
            .collect();
        let expected: Vec<[Key; 2]> = pieces.iter().map(|e| rounded(e, scale)).collect();
        same(&format!("edges of segment {segment}"), &found, &expected)?;
    }
    Ok(())
}

/// Compares both treatments of dangling edges.
pub(crate) fn verdict(segments: &[Segment], scale: f64) -> Result<(), String> {
    for (dangling, keep) in [(Dangling::Keep, true), (Dangling::Drop, false)] {
        compare(&arranged(&drawing(segments, scale), dangling), &Oracle::new(segments, keep), scale)
            .map_err(|e| format!("{dangling:?}: {e}"))?;
    }
    Ok(())
}

/// Fails with a smallest part of the input that still fails.
#[track_caller]
pub(crate) fn check(segments: &[Segment], verdict: impl Fn(&[Segment]) -> Result<(), String>) {
    if verdict(segments).is_ok() {
        return;
    }
    let mut least = segments.to_vec();
    while let Some(i) = (0..least.len()).find(|&i| {
        let mut fewer = least.clone();
        fewer.remove(i);
        verdict(&fewer).is_err()
    }) {
        least.remove(i);
    }
    panic!("{least:?}\n{}", verdict(&least).expect_err("it has failed"));
}
