//! The decisions of the rules of light, each with its alternatives. The lecture's choice comes
//! first, known mistakes and the choices of other courses follow.

/// Defines an enumeration for each decision.
macro_rules! choices {
    ($($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum $name { $($(#[$variant_doc])* $variant,)* }
        )*
    };
}

mod eye;
mod light;
mod shapes;
mod spaces;
mod spawned;

pub use eye::*;
pub use light::*;
pub use shapes::*;
pub use spaces::*;
pub use spawned::*;
