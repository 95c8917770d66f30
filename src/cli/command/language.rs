//! Which language `-o FILE` is written in: that of `--target`, or else that of the file's ending.

use std::collections::BTreeSet;
use std::path::Path;

use crate::cli::args::Choice;
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::language::targets::{self, Target};

/// The targets as a request names them: those of `--target`, or the one of the file's ending. None where neither says one.
///
/// # Errors
/// No language's files end so, or those of another language than `--target` do.
pub fn target_words(
    named: &[Choice<&'static Target>],
    file: Option<&Path>,
) -> Result<Vec<String>, Error> {
    let words: Vec<String> = named.iter().map(ToString::to_string).collect();
    let Some(file) = file.filter(|file| *file != Path::new("-")) else {
        return Ok(words);
    };
    let ending = file.extension().and_then(|ending| ending.to_str());
    let ending = ending.map(str::to_lowercase);
    let of_ending = of_ending(ending.as_deref().unwrap_or_default());
    // Of two languages with one ending the usual one.
    let usual = of_ending.iter().find(|target| target.by_default);
    match (usual.or(of_ending.first()), words.as_slice()) {
        (Some(first), []) => Ok(vec![first.name.to_owned()]),
        (None, []) if ending.is_some() => Err(no_language(file).into()),
        (Some(first), [one]) if one != "all" && of_ending.iter().all(|it| it.name != one) => {
            let (file, language) = (crate::physics::foreign::path(&file), first.name);
            let why = format!("`{file}` ends as a file of {language}, and --target is {one}");
            Err(RequestFault::conflict(why).into())
        }
        _ => Ok(words),
    }
}

/// The targets whose files end so.
fn of_ending(ending: &str) -> Vec<&'static Target> {
    let all = targets::ALL.iter().copied();
    all.filter(|target| target.endings().any(|one| one == ending))
        .collect()
}

fn no_language(file: &Path) -> RequestFault {
    let endings: BTreeSet<&str> = targets::ALL.iter().flat_map(|it| it.endings()).collect();
    let endings: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
    RequestFault::conflict(format!(
        "`{}` says no language by its ending; name one with --target, or end the file in {}",
        crate::physics::foreign::path(&file),
        endings.join(", ")
    ))
}
