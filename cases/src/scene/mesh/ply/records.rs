//! Records of elements: checks that they can all be there, and skips them.

use super::header::{Element, Kind, Property};
use super::values::Values;
use crate::scene::mesh::fault::{Fault, Place};

/// Refuses an element that has more records than the rest of the file can hold.
pub(super) fn check_count(element: &Element<'_>, values: &mut impl Values) -> Result<(), Fault> {
    let least = |property: &Property<'_>| property.count.unwrap_or(property.kind);
    let per_record =
        element.properties.iter().map(|property| 1.0 / values.most(least(property)) as f64);
    // A record takes at least this share of the rest of the file.
    let share: f64 = per_record.sum();
    if share > 0.0 && element.count as f64 * share > 1.0 + 1e-9 {
        let help = "write the file again, or correct the count";
        return Err(element.written.fault("records are more than the file holds", help));
    }
    Ok(())
}

/// Skips `n` records of an element.
pub(super) fn skip(element: &Element<'_>, values: &mut impl Values, n: usize) -> Result<(), Fault> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for record in 0..n {
        for property in &element.properties {
            pass(property, values).map_err(|fault| within(fault, element, record, values))?;
        }
    }
    Ok(())
}

/// Skips a property of a record.
pub(super) fn pass(property: &Property<'_>, values: &mut impl Values) -> Result<(), Fault> {
    let n = match property.count {
        Some(count) => n_entries(property, count, values)?,
        None => 1,
    };
    values.skip(property.kind, n)
}

/// Reads the number of entries of a list, and checks that the rest of the file can hold them.
pub(super) fn n_entries(
    property: &Property<'_>,
    count: Kind,
    values: &mut impl Values,
) -> Result<usize, Fault> {
    let at = values.at();
    let n = values.whole(count)?;
    match usize::try_from(n) {
        Ok(n) if n <= values.most(property.kind) => Ok(n),
        Ok(n) => {
            let what =
                format!("a list of {n} entries begins here, and the file ends before they do");
            Err(Fault::at(at, what, "write the file again, or correct the number of entries"))
        }
        Err(_) => Err(Fault::at(
            at,
            format!("a list cannot have {n} entries"),
            "correct the number of entries",
        )),
    }
}

/// Moves the fault to its place in record `n` of an element.
pub(super) fn within(fault: Fault, element: &Element<'_>, n: usize, values: &impl Values) -> Fault {
    let name = String::from_utf8_lossy(&element.name.text[..element.name.text.len().min(40)]);
    match fault.place {
        Place::Text(at) => {
            Fault { place: values.place(at, format!("{} {n}", name.escape_debug())), ..fault }
        }
        _ => fault,
    }
}
