//! Whether the machine's OpenGL driver draws of the solution what the interpreter computes.

use super::Said;
use crate::language::Text;
use crate::opengl::{Agreement, REFERENCE_TOLERANCE};
use std::process::{Command, Stdio};

/// Says it, and whether they agree. Where there is no driver nothing is held against it, which is no error of the homework.
pub(super) fn say(said: Said, assignment: &str) -> bool {
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
        Ok(Agreement { renderer, frames, .. }) => {
            let differing = |(index, frame): (usize, &crate::opengl::FrameAgreement)| {
                (frame.differing > 0).then_some((index, frame.differing, frame.judged))
            };
            let Some((index, count, judged)) = frames.iter().enumerate().find_map(differing) else {
                let frames = frames.len();
                said.ok(&Text::new(
                    format!("real OpenGL ({renderer}) draws the same in all {frames} frames"),
                    format!("本物の OpenGL ({renderer}) が描く画像も {frames} 枚すべてで同じです"),
                ));
                return true;
            };
            said.line(
                false,
                &Text::new(
                    format!(
                        "real OpenGL ({renderer}) draws {count} of {judged} pixels of frame {index} otherwise, by more than \
                         {REFERENCE_TOLERANCE}/255"
                    ),
                    format!(
                        "本物の OpenGL ({renderer}) では、画像 {index} の {judged} 画素中 {count} 画素が {REFERENCE_TOLERANCE}/255 を超えて異なります"
                    ),
                ),
            );
            false
        }
    }
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
