//! The shader modules, put together from the files in `src/shaders`.
//!
//! Each kind of geometry has a module for what is drawn with a depth test, one that stores layers in lists, and one that
//! sums them.

/// The pieces of a module, one after the other.
macro_rules! module {
    ($($piece:literal),*) => { concat!($(include_str!(concat!("../shaders/", $piece, ".wgsl"))),*) };
}

/// The modules of one kind of geometry.
pub(crate) struct Sources {
    /// Opaque pass and id pass.
    pub(crate) solid: &'static str,
    /// Layers in lists.
    pub(crate) layer: &'static str,
    /// Layers as sums.
    pub(crate) weighted: &'static str,
}

/// Triangles.
pub(crate) const MESH: Sources = Sources {
    solid: module!("common", "mesh"),
    layer: module!("common", "mesh", "layers", "store", "mesh_layer"),
    weighted: module!("common", "mesh", "weighted", "mesh_layer"),
};

/// Segments.
pub(crate) const LINES: Sources = Sources {
    solid: module!("common", "lines"),
    layer: module!("common", "lines", "layers", "store", "lines_layer"),
    weighted: module!("common", "lines", "weighted", "lines_layer"),
};

/// Dots.
pub(crate) const POINTS: Sources = Sources {
    solid: module!("common", "points"),
    layer: module!("common", "points", "layers", "store", "points_layer"),
    weighted: module!("common", "points", "weighted", "points_layer"),
};

/// Strokes of labels.
pub(crate) const LABELS: Sources = Sources {
    solid: module!("common", "labels"),
    layer: module!("common", "labels", "layers", "store", "labels_layer"),
    weighted: module!("common", "labels", "weighted", "labels_layer"),
};

/// Blending of the stored layers.
pub(crate) const RESOLVE: &str = module!("common", "screen", "layers", "resolve");

/// Blending of the sums of layers.
pub(crate) const COMPOSE: &str = module!("common", "screen", "compose");

/// Averaging of samples.
pub(crate) const REDUCE: &str = module!("common", "screen", "reduce");

/// Outlines of what the solid pass found.
pub(crate) const OUTLINE: &str = module!("common", "screen", "outline");

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    fn module(source: &str) -> naga::Module {
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)))
    }

    #[track_caller]
    fn check_entry_points<S: AsRef<str>>(source: &str, expected: &[S]) {
        let module = module(source);
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
        let names: Vec<_> = module.entry_points.iter().map(|e| e.name.as_str()).collect();
        assert_eq!(names, expected.iter().map(AsRef::as_ref).collect::<Vec<_>>());
    }

    #[test]
    fn every_shader_is_valid_without_optional_capabilities() {
        for (sources, name) in [(MESH, "mesh"), (LINES, "line"), (POINTS, "point"), (LABELS, "label")] {
            let mut vertex: Vec<_> =
                ["opaque", "layer", "id"].map(|way| format!("{name}_{way}_vertex")).into();
            let mut solid = vec![format!("{name}_opaque"), format!("{name}_id")];
            if name == "mesh" {
                vertex.push("mesh_solid_vertex".to_owned());
                solid.insert(1, "mesh_solid".to_owned());
            }
            check_entry_points(sources.solid, &[&vertex[..], &solid].concat());
            let layer = [&vertex[..], &solid, &[format!("{name}_layer")]].concat();
            check_entry_points(sources.layer, &layer);
            check_entry_points(sources.weighted, &layer);
            assert!(!sources.weighted.contains("var<storage"), "{name} needs storage buffers");
        }
        check_entry_points(COMPOSE, &["whole_screen", "compose"]);
        check_entry_points(RESOLVE, &["whole_screen", "resolve"]);
        check_entry_points(REDUCE, &["whole_screen", "reduce"]);
        check_entry_points(OUTLINE, &["whole_screen", "outline"]);
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
        use crate::gpu::frame::Frame;
        check_mirror!(
            Frame,
            "Frame",
            MESH.solid,
            [
                view_from_scene,
                clip_from_view,
                explode,
                about,
                opacity,
                cut,
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
                cut_groups,
                first_part,
                outlined_level,
                outline_reach,
                padding,
                outline_color
            ]
        );
        assert_eq!(layout(RESOLVE, "Node").1, crate::gpu::layers::NODE_BYTES);
    }

    /// The value of a `u32` constant of a module.
    fn constant(source: &str, name: &str) -> u32 {
        let line = source.lines().find_map(|l| l.strip_prefix(&format!("const {name}: u32 = ")));
        let value = line.and_then(|l| l.split_once("u;")).expect("the constant").0;
        let hexadecimal = value.strip_prefix("0x").map(|digits| u32::from_str_radix(digits, 16));
        hexadecimal.unwrap_or_else(|| value.parse()).expect("a number")
    }

    #[test]
    fn constants_are_those_of_the_shaders() {
        use crate::gpu::{parts, table};
        assert_eq!(constant(MESH.solid, "LIT"), parts::LIT);
        assert_eq!(constant(MESH.solid, "CELL_EDGE"), parts::CELL_EDGE);
        assert_eq!(constant(MESH.solid, "HIGHLIGHTED"), parts::HIGHLIGHTED);
        assert_eq!(constant(MESH.solid, "CLIPPED"), parts::CLIPPED);
        assert_eq!(constant(MESH.solid, "NO_GROUP"), parts::NO_GROUP);
        assert_eq!(constant(MESH.solid, "WHOLE"), crate::gpu::frame::WHOLE);
        assert_eq!(constant(MESH.solid, "TABLE_WIDTH"), table::WIDTH);
    }
}
