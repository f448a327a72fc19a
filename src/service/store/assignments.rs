//! What a teacher sets for an assignment.

use super::rows::{from_word, word};
use super::{LateRules, LateSpan, Result, Store, on, signed};
use crate::report::Hints;
use crate::service::clock::Millis;
use crate::service::counting::Counting;
use serde::{Deserialize, Serialize};

/// Who may hand in. Where nobody chose it: with a roster whoever gave a number, without one anybody.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Audience {
    /// Anybody.
    Open,
    /// Whoever came by the course link and gave a student number.
    Number,
}

/// The settings of an assignment.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignmentSettings {
    /// Its id.
    pub id: String,
    /// Seed of the fresh probes of every grading: the same for all, so that the same file always gets the same report. It
    /// is drawn at random, and the teacher can draw another.
    pub seed: u64,
    /// The most that messages may help.
    pub hints: Hints,
    /// When handing in begins.
    pub opens_at: Option<Millis>,
    /// When it is due. Handing in ends then, where the rules for late hand-ins do not say more, see [`Self::ends_at`].
    pub closes_at: Option<Millis>,
    /// How often one student may hand in.
    pub attempts: Option<u64>,
    /// Who may hand in.
    pub audience: Audience,
    /// Whether what is typed is still graded after the end.
    pub practice: bool,
    /// Whether the end is one student's own.
    pub has_own_deadline: bool,
    /// What there is after the due date.
    pub late: LateRules,
    /// Which of somebody's hand-ins counts.
    pub counting: Counting,
    /// From when on students see it; none: always.
    pub shown_from: Option<Millis>,
    /// Whether its course is archived: nobody hands in any more.
    pub is_archived: bool,
}

type AssignmentRow = (
    String,
    i64,
    String,
    Option<i64>,
    Option<i64>,
    Option<i64>,
    String,
    i64,
    i64,
    Option<i64>,
    f64,
    i64,
    f64,
    String,
    Option<i64>,
    i64,
);

/// The audience of a homework for which nobody chose one: the tables have an empty word for it, since the roster may come later.
macro_rules! usual_audience {
    () => {
        "(CASE WHEN EXISTS (SELECT 1 FROM students WHERE on_roster = 1) THEN 'number' ELSE 'open' END)"
    };
}

/// The columns of [`AssignmentRow`].
macro_rules! columns {
    () => {
        concat!(
            "id, seed, hints, opens_at, closes_at, attempts, CASE WHEN audience = '' THEN ",
            usual_audience!(),
            " ELSE audience END, practice, grace, late_until, late_percent, late_span, late_floor, counting, \
             CASE WHEN is_hidden = 1 THEN 9223372036854775807 ELSE shown_from END, \
             (SELECT count(*) FROM settings WHERE name = 'archived_at')"
        )
    };
}

impl AssignmentSettings {
    fn of(row: AssignmentRow) -> Result<Self> {
        let (id, seed, hints, opens_at, closes_at, attempts, audience, practice, ..) = row;
        let (.., grace, until, percent, span, floor, counting, shown_from, archived) = row;
        Ok(Self {
            id,
            seed: seed.unsigned_abs(),
            hints: from_word(hints)?,
            opens_at,
            closes_at,
            attempts: attempts.map(i64::unsigned_abs),
            audience: from_word(audience)?,
            practice: practice != 0,
            has_own_deadline: false,
            late: LateRules { grace, until, percent, span: LateSpan::of(span), floor },
            counting: from_word(counting)?,
            shown_from,
            is_archived: archived > 0,
        })
    }

    /// Whether it takes files at `now`.
    pub fn is_open(&self, now: Millis) -> bool {
        self.opens_at.is_none_or(|opens| opens <= now) && !self.is_closed(now)
    }

    /// When a hand-in is late: the due date and the grace after it.
    pub fn late_from(&self) -> Option<Millis> {
        Some(self.closes_at?.saturating_add(self.late.grace))
    }

    /// When handing in ends: with the grace, or with the last late hand-in that is taken. Whoever has a later due date
    /// may hand in until then.
    pub fn ends_at(&self) -> Option<Millis> {
        let in_time = self.late_from()?;
        Some(self.late.until.map_or(in_time, |until| until.max(in_time)))
    }

    /// Whether students see it at `now`.
    pub fn is_shown(&self, now: Millis) -> bool {
        self.shown_from.is_none_or(|from| from <= now)
    }

    /// Whether handing in is over at `now`.
    pub fn is_closed(&self, now: Millis) -> bool {
        self.is_archived || self.ends_at().is_some_and(|ends| ends <= now)
    }

    /// Whether what is typed is graded at `now`: where attempts are counted only after the end, as practice.
    pub fn grades_drafts(&self, now: Millis) -> bool {
        if self.is_archived {
            return false;
        }
        if self.is_closed(now) { self.practice } else { self.is_open(now) && self.attempts.is_none() }
    }
}

impl Store {
    /// The settings of an assignment; the usual ones, with a seed that nobody knows, when it is met first.
    pub async fn assignment(&self, id: &str) -> Result<AssignmentSettings> {
        const SELECT: &str = concat!("SELECT ", columns!(), " FROM assignments WHERE id = $1");
        const INSERT: &str = "INSERT INTO assignments (id, seed, hints, audience) VALUES ($1, $2, $3, '') \
                              ON CONFLICT (id) DO NOTHING";
        let found: Option<AssignmentRow> =
            on!(&self.read, db => sqlx::query_as(SELECT).bind(id).fetch_optional(db).await?);
        if let Some(row) = found {
            return AssignmentSettings::of(row);
        }
        let seed = signed(crate::grade::random_seed());
        let hints = word(&Hints::default());
        on!(&self.write, db => { sqlx::query(INSERT).bind(id).bind(seed).bind(&hints).execute(db).await?; });
        AssignmentSettings::of(on!(&self.write, db => sqlx::query_as(SELECT).bind(id).fetch_one(db).await?))
    }

    /// Sets everything of an assignment. Where nobody chose an audience, the usual one is no choice.
    pub async fn set_assignment(&self, assignment: &AssignmentSettings) -> Result<()> {
        const SQL: &str = concat!(
            "UPDATE assignments SET seed = $2, hints = $3, opens_at = $4, closes_at = $5, attempts = $6, \
             audience = CASE WHEN audience = '' AND $7 = ",
            usual_audience!(),
            " THEN '' ELSE $7 END, practice = $8, grace = $9, late_until = $10, late_percent = $11, late_span = $12, \
             late_floor = $13, counting = $14 WHERE id = $1"
        );
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&assignment.id)
                .bind(signed(assignment.seed))
                .bind(word(&assignment.hints))
                .bind(assignment.opens_at)
                .bind(assignment.closes_at)
                .bind(assignment.attempts.map(signed))
                .bind(word(&assignment.audience))
                .bind(i64::from(assignment.practice))
                .bind(assignment.late.grace)
                .bind(assignment.late.until)
                .bind(assignment.late.percent)
                .bind(assignment.late.span.millis())
                .bind(assignment.late.floor)
                .bind(word(&assignment.counting))
                .execute(db)
                .await?;
        });
        Ok(())
    }
}
