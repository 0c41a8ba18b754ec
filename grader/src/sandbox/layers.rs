//! The layers of protection around a program.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The layers around a program, besides limits on time and resources, which are always in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Layers {
    /// Namespaces of its own: the program sees no other process, no network, and no file except
    /// those that it needs.
    pub namespaces: bool,
    /// Landlock: the kernel refuses every other file, TCP, and signals to other programs.
    pub landlock: bool,
    /// A filter of system calls.
    pub seccomp: bool,
}

impl Layers {
    /// All layers.
    pub const ALL: Self = Self { namespaces: true, landlock: true, seccomp: true };

    fn list(self) -> [(bool, &'static str); 3] {
        [(self.namespaces, "namespaces"), (self.landlock, "landlock"), (self.seccomp, "seccomp")]
    }

    /// Returns the layers that both have.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            namespaces: self.namespaces && other.namespaces,
            landlock: self.landlock && other.landlock,
            seccomp: self.seccomp && other.seccomp,
        }
    }
}

/// Writes the layers in force, such as `timeouts+rlimits+namespaces+landlock+seccomp`.
impl fmt::Display for Layers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("timeouts+rlimits")?;
        self.list()
            .iter()
            .filter(|(is_on, _)| *is_on)
            .try_for_each(|(_, name)| write!(f, "+{name}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_named_in_order() {
        assert_eq!(Layers::default().to_string(), "timeouts+rlimits");
        assert_eq!(Layers::ALL.to_string(), "timeouts+rlimits+namespaces+landlock+seccomp");
    }
}
