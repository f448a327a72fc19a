//! Homeworks that come by the browser: a folder is uploaded, checked, looked at and published.
//!
//! The archive is a stranger's. A worker of its own unpacks it, reads its TOML, meshes and pictures and grades its own files; a
//! second one, which runs nothing of theirs, reads the files again within narrower limits ([`crate::sandbox`]). This process reads
//! what the second one has read, and nothing else. The folders are in the database: of each homework the one that was published
//! last is served, in the place of what the command line names.

use super::blocking::aside;
use super::errors::Problem;
use super::grading;
use super::identity::{Teacher, new_id};
use super::pages;
use super::regrade;
use super::store::{Regrading, Result as StoreResult, StaffRole, Store, UploadedFolder};
use super::{Service, State};
use crate::language::{Language, Text};
use crate::report::labels::Labels;
use crate::report::{Report, Verdict};
use crate::sandbox::{CheckedFolder, MOST_ASSIGNMENTS};
use axum::http::StatusCode;
use moka::future::Cache;
use reference::{Assignment, Folder};
use std::path::Path;
use std::sync::Arc;

/// How many folders are kept in memory that are looked at, or by which is graded again.
const KEPT: u64 = 8;

/// Folders that were read, by their ids.
#[derive(Debug)]
pub(super) struct FolderCache(Cache<String, Arc<Assignment>>);

impl Default for FolderCache {
    fn default() -> Self {
        Self(Cache::new(KEPT))
    }
}

/// What became of a folder that was to be published.
#[derive(Clone, Debug)]
pub enum Publication {
    /// It is served.
    Served,
    /// What was handed in is graded by it beside the reports that stand; adopting the results publishes it.
    Regrading(Regrading),
}

/// Draws the right pictures of a homework, so that nobody's page waits for them.
pub(super) async fn drawn(assignment: &Arc<Assignment>) -> Result<(), Problem> {
    let assignment = Arc::clone(assignment);
    aside(move || pages::warm(&assignment)).await
}

/// Reads a folder that was checked. What it says of a broken one is the folder's file, and what is wrong in it.
async fn loaded(folder: Folder) -> Result<Arc<Assignment>, Text> {
    let read = tokio::task::spawn_blocking(move || Assignment::load(folder)).await;
    match read {
        Ok(Ok(assignment)) => Ok(Arc::new(assignment)),
        Ok(Err(error)) => Err(error.text().into()),
        Err(panic) => Err(Text::verbatim(panic.to_string())),
    }
}

/// The homeworks that are served: those that are named, each by its published folder where it has one, and then the others that
/// were published. One whose folder this version of ggrade does not read any more is left out.
pub async fn served(store: &Store, named: &[Arc<Assignment>]) -> StoreResult<Vec<Arc<Assignment>>> {
    let mut served = named.to_vec();
    for (id, folder) in store.published().await? {
        let place = served.iter().position(|known| known.id == id);
        match (loaded(store.folder_files(&folder).await?).await, place) {
            (Ok(assignment), Some(place)) => served[place] = assignment,
            (Ok(assignment), None) => served.push(assignment),
            (Err(why), place) => {
                tracing::error!(homework = id, why = why.en, "a published folder cannot be read: it is not served");
                place.map(|place| served.remove(place));
            }
        }
    }
    Ok(served)
}

/// Serves what another process on the same database has published, and no more what it took out of service.
pub(super) async fn follow(service: &Service) -> StoreResult<()> {
    let now = served(&service.store, &service.named_ones()).await?;
    for id in service.ids().iter().filter(|id| now.iter().all(|assignment| assignment.id != **id)) {
        service.withdraw(id);
    }
    for assignment in now {
        let is_served = |state: State| state.assignment.digest == assignment.digest;
        if !service.homework(&assignment.id).is_some_and(is_served) {
            // A page that cannot be drawn says so itself.
            let _ = drawn(&assignment).await;
            service.serve(assignment);
        }
    }
    Ok(())
}

/// The homework in an uploaded folder.
pub async fn read(service: &Service, id: &str) -> Result<Arc<Assignment>, Problem> {
    let FolderCache(cache) = &service.folders;
    if let Some(known) = cache.get(id).await {
        return Ok(known);
    }
    let files = service.store.folder_files(id).await?;
    let assignment = loaded(files).await.map_err(|why| refused(&why))?;
    cache.insert(id.to_owned(), Arc::clone(&assignment)).await;
    Ok(assignment)
}

