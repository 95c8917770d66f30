//! The text of records, for the tests that write them.

use csv::WriterBuilder;

/// A record: its head, then its rows.
pub fn text<const N: usize>(head: [&str; N], rows: &[[String; N]]) -> String {
    let mut writer = WriterBuilder::new().from_writer(Vec::new());
    writer.write_record(head).expect("memory takes it");
    for row in rows {
        writer.write_record(row).expect("memory takes it");
    }
    String::from_utf8(writer.into_inner().expect("memory takes it")).expect("UTF-8")
}
