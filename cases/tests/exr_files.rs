//! Tests that an OpenEXR file counts as the planes R, G and B of its first part.

use std::io::Cursor;

use cases::Course;
use cases::answer::{Digest, ImageAnswer};
use cases::film::exr::{Depth, Part, Plane, encode, rgb};
use cases::film::{Image, Rows, WORDS_IN_BYTE, byte};
use exr::meta::attribute::IntegerBounds;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image as Exr, ImageAttributes,
    Layer, LayerAttributes, SpecificChannels, WritableImage,
};
use glam::DVec3;

const SIZE: (u32, u32) = (5, 3);

/// Returns a picture with light below 0 and above 1. Swapping two axes or channels would change it.
fn picture() -> Image {
    Image::from_fn(5, 3, |i, j| {
        DVec3::new(f64::from(i) / 4.0 - 0.5, f64::from(j), f64::from(i + 5 * j) / 16.0)
    })
}

/// Returns all samples of the picture in 16-bit levels.
fn words(bytes: &[u8]) -> Result<Vec<f64>, String> {
    let mut rows = Rows::open(Cursor::new(bytes)).map_err(|why| why.to_string())?;
    assert_eq!((rows.size(), rows.has_bytes()), (SIZE, false));
    let mut words = vec![0.0; 45];
    let (first, others) = words.split_at_mut(15);
    rows.words(first).and_then(|()| rows.words(others)).map_err(|why| why.to_string())?;
    assert!(rows.words(&mut [0.0; 15]).is_err(), "a row below the last");
    Ok(words)
}

#[test]
fn a_rendered_file_is_read_as_it_was_written() {
    let part =
        |name: &str, planes: Vec<Plane>| Part { name: name.to_owned(), planes, attached: vec![] };
    let expected: Vec<f64> = picture()
        .pixels()
        .iter()
        .flat_map(|pixel| pixel.to_array().map(|light| light * 65535.0))
        .collect();
    for depth in [Depth::Float, Depth::Half] {
        let main = part("colour", rgb("", &picture(), depth).into());
        let other = part("other", rgb("", &Image::from_fn(5, 3, |_, _| DVec3::ONE), depth).into());
        assert_eq!(
            words(&encode(SIZE, &[main, other], "").unwrap()).unwrap(),
            expected,
            "{depth:?}"
        );
    }
    let grey = part("grey", rgb("", &picture(), Depth::Float)[..2].to_vec());
    assert!(
        words(&encode(SIZE, &[grey], "").unwrap())
            .unwrap_err()
            .contains("its first part has no plane B")
    );
}

#[test]
fn a_stored_answer_counts_as_the_picture_that_it_expects() {
    let answer = ImageAnswer::exact(picture(), 1.0, 0);
    let levels: Vec<f64> = picture()
        .pixels()
        .iter()
        .flat_map(|pixel| pixel.to_array().map(|light| f64::from(byte(light)) * WORDS_IN_BYTE))
        .collect();
    assert_eq!(
        words(&answer.encode(&Digest::of_mistakes(&Course::default()), &[]).unwrap()).unwrap(),
        levels
    );
}

/// Returns a file of one layer at `at` in a picture of `shown` pixels, made with the crate alone.
fn file(
    at: (i32, i32),
    shown: (usize, usize),
    channel: fn(usize) -> FlatSamples,
    compression: Compression,
) -> Vec<u8> {
    let channels = ["B", "G", "R"].map(|name| AnyChannel::new(name, channel(15)));
    let attributes = LayerAttributes { layer_position: at.into(), ..LayerAttributes::named("x") };
    let encoding = Encoding { compression, ..Encoding::FAST_LOSSLESS };
    let layer =
        Layer::new((5, 3), attributes, encoding, AnyChannels::sort(channels.into_iter().collect()));
    let picture = ImageAttributes::new(IntegerBounds::from_dimensions(shown));
    let mut bytes = vec![];
    let image = Exr { attributes: picture, layer_data: layer };
    image.write().non_parallel().to_buffered(Cursor::new(&mut bytes)).unwrap();
    bytes
}

fn floats(n: usize) -> FlatSamples {
    FlatSamples::F32((0..n).map(|n| n as f32 / 8.0).collect())
}

#[test]
fn files_of_other_programs_are_read_where_they_show_a_whole_picture() {
    let lossless = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
    ];
    let expected: Vec<f64> = (0..45).map(|n| f64::from(n / 3) / 8.0 * 65535.0).collect();
    for compression in lossless {
        assert_eq!(
            words(&file((0, 0), (5, 3), floats, compression)).unwrap(),
            expected,
            "{compression:?}"
        );
    }
    for (what, bytes, says) in [
        ("moved", file((1, 0), (5, 3), floats, Compression::ZIP1), "it is a part of a picture"),
        ("a part", file((0, 0), (6, 3), floats, Compression::ZIP1), "it is a part of a picture"),
        (
            "numbers",
            file((0, 0), (5, 3), |n| FlatSamples::U32(vec![7; n]), Compression::ZIP1),
            "plane R holds whole numbers, not light",
        ),
        ("no file", b"\x76\x2f\x31\x01".to_vec(), "it cannot be decoded"),
    ] {
        let said = words(&bytes).unwrap_err();
        assert!(said.contains(says), "{what}: {said}");
    }
}

/// Reads a stored answer of 7 × 5 pixels in which some bytes were changed. The decoder panics at
/// it.
#[test]
fn a_file_whose_blocks_do_not_fit_is_damaged() {
    let bytes = include_bytes!("pictures/short_blocks.exr");
    let why = ImageAnswer::decode(bytes, 7, 5).unwrap_err().to_string();
    assert!(why.contains("its blocks do not fit its header"), "{why}");
}

#[test]
fn tiles_are_read_as_lines_are() {
    let channels = SpecificChannels::rgb(|at: exr::math::Vec2<usize>| {
        let light = (at.y() * 5 + at.x()) as f32 / 8.0;
        (light, light, light)
    });
    let encoding = Encoding {
        blocks: exr::image::Blocks::Tiles(exr::math::Vec2(2, 2)),
        compression: Compression::ZIP16,
        line_order: exr::meta::attribute::LineOrder::Unspecified,
    };
    let layer = Layer::new((5, 3), LayerAttributes::named("x"), encoding, channels);
    let mut bytes = vec![];
    Exr::from_layer(layer).write().non_parallel().to_buffered(Cursor::new(&mut bytes)).unwrap();
    let expected: Vec<f64> = (0..45).map(|n| f64::from(n / 3) / 8.0 * 65535.0).collect();
    assert_eq!(words(&bytes).unwrap(), expected);
}
