//! Moodle's CodeRunner question type: what the template of a question with a combinator-template grader prints.

use super::untrusted::{html, one_line, rich_html};
use super::wording;
use crate::class::standing::Standing;
use crate::class::{ClassEntry, Outcome};
use crate::language::Language;
use crate::report::RubricLine;
use serde_json::{Value, json};

/// One JSON object, as CodeRunner's documentation describes it.
///
/// After a failure of ours it has no `fraction`. CodeRunner cannot leave an answer unmarked: `deploy/coderunner/template.py`
/// turns that into a 0 that says what it is.
pub fn render(entry: &ClassEntry, language: Language) -> String {
    let mut result = json!({ "prologuehtml": prologue(entry, language) });
    match &entry.outcome {
        Outcome::Graded(report) => {
            result["fraction"] = json!((report.total() / report.max_score).clamp(0.0, 1.0));
            result["testresults"] = table(&report.rubric, language);
            // The columns but for `iscorrect`: text, text, and HTML that is escaped here.
            result["columnformats"] = json!(["%s", "%s", "%h"]);
            result["epiloguehtml"] = json!(epilogue(entry, language));
        }
        Outcome::NotGraded(_) => result["fraction"] = json!(0.0),
        Outcome::Fault(_) => {}
    }
    format!("{result}\n")
}

fn prologue(entry: &ClassEntry, language: Language) -> String {
    let standing = Standing::of(&entry.outcome);
    let mut prologue = format!("<p><strong>{}</strong>", html(standing.word(language)));
    if let Some(report) = entry.report() {
        prologue.push_str(&format!(" {}", html(&wording::result(report))));
    }
    prologue.push_str(&format!("</p><p>{}</p>", rich_html(&wording::explanation(entry, language))));
    if let Some(fault) = wording::fault(entry, language) {
        prologue.push_str(&format!("<p>{}</p>", rich_html(&fault)));
    }
    prologue
}

/// The table of results: a header, then a row a rubric line. `iscorrect` colours a row; a part of 1 is partly right.
fn table(rubric: &[RubricLine], language: Language) -> Value {
    let header = match language {
        Language::En => json!(["iscorrect", "Rubric", "Points", "Feedback"]),
        Language::Ja => json!(["iscorrect", "項目", "得点", "講評"]),
    };
    let row = |line: &RubricLine| {
        json!([
            (line.points / line.max_points).clamp(0.0, 1.0),
            one_line(line.label.get(language)),
            wording::points(line.points, line.max_points),
            rich_html(line.message.get(language)),
        ])
    };
    std::iter::once(header).chain(rubric.iter().map(row)).collect()
}

fn epilogue(entry: &ClassEntry, language: Language) -> String {
    let item = |(report, diagnostic)| {
        let place = html(&wording::place(report, diagnostic, language));
        format!("<li><strong>{place}</strong><br>{}</li>", rich_html(&wording::message(diagnostic, language)))
    };
    let items: String = entry.diagnostics().map(item).collect();
    let list = if items.is_empty() { items } else { format!("<ul>{items}</ul>") };
    let next = wording::next_step(entry, language).map(|next| format!("<p>→ {}</p>", rich_html(&next)));
    format!("{list}{}", next.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::formats::nasty;
    use crate::report::samples;
    use scraper::Html;

    /// The object, held against the rules of CodeRunner's documentation.
    fn result(entry: &ClassEntry) -> Value {
        let text = render(entry, Language::En);
        assert_eq!(text.lines().count(), 1);
        let result: Value = serde_json::from_str(&text).expect("JSON");
        let schema = include_str!("../../../tests/schemas/coderunner-combinator.schema.json");
        let validator = jsonschema::validator_for(&serde_json::from_str(schema).unwrap()).expect("a valid schema");
        let errors: Vec<_> = validator.iter_errors(&result).map(|error| error.to_string()).collect();
        let expected = if matches!(entry.outcome, Outcome::Fault(_)) { 1 } else { 0 };
        assert_eq!(errors.len(), expected, "{errors:?}");
        if let Some(table) = result["testresults"].as_array() {
            let columns = table[0].as_array().unwrap().len();
            assert!(table.iter().all(|row| row.as_array().unwrap().len() == columns));
            let special = table[0].as_array().unwrap().iter().filter(|name| *name == "iscorrect").count();
            assert_eq!(result["columnformats"].as_array().unwrap().len(), columns - special);
        }
        result
    }

    #[test]
    fn the_fraction_is_the_share_of_the_points() {
        let fractions: Vec<_> = nasty::class().entries.iter().map(|entry| result(entry)["fraction"].as_f64()).collect();
        assert_eq!(fractions, [Some(1.0), Some(0.8), Some(0.0), Some(0.0), Some(0.0), None]);
    }

    #[test]
    fn a_row_a_rubric_line_with_partly_right_ones() {
        let result = result(&nasty::class().entries[1]);
        let rows = result["testresults"].as_array().unwrap();
        assert_eq!(rows.len(), 5);
        assert_eq!((&rows[1][0], &rows[4][0]), (&json!(1.0), &json!(0.5)));
        assert_eq!((&rows[4][1], &rows[4][2]), (&json!("Specular"), &json!("20 / 40")));
        assert!(rows[4][3].as_str().unwrap().contains("The half vector <code>h</code> on line 11"));
    }

    #[test]
    fn students_write_no_markup() {
        let mut entries = nasty::class().entries;
        entries.extend(samples::all().map(nasty::attack));
        for entry in &entries {
            let result = result(entry);
            let mut pieces: Vec<_> = ["prologuehtml", "epiloguehtml"].map(|name| &result[name]).to_vec();
            pieces.extend(result["testresults"].as_array().into_iter().flatten().map(|row| &row[3]));
            for html in pieces.into_iter().filter_map(Value::as_str) {
                let page = Html::parse_fragment(html);
                let mut elements = page.root_element().descendent_elements().map(|element| element.value().name());
                let ours = ["html", "p", "strong", "ul", "li", "br", "code"];
                assert!(elements.all(|name| ours.contains(&name)), "{html}");
            }
        }
    }

    #[test]
    fn a_failure_of_ours_says_so_and_proposes_no_mark() {
        let result = result(&nasty::class().entries[5]);
        assert!(result["prologuehtml"].as_str().unwrap().contains("costs no points"));
        assert!(result.get("fraction").is_none());
    }
}
