//! What a student may still hand in, and until when.

use super::frame::PageFrame;
use crate::language::{Language, span};
use crate::report::text::number;
use crate::service::State;
use crate::service::clock::Millis;
use crate::service::errors::Problem;
use crate::service::identity::Identity;
use crate::service::store::{AssignmentSettings, LateSpan};

/// Milliseconds before the deadline from which it is urgent.
const URGENT: Millis = 24 * 3_600_000;

/// How a student stands towards the deadline and the number of attempts.
#[derive(Clone, Copy)]
pub(super) struct StudentStanding<'a> {
    /// What the teacher set.
    pub settings: &'a AssignmentSettings,
    pub now: Millis,
    /// Whether the course knows enough of who sits there.
    pub may_hand_in: bool,
    /// Attempts that count.
    pub used: u64,
}

/// Something to know before handing in.
pub(super) struct Fact {
    pub kind: &'static str,
    pub text: String,
    pub until: Option<Until>,
}

/// What is left until a moment, which the page keeps current.
pub(super) struct Until {
    pub at: Millis,
    /// The sentence, with `%` for what is left.
    pub template: &'static str,
    pub text: String,
    /// What is said when the moment has come.
    pub over: &'static str,
    /// Whether handing in ends then.
    pub closes: bool,
}

impl Fact {
    pub fn plain(kind: &'static str, text: String) -> Self {
        Self { kind, text, until: None }
    }
}

impl StudentStanding<'_> {
    pub fn attempts_left(&self) -> Option<u64> {
        self.settings.attempts.map(|most| most.saturating_sub(self.used))
    }

    pub fn can_hand_in(&self) -> bool {
        self.may_hand_in && self.settings.is_open(self.now) && self.attempts_left() != Some(0)
    }

    pub fn grades_drafts(&self) -> bool {
        self.may_hand_in && self.settings.grades_drafts(self.now)
    }

    fn is_closed(&self) -> bool {
        self.settings.is_closed(self.now)
    }

    /// Dates and attempts.
    pub fn facts(&self, frame: &PageFrame) -> Vec<Fact> {
        let is_english = frame.language == Language::En;
        let say = |en: String, ja: String| if is_english { en } else { ja };
        let moment = |at| frame.deadline(at).text;
        let mut facts = Vec::new();
        match (self.settings.opens_at, self.settings.closes_at) {
            (Some(opens), _) if self.now < opens => {
                let text = say(format!("Opens {}", moment(opens)), format!("受付開始 {}", moment(opens)));
                let template = frame.say("in %", "あと %");
                let over = frame.say("open now", "受付中");
                facts.push(Fact { kind: "urgent", text, until: Some(self.until(frame, opens, template, over, false)) });
            }
            (_, Some(due)) => facts.extend(self.dates(frame, due)),
            _ => {}
        }
        if self.settings.has_own_deadline && !self.is_closed() {
            facts
                .push(Fact::plain("", say("extended for you".to_owned(), "あなたの締切は延長されています".to_owned())));
        }
        if let (Some(most), Some(left), false) = (self.settings.attempts, self.attempts_left(), self.is_closed()) {
            let kind = if left <= 1 { "urgent" } else { "" };
            let text = say(format!("{left} of {most} attempts left"), format!("提出できる回数 残り {left} / {most}"));
            facts.push(Fact::plain(kind, text));
        }
        facts
    }

    /// What there is to say of a due date: when it is, or what comes after it.
    fn dates(&self, frame: &PageFrame, due: Millis) -> Vec<Fact> {
        let is_english = frame.language == Language::En;
        let say = |en: String, ja: String| if is_english { en } else { ja };
        let moment = |at| frame.deadline(at).text;
        let late_from = self.settings.late_from().unwrap_or(due);
        let ends = self.settings.ends_at().unwrap_or(due);
        let late = (ends > late_from).then(|| Fact::plain("", late_rules(self.settings, frame, ends)));
        let dated = |kind, text, at, left: (&'static str, &'static str), over: (&'static str, &'static str)| {
            let (template, over) = (frame.say(left.0, left.1), frame.say(over.0, over.1));
            Fact { kind, text, until: Some(self.until(frame, at, template, over, at == ends)) }
        };
        let left = ("% left", "残り %");
        let passed = ("the deadline has passed", "締切を過ぎました");
        let kind = |at: Millis| if at - self.now < URGENT { "urgent" } else { "" };
        match self.now {
            now if now < due => {
                let text = say(format!("Due {}", moment(due)), format!("締切 {}", moment(due)));
                std::iter::once(dated(kind(due), text, due, left, passed)).chain(late).collect()
            }
            now if now < late_from => {
                let text = say(
                    format!("Was due {}. Not late until {}", moment(due), moment(late_from)),
                    format!("締切 {}。{} までは遅延になりません", moment(due), moment(late_from)),
                );
                std::iter::once(dated("urgent", text, late_from, left, passed)).chain(late).collect()
            }
            now if now < ends => {
                let text = say(
                    format!("Was due {}. Late hand-ins until {}", moment(due), moment(ends)),
                    format!("締切 {}。遅延提出は {} まで", moment(due), moment(ends)),
                );
                let over = ("handing in has ended", "受付を終了しました");
                std::iter::once(dated("urgent", text, ends, left, over)).chain(late).collect()
            }
            _ => {
                let text = say(format!("Closed since {}", moment(ends)), format!("受付終了 {}", moment(ends)));
                vec![Fact::plain("urgent", text)]
            }
        }
    }

    fn until(&self, frame: &PageFrame, at: Millis, template: &'static str, over: &'static str, closes: bool) -> Until {
        let text = template.replace('%', &span((at - self.now).max(0).unsigned_abs(), frame.language));
        Until { at, template, text, over, closes }
    }

    /// What stands in place of the button, where there is none.
    pub fn hindrance(&self, frame: &PageFrame) -> Option<&'static str> {
        match () {
            () if !self.may_hand_in || self.can_hand_in() => None,
            () if self.settings.is_archived => Some(frame.say(
                "This course is archived. Reports can still be read.",
                "この授業はアーカイブされています。採点結果は引き続き閲覧できます。",
            )),
            () if self.is_closed() && self.settings.practice => Some(frame.say(
                "Handing in is over. What you type is still graded, as practice.",
                "提出の受付は終了しました。入力した内容は、引き続き練習として採点します。",
            )),
            () if self.is_closed() => Some(frame.say("Handing in is over.", "提出の受付は終了しました。")),
            () if self.attempts_left() == Some(0) => {
                Some(frame.say("All attempts are used up.", "提出できる回数を使い切りました。"))
            }
            () => Some(frame.say("Handing in has not begun yet.", "提出の受付はまだ始まっていません。")),
        }
    }

    /// What the page does with what is typed; `has_several` says whether the homework is several files.
    pub fn how(&self, frame: &PageFrame, has_several: bool) -> String {
        let given = if has_several {
            frame.say(
                "Drop files here, several at once or a ZIP of them, paste, or type.",
                "ファイルをここにドロップするか（複数まとめて、または ZIP でも可）、貼り付けるか、直接入力してください。",
            )
        } else {
            frame.say(
                "Drop a file here, paste, or type.",
                "ファイルをここにドロップするか、貼り付けるか、直接入力してください。",
            )
        };
        let graded = match (self.grades_drafts(), self.can_hand_in()) {
            (true, true) => frame.say(
                " What you type is graded as you go; that is a draft and not an attempt.",
                "入力中の内容はそのつど採点されますが、下書きであり、提出にはなりません。",
            ),
            (true, false) => frame.say(
                " What you type is graded as you go, as practice.",
                "入力中の内容は、練習としてそのつど採点されます。",
            ),
            (false, true) => frame.say(" It is graded when you hand it in.", "採点は提出したときに行います。"),
            (false, false) => {
                return frame.say("Nothing is graded here at the moment.", "現在、採点は行っていません。").to_owned();
            }
        };
        format!("{given}{graded}")
    }

    /// The steps of a student's work that follow upon the writing.
    pub fn steps(&self, frame: &PageFrame) -> Vec<&'static str> {
        let seen =
            frame.say("See at once what is right and what is not.", "どこが正しく、どこが違うかがすぐに分かります。");
        match (self.grades_drafts(), self.can_hand_in()) {
            (true, true) => vec![seen, frame.say("Hand in when you are content.", "納得できたら提出してください。")],
            (true, false) => vec![seen],
            (false, true) => vec![frame.say(
                "Hand in, and see what is right and what is not.",
                "提出すると、どこが正しく、どこが違うかが分かります。",
            )],
            (false, false) => Vec::new(),
        }
    }

    /// What a graded text is called that was not handed in.
    pub fn draft_word(&self, frame: &PageFrame) -> &'static str {
        if self.can_hand_in() {
            frame.say("draft, not handed in", "下書き（未提出）")
        } else {
            frame.say("practice, not handed in", "練習（提出ではありません）")
        }
    }
}

