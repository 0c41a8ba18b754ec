//! The placement of names beside points: no name overlaps another name or a point.

/// A name and the point that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Label<'a> {
    /// The name.
    pub(super) text: &'a str,
    /// The point.
    pub(super) at: (f64, f64),
    /// Whether the name is placed even where there is no room beside the point.
    pub(super) is_needed: bool,
}

const LINE: f64 = 13.0;
const GAP: f64 = 9.0;

/// Returns the approximate width of a text in small letters.
pub(super) fn width(text: &str) -> f64 {
    7.1 * text.chars().count() as f64
}

/// A rectangle: left, top, right, bottom.
type Area = (f64, f64, f64, f64);

/// Returns each name that finds a free place within `inside`, with the left end and the base line
/// of its text. A needed name without a free place beside its point is placed in the nearest free
/// place, or where it covers no other name but points. Other names without a free place are left
/// out.
pub(super) fn place<'a>(
    labels: &[Label<'a>],
    points: &[(f64, f64)],
    inside: Area,
) -> Vec<(Label<'a>, (f64, f64))> {
    let mut taken: Vec<Area> =
        points.iter().map(|(x, y)| (x - 6.0, y - 6.0, x + 6.0, y + 6.0)).collect();
    let mut placed = Vec::new();
    for label in labels {
        let is_inside = |area: &Area| {
            area.0 >= inside.0 && area.1 >= inside.1 && area.2 <= inside.2 && area.3 <= inside.3
        };
        let is_free = |area: &Area, taken: &[Area]| {
            is_inside(area) && !taken.iter().any(|other| overlap(*area, *other))
        };
        let beside = around(label).into_iter().find(|area| is_free(area, &taken));
        let free = beside.or_else(|| {
            let all = label.is_needed.then(|| everywhere(label, inside))?;
            let names = &taken[points.len()..];
            let is_clear = |area: &&Area| is_free(area, &taken);
            all.iter().find(is_clear).or(all.iter().find(|area| is_free(area, names))).copied()
        });
        if let Some(area) = free {
            taken.push(area);
            placed.push((*label, (area.0, area.3 - 3.0)));
        }
    }
    placed
}

/// Returns places all over `inside`, the nearest to the point first.
fn everywhere(label: &Label<'_>, inside: Area) -> Vec<Area> {
    let w = width(label.text);
    let steps = |from: f64, to: f64| {
        let n = ((to - from) / LINE).max(0.0) as u32;
        (0..=n).map(move |k| from + LINE * f64::from(k))
    };
    let mut all: Vec<Area> = steps(inside.0, inside.2 - w)
        .flat_map(|left| steps(inside.1, inside.3 - LINE).map(move |top| (left, top)))
        .map(|(left, top)| (left, top, left + w, top + LINE))
        .collect();
    let far = |area: &Area| {
        let (x, y) = ((area.0 + area.2) / 2.0 - label.at.0, (area.1 + area.3) / 2.0 - label.at.1);
        x * x + y * y
    };
    all.sort_by(|a, b| far(a).total_cmp(&far(b)));
    all
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
        let labels: Vec<Label<'_>> = points
            .iter()
            .map(|at| Label { text: "f64 robust 2×2", at: *at, is_needed: false })
            .collect();
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
        let label = |is_needed| Label { text: "here", at: (100.0, 100.0), is_needed };
        assert!(place(&[label(false)], &crowd, INSIDE).is_empty());
        // The crowd takes the upper left part, up to 196 by 196.
        let (_, (left, base)) = place(&[label(true)], &crowd, INSIDE)[0];
        assert!(left >= 196.0 || base - LINE + 3.0 >= 196.0, "{left} {base}");
        let narrow = (0.0, 0.0, 190.0, 190.0);
        let both = place(&[label(true), label(true)], &crowd, narrow);
        let [(_, one), (_, other)] = both[..] else { panic!("both are placed: {both:?}") };
        let apart = (one.0 - other.0).abs() >= width("here") || (one.1 - other.1).abs() >= LINE;
        assert!(apart, "they cover points, but not each other: {both:?}");
    }
}
