//! Files written here, number by number.

use super::*;
use serde_json::{Value, json};

/// A file in the making.
#[derive(Default)]
struct GltfBuilder {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl GltfBuilder {
    fn accessor(&mut self, bytes: &[u8], count: usize, kind: u32, dimensions: &str) -> usize {
        let (offset, length) = (self.bytes.len(), bytes.len());
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": length }));
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1, "componentType": kind, "count": count, "type": dimensions,
            "min": [-9, -9, -9], "max": [9, 9, 9],
        }));
        self.accessors.len() - 1
    }

    fn floats<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = vectors.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        self.accessor(&bytes, vectors.len(), 5126, &format!("VEC{N}"))
    }

    fn shorts(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        self.accessor(&bytes, indices.len(), 5123, "SCALAR")
    }

    /// The document with these primitives in mesh 0, and these nodes, of which the first is the scene's.
    fn document(&self, primitives: Value, nodes: Value) -> Value {
        json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": nodes,
            "meshes": [{ "primitives": primitives }], "accessors": self.accessors, "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len() }],
        })
    }
}

/// A binary file of a document and its buffer.
fn glb(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8], bytes: &[u8], fill: u8| {
        let mut padded = bytes.to_vec();
        padded.resize(bytes.len().next_multiple_of(4), fill);
        [&(padded.len() as u32).to_le_bytes()[..], kind, &padded].concat()
    };
    let chunks = [chunk(b"JSON", document.to_string().as_bytes(), b' '), chunk(b"BIN\0", buffer, 0)].concat();
    [b"glTF", &2_u32.to_le_bytes()[..], &(chunks.len() as u32 + 12).to_le_bytes(), &chunks].concat()
}

fn read_alone(bytes: &[u8]) -> Result<Mesh, MeshError> {
    read("a.glb", bytes, &Folder::default())
}

fn said(document: &Value, buffer: &[u8]) -> String {
    read_alone(&glb(document, buffer)).expect_err("a broken file").message.en
}

/// A rectangle 2 wide and 1 high in the plane z = 0, with all that a vertex can have.
fn rectangle() -> (GltfBuilder, Value) {
    let mut file = GltfBuilder::default();
    let primitive = json!([{
        "attributes": {
            "POSITION": file.floats(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]),
            "NORMAL": file.floats(&[[0.0, 0.0, 1.0]; 4]),
            "TEXCOORD_0": file.floats(&[[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]),
            "TANGENT": file.floats(&[[1.0, 0.0, 0.0, 1.0]; 4]),
        },
        "indices": file.shorts(&[0, 1, 2, 0, 2, 3]),
    }]);
    (file, primitive)
}

fn places(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.vertices.iter().map(|vertex| vertex.position.truncate().to_array()).collect()
}

#[test]
fn nodes_put_a_mesh_where_it_stands() {
    let (file, primitives) = rectangle();
    // Twice as high and turned by a quarter about z, then moved: (x, y) goes to (-2 y, x) + (5, 0).
    let half = 0.5_f32.sqrt();
    let nodes = json!([
        { "translation": [5, 0, 0], "children": [1] },
        { "rotation": [0, 0, half, half], "scale": [1, 2, 1], "mesh": 0 },
    ]);
    let mesh = read_alone(&glb(&file.document(primitives, nodes), &file.bytes)).expect("a mesh");
    let expected = [[5.0, 0.0, 0.0], [5.0, 2.0, 0.0], [3.0, 2.0, 0.0], [3.0, 0.0, 0.0]];
    for (vertex, expected) in mesh.vertices.iter().zip(expected) {
        assert!((vertex.position.truncate() - DVec3::from_array(expected)).length() < 1e-6, "{vertex:?}");
        assert!((vertex.normal.truncate() - DVec3::Z).length() < 1e-6);
        assert!((vertex.tangent - DVec3::Y.extend(1.0)).length() < 1e-6);
    }
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    // glTF counts v from above.
    let coordinates: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.texture_coordinates.to_array()).collect();
    assert_eq!(coordinates, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
}

#[test]
fn a_mirrored_mesh_still_shows_its_front() {
    let (file, primitives) = rectangle();
    let nodes = json!([{ "scale": [-1, 1, 1], "mesh": 0 }]);
    let mesh = read_alone(&glb(&file.document(primitives, nodes), &file.bytes)).expect("a mesh");
    assert_eq!(places(&mesh)[1], [-2.0, 0.0, 0.0]);
    assert_eq!(mesh.triangles, [[0, 2, 1], [0, 3, 2]]);
    // From the front, to +z, its picture is seen in a mirror: the tangent runs to -x, and n × t · w upwards.
    for vertex in &mesh.vertices {
        assert_eq!((vertex.normal, vertex.tangent), (DVec3::Z.extend(1.0), DVec3::NEG_X.extend(-1.0)));
    }
}

