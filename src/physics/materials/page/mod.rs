//! Reads a page of the refractiveindex.info database: YAML, written by hand over twenty years. Errors that can be repaired are, and
//! remarks say how. Nonsense is refused.
//!
//! ```yaml
//! REFERENCES: |            # HTML or Markdown
//!     P. B. Johnson and R. W. Christy. Optical constants ...
//! COMMENTS: |
//!     Room temperature
//! DATA:
//!   - type: tabulated nk   # or: tabulated n, tabulated k, formula 1 to formula 9; several items add up
//!     data: |
//!         0.1879 1.28 1.188
//!   - type: formula 2
//!     wavelength_range: 0.3 2.5
//!     coefficients: 0 1.03961212 0.00600069867
//! CONDITIONS:
//!     temperature: 293
//! PROPERTIES:
//!     nd: 1.5168
//! ```
//!
//! Wavelengths are in micrometres there. The formulas are those of [`super::Formula`]. Source: M. N. Polyanskiy,
//! *Refractiveindex.info database of optical constants*, Scientific Data 11, 94 (2024),
//! <https://doi.org/10.1038/s41597-023-02898-2>.

mod item;
mod material;
mod name;
mod plain;
mod yaml;

use super::formula::DispersionCurve;
use crate::physics::user_text::FileFault;

/// The contents of a page of refractiveindex.info, or of a table of measurements.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Page {
    /// The file, as the user named it.
    pub file: String,
    /// Refractive index by wavelength.
    pub n: Option<DispersionCurve>,
    /// Extinction coefficient by wavelength, not below 0.
    pub k: Option<DispersionCurve>,
    /// The licence of the numbers: CC0-1.0 for a page of the database; empty if unknown.
    pub licence: String,
    /// Who measured it, as one line of plain text; may be empty.
    pub reference: String,
    /// Where to read about it: its DOI as a link, or the first link; may be empty.
    pub link: String,
    /// Comments, as one line of plain text; may be empty.
    pub comments: String,
    /// Temperature, film thickness and the like, as `key: value, ...`, in SI units, keys as they are spelt; may be empty.
    pub conditions: String,
    /// The index at the d line of helium, 587.5618 nm, that the manufacturer of a glass prints.
    pub nd: Option<f64>,
    /// Remarks on what was done to the numbers.
    pub remarks: Vec<String>,
}

/// The licence that every page of the database states in its first lines.
const LICENCE: &str = "CC0-1.0";

/// The longest text that is read: more than all pages together.
pub(super) const MOST_BYTES: usize = 64 << 20;

impl Page {
    /// Reads a page. `file` is for messages, and for the page's own name.
    ///
    /// # Errors
    /// The text is not YAML, or its data are of a kind that is not supported.
    pub fn parse(file: &str, text: &str) -> Result<Page, FileFault> {
        check_text(file, text)?;
        let raw = yaml::read(file, text)?;
        let mut page = Page {
            file: file.to_owned(),
            licence: LICENCE.to_owned(),
            reference: plain::line(raw.references.as_deref().unwrap_or("")),
            link: plain::link(raw.references.as_deref().unwrap_or("")),
            comments: plain::line(raw.comments.as_deref().unwrap_or("")),
            conditions: plain::line(&raw.conditions.unwrap_or_default().said()),
            nd: raw.properties.and_then(|properties| properties.nd()),
            ..Page::default()
        };
        for item in item::read(file, text, raw.data)? {
            page.add(item.n, item.k, item.remarks);
        }
        Ok(page)
    }

    /// Adds the curves of one table or formula. If two give the same quantity, the first counts. On the one page where that
    /// happens (PVP, Konig), the formula precedes a table that was computed from it.
    pub(super) fn add(
        &mut self,
        n: Option<DispersionCurve>,
        k: Option<DispersionCurve>,
        remarks: Vec<String>,
    ) {
        let mut take =
            |own: &mut Option<DispersionCurve>, curve: Option<DispersionCurve>, letter: &str| {
                if own.is_some() && curve.is_some() {
                    let what = format!("{letter} is given twice: the first was taken");
                    self.remarks.push(what);
                } else if curve.is_some() {
                    *own = curve;
                }
            };
        take(&mut self.n, n, "n");
        take(&mut self.k, k, "k");
        self.remarks.extend(remarks);
    }
}