/// The folder with this id, for a lecturer of its homework.
pub async fn found(service: &Service, teacher: &Teacher, id: &str) -> Result<UploadedFolder, Problem> {
    teacher.check_role(StaffRole::Lecturer)?;
    let folder = stored(service, id).await?;
    teacher.check(&folder.assignment)?;
    Ok(folder)
}

/// The uploaded folders of the homeworks that a lecturer teaches, the newest first.
pub async fn all(service: &Service, teacher: &Teacher) -> Result<Vec<UploadedFolder>, Problem> {
    teacher.check_role(StaffRole::Lecturer)?;
    let mut folders = service.store.folders().await?;
    folders.retain(|folder| teacher.may_see(&folder.assignment));
    Ok(folders)
}

async fn stored(service: &Service, id: &str) -> Result<UploadedFolder, Problem> {
    service.store.folder(id).await?.ok_or_else(Problem::not_found)
}

/// The homework in an uploaded folder as its page will be: whoever looks at it sees it at an address of its own.
pub async fn previewed(service: &Service, folder: &UploadedFolder) -> Result<State, Problem> {
    let assignment = read(service, &folder.id).await?;
    drawn(&assignment).await?;
    Ok(service.unserved(assignment, &folder.id))
}

/// Whether a folder is the one that is served.
pub fn is_served(service: &Service, folder: &UploadedFolder) -> bool {
    service.homework(&folder.assignment).is_some_and(|state| state.assignment.digest == folder.digest)
}

/// Checks an archive and keeps the folder in it, where it is one of a homework that its uploader teaches; nothing is served
/// otherwise for it.
pub async fn upload(service: &Service, archive: &Path, teacher: &Teacher) -> Result<UploadedFolder, Problem> {
    let bytes = tokio::fs::read(archive).await.map_err(|error| Problem::internal(&error))?;
    let turn = service.check_turn.acquire().await;
    let pool = Arc::clone(&service.pool);
    let checked = tokio::task::spawn_blocking(move || pool.check(&bytes)).await;
    drop(turn);
    let checked = checked.map_err(|panic| Problem::internal(&panic))?.map_err(|fault| Problem::of_fault(&fault))?;
    let CheckedFolder { folder, solution, handed_out } = checked.map_err(|why| refused(&why))?;
    let assignment = loaded(folder).await.map_err(|why| refused(&why))?;
    if let Some(why) = flaw(service.config.deadline * f64::from(assignment.time), &solution, &handed_out) {
        return Err(refused(&why));
    }
    teacher.check(&assignment.id)?;
    let uploaded = UploadedFolder {
        id: new_id(),
        assignment: assignment.id.clone(),
        digest: assignment.digest.clone(),
        uploaded_at: service.clock.now(),
        uploader: None,
        solution,
        handed_out,
        published_at: None,
    };
    let staff_id = teacher.staff().map(|member| member.id.as_str());
    service.store.add_folder(&uploaded, &assignment.folder, staff_id).await?;
    service.store.folder_of_digest(&uploaded.digest).await?.ok_or_else(Problem::not_found)
}

/// What is wrong with a folder that is read and drawn: `ggrade assignment check` holds it to the same. A hand-in has `deadline` seconds.
fn flaw(deadline: f64, solution: &Report, handed_out: &Report) -> Option<Text> {
    if solution.verdict != Verdict::Correct {
        let Text { en, ja } = scored(solution);
        return Some(Text::new(
            format!("its own solution does not get full marks: {en}"),
            format!("付属の解答が満点になりません: {ja}"),
        ));
    }
    if solution.elapsed_ms > deadline * 1e3 {
        let took = solution.elapsed_ms / 1e3;
        return Some(Text::new(
            format!(
                "its own solution took {took:.1} s, and a hand-in has {deadline} s: draw fewer poses or a smaller window, or write a \
                 longer `time`"
            ),
            format!(
                "付属の解答の採点に {took:.1} 秒かかりました。提出物の制限は {deadline} 秒です。ポーズを減らすか、ウィンドウを小さくするか、`time` を大きくしてください"
            ),
        ));
    }
    if handed_out.verdict != Verdict::Wrong {
        let Text { en, ja } = scored(handed_out);
        return Some(Text::new(
            format!("what it hands out must run and leave something to do, and it does not: {en}"),
            format!("配布ファイルは、実行でき、かつ未完成でなければなりません: {ja}"),
        ));
    }
    None
}

