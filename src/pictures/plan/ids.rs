//! The map from ids of a G-buffer to materials, as TOML.
//!
//! ```toml
//! ignore = [7]              # ids that take no part in the plan; it may be left out
//!
//! [[material]]
//! id = 1                    # 1 or more: 0 is the background
//! name = "statue"           # what the scene calls it; the material's text unless given
//! material = "gold"         # a name of the catalogue, or the path of a material's file, relative to this one
//! ```

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::frame::MappedMaterial;
use crate::physics::materials::is_hidden;
use crate::physics::user_text::{FileFault, FileText};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawMap {
    #[serde(default)]
    ignore: Vec<Spanned<i64>>,
    material: Option<Spanned<Vec<Spanned<RawMaterial>>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawMaterial {
    id: Spanned<i64>,
    name: Option<Spanned<String>>,
    material: Spanned<String>,
}

/// The materials of a G-buffer, by id.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialIds {
    /// The materials, as the file lists them.
    pub materials: Vec<MappedMaterial>,
    /// The index of each id's material; `None` where the id takes no part in the plan.
    ids: BTreeMap<u32, Option<usize>>,
    /// For each material, line and column of its `material`.
    places: Vec<[usize; 2]>,
    file: String,
}

impl MaterialIds {
    /// Reads a map of materials. `file` is only for messages.
    ///
    /// ```
    /// use fresnel_gen::pictures::plan::MaterialIds;
    ///
    /// let text = "[[material]]\nid = 3\nmaterial = \"gold\"\n";
    /// let ids = MaterialIds::parse("scene.toml", text).expect("it is good");
    /// assert_eq!(ids.material_of(3), Ok(Some(0)));
    /// ```
    ///
    /// # Errors
    /// The text is not TOML, a key is missing or unknown, an id is not from 1 to 2³² - 1, or an id or a name stands twice.
    pub fn parse(file: &str, text: &str) -> Result<MaterialIds, FileFault> {
        let place = FileText { file, text };
        let raw: RawMap = toml::from_str(text).map_err(|error| place.toml_fault(&error))?;
        let mut ids = MaterialIds {
            materials: Vec::new(),
            ids: BTreeMap::new(),
            places: Vec::new(),
            file: file.to_owned(),
        };
        let listed = raw.material.map_or(Vec::new(), Spanned::into_inner);
        if listed.is_empty() {
            let what =
                "no material; the map wants at least one `[[material]]` with `id` and `material`";
            return Err(place.fault(0, what.to_owned()));
        }
        for (index, material) in listed.iter().enumerate() {
            let material = material.get_ref();
            ids.enter(&material.id, Some(index), &place)?;
            ids.take(material, &place)?;
        }
        for id in &raw.ignore {
            ids.enter(id, None, &place)?;
        }
        Ok(ids)
    }

    /// The index of an id's material in [`MaterialIds::materials`]; `None` where the id takes no part in the plan.
    ///
    /// # Errors
    /// The map lacks the id; the text says what to add.
    pub fn material_of(&self, id: u32) -> Result<Option<usize>, String> {
        let known = self.ids.get(&id).copied();
        let why = || {
            format!(
                "no material has the id {id}; add `[[material]]` with `id = {id}` to the map of materials, or {id} to its `ignore`"
            )
        };
        known.ok_or_else(why)
    }

    /// A fault of a material's name or file, at its place in the map.
    ///
    /// # Panics
    /// There is no such material.
    pub fn fault(&self, material: usize, what: String) -> FileFault {
        let [line, column] = self.places[material];
        FileFault {
            file: self.file.clone(),
            line,
            column,
            what,
        }
    }

    fn enter(
        &mut self,
        id: &Spanned<i64>,
        material: Option<usize>,
        place: &FileText,
    ) -> Result<(), FileFault> {
        let number = *id.get_ref();
        let what = match u32::try_from(number) {
            Ok(0) => "id 0 is the background, which is never mapped; ids begin with 1".to_owned(),
            Err(_) => format!(
                "id {number} is no id; ids are whole numbers from 1 to {}",
                u32::MAX
            ),
            Ok(number) => match self.ids.insert(number, material) {
                None => return Ok(()),
                Some(None) => format!("id {number} stands in `ignore` twice"),
                Some(Some(first)) => {
                    let first = &self.materials[first].name;
                    format!("id {number} is that of `{first}` already; an id stands once")
                }
            },
        };
        Err(place.fault(id.span().start, what))
    }

