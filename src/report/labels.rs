//! Every word of our own in the views, in one table.

mod phrases;

use super::text::number;
use super::{Lateness, Report, Verdict};
use crate::language::{Language, span};
use reference::Assignment;

/// The title of a mistake, as lists name it; its id where the assignment does not know it, as in an old report.
pub(crate) fn mistake_title(assignment: &Assignment, id: &str, language: Language) -> String {
    assignment.title_of(id).map_or_else(|| id.to_owned(), |title| language.of(&title).to_owned())
}

/// The name of a line of the rubric; its id where the assignment does not know it.
pub(crate) fn rubric_label<'a>(assignment: &'a Assignment, id: &'a str, language: Language) -> &'a str {
    let known = assignment.rubric.iter().find(|line| line.id == id);
    known.map_or(id, |line| language.of(&line.label))
}

/// What lateness takes off, and what is left: `Late by 1 day 2 hours: −20`, `Counts: 60 / 100`.
pub(crate) fn lateness(lateness: Lateness, report: &Report, language: Language) -> [String; 2] {
    let late = span(lateness.milliseconds, language);
    let penalty = number(lateness.penalty);
    let penalty = if lateness.penalty > 0.0 { format!("−{penalty}") } else { penalty };
    let (total, most) = (number(report.total()), number(report.max_score));
    match language {
        Language::En => [format!("Late by {late}: {penalty}"), format!("Counts: {total} / {most}")],
        Language::Ja => [format!("遅延 {late}: {penalty}"), format!("成績に入る得点: {total} / {most}")],
    }
}

