//! The graphics device: which adapter is taken, and how its errors come back.
//!
//! Adapters are asked for by backend, the native ones first and OpenGL last, and within a backend the discrete card
//! before the integrated one before a software driver. `WGPU_BACKEND` (`vulkan`, `gl`, …) narrows the choice.

use super::traffic::Traffic;
use crate::ViewerError;
use std::sync::{Arc, Mutex, PoisonError};
#[cfg(not(target_arch = "wasm32"))]
use wgpu::Backends;
use wgpu::{Adapter, Buffer, BufferUsages, DeviceType, DownlevelFlags, Instance, Limits};

/// Storage buffers that the layer shaders use at once.
const STORAGE_BUFFERS: u32 = 3;

/// How transparent layers are blended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Transparency {
    /// In order of depth, exactly; needs storage buffers that fragment shaders can write.
    Sorted,
    /// By a weighted mean, which every adapter can do.
    Weighted,
}

impl Transparency {
    /// The best that an adapter can do.
    fn of(adapter: &Adapter) -> Self {
        let writable = DownlevelFlags::FRAGMENT_WRITABLE_STORAGE;
        let enough = STORAGE_BUFFERS <= adapter.limits().max_storage_buffers_per_shader_stage;
        let sorted = adapter.get_downlevel_capabilities().flags.contains(writable) && enough;
        if sorted { Self::Sorted } else { Self::Weighted }
    }
}

/// A device with the queue, limits and name of its adapter.
pub(crate) struct Context {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) limits: Limits,
    pub(crate) adapter_name: String,
    pub(crate) transparency: Transparency,
    /// The adapter draws on the processor.
    #[cfg(feature = "window")]
    pub(crate) is_software: bool,
    first_error: Arc<Mutex<Option<String>>>,
    traffic: Mutex<Traffic>,
}

impl Context {
    /// The best adapter of this machine, no display needed.
    pub(crate) fn off_screen() -> Result<Self, ViewerError> {
        let instance = Instance::new(wgpu::InstanceDescriptor::new_without_display_handle().with_env());
        Self::on(&best_adapter(&instance, None)?)
    }

    /// The same adapter held to what WebGL 2 can do.
    pub(crate) fn portable() -> Result<Self, ViewerError> {
        let instance = Instance::new(wgpu::InstanceDescriptor::new_without_display_handle().with_env());
        let adapter = best_adapter(&instance, None)?;
        let limits = Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
        Self::with_limits(&adapter, limits, Transparency::Weighted)
    }

    /// The device of an adapter.
    pub(crate) fn on(adapter: &Adapter) -> Result<Self, ViewerError> {
        Self::with_limits(adapter, adapter.limits(), Transparency::of(adapter))
    }

