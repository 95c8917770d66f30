//! Our own records: the CSV files of `data/`, read as typed rows. Lines that begin with `#` are comments.

use serde::de::DeserializeOwned;

/// The rows of a record that is embedded in the program.
///
/// # Panics
/// A row does not fit its type. Tests read every record.
pub fn rows<Row: DeserializeOwned>(record: &str) -> Vec<Row> {
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.comment(Some(b'#')).from_reader(record.as_bytes());
    let rows = reader.into_deserialize().collect::<Result<_, _>>();
    rows.expect("tests read every record")
}

#[cfg(test)]
mod tests {
    #[test]
    fn rows_follow_a_head_and_remarks() {
        let record = "# By a test.\nname,device,share\na,\"X, 256 bits\",\nb,Y,0.5\n";
        type Row = (String, String, Option<f64>);
        let rows: Vec<Row> = super::rows(record);
        assert_eq!(rows[0], ("a".to_owned(), "X, 256 bits".to_owned(), None));
        assert_eq!(rows[1], ("b".to_owned(), "Y".to_owned(), Some(0.5)));
    }
}
