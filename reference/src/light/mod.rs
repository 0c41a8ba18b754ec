//! The formulas of light. They cast no ray and do not know the world.
//!
//! | module | contents |
//! |---|---|
//! | [`material`] | the coefficients of a surface |
//! | [`lights`] | directions to lights and their attenuation [rule 4] |
//! | [`shade`] | the terms that a light adds [rule 3] |
//! | [`optics`] | directions of reflected and refracted rays [rule 8] [rule 9] |
//! | [`snell`] | the certified direction of refraction |

pub mod lights;
pub mod material;
pub mod optics;
pub mod shade;
pub mod snell;
