//! What is handed in: a folder or an archive.

pub mod archive;
