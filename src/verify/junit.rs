//! JUnit: a case for each function, target and material, as build servers read them.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use serde_json::Value;

/// The rows as JUnit's XML under a name; a suite for each target and device.
///
/// # Errors
/// The writer refuses.
pub fn junit(name: &str, rows: &[Value]) -> Result<String, String> {
    let mut report = Report::new(name);
    let mut suites: Vec<(String, TestSuite)> = Vec::new();
    for row in rows {
        let name = format!("{} on {}", word(row, "target"), word(row, "device"));
        let place = suites.iter().position(|(other, _)| *other == name);
        let place = place.unwrap_or_else(|| {
            suites.push((name.clone(), TestSuite::new(name.clone())));
            suites.len() - 1
        });
        suites[place].1.add_test_case(case(row));
    }
    report.add_test_suites(suites.into_iter().map(|(_, suite)| suite));
    report.to_string().map_err(|why| why.to_string())
}

fn word<'a>(row: &'a Value, key: &str) -> &'a str {
    row[key].as_str().unwrap_or("none")
}

fn case(row: &Value) -> TestCase {
    let name = format!(
        "{} ({}, {})",
        word(row, "function"),
        word(row, "material"),
        word(row, "form")
    );
    let mut status = match word(row, "status") {
        "pass" => TestCaseStatus::success(),
        "not_checked" => TestCaseStatus::skipped(),
        _ => TestCaseStatus::non_success(NonSuccessKind::Failure),
    };
    if let Some(reason) = row["reason"].as_str() {
        status.set_message(reason);
    }
    let mut case = TestCase::new(name, status);
    case.set_classname(format!("{}.{}", word(row, "target"), word(row, "method")));
    case
}
