//! Which of a student's files are the ones to grade, see [`crate::slots`].

use super::folder;
use super::students::{Owned, StudentFiles};
use super::tree::Held;
use super::{FileLocation, HandInContent, IntakeOptions, in_working_folder};
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::slots::{self, Offered, SlotProblem, Trust, wording};

/// Chooses among the files of one student.
pub(super) fn choose(group: &StudentFiles, options: &IntakeOptions) -> HandInContent {
    let offers: Vec<SlotOffer> = group.files.iter().map(|file| SlotOffer { file, options }).collect();
    let trust = if group.is_named { Trust::Named } else { Trust::Found };
    match slots::fill(&options.slots, &offers, trust) {
        Ok(chosen) => taken(chosen.into_iter().map(|index| &offers[index]), options),
        Err(problems) => HandInContent::Nothing(why_not(group, options, &offers, &problems)),
    }
}

/// What there is for each slot among the files of one person, see [`super::some`].
pub(super) fn place(
    group: &StudentFiles,
    asked: usize,
    options: &IntakeOptions,
) -> Result<Vec<Option<HandedInFile>>, Text> {
    let offers: Vec<SlotOffer> = group.files.iter().map(|file| SlotOffer { file, options }).collect();
    let slots = &options.slots;
    let nothing = vec![None; slots.len()];
    let mut placed = slots::place(slots, &offers);
    let is_told = placed.as_ref().is_ok_and(|placed| *placed != nothing);
    if let (false, true, [_], Some(_)) = (is_told, group.is_named, offers.as_slice(), slots.get(asked)) {
        let mut alone = nothing.clone();
        alone[asked] = Some(0);
        placed = Ok(alone);
    }
    let missing = || (0..slots.len()).map(|slot| SlotProblem::Missing { slot }).collect();
    let placed = match placed {
        Ok(placed) if placed == nothing => Err(missing()),
        placed => placed,
    };
    let placed = placed.map_err(|problems| why_not(group, options, &offers, &problems))?;
    let file = |offer: &SlotOffer| Ok(HandedInFile::new(&offer.file.name, offer.content()?));
    placed.into_iter().map(|index| index.map(|index| file(&offers[index])).transpose()).collect()
}

/// A file that may be chosen. It is read when its content matters.
struct SlotOffer<'a> {
    file: &'a Owned,
    options: &'a IntakeOptions,
}

impl Offered for SlotOffer<'_> {
    fn name(&self) -> &str {
        &self.file.name
    }

    fn bytes(&self) -> Option<Vec<u8>> {
        self.content().ok()
    }
}

impl SlotOffer<'_> {
    /// The bytes, or why the file could not be taken.
    fn content(&self) -> Result<Vec<u8>, Text> {
        let bytes = match (&self.file.file.held, &self.file.file.local) {
            (Held::Bytes(bytes), _) => Ok(bytes.clone()),
            (Held::OnDisk, Some(local)) => {
                folder::bytes(local, self.options.limits.file_bytes).map_err(|error| super::limits::unreadable(&error))
            }
            (Held::OnDisk, None) | (Held::Unread, _) => Ok(Vec::new()),
            (Held::Refused(reason), _) => Err(reason.clone()),
        };
        let below = &self.file.below;
        bytes.map_err(|reason| {
            Text::new(
                format!("`{below}` could not be taken. {}", reason.en),
                format!("`{below}` を受け付けられませんでした。{}", reason.ja),
            )
        })
    }
}

/// The files that are graded, or why one of them cannot be taken.
fn taken<'a>(offers: impl Iterator<Item = &'a SlotOffer<'a>>, options: &IntakeOptions) -> HandInContent {
    let mut hand_in = HandIn::default();
    let mut places = Vec::new();
    for offer in offers {
        match offer.content() {
            Ok(bytes) => hand_in.files.push(HandedInFile::new(&offer.file.name, bytes)),
            Err(reason) => return HandInContent::Nothing(reason),
        }
        let local = offer.file.file.local.as_deref().and_then(in_working_folder);
        places.push(FileLocation { path: offer.file.path.clone(), local });
    }
    HandInContent::Files { hand_in: slots::tell_apart(&options.slots, hand_in), places }
}

fn why_not(group: &StudentFiles, options: &IntakeOptions, offers: &[SlotOffer], problems: &[SlotProblem]) -> Text {
    let is_missing = problems.iter().any(|problem| matches!(problem, SlotProblem::Missing { .. }));
    // What could not be opened may be what is missing.
    let refused = offers.iter().filter(|offer| matches!(offer.file.file.held, Held::Refused(_)));
    if let Some(reason) = refused.filter(|_| is_missing).find_map(|offer| offer.content().err()) {
        return reason;
    }
    if offers.is_empty() && group.has_online_text {
        let wanted = wording::wanted(&options.slots);
        return Text::new(
            format!("Only text typed into Moodle was handed in. Hand in the file {}.", wanted.en),
            format!("オンラインテキストだけが提出されています。ファイル {} を提出してください。", wanted.ja),
        );
    }
    let names: Vec<String> = offers.iter().map(|offer| offer.file.below.clone()).collect();
    wording::unfilled(&options.slots, &names, problems)
}
