//! The numbers of a question that rounding may change, and the question with one of them changed.

use cases::probe::Ask;
use serde_json::Value;

/// A question, and the places of the numbers in it that rounding may change.
///
/// Integers (pixels, indices, depths) and 0 are left out, because they are exact. `goes_on` does no
/// arithmetic, so only those of its numbers count that single precision cannot store. Copies of an
/// object in a scene are computed by equal operations, so rounding changes them together. Rule 2
/// decides which of two copies is hit.
pub(super) struct Nudges {
    question: Value,
    places: Vec<Vec<String>>,
}

impl Nudges {
    /// Finds the numbers of `ask`.
    ///
    /// # Errors
    /// The question has no JSON form.
    pub(super) fn of(ask: &Ask) -> serde_json::Result<Self> {
        let question = serde_json::to_value(ask)?;
        let is_compared = matches!(ask, Ask::GoesOn { .. });
        let mut places = Vec::new();
        collect(&question, String::new(), &mut places);
        places.retain(|(_, x)| *x != 0.0 && !(is_compared && f64::from(*x as f32) == *x));
        let copies = copies(&question);
        let places = places.into_iter().filter_map(|(place, _)| together(place, &copies)).collect();
        Ok(Self { question, places })
    }

    /// The numbers that change one at a time. Each is given by its places in the question.
    pub(super) fn places(&self) -> impl Iterator<Item = &[String]> {
        self.places.iter().map(Vec::as_slice)
    }

    /// Returns the question with the numbers at `places` changed, or `None` if the result is no
    /// question, as for the last row of a matrix.
    pub(super) fn nudged(&self, places: &[String], relative: f64) -> Option<Ask> {
        let mut moved = self.question.clone();
        for place in places {
            let number = moved.pointer_mut(place)?;
            *number = Value::from(number.as_f64()? * (1.0 + relative));
        }
        serde_json::from_value(moved).ok()
    }
}

/// Collects all floating-point numbers of `value`, with their JSON pointers.
fn collect(value: &Value, place: String, places: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) if number.is_f64() => {
            places.extend(number.as_f64().map(|x| (place, x)));
        }
        Value::Array(list) => {
            list.iter()
                .enumerate()
                .for_each(|(n, item)| collect(item, format!("{place}/{n}"), places));
        }
        Value::Object(map) => {
            map.iter().for_each(|(key, item)| collect(item, format!("{place}/{key}"), places))
        }
        _ => {}
    }
}

/// Returns, for each object of the question's scene, the index of the first object of the same
/// shape in the same place, which may be the object itself.
fn copies(question: &Value) -> Vec<usize> {
    let objects = question.pointer("/scene/objects").and_then(Value::as_array);
    let objects = objects.map_or(&[][..], Vec::as_slice);
    let keys = ["shape", "world_from_object"];
    let is_copy = |one: &Value, other: &Value| keys.iter().all(|key| one[key] == other[key]);
    let first = |object| objects.iter().position(|earlier| is_copy(earlier, object));
    objects.iter().filter_map(first).collect()
}

/// Returns the places that change together with `place`, in all copies of its object. The places of
/// a copy give `None`, because those of the first object include them.
fn together(place: String, copies: &[usize]) -> Option<Vec<String>> {
    let in_object = place.strip_prefix("/scene/objects/").and_then(|rest| rest.split_once('/'));
    let Some((index, rest)) = in_object else { return Some(vec![place]) };
    let index: usize = index.parse().ok()?;
    let same = (0..copies.len()).filter(|copy| copies[*copy] == index);
    let places: Vec<_> = same.map(|copy| format!("/scene/objects/{copy}/{rest}")).collect();
    (!places.is_empty()).then_some(places)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn n_places(ask: &Ask) -> usize {
        Nudges::of(ask).unwrap().places().count()
    }

    #[test]
    fn a_comparison_rounds_only_what_single_precision_cannot_store() {
        let goes_on = |x, threshold| {
            let weight = DVec3::new(x, 0.0, 0.5);
            n_places(&Ask::GoesOn { depth: 1, max_depth: 2, weight, threshold })
        };
        for ((x, threshold), n) in [((0.5, 0.25), 0), ((0.1, 0.25), 1), ((0.1, 0.3), 2)] {
            assert_eq!(goes_on(x, threshold), n, "{x} {threshold}");
        }
    }

    #[test]
    fn copies_of_an_object_change_together() {
        let ask = |z: f64| {
            let scene = crate::testing::scene(&format!(
                r#"
                [scene.materials]
                chalk = {{ kd = [0.8, 0.8, 0.8] }}
                [[scene.objects]]
                plane = {{ normal = [0, 0, 1], k = -4.0 }}
                material = "chalk"
                [[scene.objects]]
                plane = {{ normal = [0, 0, 1], k = {z:?} }}
                material = "chalk"
                "#
            ));
            let ray = cases::Ray::new(DVec3::ZERO, DVec3::NEG_Z);
            Ask::Nearest { scene: Box::new(scene), ray }
        };
        // Apart, the second plane adds its normal, its k and the ones of its two matrices.
        assert_eq!(n_places(&ask(-4.5)), n_places(&ask(-4.0)) + 10);
        let nudges = Nudges::of(&ask(-4.0)).unwrap();
        let place = nudges.places().find(|place| place[0].ends_with("plane/k")).unwrap();
        assert_eq!(place.len(), 2);
        let Some(Ask::Nearest { scene, .. }) = nudges.nudged(place, 0.25) else { panic!() };
        for object in &scene.objects {
            assert!(matches!(object.shape, cases::Shape::Plane { k, .. } if k == -5.0));
        }
    }
}
