//! Points of a line of the rubric that somebody who teaches gave in place of those of the grading.
//!
//! They hold for every report that comes after. Where a new version of the homework changes what a line gives at most, its share
//! of the line stays; where the line is gone, the report says so.

use super::{Result, Store, on};
use crate::language::Text;
use crate::report::text::number;
use crate::report::{Report, RubricLine};
use crate::service::clock::Millis;

/// Points that differ by less are the same: sums of fractions of points are rounded.
const SAME: f64 = 1e-6;

/// Points of a line of the rubric in place of those of the grading.
#[derive(Clone, Debug, PartialEq, sqlx::FromRow)]
pub struct Override {
    /// Id of the submission.
    pub submission_id: String,
    /// Id of the line.
    pub line: String,
    /// The points.
    pub points: f64,
    /// What the grading gave when it was overridden.
    pub graded: f64,
    /// What the line gave at most when it was overridden; none where that was before it was kept.
    pub most: Option<f64>,
    /// Why; the student reads it.
    pub reason: String,
    /// Who did it; none with a secret of the whole service.
    pub author: Option<String>,
    /// When.
    pub at: Millis,
}

/// A submission that a regrading judges anew, and a line of it that somebody overrode.
#[derive(Clone, Debug, PartialEq)]
pub struct OverriddenAgain {
    /// What somebody gave.
    pub overridden: Override,
    /// What the line gets when it is graded again; none where the new report has no such line.
    pub again: Option<LineAgain>,
}

/// What a line gets when it is graded again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineAgain {
    /// What the grading gives.
    pub graded: f64,
    /// What the line gives at most.
    pub most: f64,
}

impl Override {
    /// The points in a line that gives `most` at most: the same share of it.
    pub fn points_of(&self, most: f64) -> f64 {
        let share = self.most.filter(|before| *before > 0.0).map_or(1.0, |before| most / before);
        (self.points * share).min(most)
    }

    /// Whether the points are others in a line that gives `most` at most, or were given of another maximum.
    pub fn is_changed(&self, most: f64) -> bool {
        self.most.map_or(self.points > most + SAME, |before| (before - most).abs() > SAME)
    }

    /// `35 of 40`; only the points where it is not known of how many.
    fn given(&self) -> Text {
        let points = number(self.points);
        match self.most.map(number) {
            Some(most) => Text::new(format!("{points} of {most}"), format!("{most} 点中 {points} 点")),
            None => Text::new(points.clone(), format!("{points} 点")),
        }
    }

    /// What a report says where a line has the points.
    fn said(&self, graded: f64, most: f64) -> Text {
        let (points, graded, given, reason) =
            (number(self.points_of(most)), number(graded), self.given(), &self.reason);
        let (mut en, mut ja) = (String::new(), String::new());
        if self.is_changed(most) {
            en = format!(" ({} before the line's maximum changed)", given.en);
            ja = format!("（配点の変更前は {}）", given.ja);
        }
        Text::new(
            format!("Set to {points} points{en} by the course's staff; the grading gave {graded}. {reason}"),
            format!("担当者が {points} 点に変更しました{ja}（自動採点では {graded} 点）。{reason}"),
        )
    }

    /// The line of a report in whose rubric it is no more. It gives no points and says what was given.
    fn gone(&self) -> RubricLine {
        let (id, given, reason) = (&self.line, self.given(), &self.reason);
        let by = self.author.as_deref();
        let (en, ja) = (by.unwrap_or("the course's staff"), by.unwrap_or("担当者"));
        RubricLine {
            id: id.clone(),
            label: Text::new(id, id),
            points: 0.0,
            max_points: 0.0,
            mistake: None,
            message: Text::new(
                format!(
                    "Set to {} points by {en}. {reason}\nThe rubric has no such line any more: the points do not count.",
                    given.en
                ),
                format!(
                    "{ja} が {}に変更しました。{reason}\nこの項目は採点基準からなくなったため、得点には入りません。",
                    given.ja
                ),
            ),
            file: None,
            line: None,
            graded: Some(0.0),
        }
    }
}

impl OverriddenAgain {
    /// Whether the new grading differs from the one that was overridden, or the line does.
    pub fn is_changed(&self) -> bool {
        self.again.is_none_or(|again| {
            (again.graded - self.overridden.graded).abs() > SAME || self.overridden.is_changed(again.most)
        })
    }

    /// What the line gets with the points that somebody gave; none where the new report has no such line.
    pub fn points(&self) -> Option<f64> {
        self.again.map(|again| self.overridden.points_of(again.most))
    }

    /// How much more that is than the grading gives.
    pub fn gain(&self) -> f64 {
        self.again.map_or(0.0, |again| self.overridden.points_of(again.most) - again.graded)
    }
}

/// The columns of [`Override`].
macro_rules! override_columns {
    () => {
        "o.submission_id, o.line, o.points, o.graded, o.most, o.reason, \
         coalesce(nullif(p.name, ''), p.login) AS author, o.at"
    };
}

