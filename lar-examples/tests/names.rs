//! The table of Julia names in docs/julia-names.md: made from the `#[doc(alias)]`s of the crates, and complete for
//! the packages it covers. `LAR_UPDATE_NAMES=1` writes it anew.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Names of the first implementation that must be found, by group.
const REQUIRED: &[(&str, &str)] = &[
    ("Types", "Points Cells Cell Chain ChainOp ChainComplex LAR LARmodel"),
    (
        "Sparse operators",
        "characteristicMatrix boundary_1 coboundary_0 coboundary_1 u_boundary_2 u_boundary_3 u_coboundary_1 \
         u_coboundary_2 chaincomplex lar2cop cop2lar build_copEV VV VE VF EV EE EF FV FE FF",
    ),
    (
        "Grids",
        "grid q qn grid_0 grid_1 larGrid larVertProd larCellProd index2addr binaryRange filterByOrder \
         larGridSkeleton larImageVerts cuboidGrid larModelProduct INSR",
    ),
    ("Simplices", "simplex extrudeSimplicial simplexGrid simplexFacets quads2triangles simplexBoundary"),
    ("Hierarchy", "t s r apply Struct box traversal evalStruct struct2lar embedStruct removeDups"),
    (
        "Mapper",
        "circle helix disk helicoid ring cylinder sphere toroidal crown cuboid ball rod hollowCyl hollowBall torus \
         pizza",
    ),
    (
        "Integration",
        "M II III surface volume firstMoment secondMoment inertiaProduct inertiaMoment centroid chainAreas",
    ),
    (
        "Graphs",
        "verts2verts depth_first_search biconnectedComponent edge_biconnect permutationOrbits faces2polygons",
    ),
    (
        "Arrangements",
        "planar_arrangement spatial_arrangement minimal_2cycles minimal_3cycles spaceindex bool2d bool3d boolops",
    ),
    ("Triangle", "pols2tria triangulate2D constrained_triangulation"),
    (
        "Viewer",
        "VIEW GLFrame GLFrame2 GLAxis GLCuboid GLHull GLHull2d GLHulls GLPolygon GLPolygons GLLar2gl GLLines GLPoints \
         GLPolyhedron GLPolyhedrons GLPol GLGrid GLExplode GLText numbering COLORS",
    ),
];

/// A public item: where it is, and what other names it has.
struct Item {
    path: String,
    name: String,
    aliases: Vec<String>,
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(folder).expect("the folder exists").map(|e| e.expect("readable").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The public items of a source file. Methods are named by their type.
fn items(krate: &str, text: &str) -> Vec<Item> {
    let mut found = Vec::new();
    let (mut aliases, mut owner) = (Vec::new(), None);
    for line in text.lines() {
        let code = line.trim_start();
        if line.starts_with("impl") {
            owner = implemented_type(line);
        } else if line == "}" {
            owner = None;
        }
        if code.starts_with("#[doc(alias") {
            aliases.extend(code.split('"').skip(1).step_by(2).map(str::to_owned));
        } else if let Some(name) = public_name(code) {
            let path = match &owner {
                Some(owner) if line.starts_with(' ') => format!("{krate}::{owner}::{name}"),
                _ => format!("{krate}::{name}"),
            };
            found.push(Item { path, name: name.to_owned(), aliases: std::mem::take(&mut aliases) });
        }
    }
    found
}

/// `impl<T> Type<T> {` → `Type`; also for `impl Trait for Type {`.
fn implemented_type(line: &str) -> Option<String> {
    let named = line.split_once(" for ").map_or(line, |(_, after)| after);
    let word =
        named.trim_start_matches("impl").split_whitespace().find(|w| w.starts_with(char::is_uppercase))?;
    Some(word.chars().take_while(|c| c.is_alphanumeric()).collect())
}

/// The name that a line makes public.
fn public_name(code: &str) -> Option<&str> {
    let rest = code.strip_prefix("pub ")?;
    let rest = rest.strip_prefix("const fn ").or_else(|| {
        ["fn ", "struct ", "enum ", "trait ", "type ", "const ", "mod "]
            .iter()
            .find_map(|k| rest.strip_prefix(k))
    })?;
    Some(rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().expect("split yields something"))
}

fn snake(name: &str) -> String {
    let mut out = String::new();
    for (i, c) in name.chars().enumerate() {
        if c.is_uppercase() && i > 0 && !out.ends_with('_') {
            out.push('_');
        }
        out.extend(c.to_lowercase());
    }
    out
}

#[test]
fn every_julia_name_leads_somewhere() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let mut by_name: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for krate in ["lar-core", "lar-arrangement", "lar-triangle", "lar-viewer"] {
        let mut files = Vec::new();
        sources(&root.join(krate).join("src"), &mut files);
        for file in files {
            let text = std::fs::read_to_string(&file).expect("sources are UTF-8");
            for item in items(&krate.replace('-', "_"), &text) {
                for name in item.aliases.iter().chain([&item.name]) {
                    by_name.entry(name.clone()).or_default().push(item.path.clone());
                }
            }
        }
    }
    let primitives = root.join("lar-examples/src/primitives.rs");
    let text = std::fs::read_to_string(&primitives).expect("sources are UTF-8");
    for item in items("lar_examples::primitives", &text) {
        for name in item.aliases {
            by_name.entry(name).or_default().push(item.path.clone());
        }
    }
    let mut table = String::from(
        "# Julia names and their Rust counterparts\n\nThe functions of the first implementation (packages \
         LinearAlgebraicRepresentation, Triangle and ViewerGL) and where they are here. The names are also found by the search \
         field of the API documentation. This file is made by `lar-examples/tests/names.rs`.\n",
    );
    let mut missing = Vec::new();
    for (group, names) in REQUIRED {
        write!(table, "\n## {group}\n\n| Julia | Rust |\n|---|---|\n").expect("strings take everything");
        for name in names.split_whitespace() {
            let aliased = by_name.get(name).or_else(|| by_name.get(&snake(name)));
            match aliased {
                Some(paths) => {
                    let mut paths: Vec<String> = paths.iter().map(|p| format!("`{p}`")).collect();
                    paths.sort();
                    paths.dedup();
                    writeln!(table, "| `{name}` | {} |", paths.join(", ")).expect("strings take everything");
                }
                None => missing.push(name),
            }
        }
    }
    assert!(missing.is_empty(), "no item has the name or alias: {missing:?}");
    let path = root.join("docs/julia-names.md");
    if std::env::var_os("LAR_UPDATE_NAMES").is_some() {
        std::fs::write(&path, &table).expect("docs can be written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == table, "docs/julia-names.md is out of date: run the test with LAR_UPDATE_NAMES=1");
}
