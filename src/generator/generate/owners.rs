//! Whose function a name is: two of one name must not meet.

use std::collections::BTreeMap;

use crate::generator::error::Error;

/// Which part of the output holds a function, by its name.
#[derive(Default)]
pub struct Owners(BTreeMap<String, String>);

impl Owners {
    /// Refuses two functions of one name: a material called `gold_schlick` meets gold's `schlick` so.
    pub fn claim(&mut self, name: &str, owner: &str) -> Result<(), Error> {
        let other = self.0.insert(name.to_owned(), owner.to_owned());
        match other.filter(|other| other != owner) {
            None => Ok(()),
            Some(other) => Err(Error::Usage {
                what: format!("`{name}` would stand in {other} and in {owner}; rename a material"),
            }),
        }
    }
}
