//! A file of the folder compared with what would be written today and with what the manifest says of it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::outline::{declarations, entry_points, loops, names};
use crate::generator::emit::HeaderForm;
use crate::generator::error::Error;
use crate::generator::generate::{GeneratedFile, KeptMethods, kept};
use crate::generator::output::folder;
use crate::generator::output::manifest::{self, Entry, Manifest};
use crate::lab::verify::listed::{self, Listed};
use crate::lab::verify::outline::{Item, Outline, outline};
use crate::lab::verify::tampering;
use crate::language::methods::Gpu;
use crate::language::targets::{self, Target};
use crate::physics::foreign::Foreign;
use crate::physics::num::Precision;

/// The version of this program.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A file as it is shipped.
#[derive(Debug)]
pub struct ShippedPage {
    /// Relative to the output folder.
    pub path: String,
    /// Its bytes: those in the output folder, or what would be written where there is no such file.
    pub bytes: Vec<u8>,
    /// Whether the bytes are those in the output folder.
    pub is_shipped: bool,
    /// Whether it is what would be written today, apart from line ends.
    pub is_current: bool,
    /// The loop in what would be run, with its line. Text with a loop is never given to a device.
    pub holds_loop: Option<String>,
    /// The entry point of each function, in order. Empty for text.
    pub entries: Vec<String>,
    /// What a reader of the report should know of it, where that is no fault.
    pub remark: Option<String>,
    /// Its faults other than wrong results: additions, omissions, false numbers.
    pub findings: Vec<String>,
}

impl ShippedPage {
    /// Whether its functions are run. Among modules, only compute shaders are.
    pub fn is_run(&self) -> bool {
        !self.path.ends_with(".spv") || self.path.contains(".comp.")
    }
}

fn loop_found(found: &Item) -> String {
    match found.line {
        0 => format!("it holds a loop ({})", found.words),
        line => format!("it holds a loop (line {line}: `{}`)", found.words),
    }
}

/// Runs what would be written today in place of the file, which lacks some of its functions.
pub(super) fn replace_with_today(
    page: &mut ShippedPage,
    made: &GeneratedFile,
    asked: &[bool],
    lacks: &[&str],
) {
    page.is_shipped = false;
    page.holds_loop = None;
    page.bytes.clone_from(&made.artifact.bytes);
    page.entries = Today { made, asked }.entries();
    page.remark = Some(format!(
        "{}: it lacks {}, so that what would be written today was run",
        page.path,
        lacks.join(", ")
    ));
}

/// The output folder.
pub(super) struct Folder<'a> {
    path: &'a Path,
    /// The manifest with its text.
    manifest: Option<(Manifest, String)>,
}

