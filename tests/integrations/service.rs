//! `ggrade serve` as a unit or a container starts it.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// A service that listens.
pub struct Running {
    child: Child,
    /// Host and port.
    pub address: String,
}

impl Running {
    /// Starts it on a free port, and waits until it says which.
    pub fn start(command: &mut Command) -> Self {
        command.env("LANG", "C").env("GGRADE_LISTEN", "127.0.0.1:0").env_remove("GGRADE_LANG");
        let mut child = command.stderr(Stdio::piped()).stdin(Stdio::null()).spawn().unwrap();
        let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
        let mut said = Vec::new();
        let address = lines.by_ref().map_while(Result::ok).find_map(|line| {
            said.push(line.clone());
            line.strip_prefix("Students:").map(|url| url.trim().to_owned())
        });
        let address = address.unwrap_or_else(|| panic!("no address: {said:?}"));
        // The pipe is read to its end, so that the service never waits for it.
        std::thread::spawn(move || lines.map_while(Result::ok).count());
        let address = address.trim_start_matches("http://").trim_end_matches('/').to_owned();
        Self { child, address }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Whether the health check of a program finds a service at an address.
pub fn ready(program: impl AsRef<Path>, address: &str) -> bool {
    let mut command = Command::new(program.as_ref());
    command.args(["serve", "--healthcheck"]).env("GGRADE_LISTEN", address).stdout(Stdio::null());
    command.status().unwrap().success()
}
