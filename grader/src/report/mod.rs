//! Reports: functions of the record and its pictures. They decide nothing.

#[cfg(test)]
mod any_record;
pub mod class;
pub mod html;
pub mod junit;
pub mod mistakes;
#[cfg(test)]
pub(crate) mod sample;
pub mod terminal;
pub mod words;
