//! How a file is headed: in the short form or in the full one, with the command that makes it again.

use crate::generator::reference::MaterialInMedium;
use crate::language::methods::Method;
use crate::language::targets::Target;
use crate::physics::num::Precision;

use super::function::Emitted;
use super::{header, short};

/// How much the comments of a file say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HeaderForm {
    /// What a function is, its largest error, its cost, its source, and warnings; the rest stands in the manifest
    #[default]
    Short,
    /// All that is known of a function
    Full,
}

impl HeaderForm {
    /// Both; the first is the default.
    pub const ALL: [HeaderForm; 2] = [HeaderForm::Short, HeaderForm::Full];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            HeaderForm::Short => "short",
            HeaderForm::Full => "full",
        }
    }

    /// What `--header` says in a command, where it must be said.
    pub fn flag(self) -> Option<&'static str> {
        match self {
            HeaderForm::Short => None,
            HeaderForm::Full => Some("full"),
        }
    }

    /// The form that a text was written in, as its own command says.
    pub fn in_text(text: &str) -> HeaderForm {
        let command = text
            .lines()
            .take(6)
            .find(|line| line.contains("Regenerate: "));
        if command.is_some_and(|line| line.contains(" --header full")) {
            HeaderForm::Full
        } else {
            HeaderForm::Short
        }
    }
}

/// The form of a file's comments, and the command that makes it again.
#[derive(Clone, Copy, Debug, Default)]
pub struct Heading<'a> {
    /// The form.
    pub form: HeaderForm,
    /// The command.
    pub command: &'a str,
}

impl Heading<'_> {
    /// The head of a library file.
    pub(super) fn library(
        &self,
        target: &Target,
        method: &Method,
        functions: &[Emitted],
    ) -> Vec<String> {
        match self.form {
            HeaderForm::Short => short::library(target, method, functions, self.command),
            HeaderForm::Full => header::library(target, method, functions, self.command),
        }
    }

    /// The head of a material's file.
    pub(super) fn material(
        &self,
        target: &Target,
        subject: &MaterialInMedium,
        precision: Precision,
    ) -> Vec<String> {
        match self.form {
            HeaderForm::Short => short::material(target, subject, precision, self.command),
            HeaderForm::Full => header::material(target, subject, precision, self.command),
        }
    }

    /// What stands above one specialised function in a material's file.
    pub(super) fn specialised(&self, emitted: &Emitted) -> Vec<String> {
        match self.form {
            HeaderForm::Short => short::specialised(emitted),
            HeaderForm::Full => header::specialised(emitted),
        }
    }

    /// The head of a function that is pasted.
    pub(super) fn pasted(
        &self,
        target: &Target,
        emitted: &Emitted,
        subject: Option<&MaterialInMedium>,
    ) -> Vec<String> {
        match self.form {
            HeaderForm::Short => short::pasted(target, emitted, subject, self.command),
            HeaderForm::Full => header::pasted(target, emitted, subject, self.command),
        }
    }
}