    fn take(&mut self, raw: &RawMaterial, place: &FileText) -> Result<(), FileFault> {
        check_one_line(place, "material", &raw.material)?;
        let name = raw.name.as_ref().unwrap_or(&raw.material);
        check_one_line(place, "name", name)?;
        let mapped = MappedMaterial {
            name: name.get_ref().clone(),
            material: raw.material.get_ref().clone(),
        };
        if self.materials.iter().any(|one| one.name == mapped.name) {
            let what = format!(
                "two materials are called `{}`; give each a `name` of its own",
                mapped.name
            );
            return Err(place.fault(name.span().start, what));
        }
        let at = place.fault(raw.material.span().start, String::new());
        self.places.push([at.line, at.column]);
        self.materials.push(mapped);
        Ok(())
    }
}

/// Refuses a text that is empty, is not one line, or holds control characters, which a terminal would obey.
fn check_one_line(place: &FileText, key: &str, text: &Spanned<String>) -> Result<(), FileFault> {
    let what = if text.get_ref().trim().is_empty() {
        format!("`{key}` is empty; it wants text")
    } else if text.get_ref().chars().any(is_hidden) {
        format!(
            "`{key}` holds a line break or a control character; it wants one line of plain text"
        )
    } else {
        return Ok(());
    };
    Err(place.fault(text.span().start, what))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "ignore = [7, 9]\n\n[[material]]\nid = 1\nname = \"statue\"\nmaterial = \"gold\"\n\n[[material]]\nid = 4\nmaterial = \"../mine/brass.toml\"\n";

    #[track_caller]
    fn check(from: &str, to: &str, line: usize, says: &str) {
        assert!(GOOD.contains(from), "{from}");
        let text = GOOD.replacen(from, to, 1);
        let fault = MaterialIds::parse("scene.toml", &text).expect_err("a fault");
        assert!(fault.what.contains(says), "{fault}");
        assert_eq!(fault.line, line, "{fault}");
    }

    #[test]
    fn a_good_map_is_read() {
        let ids = MaterialIds::parse("scene.toml", GOOD).expect("it is good");
        let [statue, brass] = [
            ("statue", "gold"),
            ("../mine/brass.toml", "../mine/brass.toml"),
        ]
        .map(|(name, material)| MappedMaterial {
            name: name.to_owned(),
            material: material.to_owned(),
        });
        assert_eq!(ids.materials, [statue, brass]);
        for (id, material) in [(1, Some(0)), (4, Some(1)), (7, None), (9, None)] {
            assert_eq!(ids.material_of(id), Ok(material), "{id}");
        }
        for id in [0, 2] {
            assert!(ids.material_of(id).is_err(), "{id}");
        }
        let fault = ids.fault(1, "no such file".to_owned());
        assert_eq!((fault.line, fault.column), (10, 12));
        assert_eq!(fault.file, "scene.toml");
    }

    #[test]
    fn each_fault_names_its_line() {
        check("id = 1\n", "id = 0\n", 4, "id 0 is the background");
        check("id = 1\n", "id = -1\n", 4, "id -1 is no id");
        check("id = 1\n", "id = 4294967296\n", 4, "id 4294967296 is no id");
        check("id = 1\n", "id = 1.5\n", 4, "invalid type");
        check("id = 1\n", "", 3, "missing field `id`");
        check("id = 4", "id = 1", 9, "id 1 is that of `statue` already");
        check(
            "[7, 9]",
            "[7, 4]",
            1,
            "id 4 is that of `../mine/brass.toml` already",
        );
        check("[7, 9]", "[7, 7]", 1, "id 7 stands in `ignore` twice");
        check("[7, 9]", "[0]", 1, "id 0 is the background");
        check("ignore", "ingore", 1, "did you mean ignore?");
        check("name", "nmae", 5, "did you mean name");
        check("[[material]]", "[[materials]]", 3, "did you mean material");
        check("\"statue\"", "\" \"", 5, "`name` is empty");
        check("\"gold\"", "\"go\\u001b[31mld\"", 6, "`material` holds");
        check(
            "\"statue\"",
            "\"../mine/brass.toml\"",
            10,
            "two materials are called",
        );
        check("material = \"gold\"\n", "", 3, "missing field `material`");
        let fault = MaterialIds::parse("scene.toml", "ignore = [1]\n").expect_err("no material");
        assert!(
            fault.what.contains("at least one `[[material]]`"),
            "{fault}"
        );
    }

    #[test]
    fn nothing_in_a_map_makes_it_panic() {
        for end in 0..GOOD.len() {
            let _ = MaterialIds::parse("scene.toml", &GOOD[..end]);
            let _ = MaterialIds::parse("scene.toml", &GOOD.replacen(&GOOD[end..=end], "\0", 1));
            let _ = MaterialIds::parse("scene.toml", &GOOD.replacen(&GOOD[end..=end], "é", 1));
        }
    }
}
