//! The moving pictures as files, each a sheet of all poses.

use super::base::{ExpectedSheets, look_alike};
use super::cache::PictureCache;
use super::motion::Motion;
use super::sheet::SheetGrid;
use super::shots::Shots;
use crate::fault::Fault;
use crate::report::encode::{Canvas, Raster, encode_small, mismatched};
use crate::report::pictures::fit;
use crate::report::{Area, Picture, Pictures, TermPictures};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::sync::Arc;

/// Where a film is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmUse {
    /// In a page that holds it.
    Embedded,
    /// By a service, each sheet a file.
    Served,
}

/// Bytes of the two sheets of a film that are served. A shader that draws noise would take 15 MB, and is shown at a lower resolution.
const BUDGET_OF_SERVED: usize = 400_000;
/// Bytes of the three sheets of a film as they stand in a page, of which a page has at most 250 kB. Those of ggsample06 take 130 to 160
/// kB. Scenes that are lit pixel by pixel would take 300 to 650, and noise 20 MB: they are shown at a lower resolution instead.
const BUDGET: usize = 175_000;
/// The most of it that the right pictures take. What is handed in draws about the same, and where it differs is drawn in few colours.
const BUDGET_OF_EXPECTED: usize = 80_000;
/// Bytes that the picture of a single term takes in its own resolution. It is shown half as wide as a sheet's frame: a larger one has half
/// the pixels across and down.
const BUDGET_OF_TERM: usize = 6_000;
/// Factors by which the pictures are reduced in turn until they fit.
const REDUCTIONS: [usize; 4] = [1, 2, 4, 8];

/// The moving pictures of one grading.
#[derive(Clone, Debug)]
pub struct Film {
    /// What the student's shader draws, a PNG of all poses.
    pub yours: Vec<u8>,
    /// Where it differs from what a right answer draws.
    pub difference: Vec<u8>,
    /// Whether they are smaller than they were drawn because they would take too many bytes.
    pub is_reduced: bool,
    /// How they move.
    pub motion: Motion,
    part: Area,
    factor: usize,
}

/// What is expected, and the film of something beside it.
type MadeFilm = (Arc<[Picture]>, Option<Arc<Film>>);

impl Film {
    /// The film of a grading, in every pixel or, where that is too large, in some of them; `None` when nothing was drawn. Gradings that
    /// share their pictures have one film.
    pub fn of(yours: &Arc<[Picture]>, expected: &Arc<[Picture]>, shown: FilmUse) -> Result<Option<Arc<Self>>, Fault> {
        static MADE: PictureCache<[Picture], FilmUse, MadeFilm> = PictureCache::new();
        let make = || Ok((Arc::clone(expected), Self::made(yours, expected, shown)?.map(Arc::new)));
        let (of, film) = MADE.get(yours, shown, make)?;
        // Answers to two homeworks may draw the same.
        if Arc::ptr_eq(&of, expected) { Ok(film) } else { Ok(make()?.1) }
    }

    fn made(yours: &[Picture], expected: &Arc<[Picture]>, shown: FilmUse) -> Result<Option<Self>, Fault> {
        fit(yours, expected)?;
        let Some(first) = expected.first() else { return Ok(None) };
        // A sheet that is served stands beside those of others, in one place for all.
        let (finest, part) = match shown {
            FilmUse::Embedded => (finest(expected)?, shared_area(yours, expected)),
            FilmUse::Served => (1, Area::whole(first.width, first.height)),
        };
        let motion = Motion::of(expected.len(), first.width as usize, first.height as usize);
        let motion = motion.within(part, first.blank);
        let made = |yours, difference, factor| Self { yours, difference, is_reduced: factor > 1, motion, part, factor };
        if finest == 1
            && let Some([yours, difference]) = ExpectedSheets::of(expected, motion.grid, part)?.sheets(yours, expected)
        {
            let film = made(yours.encode()?, difference.encode()?, 1);
            if film.fits(expected, shown)? {
                return Ok(Some(film));
            }
        }
        let (Some(drawn), Some(right)) = (Shots::of(yours, part), Shots::of(expected, part)) else { return Ok(None) };
        let mut fitting = None;
        for factor in REDUCTIONS.into_iter().filter(|factor| *factor >= finest) {
            let yours = drawn.sheet(motion.grid, factor).encode()?;
            let difference = drawn.difference(&right, motion.grid, factor).encode()?;
            let film = fitting.insert(made(yours, difference, factor));
            if film.fits(expected, shown)? {
                break;
            }
        }
        Ok(fitting)
    }

    fn fits(&self, expected: &Arc<[Picture]>, shown: FilmUse) -> Result<bool, Fault> {
        Ok(match shown {
            FilmUse::Embedded => {
                let expected = expected_address(expected, self.part, self.factor)?.len();
                embedded_length(&self.yours) + embedded_length(&self.difference) + expected <= BUDGET
            }
            FilmUse::Served => self.yours.len() + self.difference.len() <= BUDGET_OF_SERVED,
        })
    }

