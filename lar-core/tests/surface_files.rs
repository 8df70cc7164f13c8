//! Surface files: round trips in every format, forms of the formats, refusals, hostile bytes.

use lar_core::{
    Cells, MeshFormat, Place, Points, PolygonMesh, Precision, Surface, SurfaceViolation, TriangleMesh, Weld,
    cuboid_grid, icosphere, parse_surface, r, read_surface, write_mesh,
};
use proptest::prelude::*;
use std::path::PathBuf;

const READ: [(MeshFormat, &str); 7] = [
    (MeshFormat::Obj, "a.obj"),
    (MeshFormat::StlText, "a.stl"),
    (MeshFormat::StlBinary, "a.stl"),
    (MeshFormat::PlyText, "a.ply"),
    (MeshFormat::PlyLittleEndian, "a.ply"),
    (MeshFormat::PlyBigEndian, "a.ply"),
    (MeshFormat::Off, "a.off"),
];

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures")).join(name)
}

/// The coordinates of every corner, face by face: what is the same however vertices are numbered.
fn corners(surface: &Surface) -> Vec<Vec<[f64; 3]>> {
    let xyz = |&v: &u32| surface.points.xyz(v as usize);
    (0..surface.n_faces()).flat_map(|f| surface.face(f).map(|l| l.iter().map(xyz).collect())).collect()
}

fn single(mesh: &TriangleMesh) -> TriangleMesh {
    let mut mesh = mesh.clone();
    mesh.points.coords_mut().iter_mut().for_each(|x| *x = f64::from(*x as f32) + 0.);
    mesh
}

#[test]
fn round_trips_of_triangles() {
    let ball = icosphere(2).transformed(&r([0.3, 0.2, 0.1])).unwrap();
    for (format, name) in READ {
        let read = parse_surface(&ball.to_bytes(format).unwrap(), name).unwrap();
        let expected = if format == MeshFormat::StlBinary { single(&ball) } else { ball.clone() };
        assert_eq!(read.format, format);
        assert_eq!(corners(&read.surface), corners(&Surface::from_triangles("a", &expected)), "{format:?}");
        assert_eq!((read.surface.points.len(), read.surface.boundary_edges().len()), (162, 0), "{format:?}");
        let text = matches!(format, MeshFormat::StlBinary);
        assert_eq!(read.surface.precision, if text { Precision::F32 } else { Precision::F64 }, "{format:?}");
        let welded = Weld { corners: 960, vertices: 162, collapsed: 0 };
        let stl = matches!(format, MeshFormat::StlBinary | MeshFormat::StlText);
        assert_eq!(read.weld, stl.then_some(welded));
    }
}

#[test]
fn round_trips_of_polygons() {
    let cube = cuboid_grid(&[2, 1, 1]).transformed(&r([1., 2., 3.])).unwrap().to_surface("a").unwrap();
    for (format, name) in READ {
        if format.is_triangular() {
            let message = "face 0 has 1 loops of 4 vertices in all; the format takes triangles";
            assert_eq!(cube.to_bytes(format).unwrap_err().to_string(), message);
        } else {
            let read = parse_surface(&cube.to_bytes(format).unwrap(), name).unwrap().surface;
            assert_eq!(read.points, cube.points);
            assert_eq!(corners(&read), corners(&cube));
        }
    }
    let n = 300_u32;
    let circle: Vec<[f64; 3]> =
        (0..n).map(|i| f64::from(i) / 48.).map(|a| [a.cos(), a.sin(), 1e300]).collect();
    let polygon = Cells::uniform(n as usize, (0..n).collect());
    let disk = Surface::from_polygons("a", Points::from_xyz(&circle), polygon);
    for format in
        [MeshFormat::PlyText, MeshFormat::PlyLittleEndian, MeshFormat::PlyBigEndian, MeshFormat::Off]
    {
        assert_eq!(parse_surface(&disk.to_bytes(format).unwrap(), "a").unwrap().surface, disk);
    }
}