/// The words of one language.
#[derive(Debug)]
pub(crate) struct Labels {
    /// The language as a BCP 47 tag.
    pub tag: &'static str,
    pub report: &'static str,
    pub verdicts: [&'static str; 4],
    pub headlines: [&'static str; 4],
    pub score: &'static str,
    pub rubric: &'static str,
    pub full: &'static str,
    pub partial: &'static str,
    pub none: &'static str,
    pub pictures: &'static str,
    pub yours: &'static str,
    pub expected: &'static str,
    pub difference: &'static str,
    pub agrees: &'static str,
    pub differs: &'static str,
    pub legend: &'static str,
    pub frame: &'static str,
    pub frames: &'static str,
    pub each_frame: &'static str,
    pub max_difference: &'static str,
    pub mean_difference: &'static str,
    pub mismatched_pixels: &'static str,
    pub coverage_mismatches: &'static str,
    pub unit: &'static str,
    pub play: &'static str,
    pub pause: &'static str,
    pub position: &'static str,
    pub reduced: &'static str,
    pub probes: &'static str,
    pub interpreter: &'static str,
    pub disputed: &'static str,
    pub disputed_means: &'static str,
    pub seed: &'static str,
    pub equation: &'static str,
    pub terms: &'static str,
    pub unknown: &'static str,
    pub source: &'static str,
    pub diagnostics: &'static str,
    pub advice: &'static str,
    /// The same of an answer that is not right.
    pub note: &'static str,
    pub hint: &'static str,
    pub next: &'static str,
    pub environment: &'static str,
    pub elapsed: &'static str,
    pub bytes: &'static str,
    pub see_above: &'static str,
    pub measured: &'static str,
    pub assignment: &'static str,
    pub renderer: &'static str,
    pub driver: &'static str,
    pub file: &'static str,
    pub comment: &'static str,
}

pub(crate) const EN: Labels = Labels {
    tag: "en",
    report: "Grading report",
    verdicts: ["Correct", "Not right yet", "Not accepted", "Stopped"],
    headlines: [
        "Every frame and every probe agrees.",
        "It runs, and something differs from a right answer.",
        "The shader could not be accepted, so nothing was drawn.",
        "The shader ran into a limit and was stopped.",
    ],
    score: "Score",
    rubric: "Points",
    full: "all points",
    partial: "some points",
    none: "no points",
    pictures: "Pictures",
    yours: "Yours",
    expected: "Expected",
    difference: "Difference",
    agrees: "agrees",
    differs: "differs",
    legend: "Largest difference of red, green and blue, in 1/255",
    frame: "Frame",
    frames: "Frames",
    each_frame: "Each frame in numbers",
    max_difference: "Largest difference",
    mean_difference: "Mean difference",
    mismatched_pixels: "Differing pixels",
    coverage_mismatches: "Shape pixels",
    unit: "Differences are in 1/255, over red, green and blue. Shape pixels are covered in one picture only.",
    play: "Play",
    pause: "Pause",
    position: "Position in the animation",
    reduced: "Shown at a reduced resolution.",
    probes: "Probes",
    interpreter: "Interpreter",
    disputed: "Driver and interpreter disagree.",
    disputed_means: "One of the two computes this file wrongly. The driver's values are what was judged; look at the result before you trust it.",
    seed: "seed",
    equation: "Equation",
    terms: "Term by term",
    unknown: "No known mistake explains this term, so it cannot be drawn on its own.",
    source: "Source",
    diagnostics: "Messages",
    advice: "It is right. For your next shader",
    note: "To know",
    hint: "Hint",
    next: "Next",
    environment: "Graded by",
    elapsed: "Time",
    bytes: "bytes",
    see_above: "costs points here; the rubric above says why.",
    measured: "Measurements",
    assignment: "Assignment",
    renderer: "Renderer",
    driver: "Driver",
    file: "File",
    comment: "Comment",
};

pub(crate) const JA: Labels = Labels {
    tag: "ja",
    report: "採点結果",
    verdicts: ["正解", "修正が必要です", "受理できません", "実行を中断しました"],
    headlines: [
        "すべてのフレームとすべての検査点が正解と一致しました。",
        "シェーダは動作しますが、正解と異なるところがあります。",
        "シェーダを受理できなかったため、描画は行っていません。",
        "シェーダが制限に達したため、実行を中断しました。",
    ],
    score: "得点",
    rubric: "採点の内訳",
    full: "満点",
    partial: "部分点",
    none: "得点なし",
    pictures: "画像の比較",
    yours: "提出",
    expected: "正解",
    difference: "差",
    agrees: "一致",
    differs: "相違",
    legend: "RGB の差の最大値（単位 1/255）",
    frame: "フレーム",
    frames: "フレーム",
    each_frame: "フレームごとの数値",
    max_difference: "最大の差",
    mean_difference: "平均の差",
    mismatched_pixels: "異なる画素",
    coverage_mismatches: "形の異なる画素",
    unit: "差は RGB について 1/255 を単位とします。「形の異なる画素」は、一方の画像だけで塗られている画素です。",
    play: "再生",
    pause: "一時停止",
    position: "アニメーションの位置",
    reduced: "解像度を下げて表示しています。",
    probes: "検査点",
    interpreter: "インタープリター",
    disputed: "ドライバーとインタープリターの計算結果が一致しません。",
    disputed_means: "どちらかの計算に誤りがあります。採点にはドライバーの値を使っています。この採点結果は、確認してから使ってください。",
    seed: "シード",
    equation: "式",
    terms: "項ごとの比較",
    unknown: "この項は既知の間違いでは説明できないため、単独では表示できません。",
    source: "ソース",
    diagnostics: "メッセージ",
    advice: "正解です。次のシェーダのために",
    note: "補足",
    hint: "ヒント",
    next: "次の一歩",
    environment: "採点環境",
    elapsed: "所要時間",
    bytes: "バイト",
    see_above: "この行で減点があります。上の採点の内訳をご覧ください。",
    measured: "測定値",
    assignment: "課題",
    renderer: "レンダラー",
    driver: "ドライバ",
    file: "ファイル",
    comment: "コメント",
};

impl Labels {
    /// The words of `language`.
    pub fn of(language: Language) -> &'static Self {
        match language {
            Language::En => &EN,
            Language::Ja => &JA,
        }
    }

    pub fn verdict(&self, verdict: Verdict) -> &'static str {
        self.verdicts[verdict as usize]
    }

    pub fn headline(&self, verdict: Verdict) -> &'static str {
        self.headlines[verdict as usize]
    }

    pub fn japanese(&self) -> bool {
        self.tag == JA.tag
    }
}
