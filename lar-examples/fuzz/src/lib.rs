//! What the fuzz targets do with their bytes. Nothing may panic; what is read must be well formed, and what is written
//! again must read as the same.

use lar_arrangement::planar::{Drawing, planar_arrangement};
use lar_arrangement::{Arranger, Checks, Expression, FillRule};
use lar_core::{
    ChainComplex, MeshFormat, Model, Points, PolygonMesh, Struct, Surface, parse_surface, parse_svg,
};

/// Faces of a scene or segments of a drawing: enough for every degeneracy, few enough to be quick.
const MOST: usize = 24;

/// Bytes as an OBJ file.
pub fn obj(bytes: &[u8]) {
    surface_file(bytes, "fuzz.obj", MeshFormat::Obj);
}

/// Bytes as an STL file, text or binary.
pub fn stl(bytes: &[u8]) {
    surface_file(bytes, "fuzz.stl", MeshFormat::Off);
}

/// Bytes as a PLY file, text or binary.
pub fn ply(bytes: &[u8]) {
    surface_file(bytes, "fuzz.ply", MeshFormat::PlyBigEndian);
}

/// Bytes as an OFF file.
pub fn off(bytes: &[u8]) {
    surface_file(bytes, "fuzz.off", MeshFormat::PlyText);
}

/// What is read is written in a format that rounds nothing, and read again.
fn surface_file(bytes: &[u8], file: &str, format: MeshFormat) {
    let Ok(read) = parse_surface(bytes, file) else { return };
    let violations = read.surface.validate();
    let Ok(written) = read.surface.to_bytes(format) else {
        assert!(!violations.is_empty(), "a well-formed surface cannot be written");
        return;
    };
    let name = match format {
        MeshFormat::Obj => "fuzz.obj",
        MeshFormat::Off => "fuzz.off",
        _ => "fuzz.ply",
    };
    let again = parse_surface(&written, name).expect("what was written can be read").surface;
    assert_eq!(again.points, read.surface.points);
    assert_eq!(again.n_faces(), read.surface.n_faces());
    assert!((0..again.n_faces()).all(|f| again.face(f).eq(read.surface.face(f))));
}

/// Bytes as an SVG drawing; what is drawn is made the input of a planar arrangement.
pub fn svg(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    let Ok(drawing) = parse_svg(text, "fuzz.svg", 0.5) else { return };
    for line in &drawing.polylines {
        assert!(line.points.coords().iter().all(|x| x.is_finite()), "{line:?}");
    }
    let _ = Drawing::from_model(&drawing.to_model());
}

/// Bytes as a model in JSON.
pub fn model(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    let Ok(model) = Model::from_json(text) else { return };
    let _ = model.to_surface("fuzz");
    if model.validate().is_empty() {
        let again = Model::from_json(&model.to_json().expect("a valid model can be written"));
        assert_eq!(again.expect("what was written can be read"), model);
    }
}

/// Bytes as a hierarchy of models in JSON.
pub fn structure(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    let Ok(scene) = Struct::from_json(text) else { return };
    let Ok(placed) = scene.eval_struct() else { return };
    for model in &placed {
        let _ = model.to_surface();
    }
    let written = scene.to_json().expect("a scene that evaluates can be written");
    let again = Struct::from_json(&written).expect("what was written can be read");
    assert_eq!(again.eval_struct().expect("it evaluated before").len(), placed.len());
}

/// Bytes as a chain complex in JSON; all that `lar info` asks of it.
pub fn complex(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    let Ok(complex) = ChainComplex::from_json(text) else { return };
    let _ = (complex.f_vector(), complex.euler_characteristic(), complex.connected_components().n);
    if complex.dim() == 3 && complex.points().dim() == 3 {
        let _ = (complex.validate_with_exterior(), complex.cell_volumes());
    }
    let written = complex.to_json().expect("a complex that was read can be written");
    assert_eq!(
        ChainComplex::from_json(&written).expect("it can be read again").to_json().ok(),
        Some(written)
    );
}

