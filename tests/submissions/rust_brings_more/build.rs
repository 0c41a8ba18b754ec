//! Has no effect: nothing runs it.

fn main() {
    panic!("a build script was run");
}
