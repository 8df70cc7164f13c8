//! One entry for all formats: which one a file is in, and the reader or writer for it.

use super::error::MeshFileError;
#[cfg(doc)]
use super::error::Problem;
use super::polygons::PolygonMesh;
use super::source::{MARK, Source};
use super::weld::Weld;
use super::{gltf, off, ply, polygons, stl};
use crate::atomic_write::read;
use crate::obj;
use crate::{FileError, ObjGrouping, Surface, atomic_write};
use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read, Write};
use std::path::Path;

/// A format of surface files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// STL as text.
    StlText,
    /// STL in binary, 32-bit numbers.
    StlBinary,
    /// PLY as text.
    PlyText,
    /// PLY in binary, least significant byte first.
    PlyLittleEndian,
    /// PLY in binary, most significant byte first.
    PlyBigEndian,
    /// Object File Format of Geomview.
    Off,
    /// glTF 2.0 as JSON with the buffer inside; written only.
    Gltf,
    /// glTF 2.0 in its binary container; written only.
    Glb,
}

impl MeshFormat {
    /// The format that a path's extension stands for; `stl` and `ply` stand for their binary forms.
    ///
    /// ```
    /// use lar_core::MeshFormat;
    /// assert_eq!(MeshFormat::of_path("part.STL"), Some(MeshFormat::StlBinary));
    /// assert_eq!(MeshFormat::of_path("part.step"), None);
    /// ```
    #[must_use]
    pub fn of_path(path: impl AsRef<Path>) -> Option<Self> {
        match extension(path.as_ref()).to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::StlBinary),
            "ply" => Some(Self::PlyLittleEndian),
            "off" => Some(Self::Off),
            "gltf" => Some(Self::Gltf),
            "glb" => Some(Self::Glb),
            _ => None,
        }
    }

    /// True when faces of the format are triangles.
    #[must_use]
    pub fn is_triangular(self) -> bool {
        matches!(self, Self::StlText | Self::StlBinary | Self::Gltf | Self::Glb)
    }
}

/// What a surface file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceFile {
    /// The faces, all of coefficient +1, named by the file.
    pub surface: Surface,
    /// The format found.
    pub format: MeshFormat,

    /// What welding did, for formats that repeat the coordinates of each corner (STL).
    pub weld: Option<Weld>,
}

/// Reads a surface from an OBJ, STL, PLY or OFF file. The content decides first (`ply`, `OFF`, an STL count
/// that fits the length), the extension where the content does not say. O(size of the file); a closed mesh
/// takes less memory than its STL file, a soup of separate triangles at most about twice as much.
///
/// # Errors
/// When the file cannot be read, is malformed or has no faces; see [`Problem`].
///
/// ```
/// use lar_core::{icosphere, read_surface, write_mesh};
/// let path = std::env::temp_dir().join(format!("lar-ball-{}.stl", std::process::id()));
/// write_mesh(&path, &icosphere(1))?;
/// let ball = read_surface(&path)?;
/// assert_eq!((ball.surface.n_faces(), ball.surface.points.len()), (80, 42));
/// assert_eq!(ball.weld.unwrap().corners, 240);
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), lar_core::MeshFileError>(())
/// ```
pub fn read_surface(path: impl AsRef<Path>) -> Result<SurfaceFile, MeshFileError> {
    const BUFFER: usize = 1 << 18;
    let path = path.as_ref();
    let failed = |source| FileError { path: path.to_owned(), action: "read", source };
    let file = File::open(path).map_err(failed)?;
    let data = file.metadata().map_err(failed)?;
    if !data.is_file() {
        // A pipe has no length: its bytes are gathered first.
        let mut bytes = Vec::new();
        BufReader::new(file).read_to_end(&mut bytes).map_err(failed)?;
        return parse_surface(&bytes, path);
    }
    let mut input = BufReader::with_capacity(BUFFER, file);
    let head = head(&mut input).map_err(failed)?;
    match detect(&head, data.len(), path)? {
        MeshFormat::Obj => parse_surface(&read(path)?, path),
        format => read_as(format, &mut Source::new(path, &mut input, data.len())),
    }
}

/// Reads a surface from the bytes of a file; `file` is for the format, the name and messages. O(size).
///
/// # Errors
/// As [`read_surface`].
///
/// ```
/// use lar_core::{MeshFormat, parse_surface};
/// let text = b"OFF 3 1 0\n0 0 0\n1 0 0\n0 0.5 0\n3 0 1 2\n";
/// let read = parse_surface(text, "triangle.off")?;
/// assert_eq!((read.surface.name.as_str(), read.format), ("triangle", MeshFormat::Off));
/// # Ok::<(), lar_core::MeshFileError>(())
/// ```
pub fn parse_surface(bytes: &[u8], file: impl AsRef<Path>) -> Result<SurfaceFile, MeshFileError> {
    let file = file.as_ref();
    let len = bytes.len() as u64;
    let mut input = Cursor::new(bytes);
    let format = detect(&bytes[..bytes.len().min(HEAD)], len, file)?;
    let mut source = Source::new(file, &mut input, len);
    if format != MeshFormat::Obj {
        return read_as(format, &mut source);
    }
    let surface = only(obj::parse(bytes, file, ObjGrouping::Whole)?);
    Ok(SurfaceFile { surface, format, weld: None })
}