/// A verdict, the points, and the first thing that the report says, with its place.
fn scored(report: &Report) -> Text {
    let one = |language| {
        let labels = Labels::of(language);
        let verdict = labels.verdict(report.verdict);
        let said = report.diagnostics.first().map(|first| {
            let place = first.line.map(|line| labels.place(first.file.as_deref(), line, first.column) + ": ");
            let stop = if labels.japanese() { "。" } else { ". " };
            format!("{stop}{}{}", place.unwrap_or_default(), first.message.get(language))
        });
        format!("{verdict}, {} / {}{}", report.score, report.max_score, said.unwrap_or_default())
    };
    Text::new(one(Language::En), one(Language::Ja))
}

/// Serves a folder, or has what was handed in graded by it first, where there is something.
pub async fn publish(service: &Service, id: &str) -> Result<Publication, Problem> {
    let folder = stored(service, id).await?;
    let state = service.homework(&folder.assignment);
    if is_served(service, &folder) {
        return Ok(Publication::Served);
    }
    if state.is_none() && service.ids().len() >= MOST_ASSIGNMENTS {
        return Err(Problem::unprocessable(
            format!(
                "One service has at most {MOST_ASSIGNMENTS} homeworks. Take one out of service, or start another service."
            ),
            format!(
                "1 つのサービスで公開できる課題は {MOST_ASSIGNMENTS} 個までです。ほかの課題の公開をやめるか、サービスを分けてください。"
            ),
        ));
    }
    let assignment = read(service, id).await?;
    if let Some(state) = state
        && service.store.has_reports(&folder.assignment).await?
    {
        return Ok(Publication::Regrading(regrade::start(&state, false, Some(folder.id)).await?));
    }
    drawn(&assignment).await?;
    // Its settings are there before anybody asks for them.
    service.store.assignment(&assignment.id).await?;
    let turn = service.served_turn.acquire().await;
    service.store.publish(id, service.clock.now()).await?;
    service.serve(assignment);
    drop(turn);
    grading::folders_changed(service).await;
    grading::files_wait(service).await;
    Ok(Publication::Served)
}

/// Takes a homework out of service, as far as it was published here: what the command line names is served as it is there.
/// Nothing that was handed in is lost.
pub async fn withdraw(service: &Service, id: &str) -> Result<(), Problem> {
    let folder = stored(service, id).await?;
    let conflict = |en: &str, ja: &str| Err(Problem::new(StatusCode::CONFLICT, "in-use", en, ja));
    let is_named = service.named_as(&folder.assignment).is_some();
    if is_named && service.store.has_reports(&folder.assignment).await? {
        return conflict(
            "Files were graded by this folder. Upload the one that should take its place: what was handed in is graded by it first.",
            "このフォルダで採点された提出があります。代わりにするフォルダをアップロードしてください。提出されたファイルが先に再採点されます。",
        );
    }
    if !is_named && service.homework(&folder.assignment).is_some() && !service.has_several() {
        return conflict(
            "This is the only homework of the service. Publish another one first.",
            "このサービスの唯一の課題です。先に別の課題を公開してください。",
        );
    }
    let turn = service.served_turn.acquire().await;
    service.store.withdraw(&folder.assignment).await?;
    service.withdraw(&folder.assignment);
    drop(turn);
    grading::folders_changed(service).await;
    Ok(())
}

/// Forgets a folder that is not published.
pub async fn remove(service: &Service, id: &str) -> Result<(), Problem> {
    let folder = stored(service, id).await?;
    if folder.published_at.is_some() {
        return Err(Problem::new(
            StatusCode::CONFLICT,
            "in-use",
            "This folder was published, and reports were made by it: it is kept.",
            "公開したことのあるフォルダは、採点結果の根拠になるため削除できません。",
        ));
    }
    Ok(service.store.remove_folder(id).await?)
}

fn refused(why: &Text) -> Problem {
    Problem::unprocessable(
        format!("This archive is not the folder of a homework that grades: {}", why.en),
        format!("採点できる課題のフォルダではありません: {}", why.ja),
    )
}
