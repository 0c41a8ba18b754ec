//! Image files: what is written can be read, and what is no picture of the size asked for is refused with a reason.

use cases::film::{Image, Kind, PictureError, Quantiser, byte, encode, level, read_exact};
use glam::DVec3;

/// A picture that no two axes or channels can be swapped in unseen.
fn picture() -> Image {
    Image::from_fn(5, 3, |i, j| DVec3::new(f64::from(i) / 4.0, f64::from(j) / 2.0, f64::from(i + 5 * j) / 14.0))
}

/// Largest error of a channel after a trip through a file of that kind.
fn trip(kind: Kind) -> f64 {
    let bytes = encode(kind, &picture()).unwrap();
    let read = read_exact(&bytes, 5, 3).unwrap();
    let pairs = picture().pixels().to_vec().into_iter().zip(read.pixels().to_vec());
    pairs.map(|(wrote, read)| (wrote - read).abs().max_element()).fold(0.0, f64::max)
}

#[test]
fn what_is_written_is_read() {
    for (kind, most) in [(Kind::Png, 0.5 / 255.0), (Kind::DeepPng, 0.5 / 65535.0), (Kind::Pfm, f64::from(f32::EPSILON))]
    {
        let error = trip(kind);
        assert!(error <= most * 1.000_001, "{kind:?}: {error}");
    }
    assert!(trip(Kind::Png) > trip(Kind::DeepPng), "16 bits are no better than 8");
}

#[test]
fn light_is_quantised_by_rounding_and_clamping() {
    for (light, level) in
        [(0.0, 0), (1.0, 255), (0.5, 128), (0.498, 127), (-3.0, 0), (7.0, 255), (f64::NAN, 0), (f64::INFINITY, 255)]
    {
        assert_eq!(byte(light), level, "{light}");
    }
    let word = |light| Quantiser::Rounding.word(light);
    assert_eq!((word(0.5), word(2.0), word(f64::NAN)), (32768, 65535, 0));
    assert_eq!((level(0.5), level(2.0), level(-1.0)), (127.5, 255.0, 0.0));
    assert!(level(f64::NAN).is_nan());
    for (light, below) in [(0.0, 0), (1.0, 255), (0.5, 127), (0.999, 254), (-3.0, 0), (7.0, 255), (f64::NAN, 0)] {
        assert_eq!(Quantiser::Truncating.byte(light), below, "{light} truncated");
    }
    assert_eq!(Quantiser::Truncating.word(0.5), 32767);
}

/// What the refusal of `bytes` as a picture of 5×3 pixels says.
fn refusal(bytes: &[u8]) -> String {
    match read_exact(bytes, 5, 3) {
        Ok(_) => "accepted".to_owned(),
        Err(why) => why.to_string(),
    }
}

fn pfm(header: &str, n_floats: usize) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(bytes.len() + n_floats * 4, 0);
    bytes
}

#[test]
fn what_is_no_picture_of_that_size_is_refused() {
    let png = encode(Kind::Png, &picture()).unwrap();
    for (bytes, says) in [
        (vec![], "the file is empty"),
        (b"BM....".to_vec(), "bytes of a BMP"),
        (vec![0xff, 0xd8, 0xff], "bytes of a JPEG"),
        (b"P6 5 3 255".to_vec(), "bytes of a PPM"),
        (b"<svg/>".to_vec(), "a text or an SVG"),
        (vec![1, 2, 3], "no known kind"),
        (png[..png.len() / 2].to_vec(), "cannot be decoded"),
        (png[..8].to_vec(), "cannot be decoded"),
        (pfm("PF\n5 4\n-1.0\n", 60), "it is 5×4 pixels, not 5×3"),
        (pfm("PF\n4000000000 4000000000\n-1.0\n", 0), "pixels, not 5×3"),
        (pfm("PF\n5 3\n-1.0\n", 44), "promises 180 bytes of light, 176 follow"),
        (pfm("PF\n-5 3\n-1.0\n", 45), "where a number belongs"),
        (pfm("PF\n5 3\nnear\n", 45), "where a number belongs"),
        (pfm("PF\n5 3\n0\n", 45), "does not say the order of bytes"),
        (pfm("PF\n5 3\nNaN\n", 45), "does not say the order of bytes"),
        (pfm("PF\n5", 0), "the header ends early"),
        (pfm(&format!("PF\n{} 3\n-1.0\n", "5".repeat(40)), 45), "overlong"),
    ] {
        let said = refusal(&bytes);
        assert!(said.contains(says), "{said:?} does not say {says:?}");
    }
    assert!(matches!(read_exact(&png, 3, 5), Err(PictureError::Size { found: (5, 3), wanted: (3, 5) })));
    assert_eq!(refusal(&pfm("PF\n5 3\n-1.0\n", 45)), "accepted");
    assert_eq!(refusal(&pfm("Pf 5 3 1.0 ", 15)), "accepted");
}

#[test]
fn a_float_map_keeps_what_is_no_number_for_the_judge_to_see() {
    let wild = Image::from_fn(1, 1, |_, _| DVec3::new(f64::NAN, f64::INFINITY, -2.0));
    let read = read_exact(&encode(Kind::Pfm, &wild).unwrap(), 1, 1).unwrap().pixel(0, 0);
    assert!(read.x.is_nan());
    assert_eq!((read.y, read.z), (f64::INFINITY, -2.0));
}

#[test]
fn threads_that_put_the_same_file_do_not_meet() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    let put = || (0..50).try_for_each(|_| cases::film::replace(&path, b"whole"));
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|_| scope.spawn(put)).collect();
        threads.into_iter().for_each(|thread| thread.join().unwrap().unwrap());
    });
    assert_eq!(std::fs::read(&path).unwrap(), b"whole");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "a neighbour stayed behind");
}
