//! A bake as a user types it: its flags, each with a space before it.

use crate::emit::{Naming, quoted, sight_flags};
use crate::materials::Sight;
use crate::targets::Target;

use super::{Lit, Request, Shape};

/// The materials by name.
pub fn typed(subjects: &[Lit]) -> String {
    let names: Vec<String> = subjects.iter().map(|one| quoted(&one.argument)).collect();
    names.join(",")
}

/// Medium and sight.
pub fn said(subjects: &[Lit], sight: &Sight) -> String {
    let medium = subjects.first().and_then(|subject| subject.medium.as_ref());
    let medium = medium.map_or(String::new(), |name| format!(" --medium {}", quoted(name)));
    medium + &sight_flags(sight)
}

/// All flags of a run in one order, without the output's place.
pub fn canonical(request: &Request) -> String {
    let formats: Vec<&str> = request.formats.iter().map(|format| format.name()).collect();
    let shape = match &request.shape {
        Shape::Fixed { axis, texels } => format!(" --size {texels} --axis {}", axis.name()),
        Shape::Within { budget, axes } if axes.len() == 1 => {
            format!(" --budget {budget:?} --axis {}", axes[0].name())
        }
        Shape::Within { budget, .. } => format!(" --budget {budget:?}"),
    };
    let atlas = if request.atlas { " --atlas" } else { "" };
    format!(
        " --material {}{}{shape} --format {}{atlas}{}",
        request.typed,
        request.flags,
        formats.join(","),
        shaders(&request.targets, &request.prefix)
    )
}

/// What asks for functions beside tables.
pub fn shaders(targets: &[&'static Target], prefix: &str) -> String {
    if targets.is_empty() {
        return String::new();
    }
    let names: Vec<&str> = targets.iter().map(|target| target.name).collect();
    let prefix = if prefix == Naming::default().prefix {
        String::new()
    } else {
        format!(" --prefix {}", quoted(prefix))
    };
    format!(" --target {}{prefix}", names.join(","))
}
