//! Tests of `plot.rs`.

use super::*;

fn point(x: f64, y: f64, is_on_front: bool) -> Point {
    let text = format!("<{x} & {y}>");
    let spread = (0.9 * x, 1.1 * x);
    Point {
        x,
        spread,
        y,
        shape: Shape::Circle,
        is_hollow: false,
        is_on_front,
        is_own: false,
        is_pick: false,
        label: text.clone(),
        hover: text,
        link: None,
    }
}

fn plot(points: Vec<Point>) -> String {
    let text = || "a".to_owned();
    svg(
        &Plot { title: text(), x: text(), y: text(), line: Some("best"), key: vec![], points },
        Place::File,
    )
}

#[test]
fn no_error_stands_below_the_axis_and_what_cannot_be_drawn_is_left_out() {
    let with_zero =
        plot(vec![point(1.0, 10.0, true), point(2.0, 0.0, true), point(3.0, f64::NAN, false)]);
    assert_eq!(with_zero.matches("<circle").count(), 2);
    assert!(
        with_zero.contains(">none</text>")
            && with_zero.contains(&format!("cy=\"{:.1}\"", BOTTOM - BAND / 2.0))
    );
    assert!(with_zero.contains("<title>&lt;1 &amp; 10&gt;</title>"), "{with_zero}");
    let without = plot(vec![
        point(1.0, 10.0, false),
        point(0.0, 1.0, false),
        point(f64::INFINITY, 1.0, false),
    ]);
    assert_eq!((without.matches("<circle").count(), without.contains(">none<")), (1, false));
    assert!(plot(Vec::new()).ends_with("</svg>\n"), "a plot without points is an empty plot");
}

#[test]
fn the_front_goes_down_in_stairs_and_bears_names() {
    let drawn = plot(vec![point(2.0, 1.0, true), point(1.0, 10.0, true), point(4.0, 5.0, false)]);
    let path = drawn.split("class=\"front\" d=\"").nth(2).unwrap().split('"').next().unwrap();
    assert!(
        path.starts_with('M') && path.matches('H').count() == 1 && path.matches('V').count() == 1,
        "{path}"
    );
    assert_eq!(drawn.matches("class=\"label\"").count(), 2);
}

#[test]
fn the_scene_and_the_pick_are_marked_even_in_a_crowd() {
    let crowd =
        || (0..400).map(|n| point(1.0 + f64::from(n % 20) / 20.0, 1.0 + f64::from(n / 20), true));
    let own = Point { is_own: true, ..point(1.5, 10.0, false) };
    let pick = Point { is_pick: true, ..point(1.5, 10.0, false) };
    let both = plot(crowd().chain([own.clone(), pick.clone()]).collect());
    assert_eq!(both.matches("class=\"label marked\"").count(), 2, "{both}");
    assert!(both.contains(": as it stands</text>") && both.contains(": the pick</text>"));
    assert!(both.contains(">the scene as it stands</text>") && both.contains(">the pick</text>"));
    assert_eq!(both.matches("class=\"ring\"").count(), 4, "two marks, and two in the legend");
    let last_other = both.rfind("&lt;1.95 &amp; 20&gt;</title>").unwrap();
    assert!(both[last_other..].contains("<circle class=\"ring\""), "marks come last");
    let one = plot(vec![Point { is_pick: true, ..own }]);
    assert!(one.contains(": as it stands, and the pick</text>"), "{one}");
    assert_eq!(plot(crowd().collect()).matches("class=\"ring\"").count(), 0);
}

#[test]
fn a_point_with_a_link_leads_to_its_picture() {
    let linked = Point { link: Some("rounding-3".to_owned()), ..point(1.0, 1.0, false) };
    assert_eq!(plot(vec![linked]).matches("<a href=\"#rounding-3\"><g>").count(), 1);
    assert!(!plot(vec![point(1.0, 1.0, false)]).contains("href"));
}