/// Until when late hand-ins are taken, and what they lose.
fn late_rules(settings: &AssignmentSettings, frame: &PageFrame, ends: Millis) -> String {
    let (rules, ends) = (&settings.late, frame.datetime(ends).text);
    let (percent, floor) = (number(rules.percent), number(rules.floor));
    let (en, ja) = match rules.span {
        LateSpan::Day => ("day", "1 日"),
        LateSpan::Hour => ("hour", "1 時間"),
    };
    let is_limited = rules.floor > 0.0;
    match frame.language {
        Language::En if rules.percent <= 0.0 => format!("Late hand-ins until {ends}, without a deduction"),
        Language::En => {
            let least = if is_limited { format!(", never below {floor} %") } else { String::new() };
            format!("Late until {ends}: −{percent} % of the points for each {en} begun{least}")
        }
        Language::Ja if rules.percent <= 0.0 => format!("遅延提出は {ends} まで（減点なし）"),
        Language::Ja => {
            let least = if is_limited { format!("、下限 {floor} %") } else { String::new() };
            format!("遅延提出は {ends} まで（{ja}ごとに満点の {percent} % を減点{least}）")
        }
    }
}

/// What is said to whoever gave no number, where that matters.
pub(super) async fn number_notice(
    state: &State,
    frame: &PageFrame,
    identity: &Identity,
    needs_number: bool,
) -> Result<Option<&'static str>, Problem> {
    if needs_number {
        return Ok(Some(frame.say(
            "To hand in, open the link that your teacher gave you and enter your student number.",
            "提出するには、教員から伝えられたリンクを開き、学籍番号を入力してください。",
        )));
    }
    let is_nobodys = identity.student().is_none() && state.store.has_roster().await?;
    Ok(is_nobodys.then(|| {
        frame.say(
            "No student number is attached to what you hand in here: it counts for nobody. To be graded, open the link that your teacher gave you and enter your student number.",
            "学籍番号が登録されていないため、ここで提出してもだれの成績にもなりません。成績に反映するには、教員から伝えられたリンクを開き、学籍番号を入力してください。",
        )
    }))
}
