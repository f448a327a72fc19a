//! The memory allocator of the C library.

/// Gives freed memory back to the kernel, wherever in the heap it lies. Does nothing where the C library cannot.
pub(crate) fn trim() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: it has no precondition, and touches nothing that is in use.
    unsafe {
        nix::libc::malloc_trim(0);
    }
}
