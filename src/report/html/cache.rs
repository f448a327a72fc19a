//! What is made once for all pages that show the same pictures.

use crate::fault::Fault;
use crate::report::Area;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// A part of the pictures, and the number of what is made of it.
type Variant = (Area, usize);

/// Things made of shared pictures, for as long as somebody has these.
pub(super) struct PictureCache<K: ?Sized, V> {
    /// Of which pictures, in which variant, and what was made.
    made: Mutex<Vec<(Weak<K>, Variant, V)>>,
}

impl<K: ?Sized, V: Clone> PictureCache<K, V> {
    pub const fn new() -> Self {
        Self { made: Mutex::new(Vec::new()) }
    }

    /// What `make` makes of a part of `pictures` in this variant, unless it is there already.
    pub fn get(
        &self,
        pictures: &Arc<K>,
        part: Area,
        variant: usize,
        make: impl FnOnce() -> Result<V, Fault>,
    ) -> Result<V, Fault> {
        let variant = (part, variant);
        let lock = || self.made.lock().unwrap_or_else(PoisonError::into_inner);
        let is_this = |of: &Weak<K>| Weak::ptr_eq(of, &Arc::downgrade(pictures));
        let known = lock().iter().find(|(of, known, _)| *known == variant && is_this(of)).map(|(.., v)| v.clone());
        if let Some(known) = known {
            return Ok(known);
        }
        // Not under the lock: two that come at once make it twice.
        let value = make()?;
        let mut made = lock();
        made.retain(|(of, ..)| of.strong_count() > 0);
        made.push((Arc::downgrade(pictures), variant, value.clone()));
        Ok(value)
    }
}
