//! Decides by the first bytes of a file what kind of picture it holds, never by its name.

use super::PictureError;

/// A kind of picture that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Signature {
    Png,
    Pfm,
    Exr,
}

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
const EXR: &[u8] = b"\x76\x2f\x31\x01";

/// Returns the kind of the picture that begins with `head`.
///
/// # Errors
/// The bytes are not those of a picture; `read` names the kinds that the caller can read.
pub(super) fn of(head: &[u8], read: &'static str) -> Result<Signature, PictureError> {
    match head {
        // A PNG that is cut off counts as a PNG; the decoder reports where it ends.
        _ if head.starts_with(PNG) || (head.starts_with(&PNG[..4]) && PNG.starts_with(head)) => {
            match head.get(12..16) {
                Some(b"CgBI") => Err(PictureError::Foreign {
                    read,
                    found: "it is an iOS-optimised PNG (CgBI): save it as a plain one",
                }),
                _ => Ok(Signature::Png),
            }
        }
        [b'P', b'F' | b'f', b'\n' | b'\r' | b' ' | b'\t', ..] => Ok(Signature::Pfm),
        _ if head.starts_with(EXR) => Ok(Signature::Exr),
        _ => Err(PictureError::Foreign { read, found: foreign(head) }),
    }
}

/// Message for a PNG with changed line ends, without the top bits of its bytes, or with replaced
/// bytes.
const TEXT_MODE: &str = "it is a PNG that was transferred in text mode, which changes bytes: \
    write and transfer it in binary mode";

fn foreign(head: &[u8]) -> &'static str {
    match head {
        [] => "the file is empty",
        [0x89, b'P', b'N', b'G', b'\r' | b'\n' | 0x1a, ..] => TEXT_MODE,
        [b'\t', b'P', b'N', b'G', ..] | [0xef, 0xbb | 0xbf, 0xbd | 0xbf, b'P', b'N', b'G', ..] => {
            TEXT_MODE
        }
        [0xc2, 0x89, b'P', b'N', b'G', ..] | [b'?', b'P', b'N', b'G', ..] => TEXT_MODE,
        [0x89, b'P', b'N', b'G', ..] => "it is a PNG whose first bytes are damaged",
        [b'B', b'M', ..] => "these are the bytes of a BMP",
        [0xff, 0xd8, ..] => "these are the bytes of a JPEG",
        [b'G', b'I', b'F', ..] => "these are the bytes of a GIF",
        [b'P', b'1'..=b'7', ..] => "these are the bytes of a PPM, PGM, PBM or PAM",
        [b'P', b'F' | b'f', ..] => "these are the bytes of a PFM with a letter after its first two",
        [b'q', b'o', b'i', b'f', ..] => "these are the bytes of a QOI",
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => {
            "these are the bytes of a WebP"
        }
        [b'I', b'I', 0x2a, 0, ..] | [b'M', b'M', 0, 0x2a, ..] => "these are the bytes of a TIFF",
        [b'#', b'?', ..] => "these are the bytes of a Radiance picture (.hdr)",
        [b'<', ..] => "these are the bytes of a text or an SVG",
        _ => "no known kind of image begins with these bytes",
    }
}
