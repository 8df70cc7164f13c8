//! The window as a canvas in a page.

use super::app::{App, Contents};
use super::host::Host;
use super::loader::Loaded;
use crate::session::Queries;
use crate::{SharedView, ViewerError};
use winit::event_loop::{ControlFlow, EventLoop};
use winit::platform::web::EventLoopExtWebSys;

/// Shows a view in a canvas that is added to the page, and returns; everything after that is told by events. `failed` is told
/// the error that ends it.
///
/// # Errors
/// As for a view that cannot be drawn, and `Window` with the message of the browser.
pub fn open(
    view: SharedView,
    queries: Box<dyn Queries>,
    host: Box<dyn Host>,
    failed: Box<dyn FnMut(ViewerError)>,
) -> Result<(), ViewerError> {
    let contents = Contents::complex(view.session, queries, view.camera, view.is_fitted)?;
    let event_loop = EventLoop::<Loaded>::with_user_event().build();
    let event_loop = event_loop.map_err(|e| ViewerError::Window(e.to_string()))?;
    event_loop.set_control_flow(ControlFlow::Wait);
    let display = event_loop.owned_display_handle();
    event_loop.spawn_app(App::new(contents, view.title, display, host, failed));
    Ok(())
}
