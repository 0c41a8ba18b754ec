//! Reads and writes OpenEXR files of several parts. Each part has named planes of floats, which
//! image viewers open; the file also has a line of notes.
//!
//! The names of planes are those that viewers expect: `R`, `G`, `B` for the main picture, `lo.R`
//! for the red of the layer `lo`. The bytes depend on the content alone. Therefore one thread
//! writes, and all notes are one attribute: the encoder keeps attributes in a hash map, whose order
//! changes from run to run.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

use ::exr::meta::Headers;
use ::exr::meta::header::Header;
use ::exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Compression, Encoding, FlatSamples, Image as Exr,
    ImageAttributes, IntegerBounds, Layer as ExrPart, LayerAttributes, MetaData, ReadChannels,
    ReadLayers, ReadSpecificChannel, SampleType, Text, Vec2, WritableImage, f16, read,
};
use glam::DVec3;

use super::{Image, PictureError};

/// Largest number of parts of a file, and of planes. A file with more is refused before anything is
/// decoded.
const MOST: usize = 1024;
/// Largest number of bytes of samples per byte of a file. The compressors reach 1,000, on planes of
/// one value.
const MOST_RATIO: usize = 2048;
/// The attribute of the first part that carries the notes.
const NOTES: &str = "notes";
/// The attribute of another part that carries bytes, and its type.
const ATTACHED: &str = "attached";
const BYTES: &str = "deflated";

/// A named set of planes, compressed together: planes that resemble each other cost little.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// A name that no other part of the file has.
    pub name: String,
    /// The planes, in any order. In a decoded part they are ordered by name.
    pub planes: Vec<Plane>,
    /// Bytes of any meaning, stored as an attribute of the part. The first part has none: two
    /// attributes of one part would change their order from run to run.
    pub attached: Vec<u8>,
}

/// One number per pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// The name, such as `R` or `lo.R`.
    pub name: String,
    /// The number of every pixel.
    pub samples: Vec<f32>,
    /// The precision in which the numbers are stored.
    pub depth: Depth,
}

/// The precision in which a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// 16 bits, 11 of them significant: an eighth of an 8-bit level at full light.
    Half,
    /// 32 bits.
    Float,
}

/// Returns the red, green and blue planes of `image` as the layer `name`, or as the main picture if
/// `name` is empty.
pub fn rgb(name: &str, image: &Image, depth: Depth) -> [Plane; 3] {
    let plane = |channel: &str, pick: fn(&DVec3) -> f64| Plane {
        name: plane_name(name, channel),
        samples: image.pixels().iter().map(|pixel| pick(pixel) as f32).collect(),
        depth,
    };
    [plane("R", |p| p.x), plane("G", |p| p.y), plane("B", |p| p.z)]
}

/// Returns the name of a plane of a layer, or of the main picture if `layer` is empty.
pub fn plane_name(layer: &str, channel: &str) -> String {
    if layer.is_empty() { channel.to_owned() } else { format!("{layer}.{channel}") }
}

impl Part {
    /// Returns the samples of a plane.
    ///
    /// # Errors
    /// The part has no plane of this name.
    pub fn plane(&self, name: &str) -> Result<&[f32], PictureError> {
        let found = self.planes.iter().find(|plane| plane.name == name);
        let none = || PictureError::Broken(format!("part \"{}\" has no plane {name}", self.name));
        Ok(&found.ok_or_else(none)?.samples)
    }
}

/// Encodes a file of `size` (width, height) with these parts, and with `notes`, which may be any
/// text.
///
/// # Errors
/// There is no part, a plane has another size, or the encoder fails.
pub fn encode(size: (u32, u32), parts: &[Part], notes: &str) -> Result<Vec<u8>, PictureError> {
    let wanted = size.0 as usize * size.1 as usize;
    if parts.is_empty() {
        return Err(PictureError::Broken("there is no picture to write".to_owned()));
    }
    if let Some(plane) =
        parts.iter().flat_map(|part| &part.planes).find(|plane| plane.samples.len() != wanted)
    {
        let (name, n) = (&plane.name, plane.samples.len());
        return Err(PictureError::Broken(format!(
            "plane {name} has {n} pixels, {wanted} are wanted"
        )));
    }
    let size = (size.0 as usize, size.1 as usize);
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    let mut file = Exr::from_layers(
        attributes,
        parts.iter().map(|part| exr_part(part, size)).collect::<Vec<_>>(),
    );
    file.layer_data[0]
        .attributes
        .other
        .insert(Text::from(NOTES), AttributeValue::Text(Text::from(notes)));
    let mut out = Vec::new();
    file.write().non_parallel().to_buffered(Cursor::new(&mut out)).map_err(broken)?;
    Ok(out)
}

