//! Times uploads and frames at 1280 × 720 on the adapter at hand.
//!
//! * spheres of about 1,000, 100,000 and 1,000,000 triangles, opaque and translucent, whole and seen from so near that most
//!   is beside the picture, and 100,000 labels: `frame_times [ROWS]`;
//! * complexes of cubes: what a session takes to be staged, uploaded, drawn, exploded, picked in, selected in, recoloured:
//!   `frame_times cells N` for N³ cubes.
//!
//! `cargo run --release -p lar-viewer --no-default-features --example frame_times`
#![expect(clippy::print_stdout, reason = "an example that reports")]

use lar_core::{ChainComplex, Points, TriangleMesh, cuboid_grid};
use lar_viewer::session::{Command, Session, Stage};
use lar_viewer::{CellData, CellRef, Drawable, Label, OffscreenRenderer, Scene, View, ViewerError};
use std::time::Instant;

/// Frames of one measurement.
const FRAMES: usize = 8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut renderer = OffscreenRenderer::new()?;
    println!("{}", renderer.adapter_name());
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["cells", n] => cells(&mut renderer, n.parse()?),
        [rows] => Ok(spheres(&mut renderer, Some(rows.parse()?))?),
        _ => Ok(spheres(&mut renderer, None)?),
    }
}

/// Does a step and prints what it takes: milliseconds on the clock, milliseconds of all threads, and what the process then
/// holds.
fn timed<R>(what: &str, step: impl FnOnce() -> R) -> R {
    let (start, cpu) = (Instant::now(), cpu_milliseconds());
    let result = step();
    let (milliseconds, cpu) = (1e3 * start.elapsed().as_secs_f64(), cpu_milliseconds() - cpu);
    println!("  {what:<44} {milliseconds:>8.1} ms {cpu:>6} ms CPU {:>7} MB", resident_megabytes());
    result
}

/// Time that all threads have run, in steps of ten milliseconds; 0 where the system does not tell.
fn cpu_milliseconds() -> u64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name in parentheses may hold spaces; user and system time are the fields 12 and 13 after it, in hundredths.
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    10 * fields.skip(11).take(2).filter_map(|field| field.parse::<u64>().ok()).sum::<u64>()
}

/// Memory of the process; 0 where the system does not tell.
fn resident_megabytes() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:"));
    let kilobytes = line.and_then(|l| l.trim().trim_end_matches(" kB").parse::<usize>().ok());
    kilobytes.map_or(0, |kilobytes| kilobytes / 1024)
}

/// A complex of n³ cubes, as a window shows it.
fn cells(renderer: &mut OffscreenRenderer, n: usize) -> Result<(), Box<dyn std::error::Error>> {
    println!("{} cubes", n.pow(3));
    let complex = timed("the complex", || ChainComplex::from_model(&cuboid_grid(&[n; 3])))?;
    let faces: Vec<Vec<u32>> =
        (0..complex.n_cells(2)).map(|f| complex.face_loops(f).swap_remove(0)).collect();
    let triangles = faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect();
    let offsets = (0..=faces.len() as u32).map(|f| 2 * f).collect();
    let data =
        timed("what is known of its cells", || CellData::new(complex))?.with_triangles(triangles, offsets)?;
    let mut session = Session::new(data);
    let stage = timed("the stage", || Stage::new(session.data(), session.pieces()))?;
    let scene = stage.pieces();
    let view = View::fitted(scene, [1.5; 3], 16.0 / 9.0);
    let mut prepared = timed("upload", || renderer.prepare(scene))?;
    for samples in [1, 3] {
        let mut view = View { samples, ..view };
        prepared.render(&view, 1280, 720)?;
        timed(&format!("a frame, {samples}×{samples} samples"), || prepared.render(&view, 1280, 720))?;
        view.explode = [2.0; 3].into();
        timed(&format!("a frame, exploded farther, {samples}×{samples}"), || {
            prepared.render(&view, 1280, 720)
        })?;
    }
    let pick = || prepared.pick(&view, [1280, 720], [640, 360], 5);
    timed("picking for the first time: shaders", pick)?;
    let hit = timed("picking", pick)?;
    session.apply(Command::Hide(vec![CellRef::new(3, 0)]));
    let looks = timed("looks after a cell was hidden", || stage.appearances(&session));
    timed("their upload", || prepared.set_appearances(&looks))?;
    session.apply(Command::Select(hit.and_then(|h| h.cell)));
    session.apply(Command::Select(Some(CellRef::new(2, 0))));
    timed("what stands out with a selected face", || stage.standing_out(&session))?;
    session.apply(Command::ToggleNumbers(3));
    let numbered = timed("numbers of all cells", || stage.standing_out(&session))?;
    let mut prepared = timed("upload", || renderer.prepare(&numbered))?;
    let view = View { samples: 1, ..view };
    prepared.render(&view, 1280, 720)?;
    timed("a frame, 1×1 samples", || prepared.render(&view, 1280, 720))?;
    Ok(())
}

