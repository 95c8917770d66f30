//! A part of the report, and the progress meter of what is computed for it.

use super::comparison::ComparisonRow;

/// A part reproduced.
#[derive(Clone, Debug, PartialEq)]
pub struct ThesisSection {
    /// A title that says how it is measured.
    pub title: String,
    /// The comparisons.
    pub rows: Vec<ComparisonRow>,
}

/// Counts evaluated angles and reports the progress.
pub struct Meter<'a> {
    done: usize,
    whole: usize,
    say: &'a mut dyn FnMut(u64, u64, &str),
}

impl<'a> Meter<'a> {
    /// A meter of `whole` angles, none of which is done.
    pub fn new(whole: usize, say: &'a mut dyn FnMut(u64, u64, &str)) -> Meter<'a> {
        Meter {
            done: 0,
            whole,
            say,
        }
    }

    /// Counts so many more angles as done.
    pub fn add(&mut self, angles: usize, what: &str) {
        self.done += angles;
        (self.say)(self.done as u64, self.whole as u64, what);
    }
}
