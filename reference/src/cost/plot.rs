//! Plots of error against cost as SVG, with logarithmic scales on both axes.
//!
//! No information is in colour alone: shapes and fillings distinguish the points, the front is a
//! line with names, and each point has a tooltip. A logarithmic scale has no place for an error of
//! 0, so such points lie in a band of their own below it.

use std::fmt::Write;

use cases::maths;

use super::labels::{self, Label};

/// The width of the picture, in its own units.
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 480.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 738.0;
const TOP: f64 = 64.0;
const BOTTOM: f64 = 424.0;
/// The height of the band for an error of 0.
const BAND: f64 = 30.0;

/// The shape of a drawn point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "their names say it")]
pub enum Shape {
    Circle,
    Square,
    Triangle,
    Diamond,
}

/// One point of a plot.
#[derive(Clone, Debug)]
pub struct Point {
    /// The cost, above 0.
    pub x: f64,
    /// The least and the greatest cost that was measured.
    pub spread: (f64, f64),
    /// The error, at least 0.
    pub y: f64,
    /// The shape of the mark.
    pub shape: Shape,
    /// Whether the mark is hollow.
    pub is_hollow: bool,
    /// Whether the point is on the Pareto front. It is then larger, and has its label beside it.
    pub is_on_front: bool,
    /// The label beside the point, if it is on the front.
    pub label: String,
    /// The tooltip.
    pub hover: String,
}

/// A plot of points.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The title above the plot.
    pub title: String,
    /// The name of the x axis, with the unit.
    pub x: String,
    /// The name of the y axis, with the unit.
    pub y: String,
    /// The meaning of the line through the points on the front. With `None` no line is drawn, and
    /// the points only have their labels.
    pub line: Option<&'static str>,
    /// The legend of shapes and fillings: shape, whether it is hollow, meaning.
    pub key: Vec<(Shape, bool, &'static str)>,
    /// The points. Points whose numbers are not finite, or whose cost is not above 0, are not
    /// drawn.
    pub points: Vec<Point>,
}

/// The place of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A file of its own, dark on white.
    File,
    /// A page, which contains [`STYLE`] and defines the colours.
    Page,
}

/// The meaning of the line in plots of error against time.
pub const FRONT: Option<&str> = Some("Pareto front: none faster and more accurate");

/// The style sheet of plots. It uses the colours of the page, if the page defines them.
pub const STYLE: &str = include_str!("plot.css");

/// A logarithmic scale.
struct Scale {
    from: (f64, f64),
    to: (f64, f64),
}

impl Scale {
    /// Returns the scale that maps the range of `values`, with a margin on either side, to `to`.
    /// Without values the range is 1 to 10.
    fn new(values: impl Iterator<Item = f64>, to: (f64, f64)) -> Self {
        let (least, greatest) =
            values.fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
        let (least, greatest) = if least <= greatest { (least, greatest) } else { (1.0, 10.0) };
        let room = 0.06 * (log10(greatest) - log10(least)).max(0.5);
        Self { from: (log10(least) - room, log10(greatest) + room), to }
    }

    fn at(&self, value: f64) -> f64 {
        let share = (log10(value) - self.from.0) / (self.from.1 - self.from.0);
        self.to.0 + share * (self.to.1 - self.to.0)
    }

    /// Returns the values to mark: powers of ten. If there are many, only some of them are marked;
    /// if there are few, also twice and five times each power.
    fn ticks(&self) -> Vec<f64> {
        let (first, last) = (self.from.0.floor() as i32, self.from.1.ceil() as i32);
        let step = (last - first).div_euclid(8) + 1;
        let multiples: &[f64] =
            if self.from.1 - self.from.0 < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let decades = (first..=last).filter(|n| n.rem_euclid(step) == 0);
        let values =
            decades.flat_map(|n| multiples.iter().map(move |m| m * maths::pow(10.0, f64::from(n))));
        values.filter(|v| (self.from.0..=self.from.1).contains(&log10(*v))).collect()
    }
}

fn log10(x: f64) -> f64 {
    maths::ln(x) / std::f64::consts::LN_10
}

/// Returns the picture as SVG.
pub fn svg(plot: &Plot, place: Place) -> String {
    stack(std::slice::from_ref(plot), place)
}

/// Returns the pictures below one another as one SVG, which is empty for no pictures.
pub fn stack(plots: &[Plot], place: Place) -> String {
    let height = HEIGHT * plots.len() as f64;
    let titles: Vec<String> = plots.iter().map(|plot| quoted(&plot.title)).collect();
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
            class=\"plot\" aria-label=\"{}\">\n",
        titles.join("; ")
    );
    if place == Place::File {
        let _ = write!(
            out,
            "<style>\n{STYLE}</style>\n\
                <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>\n"
        );
    }
    for (n, plot) in plots.iter().enumerate() {
        let _ = write!(
            out,
            "<g transform=\"translate(0 {})\">\n{}</g>\n",
            HEIGHT * n as f64,
            drawn(plot)
        );
    }
    out += "</svg>\n";
    out
}