fn exr_part(part: &Part, size: (usize, usize)) -> ExrPart<AnyChannels<FlatSamples>> {
    let channel = |plane: &Plane| {
        let samples = match plane.depth {
            Depth::Half => FlatSamples::F16(
                plane.samples.iter().map(|sample| f16::from_f32(*sample)).collect(),
            ),
            Depth::Float => FlatSamples::F32(plane.samples.clone()),
        };
        AnyChannel::new(plane.name.as_str(), samples)
    };
    let mut attributes = LayerAttributes::named(part.name.as_str());
    if !part.attached.is_empty() {
        let bytes = part.attached.as_slice().into();
        let value = AttributeValue::Custom { kind: Text::from(BYTES), bytes };
        attributes.other.insert(Text::from(ATTACHED), value);
    }
    ExrPart::new(
        size,
        attributes,
        Encoding { compression: Compression::ZIP16, ..Encoding::FAST_LOSSLESS },
        AnyChannels::sort(part.planes.iter().map(channel).collect()),
    )
}

/// Decodes the first part and the notes.
///
/// Every part must have the size `width` × `height`, which is checked before anything is decoded.
///
/// # Errors
/// [`PictureError`]: another size, too many parts or planes, or a broken file.
pub fn decode_first(bytes: &[u8], width: u32, height: u32) -> Result<(Part, String), PictureError> {
    demand(bytes, (width, height))?;
    let reader = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes();
    let file = guarded(|| reader.non_parallel().from_buffered(Cursor::new(bytes)))?;
    let notes = notes_in(&file.layer_data.attributes);
    Ok((our_part(file.layer_data), notes))
}

/// The picture in the planes `R`, `G` and `B` of the first part of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// Width and height.
    pub size: (u32, u32),
    /// The pixels, row by row from the top.
    pub pixels: Vec<[f32; 3]>,
    /// The name of the part, which may be empty.
    pub part: String,
}

/// Reads the planes `R`, `G` and `B` of the first part.
///
/// `admit` decides on the size before anything is decoded.
///
/// # Errors
/// [`PictureError`]: `admit` refuses the size, a plane is missing or holds no floats, the planes do
/// not cover the whole picture, or the file is damaged.
pub fn decode_rgb(
    bytes: &[u8],
    admit: impl Fn((u32, u32)) -> Result<(), PictureError>,
) -> Result<Shown, PictureError> {
    let headers = headers(bytes)?;
    let first = headers.first().ok_or_else(|| PictureError::Broken("it has no part".to_owned()))?;
    let size = size(first);
    admit(size)?;
    demand_rgb(first)?;
    demand_length(bytes.len(), first)?;
    let width = size.0 as usize;
    let reader = read().no_deep_data().largest_resolution_level().specific_channels();
    let reader = reader.required("R").required("G").required("B").collect_pixels(
        |size: Vec2<usize>, _: &_| vec![[0.0; 3]; size.area()],
        move |pixels: &mut Vec<[f32; 3]>, at: Vec2<usize>, (r, g, b): (f32, f32, f32)| {
            pixels[at.y() * width + at.x()] = [r, g, b];
        },
    );
    let reader = reader.first_valid_layer().all_attributes().non_parallel();
    let file = guarded(|| reader.from_buffered(Cursor::new(bytes)))?;
    Ok(Shown { size, pixels: file.layer_data.channel_data.pixels, part: name(first) })
}

/// Checks that `R`, `G` and `B` hold floats for every pixel of the whole picture.
fn demand_rgb(first: &Header) -> Result<(), PictureError> {
    let broken = |why: String| Err(PictureError::Broken(why));
    if first.deep {
        return broken("it holds deep data, which is no picture".to_owned());
    }
    let shown = first.shared_attributes.display_window;
    if (shown.position, shown.size) != (first.own_attributes.layer_position, first.layer_size) {
        return broken(
            "it is a part of a picture: its data window is not its display window".to_owned(),
        );
    }
    for wanted in ["R", "G", "B"] {
        let plane = first.channels.list.iter().find(|plane| plane.name.eq(wanted));
        match plane {
            None => return broken(format!("its first part has no plane {wanted}")),
            Some(plane) if plane.sample_type == SampleType::U32 => {
                return broken(format!("its plane {wanted} holds whole numbers, not light"));
            }
            Some(_) => {}
        }
    }
    Ok(())
}

/// Checks that a file of `length` bytes can hold the planes, so that a short file cannot claim much
/// memory.
fn demand_length(length: usize, first: &Header) -> Result<(), PictureError> {
    let sample_bytes: usize =
        first.channels.list.iter().map(|plane| plane.sample_type.bytes_per_sample()).sum();
    let wanted = first.layer_size.0.saturating_mul(first.layer_size.1).saturating_mul(sample_bytes);
    if wanted / MOST_RATIO > length {
        let ((width, height), n) = (size(first), first.channels.list.len());
        return Err(PictureError::Broken(format!(
            "it has {length} bytes, which cannot hold {n} planes of {width}×{height} pixels"
        )));
    }
    Ok(())
}

