//! Citations: where a formula or a number comes from.

/// A published source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Citation {
    /// Surnames, as printed.
    pub authors: &'static str,
    /// Title of the work.
    pub title: &'static str,
    /// Journal, conference, book or publisher, with volume and pages.
    pub place: &'static str,
    /// Year of publication.
    pub year: u16,
    /// A link that a reader can open.
    pub link: &'static str,
}

impl Citation {
    /// One line: authors, title, place, year, link.
    pub fn line(&self) -> String {
        format!(
            "{}, \"{}\", {}, {}. {}",
            self.authors, self.title, self.place, self.year, self.link
        )
    }

    /// The same in short: authors, year, link.
    pub fn short(&self) -> String {
        format!("{}, {}, {}", self.authors, self.year, self.link)
    }
}
