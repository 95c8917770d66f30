//! The machine that verifies: its environment, a clock, and its devices and compilers with their versions. Rows from machines whose
//! drivers or versions differ are not one run.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::compilers;
use super::run::{Devices, ExecutionPath};
use crate::generator::fit::Measured;
use crate::language::targets::{Compiler, DXC, Stack, Target};
use crate::physics::num::Precision;

/// Whether this runs in GitHub Actions, which reads annotations.
pub fn is_github() -> bool {
    std::env::var_os("GITHUB_ACTIONS").is_some_and(|value| value == "true")
}

/// The value of an environment variable, where it is set.
pub fn variable(name: &str) -> Option<String> {
    std::env::var_os(name).map(|value| value.to_string_lossy().into_owned())
}

/// The result of some work, and how long it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed())
}

/// How many workers run at once on this machine.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// What a machine has and what it lacks, by target, and by target and compiler.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MachineStatement {
    /// The device with its driver, or the version of the compiler.
    pub has: BTreeMap<String, String>,
    /// Why it is not here.
    pub lacks: BTreeMap<String, String>,
}

impl MachineStatement {
    /// The devices here that run a target's text by these paths.
    pub fn of_devices(target: &Target, paths: &[ExecutionPath], devices: &Devices) -> Self {
        let mut stated = MachineStatement::default();
        let is_run = !matches!(target.stack, Stack::None);
        for path in paths.iter().filter(|_| is_run) {
            let device = devices.device_for(target, *path);
            let stands = match device {
                Ok(device) => Measured::Yes(device.adapter.to_string()),
                Err(why) => Measured::No(why.to_string()),
            };
            stated.enter(path_name(target, *path), stands);
        }
        stated
    }

    /// All that is here for a target's files: devices and compilers.
    pub fn of_target(target: &Target, precision: Precision, devices: &Devices) -> Self {
        let paths = ExecutionPath::all_for(target, precision);
        let mut stated = MachineStatement::of_devices(target, paths, devices);
        for validator in target.validators_in(precision) {
            let name = format!("{} by {}", target.name, validator.name);
            stated.enter(name, compiler_here(validator.compiler));
        }
        if paths.contains(&ExecutionPath::NagaHlsl) {
            let name = path_name(target, ExecutionPath::NagaHlsl) + " through DXC";
            stated.enter(name, compiler_here(&DXC));
        }
        stated
    }

    fn enter(&mut self, name: String, stands: Measured<String>) {
        match stands {
            Measured::Yes(what) => self.has.insert(name, what),
            Measured::No(why) => self.lacks.insert(name, why),
        };
    }

    /// Adds what another statement of the same machine says.
    pub fn add(&mut self, other: MachineStatement) {
        self.has.extend(other.has);
        self.lacks.extend(other.lacks);
    }

    /// Whether a target lacks anything.
    pub fn lacks_for(&self, target: &str) -> bool {
        let is_its = |name: &String| name.split(' ').next() == Some(target);
        self.lacks.keys().any(is_its)
    }

    /// The first thing that both state and that differs between the machines: its name, and what each says of it.
    pub fn difference(&self, other: &MachineStatement) -> Option<(&str, String, String)> {
        let names = self.has.keys().chain(self.lacks.keys());
        names
            .filter_map(|name| Some((name.as_str(), self.words(name)?, other.words(name)?)))
            .find(|(_, here, there)| here != there)
    }

    fn words(&self, name: &str) -> Option<String> {
        let lacks = || self.lacks.get(name).map(|why| format!("nothing ({why})"));
        self.has.get(name).cloned().or_else(lacks)
    }
}

/// The version of a compiler. One that is here and states no version is not missing.
fn compiler_here(compiler: &Compiler) -> Measured<String> {
    match compilers::version(compiler) {
        Measured::No(why) if compilers::is_here(compiler) => Measured::Yes(why),
        version => version,
    }
}

fn path_name(target: &Target, path: ExecutionPath) -> String {
    match path {
        ExecutionPath::Own => target.name.to_owned(),
        path => format!("{} by {}", target.name, path.name()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stated(has: &[(&str, &str)], lacks: &[(&str, &str)]) -> MachineStatement {
        let map = |pairs: &[(&str, &str)]| {
            let owned = |(name, what): &(&str, &str)| ((*name).to_owned(), (*what).to_owned());
            pairs.iter().map(owned).collect()
        };
        MachineStatement {
            has: map(has),
            lacks: map(lacks),
        }
    }

    #[test]
    fn what_only_one_speaks_of_is_no_difference() {
        let one = stated(&[("wgsl", "a card"), ("gles", "a card")], &[]);
        let other = stated(&[("wgsl", "a card")], &[("hlsl by DXC", "no DXC here")]);
        assert_eq!(one.difference(&other), None);
        assert_eq!(other.difference(&one), None);
    }

    #[test]
    fn another_device_is_a_difference_and_so_is_none() {
        let one = stated(&[("wgsl", "a card")], &[]);
        let words = |other: &MachineStatement| {
            let (name, here, there) = one.difference(other).unwrap();
            format!("{name}: {here}, {there}")
        };
        let another = stated(&[("wgsl", "another")], &[]);
        assert_eq!(words(&another), "wgsl: a card, another");
        let none = stated(&[], &[("wgsl", "no driver")]);
        assert_eq!(words(&none), "wgsl: a card, nothing (no driver)");
    }

    #[test]
    fn a_target_lacks_what_its_name_begins() {
        let lacks = stated(&[], &[("hlsl by DXC", "no DXC here")]);
        assert!(lacks.lacks_for("hlsl"));
        assert!(!lacks.lacks_for("hls") && !lacks.lacks_for("wgsl"));
    }
}