#[test]
fn files_by_extension() {
    let dir = tempfile::tempdir().unwrap();
    let ball = single(&icosphere(1));
    for name in ["b.obj", "b.STL", "b.ply", "b.off"] {
        let path = dir.path().join(name);
        write_mesh(&path, &ball).unwrap();
        let read = read_surface(&path).unwrap();
        assert_eq!(read.surface.name, "b");
        assert_eq!(corners(&read.surface), corners(&Surface::from_triangles("b", &ball)), "{name}");
    }
    for name in ["b.gltf", "b.glb"] {
        let path = dir.path().join(name);
        write_mesh(&path, &ball).unwrap();
        let refused = read_surface(&path).unwrap_err().to_string();
        assert!(refused.ends_with("glTF files are written, not read"), "{refused}");
    }
    let refused = write_mesh(dir.path().join("b.step"), &ball).unwrap_err().to_string();
    assert!(refused.ends_with("extension \"step\" is none of obj, stl, ply, off, gltf, glb"), "{refused}");
    assert!(read_surface(dir.path().join("none.stl")).unwrap_err().to_string().contains("cannot read"));
    assert!(read_surface(dir.path()).is_err());
}

#[track_caller]
fn check_fixture(name: &str, format: MeshFormat, vertices: usize, faces: usize, precision: Precision) {
    let read = read_surface(fixture(name)).unwrap();
    assert_eq!((read.format, read.surface.precision), (format, precision));
    assert_eq!((read.surface.points.len(), read.surface.n_faces()), (vertices, faces));
    assert_eq!(read.surface.boundary_edges(), []);
    assert_eq!(read.surface.validate(), []);
}

#[test]
fn fixtures() {
    let short = Precision::Decimal { significant: 2, last_place: -1 };
    check_fixture("tetrahedron_solid_header.stl", MeshFormat::StlBinary, 4, 4, Precision::F32);
    check_fixture(
        "two_solids.stl",
        MeshFormat::StlText,
        8,
        8,
        Precision::Decimal { significant: 7, last_place: -6 },
    );
    check_fixture("cube_extras.ply", MeshFormat::PlyText, 8, 6, short);
    check_fixture("cube_big_endian.ply", MeshFormat::PlyBigEndian, 8, 6, Precision::F32);
    check_fixture("cube_colours.off", MeshFormat::Off, 8, 6, short);
}

#[test]
fn welding_reports_what_it_left_out() {
    let mut points = vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    points.extend([[-0., 0., 0.], [0., 1., 0.], [1e-60, 0., 0.]]);
    let mesh = TriangleMesh { points: Points::from_xyz(&points), triangles: vec![[0, 1, 2], [3, 4, 5]] };
    let read = parse_surface(&mesh.to_bytes(MeshFormat::StlBinary).unwrap(), "a.stl").unwrap();
    assert_eq!(read.weld, Some(Weld { corners: 6, vertices: 3, collapsed: 1 }));
    assert_eq!(read.surface.n_faces(), 1);
}

#[track_caller]
fn check_refused(text: &str, name: &str, expected: &str) {
    let found = parse_surface(text.as_bytes(), name).unwrap_err().to_string();
    assert_eq!(found, format!("{name}: {expected}"));
}

/// CAD programs write one header a solid, also in the binary form.
#[test]
fn several_solids_in_one_binary_file() {
    let ball = icosphere(0).to_bytes(MeshFormat::StlBinary).unwrap();
    let mut other = ball.clone();
    // The x coordinates of all corners moved, so that nothing is welded across.
    for corner in (0..20).flat_map(|f| (0..3).map(move |k| 84 + 50 * f + 12 * (k + 1))) {
        let x = f32::from_le_bytes(other[corner..corner + 4].try_into().unwrap());
        other[corner..corner + 4].copy_from_slice(&(x + 4.0).to_le_bytes());
    }
    let both = parse_surface(&[&ball[..], &other].concat(), "a.stl").unwrap();
    assert_eq!((both.format, both.surface.n_faces()), (MeshFormat::StlBinary, 40));
    assert_eq!(both.surface.points.len(), 24);
    let refused = |bytes: Vec<u8>| parse_surface(&bytes, "a.stl").unwrap_err().to_string();
    let cut = refused([&ball[..], &other[..1000]].concat());
    assert_eq!(
        cut,
        "a.stl: byte 1164: 20 facets are announced, which takes 2168 bytes, but the file has 2084"
    );
    // A second header without facets, with and without bytes behind it.
    let empty = [0; 84];
    assert!(refused([&ball[..], &empty].concat()).contains("byte 80: 20 facets are announced"));
    assert!(refused([&ball[..], &empty, &ball[84..]].concat()).contains("byte 1164: 0 facets are announced"));
}

