//! Sheets: panels in rows and columns, each fitted into its square and seen from a direction of its own, together one
//! scene. So a sheet is drawn, and turned about in a window, as any scene.

use super::Figure;
use super::parts::{Part, Point};
use crate::CommandError;
use lar_viewer::{
    Camera, Drawable, Label, Orientation, Projection, Scene, StandardView, TextStyle, View, WHITE,
};
use std::f64::consts::FRAC_PI_2;

/// Part of a panel's side that what it shows may take.
const FILL: f64 = 0.84;

/// Part of the side by which what has a caption is raised, and smaller.
const RAISED: f64 = 0.04;

/// Where the caption stands, above the lower edge, in parts of the side.
const CAPTION: f64 = 0.075;

/// Height of the capitals of captions in pixels.
const CAPITALS: f64 = 10.5;

/// Side of a panel in pixels for which the widths of lines are chosen.
const DESIGN_SIDE: f64 = 260.0;

/// Where a panel is seen from: azimuth from x towards y and elevation above the xy plane, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Eye {
    pub azimuth: f64,
    pub elevation: f64,
}

impl Default for Eye {
    /// From the front, the right and above.
    fn default() -> Self {
        Self { azimuth: -1.05, elevation: 0.42 }
    }
}

impl Eye {
    pub(crate) fn camera(self) -> Camera {
        let orientation = Orientation::turntable(self.azimuth, self.elevation);
        Camera { orientation, ..Camera::default() }
    }

    /// The unit vector towards the eye.
    pub(crate) fn direction(self) -> Point {
        let [(sin_a, cos_a), (sin_e, cos_e)] = [self.azimuth.sin_cos(), self.elevation.sin_cos()];
        [cos_e * cos_a, cos_e * sin_a, sin_e]
    }
}

/// Straight down, y up.
pub(crate) const ABOVE: Eye = Eye { azimuth: -FRAC_PI_2, elevation: FRAC_PI_2 };

/// What one square of a sheet shows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Panel {
    pub parts: Vec<Part>,
    pub eye: Eye,
    /// Points that must find room besides those of the parts: panels with the same ones have the same scale.
    pub frame: Vec<Point>,
    /// What stands below it.
    pub caption: String,
}

impl Panel {
    pub(crate) fn new(parts: impl IntoIterator<Item = Part>) -> Self {
        Self { parts: parts.into_iter().collect(), ..Self::default() }
    }

    pub(crate) fn from(self, eye: Eye) -> Self {
        Self { eye, ..self }
    }

    pub(crate) fn framed(self, frame: Vec<Point>) -> Self {
        Self { frame, ..self }
    }

    pub(crate) fn called(self, caption: impl Into<String>) -> Self {
        Self { caption: caption.into(), ..self }
    }

    /// The parts turned so that the eye looks along y with z up, and fitted into the square of side 1 about `center`.
    fn placed(self, center: [f64; 2]) -> Vec<Part> {
        let [right, up, back] = self.eye.camera().axes();
        let turn = |p: Point| [dot(p, right), -dot(p, back), dot(p, up)];
        let points = self.parts.iter().flat_map(Part::points).chain(self.frame.iter().copied());
        let Some(bounds) = lar_viewer::Bounds::of(points.map(turn)) else { return Vec::new() };
        let middle = bounds.center();
        let extent = (bounds.max[0] - bounds.min[0]).max(bounds.max[2] - bounds.min[2]);
        let raised = if self.caption.is_empty() { 0.0 } else { RAISED };
        let scale = if 0.0 < extent { (FILL - 2.0 * raised) / extent } else { 1.0 };
        let place = |p: Point| {
            let p = turn(p);
            [
                center[0] + scale * (p[0] - middle[0]),
                scale * (p[1] - middle[1]),
                center[1] + raised + scale * (p[2] - middle[2]),
            ]
        };
        self.parts.into_iter().map(|part| part.mapped(place)).collect()
    }
}

/// Panels called (a), (b), (c), … in their order.
pub(crate) fn lettered(panels: impl IntoIterator<Item = Panel>) -> Vec<Panel> {
    ('a'..='z').zip(panels).map(|(letter, panel)| panel.called(format!("({letter})"))).collect()
}

/// Panels row by row from the top left.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    pub panels: Vec<Panel>,
    pub columns: usize,
}

impl Sheet {
    /// The sheet as a picture, its panels `side` pixels wide, or as large as fits into `size`.
    pub(crate) fn figure(
        self,
        name: &str,
        title: &'static str,
        side: u32,
        size: Option<[u32; 2]>,
    ) -> Result<Figure, CommandError> {
        let columns = self.columns.clamp(1, self.panels.len().max(1));
        let rows = self.panels.len().div_ceil(columns).max(1);
        let size = size.unwrap_or([columns as u32 * side, rows as u32 * side]);
        let mut scene = Scene::new();
        let mut captions = Vec::new();
        for (i, panel) in self.panels.into_iter().enumerate() {
            let center = [(i % columns) as f64 + 0.5, (rows - i / columns) as f64 - 0.5];
            captions.push(Label::new(panel.caption.as_str(), [center[0], 0.0, center[1] - 0.5 + CAPTION]));
            panel.placed(center).into_iter().try_for_each(|part| scene.push(part.drawable()))?;
        }
        captions.retain(|caption| !caption.text.is_empty());
        let style = TextStyle { size: CAPITALS, ..TextStyle::default() };
        scene.push(Drawable::labels("captions", captions).text_style(style).on_top())?;
        let view = view([columns, rows], size);
        Ok(Figure { name: name.to_owned(), title, scene, view, size, svg: None })
    }
}

/// Parts as a picture of their own, in perspective.
pub(crate) fn single(
    name: &str,
    title: &'static str,
    parts: Vec<Part>,
    eye: Eye,
    size: [u32; 2],
) -> Result<Figure, CommandError> {
    let mut scene = Scene::new();
    parts.into_iter().try_for_each(|part| scene.push(part.drawable()))?;
    let view = View { camera: eye.camera(), background: WHITE, ..View::default() };
    let view = view.fit(&scene, f64::from(size[0]) / f64::from(size[1].max(1)));
    Ok(Figure { name: name.to_owned(), title, scene, view, size, svg: None })
}

/// The view that fills a picture with so many columns and rows.
fn view(panels: [usize; 2], size: [u32; 2]) -> View {
    let panels = panels.map(|n| n as f64);
    let pixels = size.map(|n| f64::from(n.max(1)));
    let side = (pixels[0] / panels[0]).min(pixels[1] / panels[1]);
    let camera = Camera { projection: Projection::Orthographic, ..Camera::default() };
    let camera = Camera {
        target: [0.5 * panels[0], 0.0, 0.5 * panels[1]],
        distance: pixels[1] / side / (2.0 * (0.5 * camera.fov_y).tan()),
        orientation: StandardView::Front.orientation(),
        ..camera
    };
    View { camera, background: WHITE, scale: (side / DESIGN_SIDE).clamp(0.3, 4.0) as f32, ..View::default() }
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