impl Folder<'_> {
    pub fn new(path: &Path) -> Result<Folder<'_>, Error> {
        let manifest = Manifest::in_folder(path)?
            .map(|(manifest, bytes)| (manifest, String::from_utf8_lossy(&bytes).into_owned()));
        Ok(Folder { path, manifest })
    }

    /// The methods of its material files in this precision.
    pub fn kept(&self, precision: Precision) -> KeptMethods {
        let manifest = self.manifest.as_ref();
        manifest.map_or_else(KeptMethods::new, |(manifest, _)| kept(manifest, precision))
    }

    fn listed(&self) -> impl Iterator<Item = &Entry> {
        self.manifest
            .iter()
            .flat_map(|(manifest, _)| &manifest.files)
    }

    /// The files that its manifest lists, and the manifest.
    pub fn files(&self) -> Vec<PathBuf> {
        let listed = self.listed().map(|entry| self.path.join(&entry.file));
        listed.chain([self.path.join(manifest::FILE)]).collect()
    }

    /// The files of functions, other than these pages, that the manifest lists for these targets, or for any where none is named.
    pub fn others(&self, targets: &[&Target], pages: &BTreeSet<&str>) -> Vec<String> {
        let is_wanted = |target: &str| {
            targets::find(target).is_some()
                && (targets.is_empty() || targets.iter().any(|own| own.name == target))
        };
        let others = self.listed().filter(|entry| {
            is_wanted(&entry.target)
                && entry.function_names().next().is_some()
                && !pages.contains(entry.file.as_str())
        });
        others.map(|entry| entry.file.clone()).collect()
    }

    /// The names of the functions in a file of the folder. For a module, all its names.
    pub fn functions_in(&self, path: &str) -> Result<Vec<String>, Error> {
        let bytes = folder::read(&self.path.join(path))?.unwrap_or_default();
        if path.ends_with(".spv") {
            return Ok(names(&bytes));
        }
        let found = outline(&String::from_utf8_lossy(&bytes), nests(path));
        Ok(found.functions())
    }

    /// The form of the comments of a file of the folder. Modules have no comments. A missing file has the usual form.
    pub fn header_form(&self, path: &str) -> Result<HeaderForm, Error> {
        let bytes = folder::read(&self.path.join(path))?.filter(|_| !path.ends_with(".spv"));
        let text = bytes.unwrap_or_default();
        Ok(HeaderForm::in_text(&String::from_utf8_lossy(&text)))
    }

    /// The GPU that a file of the folder was written for: the one that its command names, else the target's usual one.
    pub fn gpu(&self, path: &str, usual: Gpu) -> Option<Gpu> {
        let (manifest, _) = self.manifest.as_ref()?;
        let entry = manifest.files.iter().find(|entry| entry.file == path)?;
        if !self.path.join(path).exists() {
            return None;
        }
        match entry.gpu()? {
            Some(name) => name.parse().ok(),
            None => Some(usual),
        }
    }

    /// The page of a file. `asked` says which of its functions are to be run.
    pub fn page(&self, made: &GeneratedFile, asked: &[bool]) -> Result<ShippedPage, Error> {
        let path = made.artifact.path.clone();
        let lying = folder::read(&self.path.join(&path))?;
        let today = Today { made, asked };
        let listed = self
            .manifest
            .as_ref()
            .and_then(|(manifest, text)| Listed::new(manifest, text, &path));
        let mut page = ShippedPage {
            is_shipped: lying.is_some(),
            is_current: true,
            holds_loop: None,
            bytes: Vec::new(),
            entries: today.entries(),
            remark: None,
            findings: listed
                .iter()
                .flat_map(|listed| listed.findings(&made.artifact))
                .collect(),
            path,
        };
        let Some(bytes) = lying else {
            page.findings.extend(listed.map(|_| {
                format!(
                    "{}: it is not there, and {} lists it",
                    page.path,
                    manifest::FILE
                )
            }));
            page.bytes.clone_from(&made.artifact.bytes);
            return Ok(page);
        };
        today.compare(&mut page, bytes, listed.as_ref());
        let version = self
            .manifest
            .as_ref()
            .map(|(manifest, _)| &manifest.version);
        if let (Some(remark), Some(version)) = (&mut page.remark, version)
            && version != VERSION
        {
            *remark += &format!(
                "; version {} wrote the folder last, and this is {VERSION}",
                Foreign(version)
            );
        }
        Ok(page)
    }
}

/// What would be written today.
struct Today<'a> {
    made: &'a GeneratedFile,
    asked: &'a [bool],
}

