//! What can go wrong between a scene and a picture, said with names and values.

/// Why a scene cannot be built, drawn or shown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// No graphics driver offers what the renderer needs.
    #[error(
        "no usable graphics adapter ({found}); the renderer needs Vulkan, Metal, Direct3D 12 or OpenGL ES 3.0. Without a graphics card, a software driver does: on Debian or Ubuntu \
         `apt-get install libvulkan1 mesa-vulkan-drivers`"
    )]
    NoAdapter {
        /// The adapters that were seen and why each was passed over.
        found: String,
    },
    /// The driver refused an operation that the renderer asked for.
    #[error("the graphics driver of {adapter} reports: {message}")]
    Gpu {
        /// Name of the adapter.
        adapter: String,
        /// The driver's message.
        message: String,
    },
    /// A coordinate is NaN, infinite or larger than the renderer can place.
    #[error(
        "drawable {drawable:?}: coordinate {axis} of {item} {index} is {value}; it must lie within ±{limit:e}"
    )]
    Coordinate {
        /// Name of the drawable or group.
        drawable: String,
        /// What the coordinate belongs to: point, segment, centroid.
        item: &'static str,
        /// Its index in the drawable.
        index: usize,
        /// `x`, `y` or `z`.
        axis: char,
        /// The coordinate.
        value: f64,
        /// The largest magnitude that can be drawn.
        limit: f64,
    },
    /// A colour, opacity, width or size lies outside its range.
    #[error("drawable {drawable:?}: {attribute} is {value}; it must lie between {low} and {high}")]
    Attribute {
        /// Name of the drawable.
        drawable: String,
        /// The attribute.
        attribute: &'static str,
        /// The value given.
        value: f64,
        /// Smallest value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
    /// A triangle names a point that its mesh does not have.
    #[error(
        "drawable {drawable:?}: triangle {triangle} names point {point}, but there are {n_points} points"
    )]
    PointOutOfRange {
        /// Name of the drawable.
        drawable: String,
        /// Index of the triangle.
        triangle: usize,
        /// The point it names.
        point: u32,
        /// How many there are.
        n_points: usize,
    },
    /// Points that are neither of the plane nor of space.
    #[error("drawable {drawable:?}: points of {dim} coordinates; 2 or 3 can be drawn")]
    Dimension {
        /// Name of the drawable.
        drawable: String,
        /// Coordinates per point.
        dim: usize,
    },
    /// A drawable names a group that its scene does not have.
    #[error("drawable {drawable:?}: group {group} does not exist; the scene has {n_groups} groups")]
    GroupOutOfRange {
        /// Name of the drawable.
        drawable: String,
        /// The group it names.
        group: u32,
        /// How many there are.
        n_groups: usize,
    },
    /// A group lies within too many others.
    #[error("group {group} would be nested deeper than {limit} levels")]
    GroupDepth {
        /// Index that the group would have had.
        group: usize,
        /// Most levels.
        limit: usize,
    },
    /// A drawable has cells for its triangles, segments or dots, but not one each.
    #[error("drawable {drawable:?}: {n_cells} cells are given for {n_elements} elements")]
    ElementCells {
        /// Name of the drawable.
        drawable: String,
        /// Cells given.
        n_cells: usize,
        /// Triangles, segments or dots.
        n_elements: usize,
    },
    /// A camera or view parameter that no picture can be drawn with.
    #[error("view: {parameter} is {value}; it must be {expected}")]
    InvalidView {
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// A picture without pixels, or with more than the adapter can hold.
    #[error(
        "a picture of {width} × {height} pixels cannot be drawn; each side must lie between 1 and {limit} on {adapter}"
    )]
    ImageSize {
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// Largest side.
        limit: u32,
        /// Name of the adapter.
        adapter: String,
    },
    /// More data than one buffer of the adapter holds.
    #[error("the scene's {what} need {bytes} bytes in one buffer; {adapter} allows {limit}")]
    SceneTooLarge {
        /// Which data.
        what: &'static str,
        /// Bytes needed.
        bytes: u64,
        /// Bytes allowed.
        limit: u64,
        /// Name of the adapter.
        adapter: String,
    },
    /// One row of the picture has more transparent layers than a buffer of the adapter holds.
    #[error("one row of samples has {layers} transparent layers; {adapter} has room for {limit}")]
    TooManyLayers {
        /// Layers in the row.
        layers: u32,
        /// Room for them.
        limit: u32,
        /// Name of the adapter.
        adapter: String,
    },
    /// Not a complex that can be shown.
    #[error(transparent)]
    Complex(#[from] lar_core::IntegrationError),
    /// A text that is no view to be shown elsewhere, or a view that cannot be written as one.
    #[error("not a view to be shared: {0}")]
    SharedView(String),
    /// A picture file could not be written.
    #[error(transparent)]
    File(#[from] lar_core::FileError),
    /// A picture could not be encoded.
    #[error("cannot encode the picture as PNG: {0}")]
    Encode(#[from] png::EncodingError),
    /// There is no display to open a window on.
    #[cfg(feature = "window")]
    #[error("no display to open a window on: {0}; off-screen rendering needs none")]
    NoDisplay(String),
    /// The window system refused.
    #[cfg(feature = "window")]
    #[error("the window system reports: {0}")]
    Window(String),
}
