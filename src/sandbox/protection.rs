//! What holds a worker, as the worker itself found it.

use crate::language::Text;
use serde::{Deserialize, Serialize};

/// What to do where a worker can still reach what it must not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Policy {
    /// Refuse to grade.
    #[default]
    Required,
    /// Grade, and say what is open.
    BestEffort,
}

/// One wall around a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layer {
    /// Without root's rights.
    User,
    /// Bounded memory, CPU time, core size and descriptors.
    Limits,
    /// Landlock: nothing can be written, and only the driver's files read.
    Files,
    /// seccomp: only the system calls that a grading makes.
    SystemCalls,
}

/// Whether a layer holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LayerState {
    /// Which one.
    pub layer: Layer,
    /// Whether it holds.
    pub holds: bool,
    /// Its version, or what the kernel answered.
    pub detail: String,
}

/// Something that a worker must not be able to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reach {
    /// Open a file for reading.
    Read,
    /// Create a file.
    Write,
    /// Make a socket.
    Socket,
    /// Connect to this machine.
    Connect,
    /// Start a program.
    Child,
}

/// The layers around a worker, and what it could do in spite of them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Protection {
    /// Every layer.
    pub layers: Vec<LayerState>,
    /// What the worker tried before its first submission, and could do.
    pub open: Vec<Reach>,
}

impl Protection {
    /// Whether everything that was tried was refused.
    pub fn is_closed(&self) -> bool {
        self.open.is_empty()
    }

    /// What is missing, in one sentence; `None` where nothing is missing.
    pub fn notice(&self) -> Option<Text> {
        let missing: Vec<_> = self.layers.iter().filter(|state| !state.holds).map(|state| state.layer.name()).collect();
        let open: Vec<_> = self.open.iter().map(|reach| reach.name()).collect();
        if missing.is_empty() && open.is_empty() {
            return None;
        }
        let en = |texts: &[Text]| texts.iter().map(|text| text.en.as_str()).collect::<Vec<_>>().join(", ");
        let ja = |texts: &[Text]| texts.iter().map(|text| text.ja.as_str()).collect::<Vec<_>>().join("、");
        let mut notice = Text::default();
        if !missing.is_empty() {
            notice.en = format!("this machine lacks layers of the sandbox: {}", en(&missing));
            notice.ja = format!("このマシンではサンドボックスの一部が使えません: {}", ja(&missing));
        }
        if !open.is_empty() {
            let (en, ja) = (en(&open), ja(&open));
            let (comma, point) = if missing.is_empty() { ("", "") } else { ("; ", "。") };
            notice.en = format!("{}{comma}a grading process can: {en}", notice.en);
            notice.ja = format!("{}{point}採点プロセスにできてしまうこと: {ja}", notice.ja);
        }
        Some(notice)
    }
}

impl Layer {
    /// Its name for a person.
    pub fn name(self) -> Text {
        match self {
            Self::User => Text::new("unprivileged user", "非特権ユーザでの実行"),
            Self::Limits => Text::new("resource limits", "資源の制限"),
            Self::Files => Text::new("file access (Landlock)", "ファイルアクセスの制限 (Landlock)"),
            Self::SystemCalls => Text::new("system calls (seccomp)", "システムコールの制限 (seccomp)"),
        }
    }
}

impl Reach {
    /// Its name for a person.
    pub fn name(self) -> Text {
        match self {
            Self::Read => Text::new("open files", "ファイルを開く"),
            Self::Write => Text::new("create files", "ファイルを作る"),
            Self::Socket => Text::new("make sockets", "ソケットを作る"),
            Self::Connect => Text::new("connect to the network", "ネットワークに接続する"),
            Self::Child => Text::new("start programs", "プログラムを起動する"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(layer: Layer, holds: bool) -> LayerState {
        LayerState { layer, holds, detail: String::new() }
    }

    #[test]
    fn a_closed_sandbox_gives_no_notice() {
        let protection = Protection { layers: vec![state(Layer::User, true)], open: Vec::new() };
        assert!(protection.is_closed());
        assert_eq!(protection.notice(), None);
    }

    #[test]
    fn a_notice_names_what_is_missing_and_what_is_open() {
        let layers = vec![state(Layer::User, true), state(Layer::Files, false)];
        let missing = Protection { layers: layers.clone(), open: Vec::new() };
        assert!(missing.is_closed(), "a missing layer alone opens nothing");
        assert!(
            missing.notice().is_some_and(|notice| notice.en.contains("Landlock") && notice.ja.contains("Landlock"))
        );
        let open = Protection { layers, open: vec![Reach::Socket] };
        assert!(!open.is_closed());
        assert!(
            open.notice().is_some_and(|notice| notice.en.contains("Landlock") && notice.en.ends_with("make sockets"))
        );
    }
}
