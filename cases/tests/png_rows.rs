//! Tests that both readers of PNGs give the same levels for every kind of file, and refuse the same
//! damaged files.

use std::borrow::Cow;
use std::io::Cursor;

use cases::film::{PictureError, Rows, byte, read_exact};
use png::{BitDepth, ColorType, Info};

const WIDTH: u32 = 13;
const HEIGHT: u32 = 11;

/// Returns a PNG of that kind whose samples are all different, as far as they can be.
fn picture(colour: ColorType, depth: BitDepth, extra: impl Fn(&mut Info<'static>)) -> Vec<u8> {
    let mut info = Info::with_size(WIDTH, HEIGHT);
    (info.color_type, info.bit_depth) = (colour, depth);
    extra(&mut info);
    let (is_interlaced, n) = (info.interlaced, info.raw_bytes() - HEIGHT as usize);
    let mut bytes = vec![];
    let mut writer = png::Encoder::with_info(&mut bytes, info).unwrap().write_header().unwrap();
    let sample = |i: usize| (i * 37 % 251) as u8;
    match is_interlaced {
        true => writer.write_chunk(png::chunk::IDAT, &stored(&interlaced(sample))).unwrap(),
        false => writer.write_image_data(&(0..n).map(sample).collect::<Vec<u8>>()).unwrap(),
    }
    writer.finish().unwrap();
    bytes
}

/// Returns the seven passes over an RGB picture, with a filter byte of 0 before each row. A pass is
/// given by its first column and row, and by the steps along both.
fn interlaced(sample: impl Fn(usize) -> u8) -> Vec<u8> {
    let passes = [
        [0, 0, 8, 8],
        [4, 0, 8, 8],
        [0, 4, 4, 8],
        [2, 0, 4, 4],
        [0, 2, 2, 4],
        [1, 0, 2, 2],
        [0, 1, 1, 2],
    ];
    let mut bytes = vec![];
    for [x, y, along, down] in passes {
        for row in (y..HEIGHT as usize).step_by(down) {
            bytes.push(0);
            let columns = (x..WIDTH as usize).step_by(along);
            bytes.extend(columns.flat_map(|column| {
                [0, 1, 2].map(|c| sample((row * WIDTH as usize + column) * 3 + c))
            }));
        }
    }
    bytes
}

/// Returns `bytes` as a zlib stream of one block that is not compressed.
fn stored(bytes: &[u8]) -> Vec<u8> {
    let n = u16::try_from(bytes.len()).unwrap();
    let (a, b) = bytes.iter().fold((1, 0), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65521;
        (a, (b + a) % 65521)
    });
    [
        &[0x78, 0x01, 0x01][..],
        &n.to_le_bytes(),
        &(!n).to_le_bytes(),
        bytes,
        &(b << 16 | a).to_be_bytes(),
    ]
    .concat()
}

/// Reads the levels row by row. The result is `None` for a PNG of 16 bits.
fn by_rows(bytes: &[u8]) -> Result<Option<Vec<u8>>, PictureError> {
    let mut rows = Rows::open(Cursor::new(bytes))?;
    assert_eq!(rows.size(), (WIDTH, HEIGHT));
    let mut levels = vec![0; (WIDTH * HEIGHT * 3) as usize];
    let some = WIDTH as usize * 3 * 4;
    if !rows.has_bytes() {
        assert!(
            matches!(rows.bytes(&mut levels[..some]), Err(PictureError::Broken(_))),
            "words given as bytes"
        );
        let mut words = vec![0.0; levels.len()];
        words.chunks_mut(some).try_for_each(|part| rows.words(part))?;
        return Ok(None);
    }
    levels.chunks_mut(some).try_for_each(|part| rows.bytes(part))?;
    let more = rows.bytes(&mut [0; WIDTH as usize * 3]);
    assert!(matches!(more, Err(PictureError::Broken(_))), "a row below the last");
    Ok(Some(levels))
}

