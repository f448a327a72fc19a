//! Learning platforms: where they are, who launches from them, and the keys with which the service signs.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// A learning platform.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Platform {
    /// Id.
    pub id: String,
    /// Its name for itself.
    pub issuer: String,
    /// Its name for this service.
    pub client_id: String,
    /// What people call it.
    pub name: String,
    /// Where a launch goes to be vouched for.
    pub auth_url: String,
    /// Where tokens for its services are.
    pub token_url: String,
    /// Where its public keys are.
    pub keys_url: String,
    /// Who a request for a token is addressed to, where that is not the address itself.
    pub token_audience: Option<String>,
    /// 1 where launches are taken.
    pub is_active: i64,
}

/// A launch that was begun.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Launch {
    /// Id of the platform.
    pub platform_id: String,
    /// What the platform has to repeat.
    pub nonce: String,
    /// What the platform began it with, as a query.
    pub begun_by: String,
}

/// A link of a platform's course to a homework.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct HomeworkLink {
    /// Id of the platform.
    pub platform_id: String,
    /// The platform's id of the link.
    pub link_id: String,
    /// The homework.
    pub assignment: String,
    /// The platform's id of the course.
    pub context: String,
    /// Where scores go.
    pub line_item: Option<String>,
    /// Where the list of the course's people is.
    pub memberships: Option<String>,
}

/// Somebody of a platform.
#[derive(Clone, Debug, Default, PartialEq, Eq, sqlx::FromRow)]
pub struct PlatformPerson {
    /// Id of the student that they are.
    pub student_id: Option<String>,
    /// Id of the account that they have.
    pub staff_id: Option<String>,
}

/// A deployment of the tool in a platform.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Deployment {
    /// Id of the platform.
    pub platform_id: String,
    /// The platform's id of it.
    pub deployment_id: String,
    /// 1 where launches from it are taken.
    pub is_approved: i64,
}

const PLATFORM: &str = "SELECT id, issuer, client_id, name, auth_url, token_url, keys_url, token_audience, is_active \
                        FROM lti_platforms";

impl Store {
    /// Every platform, the oldest first.
    pub async fn platforms(&self) -> Result<Vec<Platform>> {
        let sql = sqlx::AssertSqlSafe(format!("{PLATFORM} ORDER BY created_at, id"));
        Ok(on!(&self.read, db => sqlx::query_as(sql).fetch_all(db).await?))
    }

    /// The platform with this id.
    pub async fn platform(&self, id: &str) -> Result<Option<Platform>> {
        Ok(self.platforms().await?.into_iter().find(|platform| platform.id == id))
    }

    /// Adds a platform; one with the same issuer and client is replaced, and keeps its id.
    pub async fn add_platform(&self, platform: &Platform, now: Millis) -> Result<()> {
        const SQL: &str = "INSERT INTO lti_platforms (id, issuer, client_id, name, auth_url, token_url, keys_url, \
                           token_audience, is_active, created_at) VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10) \
                           ON CONFLICT (issuer, client_id) DO UPDATE SET name = excluded.name, \
                           auth_url = excluded.auth_url, token_url = excluded.token_url, keys_url = excluded.keys_url, \
                           token_audience = excluded.token_audience, is_active = excluded.is_active";
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&platform.id)
                .bind(&platform.issuer)
                .bind(&platform.client_id)
                .bind(&platform.name)
                .bind(&platform.auth_url)
                .bind(&platform.token_url)
                .bind(&platform.keys_url)
                .bind(&platform.token_audience)
                .bind(platform.is_active)
                .bind(now)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// Says whether launches of a platform are taken.
    pub async fn set_platform_active(&self, id: &str, is_active: bool) -> Result<()> {
        const SQL: &str = "UPDATE lti_platforms SET is_active = $2 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).bind(i64::from(is_active)).execute(db).await?; });
        Ok(())
    }

