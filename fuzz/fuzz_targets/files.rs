//! Pictures and meshes of a homework's folder: PNG, OBJ and glTF. What is read is whole, and what is not is named.
#![no_main]

use libfuzzer_sys::fuzz_target;
use reference::Folder;
use reference::scene::Shape;
use reference::texture;

/// Pixels of a picture.
const MOST: usize = 1 << 16;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(picture) = texture::read(bytes, MOST) {
        assert_eq!(picture.texels.len(), picture.width * picture.height);
    }
    let folder = Folder::of(["a.obj", "a.gltf"].map(|name| (name, bytes)));
    for name in folder.files.keys() {
        match Shape::File(name.clone()).mesh(&folder) {
            Ok(mesh) => {
                let is_there = |vertex: &u32| (*vertex as usize) < mesh.vertices.len();
                assert!(mesh.triangles.iter().flatten().all(is_there));
            }
            Err(error) => {
                assert_eq!(error.file.as_ref(), Some(name));
                assert!(!error.message.en.is_empty() && !error.message.ja.is_empty());
            }
        }
    }
});
