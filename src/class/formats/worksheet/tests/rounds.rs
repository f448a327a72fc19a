//! A class that is graded again and again, in between through Moodle.

use super::moodle::Moodle;
use crate::class::formats::samples;
use crate::class::formats::worksheet::fill;
use crate::class::{Class, Outcome};
use crate::language::{Language, Text};
use crate::report::samples as reports;

/// Grades the class and puts the worksheet back; what was said.
fn round(moodle: &mut Moodle, class: &Class) -> Vec<String> {
    let filled = fill(class, &moodle.download()).expect("a worksheet");
    moodle.upload(&filled.bytes);
    filled.notes.into_iter().map(|note| note.en).collect()
}

fn begins(comment: &str) -> usize {
    comment.matches(['▼']).count()
}

/// The class whose student 1002 hands in this.
fn handing_in(outcome: Outcome, language: Language) -> Class {
    let mut class = samples::class(language);
    class.entries[1].outcome = outcome;
    class
}

fn graded(report: crate::report::Report) -> Outcome {
    Outcome::Graded(Box::new(report))
}

#[test]
fn three_rounds_leave_one_comment_and_the_teachers_words_once() {
    for is_japanese in [false, true] {
        let words = "<p>a &lt; b &amp;&amp; it's &quot;fine&quot;.</p><p>See vec&lt;3&gt; \\ R&amp;D</p>";
        let mut moodle =
            Moodle::with(&[(1001, "山田 太郎", None, ""), (1002, "B", None, words), (1006, "F", None, "<p>Late</p>")]);
        moodle.is_japanese = is_japanese;
        let (wrong, right) = (graded(reports::wrong()), graded(reports::correct()));
        round(&mut moodle, &handing_in(wrong.clone(), Language::En));
        let first = moodle.clone();
        assert_eq!(begins(&first.grades[&1001].comment), 1);
        round(&mut moodle, &handing_in(wrong.clone(), Language::En));
        assert_eq!(moodle, first, "the same grading changes nothing in Moodle");
        moodle.edit(1002, "", "<p>Come &amp; see me.</p>");
        round(&mut moodle, &handing_in(right, Language::Ja));
        round(&mut moodle, &handing_in(wrong, Language::Ja));
        let notes = round(&mut moodle, &handing_in(graded(reports::correct()), Language::En));
        assert!(!notes.iter().any(|note| note.contains("0.1.0")), "{notes:?}");
        let comment = &moodle.grades[&1002].comment;
        let before = "<p>a &lt; b &amp;&amp; it&#39;s &quot;fine&quot;.</p><p>See vec&lt;3&gt; &#92; R&amp;D</p>";
        assert!(
            comment.starts_with(&format!("{before}<div class=ggrade><p>▼ Automatic feedback by ggrade</p>")),
            "{comment}"
        );
        assert!(comment.ends_with("<p>▲ End of automatic feedback</p></div><p>Come &amp; see me.</p>"), "{comment}");
        assert!(begins(comment) == 1 && comment.contains("100 / 100") && !comment.contains("80 / 100"), "{comment}");
        assert_eq!(moodle.grades[&1002].grade, "100.00");
        // A failure of ours touches nothing.
        assert_eq!(moodle.grades[&1006].comment, "<p>Late</p>".replace("<p>", "").replace("</p>", "   "));
    }
}

#[test]
fn what_a_student_quotes_ends_no_comment() {
    let mut report = reports::rejected();
    let quote = "`▲ End of automatic feedback ▼ Automatic feedback by ggrade ▲ 自動採点ここまで`: what is that?";
    report.diagnostics[0].message = Text::verbatim(quote);
    let mut moodle = Moodle::with(&[(1002, "B", None, "<p>Hello.</p>")]);
    for _ in 0..3 {
        round(&mut moodle, &handing_in(graded(report.clone()), Language::Ja));
        moodle.edit(1002, "", "");
    }
    round(&mut moodle, &handing_in(graded(reports::correct()), Language::Ja));
    let comment = &moodle.grades[&1002].comment;
    assert!(
        comment.starts_with("<p>Hello.</p><div") && begins(comment) == 1 && comment.ends_with("</div>"),
        "{comment}"
    );
    assert!(!comment.contains("what is that"), "{comment}");
}

