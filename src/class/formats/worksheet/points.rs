//! Points as a worksheet writes them: with a decimal point or comma, and with so many decimals.

/// How the numbers of a worksheet are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Style {
    pub comma: bool,
    pub decimals: usize,
}

/// Moodle keeps five decimals of a grade.
const MOST_DECIMALS: usize = 5;
/// Decimals of a grade that is not whole where the worksheet shows fewer.
const LEAST_DECIMALS: usize = 2;

impl Style {
    /// The style of a cell such as `100.00` or `20,0`.
    pub fn of(cell: &str) -> Self {
        let mark = cell.trim().rfind(['.', ',']);
        Self { comma: cell.contains(','), decimals: mark.map_or(0, |mark| cell.trim().len() - mark - 1) }
    }

    /// `value` in this style; with more decimals than the others have where it would lose something.
    pub fn write(self, value: f64) -> String {
        let decimals = self.decimals.min(MOST_DECIMALS);
        let loses = |decimals: usize| {
            let scale = 10f64.powi(decimals as i32);
            ((value * scale).round() / scale - value).abs() > 1e-9
        };
        let decimals = (decimals..=LEAST_DECIMALS.max(decimals)).find(|n| !loses(*n));
        let text = format!("{value:.*}", decimals.unwrap_or(LEAST_DECIMALS.max(self.decimals.min(MOST_DECIMALS))));
        if self.comma { text.replace('.', ",") } else { text }
    }
}

/// The number in a cell; `None` where there is none, such as an empty cell or `-`.
pub(super) fn read(cell: &str) -> Option<f64> {
    cell.trim().replace(',', ".").parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grade_is_written_as_its_maximum_is() {
        assert_eq!(Style::of("100.00").write(80.0), "80.00");
        assert_eq!(Style::of("100,00").write(62.5), "62,50");
        assert_eq!(Style::of("20").write(16.0), "16");
        // 8.5 of 10 is not 9, and a third of 100 has no end.
        assert_eq!(Style::of("10").write(8.5), "8.5");
        assert_eq!(Style::of("10,0").write(8.25), "8,25");
        assert_eq!(Style::of("100").write(100.0 / 3.0), "33.33");
        assert_eq!(Style::of("100.000").write(100.0 / 3.0), "33.333");
    }

    #[test]
    fn what_is_no_number_is_none() {
        assert_eq!(
            [read("80,50"), read(" 80.5 "), read(""), read("-"), read("NaN")],
            [Some(80.5), Some(80.5), None, None, None]
        );
    }
}
