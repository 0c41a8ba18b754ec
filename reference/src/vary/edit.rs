//! Changes the numbers of a case file within their bounds. Comments, order and layout stay.

use std::collections::BTreeMap;

use cases::stage::Bounds;
use glam::DVec3;
use toml_edit::{Array, DocumentMut, Item, TableLike, Value};

use super::decimal::Decimal;
use crate::numbers::stream::Stream;

/// The reason why a number cannot be changed exactly.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The number, as it is written, has too many digits.
    #[error("{0} has too many digits to be moved exactly: write it shorter")]
    Digits(String),
    /// The normal of a plane has too many digits.
    #[error(
        "a plane's normal has too many digits for the plane to be moved exactly: write it shorter"
    )]
    Normal,
}

/// The number of values that each key of `[vary]` has changed, for the keys that changed any.
pub(super) type Moved = BTreeMap<&'static str, usize>;

/// Changes the numbers of `case` once. Returns how many each key of its `[vary]` has changed.
///
/// # Errors
/// A sentence on a number with too many digits to be moved exactly.
pub(super) fn jitter(
    case: &mut DocumentMut,
    bounds: &Bounds,
    stream: &mut Stream,
) -> Result<Moved, EditError> {
    let mut mover = Mover { bounds, stream, moved: Moved::new() };
    let Some(scene) = case.get_mut("scene").and_then(Item::as_table_like_mut) else {
        return Ok(mover.moved);
    };
    if let Some(camera) = scene.get_mut("camera").and_then(Item::as_table_like_mut) {
        mover.point(camera, "eye", "eye", bounds.eye)?;
        mover.point(camera, "look_at", "look_at", bounds.look_at)?;
        mover.number(camera, "fov_y_deg", "fov_y_deg", bounds.fov_y_deg)?;
    }
    mover.colour(scene, "background")?;
    tables(scene, "lights").into_iter().try_for_each(|light| mover.light(light))?;
    if let Some(materials) = scene.get_mut("materials").and_then(Item::as_table_like_mut) {
        for (name, material) in materials.iter_mut() {
            if let Some(material) = material.as_table_like_mut()
                && !mover.keeps(name.get())
            {
                mover.material(material)?;
            }
        }
    }
    tables(scene, "objects").into_iter().try_for_each(|object| mover.object(object))?;
    Ok(mover.moved)
}

/// Returns the tables in the list `key`, which may be written as `[[key]]` or as inline tables.
pub(super) fn tables<'a>(table: &'a mut dyn TableLike, key: &str) -> Vec<&'a mut dyn TableLike> {
    match table.get_mut(key) {
        Some(Item::ArrayOfTables(tables)) => {
            tables.iter_mut().map(|table| table as &mut dyn TableLike).collect()
        }
        Some(Item::Value(Value::Array(list))) => list
            .iter_mut()
            .filter_map(Value::as_inline_table_mut)
            .map(|table| table as &mut dyn TableLike)
            .collect(),
        _ => vec![],
    }
}

/// Returns the table under `key`.
fn inner<'a>(table: &'a mut dyn TableLike, key: &str) -> Option<&'a mut dyn TableLike> {
    table.get_mut(key).and_then(Item::as_table_like_mut)
}

/// Returns the list under `key`.
fn list<'a>(table: &'a mut dyn TableLike, key: &str) -> Option<&'a mut Array> {
    table.get_mut(key).and_then(Item::as_array_mut)
}

struct Mover<'a> {
    bounds: &'a Bounds,
    stream: &'a mut Stream,
    moved: Moved,
}

