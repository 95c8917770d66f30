//! What a scan found, as rows: for people, for scripts, and as the table of the documents.


use crate::pictures::stability_map::{percent, worst};
use crate::pictures::table;
use crate::lab::stability::{Finding, StabilityRow};


fn cells(row: &StabilityRow) -> Vec<String> {
    let about = match &row.material {
        None => String::new(),
        Some((name, channel)) => format!("{name}, {channel}"),
    };
    let mut cells = vec![row.method.to_owned(), about];
    match &row.finding {
        None => cells.extend([
            "none".to_owned(),
            String::new(),
            String::new(),
            String::new(),
        ]),
        Some(finding) => cells.extend([
            finding.failure.words(),
            region(finding),
            percent(finding.share),
            worst(finding),
        ]),
    }
    cells
}

/// The region; of arguments that no medium has, with that said.
fn region(finding: &Finding) -> String {
    if finding.is_media {
        finding.region.clone()
    } else {
        format!("arguments {}", finding.region)
    }
}

/// All rows for people.
pub fn stability_text(rows: &[StabilityRow]) -> String {
    let head = ["method", "material", "failure", "where", "of it", "worst"];
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let has_material = rows.iter().any(|row| row.material.is_some());
    let wanted = |(i, _): &(usize, String)| *i != 1 || has_material;
    let only = |cells: Vec<String>| -> Vec<String> {
        cells
            .into_iter()
            .enumerate()
            .filter(wanted)
            .map(|(_, cell)| cell)
            .collect()
    };
    let head = only(head.iter().map(|cell| (*cell).to_owned()).collect());
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    table::text_table(&head, &cells.into_iter().map(only).collect::<Vec<_>>())
}
