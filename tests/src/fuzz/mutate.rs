//! Mutations of good files: small ones that reach deep into a parser, and a few wild ones.

use super::Parser;
use crate::dice::Dice;

/// The maximum size of a mutation, in bytes.
const MOST_BYTES: usize = 256 << 10;

/// Numbers and marks that trouble parsers of any format.
const SCRAPS: &[&[u8]] = &[
    b"",
    b"\0",
    b"\n",
    b"\r\n",
    b"\r",
    b" ",
    b"\t",
    b"\xff",
    b"\xc3\x28",
    b"\xef\xbb\xbf",
    b"\xe2\x80\xae",
    b"\xef\xbf\xbe",
    b"\x1b[2J",
    b"\"",
    b"'",
    b"\\",
    b"#",
    b"/",
    b"..",
    b"../../x",
    b"{",
    b"}",
    b"[",
    b"]",
    b",",
    b":",
    b"=",
    b"0",
    b"-0",
    b"-1",
    b"1",
    b"255",
    b"65536",
    b"2147483648",
    b"4294967295",
    b"4294967296",
    b"18446744073709551615",
    b"18446744073709551616",
    b"99999999999999999999999",
    b"0.1",
    b".5",
    b"1.",
    b"1e308",
    b"1e309",
    b"1e-400",
    b"-1e999",
    b"nan",
    b"-nan",
    b"inf",
    b"-inf",
    b"\"nan\"",
    b"\"inf\"",
    b"null",
    b"true",
    b"false",
    b"[]",
    b"{}",
    b"\"\"",
];

/// Words of 1, 2, 4 and 8 bytes at which binary formats overflow.
const EDGES: [u64; 10] = [
    0,
    1,
    0x7f,
    0xff,
    0x7fff,
    0xffff,
    0x7fff_ffff,
    0xffff_ffff,
    0x7fff_ffff_ffff_ffff,
    0xffff_ffff_ffff_ffff,
];

/// Returns one of `seeds` with one to four changes. Checksums are corrected half of the time.
pub fn mutated(parser: &Parser, seeds: &[Vec<u8>], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = seeds[dice.below(seeds.len())].clone();
    for _ in 0..=dice.below(4) {
        change(&mut bytes, parser.scraps, seeds, dice);
        bytes.truncate(MOST_BYTES);
    }
    if dice.below(2) == 0 {
        (parser.repair)(&mut bytes);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, scraps: &[&[u8]], seeds: &[Vec<u8>], dice: &mut Dice) {
    let at = dice.below(bytes.len() + 1);
    let end = (at + dice.below(6)).min(bytes.len());
    match dice.below(13) {
        0 | 1 => flip_digit(bytes, dice),
        2 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << dice.below(8);
            }
        }
        3 => overwrite(bytes, at, dice),
        4 | 5 => drop(bytes.splice(at..end, SCRAPS[dice.below(SCRAPS.len())].iter().copied())),
        6 | 7 if !scraps.is_empty() => {
            drop(bytes.splice(at..end, scraps[dice.below(scraps.len())].iter().copied()))
        }
        8 => {
            let random: Vec<u8> = (0..dice.below(8)).map(|_| dice.bits() as u8).collect();
            bytes.splice(at..end, random);
        }
        9 => drop(bytes.drain(at..(at + dice.below(200)).min(bytes.len()))),
        10 => {
            let other = &seeds[dice.below(seeds.len())];
            let from = dice.below(other.len() + 1);
            let stretch = other[from..(from + dice.below(120)).min(other.len())].to_vec();
            bytes.splice(at..end, stretch);
        }
        11 => repeat(bytes, at, dice),
        _ => {
            if dice.below(4) == 0 {
                bytes.truncate(at);
            }
        }
    }
}

/// Changes a digit, which keeps the format and changes the meaning.
fn flip_digit(bytes: &mut [u8], dice: &mut Dice) {
    if bytes.is_empty() {
        return;
    }
    let from = dice.below(bytes.len());
    if let Some(digit) = bytes[from..].iter_mut().find(|byte| byte.is_ascii_digit()) {
        *digit = b'0' + dice.below(10) as u8;
    }
}

/// Writes a word of either byte order over the bytes at `at`.
fn overwrite(bytes: &mut [u8], at: usize, dice: &mut Dice) {
    let edge = EDGES[dice.below(EDGES.len())];
    let n = 1 << dice.below(4);
    let word = if dice.below(2) == 0 {
        edge.to_le_bytes()[..n].to_vec()
    } else {
        edge.to_be_bytes()[8 - n..].to_vec()
    };
    for (byte, new) in bytes.iter_mut().skip(at).zip(word) {
        *byte = new;
    }
}

/// Repeats a stretch, now and then thousands of times: parsers that recurse have a limit to find.
fn repeat(bytes: &mut Vec<u8>, at: usize, dice: &mut Dice) {
    let end = (at + 1 + dice.below(40)).min(bytes.len());
    let n = if dice.below(8) == 0 { 4096 } else { 1 + dice.below(8) };
    let stretch = bytes[at..end].repeat(n);
    bytes.splice(at..at, stretch);
}

/// Changes nothing: the format has no checksums.
pub fn no_repair(_bytes: &mut [u8]) {}

/// Corrects the CRC of every chunk of a PNG. Other bytes are left unchanged.
pub fn png_crcs(bytes: &mut [u8]) {
    let mut at = 8;
    while bytes.starts_with(b"\x89PNG") && at + 12 <= bytes.len() {
        let n =
            u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]) as usize;
        let Some(end) = at.checked_add(8 + n).filter(|end| end + 4 <= bytes.len()) else { break };
        let mut hasher = flate2::Crc::new();
        hasher.update(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&hasher.sum().to_be_bytes());
        at = end + 4;
    }
}

/// Corrects the checksum of every header of a tar file.
pub fn tar_sums(bytes: &mut [u8]) {
    for header in bytes.chunks_exact_mut(512).filter(|header| header[257..].starts_with(b"ustar")) {
        header[148..156].fill(b' ');
        let sum: u32 = header.iter().map(|byte| u32::from(*byte)).sum();
        header[148..156].copy_from_slice(format!("{sum:06o}\0 ").as_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_corrected() {
        let pixels = cases::film::Image::from_fn(4, 3, |_, _| cases::glam::DVec3::ONE);
        let good = cases::film::encode(cases::film::Kind::Png, &pixels).unwrap();
        let mut bytes = good.clone();
        bytes[29..33].fill(0); // the CRC of IHDR
        png_crcs(&mut bytes);
        assert_eq!(bytes, good);
        let good = super::super::seeds::tar();
        let mut bytes = good[0].clone();
        bytes[148..156].fill(b'7');
        tar_sums(&mut bytes);
        assert!(tar::Archive::new(&bytes[..]).entries().unwrap().all(|entry| entry.is_ok()));
    }

    #[test]
    fn mutations_follow_from_the_seed() {
        let parser = super::super::parsers::all()[0];
        let seeds = [b"[a]\nb = 12\n".to_vec(), b"c = [1, 2]\n".to_vec()];
        let draw = |seed| {
            let mut dice = Dice::new(seed);
            (0..50).map(|_| mutated(&parser, &seeds, &mut dice)).collect::<Vec<_>>()
        };
        assert_eq!(draw(3), draw(3));
        assert_ne!(draw(3), draw(4));
    }
}
