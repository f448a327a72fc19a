//! Moodle's own side of the worksheet, after `gradingtable.php`, `base_export_format` and `importgradeslib.php` of 5.1.

use std::collections::BTreeMap;

/// One row of an assignment's grading table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct MoodleGrade {
    pub name: String,
    pub group: Option<String>,
    pub grade: String,
    /// The feedback comment as it is in the database.
    pub comment: String,
}

/// An assignment's grades, by the participants' numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Moodle {
    pub grades: BTreeMap<u64, MoodleGrade>,
    pub is_japanese: bool,
}

impl Moodle {
    pub fn with(grades: &[(u64, &str, Option<&str>, &str)]) -> Self {
        let grade = |(number, name, group, comment): &(u64, &str, Option<&str>, &str)| {
            let group = group.map(str::to_owned);
            (*number, MoodleGrade { name: (*name).into(), group, comment: (*comment).into(), ..MoodleGrade::default() })
        };
        Self { grades: grades.iter().map(grade).collect(), is_japanese: false }
    }

    /// "Download grading worksheet".
    pub fn download(&self) -> Vec<u8> {
        let has_groups = self.grades.values().any(|grade| grade.group.is_some());
        let header = match self.is_japanese {
            false => ["Identifier", "Full name", "Status", "Group", "Grade", "Maximum grade", "Feedback comments"],
            true => ["ID", "フルネーム", "ステータス", "グループ", "評点", "最大評点", "フィードバックコメント"],
        };
        let (word, status) = if self.is_japanese {
            ("参加者", "評定のために提出済み")
        } else {
            ("Participant ", "Submitted for grading")
        };
        let mut writer = csv::WriterBuilder::new().from_writer(Vec::new());
        let mut write = |row: Vec<String>| {
            let cells = row.iter().enumerate().filter(|(at, _)| has_groups || *at != 3).map(|(_, cell)| exported(cell));
            writer.write_record(cells.collect::<Vec<_>>()).expect("a row");
        };
        write(header.map(str::to_owned).to_vec());
        for (number, row) in &self.grades {
            let group = row.group.clone().unwrap_or_default();
            write(vec![
                format!("{word}{number}"),
                row.name.clone(),
                status.into(),
                group,
                row.grade.clone(),
                "100.00".into(),
                row.comment.clone(),
            ]);
        }
        writer.into_inner().expect("a file")
    }

    /// "Upload grading worksheet": what a cell says becomes what is in the database.
    pub fn upload(&mut self, worksheet: &[u8]) {
        let mut reader = csv::Reader::from_reader(worksheet);
        let columns = reader.headers().expect("a header").clone();
        let column = |names: [&str; 2]| columns.iter().position(|name| names.contains(&name)).expect("a column");
        let (id, grade, comment) = (
            column(["Identifier", "ID"]),
            column(["Grade", "評点"]),
            column(["Feedback comments", "フィードバックコメント"]),
        );
        for record in reader.records() {
            let record = record.expect("a row");
            let number = record[id].trim_start_matches(|c: char| !c.is_ascii_digit()).parse().expect("a number");
            let row: &mut MoodleGrade = self.grades.get_mut(&number).expect("a participant");
            (row.grade, row.comment) = (record[grade].into(), record[comment].into());
        }
    }

    /// A teacher writes a paragraph in the editor, before what is there or behind it.
    pub fn edit(&mut self, number: u64, before: &str, behind: &str) {
        let row = self.grades.get_mut(&number).expect("a participant");
        // The editor quotes attributes.
        row.comment = format!("{before}{}{behind}", row.comment.replace("class=ggrade", "class=\"ggrade\""));
    }
}

/// `html_entity_decode(strip_tags(str_replace(['</p>', "\n", "\r"], '   ', $text)), ENT_COMPAT)`, for what is escaped.
pub(super) fn exported(html: &str) -> String {
    let spaced = html.replace("</p>", "   ").replace(['\n', '\r'], "   ");
    let mut is_tag = false;
    let text: String = spaced
        .chars()
        .filter(|c| {
            is_tag |= *c == '<';
            let shown = !is_tag;
            is_tag &= *c != '>';
            shown
        })
        .collect();
    // ENT_COMPAT leaves those of the single quote.
    let decoded = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&nbsp;", "\u{a0}");
    decoded.replace("&#92;", "\\").replace("&amp;", "&")
}
