//! The whole environment of a worker.

use crate::render::AdapterKind;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// Variables that are the same on every machine.
const FIXED: [(&str, &str); 11] = [
    // A cache on disk would carry one student's code into another's worker.
    ("MESA_SHADER_CACHE_DISABLE", "true"),
    // Frames are small: threads cost more than they bring, and the pool has a worker a core.
    ("LP_NUM_THREADS", "0"),
    // A shader runs for 700 vertices: its optimisation costs many times what it brings, and doubles with each loop that
    // is nested in another.
    ("GALLIVM_PERF", "nopt"),
    // Four vertices at a time, not eight: half the code to generate.
    ("LP_NATIVE_VECTOR_WIDTH", "128"),
    // Threads take turns here, and memory of their own each would only lie idle; what is large goes back at once.
    ("MALLOC_ARENA_MAX", "1"),
    ("MALLOC_MMAP_THRESHOLD_", "1048576"),
    ("MALLOC_TRIM_THRESHOLD_", "8388608"),
    // The Wayland client library, which the driver loads, complains where this is unset.
    ("XDG_RUNTIME_DIR", "/nonexistent"),
    // Layers are not part of a grading. Mesa's asks a display server which card to prefer.
    ("NODEVICE_SELECT", "1"),
    ("VK_LOADER_LAYERS_DISABLE", "~implicit~"),
    ("LC_ALL", "C.UTF-8"),
];

/// Where drivers describe themselves.
const DRIVER_FOLDERS: [&str; 4] = [
    "/etc/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
    "/usr/share/vulkan/icd.d",
    "/run/opengl-driver/share/vulkan/icd.d",
];

/// Names and values for a worker that renders on this kind of adapter.
pub(super) fn variables(adapter: AdapterKind) -> Vec<(&'static str, OsString)> {
    let mut variables: Vec<_> = FIXED.iter().map(|&(name, value)| (name, OsString::from(value))).collect();
    // Where libraries lie on machines that keep them elsewhere.
    variables.extend(std::env::var_os("LD_LIBRARY_PATH").map(|paths| ("LD_LIBRARY_PATH", paths)));
    let drivers = match adapter {
        AdapterKind::Software => software_drivers(),
        AdapterKind::Gpu => asked_for(),
    };
    if let Ok(paths) = std::env::join_paths(&drivers)
        && !drivers.is_empty()
    {
        // Loaders before 1.3.207 know the second name only.
        variables.extend([("VK_DRIVER_FILES", paths.clone()), ("VK_ICD_FILENAMES", paths)]);
    }
    variables
}

/// Descriptions of the software driver: no other driver is loaded, which halves the start. None found leaves the
/// choice to the Vulkan loader.
fn software_drivers() -> Vec<PathBuf> {
    let asked = asked_for();
    if !asked.is_empty() {
        return asked;
    }
    let files = DRIVER_FOLDERS.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
    let mut found: Vec<_> = files.flatten().map(|file| file.path()).filter(|path| is_software(path)).collect();
    found.sort();
    found
}

/// The drivers that whoever started ggrade asked for.
fn asked_for() -> Vec<PathBuf> {
    let paths = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].iter().find_map(std::env::var_os).unwrap_or_default();
    std::env::split_paths(&paths).filter(|path| path.is_absolute()).collect()
}

fn is_software(path: &Path) -> bool {
    let name = path.file_name().and_then(OsStr::to_str).unwrap_or_default();
    name.starts_with("lvp_icd.") && name.ends_with(".json") && !is_other_machine(name)
}

/// Distributions put the machine into the name, and may have several installed.
fn is_other_machine(name: &str) -> bool {
    let machines = ["x86_64", "aarch64", "i686", "i386", "armhf", "riscv64"];
    machines.iter().any(|machine| name.contains(machine) && *machine != std::env::consts::ARCH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_this_machines_software_driver_is_taken() {
        let native = format!("/usr/share/vulkan/icd.d/lvp_icd.{}.json", std::env::consts::ARCH);
        assert!(is_software(Path::new(&native)));
        assert!(is_software(Path::new("/usr/share/vulkan/icd.d/lvp_icd.json")));
        assert!(!is_software(Path::new("/usr/share/vulkan/icd.d/radeon_icd.x86_64.json")));
        assert!(!is_software(Path::new("/usr/share/vulkan/icd.d/lvp_icd.armhf.json")));
    }

    #[test]
    fn a_worker_has_neither_home_nor_path() {
        let names: Vec<_> = variables(AdapterKind::Software).into_iter().map(|(name, _)| name).collect();
        assert!(names.contains(&"MESA_SHADER_CACHE_DISABLE"));
        assert!(!names.contains(&"HOME") && !names.contains(&"PATH") && !names.contains(&"TMPDIR"));
    }
}
