//! How the mouse moves the camera.

use crate::{Camera, Orientation, Projection, StandardView};
use egui::{PointerButton, Response, Ui};

/// Zoom per point of wheel motion, as a power of e: a notch of 50 points is a fifth.
const ZOOM_PER_POINT: f64 = 0.004;

/// What a left drag does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Turning {
    /// Turns about the world's z axis, and up and down.
    #[default]
    Turntable,
    /// Turns about the screen's axes, without any limit.
    Trackball,
    /// Moves: the view stays straight down on the plane.
    Plane,
}

/// The state of navigation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Navigation {
    pub(crate) turning: Turning,
}

impl Navigation {
    /// Applies drags and wheel over the picture.
    pub(crate) fn mouse(self, ui: &Ui, response: &Response, camera: &mut Camera) {
        let height = f64::from(response.rect.height().max(1.0));
        let delta = response.drag_delta();
        let moved = [f64::from(delta.x), f64::from(delta.y)];
        let shift = ui.input(|i| i.modifiers.shift);
        let moving =
            response.dragged_by(PointerButton::Secondary) || response.dragged_by(PointerButton::Middle);
        if moving || (shift && response.dragged_by(PointerButton::Primary)) {
            *camera = camera.pan(moved, height);
        } else if response.dragged_by(PointerButton::Primary) {
            *camera = self.drag(*camera, moved, height);
        }
        if let Some(at) = response.hover_pos() {
            let (wheel, pinch) =
                ui.input(|i| (f64::from(i.smooth_scroll_delta().y), f64::from(i.zoom_delta())));
            // Pinching, and the wheel with the control key, arrive as a factor.
            let factor = (wheel * ZOOM_PER_POINT).exp() * pinch;
            if factor != 1.0 {
                let cursor = at - response.rect.center();
                *camera = camera.zoom(factor, [f64::from(cursor.x), f64::from(cursor.y)], height);
            }
        }
    }

    fn drag(self, camera: Camera, moved: [f64; 2], height: f64) -> Camera {
        let turned = |orientation| Camera { orientation, ..camera };
        match self.turning {
            Turning::Turntable => turned(camera.orientation.orbit(moved)),
            Turning::Trackball => turned(camera.orientation.tumble(moved)),
            Turning::Plane => camera.pan(moved, height),
        }
    }

    /// Looks from a standard direction. That ends the locked view of the plane, except from above.
    pub(crate) fn look_from(&mut self, view: StandardView, camera: &mut Camera) {
        if self.turning == Turning::Plane && view != StandardView::Top {
            self.turning = Turning::Turntable;
        }
        camera.orientation = view.orientation();
    }

    /// Locks the view straight down without perspective, or unlocks it.
    pub(crate) fn toggle_plane(&mut self, camera: &mut Camera) {
        if self.turning == Turning::Plane {
            self.turning = Turning::Turntable;
        } else {
            self.turning = Turning::Plane;
            camera.orientation = StandardView::Top.orientation();
            camera.projection = Projection::Orthographic;
        }
    }

    /// Switches between turntable and trackball; a rolled view is set upright by the turntable.
    pub(crate) fn toggle_trackball(&mut self, camera: &mut Camera) {
        if self.turning == Turning::Trackball {
            self.turning = Turning::Turntable;
            let [_, _, back] = camera.orientation.axes();
            let upright = Orientation::facing(back, [0.0, 0.0, 1.0]);
            camera.orientation = upright.unwrap_or(camera.orientation);
        } else {
            self.turning = Turning::Trackball;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_is_locked_until_another_side_is_asked_for() {
        let (mut navigation, mut camera) = (Navigation::default(), Camera::default());
        navigation.toggle_plane(&mut camera);
        assert_eq!(
            (camera.projection, camera.orientation),
            (Projection::Orthographic, StandardView::Top.orientation())
        );
        let dragged = navigation.drag(camera, [30.0, 20.0], 600.0);
        assert_eq!(dragged, camera.pan([30.0, 20.0], 600.0));
        navigation.look_from(StandardView::Top, &mut camera);
        assert_eq!(navigation.turning, Turning::Plane);
        navigation.look_from(StandardView::Front, &mut camera);
        assert_eq!(navigation.turning, Turning::Turntable);
    }

    #[test]
    fn the_turntable_sets_a_rolled_view_upright() {
        let (mut navigation, mut camera) = (Navigation::default(), Camera::default());
        navigation.toggle_trackball(&mut camera);
        for _ in 0..4 {
            camera = navigation.drag(camera, [60.0, 30.0], 600.0);
        }
        assert!(camera.axes()[0][2].abs() > 0.1, "rolled: {:?}", camera.axes());
        navigation.toggle_trackball(&mut camera);
        assert!(camera.axes()[0][2].abs() < 1e-9 && 0.0 < camera.axes()[1][2]);
    }
}