fn check(what: &str, bytes: &[u8]) {
    let whole = read_exact(bytes, WIDTH, HEIGHT).unwrap();
    let levels: Vec<u8> =
        whole.pixels().iter().flat_map(|pixel| pixel.to_array()).map(byte).collect();
    assert!(levels.iter().any(|level| *level != levels[0]), "{what} shows nothing");
    assert_eq!(
        by_rows(bytes).unwrap().unwrap_or_else(|| panic!("{what} has words")),
        levels,
        "{what}"
    );
}

#[test]
fn rows_hold_what_the_whole_picture_holds() {
    let palette =
        || Cow::Owned((0..=255u8).flat_map(|n| [n, n.wrapping_mul(3), !n]).collect::<Vec<u8>>());
    let plain = |_: &mut Info<'static>| {};
    let with_palette = |info: &mut Info<'static>| info.palette = Some(palette());
    let with_holes = |info: &mut Info<'static>| {
        (info.palette, info.trns) = (Some(palette()), Some(Cow::Owned(vec![0, 9, 90])))
    };
    let grey_hole = |info: &mut Info<'static>| info.trns = Some(Cow::Owned(vec![0, 37]));
    for (what, bytes) in [
        ("colour", picture(ColorType::Rgb, BitDepth::Eight, plain)),
        ("colour and alpha", picture(ColorType::Rgba, BitDepth::Eight, plain)),
        ("grey", picture(ColorType::Grayscale, BitDepth::Eight, plain)),
        ("grey and alpha", picture(ColorType::GrayscaleAlpha, BitDepth::Eight, plain)),
        (
            "grey with a transparent level",
            picture(ColorType::Grayscale, BitDepth::Eight, grey_hole),
        ),
        ("grey of 1 bit", picture(ColorType::Grayscale, BitDepth::One, plain)),
        ("grey of 2 bits", picture(ColorType::Grayscale, BitDepth::Two, plain)),
        ("grey of 4 bits", picture(ColorType::Grayscale, BitDepth::Four, plain)),
        ("palette", picture(ColorType::Indexed, BitDepth::Eight, with_palette)),
        ("palette of 1 bit", picture(ColorType::Indexed, BitDepth::One, with_palette)),
        ("palette of 2 bits", picture(ColorType::Indexed, BitDepth::Two, with_palette)),
        ("palette with alpha", picture(ColorType::Indexed, BitDepth::Eight, with_holes)),
        ("interlaced", picture(ColorType::Rgb, BitDepth::Eight, |info| info.interlaced = true)),
    ] {
        check(what, &bytes);
    }
    let [plain, interlaced] = [false, true].map(|is| {
        by_rows(&picture(ColorType::Rgb, BitDepth::Eight, |info| info.interlaced = is)).unwrap()
    });
    assert_eq!(plain, interlaced, "the order of rows in the file shows");
}

#[test]
fn all_sixteen_bits_are_kept() {
    for (colour, n_channels) in [
        (ColorType::Grayscale, 1),
        (ColorType::GrayscaleAlpha, 2),
        (ColorType::Rgb, 3),
        (ColorType::Rgba, 4),
    ] {
        let deep = picture(colour, BitDepth::Sixteen, |_| {});
        assert_eq!(by_rows(&deep).unwrap(), None, "{colour:?}");
        let sample = |n: usize| (n * 37 % 251) as u16;
        let second = n_channels; // the red sample of the second pixel
        let expected = f64::from(sample(2 * second) << 8 | sample(2 * second + 1)) / 65535.0;
        assert_eq!(read_exact(&deep, WIDTH, HEIGHT).unwrap().pixel(1, 0).x, expected, "{colour:?}");
    }
}