fn spheres(renderer: &mut OffscreenRenderer, only: Option<u32>) -> Result<(), ViewerError> {
    for rows in [16, 158, 500].into_iter().filter(|rows| only.is_none_or(|n| n == *rows)) {
        for opacity in [1.0, 0.5] {
            let mesh = sphere(rows);
            let what = format!("{} triangles, opacity {opacity}", mesh.triangles.len());
            let mut scene = Scene::new();
            scene.push(Drawable::mesh("sphere", mesh).color([0.9, 0.5, 0.3]).opacity(opacity))?;
            measure(renderer, &scene, &what)?;
        }
    }
    if only.is_none() {
        let at = |i: u32| [f64::from(i % 400), 0.0, f64::from(i / 400)];
        let labels = (0..100_000).map(|i| Label::new(i.to_string(), at(i)));
        let mut scene = Scene::new();
        scene.push(Drawable::labels("labels", labels))?;
        measure(renderer, &scene, "100000 labels")?;
    }
    Ok(())
}

fn measure(renderer: &mut OffscreenRenderer, scene: &Scene, what: &str) -> Result<(), ViewerError> {
    println!("{what}");
    let mut prepared = timed("upload", || renderer.prepare(scene))?;
    let whole = View::fitted(scene, [1.0; 3], 16.0 / 9.0);
    let mut near = whole;
    near.camera.distance *= 0.25;
    for (place, view) in [("whole", whole), ("near", near)] {
        for samples in [1, 3] {
            let mut view = View { samples, ..view };
            prepared.render(&view, 1280, 720)?;
            timed(&format!("{FRAMES} frames, {place}, {samples}×{samples} samples"), || {
                (0..FRAMES).try_for_each(|_| {
                    view.camera.orientation = view.camera.orientation.orbit([5.0, 0.0]);
                    prepared.render(&view, 1280, 720).map(drop)
                })
            })?;
        }
    }
    Ok(())
}

/// A unit sphere of `rows` bands of latitude, 4 · rows · (rows − 1) triangles.
fn sphere(rows: u32) -> TriangleMesh {
    let columns = 2 * rows;
    let angle = |i: u32, n: u32| std::f64::consts::PI * f64::from(i) / f64::from(n);
    let point = |row, column| {
        let ((sin_p, cos_p), (sin_a, cos_a)) =
            (angle(row, rows).sin_cos(), angle(2 * column, columns).sin_cos());
        [sin_p * cos_a, sin_p * sin_a, cos_p]
    };
    let corners: Vec<_> = (0..=rows).flat_map(|r| (0..columns).map(move |c| point(r, c))).collect();
    let index = |row, column| row * columns + column % columns;
    let cells = (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c)));
    let triangles = cells.flat_map(|(r, c)| {
        let [a, b, d, e] = [index(r, c), index(r + 1, c), index(r + 1, c + 1), index(r, c + 1)];
        let (lower, upper) = ((r + 1 < rows).then_some([a, b, d]), (0 < r).then_some([a, d, e]));
        lower.into_iter().chain(upper)
    });
    TriangleMesh { points: Points::from_xyz(&corners), triangles: triangles.collect() }
}
