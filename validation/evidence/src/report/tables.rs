//! Tables that both documents show.

use super::book::Book;
use super::words;
use crate::numbers::number;
use crate::{Finding, Table};

/// The criteria as a table.
pub(super) fn checked(finding: &Finding) -> Table {
    let mut table = Table::new("Verdict", &["criterion", "measured", "must be", "verdict"]);
    for criterion in &finding.criteria {
        table.row([
            criterion.what.clone(),
            number(criterion.measured),
            words::limit(criterion.limit),
            words::verdict(criterion).to_owned(),
        ]);
    }
    table
}

/// All times as a table, if there are any.
pub(super) fn timed(book: &Book<'_>) -> Option<Table> {
    let mut table = Table::new("", &["computation", "seconds", "for comparison"]);
    for timing in book.chapters.iter().flat_map(|(_, finding)| &finding.timings) {
        let seconds = number(timing.seconds);
        table.row([timing.what.clone(), seconds, timing.beside.clone()]);
    }
    (!table.rows.is_empty()).then_some(table)
}
