//! The window: the renderer of the off-screen pictures, shown inside egui.
//!
//! The scene is drawn into a texture of its own, which egui then places beside its panel; so the window needs nothing
//! from its surface but that it can show colours, and draws the same pixels as a picture file.

mod app;
mod controls;
mod painter;

use crate::{Scene, View, ViewerError};
use winit::event_loop::{ControlFlow, EventLoop};

/// Opens a window on the scene and returns when it is closed.
///
/// Left drag turns, right, middle or shift drag moves, the wheel zooms to the cursor; F fits, P switches between
/// perspective and orthographic, Esc closes. A side panel explodes the scene per axis, sets the opacity, hides the
/// edges, and saves the picture as `lar-N.png` in the working directory.
///
/// On macOS this must be called from the main thread; a process can open one window in its life.
///
/// # Errors
/// `NoDisplay` without a display, `NoAdapter`, `InvalidView`, `SceneTooLarge`, `Gpu`, or `Window` with the message of
/// the window system.
///
/// ```no_run
/// use lar_viewer::{Scene, View};
/// let mut scene = Scene::new();
/// lar_viewer::push_axes(&mut scene, 1.0)?;
/// let view = View::fitted(&scene, [1.0; 3], 1.5);
/// lar_viewer::view(scene, view, "axes")?;
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
#[doc(alias = "VIEW")]
pub fn view(scene: Scene, view: View, title: impl Into<String>) -> Result<(), ViewerError> {
    view.validate()?;
    let event_loop = event_loop()?;
    event_loop.set_control_flow(ControlFlow::Wait);
    let mut app = app::App::new(scene, view, title.into(), event_loop.owned_display_handle());
    event_loop.run_app(&mut app).map_err(|e| ViewerError::Window(e.to_string()))?;
    app.into_result()
}

fn event_loop() -> Result<EventLoop<()>, ViewerError> {
    let mut builder = EventLoop::builder();
    #[cfg(target_os = "linux")]
    {
        use winit::platform::{wayland, x11};
        x11::EventLoopBuilderExtX11::with_any_thread(&mut builder, true);
        wayland::EventLoopBuilderExtWayland::with_any_thread(&mut builder, true);
    }
    builder.build().map_err(|e| match e {
        winit::error::EventLoopError::RecreationAttempt => ViewerError::Window(e.to_string()),
        _ => ViewerError::NoDisplay(reason(&e.to_string()).to_owned()),
    })
}

/// A message of the window library without the line of its own source that it begins with.
fn reason(message: &str) -> &str {
    let after_place = message.strip_prefix("os error at ").and_then(|m| m.split_once(": "));
    after_place.map_or(message, |(_, reason)| reason).trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::reason;

    #[test]
    fn messages_name_no_source_lines() {
        let message = "os error at /src/winit/mod.rs:765: neither WAYLAND_DISPLAY nor DISPLAY is set.";
        assert_eq!(reason(message), "neither WAYLAND_DISPLAY nor DISPLAY is set");
        assert_eq!(reason("not supported: here"), "not supported: here");
    }
}
