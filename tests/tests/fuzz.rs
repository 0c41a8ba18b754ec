//! Every parser of foreign bytes reads some mutations of valid files without a panic.
//! `tests --bin fuzz` does the same for any time.

use tests::fuzz::{parsers, read_some};

/// The number of mutations for each parser.
const N: u64 = 400;

#[test]
fn mutated_files_are_read_or_refused() {
    for parser in parsers::all() {
        let counts = read_some(&parser, N, 5);
        assert_eq!(counts.n(), N);
        assert!(
            counts.n_refused > N / 20,
            "{}: {counts:?}: the mutations are too tame",
            parser.name
        );
    }
}
