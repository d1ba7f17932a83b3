//! Numbers as comma-separated values.

/// A table with a name for each column.
pub(super) struct Table {
    lines: Vec<String>,
}

impl Table {
    pub(super) fn new(columns: &[&str]) -> Self {
        Self { lines: vec![columns.join(",")] }
    }

    /// Adds a row; it has a cell for each column.
    pub(super) fn push<const N: usize>(&mut self, cells: [Cell; N]) {
        self.lines.push(cells.map(|Cell(text)| text).join(","));
    }

    pub(super) fn to_csv(&self) -> String {
        self.lines.join("\n") + "\n"
    }
}

/// A number or a name.
pub(super) struct Cell(String);

impl From<&str> for Cell {
    /// A name without commas and quotes.
    fn from(name: &str) -> Self {
        Self(name.to_owned())
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self(count.to_string())
    }
}

impl From<u32> for Cell {
    fn from(count: u32) -> Self {
        Self(count.to_string())
    }
}

impl From<f64> for Cell {
    /// Six significant digits.
    fn from(number: f64) -> Self {
        let text = format!("{number:.5e}");
        Self(text.parse::<f64>().map_or(text, |rounded| rounded.to_string()))
    }
}

impl From<Option<f64>> for Cell {
    /// Empty where there is no number.
    fn from(number: Option<f64>) -> Self {
        number.map_or(Self(String::new()), Self::from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv() {
        let mut table = Table::new(&["name", "n", "x", "y"]);
        table.push(["closed".into(), 4_u32.into(), 0.123_456_789.into(), None.into()]);
        assert_eq!(table.to_csv(), "name,n,x,y\nclosed,4,0.123457,\n");
    }
}
