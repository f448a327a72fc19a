//! What the figures were measured on.

use std::fs;

/// Processor, cores, kernel, system and driver, one a line.
pub fn describe() -> Vec<String> {
    let field = |file: &str, name: &str| {
        let text = fs::read_to_string(file).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix(name)).unwrap_or("unknown");
        line.trim_matches(|c: char| c.is_whitespace() || matches!(c, ':' | '=' | '"')).to_owned()
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    vec![
        format!("{}, {cores} cores", field("/proc/cpuinfo", "model name")),
        format!(
            "{} MiB of memory",
            field("/proc/meminfo", "MemTotal").trim_end_matches(" kB").parse().unwrap_or(0) / 1024
        ),
        format!(
            "{}, Linux {}",
            field("/etc/os-release", "PRETTY_NAME"),
            fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default().trim()
        ),
        driver(),
        format!("load average when it began: {}", load.split(' ').take(3).collect::<Vec<_>>().join(", ")),
    ]
}

fn driver() -> String {
    let device = ggrade::render::Device::open(ggrade::render::AdapterKind::Software);
    device.map_or_else(|fault| fault.message.en, |device| format!("{}, {}", device.driver, device.renderer))
}
