//! Tables as plain text: columns padded, numbers aligned right.

use crate::physics::foreign::one_line;

/// A table with a head and a rule under it. No cell breaks its line.
pub fn text_table(head: &[&str], rows: &[Vec<String>]) -> String {
    let mut lines: Vec<Vec<String>> = vec![head.iter().map(|cell| (*cell).to_owned()).collect()];
    for row in rows {
        lines.push(row.iter().map(|cell| one_line(cell)).collect());
    }
    let width = |column: usize| {
        let cells = lines.iter().filter_map(|line| line.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    lines.insert(1, widths.iter().map(|width| "-".repeat(*width)).collect());
    lines.iter().map(|cells| line(cells, &widths)).collect()
}

fn line(cells: &[String], widths: &[usize]) -> String {
    let cells = cells.iter().zip(widths);
    let padded: Vec<String> = cells.map(|(cell, width)| padded(cell, *width)).collect();
    padded.join("  ").trim_end().to_owned() + "\n"
}

fn padded(cell: &str, width: usize) -> String {
    let space = " ".repeat(width.saturating_sub(cell.chars().count()));
    let number = cell.trim_end_matches(['%', '°', '+']).trim();
    let is_number =
        cell.starts_with(|c: char| c.is_ascii_digit() || c == '-') && number.parse::<f64>().is_ok();
    if is_number {
        space + cell
    } else {
        cell.to_owned() + &space
    }
}

/// A number with three significant digits.
pub fn short_number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let digits = (2.0 - libm::floor(libm::log10(value.abs()))).clamp(0.0, 9.0) as usize;
    let long = format!("{value:.digits$}");
    if !long.contains('.') {
        return long;
    }
    let short = long.trim_end_matches('0').trim_end_matches('.');
    short.to_owned()
}

#[cfg(test)]
mod tests {
    use super::short_number;

    #[test]
    fn numbers_keep_three_digits() {
        for (value, wanted) in [
            (0.0019234, "0.00192"),
            (21.0, "21"),
            (146.25, "146"),
            (0.5, "0.5"),
            (62.345, "62.3"),
            (1e-6, "0.000001"),
            (120.0, "120"),
        ] {
            assert_eq!(short_number(value), wanted);
        }
    }
}
