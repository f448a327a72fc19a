//! From the manifest to an assignment: every name is resolved, every expression typed, every number in range.

mod about;
mod advice;
mod answers;
mod constants;
mod expression;
mod features;
mod host;
mod interface;
mod meshes;
mod mistakes;
mod moving;
mod names;
mod passes;
mod probing;
mod rubric;
mod scene;
mod solution;
mod stages;
mod textures;
mod typeset;
mod variants;

use super::{Assignment, AssignmentError, FixedStage, Gradual, HandedIn, MANIFEST, error};
use crate::Folder;
use crate::accepted::AcceptedAnswer;
use crate::interpreter::{Stage, Texture};
use crate::manifest::{self, Manifest};
use crate::mistake::Mistake;
use crate::text::both;
use solution::CheckedSolution;
use std::sync::Arc;
use variants::Variants;

/// What is said of features, the first also of terms.
const OF_FEATURES: [&str; 2] = [PART_MISSING, "part-scaled"];
const PART_MISSING: &str = "part-missing";

/// What is said of a fragment stage: that it throws everything away, or is wrong in a few pixels.
const OF_FRAGMENTS: [&str; 2] = ["nothing-drawn", "few-pixels"];

type CheckResult<T> = Result<T, AssignmentError>;

/// `place_at`: where a byte of `assignment.toml` stands.
pub(super) fn assignment(
    mut m: Manifest,
    place_at: &dyn Fn(usize) -> String,
    folder: &Folder,
) -> CheckResult<Assignment> {
    check_id(&m.id, folder)?;
    let read = |name: &str| -> CheckResult<String> { folder.text(name).map(str::to_owned) };
    let mut files = files(&m.file, &read)?;
    let fixed = fixed(&m, &read)?;
    let stages = stages::Stages::of(&files, &fixed)?;
    let pipeline = stages.pipeline()?;
    for (file, entry) in files.iter_mut().zip(&m.file) {
        file.accepted = stages.accepted(file.stage, &entry.accepted, &read)?;
    }
    let mut solution = CheckedSolution::read(&files, &pipeline, &m.constant)?;
    let mut scene = scene::scene(&m.scene, folder, place_at)?;
    if pipeline.vertex.inputs().iter().any(|input| input.name == "gl_InstanceID") {
        scene.number_instances();
    }
    let textures = textures::textures(&m.texture, scene.all_poses().len(), folder, place_at)?;
    let interface = interface::interface(&m, &textures, &stages, &solution, place_at)?;
    let free = interface::free(&m, &textures, &stages, place_at)?;
    host::is_known(&files, solution.why_whole())?;
    passes::pass(&m, &textures, &mut scene, &interface, &read, place_at)?;
    let constants = constants::constants(&files, std::mem::take(&mut m.constant))?;
    let texts: Vec<&str> = files.iter().map(|file| file.solution.text.as_str()).collect();
    let lines = rubric::rubric(&mut m.rubric, &solution, &texts)?;
    for constant in &constants {
        rubric::known_line(&lines, &constant.line, &format!("constant `{}`", constant.name))?;
    }
    let typeset = m.equation.take().map(|entry| typeset::typeset(entry, &lines, place_at)).transpose()?;
    let variants = Variants { files: &files, stages: &stages, read: &read };
    let unjudged = programs(&m.unjudged, "unjudged", &variants, place_at)?;
    let revealed = programs(&m.probes.reveal, "`reveal`", &variants, place_at)?;
    let terms = features::terms(&m, &mut solution)?;
    let features = features::features(&m, &terms, &variants, place_at)?;
    let mistakes = std::mem::take(&mut m.mistake);
    let mut mistakes = mistakes::all(mistakes, &m.rubric, &mut solution, &constants, &variants, place_at)?;
    if features.iter().all(Option::is_none) {
        // A sum may lack a term somewhere.
        let is_of_terms = |mistake: &Mistake| mistake.id == PART_MISSING && terms.iter().any(Option::is_some);
        mistakes.retain(|mistake| !OF_FEATURES.contains(&mistake.id.as_str()) || is_of_terms(mistake));
    }
    if files.iter().all(|file| file.stage != Stage::Fragment) {
        mistakes.retain(|mistake| !OF_FRAGMENTS.contains(&mistake.id.as_str()));
    }
    let gradual = gradual(&m, &mistakes, place_at)?;
    let time = m.time.as_ref().map_or(Ok(1), |entry| time(entry, place_at))?;
    let probing = probing::probing(&m.probes, &constants, &solution)?;
    let regions = probing::regions(std::mem::take(&mut m.region), &mut solution, &m.rubric, place_at)?;
    let advice = std::mem::take(&mut m.advice).into_iter();
    let advice = advice.map(|entry| advice::advice(entry, &interface, &constants, &solution));
    let advice = advice.collect::<CheckResult<Vec<_>>>()?;
    let textures: Arc<[Texture]> = textures.into();
    let names = names::names(std::mem::take(&mut m.definition), &solution, &files)?;
    let equation = solution.finish(&interface, &pipeline, &constants, Arc::clone(&textures))?;
    let mut assignment = Assignment {
        scene,
        files,
        id: m.id,
        digest: String::new(),
        folder: Arc::default(),
        task: m.task,
        typeset,
        title: m.title,
        fixed,
        textures,
        pipeline,
        interface,
        free,
        unjudged,
        gradual,
        revealed,
        constants,
        names,
        equation,
        rubric: m.rubric,
        terms,
        features,
        mistakes,
        advice,
        regions,
        time,
        probing,
        derived: Arc::default(),
        traced: Arc::default(),
    };
    about::complete(&mut assignment);
    probing::lobe_is_known(&assignment)?;
    answers::are_defined(&assignment)?;
    moving::complete(&mut assignment);
    assignment.probing.takes_backs = assignment.shows_backs();
    Ok(assignment)
}

