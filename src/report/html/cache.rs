//! What is made once for all pages that show the same pictures.

use crate::fault::Fault;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Things made of shared pictures, in variants that `N` tells apart, for as long as somebody has these pictures.
pub(crate) struct PictureCache<K: ?Sized, N, V> {
    /// Of which pictures, in which variant, and what was made.
    made: Mutex<Vec<(Weak<K>, N, V)>>,
}

impl<K: ?Sized, N: PartialEq, V: Clone> PictureCache<K, N, V> {
    pub const fn new() -> Self {
        Self { made: Mutex::new(Vec::new()) }
    }

    /// What `make` makes of `pictures` in this variant, unless it is there already.
    pub fn get(&self, pictures: &Arc<K>, variant: N, make: impl FnOnce() -> Result<V, Fault>) -> Result<V, Fault> {
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
