//! The numbers of a glTF file: each within its bounds, whatever the file says.

use super::super::super::{MOST_TRIANGLES, MeshError, refused};
use crate::Folder;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Source;
use gltf::{Accessor, Document};

/// More elements than this are not read: the corners of as many triangles as a mesh may have.
const MOST_ELEMENTS: usize = 3 * MOST_TRIANGLES;

/// The buffers of a file, by number.
pub(super) struct Buffers(Vec<Vec<u8>>);

fn broken<T>() -> Result<T, MeshError> {
    refused(
        "reads numbers beyond the end of its buffer, or of another type: export it again",
        "バッファの範囲を超えるか、型の合わないデータがあります。書き出し直してください",
    )
}

impl Buffers {
    /// Reads the buffers of the file called `name`: within itself, or in the folder.
    pub fn read(name: &str, document: &Document, blob: Option<Vec<u8>>, folder: &Folder) -> Result<Self, MeshError> {
        let mut blob = blob;
        let buffer = |buffer: gltf::Buffer<'_>| match buffer.source() {
            Source::Bin => match blob.take() {
                Some(bytes) => Ok(bytes),
                None => refused(
                    "has no buffer in itself, although it says so: export it again",
                    "ファイル内にあるはずのバッファがありません。書き出し直してください",
                ),
            },
            Source::Uri(uri) => bytes(name, uri, folder),
        };
        document.buffers().map(buffer).collect::<Result<_, _>>().map(Self)
    }

    /// The bytes of each element, or nothing where they are not all there.
    fn elements(&self, accessor: &Accessor<'_>) -> Option<Vec<&[u8]>> {
        let view = accessor.view().filter(|_| accessor.count() <= MOST_ELEMENTS)?;
        let buffer = self.0.get(view.buffer().index())?;
        let view_bytes = buffer.get(view.offset()..view.offset().checked_add(view.length())?)?;
        let size = accessor.size();
        let stride = view.stride().unwrap_or(size);
        let start = |at: usize| at.checked_mul(stride)?.checked_add(accessor.offset());
        (0..accessor.count()).map(|at| view_bytes.get(start(at)?..start(at)?.checked_add(size)?)).collect()
    }

    /// Numbers, `N` by `N`.
    pub fn vectors<const N: usize>(&self, accessor: &Accessor<'_>) -> Result<Vec<[f64; N]>, MeshError> {
        if accessor.sparse().is_some() {
            return refused(
                "has sparse numbers, which are not read: export it without them",
                "疎な (sparse) データは読み込めません。使わずに書き出してください",
            );
        }
        let dimensions = match accessor.dimensions() {
            Dimensions::Vec2 => 2,
            Dimensions::Vec3 => 3,
            Dimensions::Vec4 => 4,
            _ => 0,
        };
        let kind = accessor.data_type();
        let is_known = kind == DataType::F32 || accessor.normalized() && matches!(kind, DataType::U8 | DataType::U16);
        let Some(elements) = self.elements(accessor).filter(|_| dimensions == N && is_known) else {
            return broken();
        };
        let number = |bytes: &[u8]| match *bytes {
            [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
            [a, b] => f64::from(u16::from_le_bytes([a, b])) / f64::from(u16::MAX),
            [a] => f64::from(a) / f64::from(u8::MAX),
            _ => f64::NAN,
        };
        let vector = |bytes: &[u8]| std::array::from_fn(|at| number(&bytes[at * kind.size()..(at + 1) * kind.size()]));
        Ok(elements.into_iter().map(vector).collect())
    }

    /// Whole numbers.
    pub fn indices(&self, accessor: &Accessor<'_>) -> Result<Vec<u32>, MeshError> {
        let is_known = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32)
            && accessor.dimensions() == Dimensions::Scalar
            && accessor.sparse().is_none();
        let Some(elements) = self.elements(accessor).filter(|_| is_known) else { return broken() };
        let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
        Ok(elements.into_iter().map(number).collect())
    }
}

/// What an address leads to: data in itself, or a file of the folder beside the one called `name`.
fn bytes(name: &str, uri: &str, folder: &Folder) -> Result<Vec<u8>, MeshError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let decoded = data.split_once(";base64,").and_then(|(_, data)| STANDARD.decode(data).ok());
        return match decoded {
            Some(bytes) => Ok(bytes),
            None => refused(
                "has a buffer in itself that is not base64: export it again",
                "ファイル内のバッファが base64 ではありません。書き出し直してください",
            ),
        };
    }
    let decoded = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
    let mut path: Vec<&str> = name.split('/').collect();
    path.pop();
    for step in decoded.split('/').filter(|step| *step != ".") {
        // A step above the folder leads to no file of it.
        match step {
            ".." if !path.is_empty() => path.truncate(path.len() - 1),
            step => path.push(step),
        }
    }
    let path = path.join("/");
    match folder.files.get(&path) {
        Some(bytes) => Ok(bytes.clone()),
        None => refused(
            format!("reads `{path}`, which is not in the folder: add it, or export one file (.glb)"),
            format!(
                "`{path}` を読みますが、フォルダにありません。追加するか、1 つのファイル (.glb) として書き出してください"
            ),
        ),
    }
}
