//! Which answers of a class are alike: the attempt that counts of each, held against those of the class and of whoever is
//! kept beside it (earlier terms, archives, hand-ins without a name).

use super::State;
use super::classes::{People, Person, people};
use super::errors::Problem;
use super::gallery::blocking;
use super::store::Submission;
use crate::likeness::{Answer, Comparison, Likeness, Pair};
use crate::source::Source;

/// Most pairs that are told.
const MOST: usize = 200;

/// One of two whose answers are alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AlikePerson {
    /// What tells them apart, see [`Person::key`].
    pub key: String,
    /// Student number, or what stands for it.
    pub number: String,
    /// Name, where it is known.
    pub name: String,
    /// Id of the submission that was looked at.
    pub submission: String,
    /// Whether they are of the class; others are of an earlier term, or of nobody.
    pub is_of_class: bool,
}

impl AlikePerson {
    /// By what they are called on a page.
    pub fn called(&self) -> String {
        match (self.number.is_empty(), self.name.is_empty()) {
            (false, false) => format!("{} {}", self.number, self.name),
            (false, true) => self.number.clone(),
            (true, false) => self.name.clone(),
            (true, true) => self.submission.get(..8).unwrap_or(&self.submission).to_owned(),
        }
    }
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct AlikePairs {
    /// How many answers of the class were looked at,
    pub class: usize,
    /// and how many others.
    pub others: usize,
    /// Who is alike, the most alike first.
    pub pairs: Vec<(Pair, [AlikePerson; 2])>,
    /// How many pairs are left out, because there are too many.
    pub left_out: usize,
}

/// Holds the answers of a class against each other.
pub async fn find(state: &State) -> Result<AlikePairs, Problem> {
    let People { class, apart } = people(state).await?;
    let of_class: Vec<AlikePerson> = class.iter().filter_map(|person| member(person, true)).collect();
    let others: Vec<AlikePerson> = apart.iter().filter_map(|person| member(person, false)).collect();
    let mut hand_ins = state.store.hand_ins(&state.assignment.id).await?;
    let (class, others_count) = (of_class.len(), others.len());
    let members: Vec<AlikePerson> = of_class.into_iter().chain(others).collect();
    let files: Vec<_> = members.iter().map(|member| hand_ins.remove(&member.submission).unwrap_or_default()).collect();
    let mut pairs = blocking(state, move |state| {
        let likeness = Likeness::of(&state.assignment);
        let answers: Vec<Answer> = files.iter().map(|hand_in| likeness.read(&hand_in.readable())).collect();
        Ok(likeness.pairs(&answers, class))
    })
    .await?;
    let left_out = pairs.len().saturating_sub(MOST);
    pairs.truncate(MOST);
    let named = |pair: Pair| {
        let members = [members[pair.places.0].clone(), members[pair.places.1].clone()];
        (pair, members)
    };
    Ok(AlikePairs { class, others: others_count, pairs: pairs.into_iter().map(named).collect(), left_out })
}

/// Somebody with the attempt that counts, or the last one while none is graded.
fn member(person: &Person, is_of_class: bool) -> Option<AlikePerson> {
    let row = person.counted().or_else(|| person.rows.first())?;
    Some(AlikePerson {
        key: person.key.clone(),
        number: person.number.clone(),
        name: person.name.clone(),
        submission: row.row.submission.id.clone(),
        is_of_class,
    })
}

/// Two hand-ins of a homework side by side; the names are those that are to be shown.
pub async fn compare(state: &State, ids: [&str; 2], names: [String; 2]) -> Result<Comparison, Problem> {
    let mut files: Vec<Vec<Source>> = Vec::new();
    for id in ids {
        let submission: Submission = state.store.submission(id).await?.ok_or_else(Problem::not_found)?;
        if submission.assignment != state.assignment.id {
            return Err(Problem::not_found());
        }
        files.push(state.store.hand_in(id).await?.unwrap_or_default().readable());
    }
    blocking(state, move |state| {
        let likeness = Likeness::of(&state.assignment);
        let answers: Vec<Answer> = files.iter().map(|sources| likeness.read(sources)).collect();
        let pair = likeness.pair(&answers[0], &answers[1]);
        let sides = likeness.compare((&answers[0], &files[0]), (&answers[1], &files[1]));
        Ok(Comparison { pair, names, sides: sides.into() })
    })
    .await
}

/// Who handed this in.
pub async fn member_of(state: &State, submission: &str) -> Result<AlikePerson, Problem> {
    let People { class, apart } = people(state).await?;
    let all = class.iter().map(|person| (person, true)).chain(apart.iter().map(|person| (person, false)));
    let mut found = all.filter(|(person, _)| person.rows.iter().any(|row| row.row.submission.id == submission));
    let (person, is_of_class) = found.next().ok_or_else(Problem::not_found)?;
    Ok(AlikePerson {
        key: person.key.clone(),
        number: person.number.clone(),
        name: person.name.clone(),
        submission: submission.to_owned(),
        is_of_class,
    })
}
