//! Which scores learning platforms have, and which ones they have still to get.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// A score that a platform has still to get: the one that counts of a student, where that or the feedback beside it is not what was
/// sent last.
#[derive(Clone, Debug, PartialEq, sqlx::FromRow)]
pub struct DueScore {
    /// Id of the platform.
    pub platform_id: String,
    /// The platform's id of the link.
    pub link_id: String,
    /// The platform's id of the student.
    pub subject: String,
    /// Where it goes.
    pub line_item: String,
    /// The submission.
    pub submission_id: String,
    /// Its points, without what lateness takes off.
    pub score: f64,
    /// What tells its feedback from an earlier one: when it was graded, and how many comments and overrides there are since when.
    pub feedback: String,
    /// When the last one was sent; 0: none was.
    pub sent_at: Millis,
    /// How often sending has failed since.
    pub tries: i64,
}

/// How many scores a platform has still to get after a failure, and what it said last.
pub type Stuck = (String, i64, Option<String>);

/// Whether what is due is not what was tried last. It is unknown while somebody sends it: then it says nothing, which is as good as no.
macro_rules! has_changed {
    ($id:literal, $score:literal, $feedback:literal) => {
        concat!("(tried_id <> ", $id, " OR tried_score <> ", $score, " OR tried_feedback <> ", $feedback, ")")
    };
}

/// The statement that finds what is due: which scores it looks at, when they are tried, and which of those that are due it has. In
/// turn come those of a platform that failed least.
macro_rules! due {
    ($which:literal, $when:expr, $rest:literal) => {
        concat!(
            "SELECT platform_id, link_id, subject, line_item, submission_id, score, feedback, sent_at, tries FROM \
             (SELECT due.*, ROW_NUMBER() OVER (PARTITION BY platform_id ORDER BY tries, link_id, subject) AS turn FROM \
             (SELECT best.*, graded_at || ' ' || \
             (SELECT count(*) || ' ' || coalesce(max(c.at), 0) FROM comments c \
             WHERE c.submission_id = best.submission_id) || ' ' || \
             (SELECT count(*) || ' ' || coalesce(max(o.at), 0) FROM overrides o \
             WHERE o.submission_id = best.submission_id) AS feedback FROM \
             (SELECT k.platform_id, k.link_id, k.subject, l.line_item, s.id AS submission_id, \
             r.score - n.penalty AS score, r.graded_at, \
             k.sent_at, k.tries, k.submission_id AS sent_id, k.score AS sent_score, \
             k.feedback AS sent_feedback, k.next_at, k.tried_id, k.tried_score, k.tried_feedback, \
             ROW_NUMBER() OVER (PARTITION BY k.platform_id, k.link_id, k.subject \
             ORDER BY CASE WHEN a.counting = 'chosen' THEN coalesce(s.chosen_at, 0) ELSE 0 END DESC, \
             CASE WHEN a.counting = 'best' THEN r.score - n.penalty ELSE 0 END DESC, \
             CASE WHEN a.counting = 'best' THEN -s.received_at ELSE s.received_at END DESC, s.id) AS place \
             FROM lti_scores k \
             JOIN lti_links l ON l.platform_id = k.platform_id AND l.link_id = k.link_id \
             JOIN lti_platforms f ON f.id = k.platform_id AND f.is_active = 1 \
             JOIN lti_people p ON p.platform_id = k.platform_id AND p.subject = k.subject \
             JOIN submissions s ON s.student_id = p.student_id AND s.assignment = l.assignment \
             AND s.via <> 'editor' JOIN reports r ON r.submission_id = s.id \
             JOIN assignments a ON a.id = s.assignment \
             JOIN lateness n ON n.submission_id = s.id \
             WHERE ",
            $which,
            " AND l.line_item IS NOT NULL) AS best WHERE place = 1) AS due \
             WHERE (sent_id IS NULL OR sent_id <> submission_id OR sent_score <> score \
             OR sent_feedback <> feedback) AND (sent_id IS NULL OR score >= sent_score \
             OR EXISTS (SELECT 1 FROM submissions g WHERE g.id = sent_id)) AND ",
            $when,
            ") AS turns ",
            $rest
        )
    };
}

impl Store {
    /// Says that a link takes somebody's score.
    pub async fn expect_score(&self, platform_id: &str, link_id: &str, subject: &str) -> Result<()> {
        const SQL: &str = "INSERT INTO lti_scores (platform_id, link_id, subject, sent_at, tries, next_at) \
                           VALUES ($1, $2, $3, 0, 0, 0) ON CONFLICT (platform_id, link_id, subject) DO NOTHING";
        on!(&self.write, db => {
            sqlx::query(SQL).bind(platform_id).bind(link_id).bind(subject).execute(db).await?;
        });
        Ok(())
    }

    /// Keeps that somebody who came in is in the course of a link.
    pub async fn note_member_of_link(&self, platform_id: &str, link_id: &str, subject: &str) -> Result<()> {
        const SQL: &str = "INSERT INTO lti_members (platform_id, context, subject) \
                           SELECT p.platform_id, l.context, p.subject FROM lti_people p \
                           JOIN lti_links l ON l.platform_id = p.platform_id \
                           WHERE p.platform_id = $1 AND l.link_id = $2 AND p.subject = $3 AND l.context <> '' \
                           ON CONFLICT (platform_id, context, subject) DO NOTHING";
        on!(&self.write, db => {
            sqlx::query(SQL).bind(platform_id).bind(link_id).bind(subject).execute(db).await?;
        });
        Ok(())
    }

