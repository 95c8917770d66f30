//! Names derived from a page's path: of the page in its database, and of the material.

use deunicode::deunicode_char;

use super::Page;
use crate::physics::materials::name_fault;

/// The top folders of the database.
const SHELVES: [&str; 5] = ["main", "organic", "glass", "other", "specs"];

/// The most bytes of a material's name.
const LONGEST: usize = 64;

impl Page {
    /// The page's path in the database, from its shelf on (`main/Au/nk/Johnson.yml`); empty if the file's path has no shelf.
    pub fn path(&self) -> String {
        let parts: Vec<&str> = self.file.split(['/', '\\']).collect();
        let shelf = parts.iter().rposition(|part| SHELVES.contains(part));
        // Below a shelf there are at least a book and the page.
        match shelf {
            Some(at) if parts.len() >= at + 3 => parts[at..].join("/"),
            _ => String::new(),
        }
    }

    /// The page's folder and name in words: the book, or the manufacturer of a glass, and the file's name.
    pub fn book_and_title(&self) -> (String, String) {
        let path = self.path();
        let file = self.file.rsplit(['/', '\\']).next().unwrap_or("");
        let title = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let parts: Vec<&str> = path.split('/').collect();
        let book = match parts[..] {
            ["specs", maker, ..] => maker,
            [.., book, "nk" | "n2", _] => book,
            [_, .., book, _] => book,
            _ => "",
        };
        (book.to_owned(), title.to_owned())
    }

    /// The default name of this page's material: `main/Au/nk/Olmon-ts.yml` is `au_olmon_ts`. [`name_fault`] allows it,
    /// whatever the file's name is. Two pages can have the same one.
    pub fn default_name(&self) -> String {
        let (book, title) = self.book_and_title();
        let title = cut(&snake(&title), LONGEST - 2).to_owned();
        let book = snake(&book);
        let book = cut(&book, (LONGEST - 3).saturating_sub(title.len())).to_owned();
        let name = format!("{book}_{title}");
        let name = name.trim_matches('_');
        if name_fault(name).is_none() {
            name.to_owned()
        } else {
            format!("m_{name}").trim_end_matches('_').to_owned()
        }
    }
}

/// A text in snake_case: lower-case letters and digits, with single underscores between. Letters outside ASCII are transliterated.
fn snake(text: &str) -> String {
    let text: String = text.chars().map(spelt).collect();
    let words = text.split(|c: char| !c.is_ascii_alphanumeric());
    let words: Vec<String> = words
        .filter(|word| !word.is_empty())
        .map(str::to_ascii_lowercase)
        .collect();
    words.join("_")
}

fn spelt(c: char) -> String {
    if c.is_ascii() {
        c.to_string()
    } else {
        deunicode_char(c).unwrap_or(" ").to_owned()
    }
}

/// The start of a name in ASCII.
fn cut(name: &str, most: usize) -> &str {
    name[..name.len().min(most)].trim_end_matches('_')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(file: &str, path: &str, name: &str) {
        let page = Page {
            file: file.to_owned(),
            ..Page::default()
        };
        assert_eq!([page.path(), page.default_name()], [path, name]);
        assert_eq!(name_fault(name), None);
    }

    #[test]
    fn a_path_gives_the_page_and_a_legal_name() {
        check(
            "/a/main/data/main/Au/nk/Olmon-ts.yml",
            "main/Au/nk/Olmon-ts.yml",
            "au_olmon_ts",
        );
        check(
            "data\\main\\Au\\nk\\Johnson.yml",
            "main/Au/nk/Johnson.yml",
            "au_johnson",
        );
        let in_database = |page: &str, name: &str| check(page, page, name);
        in_database(
            "organic/(C5H8O2)n - poly(methyl methacrylate)/nk/Beadie.yml",
            "c5h8o2_n_poly_methyl_methacrylate_beadie",
        );
        in_database("specs/schott/optical/N-BK7.yml", "schott_n_bk7");
        in_database("other/alloys/Au-Ag/nk/Rioux.yml", "au_ag_rioux");
        check("mine/My Gold.v2.yml", "", "my_gold_v2");
        check("main.yml", "", "main");
        check("main/x.yml", "", "x");
        in_database("other/4H-SiC/nk/x.yml", "m_4h_sic_x");
        check("CON.yml", "", "m_con");
        check("\u{e9}\u{3bb}.yml", "", "el");
        check("Gl\u{e4}ser.csv", "", "glaser");
        check("\u{91d1}.csv", "", "jin");
        check("\u{94f6}.csv", "", "yin");
        check("\u{ffff}.csv", "", "m");
        check("", "", "m");
        let long = "x".repeat(100);
        check(&format!("{long}.yml"), "", &"x".repeat(62));
        let folder = format!("main/{long}/nk/Kumar.yml");
        in_database(&folder, &format!("{}_kumar", "x".repeat(56)));
    }
}
