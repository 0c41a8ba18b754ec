//! Tests of image files: what is written can be read, and other files are refused with a reason.

use cases::film::{Image, Kind, PictureError, Quantiser, byte, encode, level, read_exact};
use glam::DVec3;

/// Returns a picture in which no two axes or channels can be swapped unnoticed.
fn picture() -> Image {
    Image::from_fn(5, 3, |i, j| {
        DVec3::new(f64::from(i) / 4.0, f64::from(j) / 2.0, f64::from(i + 5 * j) / 14.0)
    })
}

/// Returns the largest error of a channel after a picture was written and read as that kind.
fn trip(kind: Kind) -> f64 {
    let bytes = encode(kind, &picture()).unwrap();
    let read = read_exact(&bytes, 5, 3).unwrap();
    let pairs = picture().pixels().to_vec().into_iter().zip(read.pixels().to_vec());
    pairs.map(|(wrote, read)| (wrote - read).abs().max_element()).fold(0.0, f64::max)
}

#[test]
fn what_is_written_is_read() {
    for (kind, most) in [
        (Kind::Png, 0.5 / 255.0),
        (Kind::DeepPng, 0.5 / 65535.0),
        (Kind::Pfm, f64::from(f32::EPSILON)),
    ] {
        let error = trip(kind);
        assert!(error <= most * 1.000_001, "{kind:?}: {error}");
    }
    assert!(trip(Kind::Png) > trip(Kind::DeepPng), "16 bits are no better than 8");
}

#[test]
fn light_is_quantised_by_rounding_and_clamping() {
    for (light, level) in [
        (0.0, 0),
        (1.0, 255),
        (0.5, 128),
        (0.498, 127),
        (-3.0, 0),
        (7.0, 255),
        (f64::NAN, 0),
        (f64::INFINITY, 255),
    ] {
        assert_eq!(byte(light), level, "{light}");
    }
    let word = |light| Quantiser::Rounding.word(light);
    assert_eq!((word(0.5), word(2.0), word(f64::NAN)), (32768, 65535, 0));
    assert_eq!((level(0.5), level(2.0), level(-1.0)), (127.5, 255.0, 0.0));
    assert!(level(f64::NAN).is_nan());
    for (light, below) in
        [(0.0, 0), (1.0, 255), (0.5, 127), (0.999, 254), (-3.0, 0), (7.0, 255), (f64::NAN, 0)]
    {
        assert_eq!(Quantiser::Truncating.byte(light), below, "{light} truncated");
    }
    assert_eq!(Quantiser::Truncating.word(0.5), 32767);
}

/// Returns the reason why `bytes` are refused as a picture of 5×3 pixels.
fn refusal(bytes: &[u8]) -> String {
    match read_exact(bytes, 5, 3) {
        Ok(_) => "accepted".to_owned(),
        Err(why) => why.to_string(),
    }
}

/// Returns a PFM of this header and `n_bytes` bytes, which count up from 0.
fn pfm(header: &str, n_bytes: usize) -> Vec<u8> {
    let light = (0..n_bytes).map(|n| (n % 127) as u8);
    header.bytes().chain(light).collect()
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
        (b"II*\0".to_vec(), "bytes of a TIFF"),
        (b"RIFF....WEBP".to_vec(), "bytes of a WebP"),
        (b"#?RADIANCE".to_vec(), "Radiance"),
        (
            b"\x76\x2f\x31\x01".to_vec(),
            "not a PNG or PFM image: these are the bytes of an OpenEXR file",
        ),
        (vec![1, 2, 3], "no known kind"),
        (png[..png.len() / 2].to_vec(), "ends early"),
        (png[..8].to_vec(), "ends early"),
        (pfm("PF\n5 4\n-1.0\n", 240), "it is 5×4 pixels, not 5×3"),
        (pfm("PF\n4000000000 4000000000\n-1.0\n", 0), "pixels, not 5×3"),
        (pfm("PF\n5 3\n-1.0\n", 176), "demands 180 bytes of floats, 176 follow: 4 too few"),
        (pfm("PF\n5 3\n-1.0\n", 192), "180 bytes of floats, 192 follow: 12 too many"),
        (pfm("Pf\n5 3\n-1.0\n", 180), "60 bytes of floats, 180 follow: 120 too many"),
        (pfm("PF\n-5 3\n-1.0\n", 180), "where a number belongs"),
        (pfm("PF\n5 3\nnear\n", 180), "where a number belongs"),
        (pfm("PF\n5 3\n0\n", 180), "does not say the order of bytes"),
        (pfm("PF\n5 3\nNaN\n", 180), "does not say the order of bytes"),
        (pfm("PF\n5 3\n-inf\n", 180), "does not say the order of bytes"),
        (pfm("PF\n5", 0), "the header ends early"),
        (pfm("PF\n5 3 # -1.0", 0), "the header ends early"),
        (pfm(&format!("PF\n#{}\n5 3\n-1.0\n", "x".repeat(4096)), 180), "the header does not end"),
        (pfm(&format!("PF\n{} 3\n-1.0\n", "5".repeat(40)), 180), "overlong"),
        (pfm("PF\n5\u{e9} 3\n-1.0\n", 180), "where a number belongs"),
        (pfm("PFM\n5 3\n-1.0\n", 180), "a letter after"),
    ] {
        let said = refusal(&bytes);
        assert!(said.contains(says), "{said:?} does not say {says:?}");
    }
    assert!(matches!(
        read_exact(&png, 3, 5),
        Err(PictureError::Size { found: (5, 3), wanted: (3, 5) })
    ));
}

