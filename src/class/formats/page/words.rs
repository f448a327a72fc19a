//! Every word of the class page, in one table.

use crate::language::Language;

/// The words of one language.
#[derive(Debug)]
pub(super) struct PageWords {
    pub report: &'static str,
    pub verdicts: &'static str,
    pub verdict: &'static str,
    pub yours: &'static str,
    pub expected: &'static str,
    pub pair: &'static str,
    pub mean: &'static str,
    pub scores: &'static str,
    pub mistakes: &'static str,
    pub mistakes_unit: &'static str,
    pub no_mistakes: &'static str,
    pub all_mistakes: &'static str,
    pub everyone: &'static str,
    pub search: &'static str,
    pub sort: &'static str,
    pub in_order: &'static str,
    pub by_name: &'static str,
    pub by_score_down: &'static str,
    pub by_score_up: &'static str,
    pub by_verdict: &'static str,
    pub by_mistake: &'static str,
    pub view: &'static str,
    pub pictures: &'static str,
    pub table: &'static str,
    pub shown: &'static str,
    pub filters: &'static str,
    pub clear: &'static str,
    pub remove: &'static str,
    pub nothing_found: &'static str,
    pub student: &'static str,
    pub score: &'static str,
    pub found: &'static str,
    pub shares: &'static str,
    pub shared: &'static str,
    pub shared_note: &'static str,
    pub show: &'static str,
    pub faults: &'static str,
    pub faults_note: &'static str,
    pub refused: &'static str,
    pub refused_note: &'static str,
    pub assignment: &'static str,
    pub renderer: &'static str,
    pub driver: &'static str,
    is_japanese: bool,
}

const EN: PageWords = PageWords {
    report: "Class report",
    verdicts: "Verdicts",
    verdict: "Verdict",
    yours: "Handed in",
    expected: "Expected",
    pair: "Left: handed in. Right: expected.",
    mean: "Mean",
    scores: "Scores",
    mistakes: "Mistakes",
    mistakes_unit: "students",
    no_mistakes: "No known mistake was found.",
    all_mistakes: "Show all",
    everyone: "Everyone",
    search: "Search name, file, mistake",
    sort: "Sort by",
    in_order: "not graded first",
    by_name: "name",
    by_score_down: "score, highest first",
    by_score_up: "score, lowest first",
    by_verdict: "verdict",
    by_mistake: "mistake",
    view: "View",
    pictures: "Pictures",
    table: "Table",
    shown: "{shown} of {total} shown",
    filters: "Filters",
    clear: "Clear all filters",
    remove: "Remove filter",
    nothing_found: "Nobody matches these filters.",
    student: "Student",
    score: "Score",
    found: "Found",
    shares: "Same answer",
    shared: "Who shares an answer",
    shared_note: "These files are the same when comments, spacing and the hand-out's own text are left aside. That is all this \
                  list says: a short answer can be the same by chance.",
    show: "Show",
    faults: "Grading failed",
    faults_note: "This is no verdict on the student: something on our side failed. Grade again when it is mended.",
    refused: "Left out of the input",
    refused_note: "These members were not read; everything else was graded.",
    assignment: "Assignment",
    renderer: "Renderer",
    driver: "Driver",
    is_japanese: false,
};

const JA: PageWords = PageWords {
    report: "クラスの採点結果",
    verdicts: "判定",
    verdict: "判定",
    yours: "提出",
    expected: "正解",
    pair: "左：提出　右：正解",
    mean: "平均点",
    scores: "得点の分布",
    mistakes: "間違いの種類",
    mistakes_unit: "人数",
    no_mistakes: "既知の間違いは見つかりませんでした。",
    all_mistakes: "すべて表示",
    everyone: "全員の結果",
    search: "名前・ファイル・間違いで検索",
    sort: "並べ替え",
    in_order: "採点できなかったものから",
    by_name: "名前",
    by_score_down: "得点の高い順",
    by_score_up: "得点の低い順",
    by_verdict: "判定",
    by_mistake: "間違い",
    view: "表示",
    pictures: "画像",
    table: "表",
    shown: "{total} 人中 {shown} 人を表示",
    filters: "絞り込み",
    clear: "絞り込みをすべて解除",
    remove: "絞り込みを解除",
    nothing_found: "条件に合う学生はいません。",
    student: "学生",
    score: "得点",
    found: "見つかったこと",
    shares: "同じ答案",
    shared: "同じ答案の学生",
    shared_note: "コメントと空白、配布ファイルにもとからある部分を除くと同じ内容になる提出です。この一覧が示すのはそれだけです。\
                  短い答案は偶然一致することもあります。",
    show: "表示",
    faults: "採点エラー",
    faults_note: "学生の答案についての判定ではなく、採点側の問題です。解決してからもう一度採点してください。",
    refused: "読み込まなかったもの",
    refused_note: "次のものは読み込んでいません。それ以外はすべて採点しました。",
    assignment: "課題",
    renderer: "レンダラー",
    driver: "ドライバ",
    is_japanese: true,
};

impl PageWords {
    pub fn of(language: Language) -> &'static Self {
        match language {
            Language::En => &EN,
            Language::Ja => &JA,
        }
    }

    pub fn overview(&self, students: usize, graded: usize) -> String {
        match (self.is_japanese, students) {
            (true, _) => format!("{students} 人中 {graded} 人を採点しました。"),
            (false, 1) => format!("1 student, {graded} graded."),
            (false, _) => format!("{students} students, {graded} graded."),
        }
    }

    pub fn spread(&self, median: &str, full: usize) -> String {
        if self.is_japanese {
            format!("中央値 {median} 点・満点 {full} 人")
        } else {
            format!("median {median}, full marks {full}")
        }
    }

    /// Scores from `from` up to below `to`; the last bin is `from` alone.
    pub fn range(&self, from: &str, to: Option<&str>) -> String {
        match (self.is_japanese, to) {
            (true, Some(to)) => format!("{from} 点以上 {to} 点未満"),
            (true, None) => format!("{from} 点"),
            (false, Some(to)) => format!("{from} to below {to}"),
            (false, None) => format!("{from} points"),
        }
    }

    pub fn students(&self, count: usize) -> String {
        match (self.is_japanese, count) {
            (true, _) => format!("{count} 人"),
            (false, 1) => "1 student".into(),
            (false, _) => format!("{count} students"),
        }
    }

    pub fn shared_with(&self, others: usize) -> String {
        match (self.is_japanese, others) {
            (true, _) => format!("同じ答案がほかに {others} 人"),
            (false, 1) => "same answer as 1 other".into(),
            (false, _) => format!("same answer as {others} others"),
        }
    }
}
