//! The layers of protection, and which of them this machine has.

use std::fmt;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::launcher;

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
    fn and(self, other: Self) -> Self {
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

/// The layers of this machine, and why it lacks the others.
#[derive(Clone, Debug)]
pub struct Available {
    /// The layers that programs can be started with.
    pub layers: Layers,
    /// The layers that are missing, each with the reason.
    pub missing: Vec<(&'static str, String)>,
}

/// Returns the layers of this machine. Each is tried once.
pub fn available() -> &'static Available {
    static AVAILABLE: LazyLock<Available> = LazyLock::new(|| {
        let none = Layers::default();
        let single = [
            ("namespaces", Layers { namespaces: true, ..none }),
            ("landlock", Layers { landlock: true, ..none }),
            ("seccomp", Layers { seccomp: true, ..none }),
        ];
        let (mut layers, mut missing) = (Layers::ALL, Vec::new());
        for (name, layer) in single {
            if let Err(why) = launcher::try_layers(layer) {
                missing.push((name, why.to_string()));
                let others = Layers {
                    namespaces: !layer.namespaces,
                    landlock: !layer.landlock,
                    seccomp: !layer.seccomp,
                };
                layers = layers.and(others);
            }
        }
        Available { layers, missing }
    });
    &AVAILABLE
}

/// The protection that the user selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Level {
    /// Limits on time and resources alone.
    None,
    /// The layers that this machine has.
    Basic,
    /// All layers.
    Full,
}

impl Level {
    /// Returns the layers of this level.
    ///
    /// # Errors
    /// Returns what is missing, with reasons, if this machine lacks a layer of [`Self::Full`].
    pub fn layers(self) -> Result<Layers, String> {
        let Available { layers, missing } = available();
        match self {
            Self::None => Ok(Layers::default()),
            Self::Full if *layers != Layers::ALL => {
                let each = missing.iter().map(|(name, why)| format!("{name} ({why})"));
                Err(each.collect::<Vec<_>>().join(", "))
            }
            Self::Basic | Self::Full => Ok(*layers),
        }
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

    #[test]
    fn a_level_takes_what_the_machine_has_and_full_demands_all() {
        let Available { layers, missing } = available();
        assert_eq!(Level::None.layers(), Ok(Layers::default()));
        assert_eq!(Level::Basic.layers(), Ok(*layers));
        assert_eq!(Level::Full.layers().is_ok(), missing.is_empty());
    }
}
