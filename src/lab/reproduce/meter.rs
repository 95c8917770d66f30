//! How far the work is, in angles.

/// Counts angles and tells whoever asked.
pub struct Meter<'a> {
    done: usize,
    whole: usize,
    say: &'a mut dyn FnMut(u64, u64, &str),
}

impl<'a> Meter<'a> {
    /// Nothing is done yet.
    pub fn new(whole: usize, say: &'a mut dyn FnMut(u64, u64, &str)) -> Meter<'a> {
        Meter {
            done: 0,
            whole,
            say,
        }
    }

    /// So many more angles are done.
    pub fn add(&mut self, angles: usize, what: &str) {
        self.done += angles;
        (self.say)(self.done as u64, self.whole as u64, what);
    }
}