/// Writes a surface or triangle mesh in the format that the extension stands for, whole or not at all:
/// polygons as OBJ, PLY (binary, 64-bit) and OFF, triangles also as STL (binary) and glTF. What is read back
/// is the same surface, up to rounding to 32 bits in STL and glTF. O(size).
///
/// # Errors
/// When the extension is unknown, a face does not fit the format, a coordinate cannot be held, or the file
/// cannot be written.
///
/// ```no_run
/// lar_core::write_mesh("ball.ply", &lar_core::icosphere(3))?;
/// # Ok::<(), lar_core::MeshFileError>(())
/// ```
pub fn write_mesh(path: impl AsRef<Path>, mesh: &impl PolygonMesh) -> Result<(), MeshFileError> {
    let path = path.as_ref();
    let format = MeshFormat::of_path(path).ok_or_else(|| unknown(path))?;
    let bytes_of_gltf = match format {
        MeshFormat::Gltf | MeshFormat::Glb => Some(gltf::of_mesh(mesh, format, path)?),
        _ => None,
    };
    polygons::check(mesh, format)?;
    atomic_write(path, |out| match bytes_of_gltf {
        Some(bytes) => out.write_all(&bytes),
        None => write_as(mesh, format, out),
    })?;
    Ok(())
}

/// Writes a checked mesh in any format but glTF.
pub(crate) fn write_as(
    mesh: &impl PolygonMesh,
    format: MeshFormat,
    out: &mut dyn Write,
) -> std::io::Result<()> {
    match format {
        MeshFormat::StlBinary => stl::write_binary(mesh, out),
        MeshFormat::StlText => stl::write_text(mesh, out),
        MeshFormat::PlyText | MeshFormat::PlyLittleEndian | MeshFormat::PlyBigEndian => {
            ply::write(mesh, format, out)
        }
        MeshFormat::Off => off::write(mesh, out),
        MeshFormat::Obj | MeshFormat::Gltf | MeshFormat::Glb => polygons::write_obj(mesh, out),
    }
}

/// Bytes of the beginning that decide the format.
const HEAD: usize = 512;

fn head(input: &mut impl BufRead) -> std::io::Result<Vec<u8>> {
    let ahead = input.fill_buf()?;
    Ok(ahead[..ahead.len().min(HEAD)].to_vec())
}

fn detect(head: &[u8], len: u64, file: &Path) -> Result<MeshFormat, MeshFileError> {
    let by_name = MeshFormat::of_path(file);
    let text = head.strip_prefix(MARK).unwrap_or(head);
    if text.starts_with(b"ply\n") || text.starts_with(b"ply\r") {
        return Ok(MeshFormat::PlyText);
    }
    if head.starts_with(b"glTF") || matches!(by_name, Some(MeshFormat::Gltf | MeshFormat::Glb)) {
        return Err(MeshFileError::WriteOnly { file: file.to_owned() });
    }
    if off::is_header(text) {
        return Ok(MeshFormat::Off);
    }
    match by_name {
        Some(MeshFormat::StlBinary) => Ok(stl::form(head, len)),
        None if stl::announced(head).is_some_and(|n| stl::binary_len(n) == len) => Ok(MeshFormat::StlBinary),
        None if text.starts_with(b"solid") => Ok(MeshFormat::StlText),
        Some(format) => Ok(format),
        None => Err(unknown(file)),
    }
}

fn read_as(format: MeshFormat, source: &mut Source<'_>) -> Result<SurfaceFile, MeshFileError> {
    match format {
        MeshFormat::StlBinary => stl::read_binary(source),
        MeshFormat::StlText => stl::read_text(source),
        MeshFormat::Off => off::read(source),
        _ => ply::read(source),
    }
}

fn unknown(file: &Path) -> MeshFileError {
    MeshFileError::UnknownFormat { file: file.to_owned(), extension: extension(file) }
}

fn extension(path: &Path) -> String {
    path.extension().map_or_else(String::new, |e| e.to_string_lossy().into_owned())
}

