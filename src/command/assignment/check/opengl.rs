//! Whether the machine's OpenGL driver draws of the solution what the interpreter computes.

use super::CheckWording;
use crate::language::Text;
use crate::opengl::{Agreement, FrameAgreement, REFERENCE_TOLERANCE};
use std::process::{Command, Stdio};

/// Says it, and whether they agree. Where there is no driver nothing is held against it, which is no error of the homework.
pub(super) fn say(said: CheckWording, assignment: &str) -> bool {
    match asked(assignment) {
        Err(why) => {
            said.note(&Text::new(
                format!("the solution was not held against real OpenGL: {why}"),
                format!("本物の OpenGL とは比べていません: {why}"),
            ));
            true
        }
        Ok(Agreement { refusal: Some(log), renderer, .. }) => {
            said.line(
                false,
                &Text::new(
                    format!("real OpenGL ({renderer}) refuses the solution: {}", log.trim_end()),
                    format!("本物の OpenGL ({renderer}) が解答を受け付けません: {}", log.trim_end()),
                ),
            );
            false
        }
        Ok(Agreement { renderer, frames, .. }) => say_frames(said, &renderer, &frames),
    }
}

fn say_frames(said: CheckWording, renderer: &str, frames: &[FrameAgreement]) -> bool {
    if let Some((index, frame)) = frames.iter().enumerate().find(|(_, frame)| !frame.agrees()) {
        let FrameAgreement { judged, unlike, .. } = frame;
        let text = Text::new(
            format!(
                "real OpenGL ({renderer}) draws {unlike} of {judged} pixels of frame {index} otherwise, by more than \
                 {REFERENCE_TOLERANCE}/255: look for values that are next to nothing or depend on neighbouring pixels; where a texture \
                 decides them, drivers mix its texels with weights of 8 bits, so write `filter = \"nearest\"`, or give it more texels"
            ),
            format!(
                "本物の OpenGL ({renderer}) では、画像 {index} の {judged} 画素中 {unlike} 画素が {REFERENCE_TOLERANCE}/255 を超えて異なります。0 に近い値や、隣の画素との差で決まる値がないか確かめてください。テクスチャで決まる値なら、\
                 ドライバーはテクセルを 8 ビットの重みで混ぜるので、`filter = \"nearest\"` と書くか、テクセルを増やしてください"
            ),
        );
        said.line(false, &text);
        return false;
    }
    let count = frames.len();
    let apart: usize = frames.iter().map(|frame| frame.differing).sum();
    let mut text = Text::new(
        format!("real OpenGL ({renderer}) draws the same in all {count} frames"),
        format!("本物の OpenGL ({renderer}) が描く画像も {count} 枚すべてで同じです"),
    );
    if apart > 0 {
        text.en += &format!("; in {apart} pixels an edge that a texture draws lies elsewhere");
        text.ja += &format!("(テクスチャの値で決まる境界が {apart} 画素でずれます)");
    }
    said.ok(&text);
    true
}

fn asked(assignment: &str) -> Result<Agreement, String> {
    let mut command = Command::new("/proc/self/exe");
    command.args(["opengl", assignment]).stdin(Stdio::null()).stderr(Stdio::piped());
    let output = command.output().map_err(|error| error.to_string())?;
    if output.status.success() {
        return serde_json::from_slice::<Result<Agreement, String>>(&output.stdout)
            .map_err(|error| error.to_string())?;
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("the driver ended ({}): {}", output.status, said.lines().next().unwrap_or_default()))
}