pub(super) const OVERRIDES: &str = concat!(
    "SELECT ",
    override_columns!(),
    " FROM overrides o LEFT JOIN staff p ON p.id = o.staff_id WHERE o.submission_id = $1 ORDER BY o.line"
);

pub(super) const REPORT: &str = "SELECT report FROM reports WHERE submission_id = $1";
pub(super) const SCORE: &str = "UPDATE reports SET score = $2 WHERE submission_id = $1";

/// Puts overridden points into a report.
pub(super) fn apply(report: &mut Report, overrides: &[Override]) {
    for given in overrides {
        let Some(line) = report.rubric.iter_mut().find(|line| line.id == given.line) else {
            report.rubric.push(given.gone());
            continue;
        };
        let (points, said) = (given.points_of(line.max_points), given.said(line.points, line.max_points));
        line.message =
            Text::new(format!("{}\n{}", said.en, line.message.en), format!("{}\n{}", said.ja, line.message.ja));
        report.score += points - line.points;
        line.graded = Some(line.points);
        line.points = points;
    }
}

/// Brings the score of a submission up to date, after its report or what is overridden has changed.
macro_rules! rescore {
    ($transaction:expr, $id:expr) => {{
        use $crate::service::store::overrides::{OVERRIDES, Override, REPORT, SCORE, apply};
        let json: Option<String> = sqlx::query_scalar(REPORT).bind($id).fetch_optional(&mut *$transaction).await?;
        if let Some(json) = json {
            let mut report: $crate::report::Report = serde_json::from_str(&json)?;
            let overrides: Vec<Override> = sqlx::query_as(OVERRIDES).bind($id).fetch_all(&mut *$transaction).await?;
            apply(&mut report, &overrides);
            sqlx::query(SCORE).bind($id).bind(report.score).execute(&mut *$transaction).await?;
        }
    }};
}
pub(super) use rescore;

impl Store {
    /// What is overridden of a submission.
    pub async fn overrides(&self, submission_id: &str) -> Result<Vec<Override>> {
        Ok(on!(&self.read, db => sqlx::query_as(OVERRIDES).bind(submission_id).fetch_all(db).await?))
    }

    /// Overrides a line of a submission's report, or takes that back; false where there is nothing to be taken back. The line gets
    /// the points, for a reason that its student reads.
    pub async fn set_override(
        &self,
        submission_id: &str,
        line: &str,
        given: Option<(f64, &str)>,
        staff_id: Option<&str>,
        now: Millis,
    ) -> Result<bool> {
        const CLEAR: &str = "DELETE FROM overrides WHERE submission_id = $1 AND line = $2";
        const SET: &str = "INSERT INTO overrides (submission_id, line, points, graded, most, reason, staff_id, at) \
                           VALUES ($1, $2, $3, $4, $5, $6, $7, $8)";
        let changes = on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            let json: Option<String> =
                sqlx::query_scalar(REPORT).bind(submission_id).fetch_optional(&mut *transaction).await?;
            let report: Option<Report> = json.map(|json| serde_json::from_str(&json)).transpose()?;
            let graded = report.and_then(|report| report.rubric.into_iter().find(|it| it.id == line));
            let cleared = sqlx::query(CLEAR).bind(submission_id).bind(line).execute(&mut *transaction).await?;
            if let (Some((points, reason)), Some(graded)) = (given, graded) {
                sqlx::query(SET)
                    .bind(submission_id)
                    .bind(line)
                    .bind(points)
                    .bind(graded.points)
                    .bind(graded.max_points)
                    .bind(reason)
                    .bind(staff_id)
                    .bind(now)
                    .execute(&mut *transaction)
                    .await?;
            }
            rescore!(transaction, submission_id);
            transaction.commit().await?;
            given.is_some() || cleared.rows_affected() > 0
        });
        Ok(changes)
    }

    /// What is overridden of everything that a regrading judges anew, with what it gives.
    pub async fn overridden_again(&self, regrading_id: &str) -> Result<Vec<OverriddenAgain>> {
        const SQL: &str = concat!(
            "SELECT ",
            override_columns!(),
            " FROM overrides o JOIN regraded g ON g.submission_id = o.submission_id \
             LEFT JOIN staff p ON p.id = o.staff_id WHERE g.regrading_id = $1 AND g.state = 'graded' \
             ORDER BY o.submission_id, o.line"
        );
        const AGAIN: &str = "SELECT report FROM regraded WHERE regrading_id = $1 AND submission_id = $2";
        let found: Vec<Override> = on!(&self.read, db => sqlx::query_as(SQL).bind(regrading_id).fetch_all(db).await?);
        let mut all = Vec::new();
        for overridden in found {
            let json: Option<String> = on!(&self.read, db => {
                sqlx::query_scalar(AGAIN).bind(regrading_id).bind(&overridden.submission_id).fetch_one(db).await?
            });
            let report: Option<Report> = json.map(|json| serde_json::from_str(&json)).transpose()?;
            let line = report.and_then(|report| report.rubric.into_iter().find(|it| it.id == overridden.line));
            let again = line.map(|line| LineAgain { graded: line.points, most: line.max_points });
            all.push(OverriddenAgain { overridden, again });
        }
        Ok(all)
    }
}
