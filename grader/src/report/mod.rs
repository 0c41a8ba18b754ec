//! Reports: functions of the record and the pictures behind it. They decide nothing.

pub mod class;
pub mod html;
#[cfg(test)]
pub(crate) mod sample;
pub mod words;
