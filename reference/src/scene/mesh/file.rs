//! Meshes in files of the folder.

mod gltf;
mod obj;

use super::{Mesh, MeshError, refused};
use crate::Folder;

/// The mesh in a file; the end of its name says what it is.
pub(super) fn read(name: &str, folder: &Folder) -> Result<Mesh, MeshError> {
    let bytes = folder.bytes(name).map_err(|missing| MeshError { message: missing.message, file: None, line: None })?;
    if bytes.starts_with(b"version https://git-lfs") {
        return refused(
            "is a Git LFS pointer instead of the mesh: fetch the file itself",
            "メッシュではなく Git LFS のポインタです。ファイルそのものを取得してください",
        );
    }
    match name.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase()).as_deref() {
        Some("obj") => obj::read(bytes),
        Some("gltf" | "glb") => gltf::read(name, bytes, folder),
        _ => refused(
            "is not a mesh that can be read: export it as OBJ (.obj) or glTF (.gltf, .glb)",
            "読み込めるメッシュではありません。OBJ (.obj) か glTF (.gltf、.glb) で書き出してください",
        ),
    }
}
