//! The need for an effect: what the scene calls for, and what the picture shows.

use serde::Serialize;

/// How a scene and its picture need an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Need {
    /// The scene calls for the effect. If the picture was examined, some pixel shows it.
    CalledFor,
    /// The scene calls for the effect, but nothing in view needs it: no pixel shows it.
    Idle,
    /// The scene calls for the effect, but it is not simulated.
    LeftOut,
    /// The scene does not call for the effect.
    NotCalledFor,
    /// The scene does not call for the effect, but it is simulated.
    Needless,
}

impl Need {
    /// Returns the need for an effect that the scene calls for or not, that is simulated or not,
    /// and without which `n_changed` pixels change, if the picture was examined.
    pub fn of(called_for: bool, simulated: bool, n_changed: Option<u64>) -> Self {
        match (called_for, simulated) {
            (true, true) if n_changed == Some(0) => Self::Idle,
            (true, true) => Self::CalledFor,
            (true, false) => Self::LeftOut,
            (false, false) => Self::NotCalledFor,
            (false, true) => Self::Needless,
        }
    }

    /// Returns the need in words.
    pub fn says(self) -> &'static str {
        match self {
            Self::CalledFor => "called for",
            Self::Idle => "called for, but idle",
            Self::LeftOut => "called for, but left out here",
            Self::NotCalledFor => "not called for",
            Self::Needless => "not called for, but simulated here",
        }
    }
}
