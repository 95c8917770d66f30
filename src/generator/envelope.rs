//! The common form of JSON reports: the program that wrote it, the command that writes it again, the device, the rows.
//!
//! A report with keys of its own flattens [`Origin`] and lists its keys after that: the order of fields is the order of keys.

use serde::Serialize;

/// The version of the format of JSON reports. It rises when a key changes its meaning or is removed.
pub const SCHEMA: u32 = 1;

/// The name of the program, as reports give it.
pub const TOOL: &str = "fresnel-gen";

/// The text of a JSON file, with a line break at its end.
///
/// # Panics
/// A key is no text. No report has such a key.
pub fn json_text(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).expect("a report has only text keys") + "\n"
}

/// The origin of a report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Origin {
    tool: &'static str,
    schema: u32,
    command: String,
}

impl Origin {
    /// The origin of what this command writes.
    pub fn new(command: impl Into<String>) -> Origin {
        Origin {
            tool: TOOL,
            schema: SCHEMA,
            command: command.into(),
        }
    }

    /// The same, for a format with its own version.
    pub fn with_schema(self, schema: u32) -> Origin {
        Origin { schema, ..self }
    }

    /// The command.
    pub fn command(&self) -> &str {
        &self.command
    }
}

/// A report with rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report<T> {
    #[serde(flatten)]
    origin: Origin,
    device: Option<String>,
    rows: Vec<T>,
}

impl<T> Report<T> {
    /// A report that this command writes, without a device.
    pub fn new(command: impl Into<String>, rows: Vec<T>) -> Report<T> {
        Report {
            origin: Origin::new(command),
            device: None,
            rows,
        }
    }

    /// The same report, measured on this device.
    pub fn with_device(self, device: Option<String>) -> Report<T> {
        Report { device, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_stand_in_the_order_that_users_read() {
        let report = Report::new("chart", vec![1]).with_device(Some("a card".to_owned()));
        let text = serde_json::to_string(&report).unwrap();
        assert_eq!(
            text,
            r#"{"tool":"fresnel-gen","schema":1,"command":"chart","device":"a card","rows":[1]}"#
        );
    }
}