fn files(files: &[manifest::File], read: &dyn Fn(&str) -> CheckResult<String>) -> CheckResult<Vec<HandedIn>> {
    if files.is_empty() {
        return Err(error(
            "file",
            both("nothing is handed in: write [[file]]", "提出するファイルがありません。[[file]] を書いてください"),
        ));
    }
    let handed_in = |file: &manifest::File| {
        let solution = super::Solution { text: read(&file.solution)?, name: file.solution.clone() };
        let (solution, program) = host::program(file, files.len(), solution, read)?;
        Ok(HandedIn {
            // They are read when it is known what they are linked with.
            accepted: Vec::new(),
            starter: read(&file.starter)?,
            starter_name: file.starter.clone(),
            solution,
            program,
            name: file.name.clone(),
            stage: file.stage,
        })
    };
    files.iter().map(handed_in).collect()
}

fn fixed(m: &Manifest, read: &dyn Fn(&str) -> CheckResult<String>) -> CheckResult<Vec<FixedStage>> {
    let all = m.fixed.iter().chain(m.file.iter().flat_map(|file| &file.fixed));
    all.map(|one| Ok(FixedStage { stage: one.stage, name: one.file.clone(), text: read(&one.file)? })).collect()
}

/// The programs of variants that a key lists.
fn programs(
    listed: &[toml::Spanned<manifest::Variant>],
    key: &str,
    variants: &Variants<'_>,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Vec<AcceptedAnswer>> {
    let program = |entry: &toml::Spanned<manifest::Variant>| {
        variants.program(entry.get_ref(), &format!("{}, {key}", place_at(entry.span().start)))
    };
    listed.iter().map(program).collect()
}

/// No hand-in may take longer than this, in usual times.
const MOST_TIME: u32 = 10;

fn time(entry: &toml::Spanned<u32>, place_at: &dyn Fn(usize) -> String) -> CheckResult<u32> {
    let time = *entry.get_ref();
    if (1..=MOST_TIME).contains(&time) {
        return Ok(time);
    }
    Err(error(
        format!("{}, time", place_at(entry.span().start)),
        both(
            format!("is {time}: write how many times as long as usual a hand-in may take, from 1 to {MOST_TIME}"),
            format!("{time} になっています。通常の何倍の時間を認めるかを、1 から {MOST_TIME} までで書いてください"),
        ),
    ))
}

/// The mistakes of what is not gradual. Edges are those of what a pass draws.
fn gradual(m: &Manifest, mistakes: &[Mistake], place_at: &dyn Fn(usize) -> String) -> CheckResult<Option<Gradual>> {
    let Some(entry) = &m.gradual else { return Ok(None) };
    let known = |id: &toml::Spanned<String>| {
        let place = format!("{}, gradual", place_at(id.span().start));
        if m.pass.is_empty() || m.unjudged.is_empty() {
            return Err(error(
                place,
                both(
                    "is about the edges of what a pass draws, where it is not judged: write [[pass]] and [[unjudged]], or remove it",
                    "[[pass]] が描くものの境目のうち、[[unjudged]] により採点しない場所についての設定です。両方を書くか、取り除いてください",
                ),
            ));
        }
        let id = id.get_ref();
        if !mistakes.iter().any(|mistake| mistake.id == *id) {
            return Err(error(
                place,
                both(
                    format!("there is no mistake `{id}`: correct the name, or write its [[mistake]]"),
                    format!("`{id}` という mistake はありません。名前を直すか、[[mistake]] を書いてください"),
                ),
            ));
        }
        Ok(id.clone())
    };
    Ok(Some(Gradual { abrupt: known(&entry.abrupt)?, uneven: known(&entry.uneven)? }))
}

/// Longest id of an assignment, in characters.
const LONGEST_ID: usize = 64;

/// The id stands in addresses and in names of files.
fn check_id(id: &str, folder: &Folder) -> CheckResult<()> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if (1..=LONGEST_ID).contains(&id.len()) && id.chars().all(is_plain) && !id.starts_with('.') {
        return Ok(());
    }
    let (en, ja) = (
        format!(
            "the id `{id}` cannot stand in an address: write 1 to {LONGEST_ID} of the letters a–z and A–Z, digits, `-`, `_` and `.`, \
             with no `.` at the beginning"
        ),
        format!(
            "id `{id}` はアドレスに使えません。半角英数字、`-`、`_`、`.` を使い、先頭が `.` でない {LONGEST_ID} 文字以内の\
             名前にしてください"
        ),
    );
    // Top-level keys stand before all entries.
    let is_id = |line: &str| line.split_once('=').is_some_and(|(key, _)| key.trim() == "id");
    let at = folder.text(MANIFEST)?.lines().position(is_id).map_or(1, |index| index + 1);
    Err(error(format!("{MANIFEST}, line {at}"), both(en, ja)))
}

/// Names as a sentence has them.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