/// Names and comments in Latin-1; the mark that some editors put before UTF-8; UTF-16 by its mark.
#[test]
fn encodings_of_text() {
    let stl = "solid gr\u{fc}n\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
               endloop\nendfacet\nendsolid gr\u{fc}n\n";
    let off = "OFF # gr\u{fc}n\n3 1 0\n0 0 0\n1 0 0 # gr\u{fc}n\n0 1 0\n3 0 1 2\n";
    let ply = HEADER.replace("1.0\n", "1.0\ncomment gr\u{fc}n\n") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (text, file) in [(stl, "a.stl"), (off, "a.off"), (&ply[..], "a.ply")] {
        let latin: Vec<u8> = text.chars().map(|c| u8::try_from(c).unwrap()).collect();
        let marked = [b"\xef\xbb\xbf", text.as_bytes()].concat();
        for bytes in [&latin, &marked] {
            let read = parse_surface(bytes, file).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!((read.surface.n_faces(), read.surface.points.len()), (1, 3), "{file}");
        }
        let wide: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert!(parse_surface(&wide, file).is_err(), "{file}");
    }
    let wide: Vec<u8> = "\u{feff}OFF\n3 1 0\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let refused = parse_surface(&wide, "a.off").unwrap_err();
    assert_eq!(refused.to_string(), "a.off: line 1: not UTF-8 text");
}