impl Today<'_> {
    fn is_module(&self) -> bool {
        self.made.artifact.path.ends_with(".spv")
    }

    /// The entry points of the functions that are to be run.
    fn entries(&self) -> Vec<String> {
        let functions = self.made.artifact.detail.functions();
        let wanted = functions
            .iter()
            .zip(self.asked)
            .filter(|(_, asked)| **asked);
        wanted
            .filter_map(|(function, _)| function.entry_point.clone())
            .collect()
    }

    /// The names in the file of the functions that are to be run.
    fn names(&self) -> Vec<String> {
        if self.is_module() {
            return self.entries();
        }
        let wanted = self
            .made
            .functions
            .iter()
            .zip(self.asked)
            .filter(|(_, asked)| **asked);
        wanted.map(|(emitted, _)| emitted.name.clone()).collect()
    }

    /// Fills the page from the file's bytes. If they lack a function that is to be run, what would be written today is run.
    fn compare(&self, page: &mut ShippedPage, bytes: Vec<u8>, listed: Option<&Listed>) {
        page.is_current = self.is_current(&bytes);
        if page.is_current {
            let hash = listed.and_then(|listed| listed.hash_finding(&bytes));
            page.findings.extend(hash);
            page.findings
                .extend(self.unlisted(listed, &self.entries_of_all()));
            page.bytes = bytes;
            return;
        }
        let found = self.outline(&bytes);
        let held = self.held(&bytes, &found);
        page.findings.extend(self.unlisted(listed, &held));
        // A manifest that lists these bytes proves nothing: anybody can write one.
        if self.is_module() && !page.is_run() {
            page.findings.push(format!(
                "{}: it is not what would be written today ({}), and only compute modules are run; write it again, and look at the difference",
                page.path,
                self.difference(&bytes)
            ));
        }
        let lacks: Vec<String> = self
            .names()
            .into_iter()
            .filter(|name| !held.contains(name))
            .collect();
        let is_listed = |name: &str| listed.is_none_or(|listed| listed.has(name));
        page.findings
            .extend(self.findings(&page.path, &found, &lacks, &is_listed));
        if !lacks.is_empty() {
            let lacks: Vec<&str> = lacks.iter().map(String::as_str).collect();
            replace_with_today(page, self.made, self.asked, &lacks);
            return;
        }
        page.holds_loop = found.loops.first().map(loop_found);
        page.remark = Some(format!(
            "{}: it is not what would be written today: {}",
            page.path,
            self.difference(&bytes)
        ));
        page.bytes = bytes;
    }

    /// Functions by the name that stands in the file, which is the entry point in a module.
    fn functions(&self) -> impl Iterator<Item = (&str, &str)> {
        let functions = self.made.artifact.detail.functions().iter();
        functions.map(|function| {
            let entry_point = function.entry_point.as_ref();
            let in_file = entry_point.unwrap_or(&function.name);
            (in_file.as_str(), function.name.as_str())
        })
    }

    fn entries_of_all(&self) -> Vec<String> {
        self.functions()
            .map(|(entry, _)| entry.to_owned())
            .collect()
    }

    /// The functions of the file that the manifest does not list.
    fn unlisted(&self, listed: Option<&Listed>, held: &[String]) -> Vec<String> {
        let held = self
            .functions()
            .filter(|(entry, _)| held.iter().any(|held| held == entry));
        let names: Vec<&str> = held.map(|(_, name)| name).collect();
        listed.map_or_else(Vec::new, |listed| listed.unlisted(&names))
    }

    fn is_current(&self, bytes: &[u8]) -> bool {
        let today = &self.made.artifact.bytes;
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).replace("\r\n", "\n");
        bytes == today || !self.is_module() && text(bytes) == text(today)
    }

    /// How the bytes differ from today's, in words.
    fn difference(&self, bytes: &[u8]) -> String {
        let today = &self.made.artifact.bytes;
        if self.is_module() {
            return listed::of_modules(bytes, today).to_owned();
        }
        listed::of_texts(
            &String::from_utf8_lossy(bytes),
            &String::from_utf8_lossy(today),
        )
    }

    fn outline(&self, bytes: &[u8]) -> Outline {
        if self.is_module() {
            return Outline {
                declared: declarations(bytes),
                loops: loops(bytes),
                ..Outline::default()
            };
        }
        let nests = nests(&self.made.artifact.path);
        outline(&String::from_utf8_lossy(bytes), nests)
    }

    fn held(&self, bytes: &[u8], found: &Outline) -> Vec<String> {
        if self.is_module() {
            return entry_points(bytes);
        }
        found.functions()
    }

    fn findings(
        &self,
        path: &str,
        found: &Outline,
        lacks: &[String],
        is_listed: &dyn Fn(&str) -> bool,
    ) -> Vec<String> {
        if self.is_module() && !lacks.is_empty() {
            // A module with fewer functions has another interface. Functions are listed by name, not by entry point.
            let pairs = self
                .made
                .functions
                .iter()
                .zip(self.made.artifact.detail.functions());
            let lost = pairs.filter(|(emitted, function)| {
                let entry = function.entry_point.as_ref();
                entry.is_some_and(|entry| lacks.contains(entry)) && is_listed(&emitted.name)
            });
            return lost
                .map(|(emitted, _)| format!("{path}: it lacks `{}`", emitted.name))
                .collect();
        }
        tampering::findings(
            path,
            found,
            &self.outline(&self.made.artifact.bytes),
            is_listed,
        )
    }
}

/// Whether comments nest in the language of a file, by its extension.
fn nests(path: &str) -> bool {
    let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
    let mut targets = targets::ALL.iter();
    targets.any(|target| target.extension == ending && target.nests_comments)
}
