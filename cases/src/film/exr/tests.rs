//! Tests of `exr.rs`.

use super::*;

const SIZE: (u32, u32) = (7, 5);

/// Returns the multiples of `scale`. Half precision holds multiples of a sixteenth exactly.
fn plane(name: &str, scale: f32, depth: Depth) -> Plane {
    Plane { name: name.to_owned(), samples: (0..35).map(|n| n as f32 * scale).collect(), depth }
}

fn two_parts() -> Vec<Part> {
    let first = vec![plane("R", 0.1, Depth::Float), plane("lo.R", -0.0625, Depth::Half)];
    let second = vec![plane("no_shadows.R", 0.5, Depth::Half)];
    [("answer", first), ("mistakes", second)]
        .map(|(name, planes)| {
            let attached = if name == "answer" { vec![] } else { (0..100).collect() };
            Part { name: name.to_owned(), planes, attached }
        })
        .into()
}

#[test]
fn parts_and_notes_come_back_bit_for_bit() {
    let bytes = encode(SIZE, &two_parts(), "{\"slack\":1}").unwrap();
    assert_eq!(decode(&bytes, 7, 5).unwrap(), (two_parts(), "{\"slack\":1}".to_owned()));
    assert_eq!(
        decode_first(&bytes, 7, 5).unwrap(),
        (two_parts().remove(0), "{\"slack\":1}".to_owned())
    );
    assert_eq!(attached(&bytes, "mistakes").unwrap(), two_parts()[1].attached);
    assert!(attached(&bytes, "unheard_of").unwrap().is_empty());
}

#[test]
fn the_same_content_gives_the_same_bytes() {
    assert_eq!(encode(SIZE, &two_parts(), "x").unwrap(), encode(SIZE, &two_parts(), "x").unwrap());
}

#[test]
fn another_size_is_refused() {
    let bytes = encode(SIZE, &two_parts(), "").unwrap();
    for error in [decode(&bytes, 8, 5).unwrap_err(), decode_first(&bytes, 8, 5).unwrap_err()] {
        assert!(matches!(error, PictureError::Size { found: (7, 5), wanted: (8, 5) }), "{error}");
    }
    assert!(encode((8, 5), &two_parts(), "").is_err());
    assert!(encode(SIZE, &[], "").is_err());
}

#[test]
fn a_plane_that_is_not_there_is_named() {
    let error = two_parts()[1].plane("no_shadows.G").unwrap_err();
    assert!(error.to_string().contains("part \"mistakes\" has no plane no_shadows.G"), "{error}");
}

#[test]
fn every_cut_and_every_broken_byte_is_an_error_or_a_picture_but_no_panic() {
    let bytes = encode(SIZE, &two_parts(), "notes").unwrap();
    for end in 0..bytes.len() {
        assert!(decode(&bytes[..end], 7, 5).is_err(), "cut at {end}");
    }
    for at in 0..bytes.len() {
        let mut broken = bytes.clone();
        broken[at] ^= 0x55;
        let _ = decode(&broken, 7, 5);
        let _ = decode_first(&broken, 7, 5);
    }
}
