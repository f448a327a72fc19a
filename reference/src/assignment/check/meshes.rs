//! The meshes of an assignment: each is made once, however often it is drawn.

use super::CheckResult;
use crate::Folder;
use crate::assignment::{AssignmentError, error};
use crate::scene::{Mesh, MeshError, Shape};
use crate::text::both;
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;
use toml::Spanned;

/// More vertices in all meshes than this are refused: each worker holds them.
const MOST_VERTICES: usize = 400_000;

/// The meshes so far: by the file that they are read from, or by their place in the manifest.
pub(super) struct Meshes<'a> {
    folder: &'a Folder,
    place_at: &'a dyn Fn(usize) -> String,
    known: RefCell<HashMap<(usize, String), Arc<Mesh>>>,
}

impl<'a> Meshes<'a> {
    pub fn new(folder: &'a Folder, place_at: &'a dyn Fn(usize) -> String) -> Self {
        Self { folder, place_at, known: RefCell::default() }
    }

    /// The mesh that an entry describes.
    pub fn mesh(&self, shape: &Spanned<Shape>) -> CheckResult<Arc<Mesh>> {
        let at = shape.span().start;
        let key = match shape.get_ref() {
            Shape::File(name) => (0, name.clone()),
            _ => (at, String::new()),
        };
        if let Some(known) = self.known.borrow().get(&key) {
            return Ok(Arc::clone(known));
        }
        let place = || format!("{}, scene, `mesh`", (self.place_at)(at));
        let mesh = shape.get_ref().mesh(self.folder).map_err(|MeshError { message, file, line }| match file {
            Some(file) => AssignmentError { line, ..AssignmentError::of_file(file, message) },
            None => error(place(), message),
        })?;
        let before: usize = self.known.borrow().values().map(|mesh| mesh.vertices.len()).sum();
        let sum = before + mesh.vertices.len();
        if sum > MOST_VERTICES {
            return Err(error(
                place(),
                both(
                    format!("all meshes up to this one have {sum} vertices: use at most {MOST_VERTICES}"),
                    format!(
                        "ここまでのメッシュの頂点が合わせて {sum} 個あります。{MOST_VERTICES} 個以下にしてください"
                    ),
                ),
            ));
        }
        let mesh = Arc::new(mesh);
        self.known.borrow_mut().insert(key, Arc::clone(&mesh));
        Ok(mesh)
    }
}
