//! What lies beside the picture is not drawn: bounding spheres of parts against the sides of what the camera sees.

use super::frame::Frame;
use super::parts::GroupOffsets;
use glam::{Mat4, Vec3, Vec4, Vec4Swizzles};

/// How far beyond the picture's edges a part counts as seen, in half sides: lines and dots are wider than what they mark.
const MARGIN: f32 = 1.15;

/// A ball around the elements of a part: centre and radius, in the scene before it is exploded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball {
    pub(crate) center: Vec3,
    pub(crate) radius: f32,
}

impl Ball {
    /// About the middle of the box around the points.
    pub(crate) fn around(points: impl Iterator<Item = [f32; 3]> + Clone) -> Self {
        let all = points.map(Vec3::from);
        let low = all.clone().fold(Vec3::MAX, Vec3::min);
        let high = all.clone().fold(Vec3::MIN, Vec3::max);
        let center = 0.5 * (low + high);
        let farthest = all.map(|p| p.distance_squared(center)).fold(0.0, f32::max);
        Self { center, radius: farthest.sqrt() }
    }
}

/// The sides of what a camera sees of an exploded scene.
pub(crate) struct Frustum {
    /// Normals of length 1 that point inwards, and offsets.
    sides: [Vec4; 4],
    explode: Vec<Vec3>,
    about: Vec3,
}

impl Frustum {
    pub(crate) fn new(frame: &Frame) -> Self {
        let matrix = Mat4::from_cols_array_2d(&frame.clip_from_view)
            * Mat4::from_cols_array_2d(&frame.view_from_scene);
        let [x, y, w] = [0, 1, 3].map(|i| matrix.row(i));
        let sides = [MARGIN * w + x, MARGIN * w - x, MARGIN * w + y, MARGIN * w - y];
        let unit = |side: Vec4| side / side.xyz().length().max(f32::MIN_POSITIVE);
        let explode = frame.explode.map(|f| Vec4::from(f).xyz()).to_vec();
        Self { sides: sides.map(unit), explode, about: Vec3::from(frame.about) }
    }

    /// Whether a ball of a group may be seen; `displacement` in `common.wgsl` moves it.
    pub(crate) fn sees(&self, ball: &Ball, group: Option<&GroupOffsets>) -> bool {
        let offsets = group.map(|g| g.0.map(|o| Vec4::from(o).xyz()));
        let moved = offsets.map_or(Vec3::ZERO, |offsets| {
            let inner = offsets[1..].iter().zip(&self.explode[1..]).map(|(o, e)| *o * *e);
            self.explode[0] * (offsets[0] - self.about) + inner.sum::<Vec3>()
        });
        let center = ball.center + moved;
        // What is not comparable is drawn.
        !self.sides.iter().any(|side| side.xyz().dot(center) + side.w < -ball.radius)
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
        Ball { center: center.into(), radius }
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

    proptest! {
        /// A ball with a point inside of the picture is seen.
        #[test]
        fn nothing_in_the_picture_is_left_out(
            point in prop::array::uniform3(-2.0..2.0_f64),
            away in prop::array::uniform3(-1.0..1.0_f32),
            turn in prop::array::uniform2(-400.0..400.0_f64),
            zoom in 0.1..8.0_f64,
            orthographic in any::<bool>(),
        ) {
            let mut camera = Camera::default();
            camera.orientation = camera.orientation.orbit(turn);
            camera.distance /= zoom;
            if orthographic {
                camera = camera.toggle_projection();
            }
            let Some([x, y]) = camera.project(point, 200.0) else { return Ok(()) };
            if 150.0 < x.abs() || 100.0 < y.abs() {
                return Ok(());
            }
            let view = View { camera, ..View::default() };
            let center = Vec3::from(point.map(|x| x as f32)) + Vec3::from(away);
            let ball = Ball { center, radius: Vec3::from(away).length() };
            prop_assert!(Frustum::new(&frame(&view)).sees(&ball, None));
        }
    }
}
