//! Plots of error against cost as SVG, with logarithmic scales on both axes.
//!
//! No information is in colour alone: shapes and fillings distinguish the points, the front is a
//! line with names, and each point has a tooltip. The scene as it stands and the pick have outlines
//! of their own and always a label. A logarithmic scale has no place for an error of
//! 0, so such points lie in a band of their own below it.

mod scale;
mod symbols;

use std::fmt::Write;

use scale::{Scale, number};
pub use symbols::Shape;
use symbols::{diamond, outline, ring};

use super::labels::{self, Label};

/// The width of the picture, in its own units. It fits a phone without illegible letters.
const WIDTH: f64 = 520.0;
const HEIGHT: f64 = 400.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 504.0;
const TOP: f64 = 84.0;
const BOTTOM: f64 = 346.0;
/// The height of the band for an error of 0.
const BAND: f64 = 30.0;
/// The radius of the rings around the scene as it stands and the pick.
const RING: f64 = 10.0;

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
    /// Whether the point is the scene as it stands. It then has a ring and always a label.
    pub is_own: bool,
    /// Whether the point is the pick. It then has a diamond around it and always a label.
    pub is_pick: bool,
    /// The label beside the point, if it is on the front.
    pub label: String,
    /// The tooltip.
    pub hover: String,
    /// The fragment of the page that the point links to, without `#`.
    pub link: Option<String>,
}

impl Point {
    fn is_marked(&self) -> bool {
        self.is_own || self.is_pick
    }

    /// Returns the label, with the reason why the point is marked.
    fn full_label(&self) -> String {
        let label = &self.label;
        match (self.is_own, self.is_pick) {
            (true, true) => format!("{label}: as it stands, and the pick"),
            (true, false) => format!("{label}: as it stands"),
            (false, true) => format!("{label}: the pick"),
            (false, false) => label.clone(),
        }
    }
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
pub const FRONT: Option<&str> = Some("front: none faster and more accurate");

/// The style sheet of plots. It uses the colours of the page, if the page defines them.
pub const STYLE: &str = include_str!("plot.css");

/// Returns the picture as SVG.
pub fn svg(plot: &Plot, place: Place) -> String {
    stack(std::slice::from_ref(plot), place)
}

/// Returns the pictures below one another as one SVG, which is empty for no pictures.
pub fn stack(plots: &[Plot], place: Place) -> String {
    let height = HEIGHT * plots.len() as f64;
    // A picture with links is a group of them, since the parts of an `img` cannot be reached.
    let has_links = plots.iter().flat_map(|plot| &plot.points).any(|point| point.link.is_some());
    let role = if has_links { "group" } else { "img" };
    let titles: Vec<String> = plots.iter().map(|plot| quoted(&plot.title)).collect();
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
            role=\"{role}\" class=\"plot\" aria-label=\"{}\">\n",
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
    // The marked points come last, so that no other point hides them.
    let (marked, others): (Vec<_>, Vec<_>) =
        points.iter().copied().zip(at.iter().copied()).partition(|(point, _)| point.is_marked());
    for (point, at) in others.iter().chain(&marked) {
        let spread = [point.spread.0, point.spread.1]
            .map(|value| if value > 0.0 { x.at(value) } else { at.0 });
        out += &mark(point, *at, spread);
    }
    out + &names(&marked, &others, &at)
}

/// Returns the labels of marked points, which always have one, and of points on the front, if they
/// have room.
fn names(
    marked: &[(&Point, (f64, f64))],
    others: &[(&Point, (f64, f64))],
    at: &[(f64, f64)],
) -> String {
    let text = |point: &Point| point.full_label();
    let on_front = others.iter().filter(|(point, _)| point.is_on_front);
    let texts: Vec<(String, (f64, f64), bool)> = marked
        .iter()
        .map(|(point, at)| (text(point), *at, true))
        .chain(on_front.map(|(point, at)| (text(point), *at, false)))
        .collect();
    let wanted: Vec<Label<'_>> = texts
        .iter()
        .map(|(text, at, is_needed)| Label { text, at: *at, is_needed: *is_needed })
        .collect();
    let mut out = String::new();
    for (label, (left, base)) in labels::place(&wanted, at, (LEFT, TOP, RIGHT, BOTTOM)) {
        if label.is_needed {
            let middle = left + labels::width(label.text) / 2.0;
            let _ = writeln!(
                out,
                "<path class=\"lead\" d=\"M{:.1} {:.1}L{middle:.1} {:.1}\"/>",
                label.at.0,
                label.at.1,
                base - 4.0
            );
        }
        let class = if label.is_needed { "label marked" } else { "label" };
        let _ = writeln!(
            out,
            "<text class=\"{class}\" x=\"{left:.1}\" y=\"{base:.1}\">{}</text>",
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
        BOTTOM + 38.0,
        quoted(&plot.x)
    );
    let side = (TOP + BOTTOM) / 2.0;
    let _ = writeln!(
        out,
        "<text class=\"name middle\" transform=\"translate(16 {side}) rotate(-90)\">{}</text>",
        quoted(&plot.y)
    );
    out + &legend(plot)
}

/// Returns the legend, on as many lines as it takes.
fn legend(plot: &Plot) -> String {
    let mut items: Vec<(String, &str)> = plot
        .key
        .iter()
        .map(|(shape, is_hollow, text)| (outline(*shape, *is_hollow, (5.0, 0.0), false), *text))
        .collect();
    if plot.points.iter().any(|point| point.is_own) {
        items.push((ring((5.0, 0.0), 6.0), "the scene as it stands"));
    }
    if plot.points.iter().any(|point| point.is_pick) {
        items.push((diamond((5.0, 0.0), 7.0), "the pick"));
    }
    if let Some(line) = plot.line {
        items.push(("<path class=\"front\" d=\"M-4 0h17\"/>".to_owned(), line));
    }
    let (mut out, mut left, mut top) = (String::new(), LEFT, 38.0);
    for (symbol, text) in items {
        let width = 34.0 + labels::width(text);
        if left > LEFT && left + width > WIDTH + 14.0 {
            (left, top) = (LEFT, top + 17.0);
        }
        let _ = writeln!(
            out,
            "<g class=\"legend\" transform=\"translate({left:.1} {top})\">{symbol}\
                <text class=\"tick\" x=\"17\" y=\"4\">{}</text></g>",
            quoted(text)
        );
        left += width;
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
    let mut symbols = outline(point.shape, point.is_hollow, at, point.is_on_front);
    if point.is_own {
        symbols += &ring(at, RING);
    }
    if point.is_pick {
        symbols += &diamond(at, 1.5 * RING);
    }
    let drawn = format!(
        "<g><title>{}</title><line class=\"spread\" x1=\"{:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" \
            y2=\"{y:.1}\"/>{symbols}</g>",
        quoted(&point.hover),
        spread[0],
        spread[1],
        y = at.1,
    );
    match &point.link {
        Some(link) => format!("<a href=\"#{}\">{drawn}</a>\n", quoted(link)),
        None => drawn + "\n",
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
