//! The rules of a run: the assignment's known mistakes, and the stages that have something to say about a file.

use crate::class::Class;
use crate::class::formats::untrusted::one_line;
use crate::diagnostic::DiagnosticStage;
use crate::language::{Language, Text};
use crate::report::UNEXPLAINED;
use crate::report::labels::{Labels, mistake_title};
use reference::mistake::Mistake;
use serde_json::{Value, json};
use std::collections::HashMap;

/// The rule of what a stage says.
pub(super) fn stage(stage: DiagnosticStage) -> &'static str {
    match stage {
        DiagnosticStage::Source => "source",
        DiagnosticStage::Compile => "compile",
        DiagnosticStage::Link => "link",
        DiagnosticStage::Interface => "interface",
        DiagnosticStage::Run => "run",
    }
}

/// The rules, in the order of their indices.
pub(super) struct RuleTable {
    values: Vec<Value>,
    indices: HashMap<String, usize>,
}

impl RuleTable {
    /// Those that reports of the class can name.
    pub fn of(class: &Class) -> Self {
        let mut rules = Self { values: Vec::new(), indices: HashMap::new() };
        let language = class.language;
        for stage_of in [
            DiagnosticStage::Source,
            DiagnosticStage::Compile,
            DiagnosticStage::Link,
            DiagnosticStage::Interface,
            DiagnosticStage::Run,
        ] {
            let id = stage(stage_of);
            let (short, full) = (Labels::of(language).stage(stage_of), about(stage_of));
            let help = Text::new(
                "Look at the first error first: later ones often follow from it.",
                "最初のエラーから直してみましょう。後のエラーは最初のエラーが原因であることがよくあります。",
            );
            rules.add(id, "Stage", "error", texts(short, full.get(language), help.get(language)));
        }
        for mistake in &class.assignment.mistakes {
            let title = mistake_title(&class.assignment, &mistake.id, language);
            rules.add(&mistake.id, "Mistake", "warning", described(&title, mistake, language));
        }
        for advice in &class.assignment.advice {
            let text = advice.message.fill(&[]);
            let text = Text::new(text.en, text.ja).get(language).to_owned();
            rules.add(&advice.id, "Advice", "note", texts(&text, &text, &text));
        }
        // Mistakes that are found otherwise than by the equation have no description in the assignment.
        let named = class.entries.iter().filter_map(|entry| entry.report());
        let named = named.flat_map(|report| &report.rubric).filter_map(|line| line.mistake.as_deref());
        for id in named.chain([UNEXPLAINED]) {
            let lost = Text::new("Points are lost here.", "この箇所で減点があります。");
            let lost = lost.get(language);
            rules.add(id, "Mistake", "warning", texts(&one_line(id), lost, lost));
        }
        rules
    }

    /// Adds a rule, if it is not there; `kind` ends its name, which has to be another than its id.
    fn add(&mut self, id: &str, kind: &str, level: &str, mut rule: Value) {
        if self.indices.contains_key(id) {
            return;
        }
        rule["id"] = json!(id);
        rule["name"] = json!(format!("{}{kind}", pascal_case(id)));
        rule["defaultConfiguration"] = json!({ "level": level });
        self.indices.insert(id.to_owned(), self.values.len());
        self.values.push(rule);
    }

    /// The index of the rule `id`.
    pub fn index(&self, id: &str) -> Option<usize> {
        self.indices.get(id).copied()
    }

    pub fn into_values(self) -> Vec<Value> {
        self.values
    }
}

/// What a finding of the stage means.
fn about(stage: DiagnosticStage) -> Text {
    match stage {
        DiagnosticStage::Source => {
            Text::new("The file cannot be read as a shader.", "ファイルをシェーダとして読み込めません。")
        }
        DiagnosticStage::Compile => Text::new(
            "The compiler does not take the shader, or warns about it.",
            "コンパイラがシェーダを受け付けないか、警告しています。",
        ),
        DiagnosticStage::Link => {
            Text::new("The shaders of the program do not go together.", "プログラムのシェーダ同士をリンクできません。")
        }
        DiagnosticStage::Interface => Text::new(
            "The inputs, uniforms or outputs are not those of the assignment.",
            "入力変数、uniform 変数、出力変数が課題の指定と異なります。",
        ),
        DiagnosticStage::Run => Text::new("The shader was stopped while it ran.", "シェーダの実行を中断しました。"),
    }
}

/// `specular-phong` as `SpecularPhong`: the form in which viewers show the name of a rule.
fn pascal_case(id: &str) -> String {
    let capital = |word: &str| {
        let mut letters = word.chars();
        letters.next().map(|first| first.to_ascii_uppercase().to_string() + letters.as_str()).unwrap_or_default()
    };
    id.split(|c: char| !c.is_ascii_alphanumeric()).map(capital).collect()
}

/// The title of the mistake, and what the assignment says of it, with the places left out that only a file can fill in.
fn described(title: &str, mistake: &Mistake, language: Language) -> Value {
    let said = |text: &reference::Text| {
        let text = text.fill(&[]);
        Text::new(text.en, text.ja).get(language).to_owned()
    };
    let between = if language == Language::En { " " } else { "" };
    let full = [said(&mistake.seen), said(&mistake.equation)].join(between);
    texts(title, full.trim(), &said(&mistake.look))
}

/// The three texts that GitHub's code scanning wants of every rule; where there is no fuller one, the short one.
fn texts(short: &str, full: &str, help: &str) -> Value {
    let text = |text: &str| json!({ "text": if text.trim().is_empty() { short } else { text } });
    json!({ "shortDescription": text(short), "fullDescription": text(full), "help": text(help) })
}
