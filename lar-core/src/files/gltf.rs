//! glTF 2.0 out: a scene of named, coloured nodes, one a cell.
//!
//! Positions are 32-bit, indices 32-bit, triangles without normals (which readers must then shade flat). LAR's
//! z points up, glTF's y does: one root node turns the scene, the coordinates stay as they are.
//!
//! Reference: Khronos Group, "glTF 2.0 Specification", ISO/IEC 12113:2022.

use super::error::MeshFileError;
use super::format::MeshFormat;
use super::polygons::{self, PolygonMesh};
use crate::measure::xyz;
use crate::{Cells, TriangleMesh, atomic_write};
use serde_json::{Value, json};
use std::path::Path;

/// A cell of a scene to be written as glTF.
#[derive(Clone, Debug, PartialEq)]
pub struct GltfNode<'a> {
    /// Name of the node, its mesh and its material.
    pub name: String,
    /// Its boundary.
    pub mesh: &'a TriangleMesh,
    /// Red, green, blue in sRGB and opacity, 0..=1 each; what lies beyond is brought into that range.
    pub colour: [f32; 4],
}

/// The scene as a binary glTF file. O(size).
///
/// # Errors
/// When a triangle names a vertex that does not exist, a coordinate does not fit 32 bits, or the file would
/// pass 4 GB.
///
/// ```
/// use lar_core::{GltfNode, icosphere, to_glb};
/// let ball = icosphere(0);
/// let nodes = [GltfNode { name: "ball".into(), mesh: &ball, colour: [1., 0.5, 0., 1.] }];
/// let glb = to_glb(&nodes)?;
/// assert_eq!((&glb[..4], glb.len() % 4), (&b"glTF"[..], 0));
/// # Ok::<(), lar_core::MeshFileError>(())
/// ```
pub fn to_glb(nodes: &[GltfNode<'_>]) -> Result<Vec<u8>, MeshFileError> {
    const JSON: u32 = 0x4E4F_534A;
    const BIN: u32 = 0x004E_4942;
    let (document, buffer) = scene(nodes, None)?;
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + text.len() + if buffer.is_empty() { 0 } else { 8 + buffer.len() };
    let mut glb = Vec::with_capacity(length);
    glb.extend(b"glTF");
    glb.extend(2_u32.to_le_bytes());
    glb.extend(size(length)?.to_le_bytes());
    for (kind, chunk) in [(JSON, &text), (BIN, &buffer)] {
        if !chunk.is_empty() {
            glb.extend(size(chunk.len())?.to_le_bytes());
            glb.extend(kind.to_le_bytes());
            glb.extend(chunk);
        }
    }
    Ok(glb)
}

/// The scene as glTF in JSON, its buffer inside in base 64. O(size).
///
/// # Errors
/// As [`to_glb`].
///
/// ```
/// use lar_core::{GltfNode, icosphere, to_gltf};
/// let ball = icosphere(0);
/// let text = to_gltf(&[GltfNode { name: "ball".into(), mesh: &ball, colour: [1.; 4] }])?;
/// assert!(text.contains("\"name\":\"ball\""));
/// # Ok::<(), lar_core::MeshFileError>(())
/// ```
pub fn to_gltf(nodes: &[GltfNode<'_>]) -> Result<String, MeshFileError> {
    Ok(scene(nodes, Some("data:application/octet-stream;base64,"))?.0.to_string())
}

/// Writes the scene whole or not at all: as JSON when the extension is `gltf`, else in binary. O(size).
///
/// # Errors
/// As [`to_glb`], and when the file cannot be written.
///
/// ```no_run
/// use lar_core::{GltfNode, icosphere, write_gltf};
/// let ball = icosphere(3);
/// write_gltf("ball.glb", &[GltfNode { name: "ball".into(), mesh: &ball, colour: [1.; 4] }])?;
/// # Ok::<(), lar_core::MeshFileError>(())
/// ```
pub fn write_gltf(path: impl AsRef<Path>, nodes: &[GltfNode<'_>]) -> Result<(), MeshFileError> {
    let bytes = match MeshFormat::of_path(&path) {
        Some(MeshFormat::Gltf) => to_gltf(nodes)?.into_bytes(),
        _ => to_glb(nodes)?,
    };
    atomic_write(path, |out| out.write_all(&bytes))?;
    Ok(())
}

/// A single mesh as a grey node named by the file.
pub(crate) fn of_mesh(
    mesh: &impl PolygonMesh,
    format: MeshFormat,
    path: &Path,
) -> Result<Vec<u8>, MeshFileError> {
    const GREY: [f32; 4] = [0.8, 0.8, 0.8, 1.];
    polygons::check(mesh, format)?;
    let triangles: Cells = polygons::polygons(mesh).collect();
    let triangles = triangles.indices().as_chunks().0.to_vec();
    let mesh = &TriangleMesh { points: mesh.points().clone(), triangles };
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let nodes = [GltfNode { name, mesh, colour: GREY }];
    if format == MeshFormat::Gltf { Ok(to_gltf(&nodes)?.into_bytes()) } else { to_glb(&nodes) }
}

/// The document and its buffer; with a `prefix` the buffer stands in the document too, after it.
fn scene(nodes: &[GltfNode<'_>], prefix: Option<&str>) -> Result<(Value, Vec<u8>), MeshFileError> {
    let mut scene = Scene::default();
    for node in nodes {
        polygons::check(node.mesh, MeshFormat::Glb)?;
        scene.push(node);
    }
    size(scene.buffer.len())?;
    Ok(scene.into_document(prefix))
}

fn size(bytes: usize) -> Result<u32, MeshFileError> {
    u32::try_from(bytes).map_err(|_| MeshFileError::TooLarge { bytes: bytes as u64 })
}

#[derive(Default)]
struct Scene {
    buffer: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    nodes: Vec<Value>,
}

impl Scene {
    /// A mesh without triangles has no accessor that glTF allows: its node stays empty.
    fn push(&mut self, node: &GltfNode<'_>) {
        let name = &node.name;
        if node.mesh.triangles.is_empty() {
            self.nodes.push(json!({ "name": name }));
            return;
        }
        let positions = self.positions(node.mesh);
        let indices = self.indices(&node.mesh.triangles);
        let primitive = json!({
            "attributes": { "POSITION": positions },
            "indices": indices,
            "material": self.materials.len(),
        });
        self.nodes.push(json!({ "name": name, "mesh": self.meshes.len() }));
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.materials.push(material(name, node.colour));
    }

    fn positions(&mut self, mesh: &TriangleMesh) -> usize {
        const FLOAT: u32 = 5126;
        const ARRAY_BUFFER: u32 = 34962;
        let start = self.buffer.len();
        let (mut lo, mut hi) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for v in 0..mesh.points.len() {
            let point = xyz(&mesh.points, v).map(|x| x as f32);
            for (k, x) in point.into_iter().enumerate() {
                lo[k] = lo[k].min(x);
                hi[k] = hi[k].max(x);
                self.buffer.extend(x.to_le_bytes());
            }
        }
        let count = mesh.points.len();
        let view = self.view(start, ARRAY_BUFFER);
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": count, "type": "VEC3", "min": lo, "max": hi,
        }));
        self.accessors.len() - 1
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        const UNSIGNED_INT: u32 = 5125;
        const ELEMENT_ARRAY_BUFFER: u32 = 34963;
        let start = self.buffer.len();
        self.buffer.extend(triangles.as_flattened().iter().flat_map(|v| v.to_le_bytes()));
        let view = self.view(start, ELEMENT_ARRAY_BUFFER);
        let count = 3 * triangles.len();
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR",
        }));
        self.accessors.len() - 1
    }

    fn view(&mut self, start: usize, target: u32) -> usize {
        let length = self.buffer.len() - start;
        self.views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": length, "target": target }));
        self.views.len() - 1
    }

    /// Lists that would be empty are left out, as glTF demands.
    fn into_document(self, prefix: Option<&str>) -> (Value, Vec<u8>) {
        let Self { buffer, views, accessors, meshes, materials, mut nodes } = self;
        let mut root = json!({ "name": "z up", "rotation": z_up() });
        if !nodes.is_empty() {
            root["children"] = (0..nodes.len()).collect();
        }
        let last = nodes.len();
        nodes.push(root);
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("lar-core ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": [last] }],
            "nodes": nodes,
        });
        if !buffer.is_empty() {
            let mut entry = json!({ "byteLength": buffer.len() });
            if let Some(prefix) = prefix {
                entry["uri"] = (prefix.to_owned() + &base64(&buffer)).into();
            }
            document["buffers"] = json!([entry]);
            document["bufferViews"] = views.into();
            document["accessors"] = accessors.into();
            document["meshes"] = meshes.into();
            document["materials"] = materials.into();
        }
        (document, buffer)
    }
}

