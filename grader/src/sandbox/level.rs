//! The layers of protection that this machine has, and those that the user selects.

use std::sync::LazyLock;

use super::launcher;
use super::layers::Layers;

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

/// The layers that this machine lacks, each with the reason.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "this machine cannot give programs full protection: it lacks {}; `--sandbox basic` grades with \
     what it has, and every record says so",
    .0.iter().map(|(name, why)| format!("{name} ({why})")).collect::<Vec<_>>().join(", ")
)]
pub struct MissingLayers(pub Vec<(&'static str, String)>);

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
    /// Fails if this machine lacks a layer of [`Self::Full`].
    pub fn layers(self) -> Result<Layers, MissingLayers> {
        let Available { layers, missing } = available();
        match self {
            Self::None => Ok(Layers::default()),
            Self::Full if *layers != Layers::ALL => Err(MissingLayers(missing.clone())),
            Self::Basic | Self::Full => Ok(*layers),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_takes_what_the_machine_has_and_full_demands_all() {
        let Available { layers, missing } = available();
        assert_eq!(Level::None.layers(), Ok(Layers::default()));
        assert_eq!(Level::Basic.layers(), Ok(*layers));
        assert_eq!(Level::Full.layers().is_ok(), missing.is_empty());
    }
}