    /// The deployments of all platforms.
    pub async fn deployments(&self) -> Result<Vec<Deployment>> {
        const SQL: &str = "SELECT platform_id, deployment_id, is_approved FROM lti_deployments \
                           ORDER BY platform_id, deployment_id";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// Notes a deployment; one that is known keeps what was said of it, unless it is approved now.
    pub async fn note_deployment(&self, platform_id: &str, deployment_id: &str, is_approved: bool) -> Result<()> {
        const NOTE: &str = "INSERT INTO lti_deployments (platform_id, deployment_id, is_approved) VALUES ($1, $2, $3) \
                            ON CONFLICT (platform_id, deployment_id) DO UPDATE SET is_approved = \
                            CASE WHEN excluded.is_approved = 1 THEN 1 ELSE lti_deployments.is_approved END";
        on!(&self.write, db => {
            sqlx::query(NOTE)
                .bind(platform_id)
                .bind(deployment_id)
                .bind(i64::from(is_approved))
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// Begins a launch, and forgets those that were never finished.
    pub async fn begin_launch(&self, state_hash: &str, launch: &Launch, now: Millis, until: Millis) -> Result<()> {
        const CLEAR: &str = "DELETE FROM lti_launches WHERE expires_at <= $1";
        const SQL: &str = "INSERT INTO lti_launches (state_hash, platform_id, nonce, begun_by, expires_at) \
                           VALUES ($1, $2, $3, $4, $5)";
        on!(&self.write, db => {
            sqlx::query(CLEAR).bind(now).execute(db).await?;
            sqlx::query(SQL)
                .bind(state_hash)
                .bind(&launch.platform_id)
                .bind(&launch.nonce)
                .bind(&launch.begun_by)
                .bind(until)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// The launch of a state, which is used up by that: whoever comes second gets nothing.
    pub async fn take_launch(&self, state_hash: &str, now: Millis) -> Result<Option<Launch>> {
        const SQL: &str = "DELETE FROM lti_launches WHERE state_hash = $1 AND expires_at > $2 \
                           RETURNING platform_id, nonce, begun_by";
        let row: Option<(String, String, String)> =
            on!(&self.write, db => sqlx::query_as(SQL).bind(state_hash).bind(now).fetch_optional(db).await?);
        Ok(row.map(|(platform_id, nonce, begun_by)| Launch { platform_id, nonce, begun_by }))
    }

    /// Notes a link; what the platform does not say any more stays known.
    pub async fn note_link(&self, link: &HomeworkLink) -> Result<()> {
        const SQL: &str = "INSERT INTO lti_links (platform_id, link_id, assignment, context, line_item, memberships) \
                           VALUES ($1, $2, $3, $4, $5, $6) ON CONFLICT (platform_id, link_id) DO UPDATE SET \
                           assignment = excluded.assignment, context = excluded.context, \
                           line_item = COALESCE(excluded.line_item, lti_links.line_item), \
                           memberships = COALESCE(excluded.memberships, lti_links.memberships)";
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&link.platform_id)
                .bind(&link.link_id)
                .bind(&link.assignment)
                .bind(&link.context)
                .bind(&link.line_item)
                .bind(&link.memberships)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// Every link.
    pub async fn links(&self) -> Result<Vec<HomeworkLink>> {
        const SQL: &str = "SELECT platform_id, link_id, assignment, context, line_item, memberships FROM lti_links \
                           ORDER BY platform_id, link_id";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// Who somebody of a platform is.
    pub async fn platform_person(&self, platform_id: &str, subject: &str) -> Result<Option<PlatformPerson>> {
        const SQL: &str = "SELECT student_id, staff_id FROM lti_people WHERE platform_id = $1 AND subject = $2";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(platform_id).bind(subject).fetch_optional(db).await?))
    }

    /// Whether a student is somebody else of the platform already.
    pub async fn is_taken(&self, platform_id: &str, subject: &str, student_id: &str) -> Result<bool> {
        const SQL: &str =
            "SELECT count(*) FROM lti_people WHERE platform_id = $1 AND subject <> $2 AND student_id = $3";
        let count: i64 = on!(&self.read, db => {
            sqlx::query_scalar(SQL).bind(platform_id).bind(subject).bind(student_id).fetch_one(db).await?
        });
        Ok(count > 0)
    }

    /// Whether somebody has proved to be a student, or handed in as them: a browser by a personal code or by the word of others, or a
    /// file that came in no archive of a teacher's.
    pub async fn is_held(&self, student_id: &str) -> Result<bool> {
        const SQL: &str = "SELECT (SELECT count(*) FROM owners o JOIN students s ON s.id = o.student_id \
                           WHERE s.id = $1 AND o.code_generation = s.code_generation AND o.proof <> 'first') \
                           + (SELECT count(*) FROM submissions WHERE student_id = $1 AND batch_id IS NULL)";
        let count: i64 = on!(&self.write, db => sqlx::query_scalar(SQL).bind(student_id).fetch_one(db).await?);
        Ok(count > 0)
    }

    /// Says who somebody of a platform is; what is none stays as it was.
    pub async fn note_person(&self, platform_id: &str, subject: &str, person: &PlatformPerson) -> Result<()> {
        const SQL: &str = "INSERT INTO lti_people (platform_id, subject, student_id, staff_id) VALUES ($1, $2, $3, $4) \
                           ON CONFLICT (platform_id, subject) DO UPDATE SET \
                           student_id = COALESCE(excluded.student_id, lti_people.student_id), \
                           staff_id = COALESCE(excluded.staff_id, lti_people.staff_id)";
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(platform_id)
                .bind(subject)
                .bind(&person.student_id)
                .bind(&person.staff_id)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// The keys with which the service signs, the oldest first: id, PEM, and since when.
    pub async fn signing_keys(&self) -> Result<Vec<(String, String, Millis)>> {
        const SQL: &str = "SELECT id, pem, created_at FROM lti_keys ORDER BY created_at, id";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// Keeps a new key, and forgets those from before.
    pub async fn add_signing_key(&self, id: &str, pem: &str, now: Millis, forget_before: Millis) -> Result<()> {
        const CLEAR: &str = "DELETE FROM lti_keys WHERE created_at < $1";
        const SQL: &str = "INSERT INTO lti_keys (id, pem, created_at) VALUES ($1, $2, $3)";
        on!(&self.write, db => {
            sqlx::query(SQL).bind(id).bind(pem).bind(now).execute(db).await?;
            sqlx::query(CLEAR).bind(forget_before).execute(db).await?;
        });
        Ok(())
    }
}