impl Mover<'_> {
    fn keeps(&self, name: &str) -> bool {
        self.bounds.keep.iter().any(|kept| kept == name)
    }

    /// Adds `by` to a number, and counts it for the key `because` of `[vary]`.
    fn add(
        &mut self,
        value: &mut Value,
        by: Decimal,
        because: &'static str,
    ) -> Result<(), EditError> {
        let Some(number) = Decimal::of(value) else { return Ok(()) };
        let sum = number.plus(by).ok_or_else(|| EditError::Digits(value.to_string()))?;
        if sum != number {
            let mut written = sum.written();
            *written.decor_mut() = value.decor().clone();
            *value = written;
        }
        *self.moved.entry(because).or_default() += 1;
        Ok(())
    }

    /// Adds a random number within `bound` to a number. A bound of 0 changes nothing and draws
    /// nothing.
    fn shift(
        &mut self,
        value: &mut Value,
        bound: f64,
        because: &'static str,
    ) -> Result<(), EditError> {
        if bound <= 0.0 {
            return Ok(());
        }
        let by = Decimal::drawn(bound, self.stream);
        self.add(value, by, because)
    }

    /// Changes a number by at most a share of itself.
    fn stretch(
        &mut self,
        value: &mut Value,
        share: f64,
        because: &'static str,
    ) -> Result<(), EditError> {
        let size = Decimal::of(value).map_or(0.0, |number| number.get().abs());
        self.shift(value, size * share, because)
    }

    fn number(
        &mut self,
        table: &mut dyn TableLike,
        key: &str,
        because: &'static str,
        bound: f64,
    ) -> Result<(), EditError> {
        match table.get_mut(key).and_then(Item::as_value_mut) {
            Some(value) => self.shift(value, bound, because),
            None => Ok(()),
        }
    }

    fn point(
        &mut self,
        table: &mut dyn TableLike,
        key: &str,
        because: &'static str,
        bound: DVec3,
    ) -> Result<(), EditError> {
        let Some(three) = list(table, key) else { return Ok(()) };
        three
            .iter_mut()
            .zip(bound.to_array())
            .try_for_each(|(value, bound)| self.shift(value, bound, because))
    }

    /// Changes the channels of a colour. 0 and 1 are meant exactly and stay, no channel crosses 1,
    /// and a dark channel keeps at least half of its value.
    fn colour(&mut self, table: &mut dyn TableLike, key: &str) -> Result<(), EditError> {
        let Some(channels) = list(table, key) else { return Ok(()) };
        for channel in channels.iter_mut() {
            let was = Decimal::of(channel).map_or(0.0, Decimal::get);
            self.shift(
                channel,
                self.bounds.colours.min(was / 2.0).min((1.0 - was).abs()),
                "colours",
            )?;
        }
        Ok(())
    }

    fn light(&mut self, light: &mut dyn TableLike) -> Result<(), EditError> {
        if let Some(point) = inner(light, "point") {
            self.point(point, "position", "lights", self.bounds.lights)?;
        }
        if let Some(directional) = inner(light, "directional")
            && let Some(direction) = list(directional, "direction")
        {
            let longest =
                direction.iter().filter_map(Decimal::of).map(|x| x.get().abs()).fold(0.0, f64::max);
            let bound = longest * self.bounds.directions;
            direction.iter_mut().try_for_each(|value| self.shift(value, bound, "directions"))?;
        }
        for kind in ["point", "directional"] {
            if let Some(light) = inner(light, kind) {
                self.colour(light, "colour")?;
                self.colour(light, "ambient")?;
            }
        }
        Ok(())
    }

    fn material(&mut self, material: &mut dyn TableLike) -> Result<(), EditError> {
        ["ke", "ka", "kd", "ks", "kt", "kr"]
            .iter()
            .try_for_each(|key| self.colour(material, key))?;
        self.number(material, "index", "indices", self.bounds.indices)
    }

    fn object(&mut self, object: &mut dyn TableLike) -> Result<(), EditError> {
        if object.get("name").and_then(Item::as_str).is_some_and(|name| self.keeps(name)) {
            return Ok(());
        }
        tables(object, "transforms").into_iter().try_for_each(|step| self.step(step))?;
        if object.get("transforms").is_none() {
            self.place(object)?;
        }
        for (shape, radii) in [
            ("sphere", &["radius"][..]),
            ("cylinder", &["radius"]),
            ("cone", &["bottom_radius", "top_radius"]),
        ] {
            let Some(shape) = inner(object, shape) else { continue };
            for key in radii {
                if let Some(radius) = shape.get_mut(key).and_then(Item::as_value_mut) {
                    self.stretch(radius, self.bounds.radii, "radii")?;
                }
            }
        }
        tables(object, "group").into_iter().try_for_each(|object| self.object(object))
    }

    /// Changes a step of a list of transforms.
    fn step(&mut self, step: &mut dyn TableLike) -> Result<(), EditError> {
        self.point(step, "translate", "translate", self.bounds.translate)?;
        if let Some(turn) = inner(step, "rotate") {
            self.number(turn, "angle_deg", "angle_deg", self.bounds.angle_deg)?;
        }
        match step.get_mut("scale").and_then(Item::as_value_mut) {
            Some(Value::Array(factors)) => {
                factors
                    .iter_mut()
                    .try_for_each(|factor| self.stretch(factor, self.bounds.scale, "scale"))?;
            }
            Some(factor) => self.stretch(factor, self.bounds.scale, "scale")?,
            None => {}
        }
        if let Some(shear) = inner(step, "shear") {
            for (_, amount) in shear.iter_mut() {
                if let Some(amount) = amount.as_value_mut() {
                    self.stretch(amount, self.bounds.scale, "scale")?;
                }
            }
        }
        Ok(())
    }

    /// Moves an object as a whole if its position is written in the file.
    fn place(&mut self, object: &mut dyn TableLike) -> Result<(), EditError> {
        if self.bounds.objects == DVec3::ZERO {
            return Ok(());
        }
        let by = self.bounds.objects.to_array().map(|bound| Decimal::drawn(bound, self.stream));
        if let Some(sphere) = inner(object, "sphere") {
            self.carry(list(sphere, "center"), by)?;
        }
        if let Some(cuboid) = inner(object, "box")
            && cuboid.contains_key("min")
            && cuboid.contains_key("max")
        {
            self.carry(list(cuboid, "min"), by)?;
            self.carry(list(cuboid, "max"), by)?;
        }
        if let Some(vertices) = inner(object, "mesh").and_then(|mesh| list(mesh, "vertices")) {
            vertices.iter_mut().try_for_each(|vertex| self.carry(vertex.as_array_mut(), by))?;
        }
        match inner(object, "plane") {
            Some(plane) => self.carry_plane(plane, by),
            None => Ok(()),
        }
    }

    fn carry(&mut self, point: Option<&mut Array>, by: [Decimal; 3]) -> Result<(), EditError> {
        let Some(point) = point else { return Ok(()) };
        let bounds = self.bounds.objects.to_array();
        let moves = by.into_iter().zip(bounds);
        point
            .iter_mut()
            .zip(moves)
            .filter(|(_, (_, bound))| *bound > 0.0)
            .try_for_each(|(value, (by, _))| self.add(value, by, "objects"))
    }

    /// Moves a plane by `by`: N·(X − by) = k adds N·by to k.
    fn carry_plane(
        &mut self,
        plane: &mut dyn TableLike,
        by: [Decimal; 3],
    ) -> Result<(), EditError> {
        let Some(normal) = list(plane, "normal") else { return Ok(()) };
        let along = normal
            .iter()
            .zip(by)
            .try_fold(Decimal::ZERO, |sum, (n, by)| sum.plus(Decimal::of(n)?.times(by)?));
        let along = along.ok_or(EditError::Normal)?;
        let is_reached = normal
            .iter()
            .zip(self.bounds.objects.to_array())
            .any(|(n, bound)| bound > 0.0 && Decimal::of(n) != Some(Decimal::ZERO));
        match plane.get_mut("k").and_then(Item::as_value_mut) {
            Some(k) if is_reached => self.add(k, along, "objects"),
            _ => Ok(()),
        }
    }
}