/// Returns a PNG with another chunk before its pixels.
fn with_chunk(kind: &[u8; 4], body: &[u8]) -> Vec<u8> {
    let mut info = Info::with_size(WIDTH, HEIGHT);
    (info.color_type, info.bit_depth) = (ColorType::Rgb, BitDepth::Eight);
    let mut bytes = vec![];
    let mut writer = png::Encoder::with_info(&mut bytes, info).unwrap().write_header().unwrap();
    writer.write_chunk(png::chunk::ChunkType(*kind), body).unwrap();
    writer.write_image_data(&[7; (WIDTH * HEIGHT * 3) as usize]).unwrap();
    writer.finish().unwrap();
    bytes
}

/// Returns the error of both readers, which must be the same.
fn refusal(what: &str, bytes: &[u8]) -> String {
    let [whole, rows] = [read_exact(bytes, WIDTH, HEIGHT).map(drop), by_rows(bytes).map(drop)]
        .map(|read| read.map_or_else(|why| why.to_string(), |()| "accepted".to_owned()));
    assert_eq!(
        whole,
        rows.replace("PNG, PFM or EXR", "PNG or PFM"),
        "{what}: the readers do not agree"
    );
    whole
}

#[test]
fn a_damaged_file_is_refused_by_both_readers_alike() {
    for (what, bytes) in [
        ("8 bits", picture(ColorType::Rgb, BitDepth::Eight, |_| {})),
        ("16 bits", picture(ColorType::Rgb, BitDepth::Sixteen, |_| {})),
        ("interlaced", picture(ColorType::Rgb, BitDepth::Eight, |info| info.interlaced = true)),
    ] {
        assert_eq!(refusal(what, &bytes), "accepted");
        let find = |kind: &[u8]| bytes.windows(4).position(|at| at == kind).unwrap();
        let flip = |at: usize| {
            bytes
                .iter()
                .enumerate()
                .map(|(n, byte)| if n == at { byte ^ 1 } else { *byte })
                .collect()
        };
        let (data, end) = (find(b"IDAT"), bytes.len());
        for (damage, bytes, says) in [
            ("a bit of the header", flip(28), "the PNG is damaged: CRC error"),
            ("a bit of the CRC of the header", flip(30), "the PNG is damaged: CRC error"),
            ("a bit of the pixels", flip(data + 20), "the PNG is damaged"),
            ("a bit of the CRC of the pixels", flip(end - 13), "the PNG is damaged: CRC error"),
            ("a bit of the CRC of the end mark", flip(end - 1), "while decoding IEND chunk"),
            ("no end mark", bytes[..end - 12].to_vec(), "ends early, before its end mark (IEND)"),
            (
                "no CRC of the end mark",
                bytes[..end - 4].to_vec(),
                "ends early, before its end mark (IEND)",
            ),
            ("half of it", bytes[..end / 2].to_vec(), "ends early, before its end mark (IEND)"),
            ("no pixels", [&bytes[..data - 4], &bytes[end - 12..]].concat(), "the PNG is damaged"),
            ("other letters", flip(data), "the PNG is damaged"),
        ] {
            let said = refusal(damage, &bytes);
            assert!(said.contains(says), "{what}, {damage}: {said}");
        }
    }
}

#[test]
fn what_stands_beside_the_pixels_must_be_whole_but_counts_for_nothing() {
    let note = with_chunk(b"tEXt", b"Comment\0made by hand");
    assert_eq!(refusal("a note", &note), "accepted");
    let at = note.windows(4).position(|at| at == b"made").unwrap();
    let broken: Vec<u8> =
        note.iter().enumerate().map(|(n, byte)| if n == at { byte ^ 1 } else { *byte }).collect();
    assert!(refusal("a broken note", &broken).contains("the PNG is damaged: CRC error"));
    assert_eq!(refusal("bytes after the end mark", &[&note[..], b"more"].concat()), "accepted");
    assert_eq!(
        refusal("a profile that is none", &with_chunk(b"iCCP", b"x\0\0no zlib stream")),
        "accepted"
    );
    let huge = with_chunk(b"eXIf", &vec![0; 20 << 20]);
    assert!(refusal("20 MiB of notes", &huge).contains("beside its pixels has more than"));
    assert!(refusal("an unknown chunk", &with_chunk(b"BANG", b"x")).contains("the PNG is damaged"));
}