/// A quarter turn about x, as the quaternion (x, y, z, w), that brings z to y.
fn z_up() -> [f64; 4] {
    [-std::f64::consts::FRAC_1_SQRT_2, 0., 0., std::f64::consts::FRAC_1_SQRT_2]
}

fn material(name: &str, [r, g, b, a]: [f32; 4]) -> Value {
    let unit = |x: f32| if x.is_nan() { 0. } else { f64::from(x.clamp(0., 1.)) };
    let colour = [linear(unit(r)), linear(unit(g)), linear(unit(b)), unit(a)];
    let mut material = json!({
        "name": name,
        "doubleSided": true,
        "pbrMetallicRoughness": { "baseColorFactor": colour, "metallicFactor": 0, "roughnessFactor": 0.8 },
    });
    if colour[3] < 1. {
        material["alphaMode"] = "BLEND".into();
    }
    material
}

/// Light from an sRGB value; IEC 61966-2-1.
fn linear(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

/// RFC 4648, with padding.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (i, shift) in [18, 12, 6, 0].into_iter().enumerate() {
            let letter = ALPHABET[(bits >> shift & 63) as usize];
            text.push(if i <= group.len() { letter.into() } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Points, icosphere};

    #[track_caller]
    fn check_base64(bytes: &str, expected: &str) {
        assert_eq!(base64(bytes.as_bytes()), expected);
    }

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn base_64() {
        check_base64("", "");
        check_base64("f", "Zg==");
        check_base64("fo", "Zm8=");
        check_base64("foo", "Zm9v");
        check_base64("foobar", "Zm9vYmFy");
    }

    #[test]
    fn one_node_a_cell() {
        let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 2., 0.5]]);
        let mesh = &TriangleMesh { points, triangles: vec![[0, 1, 2]] };
        let empty = &TriangleMesh { points: Points::new(3), triangles: Vec::new() };
        let node = |name: &str, mesh, colour| GltfNode { name: name.into(), mesh, colour };
        let nodes = [
            node("A \"1\"", mesh, [1., 0.5, 0., 1.]),
            node("nothing", empty, [0.; 4]),
            node("B", mesh, [f32::NAN, 2., 0., 0.25]),
        ];
        let text = to_gltf(&nodes).unwrap();
        let document: Value = serde_json::from_str(&text).unwrap();
        insta::assert_snapshot!(serde_json::to_string_pretty(&document).unwrap());
    }

    #[test]
    fn binary_container() {
        let ball = icosphere(1);
        let glb = to_glb(&[GltfNode { name: "é".into(), mesh: &ball, colour: [1.; 4] }]).unwrap();
        let word = |i: usize| u32::from_le_bytes(glb[i..i + 4].try_into().unwrap()) as usize;
        assert_eq!((word(4), word(8)), (2, glb.len()));
        let text = word(12);
        let document: Value = serde_json::from_slice(&glb[20..20 + text]).unwrap();
        assert_eq!(document["nodes"][0]["name"], "é");
        let buffer = 20 + text + 8;
        assert_eq!(&glb[buffer - 4..buffer], b"BIN\0");
        assert_eq!(word(buffer - 8), 42 * 12 + 80 * 12);
        assert_eq!(document["buffers"][0]["byteLength"], 42 * 12 + 80 * 12);
        let x = f32::from_le_bytes(glb[buffer..buffer + 4].try_into().unwrap());
        assert_eq!(x, ball.points.xyz(0)[0] as f32);
        let scene = to_glb(&[]).unwrap();
        assert_eq!(scene.len(), 20 + usize::from(scene[12]));
    }

    #[test]
    fn refusals() {
        let far = &TriangleMesh { points: Points::from_xyz(&[[0., 1e39, 0.]]), triangles: vec![[0, 0, 0]] };
        let node = GltfNode { name: String::new(), mesh: far, colour: [1.; 4] };
        let message = "coordinate 1 of vertex v0 is 1e39, which the format cannot hold";
        assert_eq!(to_glb(&[node]).unwrap_err().to_string(), message.replace("1e39", &1e39_f64.to_string()));
    }
}
