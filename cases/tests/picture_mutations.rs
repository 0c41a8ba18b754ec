//! Tests that mutated pictures and arbitrary bytes are read or refused, in bounded memory.

use std::io::Cursor;
use std::panic::catch_unwind;
use std::process::Command;

use cases::film::exr::{Depth, Part, rgb};
use cases::film::{Image, Kind, PictureError, Rows, encode, exr, most_bytes, read_exact};
use fastrand::Rng;
use glam::DVec3;

const SIZE: (u32, u32) = (13, 11);

/// Returns a picture of each kind that can be read.
fn good() -> Vec<(&'static str, Vec<u8>)> {
    let image = Image::from_fn(SIZE.0, SIZE.1, |i, j| {
        DVec3::new(f64::from(i * j) / 130.0, f64::from(i) / 12.0, 0.5)
    });
    let part = Part {
        name: "colour".to_owned(),
        planes: rgb("", &image, Depth::Float).into(),
        attached: vec![],
    };
    let mut interlaced = vec![];
    let mut info = png::Info::with_size(SIZE.0, SIZE.1);
    (info.color_type, info.interlaced) = (png::ColorType::Rgb, true);
    let mut writer =
        png::Encoder::with_info(&mut interlaced, info).unwrap().write_header().unwrap();
    // The stream is too short for seven passes, but it begins like one.
    writer.write_chunk(png::chunk::IDAT, b"\x78\x01\x01\x04\x00\xfb\xff\x00\x07\x07\x07").unwrap();
    writer.finish().unwrap();
    vec![
        ("PNG", encode(Kind::Png, &image).unwrap()),
        ("PNG of 16 bits", encode(Kind::DeepPng, &image).unwrap()),
        ("interlaced PNG", interlaced),
        ("PFM", encode(Kind::Pfm, &image).unwrap()),
        ("EXR", exr::encode(SIZE, &[part], "notes").unwrap()),
    ]
}

/// Replaces one to four stretches of `bytes`. Half of the time it corrects the CRCs of a PNG.
fn mutated(bytes: &[u8], dice: &mut Rng) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + dice.usize(..4) {
        let at = dice.usize(..bytes.len() + 1);
        let end = (at + dice.usize(..6)).min(bytes.len());
        let put: Vec<u8> = match dice.usize(..4) {
            0 => vec![[0, 1, 0x7f, 0x80, 0xff][dice.usize(..5)]; end - at],
            1 => (0..dice.usize(..6)).map(|_| dice.u8(..)).collect(),
            2 => (at..end).map(|_| dice.u8(..)).collect(),
            _ => vec![],
        };
        bytes.splice(at..end, put);
    }
    if dice.usize(..2) == 0 { with_right_crcs(bytes) } else { bytes }
}

/// Corrects the CRC of every chunk of a PNG, so that the decoder gets the changed content.
fn with_right_crcs(mut bytes: Vec<u8>) -> Vec<u8> {
    let mut at = 8;
    while bytes.starts_with(b"\x89PNG") && at + 12 <= bytes.len() {
        let n = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let Some(end) = at.checked_add(8 + n).filter(|end| end + 4 <= bytes.len()) else { break };
        let crc = crc(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&crc.to_be_bytes());
        at = end + 4;
    }
    bytes
}

/// Returns the CRC of a PNG's chunk.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc)))
}

/// Reads `bytes` with both readers, which must agree.
fn read(bytes: &[u8]) -> Result<(), PictureError> {
    let _ = most_bytes(&bytes[..bytes.len().min(4096)]);
    let exact = read_exact(bytes, SIZE.0, SIZE.1);
    let rows = Rows::open(Cursor::new(bytes))
        .and_then(|rows| (rows.size() == SIZE).then(|| rows.into_image()).transpose());
    match (exact, rows) {
        (Ok(exact), rows) => {
            let rows = rows.expect("read whole, but not row by row").expect("the size demanded");
            assert_eq!(format!("{rows:?}"), format!("{exact:?}")); // as text, NaN equals NaN
            Ok(())
        }
        (Err(PictureError::Foreign { .. } | PictureError::Size { .. }), Ok(_)) => Ok(()),
        (Err(why), rows) => {
            assert!(!why.to_string().is_empty());
            if let (PictureError::Broken(_), Err(other)) = (&why, rows) {
                assert_eq!(why.to_string(), other.to_string(), "the readers do not agree");
            }
            Err(why)
        }
    }
}