#[test]
fn a_header_of_any_line_end_is_read_alike() {
    let plain = read_exact(&pfm("PF\n5 3\n-1.0\n", 180), 5, 3).unwrap();
    assert_ne!(plain.pixel(0, 0), plain.pixel(4, 2), "all pixels are alike");
    for header in [
        "PF\r\n5 3\r\n-1.0\r\n",
        "PF\r5 3\r-1.0\r",
        "PF 5 3 -1.0 ",
        "PF\n5 3\n-1.0\r\n",
        "PF\n5 3\n-1.0\r",
        "PF\n5\n\t3\n-0.25\t",
        "PF\n# made by a tracer\n5 3 # width and height\n-1.0\n",
        "PF\r\n# made on Windows\r\n5 3\r\n-1.0\r\n",
    ] {
        assert_eq!(read_exact(&pfm(header, 180), 5, 3).unwrap(), plain, "{header:?}");
    }
    // The light may begin with what looks like a line end.
    let mut bytes = pfm("PF\n5 3\n-1.0\r", 180);
    bytes[13] = b'\n';
    assert_eq!(
        read_exact(&bytes, 5, 3).unwrap().pixel(0, 2).y,
        plain.pixel(0, 2).y,
        "shifted by a byte"
    );
    // The sign of the scale gives the order of bytes: here 1.0 in big-endian floats, grey.
    let grey = [&b"Pf\n2 1\n+1.0\n"[..], &1.0f32.to_be_bytes(), &0.5f32.to_be_bytes()].concat();
    assert_eq!(read_exact(&grey, 2, 1).unwrap().pixels(), [DVec3::ONE, DVec3::splat(0.5)]);
}

#[test]
fn a_byte_too_many_or_too_few_names_the_likely_cause() {
    for (bytes, says) in [
        (pfm("PF\n5 3\n-1.0 \n", 180), "1 too many; the header is the likely cause"),
        (pfm("PF\n5 3\n-1.0\n", 179), "1 too few; the header is the likely cause"),
        (pfm("PF\r\n5 3\r\n-1.0\r\n", 181), "1 too many; the header is the likely cause"),
        (pfm("PF\r\n5 3\r\n-1.0\r\n", 178), "2 too few; the header is the likely cause"),
    ] {
        let said = refusal(&bytes);
        assert!(said.contains(says), "{said:?} does not say {says:?}");
    }
    // A program on Windows that opens a file as text writes CR LF for the bytes 10 and 137.
    let header = "PF\r\n5 3\r\n-1.0\r\n";
    let light = pfm("", 180)
        .into_iter()
        .flat_map(|byte| if byte == b'\n' { vec![b'\r', b'\n'] } else { vec![byte] });
    let text: Vec<u8> = header.bytes().chain(light).collect();
    assert!(
        refusal(&text).contains("2 too many; every line end in it is CR LF"),
        "{}",
        refusal(&text)
    );
}

#[test]
fn a_picture_without_pixels_is_an_error() {
    for (width, height) in [(0, 0), (0, 5), (5, 0)] {
        let header = format!("PF\n{width} {height}\n-1.0\n");
        let png = [
            b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR",
            &[0; 3][..],
            &[width as u8],
            &[0; 3],
            &[height as u8],
        ]
        .concat();
        for bytes in [header.as_bytes(), &png] {
            assert!(refusal(bytes).contains("not 5×3"), "{}", refusal(bytes));
            let exact = read_exact(bytes, width, height).unwrap_err().to_string();
            assert!(exact.contains(&format!("{width}×{height} pixels")), "{exact}");
        }
        let empty = Image::from_fn(width, height, |_, _| DVec3::ZERO);
        for kind in [Kind::Png, Kind::DeepPng, Kind::Pfm] {
            assert!(matches!(encode(kind, &empty), Err(PictureError::Broken(_))), "{kind:?}");
        }
    }
}

#[test]
fn a_float_map_keeps_what_is_no_number_for_the_judge_to_see() {
    let wild = Image::from_fn(1, 1, |_, _| DVec3::new(f64::NAN, f64::INFINITY, -2.0));
    let read = read_exact(&encode(Kind::Pfm, &wild).unwrap(), 1, 1).unwrap().pixel(0, 0);
    assert!(read.x.is_nan());
    assert_eq!((read.y, read.z), (f64::INFINITY, -2.0));
}

/// `expect --check` compares stored pictures byte for byte, so an encoder must not change.
#[test]
fn stored_pictures_are_encoded_as_they_are_stored() {
    let stages = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("stages");
    let list = |folder: &std::path::Path| {
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path())
    };
    let files = list(&stages).filter(|path| path.is_dir()).flat_map(|stage| list(&stage));
    let pngs: Vec<_> =
        files.filter(|path| path.to_string_lossy().ends_with(".expected.png")).collect();
    for path in &pngs {
        let bytes = std::fs::read(path).unwrap();
        let side = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        let image = read_exact(&bytes, side(16), side(20)).unwrap();
        assert!(encode(Kind::Png, &image).unwrap() == bytes, "{}", path.display());
    }
    assert!(pngs.len() > 20, "only {} pictures were found", pngs.len());
}

#[test]
fn a_name_with_another_ending_is_not_written() {
    let why = cases::film::write(std::path::Path::new("picture.bmp"), &picture()).unwrap_err();
    assert_eq!(
        why.to_string(),
        "cannot write picture.bmp: the name must end in .png or .pfm; nothing was changed"
    );
}
