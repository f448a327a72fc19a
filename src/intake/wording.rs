//! What is said of files that can be several students'.

use super::Participant;
use super::moodle;
use crate::language::Text;
use crate::slots::wording::list;

/// A name in a Moodle download that is one of several students'.
pub(super) fn unclear(participants: &[Participant]) -> Text {
    let names: Vec<String> = participants.iter().map(moodle::numbered).collect();
    let list = list(&names);
    Text::new(
        format!(
            "Its name can be read as that of a file of each of these: {}. It is not graded for any of them. Download the \
             submissions with \"Download submissions in folders\" on, which leaves no doubt.",
            list.en
        ),
        format!(
            "この名前は、次のどの提出者のファイルとも読めます: {}。だれの提出としても採点していません。Moodle の\
             「提出をフォルダに入れてダウンロードする」を有効にしてダウンロードし直すと、区別できます。",
            list.ja
        ),
    )
}
