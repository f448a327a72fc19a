//! Landlock: nothing can be written, and only what a driver needs can be read.

use crate::render::AdapterKind;
use landlock::{
    ABI, Access, AccessFs, AccessNet, LandlockStatus, Ruleset, RulesetAttr, RulesetCreated, RulesetCreatedAttr,
    RulesetError, RulesetStatus, Scope, path_beneath_rules,
};
use std::path::PathBuf;

/// The newest version whose rights are handled here; an older kernel enforces those that it knows.
const NEWEST: ABI = ABI::V6;

/// Libraries, the driver's description, and what both ask about the machine.
const READ: [&str; 15] = [
    "/usr",
    "/lib",
    "/lib64",
    "/opt",
    "/nix/store",
    "/gnu/store",
    "/run/opengl-driver",
    "/etc/ld.so.cache",
    "/etc/vulkan",
    "/etc/glvnd",
    "/etc/drirc",
    "/sys/devices/system",
    "/proc/cpuinfo",
    "/proc/meminfo",
    "/dev/null",
];

/// What a graphics card's driver needs besides.
const CARD_READ: [&str; 3] = ["/sys", "/proc/driver", "/proc/modules"];
const CARD_WRITE: [&str; 4] = ["/dev/dri", "/dev/nvidiactl", "/dev/nvidia0", "/dev/nvidia-modeset"];

/// Shuts the file system, TCP and other processes away from this thread and those that it starts.
pub(super) fn restrict(adapter: AdapterKind) -> Result<String, String> {
    let status = ruleset(adapter).and_then(RulesetCreated::restrict_self).map_err(|error| error.to_string())?;
    let version = match status.landlock {
        LandlockStatus::Available { effective_abi, .. } => format!("Landlock {effective_abi:?}"),
        LandlockStatus::NotEnabled => "Landlock is not enabled in this kernel".into(),
        LandlockStatus::NotImplemented => "this kernel has no Landlock".into(),
    };
    if status.ruleset == RulesetStatus::NotEnforced { Err(version) } else { Ok(version) }
}

fn ruleset(adapter: AdapterKind) -> Result<RulesetCreated, RulesetError> {
    let read = AccessFs::ReadFile | AccessFs::ReadDir;
    let rules = Ruleset::default()
        .handle_access(AccessFs::from_all(NEWEST))?
        .handle_access(AccessNet::from_all(NEWEST))?
        .scope(Scope::from_all(NEWEST))?
        .create()?
        .add_rules(path_beneath_rules(READ, read))?
        .add_rules(path_beneath_rules(given(), read))?;
    if adapter == AdapterKind::Software {
        return Ok(rules);
    }
    let use_card = read | AccessFs::WriteFile | AccessFs::IoctlDev;
    rules.add_rules(path_beneath_rules(CARD_READ, read))?.add_rules(path_beneath_rules(CARD_WRITE, use_card))
}

/// Places that the parent named in the environment.
fn given() -> Vec<PathBuf> {
    ["VK_DRIVER_FILES", "LD_LIBRARY_PATH"]
        .iter()
        .filter_map(std::env::var_os)
        .flat_map(|paths| std::env::split_paths(&paths).collect::<Vec<_>>())
        .filter(|path| path.is_absolute())
        .collect()
}
