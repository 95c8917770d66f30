//! The materials of a request, each in its medium.

use crate::generator::reference::MaterialInMedium;
use crate::physics::foreign::one_line;
use crate::physics::materials::Unseen;

use crate::generator::error::Error;
use crate::generator::fault::RequestFault;

/// The materials of a request.
#[derive(Clone, Debug, Default)]
pub struct Subjects {
    /// Each in its medium, with the text of both files; sorted by name, each once.
    pub ready: Vec<(MaterialInMedium, String)>,
    /// Why some of those that `all` brings along are left out.
    pub left_out: Vec<Unseen>,
}

impl Subjects {
    /// The materials alone.
    pub fn materials(self) -> Vec<MaterialInMedium> {
        self.ready
            .into_iter()
            .map(|(material, _)| material)
            .collect()
    }

    /// A line for each material that is left out.
    pub fn left_out_lines(&self) -> Vec<String> {
        let each = self.left_out.iter();
        each.map(|unseen| format!("left out: {}", one_line(&unseen.why)))
            .collect()
    }

    pub(super) fn sorted(mut self) -> Result<Subjects, Error> {
        self.ready.sort_by(|(a, _), (b, _)| a.name.cmp(&b.name));
        let twice = |pair: &&[(MaterialInMedium, String)]| {
            pair[0].0.name == pair[1].0.name && pair[0].1 != pair[1].1
        };
        if let Some(pair) = self.ready.windows(2).find(twice) {
            let [one, other] = [0, 1].map(|i| pair[i].0.argument.as_str());
            return Err(same_name(&pair[0].0.name, [one, other]));
        }
        self.ready.dedup_by(|(a, _), (b, _)| a.name == b.name);
        match self.left_out.first() {
            Some(fault) if self.ready.is_empty() => Err(fault.clone().into()),
            _ => Ok(self),
        }
    }
}

/// Two materials of one name, and the words that name them.
pub fn same_name(name: &str, words: [&str; 2]) -> Error {
    RequestFault::SameName {
        name: name.to_owned(),
        words: words.map(str::to_owned),
    }
    .into()
}
