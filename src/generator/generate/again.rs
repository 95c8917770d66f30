//! The command that makes a file again, and the form of its comments.

use crate::generator::command_line::CommandLine;
use crate::generator::emit::{HeaderForm, Naming};
use crate::generator::reference::MaterialInMedium;
use crate::language::targets::{Finish, Target};
use crate::physics::num::Precision;

use crate::generator::generate::Run;

impl Run<'_> {
    /// The form of the comments of a file, named without its ending. Modules have no comments.
    pub(super) fn form(&self, target: &Target, stem: &str) -> HeaderForm {
        let held = self.held.map(|held| &held.full_headers);
        let is_full = held.is_some_and(|full| full.contains(&format!("{}/{stem}", target.name)));
        match target.finish {
            Finish::Spirv => HeaderForm::Short,
            _ if is_full => HeaderForm::Full,
            _ => self.request.header,
        }
    }

    /// The command that makes a file again.
    pub(super) fn command(
        &self,
        target: &Target,
        methods: Option<&[&str]>,
        subject: Option<&MaterialInMedium>,
        form: HeaderForm,
    ) -> String {
        let request = self.request;
        let precision =
            Some(request.precision).filter(|precision| *precision != Precision::default());
        let medium = subject.and_then(|subject| subject.medium.as_ref());
        let seen = subject.map(|subject| {
            crate::generator::command_line::surface_flags(
                &request.viewing,
                &subject.reference.surface,
            )
        });
        CommandLine::new("fresnel-gen")
            .list("target", [target.name])
            .list("method", methods.into_iter().flatten())
            .list("material", subject.map(|subject| &subject.argument))
            .list("medium", medium.map(|(argument, _)| argument))
            .list("prefix", Naming::flag_of_prefix(&request.prefix))
            .list("precision", precision.map(Precision::name))
            .switch("force", request.force && request.precision.is_half())
            .with(&seen.unwrap_or_default())
            .list(
                "matching-angle",
                request.matching_angle.filter(|_| subject.is_some()),
            )
            .list("header", form.flag())
            .into()
    }
}
