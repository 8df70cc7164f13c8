//! The surface of a solid as polygons and as triangles, its numbers and its file.

use super::input::is_json;
use super::report::{Rounding, Threads, counted};
use crate::CommandError;
use lar_arrangement::{Evaluator, Solid, SolidComplex};
use lar_core::{FaceId, MeshFormat, TriangleMesh, write_mesh};
use lar_triangle::Triangulation;
use serde::Serialize;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

/// A result in both forms, and how long it took to make them.
pub(crate) struct Surfaces {
    polygons: SolidComplex,
    triangulation: Triangulation,
    triangles: TriangleMesh,
    /// Until there were polygons: of all cells the choice, and their surface.
    pub boolean: Duration,
    pub triangulate: Duration,
}

impl Surfaces {
    /// The surface of a solid that was being chosen since `before`.
    pub(crate) fn new(
        solid: &Solid<'_>,
        evaluator: &Evaluator<'_>,
        before: Instant,
        threads: Threads,
    ) -> Result<Self, CommandError> {
        let polygons =
            evaluator.surface(solid).map_err(|source| CommandError::Boolean { file: None, source })?;
        Self::of(polygons, before.elapsed(), threads)
    }

    /// Polygons that took so long to find.
    pub(crate) fn of(
        polygons: SolidComplex,
        boolean: Duration,
        threads: Threads,
    ) -> Result<Self, CommandError> {
        let before = Instant::now();
        let triangulation = threads.triangulate(&polygons.complex)?;
        let faces = (0..).map(|f| (FaceId(f), 1)).take(polygons.n_faces());
        let triangles = triangulation.mesh_of_faces(polygons.complex.points(), faces)?;
        Ok(Self { polygons, triangulation, triangles, boolean, triangulate: before.elapsed() })
    }

    /// What rounding did to it. `volumes` are those of its bounded cells.
    pub(crate) fn rounding(&self, volumes: impl Iterator<Item = f64>) -> Rounding {
        let normal = |face| self.polygons.normal(face);
        let defects = self.triangulation.defects(self.polygons.complex.points(), normal);
        Rounding::new(&self.triangulation, defects, volumes)
    }

    /// Polygons as a chain complex when the name ends in `.json`, else triangles in the format of the extension, OBJ
    /// when it names none.
    pub(crate) fn write(&self, path: &Path) -> Result<(), CommandError> {
        if is_json(path) {
            self.polygons.complex.write_json(path)?;
        } else if MeshFormat::of_path(path).is_some() {
            write_mesh(path, &self.triangles)?;
        } else {
            self.triangles.write_obj(path)?;
        }
        Ok(())
    }
}

/// The numbers of a surface. The counts are those of its polygons, but for `triangles`.
#[derive(Debug, Serialize)]
pub(crate) struct SurfaceCounts {
    vertices: usize,
    edges: usize,
    faces: usize,
    triangles: usize,
    components: usize,
    loops: usize,
    /// `null` when the result is unbounded.
    volume: Option<f64>,
    area: f64,
    /// Each edge is used as often in one direction as in the other.
    closed: bool,
    bounded: bool,
    /// V − E + Σ over faces of (2 − loops).
    euler: i64,
}

impl SurfaceCounts {
    /// With its volume, when it has one, and its area.
    pub(crate) fn new(surfaces: &Surfaces, volume: Option<f64>, area: f64) -> Self {
        let polygons = &surfaces.polygons;
        Self {
            vertices: polygons.complex.n_cells(0),
            edges: polygons.complex.n_cells(1),
            faces: polygons.n_faces(),
            triangles: surfaces.triangles.triangles.len(),
            components: polygons.n_components(),
            loops: polygons.n_loops(),
            volume,
            area,
            closed: polygons.is_closed() && surfaces.triangles.is_closed(),
            bounded: volume.is_some(),
            euler: polygons.euler(),
        }
    }

    /// Those of a surface without cells.
    pub(crate) fn alone(surfaces: &Surfaces, is_bounded: bool) -> Self {
        let polygons = &surfaces.polygons;
        Self::new(surfaces, is_bounded.then(|| polygons.volume()), polygons.area())
    }

    /// Two lines, the first after `what` and a colon.
    pub(crate) fn print(&self, what: &str, out: &mut dyn Write) -> Result<(), CommandError> {
        let counts = [
            counted(self.vertices, "vertex"),
            counted(self.edges, "edge"),
            counted(self.faces, "face"),
            counted(self.triangles, "triangle"),
            counted(self.components, "component"),
        ];
        writeln!(out, "{what}: {}", counts.join(", "))?;
        let volume = self.volume.map_or("unbounded".to_owned(), |v| format!("volume {v}"));
        let closed = if self.closed { "closed" } else { "NOT CLOSED" };
        writeln!(out, "{volume}, area {}, {closed}, Euler characteristic {}", self.area, self.euler)?;
        Ok(())
    }
}

/// The numbers of a result made of cells.
#[derive(Debug, Serialize)]
pub(crate) struct Counts {
    #[serde(flatten)]
    surface: SurfaceCounts,
    /// The cells of the arrangement that make up the result.
    cells: Vec<u32>,
    rounding: Rounding,
}

impl Counts {
    /// `volumes` are those of the arrangement's cells.
    pub(crate) fn new(volumes: &[f64], solid: &Solid<'_>, surfaces: &Surfaces) -> Self {
        let bounded = solid.cells().iter().filter(|cell| cell.0 != 0);
        let volume = solid.is_bounded().then(|| solid.volume());
        Self {
            surface: SurfaceCounts::new(surfaces, volume, solid.area()),
            cells: solid.cells().iter().map(|c| c.0).collect(),
            rounding: surfaces.rounding(bounded.map(|cell| volumes[cell.index()])),
        }
    }

    /// Two lines, the first after `what` and a colon, and one about rounding when it did anything.
    pub(crate) fn print(&self, what: &str, out: &mut dyn Write) -> Result<(), CommandError> {
        self.surface.print(what, out)?;
        self.rounding.line().map_or(Ok(()), |line| Ok(writeln!(out, "{line}")?))
    }
}
