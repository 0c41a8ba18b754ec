//! OpenEXR files of several layers: float pictures that image viewers open, and a line of notes.
//!
//! The bytes depend on the content alone: one thread writes, and all notes are one attribute, since attributes are kept in a
//! hash map, whose order changes from run to run.

use std::io::Cursor;

use ::exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Compression, Encoding, FlatSamples, Image as Exr, ImageAttributes,
    IntegerBounds, Layer as ExrLayer, LayerAttributes, MetaData, ReadChannels, ReadLayers, Text, WritableImage, read,
};
use glam::DVec3;

use super::{Image, PictureError};

/// More layers than this are refused before anything is decoded.
const MOST_LAYERS: usize = 64;
/// The attribute of the first layer that carries the notes.
const NOTES: &str = "notes";

/// A named picture in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Such as `expected`; no two layers of a file share a name.
    pub name: String,
    /// Its pixels, stored as f32.
    pub image: Image,
}

/// The bytes of a file with these layers, all of one size, and `notes`, which may be any text.
///
/// # Errors
/// No layer, layers of different sizes, or what the encoder says.
pub fn encode(layers: &[Layer], notes: &str) -> Result<Vec<u8>, PictureError> {
    let first = layers.first().ok_or_else(|| PictureError::Broken("there is no layer".to_owned()))?;
    let size = (first.image.width(), first.image.height());
    if let Some(other) = layers.iter().find(|layer| (layer.image.width(), layer.image.height()) != size) {
        return Err(PictureError::Size { found: (other.image.width(), other.image.height()), wanted: size });
    }
    let size = (size.0 as usize, size.1 as usize);
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    let mut file = Exr::from_layers(attributes, layers.iter().map(exr_layer).collect::<Vec<_>>());
    file.layer_data[0].attributes.other.insert(Text::from(NOTES), AttributeValue::Text(Text::from(notes)));
    let mut out = Vec::new();
    file.write().non_parallel().to_buffered(Cursor::new(&mut out)).map_err(broken)?;
    Ok(out)
}

fn exr_layer(layer: &Layer) -> ExrLayer<AnyChannels<FlatSamples>> {
    let channel = |name: &str, pick: fn(&DVec3) -> f64| {
        let samples = layer.image.pixels().iter().map(|pixel| pick(pixel) as f32).collect();
        AnyChannel::new(name, FlatSamples::F32(samples))
    };
    let channels = [channel("R", |p| p.x), channel("G", |p| p.y), channel("B", |p| p.z)];
    ExrLayer::new(
        (layer.image.width() as usize, layer.image.height() as usize),
        LayerAttributes::named(layer.name.as_str()),
        Encoding { compression: Compression::ZIP16, ..Encoding::FAST_LOSSLESS },
        AnyChannels::sort(channels.into_iter().collect()),
    )
}

/// The layers and the notes that `bytes` hold, each layer demanded to be `width` × `height` before any is decoded.
///
/// # Errors
/// [`PictureError`]: another size, too many layers, a layer without the channels R, G, B, or a broken file.
pub fn decode(bytes: &[u8], width: u32, height: u32) -> Result<(Vec<Layer>, String), PictureError> {
    demand(bytes, (width, height))?;
    let file = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    let notes = match file.layer_data.first().and_then(|layer| layer.attributes.other.get(&Text::from(NOTES))) {
        Some(AttributeValue::Text(text)) => text.to_string(),
        _ => String::new(),
    };
    let layers = file.layer_data.iter().map(|layer| our_layer(layer, (width, height))).collect::<Result<_, _>>()?;
    Ok((layers, notes))
}

