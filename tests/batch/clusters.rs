//! A class in parts on what universities have: a Slurm cluster of two nodes, which run on this machine, and GNU parallel.

use crate::class::{Place, REJECTED, WRONG, ggrade, sample};
use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Formats that say nothing of the time that a grading took, and a seed.
const OPTIONS: [&str; 4] = ["--formats", "csv,vpl", "--seed", "11"];

/// Longest wait for the cluster to come up, and for its jobs.
const PATIENCE: Duration = Duration::from_secs(180);

fn class() -> Place {
    let place = Place::of_many(60);
    for (student, file) in [("copy-1", WRONG), ("copy-2", WRONG), ("broken", REJECTED)] {
        place.hand_in(student, &sample(file));
    }
    place.batch("whole").args(OPTIONS).assert().code(1);
    place
}

#[test]
fn a_slurm_array_gives_what_one_run_gives() {
    let (place, cluster) = (class(), Cluster::start());
    let submit = Path::new(env!("CARGO_MANIFEST_DIR")).join("deploy/slurm/submit");
    let mut command = cluster.command(submit);
    command.arg(place.at("cluster")).arg(place.at("class")).args(["--formats", "csv,vpl", "--deadline", "10"]);
    command.env("GGRADE", env!("CARGO_BIN_EXE_ggrade")).env("SHARDS", "3").env("SEED", "11");
    let said = command.env("LANG", "C").env_remove("GGRADE_LANG").output().unwrap();
    assert!(said.status.success(), "{said:?}");
    cluster.wait_for("the jobs", || cluster.told("squeue", &["--noheader"]).is_empty());
    let logs = || cluster.log() + &fs::read_to_string(place.at("cluster/merge.log")).unwrap_or_default();
    assert!(place.at("cluster/results/results.jsonl").exists(), "{}", logs());
    for shard in 1..=3 {
        assert!(place.at("cluster/shards").join(format!("{shard}/results.jsonl")).exists(), "{}", logs());
    }
    assert_eq!(place.files("cluster/results"), place.files("whole"), "{}", logs());
}

#[test]
fn gnu_parallel_gives_what_one_run_gives() {
    let place = class();
    let script = r#"seq 3 | parallel -j 2 --wd . "$GGRADE" batch class --out parts/{} --shard {}/3 --deadline 10 "$@" &&
                    "$GGRADE" batch merge class --out merged --deadline 10 "$@" --shards parts/1 parts/2 parts/3"#;
    let mut command = assert_cmd::Command::new("sh");
    command.current_dir(place.at("")).args(["-c", script, "sh"]).args(OPTIONS);
    command.env("GGRADE", ggrade().get_program()).env("HOME", place.at("")).env("LANG", "C").env_remove("GGRADE_LANG");
    command.assert().code(1);
    assert_eq!(place.files("merged"), place.files("whole"));
}

/// A controller and two nodes, each a process on this machine, which end with it.
struct Cluster {
    folder: tempfile::TempDir,
    processes: Vec<Child>,
}

impl Cluster {
    fn start() -> Self {
        let mut cluster = Self { folder: tempfile::tempdir().unwrap(), processes: Vec::new() };
        let folder = cluster.folder.path().display().to_string();
        fs::create_dir(cluster.at("state")).unwrap();
        fs::create_dir(cluster.at("log")).unwrap();
        let user = nix::unistd::User::from_uid(nix::unistd::Uid::effective()).unwrap().expect("a user").name;
        let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap();
        let host = host.trim().split('.').next().unwrap();
        // Held until all are known, so that no two are the same.
        let free: Vec<TcpListener> = (0..3).map(|_| TcpListener::bind("127.0.0.1:0").unwrap()).collect();
        let [controller, first, second] = [0, 1, 2].map(|index: usize| free[index].local_addr().unwrap().port());
        drop(free);
        let socket = format!("{folder}/munge");
        let configuration = format!(
            "ClusterName=test\nSlurmctldHost={host}(127.0.0.1)\nSlurmctldPort={controller}\nSlurmUser={user}\n\
             SlurmdUser={user}\nAuthType=auth/munge\nCredType=cred/munge\nAuthInfo=socket={socket}\nMpiDefault=none\n\
             StateSaveLocation={folder}/state\nSlurmdSpoolDir={folder}/spool-%n\nSlurmctldPidFile={folder}/controller.pid\n\
             SlurmdPidFile={folder}/%n.pid\nSlurmctldLogFile={folder}/log/controller\nSlurmdLogFile={folder}/log/%n\n\
             ProctrackType=proctrack/pgid\nTaskPlugin=task/none\nSelectType=select/cons_tres\n\
             SelectTypeParameters=CR_Core\nReturnToService=2\nSlurmdParameters=config_overrides\n\
             NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={first} CPUs=2\n\
             NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={second} CPUs=2\n\
             PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP\n"
        );
        fs::write(cluster.at("slurm.conf"), configuration).unwrap();
        let key: Vec<u8> = (0..128).collect();
        fs::write(cluster.at("munge.key"), key).unwrap();
        let mut permissions = fs::metadata(cluster.at("munge.key")).unwrap().permissions();
        std::os::unix::fs::PermissionsExt::set_mode(&mut permissions, 0o600);
        fs::set_permissions(cluster.at("munge.key"), permissions).unwrap();
        let at = |name: &str| format!("{folder}/{name}");
        let (key, seed, log, pid) = (at("munge.key"), at("munge.seed"), at("log/munge"), at("munge.pid"));
        cluster.run(
            "/usr/sbin/munged",
            &[
                "--foreground",
                "--force",
                "--socket",
                &socket,
                "--key-file",
                &key,
                "--seed-file",
                &seed,
                "--log-file",
                &log,
                "--pid-file",
                &pid,
            ],
        );
        cluster.wait_for("munge", || Path::new(&socket).exists());
        cluster.run("/usr/sbin/slurmctld", &["-D"]);
        cluster.run("/usr/sbin/slurmd", &["-D", "-N", "n1"]);
        cluster.run("/usr/sbin/slurmd", &["-D", "-N", "n2"]);
        cluster.wait_for("the nodes", || cluster.told("sinfo", &["--noheader", "--format=%D %T"]).trim() == "2 idle");
        cluster
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, program: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = Command::new(program);
        command.env("SLURM_CONF", self.at("slurm.conf")).stdin(Stdio::null());
        command
    }

    fn run(&mut self, program: &str, arguments: &[&str]) {
        let mut command = self.command(program);
        command.args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
        let started = command.spawn();
        self.processes
            .push(started.unwrap_or_else(|error| panic!("{program}: {error}; script/bootstrap --test has it")));
    }

    /// What a program of Slurm prints.
    fn told(&self, program: &str, arguments: &[&str]) -> String {
        let output = self.command(program).args(arguments).output().unwrap();
        // A controller that is not there yet is no answer.
        if output.status.success() { String::from_utf8(output.stdout).unwrap() } else { "no answer".into() }
    }

    fn wait_for(&self, what: &str, mut is_there: impl FnMut() -> bool) {
        let give_up = Instant::now() + PATIENCE;
        while !is_there() {
            assert!(Instant::now() < give_up, "{what} did not come:\n{}", self.log());
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    fn log(&self) -> String {
        let logs = ["munge", "controller", "n1", "n2"].map(|name| self.at("log").join(name));
        logs.iter().filter_map(|path| fs::read_to_string(path).ok()).collect()
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        for process in self.processes.iter_mut().rev() {
            let _ = process.kill();
            let _ = process.wait();
        }
    }
}