/// Decodes all parts and the notes. The sizes are checked as in [`decode_first`].
///
/// # Errors
/// See [`decode_first`].
pub fn decode(bytes: &[u8], width: u32, height: u32) -> Result<(Vec<Part>, String), PictureError> {
    demand(bytes, (width, height))?;
    let reader = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes();
    let file = guarded(|| reader.non_parallel().from_buffered(Cursor::new(bytes)))?;
    let notes = file.layer_data.first().map(|part| notes_in(&part.attributes)).unwrap_or_default();
    Ok((file.layer_data.into_iter().map(our_part).collect(), notes))
}

/// Returns the bytes attached to the part `part`; none if there is no such part. Nothing is
/// decoded.
///
/// # Errors
/// The file is broken.
pub fn attached(bytes: &[u8], part: &str) -> Result<Vec<u8>, PictureError> {
    let headers = headers(bytes)?;
    let header = headers.iter().find(|header| name(header) == part);
    Ok(header.map(|header| attached_in(&header.own_attributes)).unwrap_or_default())
}

/// Returns the notes, or an empty text if there are none. Nothing is decoded.
///
/// # Errors
/// The file is broken.
pub fn notes(bytes: &[u8]) -> Result<String, PictureError> {
    Ok(headers(bytes)?.first().map(|header| notes_in(&header.own_attributes)).unwrap_or_default())
}

/// Reads only the headers, and checks that every part has the size `wanted`.
fn demand(bytes: &[u8], wanted: (u32, u32)) -> Result<Headers, PictureError> {
    let headers = headers(bytes)?;
    match headers.iter().map(size).find(|found| *found != wanted) {
        Some(found) => Err(PictureError::Size { found, wanted }),
        None => Ok(headers),
    }
}

fn size(header: &Header) -> (u32, u32) {
    let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    (side(header.layer_size.0), side(header.layer_size.1))
}

fn name(header: &Header) -> String {
    header.own_attributes.layer_name.as_ref().map(Text::to_string).unwrap_or_default()
}

/// Reads only the headers, and checks the number of parts and planes.
fn headers(bytes: &[u8]) -> Result<Headers, PictureError> {
    let headers = guarded(|| MetaData::read_from_buffered(Cursor::new(bytes), true))?.headers;
    let n_planes: usize = headers.iter().map(|header| header.channels.list.len()).sum();
    if headers.len() > MOST || n_planes > MOST {
        let n = headers.len();
        return Err(PictureError::Broken(format!(
            "it has {n} parts with {n_planes} planes, at most {MOST} are read"
        )));
    }
    Ok(headers)
}

fn notes_in(attributes: &LayerAttributes) -> String {
    match attributes.other.get(&Text::from(NOTES)) {
        Some(AttributeValue::Text(text)) => text.to_string(),
        _ => String::new(),
    }
}

fn attached_in(attributes: &LayerAttributes) -> Vec<u8> {
    match attributes.other.get(&Text::from(ATTACHED)) {
        Some(AttributeValue::Custom { bytes, .. }) => bytes.to_vec(),
        _ => Vec::new(),
    }
}

fn our_part(part: ExrPart<AnyChannels<FlatSamples>>) -> Part {
    let plane = |channel: AnyChannel<FlatSamples>| Plane {
        name: channel.name.to_string(),
        depth: if matches!(channel.sample_data, FlatSamples::F16(_)) {
            Depth::Half
        } else {
            Depth::Float
        },
        samples: channel.sample_data.values_as_f32().collect(),
    };
    let name = part.attributes.layer_name.as_ref().map(Text::to_string).unwrap_or_default();
    let attached = attached_in(&part.attributes);
    Part { name, planes: part.channel_data.list.into_iter().map(plane).collect(), attached }
}

/// Calls the decoder. A panic of the decoder becomes an error of the file.
///
/// The decoder (1.74.2) indexes out of bounds where a block is shorter than the header says. It
/// reads from memory, so that a panic leaves nothing half changed.
fn guarded<T>(read: impl FnOnce() -> ::exr::error::Result<T>) -> Result<T, PictureError> {
    let unfit = |_| PictureError::Broken("its blocks do not fit its header".to_owned());
    catch_unwind(AssertUnwindSafe(read)).map_err(unfit)?.map_err(broken)
}

fn broken(why: ::exr::error::Error) -> PictureError {
    PictureError::Broken(why.to_string())
}

#[cfg(test)]
mod tests;
