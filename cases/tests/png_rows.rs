//! PNGs of every kind, read row by row, hold the levels that they hold when read whole; what is no such PNG is refused or left to others.

use std::borrow::Cow;
use std::io::Cursor;

use cases::film::{PictureError, Rows, byte, read_exact};
use png::{BitDepth, ColorType, Info};

const WIDTH: u32 = 13;
const HEIGHT: u32 = 11;

/// A PNG of that kind whose samples are all different, as far as they can be.
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

/// The seven passes over an RGB picture: first column and row, steps along both; each row behind a filter byte of 0.
fn interlaced(sample: impl Fn(usize) -> u8) -> Vec<u8> {
    let passes = [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];
    let mut bytes = vec![];
    for [x, y, along, down] in passes {
        for row in (y..HEIGHT as usize).step_by(down) {
            bytes.push(0);
            let columns = (x..WIDTH as usize).step_by(along);
            bytes.extend(columns.flat_map(|column| [0, 1, 2].map(|c| sample((row * WIDTH as usize + column) * 3 + c))));
        }
    }
    bytes
}

/// `bytes` as a zlib stream of one block that is not compressed.
fn stored(bytes: &[u8]) -> Vec<u8> {
    let n = u16::try_from(bytes.len()).unwrap();
    let (a, b) = bytes.iter().fold((1, 0), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65521;
        (a, (b + a) % 65521)
    });
    [&[0x78, 0x01, 0x01][..], &n.to_le_bytes(), &(!n).to_le_bytes(), bytes, &(b << 16 | a).to_be_bytes()].concat()
}

/// The levels row by row, some rows at a time.
fn by_rows(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut rows = Rows::open(Cursor::new(bytes), 64).unwrap()?;
    assert_eq!((rows.width, rows.height), (WIDTH, HEIGHT));
    let mut levels = vec![0; (WIDTH * HEIGHT * 3) as usize];
    levels.chunks_mut(WIDTH as usize * 3 * 4).for_each(|some| rows.read(some).unwrap());
    let more = rows.read(&mut [0; WIDTH as usize * 3]);
    assert!(matches!(more, Err(PictureError::Broken(_))), "a row below the last");
    Some(levels)
}

fn check(what: &str, bytes: &[u8]) {
    let whole = read_exact(bytes, WIDTH, HEIGHT).unwrap();
    let levels: Vec<u8> = whole.pixels().iter().flat_map(|pixel| pixel.to_array()).map(byte).collect();
    assert!(levels.iter().any(|level| *level != levels[0]), "{what} shows nothing");
    assert_eq!(by_rows(bytes).unwrap_or_else(|| panic!("{what} is left to others")), levels, "{what}");
}

#[test]
fn rows_hold_what_the_whole_picture_holds() {
    let palette = || Cow::Owned((0..=255u8).flat_map(|n| [n, n.wrapping_mul(3), !n]).collect::<Vec<u8>>());
    let plain = |_: &mut Info<'static>| {};
    let with_palette = |info: &mut Info<'static>| info.palette = Some(palette());
    let with_holes =
        |info: &mut Info<'static>| (info.palette, info.trns) = (Some(palette()), Some(Cow::Owned(vec![0, 9, 90])));
    for (what, bytes) in [
        ("colour", picture(ColorType::Rgb, BitDepth::Eight, plain)),
        ("colour and alpha", picture(ColorType::Rgba, BitDepth::Eight, plain)),
        ("grey", picture(ColorType::Grayscale, BitDepth::Eight, plain)),
        ("grey and alpha", picture(ColorType::GrayscaleAlpha, BitDepth::Eight, plain)),
        ("grey of 1 bit", picture(ColorType::Grayscale, BitDepth::One, plain)),
        ("grey of 4 bits", picture(ColorType::Grayscale, BitDepth::Four, plain)),
        ("palette", picture(ColorType::Indexed, BitDepth::Eight, with_palette)),
        ("palette of 2 bits", picture(ColorType::Indexed, BitDepth::Two, with_palette)),
        ("palette with alpha", picture(ColorType::Indexed, BitDepth::Eight, with_holes)),
        ("interlaced", picture(ColorType::Rgb, BitDepth::Eight, |info| info.interlaced = true)),
    ] {
        check(what, &bytes);
    }
    let [plain, interlaced] =
        [false, true].map(|is| by_rows(&picture(ColorType::Rgb, BitDepth::Eight, |info| info.interlaced = is)));
    assert_eq!(plain, interlaced, "the order of rows in the file shows");
}

#[test]
fn what_is_no_picture_of_8_bits_is_left_to_others_or_refused() {
    for colour in [ColorType::Grayscale, ColorType::GrayscaleAlpha, ColorType::Rgb, ColorType::Rgba] {
        let deep = picture(colour, BitDepth::Sixteen, |_| {});
        assert_eq!(by_rows(&deep), None, "{colour:?} of 16 bits");
        assert!(read_exact(&deep, WIDTH, HEIGHT).is_ok());
    }
    assert_eq!(by_rows(b"P6 5 3 255"), None);
    assert_eq!(by_rows(b""), None);
    let png = picture(ColorType::Rgb, BitDepth::Eight, |_| {});
    let open = |bytes: &[u8], most| Rows::open(Cursor::new(bytes.to_vec()), most).map(|rows| rows.is_some());
    assert!(matches!(open(&png, 12), Err(PictureError::Size { found: (WIDTH, HEIGHT), wanted: (12, 12) })));
    assert!(matches!(open(&png[..20], 64), Err(PictureError::Broken(_))));
    let mut rows = Rows::open(Cursor::new(&png[..png.len() / 2]), 64).unwrap().unwrap();
    assert!(
        matches!(rows.read(&mut vec![0; (WIDTH * HEIGHT * 3) as usize]), Err(PictureError::Broken(_))),
        "half a file"
    );
}
