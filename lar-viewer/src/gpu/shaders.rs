//! The shader modules, put together from the files in `src/shaders`.

/// Triangles.
pub(crate) const MESH: &str = concat!(
    include_str!("../shaders/common.wgsl"),
    include_str!("../shaders/layers.wgsl"),
    include_str!("../shaders/store.wgsl"),
    include_str!("../shaders/mesh.wgsl")
);

/// Segments.
pub(crate) const LINES: &str = concat!(
    include_str!("../shaders/common.wgsl"),
    include_str!("../shaders/layers.wgsl"),
    include_str!("../shaders/store.wgsl"),
    include_str!("../shaders/lines.wgsl")
);

/// Dots.
pub(crate) const POINTS: &str = concat!(
    include_str!("../shaders/common.wgsl"),
    include_str!("../shaders/layers.wgsl"),
    include_str!("../shaders/store.wgsl"),
    include_str!("../shaders/points.wgsl")
);

/// Blending of the stored layers.
pub(crate) const RESOLVE: &str = concat!(
    include_str!("../shaders/common.wgsl"),
    include_str!("../shaders/layers.wgsl"),
    include_str!("../shaders/resolve.wgsl")
);

/// Averaging of samples.
pub(crate) const REDUCE: &str =
    concat!(include_str!("../shaders/common.wgsl"), include_str!("../shaders/reduce.wgsl"));

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    fn module(source: &str) -> naga::Module {
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)))
    }

    #[track_caller]
    fn check_entry_points(source: &str, expected: &[&str]) {
        let module = module(source);
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
        let names: Vec<_> = module.entry_points.iter().map(|e| e.name.as_str()).collect();
        assert_eq!(names, expected);
    }

    #[test]
    fn every_shader_is_valid_without_optional_capabilities() {
        check_entry_points(MESH, &["mesh_vertex", "mesh_opaque", "mesh_layer"]);
        check_entry_points(LINES, &["line_vertex", "line_opaque", "line_layer"]);
        check_entry_points(POINTS, &["point_vertex", "point_opaque", "point_layer"]);
        check_entry_points(RESOLVE, &["whole_screen", "resolve"]);
        check_entry_points(REDUCE, &["whole_screen", "reduce"]);
    }

    /// Byte offsets of the members of a WGSL struct, and its size.
    fn layout(source: &str, name: &str) -> (Vec<(String, u32)>, u32) {
        let module = module(source);
        let (_, ty) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).expect("the struct");
        let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is not a struct") };
        (members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect(), *span)
    }

    macro_rules! check_mirror {
        ($rust:ty, $wgsl:literal, $source:expr, [$($field:ident),*]) => {{
            let rust = vec![$((stringify!($field).to_owned(), std::mem::offset_of!($rust, $field) as u32)),*];
            assert_eq!((rust, size_of::<$rust>() as u32), layout($source, $wgsl));
        }};
    }

    #[test]
    fn mirror_structs_have_the_layout_of_the_shaders() {
        use crate::gpu::batch::Part;
        use crate::gpu::frame::Frame;
        check_mirror!(Part, "Part", MESH, [color, centroid, flags]);
        check_mirror!(
            Frame,
            "Frame",
            MESH,
            [
                view_from_scene,
                clip_from_view,
                explode,
                opacity,
                viewport,
                samples_per_pixel,
                sample_size,
                near,
                perspective,
                hide_edges,
                supersample,
                band_row,
                band,
                node_capacity,
                padding
            ]
        );
        assert_eq!(layout(RESOLVE, "Node").1, crate::gpu::layers::NODE_BYTES);
    }
}