#[test]
fn what_is_missing_follows_from_the_rest() {
    let (mut file, primitives) = rectangle();
    let position = &primitives[0]["attributes"]["POSITION"];
    let (strip, fan) = (file.shorts(&[0, 1, 3, 2]), file.shorts(&[0, 1, 2, 3]));
    let line = file.shorts(&[0, 1]);
    let nodes = json!([{ "mesh": 0 }]);
    let parts = json!([
        { "attributes": { "POSITION": position }, "indices": strip, "mode": 5 },
        { "attributes": { "POSITION": position }, "indices": line, "mode": 1 },
        { "attributes": { "POSITION": position, "TEXCOORD_0": primitives[0]["attributes"]["TEXCOORD_0"] }, "indices": fan, "mode": 6 },
    ]);
    let mesh = read_alone(&glb(&file.document(parts, nodes), &file.bytes)).expect("a mesh");
    // Flat normals: each triangle has its own vertices. The second of a strip runs 3, 1, 2.
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(places(&mesh), [a, b, d, d, b, c, a, b, c, a, c, d]);
    for (number, vertex) in mesh.vertices.iter().enumerate() {
        assert_eq!(vertex.normal, DVec3::Z.extend(1.0));
        if number >= 6 {
            assert_eq!(vertex.tangent, DVec3::X.extend(1.0));
        }
    }
}

#[test]
fn buffers_stand_in_the_file_or_in_the_folder() {
    let (file, primitives) = rectangle();
    let mut document = file.document(primitives, json!([{ "mesh": 0 }]));
    let whole = read_alone(&glb(&document, &file.bytes)).expect("a mesh");
    let mut read_from = |uri: &str, path: &str| {
        document["buffers"][0]["uri"] = uri.into();
        let folder = Folder::of([(path, file.bytes.clone())]);
        read("models/a.gltf", document.to_string().as_bytes(), &folder)
    };
    use base64::Engine;
    let coded = base64::engine::general_purpose::STANDARD.encode(&file.bytes);
    assert_eq!(read_from(&format!("data:application/octet-stream;base64,{coded}"), "x").expect("coded"), whole);
    assert_eq!(read_from("./my%20data.bin", "models/my data.bin").expect("beside it"), whole);
    assert_eq!(read_from("../data.bin", "data.bin").expect("above it"), whole);
    for (uri, part) in [
        ("../../etc/passwd", "reads `../etc/passwd`, which is not in the folder"),
        ("/etc/passwd", "reads `models//etc/passwd`, which is not in the folder"),
        ("https://example.org/a.bin", "which is not in the folder"),
        ("data:;base64,!!", "that is not base64"),
    ] {
        let message = read_from(uri, "data.bin").expect_err(uri).message;
        assert!(message.en.contains(part) && !message.ja.is_empty(), "{}", message.en);
    }
}

#[test]
fn what_a_file_promises_is_not_taken_for_granted() {
    let (file, primitives) = rectangle();
    let whole = file.document(primitives.clone(), json!([{ "mesh": 0 }]));
    let changed = |path: &str, value: Value| {
        let mut document = whole.clone();
        *document.pointer_mut(path).expect(path) = value;
        said(&document, &file.bytes)
    };
    assert!(changed("/accessors/4/count", 9.into()).contains("beyond the end of its buffer"));
    assert!(changed("/accessors/0/count", 4_000_000_000_u64.into()).contains("use at most 100000"));
    assert!(changed("/accessors/1/count", 4_000_000_000_u64.into()).contains("beyond the end of its buffer"));
    assert!(changed("/accessors/4/componentType", 5125.into()).contains("beyond the end of its buffer"));
    assert!(changed("/accessors/0/type", "VEC2".into()).contains("of another type"));
    assert!(changed("/bufferViews/0/byteOffset", u64::MAX.into()).contains("export it again"));
    assert!(changed("/nodes", json!([{ "mesh": 7 }])).contains("is no glTF 2.0, or damaged"));
    assert!(
        changed("/nodes", json!([{ "mesh": 0, "children": [0] }])).contains("use at most")
            || changed("/nodes", json!([{ "mesh": 0, "children": [0] }])).contains("64 deep")
    );
    assert!(changed("/scenes", json!([])).contains("is no glTF 2.0, or damaged"));
    let mut without = whole.clone();
    for key in ["scene", "scenes"] {
        without.as_object_mut().expect("an object").remove(key);
    }
    assert!(said(&without, &file.bytes).contains("has no scene"));
    let mut compressed = whole.clone();
    compressed["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    assert!(said(&compressed, &file.bytes).contains("needs KHR_draco_mesh_compression: export it without compression"));
    let mut sparse = whole.clone();
    sparse["accessors"][0]["sparse"] = json!({
        "count": 1, "indices": { "bufferView": 4, "componentType": 5123 }, "values": { "bufferView": 0 },
    });
    assert!(said(&sparse, &file.bytes).contains("sparse"));
    let mut file = file;
    let beyond = file.shorts(&[0, 1, 9]);
    let mut primitives = primitives;
    primitives[0]["indices"] = beyond.into();
    let message = said(&file.document(primitives, json!([{ "mesh": 0 }])), &file.bytes);
    assert!(message.contains("indices of vertices that are not there"), "{message}");
}

#[test]
fn a_damaged_file_is_a_mesh_or_an_error() {
    let (file, primitives) = rectangle();
    let whole = glb(&file.document(primitives, json!([{ "mesh": 0 }])), &file.bytes);
    assert!(read_alone(&whole).is_ok());
    for at in 0..whole.len() {
        assert!(read_alone(&whole[..at]).is_err(), "cut at {at}");
        for byte in [0, b'0', b'9', b'-', b'"', b',', 0x7f, 0xff] {
            let mut bytes = whole.clone();
            bytes[at] = byte;
            if let Ok(mesh) = read_alone(&bytes) {
                let count = mesh.vertices.len() as u32;
                assert!(mesh.triangles.iter().flatten().all(|vertex| *vertex < count));
            }
        }
    }
}
