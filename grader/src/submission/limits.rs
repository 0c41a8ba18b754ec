//! The limits on what is read of a submission. Messages and documents name these numbers.

use std::fmt;

/// The most that a folder or an archive may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of an archive as it was handed in.
    pub archive_bytes: u64,
    /// Bytes that a `.tar.gz` inflates to, including the entries that are not taken.
    pub inflated_bytes: u64,
    /// Entries of an archive that are looked at, including those in [`SKIPPED`] folders.
    pub looked_at: usize,
    /// Files and folders outside of [`SKIPPED`] folders.
    pub entries: usize,
    /// Names in a path: `src/main.rs` has two.
    pub depth: usize,
    /// Bytes of one file.
    pub file_bytes: u64,
    /// Bytes of all files.
    pub all_bytes: u64,
    /// Times its own size that an archive may inflate to, once it exceeds [`RATIO_FREE_BYTES`].
    pub ratio: u64,
}

/// The limits for all submissions: ample for sources, a few meshes and some pictures.
pub const LIMITS: Limits = Limits {
    archive_bytes: 32 * MIB,
    inflated_bytes: 512 * MIB,
    looked_at: 250_000,
    entries: 2000,
    depth: 12,
    file_bytes: 16 * MIB,
    all_bytes: 64 * MIB,
    ratio: 100,
};

/// Bytes that may come out of an archive however small it is.
pub const RATIO_FREE_BYTES: u64 = MIB;

/// Bytes of a path below the top of the hand-in.
pub const PATH_BYTES: usize = 1000;

/// Bytes of one source file of the template.
pub const SOURCE_BYTES: u64 = MIB;

/// Bytes of a `submission.toml`.
pub const MANIFEST_BYTES: u64 = 64 * KIB;

/// Folders between the top of a hand-in and the folder that holds `src` or `submission.toml`.
pub const NESTED: usize = 3;

/// Folders that tools fill. They are neither unpacked nor read.
pub const SKIPPED: [&str; 6] =
    ["target", ".git", "__MACOSX", "node_modules", ".venv", "__pycache__"];

const KIB: u64 = 1 << 10;
const MIB: u64 = 1 << 20;

/// Returns whether a file is one that an operating system creates beside the files of a person,
/// such as `.DS_Store`.
pub(super) fn is_of_system(name: &str) -> bool {
    matches!(name, ".DS_Store" | "Thumbs.db" | "desktop.ini") || name.starts_with("._")
}

/// A size beside the limit that it exceeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Excess {
    /// Bytes that are there; `None` where reading stopped before the end.
    pub found: Option<u64>,
    /// Bytes that are read.
    pub limit: u64,
}

impl fmt::Display for Excess {
    /// Writes, for example, `has 20 MiB; at most 16 MiB are read`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let limit = size(self.limit);
        match self.found {
            None => write!(f, "has more than {limit}; at most {limit} are read"),
            Some(found) if size(found) == limit => {
                write!(f, "has {found} bytes; at most {} bytes are read", self.limit)
            }
            Some(found) => write!(f, "has {}; at most {limit} are read", size(found)),
        }
    }
}

/// Returns `bytes` in the largest unit that leaves a number of at least 1, cut to one decimal.
pub fn size(bytes: u64) -> String {
    let (unit, name) = match bytes {
        0..KIB => return format!("{bytes} bytes"),
        KIB..MIB => (KIB, "KiB"),
        _ => (MIB, "MiB"),
    };
    let tenths = u128::from(bytes) * 10 / u128::from(unit);
    match tenths % 10 {
        0 => format!("{} {name}", tenths / 10),
        rest => format!("{}.{rest} {name}", tenths / 10),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_short() {
        for (bytes, expected) in [
            (0, "0 bytes"),
            (1023, "1023 bytes"),
            (1024, "1 KiB"),
            (1536, "1.5 KiB"),
            (20 * MIB, "20 MiB"),
            (20 * MIB + MIB / 2, "20.5 MiB"),
            (u64::MAX, "17592186044415.9 MiB"),
        ] {
            assert_eq!(size(bytes), expected, "{bytes}");
        }
    }

    #[test]
    fn an_excess_names_both_numbers() {
        let excess = |found| Excess { found, limit: 16 * MIB }.to_string();
        assert_eq!(excess(Some(20 * MIB)), "has 20 MiB; at most 16 MiB are read");
        assert_eq!(
            excess(Some(16 * MIB + 1)),
            "has 16777217 bytes; at most 16777216 bytes are read"
        );
        assert_eq!(excess(None), "has more than 16 MiB; at most 16 MiB are read");
    }
}
