//! Whose file is next: everybody's first file as it comes, and who sends many at once behind who does not.
//!
//! A turn is a time. It is the time of arrival for who sends seldom; each further file is later than the one before by what a
//! file is allowed to cost, as if the files had come so far apart. A file whose turn is in the future waits only for files
//! with earlier turns: nobody waits for an idle grader. All processes on a database take turns together.

use super::{Result, Store, on};
use crate::hand_in::hexadecimal;
use crate::service::clock::Millis;
use sha2::{Digest, Sha256};
use std::net::IpAddr;

/// What one file of a browser or a student costs, in milliseconds: who hands in no faster than this is never set back.
const BY_OWNER: Millis = 1000;

/// The same of an address, behind which a whole class may sit: 20 files a second.
const BY_ADDRESS: Millis = 50;

/// How long the files of a sender wait behind all others after one of them had to be stopped, in milliseconds.
const SUSPECTED: Millis = 600_000;

/// The turn of a file of sender `$1` that comes at `$2`; that of their next one is `$3` later.
pub(super) const TAKE_TURN: &str = "INSERT INTO senders (sender, turn) VALUES ($1, $2 + $3) ON CONFLICT (sender) DO UPDATE \
                                    SET turn = CASE WHEN senders.turn > $2 THEN senders.turn ELSE $2 END + $3 \
                                    RETURNING turn - $3";

/// Holds the row of sender `$1` until the transaction ends: others who send as the same one wait. Their turn stays.
pub(super) const HOLD: &str = "INSERT INTO senders (sender, turn) VALUES ($1, 0) \
                               ON CONFLICT (sender) DO UPDATE SET turn = senders.turn";

/// Suspects who sent file `$1` until `$2`.
pub(super) const SUSPECT: &str = "INSERT INTO senders (sender, turn, suspected_until) SELECT sender, 0, $2 FROM submissions \
                                  WHERE id = $1 AND sender IS NOT NULL \
                                  ON CONFLICT (sender) DO UPDATE SET suspected_until = $2";

/// Until when who sent a file is suspected that was stopped at `now`.
pub(super) fn suspected_until(now: Millis) -> Millis {
    now + SUSPECTED
}

/// Who is told apart from others who send.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sender {
    /// A browser or a student, by id.
    Owner(String),
    /// Whoever sends from an address.
    Address(IpAddr),
}

impl Sender {
    /// What is kept of them.
    pub(super) fn key(&self) -> String {
        let text = match self {
            Self::Owner(id) => format!("owner {id}"),
            Self::Address(address) => format!("address {address}"),
        };
        hexadecimal(&Sha256::digest(text))
    }

    /// How much later the turn of each further file is.
    pub(super) fn cost(&self) -> Millis {
        match self {
            Self::Owner(_) => BY_OWNER,
            Self::Address(_) => BY_ADDRESS,
        }
    }
}

impl Store {
    /// Forgets who is neither set back nor suspected any more.
    pub async fn forget_senders(&self, now: Millis) -> Result<()> {
        const SQL: &str = "DELETE FROM senders WHERE turn <= $1 AND suspected_until <= $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(now).execute(db).await?; });
        Ok(())
    }
}
