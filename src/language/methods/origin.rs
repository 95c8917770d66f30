//! Whose a method's form is, and how its source is cited.

use super::method::Method;

/// Whose a method's form is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The source's.
    Published,
    /// The source's but for what is said here.
    Adapted(&'static str),
    /// Ours. Says what the source is of.
    Ours(&'static str),
}

impl Method {
    /// Whether its form is ours, and not published elsewhere.
    pub fn is_ours(&self) -> bool {
        matches!(self.origin, Origin::Ours(_))
    }

    /// Where it comes from: the whole citation, and what of it is ours.
    pub fn source_in_full(&self) -> String {
        self.with_origin(&self.source.line())
    }

    /// The same with authors, year and link.
    pub fn source_in_short(&self) -> String {
        self.with_origin(&self.source.short())
    }

    fn with_origin(&self, citation: &str) -> String {
        match self.origin {
            Origin::Published => citation.to_owned(),
            Origin::Adapted(what) => format!("{what}; else {citation}"),
            Origin::Ours(of) => format!("the form is fresnel-gen's; {of}: {citation}"),
        }
    }
}
