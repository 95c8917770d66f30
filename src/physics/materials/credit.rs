//! Who measured a material's numbers, where it stands, and their licence: as far as its file says so.

use super::Material;

/// What a material's file says of what its source does not.
pub(super) const NOT_GIVEN: &str = "not given";

impl Material {
    /// `Data: reference. link. Licence CC0-1.0`, without what is not given; none where nothing is.
    pub fn data_line(&self) -> Option<String> {
        let source = self.source_words(". ");
        let licence = given(&self.licence).map(|licence| format!("Licence {licence}"));
        let parts: Vec<String> = source.into_iter().chain(licence).collect();
        (!parts.is_empty()).then(|| format!("Data: {}", parts.join(". ")))
    }

    /// Reference and link with this between them; none where neither is given.
    pub fn source_words(&self, between: &str) -> Option<String> {
        // A full stop of its own ends no sentence here.
        let reference = given(&self.reference).map(|text| {
            if between.starts_with('.') {
                text.trim_end_matches('.')
            } else {
                text
            }
        });
        let parts: Vec<&str> = reference.into_iter().chain(given(&self.link)).collect();
        (!parts.is_empty()).then(|| parts.join(between))
    }

    /// The licence of the numbers, where it is given.
    pub fn licence_words(&self) -> Option<&str> {
        given(&self.licence)
    }
}

fn given(text: &str) -> Option<&str> {
    let text = text.trim();
    (!text.is_empty() && text != NOT_GIVEN).then_some(text)
}

#[cfg(test)]
mod tests {
    use crate::physics::materials::find;

    #[track_caller]
    fn check(fields: [&str; 3], line: Option<&str>) {
        let mut material = find("gold").unwrap().unwrap();
        let [reference, link, licence] = fields.map(str::to_owned);
        material.reference = reference;
        material.link = link;
        material.licence = licence;
        assert_eq!(material.data_line().as_deref(), line);
    }

    #[test]
    fn a_line_says_what_is_given() {
        check(
            ["A. Author, group.", "https://example.org", "CC0-1.0"],
            Some("Data: A. Author, group. https://example.org. Licence CC0-1.0"),
        );
        check(
            ["A. Author", "not given", "MIT"],
            Some("Data: A. Author. Licence MIT"),
        );
        check(["not given", "not given", "MIT"], Some("Data: Licence MIT"));
        check(["not given", "not given", "not given"], None);
    }
}
