//! Pages of rows that are too many for one.

/// Rows of a page.
const PAGE: usize = 50;

/// One page of rows among others.
pub(super) struct Pager {
    /// First and last row of the page, and how many there are.
    pub from: usize,
    pub to: usize,
    pub total: usize,
    /// The pages: number, address, whether it is this one.
    pub pages: Vec<(usize, String, bool)>,
}

impl Pager {
    /// The page that `wished` names, from 1; the nearest where there is none.
    pub fn new(total: usize, wished: &str, query: impl Fn(&str) -> String) -> Self {
        let count = total.div_ceil(PAGE).max(1);
        let page = wished.parse().unwrap_or(1).clamp(1, count);
        let pages = (1..=count).map(|number| (number, query(&number.to_string()), number == page)).collect();
        Self { from: (page - 1) * PAGE, to: (page * PAGE).min(total), total, pages }
    }

    /// The rows of this page.
    pub fn of<'a, T>(&self, rows: &'a [T]) -> &'a [T] {
        &rows[self.from..self.to]
    }

    pub fn is_one(&self) -> bool {
        self.pages.len() == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fifty_rows_are_a_page() {
        let rows: Vec<usize> = (0..120).collect();
        let pager = |wished: &str| Pager::new(rows.len(), wished, |page| format!("?page={page}"));
        assert_eq!((pager("").of(&rows).len(), pager("3").of(&rows).len()), (PAGE, 20));
        assert_eq!((pager("2").from, pager("9").from, pager("x").from), (50, 100, 0));
        assert_eq!(pager("2").pages[1], (2, "?page=2".to_owned(), true));
        assert!(Pager::new(PAGE, "", |_| String::new()).is_one() && Pager::new(0, "", |_| String::new()).is_one());
    }
}
