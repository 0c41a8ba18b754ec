//! Which names in an archive are safe to create on any machine.

use crate::plain;

/// What is wrong with an entry of an archive; completes "the entry NAME ...".
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsafe {
    /// A link, device, pipe or socket.
    #[error("is neither a file nor a folder (a link or a device, say)")]
    NeitherFileNorFolder,
    /// It begins at the root of the file system.
    #[error("has an absolute path")]
    Absolute,
    /// It has `..` in it.
    #[error("leaves the folder (`..`)")]
    Leaves,
    /// A backslash or a colon: another path on another system.
    #[error("has a backslash or a colon in its name")]
    OtherSystem,
    /// NUL, a control character, or one that cannot be seen.
    #[error("has a control character or an invisible one in its name")]
    Control,
    /// The name is not UTF-8.
    #[error("has a name that is not UTF-8")]
    NotUtf8,
    /// A name that Windows keeps for a device.
    #[error("has a name that Windows keeps for a device")]
    Device,
    /// A name of more than 255 bytes.
    #[error("has too long a name")]
    TooLong,
    /// Too many folders in one another.
    #[error("lies more than {0} folders deep")]
    TooDeep(usize),
    /// It came before.
    #[error("comes twice")]
    Twice,
    /// On some systems it would be the same file as another.
    #[error("differs from `{0}` only in upper and lower case")]
    SameButForCase(String),
    /// More bytes than a file may have.
    #[error("is larger than {0} bytes")]
    TooLarge(u64),
}

/// The names that the path `name` of an entry is made of, `.` left out: none for the top folder itself.
pub(super) fn parts(name: &[u8], depth: usize) -> Result<Vec<&str>, Unsafe> {
    let name = str::from_utf8(name).map_err(|_| Unsafe::NotUtf8)?;
    if name.chars().any(plain::is_hidden) {
        return Err(Unsafe::Control);
    }
    if name.contains(['\\', ':']) {
        return Err(Unsafe::OtherSystem);
    }
    if name.starts_with('/') {
        return Err(Unsafe::Absolute);
    }
    let parts: Vec<&str> = name.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
    parts.iter().try_for_each(|part| check(part))?;
    if parts.len() > depth { Err(Unsafe::TooDeep(depth)) } else { Ok(parts) }
}

fn check(part: &str) -> Result<(), Unsafe> {
    if part == ".." {
        return Err(Unsafe::Leaves);
    }
    if part.len() > 255 {
        return Err(Unsafe::TooLong);
    }
    let stem = part.split('.').next().unwrap_or(part).trim_end().to_ascii_lowercase();
    let numbered = |prefix| stem.strip_prefix(prefix).is_some_and(|n| matches!(n.as_bytes(), [b'0'..=b'9']));
    if matches!(stem.as_str(), "con" | "prn" | "aux" | "nul") || numbered("com") || numbered("lpt") {
        return Err(Unsafe::Device);
    }
    Ok(())
}