/// Reads `n` mutations of every good picture.
fn check(n: usize) {
    let mut dice = Rng::with_seed(11);
    for (kind, bytes) in good() {
        let (mut n_read, mut n_refused) = (0, 0);
        for _ in 0..n {
            let mutation = mutated(&bytes, &mut dice);
            let read = catch_unwind(|| read(&mutation));
            match read.unwrap_or_else(|_| panic!("{kind}: {}", mutation.escape_ascii())) {
                Ok(()) => n_read += 1,
                Err(_) => n_refused += 1,
            }
        }
        assert!(
            n_refused > n / 4,
            "{kind}: {n_read} read, {n_refused} refused: the mutations are too tame"
        );
    }
}

#[test]
fn mutated_pictures_never_panic() {
    check(3000);
}

#[test]
fn arbitrary_bytes_never_panic() {
    let mut dice = Rng::with_seed(5);
    let heads: [&[u8]; 6] = [
        b"",
        b"\x89PNG\r\n\x1a\n",
        b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR",
        b"PF\n",
        b"PF\n13 11\n-1.0\n",
        b"\x76\x2f\x31\x01\x02\0\0\0",
    ];
    for head in heads {
        for _ in 0..2000 {
            let tail: Vec<u8> = (0..dice.usize(..200)).map(|_| dice.u8(..)).collect();
            let _ = read(&with_right_crcs([head, &tail].concat()));
        }
    }
}

/// Variable that the test below sets when it runs itself again in little memory.
const AGAIN: &str = "CASES_TEST_IN_LITTLE_MEMORY";

/// Returns files of a few hundred bytes whose headers claim gigabytes.
fn bombs() -> Vec<Vec<u8>> {
    let wide = |width: u32, height: u32, colour: png::ColorType, interlaced: bool| {
        let mut info = png::Info::with_size(width, height);
        (info.color_type, info.bit_depth, info.interlaced) =
            (colour, png::BitDepth::Sixteen, interlaced);
        let mut bytes = vec![];
        let mut writer = png::Encoder::with_info(&mut bytes, info).unwrap().write_header().unwrap();
        writer.write_chunk(png::chunk::IDAT, b"\x78\x9c\x63\x60").unwrap();
        writer.finish().unwrap();
        bytes
    };
    let exr = |side: i32| {
        let mut bytes = good().pop().unwrap().1;
        for window in ["dataWindow\0box2i\0\x10\0\0\0", "displayWindow\0box2i\0\x10\0\0\0"] {
            let at = bytes.windows(window.len()).position(|at| at == window.as_bytes()).unwrap()
                + window.len();
            bytes[at + 8..at + 16].copy_from_slice([(side - 1).to_le_bytes(); 2].as_flattened());
        }
        bytes
    };
    vec![
        wide(16_384, 16_384, png::ColorType::Rgba, false),
        wide(1 << 30, 1 << 30, png::ColorType::Rgba, false),
        wide(16_384, 16_384, png::ColorType::Rgba, true),
        b"PF\n16384 16384\n-1.0\n".to_vec(),
        b"PF\n8192 8192\n-1.0\n".to_vec(),
        b"PF\n4294967295 4294967295\n-1.0\n".to_vec(),
        exr(8192),
        exr(1 << 30),
        exr(i32::MAX),
    ]
}

#[test]
fn memory_is_bounded_whatever_a_file_promises() {
    if std::env::var_os(AGAIN).is_some() {
        for bomb in bombs() {
            assert!(
                Rows::open(Cursor::new(&bomb)).and_then(Rows::into_image).is_err(),
                "{}",
                bomb.escape_ascii()
            );
        }
        return check(300);
    }
    let script = "ulimit -v 400000; exec \"$0\" --exact \
        memory_is_bounded_whatever_a_file_promises --test-threads 1";
    let again = Command::new("sh")
        .args(["-c", script])
        .arg(std::env::current_exe().unwrap())
        .env(AGAIN, "1")
        .output();
    let output = again.unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}
