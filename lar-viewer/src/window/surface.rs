//! The surface of a window: created, configured, lost and found again.

use crate::ViewerError;
use crate::gpu::context::Context;
use std::sync::Arc;
use wgpu::CurrentSurfaceTexture;
use winit::event_loop::OwnedDisplayHandle;
use winit::window::Window;

/// Frames in a row in which a surface is configured in vain before that is an error: a window that is being closed by someone
/// else has lost its surface before the message of its end arrives.
const MOST_FAILURES: u32 = 20;

/// A surface with its configuration.
pub(crate) struct Surface {
    window: Arc<Window>,
    pub(crate) instance: wgpu::Instance,
    pub(crate) surface: wgpu::Surface<'static>,
    pub(crate) config: wgpu::SurfaceConfiguration,
    /// How often in a row it could not be configured.
    failures: u32,
}

impl Surface {
    /// The instance and a surface, not configured yet.
    pub(crate) fn unconfigured(
        window: &Arc<Window>,
        display: &OwnedDisplayHandle,
    ) -> Result<(wgpu::Instance, wgpu::Surface<'static>), ViewerError> {
        let handle = Box::new(display.clone());
        let mut descriptor = wgpu::InstanceDescriptor::new_with_display_handle(handle).with_env();
        if cfg!(target_arch = "wasm32") {
            // Browsers do not let a page wait for a fence; reading a buffer back waits all the same.
            descriptor.backend_options.gl.fence_behavior = wgpu::GlFenceBehavior::AutoFinish;
        }
        let instance = wgpu::Instance::new(descriptor);
        let surface = on(&instance, window)?;
        Ok((instance, surface))
    }

    pub(crate) fn new(
        window: Arc<Window>,
        instance: wgpu::Instance,
        surface: wgpu::Surface<'static>,
        adapter: &wgpu::Adapter,
    ) -> Result<Self, ViewerError> {
        let config = configuration(&surface, adapter, &window)?;
        Ok(Self { window, instance, surface, config, failures: 0 })
    }

    /// Whether there is nothing to draw on: a window that is minimised or has no area.
    pub(crate) fn is_empty(&self) -> bool {
        self.config.width == 0 || self.config.height == 0
    }

    /// Follows the size of the window; without area it stays as it was.
    pub(crate) fn resize(&mut self, context: &Context, width: u32, height: u32) -> Result<(), ViewerError> {
        let limit = context.limits.max_texture_dimension_2d;
        (self.config.width, self.config.height) = (width.min(limit), height.min(limit));
        if self.is_empty() { Ok(()) } else { self.configure(context) }
    }

    /// Configures the surface. What the driver has against it is an error only when it stays.
    fn configure(&mut self, context: &Context) -> Result<(), ViewerError> {
        self.surface.configure(&context.device, &self.config);
        match context.check() {
            Ok(()) => self.failures = 0,
            Err(error) if self.failures == MOST_FAILURES => return Err(error),
            Err(_) => self.failures += 1,
        }
        Ok(())
    }

    /// The next texture; `None` when this frame is to be skipped. A lost surface is made anew.
    pub(crate) fn next_texture(
        &mut self,
        context: &Context,
    ) -> Result<Option<wgpu::SurfaceTexture>, ViewerError> {
        let remedy = if 0 < self.failures {
            Remedy::Renew
        } else {
            match self.surface.get_current_texture() {
                CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => {
                    return Ok(Some(texture));
                }
                missing => remedy(&missing),
            }
        };
        match remedy {
            Remedy::Wait => return Ok(None),
            Remedy::Retry => {}
            Remedy::Report => context.check()?,
            Remedy::Configure => self.configure(context)?,
            Remedy::Renew => {
                self.surface = on(&self.instance, &self.window)?;
                self.configure(context)?;
            }
        }
        self.window.request_redraw();
        Ok(None)
    }
}

/// What helps where there is no texture to draw on. All but waiting ask for another frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Remedy {
    /// Nothing is seen of the window; it says when it is.
    Wait,
    Retry,
    /// The window has changed since the surface was configured.
    Configure,
    /// A new surface of the same window.
    Renew,
    /// What the graphics card refused closes the window with its message.
    Report,
}

/// A surface that has a texture needs none, and tries again.
fn remedy(missing: &CurrentSurfaceTexture) -> Remedy {
    match missing {
        CurrentSurfaceTexture::Occluded => Remedy::Wait,
        CurrentSurfaceTexture::Outdated => Remedy::Configure,
        CurrentSurfaceTexture::Lost => Remedy::Renew,
        CurrentSurfaceTexture::Validation => Remedy::Report,
        CurrentSurfaceTexture::Timeout
        | CurrentSurfaceTexture::Success(_)
        | CurrentSurfaceTexture::Suboptimal(_) => Remedy::Retry,
    }
}

fn on(instance: &wgpu::Instance, window: &Arc<Window>) -> Result<wgpu::Surface<'static>, ViewerError> {
    instance.create_surface(Arc::clone(window)).map_err(|e| ViewerError::Window(e.to_string()))
}

/// The surface in a format that takes colours as they are, since egui mixes sRGB values.
fn configuration(
    surface: &wgpu::Surface<'_>,
    adapter: &wgpu::Adapter,
    window: &Window,
) -> Result<wgpu::SurfaceConfiguration, ViewerError> {
    let size = window.inner_size();
    let default = surface.get_default_config(adapter, size.width.max(1), size.height.max(1));
    let mut config = default.ok_or_else(|| ViewerError::Window("the window has no pixel format".into()))?;
    let formats = surface.get_capabilities(adapter).formats;
    let plain = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
    config.format = formats.into_iter().find(|f| plain.contains(f)).unwrap_or(config.format);
    config.present_mode = wgpu::PresentMode::AutoVsync;
    Ok(config)
}

/// A pass that draws onto the surface, cleared.
pub(crate) fn pass(
    encoder: &mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
) -> wgpu::RenderPass<'static> {
    let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store };
    let target =
        wgpu::RenderPassColorAttachment { view: target, depth_slice: None, resolve_target: None, ops };
    let descriptor = wgpu::RenderPassDescriptor {
        label: Some("window"),
        color_attachments: &[Some(target)],
        ..Default::default()
    };
    encoder.begin_render_pass(&descriptor).forget_lifetime()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_that_are_lost_or_outdated_are_found_again() {
        for (missing, expected) in [
            (CurrentSurfaceTexture::Timeout, Remedy::Retry),
            (CurrentSurfaceTexture::Occluded, Remedy::Wait),
            (CurrentSurfaceTexture::Outdated, Remedy::Configure),
            (CurrentSurfaceTexture::Lost, Remedy::Renew),
            (CurrentSurfaceTexture::Validation, Remedy::Report),
        ] {
            assert_eq!(remedy(&missing), expected, "{missing:?}");
        }
    }
}
