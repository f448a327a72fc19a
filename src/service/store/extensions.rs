//! Deadlines of single students, and of groups of them.

use super::{AssignmentSettings, Result, Store, on};
use crate::service::clock::Millis;

/// Whose deadline it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Beneficiary {
    /// A student, by their id.
    Student(String),
    /// Everybody in a group of the roster, by its name.
    Group(String),
}

impl Beneficiary {
    fn key(&self) -> &str {
        match self {
            Self::Student(key) | Self::Group(key) => key,
        }
    }
}

/// A deadline in place of that of the homework.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Extension {
    /// When the homework is due for them.
    pub closes_at: Millis,
    /// Why, for those who teach.
    pub reason: String,
}

/// An extension, and whose it is in words.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct NamedExtension {
    /// Student number; none where it is a group's.
    pub number: Option<String>,
    /// Name of the student; empty where it is not known.
    pub name: String,
    /// Id of the student, or name of the group.
    pub key: String,
    /// When the homework is due for them.
    pub closes_at: Millis,
    /// Why, for those who teach.
    pub reason: String,
}

impl NamedExtension {
    /// Whose it is.
    pub fn beneficiary(&self) -> Beneficiary {
        let key = self.key.clone();
        if self.number.is_some() { Beneficiary::Student(key) } else { Beneficiary::Group(key) }
    }
}

impl Store {
    /// The settings of an assignment as they are for somebody: with their own deadline or that of their group, where the
    /// homework has one and theirs is later.
    pub async fn assignment_for(&self, id: &str, student_id: Option<&str>) -> Result<AssignmentSettings> {
        const SQL: &str = "SELECT max(closes_at) FROM (SELECT closes_at FROM extensions \
                           WHERE assignment = $1 AND student_id = $2 UNION ALL SELECT g.closes_at FROM group_extensions g \
                           JOIN students t ON t.group_name = g.group_name WHERE g.assignment = $1 AND t.id = $2) AS own";
        let settings = self.assignment(id).await?;
        let (Some(closes), Some(student_id)) = (settings.closes_at, student_id) else { return Ok(settings) };
        let own: Option<Millis> =
            on!(&self.read, db => sqlx::query_scalar(SQL).bind(id).bind(student_id).fetch_one(db).await?);
        Ok(match own.filter(|own| *own > closes) {
            Some(own) => AssignmentSettings { closes_at: Some(own), has_own_deadline: true, ..settings },
            None => settings,
        })
    }

    /// The deadline that a student or a group has of their own.
    pub async fn extension(&self, assignment: &str, to: &Beneficiary) -> Result<Option<Extension>> {
        const STUDENT: &str = "SELECT closes_at, reason FROM extensions WHERE assignment = $1 AND student_id = $2";
        const GROUP: &str = "SELECT closes_at, reason FROM group_extensions WHERE assignment = $1 AND group_name = $2";
        let sql = if matches!(to, Beneficiary::Student(_)) { STUDENT } else { GROUP };
        Ok(on!(&self.read, db => sqlx::query_as(sql).bind(assignment).bind(to.key()).fetch_optional(db).await?))
    }

    /// Every deadline of an assignment that is not the class's, groups first.
    pub async fn extensions(&self, assignment: &str) -> Result<Vec<NamedExtension>> {
        const SQL: &str = "SELECT NULL AS number, '' AS name, group_name AS key, closes_at, reason FROM group_extensions \
                           WHERE assignment = $1 UNION ALL SELECT t.number, t.name, t.id, e.closes_at, e.reason \
                           FROM extensions e JOIN students t ON t.id = e.student_id WHERE e.assignment = $1 \
                           ORDER BY 1, 3";
        let mut found: Vec<NamedExtension> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).fetch_all(db).await?);
        // The databases do not agree where nothing stands in an order.
        found.sort_by_key(|extension| extension.number.is_some());
        Ok(found)
    }

    /// Gives a student or a group a deadline of their own, or takes it away.
    pub async fn set_extension(&self, assignment: &str, to: &Beneficiary, own: Option<&Extension>) -> Result<()> {
        const STUDENT: [&str; 2] = [
            "DELETE FROM extensions WHERE assignment = $1 AND student_id = $2",
            "INSERT INTO extensions (assignment, student_id, closes_at, reason) VALUES ($1, $2, $3, $4)",
        ];
        const GROUP: [&str; 2] = [
            "DELETE FROM group_extensions WHERE assignment = $1 AND group_name = $2",
            "INSERT INTO group_extensions (assignment, group_name, closes_at, reason) VALUES ($1, $2, $3, $4)",
        ];
        let [clear, set] = if matches!(to, Beneficiary::Student(_)) { STUDENT } else { GROUP };
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(clear).bind(assignment).bind(to.key()).execute(&mut *transaction).await?;
            if let Some(own) = own {
                sqlx::query(set)
                    .bind(assignment)
                    .bind(to.key())
                    .bind(own.closes_at)
                    .bind(&own.reason)
                    .execute(&mut *transaction)
                    .await?;
            }
            transaction.commit().await?;
        });
        Ok(())
    }
}
