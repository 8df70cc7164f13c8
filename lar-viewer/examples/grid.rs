//! A grid of cubes to explore, its shape read from a file that is watched: change `2 1 1` to `3 2 2` and look.
//!
//! `cargo run --release -p lar-viewer --example grid -- SHAPE.txt`

use lar_core::{ChainComplex, cuboid_grid};
use lar_viewer::session::{Explode, Session};
use lar_viewer::{CellData, Exhibit, Exploration, NoQueries, Source, explore};
use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let Exhibit { data, queries } = Shapes.load(&files)?;
    let mut session = Session::new(data);
    session.explode = Explode::cells([1.3; 3]);
    let title = "grid".to_owned();
    Ok(explore(Exploration { session, queries, source: Box::new(Shapes), files, camera: None, title })?)
}

/// Grids from files of three numbers.
struct Shapes;

impl Source for Shapes {
    fn load(&self, files: &[PathBuf]) -> Result<Exhibit, String> {
        grid(files).map_err(|error| error.to_string())
    }
}

fn grid(files: &[PathBuf]) -> Result<Exhibit, Box<dyn Error>> {
    let text = std::fs::read_to_string(files.first().ok_or("no file with the shape of a grid")?)?;
    let shape = text.split_whitespace().map(str::parse).collect::<Result<Vec<usize>, _>>()?;
    if shape.len() != 3 || !shape.iter().all(|n| (1..=20).contains(n)) {
        return Err(format!("{:?} is not the shape of a grid", text.trim()).into());
    }
    let complex =
        ChainComplex::from_model(&cuboid_grid(&shape))?.with_exterior().map_err(|v| v.to_string())?;
    let (mut triangles, mut offsets) = (Vec::new(), vec![0]);
    for face in 0..complex.n_cells(2) {
        let corners = complex.face_loops(face).swap_remove(0);
        triangles.extend(corners[1..].windows(2).map(|w| [corners[0], w[0], w[1]]));
        offsets.push(triangles.len() as u32);
    }
    let data = CellData::new(complex)?.with_triangles(triangles, offsets)?.with_exterior();
    Ok(Exhibit { data, queries: Box::new(NoQueries) })
}
