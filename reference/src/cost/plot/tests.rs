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
        label: text.clone(),
        hover: text,
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
fn a_scale_takes_powers_of_ten_to_equal_steps() {
    let scale = Scale { from: (0.0, 2.0), to: (100.0, 300.0) };
    for (value, at) in [(1.0, 100.0), (10.0, 200.0), (100.0, 300.0)] {
        assert!((scale.at(value) - at).abs() < 1e-9, "{value}");
    }
    assert_eq!(
        scale.ticks().into_iter().map(number).collect::<Vec<_>>(),
        ["1", "2", "5", "10", "20", "50", "100"]
    );
    let long = Scale { from: (-12.5, 3.5), to: (0.0, 1.0) };
    assert_eq!(
        long.ticks().into_iter().map(number).collect::<Vec<_>>(),
        ["1e-12", "1e-9", "1e-6", "0.001", "1", "1000"]
    );
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