#[test]
fn refusals_of_stl() {
    let stl = |text: &str, expected: &str| check_refused(text, "a.stl", expected);
    stl("", "byte 0: the file ends where an STL header of 84 bytes is needed");
    stl("solid\nendsolid", "byte 14: no faces");
    stl("solid\nfacet", "line 2: \"\" where normal is needed");
    stl(
        "solid a\nfacet normal 0 0 1\n outer loop\n",
        "line 3: the file ends where vertex or endloop is needed",
    );
    let open = "solid\nfacet normal nan 0 1 outer loop\nvertex 0 0 0\n";
    stl(&format!("{open}vertex 0 0\n"), "line 4: \"\" where a coordinate is needed");
    stl(&format!("{open}vertex 0 0 1e999\n"), "line 4: coordinate 1e999 is not finite");
    stl(&format!("{open}vertex 0 x 0\n"), "line 4: \"x\" where a coordinate is needed");
    stl(&format!("{open}endloop\n"), "line 4: a face of 1 vertices where 3 are needed");
    stl(&format!("{open}endfacet\n"), "line 4: \"endfacet\" where vertex or endloop is needed");
    stl(&format!("{open}è"), "line 4: \"è\" where vertex or endloop is needed");
    let bytes = icosphere(0).to_bytes(MeshFormat::StlBinary).unwrap();
    let refused = |bytes: &[u8]| parse_surface(bytes, "a.stl").unwrap_err().to_string();
    let announced = "a.stl: byte 80: 20 facets are announced, which takes 1084 bytes, but the file has";
    assert_eq!(refused(&bytes[..1000]), format!("{announced} 1000"));
    assert_eq!(refused(&[&bytes[..], b"\n"].concat()), format!("{announced} 1085"));
    let mut broken = bytes.clone();
    broken[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(refused(&broken), "a.stl: byte 134: coordinate NaN is not finite");
    let mut many = bytes;
    many[80..84].fill(255);
    assert!(refused(&many).contains("4294967295 facets are announced, which takes 214748364834 bytes"));
}

const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                      property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

#[test]
fn refusals_of_ply() {
    let ply = |text: &str, expected: &str| check_refused(text, "a.ply", expected);
    let swap = |from: &str, to: &str| {
        assert!(HEADER.contains(from));
        format!("{}0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", HEADER.replacen(from, to, 1))
    };
    assert!(parse_surface(swap("ply", "ply").as_bytes(), "a.ply").is_ok());
    assert!(parse_surface(swap("ply", "ply").replace('\n', "\r\n").as_bytes(), "a.ply").is_ok());
    ply("ply\n", "line 1: the file ends where end_header is needed");
    ply("x", "line 1: \"x\" where ply is needed");
    ply(&swap("1.0", "2.0"), "line 2: a version other than 1.0 is not supported: \"2.0\"");
    ply(
        &swap("ascii", "utf8"),
        "line 2: \"utf8\" where ascii, binary_little_endian or binary_big_endian is needed",
    );
    ply(&swap("format ascii 1.0\n", ""), "line 8: \"end_header\" where format is needed");
    ply(&swap("element vertex 3\n", ""), "line 3: \"property\" where an element first is needed");
    ply(&swap("vertex 3", "vertex -3"), "line 3: \"-3\" where the number of items is needed");
    ply(&swap("float x", "half x"), "line 4: \"half\" where a number type is needed");
    ply(&swap("float x", "float w"), "line 9: \"end_header\" where an element vertex with x, y, z is needed");
    ply(&swap("float y", "float x"), "line 5: a property twice is not supported: \"property float x\"");
    ply(
        &swap("int vertex", "float vertex"),
        "line 9: \"end_header\" where an element face with vertex_indices is needed",
    );
    ply(
        &swap("list uchar", "list float"),
        "line 8: \"F32\" where an integer type for the length of a list is needed",
    );
    ply(&swap("element face", "element vertex"), "line 7: an element twice is not supported: \"vertex\"");
    let announced = "items of an element are announced, which takes";
    ply(
        &swap("vertex 3", "vertex 4000000000"),
        &format!("byte 163: 4000000000 {announced} 23999999999 bytes, but the file has 26"),
    );
    ply(&swap("face 1", "face 9"), &format!("byte 172: 9 {announced} 17 bytes, but the file has 8"));
    ply(&swap("face 1", "face 0"), "byte 172: no faces");
    let items = |text: &str, expected: &str| ply(&format!("{HEADER}{text}"), expected);
    items("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 13: vertex 3 of 3");
    items("0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 13: vertex -1 of 3");
    items("0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "line 13: a face of 2 vertices where 3 are needed");
    items("0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", "line 13: \"\" where an item of a list is needed");
    items("0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", "line 11: coordinate inf is not finite");
    items("0 0 0\n1 0      \n0 1 0\n", "line 11: \"\" where a coordinate is needed");
    let bytes = icosphere(0).to_bytes(MeshFormat::PlyBigEndian).unwrap();
    let start = bytes.len() - 20 * 13;
    let refused = |at: usize, new: &[u8]| {
        let mut broken = bytes.clone();
        broken[at..at + new.len()].copy_from_slice(new);
        parse_surface(&broken, "a.ply").unwrap_err().to_string()
    };
    // Of the first face: the length of its list is byte `start`, its first vertex the four bytes behind.
    let vertex = refused(start + 1, &[255, 0, 0, 9]);
    assert_eq!(vertex, format!("a.ply: byte {}: vertex 4278190089 of 12", start + 1));
    assert_eq!(
        refused(bytes.len() - 13, &[255]),
        format!(
            "a.ply: byte {}: 255 items of a list are announced, which takes 1020 bytes, but the file has 12",
            bytes.len() - 13
        )
    );
    assert_eq!(
        refused(start - 8, &f64::NAN.to_be_bytes()),
        format!("a.ply: byte {}: coordinate NaN is not finite", start - 8)
    );
}

#[test]
fn refusals_of_off() {
    let off = |text: &str, expected: &str| check_refused(text, "a.off", expected);
    off("", "line 1: the file ends where OFF is needed");
    off("4OFF\n1 1 1", "line 1: this kind of OFF is not supported: \"4OFF\"");
    off("OFF BINARY\n", "line 1: OFF in binary is not supported: \"OFF BINARY\"");
    off("off\n", "line 1: \"off\" where OFF is needed");
    off("OFF\n# c\n\n4000000000 1 0\n0 0 0\n", "line 5: the file ends where a vertex is needed");
    off("OFF 1 -1 0\n", "line 1: \"-1\" where the number of faces is needed");
    off("OFF 1 0 0\n0 0 0\n", "line 2: no faces");
    let items =
        |text: &str, expected: &str| off(&format!("NOFF 3 1 0\n0 0 0 1 1\n1 0 0\n0 1 0\n{text}"), expected);
    items("3 0 1 3", "line 5: vertex 3 of 3");
    items("4 0 1 2", "line 5: \"\" where a vertex is needed");
    items("2 0 1", "line 5: a face of 2 vertices where 3 are needed");
    items("3 0 1 1.5", "line 5: \"1.5\" where a vertex is needed");
}

#[test]
fn refusals_to_write() {
    let mut mesh = icosphere(0);
    mesh.triangles[3][1] = 99;
    for (format, _) in READ {
        assert_eq!(mesh.to_bytes(format).unwrap_err().to_string(), "face 3 names vertex 99 of 12");
    }
    mesh.points.coords_mut()[5] = 1e39;
    let far = mesh.to_bytes(MeshFormat::StlBinary).unwrap_err().to_string();
    assert!(
        far.starts_with("coordinate 2 of vertex v1 is 1") && far.ends_with("which the format cannot hold")
    );
    let mut holed = Surface::new("a", icosphere(0).points);
    holed.push_face([&[0, 1, 2][..], &[3, 4, 5][..]], 1);
    let message = "face 0 has 2 loops of 6 vertices in all; the format takes polygons of one loop";
    assert_eq!(holed.to_bytes(MeshFormat::Off).unwrap_err().to_string(), message);
}

#[test]
fn unknown_names_are_told_by_content() {
    let ball = icosphere(0);
    for (format, _) in READ {
        let read = parse_surface(&ball.to_bytes(format).unwrap(), "a.dat");
        assert_eq!(read.is_ok(), format != MeshFormat::Obj, "{format:?}");
    }
    assert!(parse_surface(b"", "").unwrap_err().to_string().contains("extension \"\" is none of"));
}

#[test]
fn places() {
    assert_eq!((Place::Line(3).to_string(), Place::Byte(0).to_string()), ("line 3".into(), "byte 0".into()));
}

fn surface_strategy() -> impl Strategy<Value = TriangleMesh> {
    let coordinate = prop_oneof![-3_i8..4].prop_map(f64::from);
    (prop::collection::vec(coordinate, 30), prop::collection::vec(prop::array::uniform3(0..10_u32), 1..20))
        .prop_map(|(coords, triangles)| TriangleMesh { points: Points::from_columns(3, coords), triangles })
}

proptest! {
    #[test]
    fn any_mesh_reads_back(mesh in surface_strategy(), which in 0..READ.len()) {
        let (format, name) = READ[which];
        let expected = corners(&Surface::from_triangles("a", &mesh));
        let distinct = |t: &Vec<[f64; 3]>| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        match parse_surface(&mesh.to_bytes(format).unwrap(), name) {
            Ok(read) if read.weld.is_some() => {
                let kept: Vec<_> = expected.iter().filter(|t| distinct(t)).cloned().collect();
                prop_assert_eq!(corners(&read.surface), kept);
            }
            Ok(read) => prop_assert_eq!(corners(&read.surface), expected),
            Err(refused) => {
                prop_assert!(!expected.iter().any(distinct) && refused.to_string().ends_with("no faces"));
            }
        }
    }

    #[test]
    fn truncated_files_are_refused_or_shorter(cut in 0.0..1.0_f64, which in 0..READ.len()) {
        let (format, name) = READ[which];
        let bytes = icosphere(1).to_bytes(format).unwrap();
        let cut = (cut * (bytes.len() - 1) as f64) as usize;
        let text = matches!(format, MeshFormat::Obj | MeshFormat::Off | MeshFormat::PlyText | MeshFormat::StlText);
        let read = parse_surface(&bytes[..cut], name);
        prop_assert!(text || read.is_err());
        if let Ok(read) = read {
            prop_assert!(read.surface.n_faces() <= 80);
            // The last number of a text may have lost digits: its face may then name one vertex twice.
            let last = read.surface.n_faces().saturating_sub(1);
            let is_cut = |v: &SurfaceViolation| {
                matches!(v, SurfaceViolation::ShortLoop { face, .. } | SurfaceViolation::RepeatedVertex { face, .. }
                    if face.index() == last)
            };
            let violations = read.surface.validate();
            prop_assert!(violations.iter().all(is_cut), "{violations:?}");
        }
    }

    #[test]
    fn mutated_files_do_not_panic(
        which in 0..READ.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
        inserts in prop::collection::vec((any::<prop::sample::Index>(), prop::collection::vec(any::<u8>(), 0..8)), 0..3),
    ) {
        let (format, name) = READ[which];
        let mut bytes = icosphere(0).to_bytes(format).unwrap();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        for (at, more) in inserts {
            let at = at.index(bytes.len());
            bytes.splice(at..at, more);
        }
        if let Ok(read) = parse_surface(&bytes, name) {
            prop_assert_eq!(read.surface.points.non_finite().count(), 0);
            let n = read.surface.points.len();
            prop_assert!(corners(&read.surface).len() == read.surface.n_faces() && n <= bytes.len());
        }
    }

    #[test]
    fn random_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), which in 0..READ.len()) {
        let _ = parse_surface(&bytes, READ[which].1);
    }

    #[test]
    fn random_words_do_not_panic(
        words in "((OFF|ply|solid|facet normal|vertex|element face|property list uchar int|end_header|[0-9.-]{1,5}|3)[ \n]){0,40}",
        start in prop_oneof!["OFF 2 2 0\n", "ply\nformat ascii 1.0\n", "solid\n"],
        which in 0..READ.len(),
    ) {
        let _ = parse_surface((start + &words).as_bytes(), READ[which].1);
    }
}
