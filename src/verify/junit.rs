//! JUnit: a case for each function, target and material, as build servers read them.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::row::{Status, VerifyRow};

/// A row as a case of JUnit's.
#[derive(Clone, Copy, Debug)]
pub struct JunitCase<'a> {
    /// The target.
    pub target: &'a str,
    /// On what it ran.
    pub device: Option<&'a str>,
    /// The function.
    pub function: &'a str,
    /// The material.
    pub material: Option<&'a str>,
    /// `library`, `specialised` or `user`.
    pub form: &'a str,
    /// The method.
    pub method: &'a str,
    /// What to think of it.
    pub status: Status,
    /// Why it is not a pass.
    pub reason: Option<&'a str>,
}

impl VerifyRow {
    /// The row as JUnit has it.
    pub fn junit_case(&self) -> JunitCase<'_> {
        JunitCase {
            target: &self.target,
            device: self.device.as_deref(),
            function: &self.function,
            material: self.material.as_deref(),
            form: &self.form,
            method: &self.method,
            status: self.status,
            reason: self.reason.as_deref(),
        }
    }
}

/// What stands where nothing is known.
const NONE: &str = "none";

/// The cases as JUnit's XML under a name; a suite for each target and device.
///
/// # Errors
/// The writer refuses.
pub fn junit<'a>(name: &str, cases: impl Iterator<Item = JunitCase<'a>>) -> Result<String, String> {
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
    report.to_string().map_err(|why| why.to_string())
}

fn test_case(case: &JunitCase) -> TestCase {
    let material = case.material.unwrap_or(NONE);
    let name = format!("{} ({material}, {})", case.function, case.form);
    let mut status = match case.status {
        Status::Pass => TestCaseStatus::success(),
        Status::NotChecked => TestCaseStatus::skipped(),
        Status::Fail => TestCaseStatus::non_success(NonSuccessKind::Failure),
    };
    if let Some(reason) = case.reason {
        status.set_message(reason);
    }
    let mut test = TestCase::new(name, status);
    test.set_classname(format!("{}.{}", case.target, case.method));
    test
}