/// Whether a text can be read at all.
pub(super) fn check_text(file: &str, text: &str) -> Result<(), FileFault> {
    let fault = |at: usize, what: String| FileFault::at(file, text, at, what);
    if text.len() > MOST_BYTES {
        let what = format!(
            "the file has {} bytes; at most {MOST_BYTES} are read",
            text.len()
        );
        return Err(fault(0, what));
    }
    match text.find('\0') {
        Some(at) => Err(fault(at, "a NUL byte: this is no text".to_owned())),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::{Extrapolate, Formula, Material, MaterialKind};

    const GOOD: &str = "\
# a comment
REFERENCES: |
    A. Author. <a href=\"https://doi.org/10.1000/1\"><i>J.</i> <b>6</b></a>
COMMENTS: |
    Room temperature
DATA:
  - type: tabulated nk
    data: |
        0.2261 1.28 1.188
        0.5 1.5 0.25
CONDITIONS:
    temerature: 293
    film_thickness: 20e-9
PROPERTIES:
    density:
      - value: 2510
    nd: 1.5168
";

    fn data(items: &str) -> String {
        format!("REFERENCES: r\nDATA:\n{items}")
    }

    fn formula(number: &str, range: &str, coefficients: &str) -> String {
        data(&format!(
            "- type: formula {number}\n  wavelength_range: {range}\n  coefficients: {coefficients}\n"
        ))
    }

    fn table(kind: &str, rows: &str) -> String {
        let rows: String = rows
            .split(';')
            .map(|row| format!("     {}\n", row.trim()))
            .collect();
        data(&format!("- type: tabulated {kind}\n  data: |\n{rows}"))
    }

    fn read(text: &str) -> Page {
        Page::parse("main/Au/nk/Mine.yml", text).expect("it is good")
    }

    fn curve(points: &[(f64, f64)]) -> Option<DispersionCurve> {
        DispersionCurve::table(points.to_vec())
    }

    #[test]
    fn a_good_page_is_read() {
        let page = read(GOOD);
        assert_eq!(page.n, curve(&[(226.1, 1.28), (500.0, 1.5)]));
        assert_eq!(page.k, curve(&[(226.1, 1.188), (500.0, 0.25)]));
        assert_eq!(page.reference, "A. Author. J. 6");
        assert_eq!(page.link, "https://doi.org/10.1000/1");
        assert_eq!(page.comments, "Room temperature");
        assert_eq!(page.conditions, "temerature: 293, film_thickness: 20e-9");
        assert_eq!(page.nd, Some(1.5168));
        assert_eq!(page.remarks, Vec::<String>::new());
        let material = page.material(None).expect("it has n");
        assert_eq!(material.name, "au_mine");
        assert_eq!(material.summary, "Au, Mine: Room temperature");
        assert_eq!(material.page, "main/Au/nk/Mine.yml");
        assert_eq!(material.kind, MaterialKind::Semiconductor);
        assert_eq!(
            material.note,
            "class semiconductor guessed from n = 1.39, k = 0.719 at 363.05 nm"
        );
        assert_eq!(Material::parse("m.toml", &material.to_toml()), Ok(material));
        assert_eq!(read(&GOOD.replace('\n', "\r\n")).n, page.n);
        assert_eq!(read(&format!("\u{feff}{GOOD}")).n, page.n);
    }

    #[test]
    fn formulas_are_read() {
        let page = read(&formula("2", "0.3 2.5", "0 1.04 0.006"));
        let expected = Formula {
            number: 2,
            coefficients: vec![0.0, 1.04, 0.006],
            from_nm: 300.0,
            to_nm: 2500.0,
        };
        assert_eq!(page.n, Some(DispersionCurve::Formula(expected)));
        for number in 1..=9 {
            // A value of 1.5 would be a negative n² in formula 8.
            let page = read(&formula(&number.to_string(), "0.3 2.5", "0.25"));
            assert!(page.n.is_some() && page.remarks.is_empty(), "{number}");
        }
        let both =
            formula("5", "0.3 2.5", "1.5") + "- type: tabulated k\n  data: |\n    0.4 1e-8\n";
        assert_eq!(read(&both).k, curve(&[(400.0, 1e-8)]));
    }

    #[track_caller]
    fn remarks(text: &str, remarks: &[&str]) -> Page {
        let page = read(text);
        assert_eq!(page.remarks, remarks);
        page
    }

    #[test]
    fn what_is_done_to_a_page_is_said() {
        let page = remarks(
            &table("nk", "0.5 2 0; 0.4 1 -0.1; 0.4 2 0"),
            &[
                "k was below 0 in 1 row, at worst -0.1: taken as 0",
                "rows were not in order of wavelength: sorted",
                "1 wavelength had several rows that differ, the first at 400 nm: their mean was taken",
            ],
        );
        assert_eq!(page.n, curve(&[(400.0, 1.5), (500.0, 2.0)]));
        let rest = "formula 9 has 6 coefficients, and 7 are given: the rest was not used";
        remarks(&formula("9", "0.3 2.5", "2 .1 .01 .1 5 6 7"), &[rest]);
        remarks(&formula("8", "0.3 2.5", ".3 .01 .001 .001"), &[]);
        let stray = table("n", "0.4 1") + "  wavelength_range: 0.3 2.5\n";
        remarks(&stray, &["a table has no `wavelength_range`: not used"]);
        let twice =
            formula("5", "0.3 2.5", "1.5") + "- type: tabulated nk\n  data: |\n    0.4 1 0.5\n";
        let page = remarks(&twice, &["n is given twice: the first was taken"]);
        assert!(
            matches!(page.n, Some(DispersionCurve::Formula(_))) && page.k == curve(&[(400.0, 0.5)])
        );
    }

    /// The pole of the first lies at 0.6 um, beside the middle of the visible range, that of the second at 0.4 um.
    #[test]
    fn a_formula_is_cut_to_where_it_gives_an_index() {
        for (coefficients, from_nm, to_nm, says) in [
            ("0.5 0.01 0.36", 300.0, 598.0, "formula 2 gives n^2 = "),
            ("1.5 0.01 0.16", 401.0, 2500.0, "formula 2 gives n^2 = "),
        ] {
            let page = read(&formula("2", "0.3 2.5", coefficients));
            let n = page.n.as_ref().expect("it has n");
            assert_eq!(n.range_nm(), (from_nm, to_nm), "{page:?}");
            assert!(page.remarks[0].starts_with(says), "{page:?}");
            assert!(page.remarks[0].contains("was cut to"), "{page:?}");
        }
        refused(
            &formula("1", "0.3 2.5", "1e155"),
            [3, 9],
            "formula 1 gives n^2 = 1e155 at 300 nm; n must lie between 0.001 and 10000",
        );
        refused(
            &formula("5", "0.3 2.5", "-1"),
            [3, 9],
            "formula 5 gives n = -1",
        );
    }

    #[track_caller]
    fn refused(text: &str, at: [usize; 2], says: &str) {
        let fault = Page::parse("p.yml", text).expect_err("it is refused");
        assert!(fault.what.contains(says), "{fault}");
        assert_eq!([fault.line, fault.column], at, "{fault}");
    }

    #[test]
    fn a_fault_in_a_row_names_its_line_and_column() {
        refused(
            &table("nk", "0.4 1 1; 0.5 1.80-17 0"),
            [6, 10],
            "`1.80-17` is no number; did you mean 1.80e-17?",
        );
        for (kind, rows, at, says) in [
            ("n", "0.4 1; 0,5 1", [6, 6], "did you mean 0.5?"),
            ("n", "0.4 nan", [5, 10], "`nan` is not a finite number"),
            ("n", "0.4 1;; 0.5 -inf", [7, 10], "not a finite number"),
            ("k", "0.4 -0.21", [5, 10], "k is -0.21"),
            ("n", "0 1", [5, 6], "the wavelength is 0"),
            ("n", "-0.4 1", [5, 6], "the wavelength is -0.4"),
        ] {
            refused(&table(kind, rows), at, says);
        }
        refused(
            &table("nk", "0.4 1"),
            [5, 6],
            "a row of 2 numbers; it wants wavelength, n, k",
        );
        refused(
            &table("k", "0.4 1 2"),
            [5, 6],
            "a row of 3 numbers; it wants wavelength, k",
        );
        // Lines that YAML folded into one have no place of their own.
        refused(
            &data("- type: tabulated n\n  data: >\n    0.4 1\n    0.5 x\n"),
            [5, 5],
            "a row of 4 numbers",
        );
        refused(
            &data("- type: tabulated n\n  data: \"0.4 x\"\n"),
            [4, 9],
            "`x` is no number",
        );
    }

    #[test]
    fn a_page_that_is_none_is_refused() {
        refused("", [1, 1], "");
        refused("a text", [1, 1], "expected mapping start");
        refused("REFERENCES: r\n", [1, 1], "DATA is missing");
        refused("DATA: []\n", [1, 1], "DATA is empty");
        refused("DATA:\n", [1, 1], "DATA is missing");
        refused("DATA: x\n", [1, 7], "");
        for (item, column, says) in [
            (
                "data: |\n    1 2",
                3,
                "without `type`; allowed: tabulated nk",
            ),
            (
                "type: tabulated nkx",
                9,
                "unknown type `tabulated nkx`; allowed: tabulated nk",
            ),
            ("type: formula 10", 9, "unknown type `formula 10`; allowed"),
            ("type: formula A", 9, "formula 1 to formula 9"),
            (
                "type: tabulated n2\n  data: |\n     0.4 1",
                9,
                "gives the nonlinear index n2, not n and k",
            ),
            (
                "type: tabulated n",
                9,
                "the table `tabulated n` has no rows",
            ),
            ("type: tabulated n\n  data:", 9, "has no rows"),
        ] {
            refused(&data(&format!("- {item}\n")), [3, column], says);
        }
        refused(&table("n", ""), [3, 9], "has no rows");
        refused(&GOOD.replace("1.28", "1\0"), [9, 17], "NUL");
        refused(
            "DATA: []\nDATA: []\n",
            [2, 1],
            "duplicate mapping key: DATA",
        );
        refused(
            "DATA: []\n---\nDATA: []\n",
            [2, 1],
            "a second document; a page is one",
        );
    }

    #[test]
    fn a_formula_that_is_none_is_refused() {
        refused(
            &data("- type: formula 1\n  coefficients: 1\n"),
            [3, 9],
            "`formula 1` without `wavelength_range`",
        );
        refused(
            &data("- type: formula 1\n  wavelength_range: 1 2\n"),
            [3, 9],
            "without `coefficients`",
        );
        for (range, says) in [
            ("0.3", "`wavelength_range` has 1 numbers"),
            ("2.5 0.3", "does not ascend"),
            ("1 1", "does not ascend"),
            ("0 1", "must be above 0"),
            ("a 1", "`wavelength_range`: `a` is no number"),
        ] {
            refused(&formula("1", range, "1"), [4, 21], says);
        }
        for (coefficients, says) in [
            ("1 1.8-2", "did you mean 1.8e-2?"),
            ("1 inf", "not a finite number"),
            ("\"\"", "0 of them; a formula has 1 to 64"),
            ("1 ".repeat(65).as_str(), "65 of them"),
        ] {
            refused(&formula("1", "0.3 2.5", coefficients), [5, 17], says);
        }
        assert!(read(&formula("1", "0.3 2.5", &"0 ".repeat(63))).n.is_some());
        refused(
            &formula("4", "0.3 5", "1 1.04 2 0.09 2 0.9 0 9.9"),
            [5, 17],
            "formula 4 has 8 coefficients, and C6 wants all up to C9",
        );
        refused(
            &formula("2", "0.3 2.5", "0 1 0.01 2"),
            [5, 17],
            "C4 wants all up to C5",
        );
    }

    /// The form of pages before 2024.
    #[test]
    fn the_range_of_the_old_schema_is_read() {
        let new = formula("2", "0.3 2.5", "0 1.03961212 0.00600069867");
        let old = new.replace("wavelength_range:", "range:");
        assert_ne!(old, new);
        assert_eq!(read(&old), read(&new));
    }

    #[test]
    fn bombs_are_refused() {
        refused(
            &format!("DATA: {}", "[".repeat(100)),
            [1, 23],
            "recursion limit",
        );
        let anchors = "no page has anchors or aliases";
        refused(&data("- &a\n  type: x\n- *a\n"), [4, 3], anchors);
        refused(&data("- <<: {type: x}\n"), [3, 3], anchors);
        let deep: String = (0..100).map(|depth| " ".repeat(depth) + "a:\n").collect();
        refused(&deep, [17, 17], "nested deeper than any page");
        let wide = "A: [".to_owned() + &"a,".repeat(20_000) + "]";
        refused(&wide, [1, 19_995], "more than any page holds");
        let long = "x".repeat(MOST_BYTES + 1);
        refused(
            &long,
            [1, 1],
            "the file has 67108865 bytes; at most 67108864 are read",
        );
    }

    #[test]
    fn a_million_rows_are_read() {
        let rows: String = (0..1_000_000)
            .map(|i| format!("    {}.5 1.5\n", i + 1))
            .collect();
        let page = read(&data(&format!("- type: tabulated n\n  data: |\n{rows}")));
        let n = page.n.expect("a table");
        assert_eq!(n.measured_nm().len(), 1_000_000);
    }

    #[track_caller]
    fn no_material(text: &str, says: &str) {
        let fault = read(text).material(None).expect_err("no material");
        assert!(fault.to_string().contains(says), "{fault}");
    }

    #[test]
    fn a_material_needs_n_and_a_name() {
        no_material(
            &table("k", "0.4 1"),
            "main/Au/nk/Mine.yml:1:1: the page gives k only, no n",
        );
        let apart = |k| {
            formula("5", "0.3 0.5", "1.5")
                + &format!("- type: tabulated k\n  data: |\n    0.2 {k}\n")
        };
        no_material(&apart("1"), "n and k have no wavelength in common");
        let material = read(&apart("-0.0000E+00")).material(None).expect("k is 0");
        assert!(material.k.is_none() && material.note.contains("left out"));
        let fault = read(GOOD).material(Some("Gold")).expect_err("no name");
        assert!(
            fault.what.contains("`Gold` is no name: capital letters"),
            "{fault}"
        );
        let named = read(GOOD).material(Some("gold")).expect("a name");
        assert_eq!([named.name, named.substance], ["gold", "gold"]);
        let bare = Page::parse("x.yml", "DATA:\n- type: tabulated n\n  data: 0.4 1\n");
        let bare = bare.expect("it has data").material(None).expect("it has n");
        let texts = [&bare.reference, &bare.link, &bare.summary, &bare.page];
        assert_eq!(texts, ["not given", "not given", "x", ""]);
        assert_eq!(Material::parse("m.toml", &bare.to_toml()), Ok(bare));
    }

    #[test]
    fn the_class_is_guessed() {
        for (row, kind) in [
            ("0.58 0.3 2.8", MaterialKind::Metal),
            ("0.58 4 0.02", MaterialKind::Semiconductor),
            ("0.58 1.5 0.0001", MaterialKind::Dielectric),
            ("0.58 -1 1", MaterialKind::Dielectric),
        ] {
            let material = read(&table("nk", row)).material(None).expect("it has n");
            assert_eq!(material.kind, kind, "{row}");
            assert!(material.note.contains("guessed"), "{}", material.note);
        }
    }

    #[test]
    fn an_index_that_is_none_is_refused_where_it_is_asked_for() {
        let material = read(&table("nk", "0.4 -0.5 1; 0.6 1.5 1"))
            .material(None)
            .expect("it has n");
        let fault = material
            .index(400.0, Extrapolate::Refuse)
            .expect_err("n < 0");
        assert_eq!(
            fault,
            "material `au_mine`: n is -0.5 at 400 nm; it must lie between 0.001 and 10000"
        );
        assert!(material.index(590.0, Extrapolate::Refuse).is_ok());
    }
}