fn drawn(plot: &Plot) -> String {
    let drawable = |p: &&Point| p.x > 0.0 && p.x.is_finite() && p.y >= 0.0 && p.y.is_finite();
    let points: Vec<&Point> = plot.points.iter().filter(drawable).collect();
    let has_zero = points.iter().any(|point| point.y == 0.0);
    let floor = if has_zero { BOTTOM - BAND } else { BOTTOM };
    let x = Scale::new(
        points.iter().flat_map(|p| [p.x, p.spread.0, p.spread.1]).filter(|x| *x > 0.0),
        (LEFT, RIGHT),
    );
    let y = Scale::new(points.iter().map(|p| p.y).filter(|y| *y > 0.0), (floor, TOP));
    let height = |value: f64| if value == 0.0 { BOTTOM - BAND / 2.0 } else { y.at(value) };
    let at: Vec<(f64, f64)> = points.iter().map(|p| (x.at(p.x), height(p.y))).collect();
    let mut out = axes(plot, &x, &y, floor, has_zero);
    let on_front = || points.iter().zip(&at).filter(|(point, _)| point.is_on_front);
    let mut front: Vec<(f64, f64)> = on_front().map(|(_, at)| *at).collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    if plot.line.is_some() {
        out += &stairs(&front);
    }
    for (point, at) in points.iter().zip(&at) {
        let spread = [point.spread.0, point.spread.1]
            .map(|value| if value > 0.0 { x.at(value) } else { at.0 });
        out += &mark(point, *at, spread);
    }
    let wanted: Vec<Label<'_>> =
        on_front().map(|(point, at)| Label { text: &point.label, at: *at }).collect();
    for (label, (left, base)) in labels::place(&wanted, &at, (LEFT, TOP, RIGHT, BOTTOM)) {
        let _ = writeln!(
            out,
            "<text class=\"label\" x=\"{left:.1}\" y=\"{base:.1}\">{}</text>",
            quoted(label.text)
        );
    }
    out
}

fn axes(plot: &Plot, x: &Scale, y: &Scale, floor: f64, has_zero: bool) -> String {
    let mut out =
        format!("<text class=\"title\" x=\"{LEFT}\" y=\"20\">{}</text>\n", quoted(&plot.title));
    for tick in x.ticks() {
        let at = x.at(tick);
        let _ = writeln!(
            out,
            "<line class=\"grid\" x1=\"{at:.1}\" y1=\"{TOP}\" x2=\"{at:.1}\" y2=\"{BOTTOM}\"/>"
        );
        let _ = writeln!(
            out,
            "<text class=\"tick middle\" x=\"{at:.1}\" y=\"{}\">{}</text>",
            BOTTOM + 16.0,
            number(tick)
        );
    }
    for tick in y.ticks() {
        let at = y.at(tick);
        let _ = writeln!(
            out,
            "<line class=\"grid\" x1=\"{LEFT}\" y1=\"{at:.1}\" x2=\"{RIGHT}\" y2=\"{at:.1}\"/>"
        );
        let _ = writeln!(
            out,
            "<text class=\"tick end\" x=\"{}\" y=\"{:.1}\">{}</text>",
            LEFT - 7.0,
            at + 4.0,
            number(tick)
        );
    }
    if has_zero {
        let _ = writeln!(
            out,
            "<line class=\"axis\" x1=\"{LEFT}\" y1=\"{floor}\" x2=\"{RIGHT}\" y2=\"{floor}\"/>"
        );
        let middle = BOTTOM - BAND / 2.0;
        let _ = writeln!(
            out,
            "<text class=\"tick end\" x=\"{}\" y=\"{}\">none</text>",
            LEFT - 7.0,
            middle + 4.0
        );
    }
    let _ = writeln!(out, "<path class=\"axis\" d=\"M{LEFT} {TOP}V{BOTTOM}H{RIGHT}\"/>");
    let middle = (LEFT + RIGHT) / 2.0;
    let _ = writeln!(
        out,
        "<text class=\"name middle\" x=\"{middle}\" y=\"{}\">{}</text>",
        BOTTOM + 40.0,
        quoted(&plot.x)
    );
    let side = (TOP + BOTTOM) / 2.0;
    let _ = writeln!(
        out,
        "<text class=\"name middle\" transform=\"translate(18 {side}) rotate(-90)\">{}</text>",
        quoted(&plot.y)
    );
    let mut left = LEFT;
    for (shape, is_hollow, text) in &plot.key {
        let _ = writeln!(out, "{}", outline(*shape, *is_hollow, (left + 5.0, 40.0), false));
        let _ = writeln!(
            out,
            "<text class=\"tick\" x=\"{}\" y=\"44\">{}</text>",
            left + 15.0,
            quoted(text)
        );
        left += 34.0 + labels::width(text);
    }
    if let Some(line) = plot.line {
        let _ = writeln!(out, "<path class=\"front\" d=\"M{left} 40h24\"/>");
        let _ = writeln!(
            out,
            "<text class=\"tick\" x=\"{}\" y=\"44\">{}</text>",
            left + 31.0,
            quoted(line)
        );
    }
    out
}

/// Returns the front as a staircase. All points to the right of it and above it are beaten.
fn stairs(front: &[(f64, f64)]) -> String {
    let Some(((x, y), rest)) = front.split_first() else { return String::new() };
    let mut path = format!("M{x:.1} {y:.1}");
    for (x, y) in rest {
        let _ = write!(path, "H{x:.1}V{y:.1}");
    }
    format!("<path class=\"front\" d=\"{path}\"/>\n")
}

fn mark(point: &Point, at: (f64, f64), spread: [f64; 2]) -> String {
    format!(
        "<g><title>{}</title><line class=\"spread\" x1=\"{:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" \
            y2=\"{y:.1}\"/>{}</g>\n",
        quoted(&point.hover),
        spread[0],
        spread[1],
        outline(point.shape, point.is_hollow, at, point.is_on_front),
        y = at.1,
    )
}

fn outline(shape: Shape, is_hollow: bool, (x, y): (f64, f64), is_large: bool) -> String {
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

/// Returns the text of a tick: a decimal from 0.001 to below 100,000, otherwise with an exponent.
fn number(x: f64) -> String {
    if (1e-3..1e5).contains(&x) {
        format!("{:.4}", x).trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{x:.0e}")
    }
}

/// Returns text with the escapes of SVG and HTML. Control characters except line breaks become
/// U+FFFD.
fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            c if c.is_control() && c != '\n' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests;
