//! The placement of names beside points: no name overlaps another name or a point.

/// A name and the point that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Label<'a> {
    /// The name.
    pub(super) text: &'a str,
    /// The point.
    pub(super) at: (f64, f64),
}

const LINE: f64 = 13.0;
const GAP: f64 = 9.0;

/// Returns the approximate width of a text in small letters.
pub(super) fn width(text: &str) -> f64 {
    6.1 * text.chars().count() as f64
}

/// A rectangle: left, top, right, bottom.
type Area = (f64, f64, f64, f64);

/// Returns each name that finds a free place within `inside`, with the left end and the base line
/// of its text. Names without a free place are left out.
pub(super) fn place<'a>(
    labels: &[Label<'a>],
    points: &[(f64, f64)],
    inside: Area,
) -> Vec<(Label<'a>, (f64, f64))> {
    let mut taken: Vec<Area> =
        points.iter().map(|(x, y)| (x - 6.0, y - 6.0, x + 6.0, y + 6.0)).collect();
    let mut placed = Vec::new();
    for label in labels {
        let free = around(label).into_iter().find(|area| {
            let is_inside = area.0 >= inside.0
                && area.1 >= inside.1
                && area.2 <= inside.2
                && area.3 <= inside.3;
            is_inside && !taken.iter().any(|other| overlap(*area, *other))
        });
        if let Some(area) = free {
            taken.push(area);
            placed.push((*label, (area.0, area.3 - 3.0)));
        }
    }
    placed
}

/// Returns the places beside, above and below a point, the best first.
fn around(label: &Label<'_>) -> [Area; 8] {
    let ((x, y), w) = (label.at, width(label.text));
    let area = |left: f64, top: f64| (left, top, left + w, top + LINE);
    let (right, left, middle) = (x + GAP, x - GAP - w, x - w / 2.0);
    [
        area(right, y - LINE - 3.0),
        area(right, y - LINE / 2.0),
        area(right, y + 4.0),
        area(left, y + 4.0),
        area(left, y - LINE / 2.0),
        area(left, y - LINE - 3.0),
        area(middle, y - LINE - GAP),
        area(middle, y + GAP),
    ]
}

fn overlap(a: Area, b: Area) -> bool {
    a.0 < b.2 && b.0 < a.2 && a.1 < b.3 && b.1 < a.3
}

#[cfg(test)]
mod tests {
    use super::*;

    const INSIDE: Area = (0.0, 0.0, 400.0, 300.0);

    #[test]
    fn names_keep_clear_of_each_other_of_points_and_of_the_edge() {
        let points = [(10.0, 10.0), (60.0, 30.0), (66.0, 34.0), (390.0, 290.0), (200.0, 150.0)];
        let labels: Vec<Label<'_>> =
            points.iter().map(|at| Label { text: "f64 robust 2×2", at: *at }).collect();
        let placed = place(&labels, &points, INSIDE);
        assert!(placed.len() >= 4, "{placed:?}");
        let areas: Vec<Area> = placed
            .iter()
            .map(|(label, (x, y))| (*x, y + 3.0 - LINE, x + width(label.text), y + 3.0))
            .collect();
        for (n, area) in areas.iter().enumerate() {
            assert!(areas[n + 1..].iter().all(|other| !overlap(*area, *other)));
            assert!(
                area.0 >= 0.0 && area.1 >= 0.0 && area.2 <= 400.0 && area.3 <= 300.0,
                "{area:?}"
            );
            assert!(
                points.iter().all(|(x, y)| !overlap(*area, (x - 1.0, y - 1.0, x + 1.0, y + 1.0)))
            );
        }
    }

    #[test]
    fn a_name_without_room_is_left_out() {
        let crowd: Vec<(f64, f64)> =
            (0..400).map(|n| (f64::from(n % 20) * 10.0, f64::from(n / 20) * 10.0)).collect();
        assert!(place(&[Label { text: "here", at: (100.0, 100.0) }], &crowd, INSIDE).is_empty());
    }
}