#[test]
fn of_an_animation_the_still_picture_counts() {
    let still = [9; (WIDTH * HEIGHT * 3) as usize];
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, WIDTH, HEIGHT);
    encoder.set_color(ColorType::Rgb);
    encoder.set_animated(2, 0).unwrap();
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&still).unwrap();
    writer.write_image_data(&[200; (WIDTH * HEIGHT * 3) as usize]).unwrap();
    writer.finish().unwrap();
    assert_eq!(by_rows(&bytes).unwrap().unwrap(), still);
    assert!(
        read_exact(&bytes, WIDTH, HEIGHT).unwrap().pixels().iter().all(|pixel| byte(pixel.x) == 9)
    );
}

#[test]
fn what_became_of_a_png_on_its_way_is_named() {
    let png = picture(ColorType::Rgb, BitDepth::Eight, |_| {});
    let rest = &png[8..];
    let apple = [&png[..8], b"\0\0\0\x04CgBI\x50\0\x20\x02\x2b\xd5\xb3\x7f", rest].concat();
    for (what, bytes, says) in [
        ("LF became CR LF", [b"\x89PNG\r\r\n\x1a\r\n", rest].concat(), "text mode"),
        ("CR LF became LF", [b"\x89PNG\n\x1a\n", rest].concat(), "text mode"),
        ("CR LF became CR", [b"\x89PNG\r\x1a\r", rest].concat(), "text mode"),
        ("7 bits", [b"\tPNG\r\n\x1a\n", rest].concat(), "text mode"),
        ("UTF-8", ["\u{fffd}PNG\r\n\u{1a}\n".as_bytes(), rest].concat(), "text mode"),
        ("Latin-1 as UTF-8", ["\u{89}PNG\r\n\u{1a}\n".as_bytes(), rest].concat(), "text mode"),
        ("a damaged signature", [b"\x89PNG\0\0\0\0", rest].concat(), "first bytes are damaged"),
        ("Apple's own", apple, "iOS-optimised PNG (CgBI)"),
        ("no PNG", b"P6 5 3 255".to_vec(), "bytes of a PPM"),
    ] {
        let said = refusal(what, &bytes);
        assert!(said.contains(says) && !said.contains("pixels"), "{what}: {said}");
    }
}

#[test]
fn a_size_out_of_bounds_is_refused_before_anything_is_decoded() {
    let sized = |kind: &str, width: u32, height: u32| match kind {
        "PFM" => format!("PF\n{width} {height}\n-1.0\n").into_bytes(),
        _ => {
            let mut info = Info::with_size(width, height);
            info.interlaced = kind == "interlaced";
            let mut bytes = vec![];
            drop(png::Encoder::with_info(&mut bytes, info).unwrap().write_header());
            bytes
        }
    };
    for (kind, width, height, most) in [
        ("PNG", 16_385, 1, "at most 16384×16384"),
        ("PNG", 1, 2_000_000_000, "at most 16384×16384"),
        ("interlaced", 16_384, 16_384, "at most 67108864 pixels"),
        ("PFM", 16_385, 1, "at most 16384×16384"),
        ("PFM", 4_000_000_000, 4_000_000_000, "at most 16384×16384"),
        ("PFM", 16_384, 16_384, "at most 67108864 pixels"),
    ] {
        let said = Rows::open(Cursor::new(sized(kind, width, height))).err().unwrap().to_string();
        assert!(
            said.contains(&format!("{width}×{height}")) && said.contains(most),
            "{kind}: {said}"
        );
    }
    let png = sized("PNG", 16_384, 16_384);
    assert!(
        !Rows::open(Cursor::new(png)).err().unwrap().to_string().contains("at most"),
        "too strict"
    );
}