fn only(surfaces: Vec<Surface>) -> Surface {
    surfaces.into_iter().next().expect("reading as a whole gives one surface")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::icosphere;
    use proptest::prelude::*;
    use proptest::sample::Index;

    /// Texts with the usual lines and others between them.
    const TEXTS: [(&str, &str, &str); 4] = [
        (
            "a.obj",
            "",
            "v 0 0 0\nv 1.5e0 0 0 1\r\nv 0 1 -0.25\nv\t0 -0 1e+00 0.5 .5 5e-1\nvt 0 0\nvn 0 0 1 # up\n\ng top  side\n\
             f 1 2 3\n# f 1 2\nf 1/1/1 2/1/1 4//1\n  f 1 3 2\nf -1 -2 -3\nf 1 3 \\\n4\nf 2 3/1 4/ \nf 1 +2 5\nv 9 9 9",
        ),
        (
            "a.stl",
            "solid a  b c\n",
            "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1.25 0 -0.0\n  vertex 0 1e-01 0\n endloop\n\
             endfacet\nfacet normal nan nan nan\nouter loop vertex 0 0 0\nvertex 1 0 0\r\nvertex 0 0 7\nendloop endfacet\n\
             FACET NORMAL 0 0 0\r\nOuter Loop\r\nvertex 1 2 3\r\nvertex 1 2 4\r\nvertex 1 2 4\r\nendloop\r\nendfacet\r\n\
             endsolid\nsolid\nfacet normal 1 2 3\nouter loop\nvertex 0 0 0\nvertex 0.5 0 0\nvertex 0 0.5 0\nendloop\n\
             endfacet\nendsolid",
        ),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             property uchar red\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n",
            "0 0 0 255\n1 0 -0.5 7 \n0 1.125 0 x\r\n0 0 1e0 0 more\n3 0 1 2\n4 0 2 3 1 7\n3 1  2 3",
        ),
        (
            "a.off",
            "OFF # faces\n4 4 0\n",
            "0 0 0\n# c\n1 0 -0.5 255 0 0\n\n0 1.125 0\r\n 0 0 1e0 # last\n3 0 1 2\n3 0 2 3 7 7 7\n4\t0 1 2 3\n3 1 2 3",
        ),
    ];

    fn outcome(read: Result<SurfaceFile, MeshFileError>) -> Result<SurfaceFile, String> {
        read.map_err(|error| error.to_string())
    }

    /// The words of each line parted by vertical tabs, which no usual line has.
    fn unusual(text: &[u8]) -> Vec<u8> {
        let line = |line: &[u8]| {
            let indent = line.len() - line.trim_ascii_start().len();
            let (indent, words) = line.split_at(indent);
            [indent, &words.iter().map(|&b| if b == b' ' { b'\x0b' } else { b }).collect::<Vec<_>>()].concat()
        };
        text.split(|&byte| byte == b'\n').map(line).collect::<Vec<_>>().join(&b'\n')
    }

    /// What is read of the body, is read of it without usual lines.
    #[track_caller]
    fn check(name: &str, head: &str, body: &[u8]) {
        let read = |body: &[u8]| outcome(parse_surface(&[head.as_bytes(), body].concat(), name));
        assert_eq!(read(body), read(&unusual(body)), "{name}: {:?}", String::from_utf8_lossy(body));
    }

    #[test]
    fn usual_lines_are_read_like_others_wherever_the_text_ends() {
        for (name, head, body) in TEXTS {
            let body = body.as_bytes();
            assert!(parse_surface(&[head.as_bytes(), body].concat(), name).is_ok(), "{name}");
            (0..=body.len()).for_each(|cut| check(name, head, &body[..cut]));
        }
    }

    #[test]
    fn buffers_of_any_size() {
        let texts = TEXTS[1..].iter().map(|(name, head, body)| (*name, [*head, *body].concat().into_bytes()));
        let binary = [("b.stl", MeshFormat::StlBinary), ("b.ply", MeshFormat::PlyBigEndian)];
        let binary = binary.map(|(name, format)| (name, icosphere(0).to_bytes(format).unwrap()));
        for (name, bytes) in texts.chain(binary) {
            let whole = parse_surface(&bytes, name).unwrap();
            for n in 1..=bytes.len() {
                let mut input = BufReader::with_capacity(n, &bytes[..]);
                let mut source = Source::new(Path::new(name), &mut input, bytes.len() as u64);
                assert_eq!(read_as(whole.format, &mut source).unwrap(), whole, "{name}, {n} bytes");
            }
        }
    }

    proptest! {
        #[test]
        fn usual_lines_are_read_like_others_with_errors_in_them(
            which in 0..TEXTS.len(),
            changes in prop::collection::vec(
                (any::<Index>(), prop::sample::select(&b" \t\r\n\x0c0123459.-+eE#/\\vfgx,\0\xff\xc3\xa0"[..]), 0..3),
                1..4,
            ),
        ) {
            let (name, head, body) = TEXTS[which];
            let mut body = body.as_bytes().to_vec();
            for (place, byte, change) in changes {
                let place = place.index(body.len());
                match change {
                    0 => body[place] = byte,
                    1 => body.insert(place, byte),
                    _ => drop(body.remove(place)),
                }
            }
            check(name, head, &body);
        }
    }
}
