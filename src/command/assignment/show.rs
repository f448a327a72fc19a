//! `ggrade assignment show`: what a folder says, as a person reads it.

use super::super::{ExitStatus, assignment};
use crate::cli::ShowArguments;
use crate::language::{Language, Text};
use reference::Assignment;
use reference::assignment::{Feed, Stream, Uniform};
use reference::interpreter::Stage;
use reference::scene::{Draw, View};
use std::fmt::Write;

/// Prints it.
pub fn run(arguments: &ShowArguments, language: Language) -> ExitStatus {
    let Some(assignment) = assignment(Some(&arguments.assignment), &[], language) else { return ExitStatus::Usage };
    let shown = AssignmentView { assignment: &assignment, language, text: String::new() };
    anstream::print!("{}", shown.text());
    ExitStatus::FullMarks
}

struct AssignmentView<'a> {
    assignment: &'a Assignment,
    language: Language,
    text: String,
}

impl AssignmentView<'_> {
    fn text(mut self) -> String {
        let Assignment { id, title, task, .. } = self.assignment;
        self.line(&format!("{id}: {}", self.language.of(title)));
        if let Some(task) = task {
            self.line(self.language.of(&task.text));
            self.line(self.language.of(&task.picture));
        }
        self.files();
        self.interface();
        self.scene();
        self.rubric();
        self.mistakes();
        self.head("digest", "ダイジェスト");
        self.line(&self.assignment.digest);
        self.text
    }

    fn word<'t>(&self, en: &'t str, ja: &'t str) -> &'t str {
        if self.language == Language::Ja { ja } else { en }
    }

    fn line(&mut self, line: &str) {
        self.text += line;
        self.text.push('\n');
    }

    fn item(&mut self, line: &str) {
        self.line(&format!("  {line}"));
    }

    fn head(&mut self, en: &str, ja: &str) {
        let word = self.word(en, ja).to_owned();
        self.line("");
        self.line(&word);
    }

    fn files(&mut self) {
        self.head("files", "ファイル");
        let stage =
            |stage| if stage == Stage::Vertex { ("vertex", "頂点") } else { ("fragment", "フラグメント") };
        for file in &self.assignment.files {
            let (en, ja) = stage(file.stage);
            let (name, starter, solution) = (&file.name, &file.starter_name, &file.solution.name);
            let line = Text::new(
                format!("{name}  handed in, {en} stage; starter {starter}, solution {solution}"),
                format!("{name}  提出、{ja}ステージ。配布ファイル {starter}、解答 {solution}"),
            );
            self.item(line.get(self.language));
            for answer in &file.accepted {
                let line =
                    Text::new(format!("  also right: {}", answer.name), format!("  これも正解: {}", answer.name));
                self.item(line.get(self.language));
            }
        }
        for fixed in &self.assignment.fixed {
            let (en, ja) = stage(fixed.stage);
            let line =
                Text::new(format!("{}  fixed, {en} stage", fixed.name), format!("{}  固定、{ja}ステージ", fixed.name));
            self.item(line.get(self.language));
        }
    }

    fn interface(&mut self) {
        let interface = &self.assignment.interface;
        self.head("inputs", "頂点属性");
        for input in &interface.inputs {
            let given = match &input.stream {
                Stream::Mesh(attribute) => format!("carries {}", kebab(&format!("{attribute:?}"))),
                Stream::Listed(values) => format!("{} values", values.len()),
            };
            self.item(&format!("{} {}  {given}", input.kind, input.name));
        }
        self.head("uniforms", "uniform");
        for uniform in &interface.uniforms {
            self.item(&format!("{} {}  {}", uniform.kind, uniform.path, fed(uniform).get(self.language)));
        }
        self.head("outputs", "出力");
        for output in &interface.outputs {
            self.item(&format!("{} {}", output.kind, output.name));
        }
    }

    fn scene(&mut self) {
        let scene = &self.assignment.scene;
        self.head("scene", "シーン");
        let (width, height, cycle) = (scene.width, scene.height, scene.cycle);
        let line = Text::new(
            format!("{width} × {height} pixels, a cycle of {cycle} s"),
            format!("{width} × {height} 画素、周期 {cycle} 秒"),
        );
        self.item(line.get(self.language));
        for view in &scene.views {
            self.view(view);
        }
    }

    fn view(&mut self, view: &View) {
        let poses = view.times.len();
        let View { fovy, near, far, .. } = view;
        let line = Text::new(
            format!("view: {poses} poses, field of view {fovy}, near {near}, far {far}"),
            format!("視点: ポーズ {poses} 個、視野角 {fovy}、near {near}、far {far}"),
        );
        self.item(line.get(self.language));
        for Draw { mesh, instances, depth_test, cull, .. } in &view.draws {
            let (vertices, triangles) = (mesh.vertices.len(), mesh.triangles.len());
            let depth = depth_test.map_or("off".to_owned(), |test| kebab(&format!("{test:?}")));
            let cull = kebab(&format!("{cull:?}"));
            let line = Text::new(
                format!(
                    "  draws {vertices} vertices, {triangles} triangles, {instances} times; depth test {depth}, cull {cull}"
                ),
                format!(
                    "  頂点 {vertices} 個、三角形 {triangles} 個を {instances} 回描く。深度テスト {depth}、カリング {cull}"
                ),
            );
            self.item(line.get(self.language));
        }
    }

    fn rubric(&mut self) {
        self.head("rubric", "採点");
        for line in &self.assignment.rubric {
            let judged = if line.judges.is_empty() { "" } else { &line.judges };
            let without = if line.without.is_some() {
                self.word(", judged by what is seen without it", "、取り除いたときの差で判定")
            } else {
                ""
            };
            let (id, points, label) = (&line.id, line.points, self.language.of(&line.label));
            let word = self.word("points", "点");
            self.item(&format!("{id}  {points} {word}  {label} (`{judged}`{without})"));
        }
        let total = self.assignment.max_score();
        let line = Text::new(format!("{total} points in all"), format!("合計 {total} 点"));
        self.item(line.get(self.language));
    }

    fn mistakes(&mut self) {
        if self.assignment.mistakes.is_empty() {
            return;
        }
        self.head("mistakes, and the share of points that is kept", "誤りと、残る点の割合");
        for mistake in &self.assignment.mistakes {
            let mut keeps = String::new();
            for (line, share) in &mistake.keeps {
                let _ = write!(keeps, " {line} {share}");
            }
            self.item(&format!("{}  {} {keeps}", mistake.id, self.language.of(&mistake.title)));
        }
    }
}

/// Where the value of a uniform comes from.
fn fed(uniform: &Uniform) -> Text {
    let given = match &uniform.feed {
        Feed::Role(role) => {
            let role = kebab(&format!("{role:?}"));
            Text::new(format!("carries {role}"), format!("役割 {role}"))
        }
        Feed::Constant(value) => {
            // Kept as the program is given it, which has fewer digits than a double.
            let numbers: Vec<_> = value.numbers().iter().map(|&number| (number as f32).to_string()).collect();
            Text::verbatim(numbers.join(" "))
        }
        Feed::Expression(_) => Text::new("an expression", "式"),
        Feed::Drawn { at_probes: number, .. } | Feed::Texture(number) => {
            Text::new(format!("texture {}", number + 1), format!("テクスチャ {}", number + 1))
        }
    };
    match uniform.probe {
        Some(_) => Text::new(format!("{}, varies in probes", given.en), format!("{}、検査点ごとに変わる", given.ja)),
        None => given,
    }
}

/// `ModelView` as folders write it.
fn kebab(name: &str) -> String {
    let mut text = String::new();
    for character in name.chars() {
        if character.is_uppercase() && !text.is_empty() {
            text.push('-');
        }
        text.extend(character.to_lowercase());
    }
    text
}
