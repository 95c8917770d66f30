//! The plan: which files are run, each with what its functions mean. Supervisor and workers make the same plan from the
//! same flags, so that a number names a file.

use std::path::PathBuf;

use crate::generator::emit::Emitted;
use crate::generator::reference::MaterialInMedium;
use crate::language::targets::Target;
use crate::physics::num::Precision;

/// What is to be run.
#[derive(Debug)]
pub struct VerifyPlan {
    /// The files in order.
    pub files: Vec<PlannedFile>,
    /// The materials.
    pub subjects: Vec<MaterialInMedium>,
    /// The materials with whose values library functions are run, where it is not those.
    pub others: Vec<MaterialInMedium>,
    /// Why some are left out.
    pub left_out: Vec<String>,
    /// Files of functions that the folder's manifest lists and a run that names nothing leaves out: other materials', methods', precisions'.
    pub unasked: Vec<String>,
    /// The files that are read or listed in the folder: no report may take the place of one.
    pub places: Vec<PathBuf>,
}

/// A file, or the modules that stand for one.
#[derive(Debug)]
pub struct PlannedFile {
    /// Its target.
    pub target: &'static Target,
    /// Its pages: that which is run comes last.
    pub pages: Vec<ShippedPage>,
    /// Its functions in order.
    pub functions: Vec<Emitted>,
    /// The place of its material among the subjects, where it has one.
    pub subject: Option<usize>,
}

impl VerifyPlan {
    /// The materials with whose values library functions are run.
    pub fn trial_subjects(&self) -> &[MaterialInMedium] {
        if self.others.is_empty() {
            &self.subjects
        } else {
            &self.others
        }
    }
}

impl PlannedFile {
    /// What its functions compute in.
    pub fn precision(&self) -> Precision {
        self.functions
            .first()
            .map_or_else(Precision::default, |emitted| emitted.precision)
    }

    /// The page that is run.
    pub fn run_page(&self) -> &ShippedPage {
        self.pages.last().expect("a planned file has a page")
    }

    /// Why it has no row, where it has none. A function of an effect and one of a material have one always.
    pub fn why_no_row(&self) -> &'static str {
        if self.functions.is_empty() {
            "it holds no function that was asked for"
        } else {
            "its functions describe none of the materials that are run"
        }
    }

    /// Adds a page; compute modules are run, so that they come last.
    pub fn add(&mut self, page: ShippedPage) {
        self.pages.push(page);
        self.pages.sort_by_key(ShippedPage::is_run);
    }
}

/// A file as it is shipped.
#[derive(Debug)]
pub struct ShippedPage {
    /// Relative to the output folder.
    pub path: String,
    /// Its bytes: those in the output folder, or, where it is not there, what would be written.
    pub bytes: Vec<u8>,
    /// Whether it lies in the output folder.
    pub is_shipped: bool,
    /// Whether it is what would be written today, line ends aside.
    pub is_current: bool,
    /// The loop in what would be run, with its line: a device is not given one.
    pub holds_loop: Option<String>,
    /// The entry point of each function, in order; nothing for text.
    pub entries: Vec<String>,
    /// What a reader of the report should know of it, and is no fault.
    pub remark: Option<String>,
    /// Its faults, whatever its functions return: what was added, what it lacks, false numbers.
    pub findings: Vec<String>,
}

impl ShippedPage {
    /// Whether its functions are run: of modules those of compute shaders are.
    pub fn is_run(&self) -> bool {
        !self.path.ends_with(".spv") || self.path.contains(".comp.")
    }
}
