//! Reports: functions of the record and its pictures. They decide nothing.

#[cfg(test)]
mod any_record;
pub mod class;
pub mod gradebook;
pub mod gradescope;
pub mod html;
pub mod junit;
pub mod mistakes;
pub mod prairielearn;
#[cfg(test)]
pub(crate) mod sample;
pub mod terminal;
pub mod words;