/// Reads the headers alone.
fn demand(bytes: &[u8], wanted: (u32, u32)) -> Result<(), PictureError> {
    let headers = MetaData::read_from_buffered(Cursor::new(bytes), true).map_err(broken)?.headers;
    if headers.len() > MOST_LAYERS {
        return Err(PictureError::Broken(format!("it has {} layers, at most {MOST_LAYERS} are read", headers.len())));
    }
    for header in &headers {
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let found = (side(header.layer_size.0), side(header.layer_size.1));
        if found != wanted {
            return Err(PictureError::Size { found, wanted });
        }
        if header.channels.list.len() != 3 {
            let n_channels = header.channels.list.len();
            return Err(PictureError::Broken(format!("a layer has {n_channels} channels instead of R, G, B")));
        }
    }
    Ok(())
}

fn our_layer(layer: &ExrLayer<AnyChannels<FlatSamples>>, size: (u32, u32)) -> Result<Layer, PictureError> {
    let name = layer.attributes.layer_name.as_ref().map(Text::to_string).unwrap_or_default();
    let channel = |wanted: &str| {
        let found = layer.channel_data.list.iter().find(|channel| channel.name.eq(wanted));
        let found = found.ok_or_else(|| PictureError::Broken(format!("layer \"{name}\" has no channel {wanted}")))?;
        Ok::<Vec<f32>, PictureError>(found.sample_data.values_as_f32().collect())
    };
    let (red, green, blue) = (channel("R")?, channel("G")?, channel("B")?);
    let pixel = |((r, g), b): ((&f32, &f32), &f32)| DVec3::new(f64::from(*r), f64::from(*g), f64::from(*b));
    let pixels = red.iter().zip(&green).zip(&blue).map(pixel).collect();
    let image = Image::from_pixels(size.0, size.1, pixels)
        .ok_or_else(|| PictureError::Broken(format!("layer \"{name}\" lacks pixels")))?;
    Ok(Layer { name, image })
}

fn broken(why: ::exr::error::Error) -> PictureError {
    PictureError::Broken(why.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(width: u32, height: u32, scale: f32) -> Image {
        Image::from_fn(width, height, |i, j| {
            DVec3::new(f64::from(i as f32 * scale), f64::from(j as f32 * scale), -0.5) // as f32, so that nothing is lost
        })
    }

    fn two_layers() -> Vec<Layer> {
        let layer = |name: &str, scale| Layer { name: name.to_owned(), image: ramp(7, 5, scale) };
        vec![layer("expected", 0.1), layer("weight", 3.3)]
    }

    #[test]
    fn layers_and_notes_come_back_bit_for_bit() {
        let bytes = encode(&two_layers(), "{\"levels\":2.0}").unwrap();
        assert_eq!(decode(&bytes, 7, 5).unwrap(), (two_layers(), "{\"levels\":2.0}".to_owned()));
    }

    #[test]
    fn the_same_content_gives_the_same_bytes() {
        assert_eq!(encode(&two_layers(), "x").unwrap(), encode(&two_layers(), "x").unwrap());
    }

    #[test]
    fn another_size_is_refused() {
        let bytes = encode(&two_layers(), "").unwrap();
        let error = decode(&bytes, 8, 5).unwrap_err();
        assert!(matches!(error, PictureError::Size { found: (7, 5), wanted: (8, 5) }), "{error}");
    }

    #[test]
    fn layers_of_different_sizes_are_refused() {
        let layer = |width| Layer { name: format!("{width}"), image: ramp(width, 5, 0.1) };
        assert!(encode(&[layer(3), layer(4)], "").is_err());
        assert!(encode(&[], "").is_err());
    }

    #[test]
    fn every_cut_and_every_broken_byte_is_an_error_or_a_picture_but_no_panic() {
        let bytes = encode(&two_layers(), "notes").unwrap();
        for end in 0..bytes.len() {
            assert!(decode(&bytes[..end], 7, 5).is_err(), "cut at {end}");
        }
        for at in 0..bytes.len() {
            let mut broken = bytes.clone();
            broken[at] ^= 0x55;
            let _ = decode(&broken, 7, 5);
        }
    }
}
