//! Old names of methods on the command line, handled in one place for all commands.

use std::ffi::OsString;

use crate::language::methods::{Renamed, renamed};

/// The words of a command line with today's names of methods, and a remark for each old name.
pub fn with_names_of_today(
    words: impl Iterator<Item = OsString>,
    all: &[Renamed],
) -> (Vec<OsString>, Vec<String>) {
    let (mut today, mut remarks) = (Vec::new(), Vec::new());
    let mut names_follow = false;
    for word in words {
        let text = word.to_str().unwrap_or_default();
        let (head, names) = match text.strip_prefix("--method=") {
            Some(names) => ("--method=", names),
            None => ("", text),
        };
        let has_names = names_follow || !head.is_empty();
        names_follow = text == "--method" || text == "show";
        let is_old = |name: &str| renamed(name, all).is_some();
        if !has_names || !names.split(',').any(is_old) {
            today.push(word);
            continue;
        }
        let found = names.split(',').map(|name| (name, renamed(name, all)));
        let (names, old): (Vec<&str>, Vec<Option<Renamed>>) = found
            .map(|(name, old)| (old.map_or(name, |old| old.new), old))
            .unzip();
        remarks.extend(old.iter().flatten().map(Renamed::remark));
        today.push(format!("{head}{}", names.join(",")).into());
    }
    (today, remarks)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Renamed; 1] = [Renamed {
        old: "schlik",
        new: "schlick",
        in_version: (0, 2),
    }];

    #[track_caller]
    fn check(line: &str, expected: &str, remarks: usize) {
        let words = line.split(' ').map(OsString::from);
        let (today, said) = with_names_of_today(words, &ALL);
        let today: Vec<&str> = today.iter().filter_map(|word| word.to_str()).collect();
        assert_eq!((today.join(" ").as_str(), said.len()), (expected, remarks));
    }

    #[test]
    fn old_names_become_those_of_today() {
        check(
            "verify --method fitted,schlik",
            "verify --method fitted,schlick",
            1,
        );
        check("--method=schlik -o -", "--method=schlick -o -", 1);
        check("methods show schlik", "methods show schlick", 1);
    }

    #[test]
    fn all_else_stays() {
        check(
            "--material schlik --method schlick",
            "--material schlik --method schlick",
            0,
        );
    }
}
