//! The Debian package: its files, put together as the metadata in `Cargo.toml` says, are installed, upgraded, removed and purged
//! by dpkg in a root of its own. `cargo deb` packs the same files; here dpkg-deb does, which every Debian has.

use super::repository;
use super::service::{Running, ready};
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn metadata() -> toml::Table {
    let text = fs::read_to_string(repository().join("Cargo.toml")).unwrap();
    let manifest: toml::Table = toml::from_str(&text).unwrap();
    manifest["package"]["metadata"]["deb"].as_table().unwrap().clone()
}

fn text<'a>(metadata: &'a toml::Table, key: &str) -> &'a str {
    metadata[key].as_str().unwrap_or_else(|| panic!("{key}"))
}

fn run(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {said}{}", String::from_utf8_lossy(&output.stdout));
    output
}

/// The files that a source of an asset names: the program under test, what script/package makes, or files of this tree.
fn sources(asset: &str, made: &Path) -> Vec<PathBuf> {
    if asset == "target/release/ggrade" {
        return vec![env!("CARGO_BIN_EXE_ggrade").into()];
    }
    let path = asset.strip_prefix("target/package/").map_or_else(|| repository().join(asset), |rest| made.join(rest));
    let Some(ending) = path.file_name().unwrap().to_str().unwrap().strip_prefix('*') else { return vec![path] };
    let entries = fs::read_dir(path.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
    let found: Vec<_> = entries.filter(|path| path.to_str().unwrap().ends_with(ending)).collect();
    assert!(!found.is_empty(), "{asset} names no file");
    found
}

/// Packs a version into `folder`.
fn package(version: &str, folder: &Path) -> PathBuf {
    let (tree, made, metadata) = (folder.join(version), folder.join("made"), metadata());
    run(Command::new(repository().join("script/package")).arg("--manual").arg(env!("CARGO_BIN_EXE_ggrade")).arg(&made));
    for asset in metadata["assets"].as_array().unwrap() {
        let [from, to, mode] = [0, 1, 2].map(|place| asset[place].as_str().unwrap());
        for source in sources(from, &made) {
            let mut target = tree.join(to);
            if to.ends_with('/') {
                target.push(source.file_name().unwrap());
            }
            fs::create_dir_all(target.parent().unwrap()).unwrap();
            fs::copy(&source, &target).unwrap_or_else(|error| panic!("{}: {error}", source.display()));
            fs::set_permissions(&target, fs::Permissions::from_mode(u32::from_str_radix(mode, 8).unwrap())).unwrap();
        }
    }
    let control = tree.join("DEBIAN");
    fs::create_dir(&control).unwrap();
    for entry in fs::read_dir(repository().join(text(&metadata, "maintainer-scripts"))).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none() {
            run(Command::new("sh").arg("-n").arg(&path));
            fs::copy(&path, control.join(path.file_name().unwrap())).unwrap();
        }
    }
    let files = metadata["conf-files"].as_array().unwrap().iter().map(|file| format!("{}\n", file.as_str().unwrap()));
    fs::write(control.join("conffiles"), files.collect::<String>()).unwrap();
    // What the program is linked with is found by `cargo deb`.
    let depends =
        text(&metadata, "depends").strip_prefix("$auto, ").expect("what the program is linked with comes first");
    let [maintainer, recommends, about] =
        ["maintainer", "recommends", "extended-description"].map(|key| text(&metadata, key));
    let fields = format!(
        "Package: ggrade\nVersion: {version}\nArchitecture: all\nMaintainer: {maintainer}\nDepends: {depends}\n\
         Recommends: {recommends}\nDescription: ggrade\n {about}\n"
    );
    fs::write(control.join("control"), fields).unwrap();
    let file = folder.join(format!("ggrade_{version}.deb"));
    run(Command::new("dpkg-deb").args(["--build", "--root-owner-group", "-Znone"]).arg(&tree).arg(&file));
    file
}

/// A machine of which only dpkg's own files are there.
struct Root(tempfile::TempDir);

impl Root {
    fn new() -> Self {
        let root = Self(tempfile::tempdir().unwrap());
        for folder in ["var/lib/dpkg/info", "var/lib/dpkg/updates", "var/lib/systemd", "var/log", "etc/systemd/system"]
        {
            fs::create_dir_all(root.path(folder)).unwrap();
        }
        fs::write(root.path("var/lib/dpkg/status"), "").unwrap();
        root
    }

    fn path(&self, below: &str) -> PathBuf {
        self.0.path().join(below)
    }

    /// Runs dpkg; the package's scripts run as they do in a root that is no machine yet (`DPKG_ROOT`).
    fn dpkg(&self, arguments: &[&str]) {
        let force = "--force-script-chrootless,not-root,depends,bad-path,confold";
        let mut command = Command::new("dpkg");
        run(command
            .arg("--root")
            .arg(self.0.path())
            .arg(force)
            .args(arguments)
            .env("DEBIAN_FRONTEND", "noninteractive"));
    }

    /// Everything but dpkg's own files, and folders that every machine has.
    fn files(&self) -> BTreeSet<String> {
        let all = walkdir::WalkDir::new(self.0.path()).into_iter().map(Result::unwrap);
        let files = all.filter(|entry| !entry.file_type().is_dir());
        let names = files.map(|entry| entry.path().strip_prefix(self.0.path()).unwrap().to_str().unwrap().to_owned());
        names.filter(|name| !name.starts_with("var/lib/dpkg/") && !name.starts_with("var/log/")).collect()
    }
}