    /// Expects the scores of homeworks that students of a platform's course handed in without opening the link of theirs. SQLite
    /// looks through the few submissions of each student, and not of each homework, since no index has what is compared.
    pub async fn expect_scores(&self) -> Result<()> {
        const SQL: &str = "SELECT m.platform_id, l.link_id, m.subject FROM lti_members m \
                           JOIN lti_links l ON l.platform_id = m.platform_id AND l.context = m.context \
                           JOIN lti_people p ON p.platform_id = m.platform_id AND p.subject = m.subject \
                           WHERE l.line_item IS NOT NULL AND NOT EXISTS (SELECT 1 FROM lti_scores k \
                           WHERE k.platform_id = m.platform_id AND k.link_id = l.link_id AND k.subject = m.subject) \
                           AND EXISTS (SELECT 1 FROM submissions s WHERE s.student_id = p.student_id \
                           AND s.assignment || '' = l.assignment AND s.via <> 'editor') LIMIT 1000";
        let missing: Vec<(String, String, String)> = on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?);
        for (platform, link, subject) in missing {
            self.expect_score(&platform, &link, &subject).await?;
        }
        Ok(())
    }

    /// Scores that are due at `now`: of each platform as many as are sent in one go. What has changed since it failed does not wait. The attempt counts that
    /// [`counted`](crate::service::counting::counted) names. Where the one that was sent is deleted, no lower one takes its place:
    /// what is too old to be kept costs nobody a point.
    pub async fn due_scores(&self, now: Millis) -> Result<Vec<DueScore>> {
        const SQL: &str = due!(
            "1 = 1",
            concat!("(next_at <= $1 OR ", has_changed!("submission_id", "score", "feedback"), ")"),
            "WHERE turn <= 50 ORDER BY platform_id, turn"
        );
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(now).fetch_all(db).await?))
    }

    /// Claims a score that was due, and keeps it from other processes until `until`. None where another one has it, or has sent it;
    /// else what is due of it now.
    pub async fn claim_score(&self, due: &DueScore, now: Millis, until: Millis) -> Result<Option<DueScore>> {
        const CLAIM: &str = concat!(
            "UPDATE lti_scores SET next_at = $5, tries = CASE WHEN ",
            has_changed!("$6", "$7", "$8"),
            " THEN 0 ELSE tries END, tried_id = NULL, tried_score = NULL, tried_feedback = NULL \
             WHERE platform_id = $1 AND link_id = $2 AND subject = $3 AND (next_at <= $4 OR ",
            has_changed!("$6", "$7", "$8"),
            ")"
        );
        const SQL: &str = due!("k.platform_id = $1 AND k.link_id = $2 AND k.subject = $3", "1 = 1", "");
        const FREE: &str = "UPDATE lti_scores SET next_at = 0 WHERE platform_id = $1 AND link_id = $2 AND subject = $3 AND next_at = $4";
        let (platform, link, subject) = (&due.platform_id, &due.link_id, &due.subject);
        on!(&self.write, db => {
            let claim = sqlx::query(CLAIM).bind(platform).bind(link).bind(subject).bind(now).bind(until);
            let claim = claim.bind(&due.submission_id).bind(due.score).bind(&due.feedback);
            if claim.execute(db).await?.rows_affected() == 0 {
                return Ok(None);
            }
            let now_due = sqlx::query_as(SQL).bind(platform).bind(link).bind(subject).fetch_optional(db).await?;
            if now_due.is_none() {
                sqlx::query(FREE).bind(platform).bind(link).bind(subject).bind(until).execute(db).await?;
            }
            Ok(now_due)
        })
    }

    /// Notes that a score has arrived, with the time that it was given. Those that its platform did not take are tried again.
    pub async fn score_sent(&self, due: &DueScore, at: Millis) -> Result<()> {
        const SQL: &str = "UPDATE lti_scores SET submission_id = $4, score = $5, sent_at = $6, feedback = $7, tries = 0, \
                           next_at = 0, problem = NULL WHERE platform_id = $1 AND link_id = $2 AND subject = $3";
        const OTHERS: &str =
            "UPDATE lti_scores SET tries = 0, next_at = 0 WHERE platform_id = $1 AND tried_id IS NOT NULL";
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&due.platform_id)
                .bind(&due.link_id)
                .bind(&due.subject)
                .bind(&due.submission_id)
                .bind(due.score)
                .bind(at)
                .bind(&due.feedback)
                .execute(db)
                .await?;
            sqlx::query(OTHERS).bind(&due.platform_id).execute(db).await?;
        });
        Ok(())
    }

    /// Notes that a score did not arrive, why, and when it is tried again.
    pub async fn score_failed(&self, due: &DueScore, problem: &str, next_at: Millis) -> Result<()> {
        const SQL: &str = "UPDATE lti_scores SET tries = tries + 1, next_at = $4, problem = $5, tried_id = $6, \
                           tried_score = $7, tried_feedback = $8 \
                           WHERE platform_id = $1 AND link_id = $2 AND subject = $3";
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&due.platform_id)
                .bind(&due.link_id)
                .bind(&due.subject)
                .bind(next_at)
                .bind(problem)
                .bind(&due.submission_id)
                .bind(due.score)
                .bind(&due.feedback)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// Platforms that did not take scores: how many, and one of the problems.
    pub async fn stuck_scores(&self) -> Result<Vec<Stuck>> {
        const SQL: &str = "SELECT platform_id, count(*), max(problem) FROM lti_scores WHERE problem IS NOT NULL \
                           GROUP BY platform_id";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }
}
