//! What lies beside the picture is not drawn: bounding spheres of parts against the sides of what the camera sees.

use super::frame::Frame;
use super::parts::GroupOffsets;
use glam::{Mat4, Vec3, Vec4, Vec4Swizzles};

/// At least so far beyond the edges something counts as seen, in half sides of the picture: room for rounding.
const MARGIN: f32 = 0.03;

/// A ball around the elements of a part: centre and radius, in the scene before it is exploded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball {
    pub(crate) center: Vec3,
    pub(crate) radius: f32,
    /// How much the widest element reaches out of the ball, in pixels of line width.
    pub(crate) reach: f32,
}

impl Ball {
    /// About the middle of the box around the points, with elements of no width.
    pub(crate) fn around(points: impl Iterator<Item = [f32; 3]> + Clone) -> Self {
        let all = points.map(Vec3::from);
        let low = all.clone().fold(Vec3::MAX, Vec3::min);
        let high = all.clone().fold(Vec3::MIN, Vec3::max);
        let center = 0.5 * (low + high);
        let farthest = all.map(|p| p.distance_squared(center)).fold(0.0, f32::max);
        Self { center, radius: farthest.sqrt(), reach: 0.0 }
    }

    /// With lines of these widths or dots of these sizes. What is highlighted is up to twice as wide.
    pub(crate) fn of_widths(self, widths: impl Iterator<Item = f32>) -> Self {
        Self { reach: widths.fold(0.0, f32::max), ..self }
    }
}

/// A rectangle of the picture.
struct Rectangle {
    /// What gives the clip coordinates x, y and w.
    rows: [Vec4; 3],
    /// Its edges, x and y over w.
    low: [f32; 2],
    high: [f32; 2],
}

impl Rectangle {
    /// The sides of what is seen through it and so many half sides of the picture beyond its edges: normals of length 1 that
    /// point inwards, and offsets.
    fn sides(&self, margins: [f32; 2]) -> [Vec4; 4] {
        let [x, y, w] = self.rows;
        let low = [0, 1].map(|k| self.low[k] - margins[k]);
        let high = [0, 1].map(|k| self.high[k] + margins[k]);
        let sides = [x - low[0] * w, high[0] * w - x, y - low[1] * w, high[1] * w - y];
        sides.map(|side| side / side.xyz().length().max(f32::MIN_POSITIVE))
    }
}

/// What a camera sees of an exploded scene in a rectangle.
pub(crate) struct Frustum {
    rectangle: Rectangle,
    /// Its sides with the least margin.
    sides: [Vec4; 4],
    /// Half the sides of the picture, in pixels of line width.
    half_view: [f32; 2],
    explode: Vec<Vec3>,
    about: Vec3,
}

impl Frustum {
    /// Of the picture.
    pub(crate) fn new(frame: &Frame) -> Self {
        Self::through(frame, [-1.0; 2], [1.0; 2])
    }

    /// Of the pixels that are at most `radius` columns and rows from one.
    pub(crate) fn around(frame: &Frame, pixel: [u32; 2], radius: u32) -> Self {
        let side = frame.viewport.map(|samples| samples / frame.supersample as f32);
        let from = [0, 1].map(|k| 2.0 * (pixel[k] as f32 - radius as f32) / side[k] - 1.0);
        let to = [0, 1].map(|k| 2.0 * ((pixel[k] + 1) as f32 + radius as f32) / side[k] - 1.0);
        // Rows are counted downwards.
        Self::through(frame, [from[0], -to[1]], [to[0], -from[1]])
    }

    fn through(frame: &Frame, low: [f32; 2], high: [f32; 2]) -> Self {
        let matrix = Mat4::from_cols_array_2d(&frame.clip_from_view)
            * Mat4::from_cols_array_2d(&frame.view_from_scene);
        let rectangle = Rectangle { rows: [0, 1, 3].map(|i| matrix.row(i)), low, high };
        Self {
            sides: rectangle.sides([MARGIN; 2]),
            rectangle,
            half_view: frame.viewport.map(|samples| 0.5 * samples / frame.samples_per_pixel),
            explode: frame.explode.map(|f| Vec4::from(f).xyz()).to_vec(),
            about: Vec3::from(frame.about),
        }
    }