#[test]
fn the_package_is_installed_upgraded_removed_and_purged() {
    let folder = tempfile::tempdir().unwrap();
    let [old, new] = ["1.0", "1.1"].map(|version| package(version, folder.path()));
    let root = Root::new();
    root.dpkg(&["--install", old.to_str().unwrap()]);
    let enabled = "etc/systemd/system/multi-user.target.wants/ggrade.service";
    let files = root.files();
    for file in [
        "usr/bin/ggrade",
        "usr/lib/systemd/system/ggrade.service",
        "etc/ggrade/ggrade.toml",
        "usr/share/man/man1/ggrade.1",
        "usr/share/man/man1/ggrade-serve.1",
        "usr/share/man/man1/ggrade-batch-merge.1",
        "usr/share/bash-completion/completions/ggrade",
        "usr/share/zsh/vendor-completions/_ggrade",
        "usr/share/fish/vendor_completions.d/ggrade.fish",
        "usr/share/doc/ggrade/docs/service.md",
        enabled,
    ] {
        assert!(files.contains(file), "{file} is not in {files:#?}");
    }
    // The file has secrets.
    let mode = fs::metadata(root.path("etc/ggrade/ggrade.toml")).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
    runs_as_the_unit_says(&root);

    // An upgrade keeps what the administrator wrote, and what the service keeps.
    fs::write(root.path("etc/ggrade/ggrade.toml"), "queue = 7\n").unwrap();
    for place in ["var/lib/private/ggrade", "var/cache/private/ggrade"] {
        fs::create_dir_all(root.path(place)).unwrap();
        fs::write(root.path(place).join("kept"), "").unwrap();
    }
    std::os::unix::fs::symlink("private/ggrade", root.path("var/lib/ggrade")).unwrap();
    root.dpkg(&["--install", new.to_str().unwrap()]);
    assert_eq!(fs::read_to_string(root.path("etc/ggrade/ggrade.toml")).unwrap(), "queue = 7\n");
    assert!(root.files().contains("var/lib/private/ggrade/kept"));

    root.dpkg(&["--remove", "ggrade"]);
    let left = root.files();
    assert!(left.contains("etc/ggrade/ggrade.toml") && left.contains("var/lib/private/ggrade/kept"), "{left:?}");
    assert!(!left.iter().any(|file| file.starts_with("usr/")), "{left:?}");
    root.dpkg(&["--purge", "ggrade"]);
    assert_eq!(root.files(), BTreeSet::new());
    assert!(!root.path("etc/ggrade").exists() && !root.path("var/lib/private/ggrade").exists());
}

/// Starts what the unit starts, with the file that is installed, and asks it as a health check does.
fn runs_as_the_unit_says(root: &Root) {
    let unit = fs::read_to_string(root.path("usr/lib/systemd/system/ggrade.service")).unwrap();
    let value = |key: &str| {
        let mut values = unit.lines().filter_map(|line| line.strip_prefix(key)?.strip_prefix('='));
        values.next().unwrap_or_else(|| panic!("the unit has no {key}")).to_owned()
    };
    assert_eq!(value("LoadCredential"), "ggrade.toml:/etc/ggrade/ggrade.toml");
    assert_eq!((value("StateDirectory"), value("WorkingDirectory")), ("ggrade".into(), "/var/lib/ggrade".into()));
    let credentials = root.path("etc/ggrade").to_str().unwrap().to_owned();
    let line = value("ExecStart").replace("%d", &credentials);
    let words: Vec<&str> = line.split(' ').collect();
    assert_eq!(words[0], "ggrade", "systemd looks for the program itself");
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(root.path("usr/bin/ggrade"));
    // A port and a database of the test's own, in place of those of the file.
    command.args(&words[1..]).env("GGRADE_DATABASE", folder.path().join("ggrade.db"));
    let (variable, cache) = value("Environment").split_once('=').map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    assert_eq!((variable.as_str(), cache.as_str()), ("GGRADE_CACHE", "/var/cache/ggrade"));
    let running = Running::start(command.env(variable, folder.path()));
    assert!(ready(root.path("usr/bin/ggrade"), &running.address));
}

/// Each line of the file that is shipped is an option, also those that are only shown.
#[test]
fn the_file_of_the_service_has_options_only() {
    let path = repository().join("deploy/debian/ggrade.toml");
    let shipped = fs::read_to_string(path).unwrap();
    let is_option =
        |line: &&str| line.trim_start_matches("# ").split_once(" = ").is_some_and(|(key, _)| !key.contains(' '));
    let lines: Vec<&str> = shipped.lines().filter(is_option).map(|line| line.trim_start_matches("# ")).collect();
    assert!(lines.len() >= 7, "{lines:?}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ggrade.toml");
    fs::write(&file, lines.join("\n")).unwrap();
    let serve = ggrade::cli::ServeArguments { config: Some(file), ..Default::default() };
    let config = ggrade::service::Config::load(&serve).map_err(|fault| fault.message.en).unwrap();
    assert_eq!(config.retention_days, 400);
}