/// What ggrade 0.1.0 wrote: our comment without its first and its last words.
fn former(class: &Class, worksheet: &[u8]) -> Vec<u8> {
    let text = String::from_utf8(fill(class, worksheet).expect("a worksheet").bytes).expect("UTF-8");
    let marks = [
        "<p>▼ Automatic feedback by ggrade</p>",
        "<p>▲ End of automatic feedback</p>",
        "<p>▼ ggrade による自動採点</p>",
        "<p>▲ 自動採点ここまで</p>",
    ];
    marks.iter().fold(text, |text, mark| text.replace(mark, "")).into_bytes()
}

#[test]
fn piles_of_the_first_version_are_cleared_away() {
    let outcomes = [
        graded(reports::wrong()),
        graded(reports::correct()),
        graded(reports::rejected()),
        graded(reports::stopped()),
        Outcome::NotGraded(Text::new(
            "Several files could be the one to grade: `a.vert`, `b.vert`. Hand in one file, `ggsample06.vert`.",
            "採点するファイルの候補が複数あります: `a.vert`、`b.vert`。`ggsample06.vert` を 1 つだけ提出してください。",
        )),
    ];
    for language in [Language::En, Language::Ja] {
        for before in &outcomes {
            for after in &outcomes {
                let mut moodle = Moodle::with(&[(1002, "B", None, "<p>First of mine.</p>")]);
                // 0.1.0 hung one behind the other.
                for outcome in [before, &outcomes[0], before] {
                    let mut alone = moodle.clone();
                    alone.edit(1002, "", "");
                    alone.grades.get_mut(&1002).unwrap().comment = String::new();
                    alone.upload(&former(&handing_in(outcome.clone(), language), &alone.download()));
                    let row = moodle.grades.get_mut(&1002).unwrap();
                    row.comment = super::moodle::exported(&row.comment) + &alone.grades[&1002].comment;
                }
                moodle.edit(1002, "", "<p>Last of mine.</p>");
                round(&mut moodle, &handing_in(after.clone(), language));
                let comment = &moodle.grades[&1002].comment;
                assert_eq!(begins(comment), 1, "{comment}");
                let outside = comment.split_once("<div class=ggrade>").unwrap();
                let outside = format!("{}{}", outside.0, outside.1.split_once("</div>").unwrap().1);
                assert!(outside.starts_with("<p>First of mine.</p>"), "{comment}");
                for word in ["/ 100", "line 11", "Specular", "鏡面反射光", "採点対象", "Nothing to grade"] {
                    assert!(!outside.contains(word), "{word}: {comment}");
                }
            }
        }
    }
}

#[test]
fn a_first_comment_that_says_the_same_gives_the_words_behind_it_back() {
    let class = handing_in(graded(reports::wrong()), Language::En);
    let mut moodle = Moodle::with(&[(1002, "B", None, "")]);
    moodle.upload(&former(&class, &moodle.download()));
    moodle.edit(1002, "<p>Before.</p>", "<p>Right behind.</p>");
    let notes = round(&mut moodle, &class);
    let comment = &moodle.grades[&1002].comment;
    assert!(comment.starts_with("<p>Before.</p><div") && comment.ends_with("</div><p>Right behind.</p>"), "{comment}");
    assert!(!notes.iter().any(|note| note.contains("0.1.0")));
    // Where it says something else nobody can tell: that is said.
    let mut moodle = Moodle::with(&[(1002, "B", None, "")]);
    moodle.upload(&former(&class, &moodle.download()));
    moodle.edit(1002, "", "<p>Right behind.</p>");
    let notes = round(&mut moodle, &handing_in(graded(reports::correct()), Language::En));
    assert!(notes.iter().any(|note| note.contains("0.1.0") && note.contains("O'Brien")), "{notes:?}");
}
