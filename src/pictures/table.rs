//! Tables as plain text: columns padded, numbers aligned right.

use crate::physics::foreign::one_line;

/// A table with a head and a rule under it. No cell breaks its line.
pub fn text_table(head: &[&str], rows: &[Vec<String>]) -> String {
    let shown = |row: &Vec<String>| row.iter().map(|cell| one_line(cell)).collect();
    let rows: Vec<Vec<String>> = rows.iter().map(shown).collect();
    let head: Vec<String> = head.iter().map(|cell| (*cell).to_owned()).collect();
    let widths: Vec<usize> = (0..head.len())
        .map(|column| {
            let cells = rows
                .iter()
                .filter_map(|row| row.get(column))
                .chain([&head[column]]);
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        })
        .collect();
    let rule: Vec<String> = widths.iter().map(|width| "-".repeat(*width)).collect();
    let lines = [&head, &rule]
        .into_iter()
        .chain(&rows)
        .map(|row| line(row, &widths));
    lines.collect::<Vec<_>>().concat()
}

fn line(cells: &[String], widths: &[usize]) -> String {
    let padded: Vec<String> = cells
        .iter()
        .zip(widths)
        .map(|(cell, width)| padded(cell, *width))
        .collect();
    padded.join("  ").trim_end().to_owned() + "\n"
}

fn padded(cell: &str, width: usize) -> String {
    let space = " ".repeat(width.saturating_sub(cell.chars().count()));
    let is_number = cell.starts_with(|c: char| c.is_ascii_digit() || c == '-')
        && cell
            .trim_end_matches(['%', '°', '+'])
            .trim()
            .parse::<f64>()
            .is_ok();
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
    let is_fraction = long.contains('.');
    let short = if is_fraction {
        long.trim_end_matches('0').trim_end_matches('.')
    } else {
        &long
    };
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
