//! The symbols of points.

/// The shape of a drawn point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "their names say it")]
pub enum Shape {
    Circle,
    Square,
    Triangle,
    Diamond,
}

/// Returns a circle without a filling.
pub(super) fn ring((x, y): (f64, f64), r: f64) -> String {
    format!("<circle class=\"ring\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"/>")
}

/// Returns a diamond without a filling, `d` from its centre to each corner.
pub(super) fn diamond((x, y): (f64, f64), d: f64) -> String {
    format!(
        "<path class=\"ring\" d=\"M{x:.1} {:.1}l{d:.1} {d:.1}l-{d:.1} {d:.1}l-{d:.1} -{d:.1}Z\"/>",
        y - d
    )
}

/// Returns the symbol of a point.
pub(super) fn outline(shape: Shape, is_hollow: bool, (x, y): (f64, f64), is_large: bool) -> String {
    let r = if is_large { 6.0 } else { 4.5 };
    let class = if is_hollow { "hollow" } else { "solid" };
    match shape {
        Shape::Circle => {
            format!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"/>")
        }
        Shape::Square => {
            let (left, top, side) = (x - 0.9 * r, y - 0.9 * r, 1.8 * r);
            format!(
                "<rect class=\"{class}\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{side:.1}\" \
                    height=\"{side:.1}\"/>"
            )
        }
        Shape::Triangle => {
            let (up, half, down) = (y - 1.2 * r, 1.1 * r, y + 0.8 * r);
            format!(
                "<path class=\"{class}\" d=\"M{x:.1} {up:.1}L{:.1} {down:.1}H{:.1}Z\"/>",
                x + half,
                x - half
            )
        }
        Shape::Diamond => {
            let d = 1.25 * r;
            format!(
                "<path class=\"{class}\" d=\"M{x:.1} {:.1}l{d:.1} {d:.1}l-{d:.1} {d:.1}l-{d:.1} \
                    -{d:.1}Z\"/>",
                y - d
            )
        }
    }
}