    /// Where a page that holds all pictures itself finds them. `still`: the PNG of a single frame.
    pub fn embedded(&self, pictures: &Pictures, still: Option<Vec<u8>>) -> Result<PictureAddresses, Fault> {
        static MADE: PictureCache<Picture, (), Arc<str>> = PictureCache::new();
        let address = |picture: &Arc<Picture>| {
            MADE.get(picture, (), || {
                let whole = Raster::opaque(picture)?;
                let png = encode_small(&whole)?;
                let png = if png.len() > BUDGET_OF_TERM { encode_small(&whole.reduced(2))? } else { png };
                Ok(inline(&png).into())
            })
        };
        let term = |term: &TermPictures| {
            let yours = term.yours.as_ref().map(address).transpose()?;
            Ok::<_, Fault>(TermFilm { id: term.id.clone(), t: term.t, yours, expected: address(&term.expected)? })
        };
        Ok(PictureAddresses {
            yours: inline(&self.yours),
            expected: expected_address(&pictures.expected, self.part, self.factor)?,
            difference: inline(&self.difference),
            is_reduced: self.is_reduced,
            still: still.map(|png| inline(&png)),
            terms: pictures.terms.iter().map(term).collect::<Result<_, _>>()?,
        })
    }
}

/// The sheet of what a right answer draws in every pixel, the same for every film of an assignment, as a PNG.
pub fn expected_sheet(expected: &[Picture]) -> Result<Vec<u8>, Fault> {
    let whole = expected.first().map(|first| Area::whole(first.width, first.height)).unwrap_or_default();
    reduced_sheet(expected, whole, 1)?.encode_hardest()
}

fn reduced_sheet(expected: &[Picture], part: Area, factor: usize) -> Result<Canvas, Fault> {
    fit(expected, expected)?;
    let shots = Shots::of(expected, part).ok_or_else(mismatched)?;
    Ok(shots.sheet(SheetGrid::of(expected.len()), factor))
}

/// The sheet of a part of it, inside a page.
fn expected_address(expected: &Arc<[Picture]>, part: Area, factor: usize) -> Result<Arc<str>, Fault> {
    static MADE: PictureCache<[Picture], (Area, usize), Arc<str>> = PictureCache::new();
    MADE.get(expected, (part, factor), || Ok(inline(&reduced_sheet(expected, part, factor)?.encode_hardest()?).into()))
}

/// The part of all pictures that a page shows, the rest of which is background: where a right answer draws, for most others draw
/// nowhere else, and share what is made of it. All of them where one draws elsewhere.
fn shared_area(yours: &[Picture], expected: &[Picture]) -> Area {
    let Some(first) = expected.first() else { return Area::default() };
    let painted = |pictures: &[Picture]| pictures.iter().fold(Area::default(), |all, picture| all.with(picture.area));
    let right = painted(expected);
    let is_alike = yours.iter().chain(expected).all(|picture| look_alike(&[picture.blank], &[first.blank]));
    match is_alike && !right.is_empty() && right.with(painted(yours)) == right {
        true => right,
        false => Area::whole(first.width, first.height),
    }
}

/// The least reduction at which the right pictures take their share of a page.
fn finest(expected: &Arc<[Picture]>) -> Result<usize, Fault> {
    static FOUND: PictureCache<[Picture], (), usize> = PictureCache::new();
    FOUND.get(expected, (), || {
        for factor in REDUCTIONS {
            let sheet = reduced_sheet(expected, shared_area(expected, expected), factor)?;
            if embedded_length(&sheet.encode()?) <= BUDGET_OF_EXPECTED {
                return Ok(factor);
            }
        }
        Ok(REDUCTIONS[REDUCTIONS.len() - 1])
    })
}

/// Bytes that a PNG takes in a page.
fn embedded_length(png: &[u8]) -> usize {
    png.len().div_ceil(3) * 4
}

fn inline(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// Addresses of the pictures that a report shows.
#[derive(Clone, Debug, Default)]
pub struct PictureAddresses {
    /// The sheet of what the student's shader draws.
    pub yours: String,
    /// The sheet of what a right answer draws.
    pub expected: Arc<str>,
    /// The sheet of where they differ.
    pub difference: String,
    /// Whether to say that the sheets are smaller than they were drawn.
    pub is_reduced: bool,
    /// The frame of a single moment, where it is a picture of its own; else it is cut out of the sheet.
    pub still: Option<String>,
    /// Single terms of the equation.
    pub terms: Arc<[TermFilm]>,
}

/// Addresses of the pictures of one term of the equation.
#[derive(Clone, Debug)]
pub struct TermFilm {
    /// Id of the rubric line that judges it.
    pub id: String,
    /// Fraction of the animation cycle, in [0, 1).
    pub t: f64,
    /// As the student's shader computes it, where a known mistake explains it.
    pub yours: Option<Arc<str>>,
    /// As a right answer computes it.
    pub expected: Arc<str>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    #[test]
    fn gradings_that_share_their_pictures_have_one_film_each_beside_its_own_right_ones() {
        let pictures = samples::pictures();
        let film = |expected: &Arc<[Picture]>| {
            Film::of(&pictures.yours, expected, FilmUse::Embedded).expect("no fault").expect("a film")
        };
        assert!(Arc::ptr_eq(&film(&pictures.expected), &film(&pictures.expected)));
        // The same drawing as an answer to another homework, to which it is right.
        let right = film(&pictures.yours);
        assert_ne!(right.difference, film(&pictures.expected).difference);
    }
}
