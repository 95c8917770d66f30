//! What of an output folder is this program's own, and by what proof. Nothing else is replaced or removed.
//!
//! A file *bears the mark* where its head says that fresnel-gen wrote it. A file is *listed* where the folder's manifest
//! has its path with the SHA-256 of its bytes. Either proof lets a run replace a file. A run removes a file only where
//! it is listed and this program could have written that path for that entry: a mark can be pasted, and a manifest can
//! be written by anybody.

use crate::digest::sha256;
use crate::emit::{EFFECTS, MARK};
use crate::lut::{Format, KTX2_MARK, TABLES};
use crate::num::Precision;
use crate::targets::{self, Finish};

use super::catalogue::JSON;
use super::manifest::Entry;

/// The catalogue of coefficients for no language, and what such files are named after.
const CATALOGUE_JSON: &str = "catalogue.json";
const CATALOGUE: &str = "catalogue";

/// The mark must stand within this many bytes of a file that is no text.
const MARK_WITHIN: usize = 1024;

/// How files begin that have no comments, and what their heads say then: JSON, KTX2.
const WITHOUT_COMMENTS: [(&[u8], &[u8]); 2] = [(b"{", b"\"tool\": \"fresnel-gen\""), KTX2_MARK];

/// The hash of a file as a manifest lists it. Ends of lines do not count in text: version control changes them.
pub fn listed_hash(path: &str, bytes: &[u8]) -> String {
    if is_binary(path) || !bytes.contains(&b'\r') {
        return sha256(bytes);
    }
    sha256(&without_carriage_returns(bytes))
}

/// Do these files say the same? Ends of lines do not count in text.
pub fn is_same(path: &str, one: &[u8], other: &[u8]) -> bool {
    one == other
        || !is_binary(path) && without_carriage_returns(one) == without_carriage_returns(other)
}

/// Does the head of a file say that this program wrote it? In text the first line must: a function that somebody pasted
/// into a file of theirs brings its own head along.
pub fn bears_mark(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(MARK_WITHIN)];
    let holds = |mark: &[u8]| head.windows(mark.len()).any(|part| part == mark);
    let format = WITHOUT_COMMENTS
        .iter()
        .find(|(start, _)| bytes.starts_with(start));
    if let Some((_, mark)) = format {
        return holds(mark);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => text.lines().next().is_some_and(|line| line.contains(MARK)),
        Err(_) => holds(MARK.as_bytes()),
    }
}

/// Is the file as the manifest lists it, or as it was before a run that was killed?
pub fn is_listed(entry: &Entry, bytes: &[u8]) -> bool {
    let hash = listed_hash(&entry.file, bytes);
    hash == entry.sha256 || entry.was.as_ref() == Some(&hash)
}

/// Could this program have written this path for this entry? The method or the material need not exist today.
pub fn could_be_written(entry: &Entry) -> bool {
    let parts: Vec<&str> = entry.file.split('/').collect();
    match parts.as_slice() {
        [CATALOGUE_JSON] => entry.target == JSON,
        [TABLES, .., name] => entry.target == TABLES && is_table(name),
        [folder, name] if *folder == entry.target => {
            let stem = stem(entry, name);
            match (&entry.method, &entry.material) {
                (Some(method), None) => stem.is_some_and(|stem| stem.ends_with(method.as_str())),
                (None, None) => stem == Some(CATALOGUE),
                _ => false,
            }
        }
        [folder, EFFECTS, name] if *folder == entry.target => {
            let parts = [&entry.effect, &entry.material, &entry.method];
            let parts: Vec<&str> = parts.into_iter().flatten().map(String::as_str).collect();
            entry.effect.is_some() && stem(entry, name) == Some(parts.join("_").as_str())
        }
        _ if entry.effect.is_some() => false,
        [folder, "materials", name] if *folder == entry.target => entry
            .material
            .as_deref()
            .is_some_and(|material| stem(entry, name) == Some(material)),
        _ => false,
    }
}

/// The name of a target's file without its ending and without the suffix of its precision, where these are right.
fn stem<'a>(entry: &Entry, name: &'a str) -> Option<&'a str> {
    let target = targets::find(&entry.target)?;
    let stem = target.pages.iter().find_map(|page| {
        let ending = format!("{}.{}", page.suffix, target.extension);
        name.strip_suffix(&ending)
    });
    let stem = stem?.strip_suffix(if entry.precision() == Precision::F16.name() {
        Precision::F16.suffix()
    } else {
        ""
    })?;
    let is_name = stem
        .bytes()
        .all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    is_name.then_some(stem)
}

fn is_table(name: &str) -> bool {
    let mut endings = Format::ALL.map(Format::ending).into_iter().chain([".json"]);
    let is_function = |target: &&targets::Target| {
        let stem = name.strip_suffix(target.extension);
        stem.is_some_and(|stem| stem.ends_with('.'))
    };
    endings.any(|ending| name.ends_with(ending)) || targets::ALL.iter().any(is_function)
}

fn is_binary(path: &str) -> bool {
    let is_module = |target: &&targets::Target| {
        let stem = path.strip_suffix(target.extension);
        target.finish == Finish::Spirv && stem.is_some_and(|stem| stem.ends_with('.'))
    };
    let mut tables = Format::ALL.into_iter().filter(|format| !format.is_text());
    tables.any(|format| path.ends_with(format.ending())) || targets::ALL.iter().any(is_module)
}

fn without_carriage_returns(bytes: &[u8]) -> Vec<u8> {
    let followed = bytes.iter().skip(1).copied().map(Some).chain([None]);
    let pairs = bytes.iter().copied().zip(followed);
    let kept = pairs.filter(|pair| *pair != (b'\r', Some(b'\n')));
    kept.map(|(byte, _)| byte).collect()
}
