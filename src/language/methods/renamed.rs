//! Renamed methods: the old name works for one minor version, with a remark, and is then removed.

/// A method's old name and its new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Renamed {
    /// The name before.
    pub old: &'static str,
    /// The name now.
    pub new: &'static str,
    /// The version that renamed it, major and minor. The old name works in that version and in no later one.
    pub in_version: (u32, u32),
}

/// Every old name that still works. A test fails when one has expired.
pub const RENAMED: &[Renamed] = &[];

/// Former names of methods, renamed ones included, under which earlier versions of this program wrote files. A run without
/// flags removes such files. It removes none under a name that is not listed.
pub const FORMER: &[&str] = &[];

/// The renaming of an old name, if there is one.
pub fn renamed(name: &str, all: &[Renamed]) -> Option<Renamed> {
    all.iter().find(|renamed| renamed.old == name).copied()
}

impl Renamed {
    /// What a user of the old name should know.
    pub fn remark(&self) -> String {
        let (major, minor) = self.in_version;
        format!(
            "remark: the method `{}` is now called `{}`; the old name works in version {major}.{minor} only",
            self.old, self.new
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods;

    #[test]
    fn old_names_lead_to_methods_and_none_has_expired() {
        let number = |text: &str| text.parse::<u32>().unwrap();
        let version = (
            number(env!("CARGO_PKG_VERSION_MAJOR")),
            number(env!("CARGO_PKG_VERSION_MINOR")),
        );
        for one in RENAMED {
            assert!(methods::find(one.new).is_some(), "{one:?}: no such method");
            let is_taken = methods::ALL.iter().any(|method| method.name == one.old);
            assert!(!is_taken, "{one:?}: a method has the old name");
            assert!(version <= one.in_version, "{one:?}: remove this line");
            assert!(FORMER.contains(&one.old), "{one:?}: FORMER lacks it");
        }
        for name in FORMER {
            let is_taken = methods::ALL.iter().any(|method| method.name == *name);
            assert!(!is_taken, "{name}: a method has the former name");
        }
    }

    #[test]
    fn an_old_name_is_answered_with_the_new_one() {
        let all = [Renamed {
            old: "schlik",
            new: "schlick",
            in_version: (0, 2),
        }];
        let one = renamed("schlik", &all).unwrap();
        assert!(one.remark().contains("now called `schlick`"));
        assert_eq!(renamed("schlick", &all), None);
    }
}
