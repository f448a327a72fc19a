//! Lines of a source, and where they stand in its text.

use super::Source;

impl Source {
    /// How many lines there are.
    pub fn line_count(&self) -> u32 {
        u32::try_from(self.line_starts.len()).unwrap_or(u32::MAX)
    }

    /// Line `number`, from 1, without its end; empty where there is no such line.
    pub fn line(&self, number: u32) -> &str {
        self.line_of(&self.text, number)
    }

    /// Line `number`, from 1, of [`Source::code`].
    pub fn code_line(&self, number: u32) -> &str {
        self.line_of(&self.code, number)
    }

    fn line_of<'a>(&self, text: &'a str, number: u32) -> &'a str {
        let Some(index) = (number as usize).checked_sub(1) else {
            return "";
        };
        let Some(&start) = self.line_starts.get(index) else {
            return "";
        };
        let end = self.line_starts.get(index + 1).copied().unwrap_or(text.len());
        text[start..end].trim_end_matches('\n')
    }

    /// Line and column, both from 1, of a byte offset into the text; the column counts characters. An offset inside a
    /// character is that character's; one past the end is the end of the last line.
    pub fn position(&self, offset: usize) -> (u32, u32) {
        let line = self.line_starts.partition_point(|&start| start <= offset).max(1);
        let start = self.line_starts.get(line - 1).copied().unwrap_or(0);
        let line = u32::try_from(line).unwrap_or(u32::MAX);
        let before = self.line(line).char_indices().skip(1).take_while(|&(at, _)| start + at <= offset).count();
        let past_end = usize::from(offset >= start + self.line(line).len() && !self.line(line).is_empty());
        (line, u32::try_from(before + past_end + 1).unwrap_or(u32::MAX))
    }

    /// The byte offset of a line and column, both from 1; the column may be the one after the line's last character.
    pub fn offset(&self, line: u32, column: u32) -> Option<usize> {
        let start = *self.line_starts.get((line as usize).checked_sub(1)?)?;
        let text = self.line(line);
        let ends = std::iter::once(text.len());
        text.char_indices().map(|(at, _)| at).chain(ends).nth((column as usize).checked_sub(1)?).map(|at| start + at)
    }
}