    /// Whether a ball of a group may be seen; `displacement` in `common.wgsl` moves it.
    pub(crate) fn sees(&self, ball: &Ball, group: Option<&GroupOffsets>) -> bool {
        let offsets = group.map(|g| g.0.map(|o| Vec4::from(o).xyz()));
        let moved = offsets.map_or(Vec3::ZERO, |offsets| {
            let inner = offsets[1..].iter().zip(&self.explode[1..]).map(|(o, e)| *o * *e);
            self.explode[0] * (offsets[0] - self.about) + inner.sum::<Vec3>()
        });
        let center = ball.center + moved;
        let margins = self.half_view.map(|half| MARGIN.max((ball.reach + 1.0) / half));
        let sides = if margins == [MARGIN; 2] { self.sides } else { self.rectangle.sides(margins) };
        // What is not comparable is drawn.
        !sides.iter().any(|side| side.xyz().dot(center) + side.w < -ball.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::frame::{Placement, Raster};
    use crate::{Camera, View};
    use proptest::prelude::*;

    fn frame(view: &View) -> Frame {
        let raster = Raster { width: 300, height: 200, samples: 1, scale: 1.0 };
        let placement = Placement { center: [0.0; 3], unit: 1.0 };
        Frame::new(view, &raster, &placement, None)
    }

    fn ball(center: [f32; 3], radius: f32) -> Ball {
        Ball { center: center.into(), radius, reach: 0.0 }
    }

    #[test]
    fn what_is_beside_the_picture_is_not_seen_until_it_is_exploded_into_it() {
        let front = Camera { orientation: crate::StandardView::Front.orientation(), ..Camera::default() };
        let mut view = View { camera: front.toggle_projection(), ..View::default() };
        let beside = ball([5.0, 0.0, 0.0], 0.5);
        assert!(Frustum::new(&frame(&view)).sees(&ball([0.0; 3], 0.1), None));
        assert!(!Frustum::new(&frame(&view)).sees(&beside, None));
        assert!(
            Frustum::new(&frame(&view)).sees(&ball([5.0, 0.0, 0.0], 4.0), None),
            "large enough to reach in"
        );
        let mut offsets = [[0.0; 4]; crate::LEVELS];
        offsets[0][0] = -5.0;
        let group = GroupOffsets(offsets);
        assert!(!Frustum::new(&frame(&view)).sees(&beside, Some(&group)));
        view.explode = [2.0, 1.0, 1.0].into();
        assert!(Frustum::new(&frame(&view)).sees(&beside, Some(&group)));
    }

    #[test]
    fn only_what_is_near_a_pixel_is_seen_around_it() {
        let front = Camera { orientation: crate::StandardView::Front.orientation(), ..Camera::default() };
        let view = View { camera: front.toggle_projection(), ..View::default() };
        let at = |x: f64, y: f64| front.toggle_projection().project([x, 0.0, y], 200.0).unwrap();
        let [right, up] = [at(0.6, 0.0)[0], at(0.0, 0.6)[1]].map(f64::abs);
        let seen = |pixel: [f64; 2], center| {
            let frustum = Frustum::around(&frame(&view), pixel.map(|x| x.round() as u32), 3);
            frustum.sees(&ball(center, 0.01), None)
        };
        let [middle, to_the_right, above] = [[150.0, 100.0], [150.0 + right, 100.0], [150.0, 100.0 - up]];
        let places = [[0.0; 3], [0.6, 0.0, 0.0], [0.0, 0.0, 0.6]];
        let table = [middle, to_the_right, above].map(|pixel| places.map(|place| seen(pixel, place)));
        assert_eq!(table, [[true, false, false], [false, true, false], [false, false, true]]);
    }

    proptest! {
        /// A ball with a point inside of the picture is seen, around the pixel of the point too; so is one whose lines
        /// reach that far.
        #[test]
        fn nothing_in_the_picture_is_left_out(
            point in prop::array::uniform3(-2.0..2.0_f64),
            away in prop::array::uniform3(-1.0..1.0_f32),
            turn in prop::array::uniform2(-400.0..400.0_f64),
            zoom in 0.1..8.0_f64,
            orthographic in any::<bool>(),
            aside in prop::array::uniform2(-140.0..140.0_f64),
        ) {
            let mut camera = Camera::default();
            camera.orientation = camera.orientation.orbit(turn);
            camera.distance /= zoom;
            if orthographic {
                camera = camera.toggle_projection();
            }
            let Some([x, y]) = camera.project(point, 200.0) else { return Ok(()) };
            if 149.0 < x.abs() || 99.0 < y.abs() {
                return Ok(());
            }
            let frame = frame(&View { camera, ..View::default() });
            let inner = Vec3::from(point.map(|x| x as f32));
            let away = Vec3::from(away);
            let ball = Ball { center: inner + away, radius: away.length(), reach: 0.0 };
            prop_assert!(Frustum::new(&frame).sees(&ball, None));
            let pixel = [150.0 + x, 100.0 + y].map(|x| x.floor() as u32);
            prop_assert!(Frustum::around(&frame, pixel, 0).sees(&ball, None));
            let beside = [0, 1].map(|k| (f64::from(pixel[k]) + aside[k]).clamp(0.0, [299.0, 199.0][k]) as u32);
            let distance = (0..2).map(|k| f64::from(beside[k].abs_diff(pixel[k])).powi(2)).sum::<f64>().sqrt();
            let wide = ball.of_widths([1.0, distance as f32].into_iter());
            prop_assert!(Frustum::around(&frame, beside, 0).sees(&wide, None));
        }
    }
}