    fn with_limits(
        adapter: &Adapter,
        limits: Limits,
        transparency: Transparency,
    ) -> Result<Self, ViewerError> {
        let info = adapter.get_info();
        let adapter_name = format!("{} ({})", info.name, info.backend);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("lar-viewer"),
            required_limits: limits.clone(),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|e| ViewerError::Gpu { adapter: adapter_name.clone(), message: e.to_string() })?;
        let first_error = Arc::new(Mutex::new(None));
        let slot = Arc::clone(&first_error);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| error.to_string());
        }));
        Ok(Self {
            device,
            queue,
            limits,
            adapter_name,
            transparency,
            #[cfg(feature = "window")]
            is_software: info.device_type == DeviceType::Cpu,
            first_error,
            traffic: Mutex::default(),
        })
    }

    /// The first error that the device has reported since the last call.
    pub(crate) fn check(&self) -> Result<(), ViewerError> {
        match self.first_error.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(message) => Err(self.error(message)),
            None => Ok(()),
        }
    }

    /// Waits until everything that was submitted is done.
    pub(crate) fn wait(&self) -> Result<(), ViewerError> {
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| self.error(e.to_string()))?;
        self.check()
    }

    /// The bytes of a buffer that was made with `MAP_READ`, when all work on it is done.
    pub(crate) fn read<R>(&self, buffer: &Buffer, read: impl FnOnce(&[u8]) -> R) -> Result<R, ViewerError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        buffer.slice(..).map_async(wgpu::MapMode::Read, move |result| {
            // The receiver lives until this has been called, unless waiting failed and said so.
            let _ = sender.send(result);
        });
        self.wait()?;
        let mapped = receiver.recv().map_err(|e| self.error(e.to_string()))?;
        mapped.map_err(|e| self.error(e.to_string()))?;
        let value = {
            let bytes = buffer.slice(..).get_mapped_range().map_err(|e| self.error(e.to_string()))?;
            read(&bytes)
        };
        buffer.unmap();
        Ok(value)
    }

    /// A buffer of these bytes; never empty, since empty buffers cannot be bound.
    pub(crate) fn upload(
        &self,
        what: &'static str,
        bytes: &[u8],
        usage: BufferUsages,
    ) -> Result<Buffer, ViewerError> {
        let size = (bytes.len() as u64).next_multiple_of(4).max(48);
        let limit = self.limits.max_buffer_size;
        if limit < size {
            return Err(ViewerError::SceneTooLarge {
                what,
                bytes: size,
                limit,
                adapter: self.adapter_name.clone(),
            });
        }
        let buffer = self.buffer(what, size, usage | BufferUsages::COPY_DST);
        self.check()?;
        self.write(&buffer, bytes);
        self.count(|traffic| {
            let upload = if usage.contains(BufferUsages::UNIFORM) {
                &mut traffic.parameters
            } else {
                &mut traffic.geometry
            };
            upload.made += 1;
            upload.bytes += bytes.len() as u64;
        });
        Ok(buffer)
    }

    /// An empty buffer.
    #[expect(clippy::disallowed_methods, reason = "all buffers are made here")]
    pub(crate) fn buffer(&self, what: &'static str, size: u64, usage: BufferUsages) -> Buffer {
        let descriptor = wgpu::BufferDescriptor { label: Some(what), size, usage, mapped_at_creation: false };
        self.device.create_buffer(&descriptor)
    }

    #[expect(clippy::disallowed_methods, reason = "only `upload` calls this, and counts")]
    fn write(&self, buffer: &Buffer, bytes: &[u8]) {
        self.queue.write_buffer(buffer, 0, bytes);
    }

    /// Writes all texels of a table, rows of this many bytes.
    #[expect(clippy::disallowed_methods, reason = "counted here")]
    pub(crate) fn write_table(&self, table: &wgpu::Texture, bytes: &[u8], row_bytes: u32) {
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row_bytes), rows_per_image: None };
        self.queue.write_texture(table.as_image_copy(), bytes, layout, table.size());
        self.count(|traffic| traffic.tables.bytes += bytes.len() as u64);
    }

    /// Counts what is handed to the graphics card.
    pub(crate) fn count(&self, count: impl FnOnce(&mut Traffic)) {
        count(&mut self.traffic.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// What was handed to the graphics card so far.
    pub(crate) fn traffic(&self) -> Traffic {
        *self.traffic.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Bytes of the largest storage buffer that can be bound whole.
    pub(crate) fn largest_storage(&self) -> u64 {
        self.limits.max_buffer_size.min(self.limits.max_storage_buffer_binding_size)
    }

    fn error(&self, message: String) -> ViewerError {
        ViewerError::Gpu { adapter: self.adapter_name.clone(), message }
    }
}

/// The adapter of the browser for a canvas.
#[cfg(target_arch = "wasm32")]
pub(crate) fn best_adapter(
    instance: &Instance,
    surface: Option<&wgpu::Surface<'_>>,
) -> Result<Adapter, ViewerError> {
    let options = wgpu::RequestAdapterOptions { compatible_surface: surface, ..Default::default() };
    // With WebGL the answer is there at once.
    let adapter = pollster::block_on(instance.request_adapter(&options));
    let adapter = adapter.map_err(|e| ViewerError::NoAdapter { found: e.to_string() })?;
    match lacking(&adapter, surface) {
        None => Ok(adapter),
        Some(reason) => {
            Err(ViewerError::NoAdapter { found: format!("{} {reason}", adapter.get_info().name) })
        }
    }
}

/// The best adapter that, given a surface, can draw on it: one that sorts layers before any other.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn best_adapter(
    instance: &Instance,
    surface: Option<&wgpu::Surface<'_>>,
) -> Result<Adapter, ViewerError> {
    let allowed = Backends::from_env().unwrap_or(Backends::all());
    let mut passed_over = Vec::new();
    let mut second_best = None;
    for backends in [Backends::all() - Backends::GL, Backends::GL] {
        let mut adapters = pollster::block_on(instance.enumerate_adapters(backends & allowed));
        adapters.sort_by_cached_key(|a| (rank(a.get_info().device_type), a.get_info().name));
        for adapter in adapters {
            match lacking(&adapter, surface) {
                None if Transparency::of(&adapter) == Transparency::Sorted => return Ok(adapter),
                None => second_best = second_best.or(Some(adapter)),
                Some(reason) => {
                    let info = adapter.get_info();
                    passed_over.push(format!("{} ({}) {reason}", info.name, info.backend));
                }
            }
        }
    }
    if let Some(adapter) = second_best {
        return Ok(adapter);
    }
    let found = if passed_over.is_empty() { "none found".to_owned() } else { passed_over.join("; ") };
    Err(ViewerError::NoAdapter { found })
}

#[cfg(not(target_arch = "wasm32"))]
fn rank(device_type: DeviceType) -> u8 {
    match device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Cpu => 3,
        DeviceType::Other => 4,
    }
}

fn lacking(adapter: &Adapter, surface: Option<&wgpu::Surface<'_>>) -> Option<&'static str> {
    if adapter.limits().max_color_attachments < 2
        || adapter.limits().max_texture_dimension_2d < super::table::WIDTH
    {
        Some("has too small textures")
    } else if surface.is_some_and(|s| !adapter.is_surface_supported(s)) {
        Some("cannot draw on this window")
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_an_adapter_the_error_says_what_to_install() {
        let none = wgpu::InstanceDescriptor {
            backends: Backends::empty(),
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        };
        let error = best_adapter(&Instance::new(none), None).unwrap_err();
        let message = error.to_string();
        assert!(matches!(error, ViewerError::NoAdapter { .. }), "{message}");
        assert!(
            message.contains("none found") && message.contains("apt-get install libvulkan1"),
            "{message}"
        );
    }

    #[test]
    fn graphics_cards_come_before_software() {
        let order =
            [DeviceType::DiscreteGpu, DeviceType::IntegratedGpu, DeviceType::VirtualGpu, DeviceType::Cpu];
        assert!(order.is_sorted_by_key(|t| rank(*t)));
    }
}
