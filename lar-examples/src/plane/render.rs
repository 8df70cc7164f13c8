//! Pictures of the plane as pixels, by the off-screen renderer: seen from above, without perspective or light.

use super::picture::{Color, Frame, Picture};
use crate::CommandError;
use lar_core::{Points, TriangleMesh};
use lar_triangle::{TriangulateError, Triangulator};
use lar_viewer::{
    Camera, Drawable, Image, OffscreenRenderer, Projection, Rgb, Scene, StandardView, View, WHITE,
};
use std::collections::BTreeMap;

impl Picture {
    /// Draws the picture in `size` pixels on white.
    ///
    /// # Errors
    /// When a filled path cannot be triangulated, a coordinate is too large to be drawn, or the renderer fails.
    pub fn render(&self, renderer: &mut OffscreenRenderer, size: [u32; 2]) -> Result<Image, CommandError> {
        let (scene, view) = self.scene(size)?;
        Ok(renderer.render(&scene, &view, size[0], size[1])?)
    }

    /// The picture as a scene, and the view that fills `size` pixels with it.
    ///
    /// # Errors
    /// When a filled path cannot be triangulated or a coordinate is too large to be drawn.
    pub fn scene(&self, size: [u32; 2]) -> Result<(Scene, View), CommandError> {
        let frame = self.frame(size);
        let mut scene = Scene::new();
        self.fills(&frame)?.into_iter().try_for_each(|drawable| scene.push(drawable))?;
        self.strokes(&frame).into_iter().try_for_each(|drawable| scene.push(drawable))?;
        let view = View { camera: camera(&frame, size[1]), background: WHITE, ..View::default() };
        Ok((scene, view))
    }

    /// How much higher each path lies than the one before it: by more than the renderer raises lines above faces, so
    /// that later paths hide earlier ones. Many paths all lie in one plane; they would not tell anyway.
    fn layer_step(&self, frame: &Frame) -> f64 {
        const MOST: usize = 4096;
        let width =
            self.paths.iter().filter_map(|path| path.stroke).fold(0.0, |most: f64, s| most.max(s.width));
        if self.paths.len() <= MOST { (2.0 * width * frame.scale + 1.0) * frame.per_pixel } else { 0.0 }
    }

    /// The insides, a mesh for each colour.
    fn fills(&self, frame: &Frame) -> Result<Vec<Drawable>, TriangulateError> {
        let step = self.layer_step(frame);
        let mut triangulator = Triangulator::new();
        let mut meshes: BTreeMap<Color, TriangleMesh> = BTreeMap::new();
        let filled = self.paths.iter().enumerate().filter_map(|(i, path)| Some((i, path, path.fill?)));
        for (i, path, color) in filled {
            let (points, loops) = numbered(path.runs.iter().filter(|run| run.1).map(|run| run.0.as_slice()));
            let mut triangles = Vec::new();
            triangulator.face(&points, loops.iter().map(Vec::as_slice), &mut triangles)?;
            let empty = || TriangleMesh { points: Points::new(3), triangles: Vec::new() };
            let mesh = meshes.entry(color).or_insert_with(empty);
            let first = mesh.points.len() as u32;
            points.iter().for_each(|p| mesh.points.push(&[p[0], p[1], step * i as f64]));
            mesh.triangles.extend(triangles.iter().map(|t| t.map(|v| first + v)));
        }
        let drawable = |(color, mesh)| Drawable::mesh("faces", mesh).color(rgb(color)).unlit();
        Ok(meshes.into_iter().map(drawable).collect())
    }

    /// Lines and dots, a drawable for each colour and width.
    fn strokes(&self, frame: &Frame) -> Vec<Drawable> {
        type Strokes = (Vec<[[f64; 3]; 2]>, Vec<[f64; 3]>);
        let mut strokes: BTreeMap<(u64, Color), Strokes> = BTreeMap::new();
        let step = self.layer_step(frame);
        let stroked = self.paths.iter().enumerate().filter_map(|(i, path)| Some((i, path, path.stroke?)));
        for (i, path, stroke) in stroked {
            let spatial = |[x, y]: [f64; 2]| [x, y, step * i as f64];
            // Widths are not negative: their bits are in their order.
            let (lines, dots) = strokes.entry((stroke.width.to_bits(), stroke.color)).or_default();
            for (points, closed) in &path.runs {
                let closing = if *closed { points.first() } else { None };
                let next = points.iter().skip(1).chain(closing);
                lines.extend(points.iter().zip(next).map(|(&a, &b)| [a, b].map(spatial)));
                if let [dot] = points.as_slice() {
                    dots.push(spatial(*dot));
                }
            }
        }
        let drawables = |((width, color), (lines, dots)): ((u64, Color), Strokes)| {
            let pixels = (f64::from_bits(width) * frame.scale) as f32;
            let lines = Drawable::lines("lines", lines).width(pixels).color(rgb(color));
            [lines, Drawable::points("dots", dots).size(pixels).color(rgb(color))]
        };
        strokes.into_iter().flat_map(drawables).collect()
    }
}

/// Looking straight down, y up in the picture.
fn camera(frame: &Frame, height: u32) -> Camera {
    let camera = Camera { projection: Projection::Orthographic, ..Camera::default() };
    let distance = frame.per_pixel * f64::from(height) / (2.0 * (0.5 * camera.fov_y).tan());
    let [x, y] = [0, 1].map(|k| frame.lo[k] / 2.0 + frame.hi[k] / 2.0);
    Camera { target: [x, y, 0.0], distance, orientation: StandardView::Top.orientation(), ..camera }
}

/// Points one after the other, and the loops over them.
fn numbered<'a>(runs: impl Iterator<Item = &'a [[f64; 2]]>) -> (Points, Vec<Vec<u32>>) {
    let (mut points, mut loops) = (Points::new(2), Vec::new());
    for run in runs {
        let first = points.len() as u32;
        run.iter().for_each(|p| points.push(p));
        loops.push((first..points.len() as u32).collect());
    }
    (points, loops)
}

fn rgb(color: Color) -> Rgb {
    color.0.map(|channel| f32::from(channel) / 255.0)
}
