//! reference
fn main() {}
