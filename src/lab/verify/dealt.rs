//! Which shard a run is: by `--shard`, or by what a scheduler says to each task. How many shards there are only the command line
//! says: in an array that is run again in part, a scheduler counts the tasks of that part.

use crate::lab::verify::shard::Shard;

use crate::generator::fault::RequestFault;

/// A variable of the environment, and what it says where it is set.
pub type Variable = (&'static str, Option<String>);

/// The variables in which schedulers number tasks from 0: Slurm's arrays, and Indexed Jobs of Kubernetes.
pub const VARIABLES: [&str; 2] = ["SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"];

/// The shard that a run is; none where it is whole. Variables count where `--shards` stands without `--shard`, and nowhere else.
///
/// # Errors
/// There is no such shard, or nothing says which one it is, or two variables contradict each other.
pub fn shard_of(
    shards: Option<usize>,
    shard: Option<usize>,
    variables: &[Variable],
) -> Result<Option<Shard>, RequestFault> {
    let Some(count) = shards else {
        return Ok(None);
    };
    if count == 0 {
        return Err(RequestFault::OutOfRange {
            flag: "shards",
            value: "0".to_owned(),
            allowed: "is 1 or more".to_owned(),
        });
    }
    let (said_by, index) = match shard {
        Some(index) => ("--shard", index),
        None => said(count, variables)?,
    };
    let found = Shard::new(index, count);
    found.map(Some).ok_or_else(|| {
        RequestFault::conflict(format!(
            "{said_by} is {index}; shards are counted from 0, so that with --shards {count} it is 0 to {}",
            count - 1
        ))
    })
}

/// The number of the task by the variables that are set.
fn said(count: usize, variables: &[Variable]) -> Result<(&'static str, usize), RequestFault> {
    let mut said: Vec<(&'static str, usize)> = Vec::new();
    for (name, value) in variables {
        if let Some(value) = value {
            said.push((name, number(name, value)?));
        }
    }
    let Some(first) = said.first() else {
        return Err(RequestFault::conflict(format!(
            "--shards {count} does not say which shard this is. Add --shard I, where I is 0 to {}, or run it in a Slurm array or in an \
             Indexed Job of Kubernetes: those set {}",
            count - 1,
            VARIABLES.join(" and ")
        )));
    };
    match said.iter().find(|other| other.1 != first.1) {
        None => Ok(*first),
        Some(other) => Err(RequestFault::conflict(format!(
            "{} is {} and {} is {}, so that this could be either shard; say which with --shard I",
            first.0, first.1, other.0, other.1
        ))),
    }
}

fn number(name: &str, value: &str) -> Result<usize, RequestFault> {
    let digits = !value.is_empty() && value.bytes().all(|byte| byte.is_ascii_digit());
    let number = digits.then(|| value.parse().ok()).flatten();
    number.ok_or_else(|| {
        RequestFault::conflict(format!(
            "{name} is `{value}`, which is not the number of a shard; unset it, or say which shard this is with --shard I"
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLURM: &str = VARIABLES[0];
    const KUBERNETES: &str = VARIABLES[1];

    fn variables(slurm: Option<&str>, kubernetes: Option<&str>) -> [Variable; 2] {
        [
            (SLURM, slurm.map(str::to_owned)),
            (KUBERNETES, kubernetes.map(str::to_owned)),
        ]
    }

    #[track_caller]
    fn check(shards: usize, shard: Option<usize>, set: [Variable; 2], expected: usize) {
        let found = shard_of(Some(shards), shard, &set).unwrap().unwrap();
        assert_eq!((found.index(), found.count()), (expected, shards));
    }

    #[track_caller]
    fn refused(shards: usize, shard: Option<usize>, set: [Variable; 2], says: &[&str]) {
        let why = shard_of(Some(shards), shard, &set).unwrap_err().to_string();
        for text in says {
            assert!(why.contains(text), "{text} is not in {why}");
        }
    }

    #[test]
    fn the_flag_is_believed_before_any_variable() {
        check(4, Some(2), variables(None, None), 2);
        check(4, Some(2), variables(Some("3"), Some("nonsense")), 2);
        check(4, None, variables(Some("3"), None), 3);
        check(4, None, variables(None, Some("0")), 0);
        check(4, None, variables(Some("1"), Some("01")), 1);
    }

    #[test]
    fn without_shards_no_variable_counts() {
        let set = variables(Some("x"), Some("9"));
        assert_eq!(shard_of(None, None, &set).unwrap(), None);
    }

    #[test]
    fn what_names_no_shard_is_refused() {
        let none = || variables(None, None);
        refused(4, None, none(), &["--shard I", "0 to 3", SLURM, KUBERNETES]);
        refused(0, Some(0), none(), &["--shards is 0", "1 or more"]);
        refused(4, Some(4), none(), &["--shard is 4", "0 to 3"]);
        refused(4, None, variables(Some("4"), None), &[SLURM, "0 to 3"]);
        for value in ["", "-1", "+1", " 1", "1.0", "one", "99999999999999999999"] {
            refused(4, None, variables(None, Some(value)), &[KUBERNETES, value]);
        }
        let both = variables(Some("1"), Some("2"));
        refused(4, None, both, &[SLURM, KUBERNETES, "--shard I"]);
    }
}