/// Bytes as an expression.
pub fn expression(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    let Ok(expression) = Expression::parse(text, &["A", "B", "C"]) else { return };
    assert!(!expression.operands().is_empty());
    let values: Vec<bool> = (0..8).map(|bits| expression.evaluate(|solid| bits >> solid & 1 == 1)).collect();
    let twice = Expression::parse(&format!("!(!({text}))"), &["A", "B", "C"]).expect("it parsed before");
    assert!((0..8).zip(&values).all(|(bits, &v)| twice.evaluate(|solid| bits >> solid & 1 == 1) == v));
}

/// Numbers out of bytes: mostly small integers, some beside them, some of any size.
struct Numbers<'a>(&'a [u8]);

impl Numbers<'_> {
    fn byte(&mut self) -> Option<u8> {
        let (&first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(first)
    }

    fn coordinate(&mut self) -> Option<f64> {
        let byte = self.byte()?;
        let small = f64::from(byte & 7);
        Some(match byte >> 3 {
            0 => small.next_up(),
            1 => small + 2f64.powi(-38),
            2 => -small / 3.0,
            3 => small * 1e-200,
            4 => f64::from_bits(u64::from(self.byte()?) << 56 | u64::from(byte)),
            _ => small,
        })
    }

    fn point<const D: usize>(&mut self) -> Option<[f64; D]> {
        let mut p = [0.0; D];
        for x in &mut p {
            *x = self.coordinate()?;
        }
        Some(p)
    }
}

/// Bytes as two surfaces of polygons, some with holes; every stage is checked, and Booleans taken.
pub fn arrangement(bytes: &[u8]) {
    let mut numbers = Numbers(bytes);
    let mut surfaces = vec![Surface::new("a", Points::new(3)), Surface::new("b", Points::new(3))];
    for _ in 0..MOST {
        let Some(header) = numbers.byte() else { break };
        let surface = &mut surfaces[usize::from(header & 1)];
        let (n, hole) = (3 + usize::from(header >> 1 & 3), header >> 3 & 7 == 0);
        let mut cycle = |n: usize| -> Option<Vec<u32>> {
            let next = |_| {
                surface.points.push(&numbers.point::<3>()?);
                Some(surface.points.len() as u32 - 1)
            };
            (0..n).map(next).collect()
        };
        let Some(outer) = cycle(n) else { break };
        let inner = if hole { cycle(3) } else { None };
        surface.push_face(std::iter::once(&outer[..]).chain(inner.as_deref()), 1);
    }
    let result = Arranger::new().checks(Checks::EveryStage).arrange(&surfaces);
    let a = match result {
        Err(error @ lar_arrangement::ArrangementError::PostCondition { .. }) => panic!("{error}"),
        Err(_) => return,
        Ok(a) => a,
    };
    for text in ["A | B", "A & B", "A - B", "!A ^ B"] {
        let expression = Expression::parse(text, &["A", "B"]).expect("a fixed text");
        let Ok(solid) = a.boolean(&expression, FillRule::EvenOdd) else { continue };
        for detail in [lar_arrangement::Detail::Fragments, lar_arrangement::Detail::Simplified] {
            assert!(solid.to_complex(detail).is_closed(), "{text}");
        }
    }
}

/// Bytes as segments in the plane.
pub fn planar(bytes: &[u8]) {
    let mut numbers = Numbers(bytes);
    let mut drawing = Drawing::new(Points::new(2));
    while let (Some(p), Some(q)) = (numbers.point::<2>(), numbers.point::<2>()) {
        let ends = [drawing.push_point(p), drawing.push_point(q)];
        drawing.push_segment(ends);
        if drawing.n_segments() == MOST {
            break;
        }
    }
    let Ok(a) = planar_arrangement(&drawing) else { return };
    assert_eq!(a.complex().validate(), []);
    assert_eq!(a.euler(), 0);
}
