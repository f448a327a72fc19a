//! `assignment.toml` as it is written, with what there is to change.

use super::{FolderPlan, SCHEMA};
use crate::interpreter::Stage;

/// A text as TOML has it.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// The id as a title: `toon-shading` is `Toon shading`.
fn title(id: &str) -> String {
    let words = id.replace(['-', '_'], " ");
    let mut characters = words.chars();
    characters.next().map_or_else(String::new, |first| first.to_uppercase().chain(characters).collect())
}

pub(super) fn manifest(plan: &FolderPlan) -> String {
    let mut text = format!(
        "#:schema ./{SCHEMA}\n# A homework. Every key: docs/assignment-toml.md, or `ggrade assignment schema` for an editor.\n\
         # `ggrade assignment check .` says what is wrong in this folder.\n\nid = {}\n",
        quoted(&plan.id)
    );
    let name = title(&plan.id);
    text += &format!("title = {{ en = {0}, ja = {0} }} # write it in both languages\n", quoted(&name));
    text += &task(plan);
    text += &files(plan);
    text += "\n# ---- What the program gives the shader ----\n";
    for attribute in &plan.attributes {
        text += &format!("\n[[input]]\nname = {}\n{}\n", quoted(&attribute.name), attribute.said);
    }
    for uniform in &plan.uniforms {
        text += &format!("\n[[uniform]]\nname = {}\n{}\n", quoted(&uniform.name), uniform.lines.join("\n"));
    }
    if plan.uniforms.iter().any(|uniform| uniform.texture.is_some()) {
        text += "\n# Pictures that are computed; `file = \"brick.png\"` takes one from this folder.\n";
    }
    for texture in plan.uniforms.iter().filter_map(|uniform| uniform.texture.as_ref()) {
        text += &format!("\n[[texture]]\nname = {}\n{}\n", quoted(&texture.name), texture.lines.join("\n"));
    }
    text += &format!("\n# ---- What is drawn ----\n\n[scene]\n{}\n", plan.scene.lines.join("\n"));
    text += &rubric(plan);
    text
}

fn task(plan: &FolderPlan) -> String {
    let files = plan.sources.iter().map(|source| format!("`{}`", source.name)).collect::<Vec<_>>();
    let (en, ja) = (files.join(" and "), files.join(" と "));
    let entries = plan.sources.iter().map(|source| format!("`{}`", source.entry)).collect::<Vec<_>>();
    let entry = &entries[0];
    let (seen_en, seen_ja) = plan.scene.seen;
    [
        "\n# What students read: what there is to do, and what the right picture shows. Names between backticks are code.\n[task]\n".to_owned(),
        format!("text.en = {}\n", quoted(&format!("Write {entry} in {en} so that the picture becomes the expected one."))),
        format!("text.ja = {}\n", quoted(&format!("{ja} の {entry} を書き、期待される画像と同じになるようにしてください。"))),
        format!("picture.en = {}\n", quoted(&format!("{seen_en}."))),
        format!("picture.ja = {}\n", quoted(&format!("{seen_ja}。"))),
    ]
    .concat()
}

fn files(plan: &FolderPlan) -> String {
    let mut text = "\n# ---- What is handed in ----\n".to_owned();
    for source in &plan.sources {
        let stage = if source.stage == Stage::Vertex { "vertex" } else { "fragment" };
        text += &format!(
            "\n[[file]]\nname = {}\nstage = {stage:?}\nstarter = {}\nsolution = {}\n",
            quoted(&source.name),
            quoted(&source.starter_name()),
            quoted(&source.solution_name())
        );
    }
    if let Some(fixed) = &plan.fixed {
        let stage = if fixed.stage == Stage::Vertex { "vertex" } else { "fragment" };
        text += &format!(
            "\n# The other stage, which every hand-in is linked with.\n[[fixed]]\nstage = {stage:?}\nfile = {}\n",
            quoted(&fixed.name())
        );
    }
    text
}

fn rubric(plan: &FolderPlan) -> String {
    let mut text = "\n# ---- What it is worth: points, and what is said ----\n".to_owned();
    let points = shares(plan.rubric.len());
    if plan.rubric.iter().any(|line| line.without.is_some()) {
        text += "\n# `without` is the solution without what the line judges.\n";
    } else {
        text += "\n# More lines: `without = { replace = [[\"text of the solution\", \"other text\"]] }` tells what a line judges.\n";
    }
    for (line, points) in plan.rubric.iter().zip(points) {
        text += &format!("\n[[rubric]]\nid = {}\npoints = {points}\n", quoted(&line.id));
        text += &format!("label = {{ en = {}, ja = {} }}\n", quoted(&line.label.en), quoted(&line.label.ja));
        text += &line.judges.as_ref().map(|judged| format!("judges = {}\n", quoted(judged))).unwrap_or_default();
        if let Some(change) = &line.without {
            text += &format!("without = {}\n", change.text());
        }
    }
    let missing: Vec<_> = plan.rubric.iter().filter(|line| line.without.is_some()).collect();
    if !missing.is_empty() {
        text += "\n# ---- Known mistakes: what is said to who made one, and the share of each line's points that is kept ----\n\
                 # More: wrong signs, forgotten `normalize`, a factor left out: each as a change of the solution.\n";
    }
    for line in missing {
        let Some(change) = &line.without else { continue };
        let (en, ja) = (&line.in_sentences.en, &line.in_sentences.ja);
        text += &format!("\n[[mistake]]\nid = {}\n", quoted(&format!("no-{}", line.id)));
        text += &format!(
            "title = {{ en = {}, ja = {} }}\n",
            quoted(&format!("{}: missing", line.label.en)),
            quoted(&format!("{}がない", ja.replacen('`', "「", 1).replacen('`', "」", 1)))
        );
        text += &format!("keeps = {{ {} = 0 }}\nvariants = [{}]\n", key(&line.id), change.text());
        text += &format!(
            "seen.en = {}\nseen.ja = {}\n",
            quoted(&format!("{en}: nothing of it shows in the picture.")),
            quoted(&format!("画像に{ja}が現れていません。"))
        );
        text += &format!(
            "equation.en = {}\nequation.ja = {}\n",
            quoted(&format!("{en} is a part of what the picture has to show.")),
            quoted(&format!("{ja}は、求められている画像の一部です。"))
        );
        text += &format!(
            "look.en = {}\nlook.ja = {}\n",
            quoted(&format!("{en}: which statement of yours computes it, and does its value reach the output?")),
            quoted(&format!("{ja}を計算している文はどれでしょうか。その値は出力まで届いているでしょうか。"))
        );
    }
    text
}

/// A key as TOML has it: bare where that is possible.
fn key(id: &str) -> String {
    let is_bare = id.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_'));
    if is_bare { id.to_owned() } else { quoted(id) }
}

/// 100 points in as many whole shares, the first ones greater.
fn shares(count: usize) -> Vec<usize> {
    (0..count).map(|at| 100 / count + usize::from(at < 100 % count)).collect()
}
