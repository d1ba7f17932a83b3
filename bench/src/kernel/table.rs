//! Tables in Markdown.

use std::io::Write;

use super::Outcome;

/// The first row and the line below it.
pub(super) fn header(out: &mut dyn Write, corner: &str, columns: impl Iterator<Item = String>) -> Outcome {
    let columns: Vec<_> = columns.collect();
    row(out, corner, columns.iter().cloned())?;
    writeln!(out, "|{}", "---|".repeat(columns.len() + 1))?;
    Ok(())
}

/// One row.
pub(super) fn row(out: &mut dyn Write, name: &str, cells: impl Iterator<Item = String>) -> Outcome {
    write!(out, "| {name} |")?;
    for cell in cells {
        write!(out, " {cell} |")?;
    }
    writeln!(out)?;
    out.flush()?;
    Ok(())
}

/// Millions per second.
pub(super) fn mega(count: usize, seconds: f64) -> f64 {
    count as f64 * 1e-6 / seconds
}
