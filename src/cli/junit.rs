//! Reports in JUnit's XML, as build servers read them: a case for each function, target and material.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use crate::lab::audit::AuditRow;
use crate::lab::verify::{Status, VerifyRow};
use crate::physics::foreign::{Foreign, one_line};

/// A row as a JUnit case.
struct JunitCase<'a> {
    target: &'a str,
    device: Option<&'a str>,
    function: &'a str,
    material: Option<&'a str>,
    form: &'a str,
    method: &'a str,
    status: Status,
    reason: Option<&'a str>,
}

/// The placeholder for a name that is not known.
const NONE: &str = "none";

/// A verification as JUnit's XML; a suite for each target and device.
///
/// # Errors
/// The writer fails.
pub fn verify_junit(rows: &[VerifyRow]) -> Result<String, String> {
    let cases = rows.iter().map(|row| JunitCase {
        target: &row.target,
        device: row.device.as_deref(),
        function: &row.function,
        material: row.material.as_deref(),
        form: row.form.name(),
        method: &row.method,
        status: row.status,
        reason: row.reason.as_deref(),
    });
    junit("fresnel-gen verify", cases)
}

/// An audit as JUnit's XML; a suite for each target and device.
///
/// # Errors
/// The writer fails.
pub fn audit_junit(rows: &[AuditRow]) -> Result<String, String> {
    let cases = rows.iter().map(|row| JunitCase {
        target: row.target,
        device: row.device.as_deref(),
        function: &row.function,
        material: Some(&row.material),
        form: row.form,
        method: &row.method,
        status: row.status,
        reason: row.reason.as_deref(),
    });
    junit("fresnel-gen audit", cases)
}

fn junit<'a>(name: &str, cases: impl Iterator<Item = JunitCase<'a>>) -> Result<String, String> {
    let mut report = Report::new(name);
    let mut suites: Vec<(String, TestSuite)> = Vec::new();
    for case in cases {
        let name = format!("{} on {}", case.target, case.device.unwrap_or(NONE));
        let place = suites.iter().position(|(other, _)| *other == name);
        let place = place.unwrap_or_else(|| {
            suites.push((name.clone(), TestSuite::new(name.clone())));
            suites.len() - 1
        });
        suites[place].1.add_test_case(test_case(&case));
    }
    report.add_test_suites(suites.into_iter().map(|(_, suite)| suite));
    let text = report.to_string().map_err(|why| why.to_string())?;
    // The writer passes these two characters, which XML forbids.
    Ok(text.replace(['\u{fffe}', '\u{ffff}'], "\u{fffd}"))
}

fn test_case(case: &JunitCase) -> TestCase {
    let [function, material] = [case.function, case.material.unwrap_or(NONE)].map(Foreign);
    let name = format!("{function} ({material}, {})", case.form);
    let mut status = match case.status {
        Status::Pass => TestCaseStatus::success(),
        Status::NotChecked => TestCaseStatus::skipped(),
        Status::Fail => TestCaseStatus::non_success(NonSuccessKind::Failure),
    };
    if let Some(reason) = case.reason {
        let lines: Vec<String> = reason.lines().map(one_line).collect();
        status.set_message(lines.join("\n"));
    }
    let mut test = TestCase::new(name, status);
    test.set_classname(format!("{}.{}", case.target, Foreign(case.method)));
    test
}
