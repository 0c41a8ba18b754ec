//! The correct answers to questions: decisions by exact arithmetic on the numbers of the question,
//! values to some 190 bits.
//!
//! Borders belong to the shapes (D3). A tangent line hits a sphere once. Exactly at the critical
//! angle a ray is transmitted (D14). A plane parallel to the line, a triangle without area or edge
//! on, and the side of a cone that contains the line are misses.

use super::evaluate::Found;
use super::exact::{Exact, Exact3, ExactLine, cross, dot, exact3, minus, plus, times, unit};
use super::oracle_round;
use super::question::{Form, Question};

/// Returns the correct answer. A miss, total internal reflection and a singular matrix are `None`.
/// A sphere without radius has no normal.
pub fn right(question: &Question) -> Option<Found<Exact>> {
    match *question {
        Question::Sphere { line, center, radius } => {
            let line = ExactLine::of(&line);
            let from_center = minus(&line.origin, &exact3(center));
            let t = sphere(&from_center, &line.direction, &Exact::of(radius))?;
            if radius == 0.0 {
                return Some(Found::at(t));
            }
            let normal = unit(&plus(&from_center, &times(&line.direction, &t)));
            Some(Found::hit(t, normal))
        }
        Question::Plane { line, normal, k } => {
            plane(&ExactLine::of(&line), &exact3(normal), &Exact::of(k)).map(Found::at)
        }
        Question::Square { line } => square(&ExactLine::of(&line), &Exact::of(0.5)),
        Question::Cuboid { line, min, max } => {
            cuboid(&ExactLine::of(&line), &exact3(min), &exact3(max))
        }
        Question::Round { line, radii, ends, is_capped } => oracle_round::round(
            &ExactLine::of(&line),
            &radii.map(Exact::of),
            &ends.map(Exact::of),
            is_capped,
        ),
        Question::Triangle { line, corners } => {
            triangle(&ExactLine::of(&line), &corners.map(exact3))
        }
        Question::Transformed { line, form, rows, translation } => {
            transformed(&ExactLine::of(&line), &form, &rows.map(exact3), &exact3(translation))
        }
        Question::Reflect { direction, normal } => {
            Some(reflect(&exact3(direction), &exact3(normal)))
        }
        Question::Refract { direction, normal, eta_i, eta_t } => {
            refract(&exact3(direction), &exact3(normal), &Exact::of(eta_i), &Exact::of(eta_t))
        }
        Question::Normal { rows, normal } => {
            let cofactors = cofactors(&rows.map(exact3));
            let sign = dot(&exact3(rows[0]), &cofactors[0]).sign();
            (sign != 0).then(|| Found::direction(unit(&turned(&cofactors, &exact3(normal), sign))))
        }
    }
}

/// Returns t for the sphere about the origin. The line starts at `from`.
fn sphere(from: &Exact3, direction: &Exact3, radius: &Exact) -> Option<Exact> {
    let (a, b) = (dot(direction, direction), -&dot(from, direction));
    let c = &dot(from, from) - &radius.squared();
    let disc = &b.squared() - &(&a * &c);
    if a.sign() == 0 || disc.sign() < 0 || (c.sign() >= 0 && b.sign() <= 0) {
        return None;
    }
    let root = disc.sqrt();
    let is_near = c.sign() > 0;
    Some(match (is_near, b.sign() < 0) {
        (true, _) => c.over(&(&b + &root)),
        (false, false) => (&b + &root).over(&a),
        (false, true) => c.over(&(&b - &root)),
    })
}

fn plane(line: &ExactLine, normal: &Exact3, k: &Exact) -> Option<Exact> {
    let slope = dot(normal, &line.direction);
    let rest = k - &dot(normal, &line.origin);
    (slope.sign() * rest.sign() > 0).then(|| rest.over(&slope))
}

fn square(line: &ExactLine, half: &Exact) -> Option<Found<Exact>> {
    let (o, d) = (&line.origin, &line.direction);
    if o[2].sign() * d[2].sign() >= 0 {
        return None;
    }
    let is_within = |n: usize| {
        let at = &(&o[n] * &d[2]) - &(&o[2] * &d[n]); // the coordinate, multiplied by d_z
        let reach = (half * &d[2]).squared();
        at.squared() <= reach
    };
    (is_within(0) && is_within(1)).then(|| Found::at((-&o[2]).over(&d[2])))
}

/// A ray parameter as a quotient with a positive divisor.
struct Quotient(Exact, Exact);

impl Quotient {
    fn of(rest: &Exact, along: &Exact) -> Self {
        if along.sign() < 0 { Self(-rest, -along) } else { Self(rest.clone(), along.clone()) }
    }

    fn is_less(&self, other: &Self) -> bool {
        &self.0 * &other.1 < &other.0 * &self.1
    }
}

fn cuboid(line: &ExactLine, min: &Exact3, max: &Exact3) -> Option<Found<Exact>> {
    let (mut enter, mut leave): (Option<(Quotient, _)>, Option<(Quotient, _)>) = (None, None);
    for axis in 0..3 {
        let (from, along) = (&line.origin[axis], &line.direction[axis]);
        if along.sign() == 0 {
            if from < &min[axis] || from > &max[axis] {
                return None;
            }
            continue;
        }
        let side = |is_max: bool| {
            let face = if is_max { &max[axis] } else { &min[axis] };
            let normal = std::array::from_fn(|n| match (n == axis, is_max) {
                (false, _) => Exact::ZERO,
                (true, is_max) => Exact::of(if is_max { 1.0 } else { -1.0 }),
            });
            (Quotient::of(&(face - from), along), normal)
        };
        let (first, last) = (side(along.sign() < 0), side(along.sign() > 0));
        enter = match enter {
            Some(known) if !known.0.is_less(&first.0) => Some(known),
            _ => Some(first),
        };
        leave = match leave {
            Some(known) if !last.0.is_less(&known.0) => Some(known),
            _ => Some(last),
        };
    }
    let (enter, leave) = (enter?, leave?);
    if leave.0.is_less(&enter.0) {
        return None;
    }
    let (t, normal) = [enter, leave].into_iter().find(|(t, _)| t.0.sign() > 0)?;
    Some(Found::hit(t.0.over(&t.1), normal))
}

fn triangle(line: &ExactLine, corners: &[Exact3; 3]) -> Option<Found<Exact>> {
    let [a, b, c] = corners;
    let normal = cross(&minus(b, a), &minus(c, a));
    let slope = dot(&normal, &line.direction);
    let rest = dot(&normal, &minus(a, &line.origin));
    if slope.sign() * rest.sign() <= 0 {
        return None;
    }
    let [a, b, c] = [a, b, c].map(|corner| minus(corner, &line.origin));
    let volume = |p: &Exact3, q: &Exact3| dot(&line.direction, &cross(p, q));
    let volumes = [volume(&b, &c), volume(&c, &a), volume(&a, &b)];
    if volumes.iter().any(|v| v.sign() * slope.sign() < 0) {
        return None;
    }
    let weights = volumes.map(|v| v.over(&slope)); // their sum is N·d
    Some(Found { weights: Some(weights), ..Found::hit(rest.over(&slope), unit(&normal)) })
}

/// Returns the rows of the cofactor matrix, det A · A⁻ᵀ.
fn cofactors(rows: &[Exact3; 3]) -> [Exact3; 3] {
    let [x, y, z] = rows;
    [cross(y, z), cross(z, x), cross(x, y)]
}

fn turned(cofactors: &[Exact3; 3], normal: &Exact3, sign: i32) -> Exact3 {
    std::array::from_fn(|n| {
        let along = dot(&cofactors[n], normal);
        if sign < 0 { -&along } else { along }
    })
}

/// Intersects the transformed shape. O − t and d are multiplied by |det A| A⁻¹, which is a matrix
/// of cofactors, and so are the lengths of the shape: that changes no root.
fn transformed(
    line: &ExactLine,
    form: &Form,
    rows: &[Exact3; 3],
    translation: &Exact3,
) -> Option<Found<Exact>> {
    let cofactors = cofactors(rows);
    let det = dot(&rows[0], &cofactors[0]);
    let sign = det.sign();
    if sign == 0 {
        return None;
    }
    let size = if sign < 0 { -&det } else { det };
    let to_object = |v: &Exact3| -> Exact3 {
        std::array::from_fn(|n| {
            let column = [&cofactors[0][n], &cofactors[1][n], &cofactors[2][n]].map(Exact::clone);
            let along = dot(&column, v);
            if sign < 0 { -&along } else { along }
        })
    };
    let line = ExactLine {
        origin: to_object(&minus(&line.origin, translation)),
        direction: to_object(&line.direction),
    };
    let length = |x: f64| &Exact::of(x) * &size;
    let point = |v: [f64; 3]| times(&exact3(v), &size);
    let found = match *form {
        Form::Sphere { center, radius } => {
            let from_center = minus(&line.origin, &point(center));
            let t = sphere(&from_center, &line.direction, &length(radius))?;
            let normal = plus(&from_center, &times(&line.direction, &t));
            Found::hit(t, normal)
        }
        Form::Plane { normal, k } => {
            Found::hit(plane(&line, &exact3(normal), &length(k))?, exact3(normal))
        }
        Form::Square => {
            let found = square(&line, &length(0.5))?;
            Found { vector: Some(exact3([0.0, 0.0, 1.0])), ..found }
        }
        Form::Cuboid { min, max } => cuboid(&line, &point(min), &point(max))?,
        Form::Round { radii, ends, is_capped } => {
            oracle_round::round(&line, &radii.map(length), &ends.map(length), is_capped)?
        }
    };
    let to_world = |normal: Exact3| unit(&turned(&cofactors, &normal, sign));
    Some(Found { vector: found.vector.map(to_world), ..found })
}

fn reflect(direction: &Exact3, normal: &Exact3) -> Found<Exact> {
    let twice = dot(direction, normal).scaled(1).over(&dot(normal, normal));
    Found::direction(minus(direction, &times(normal, &twice)))
}

/// Returns the transmitted unit direction for the unit vectors along `direction` and `normal`.
/// Intermediate lengths are multiplied by w = ‖d‖ ‖N‖.
fn refract(
    direction: &Exact3,
    normal: &Exact3,
    eta_i: &Exact,
    eta_t: &Exact,
) -> Option<Found<Exact>> {
    let (d_squared, n_squared) = (dot(direction, direction), dot(normal, normal));
    let w_squared = &d_squared * &n_squared;
    let cos_i = -&dot(direction, normal); // multiplied by w
    let square =
        &(&(&eta_t.squared() - &eta_i.squared()) * &w_squared) + &(eta_i * &cos_i).squared();
    if square.sign() < 0 {
        return None;
    }
    let d_length = d_squared.sqrt();
    let along_d = eta_i.over(&(eta_t * &d_length));
    let across = &(eta_i * &cos_i) - &square.sqrt(); // multiplied by w η_t
    let along_n = across.over(&(&(eta_t * &d_length) * &n_squared));
    Some(Found::direction(plus(&times(direction, &along_d), &times(normal, &along_n))))
}

#[cfg(test)]
mod tests {
    use super::super::question::{Form, Line};
    use super::*;

    fn check(question: Question, t: Option<f64>) {
        let found = right(&question).map(|found| found.t.expect("a parameter").f64());
        assert_eq!(found, t, "{question:?}");
    }

    const fn line(origin: [f64; 3], direction: [f64; 3]) -> Line {
        Line { origin, direction }
    }

    #[test]
    fn spheres_are_decided_to_the_last_place() {
        let sphere = |x: f64| {
            let line = line([x, 0.0, -5.0], [0.0, 0.0, 1.0]);
            Question::Sphere { line, center: [0.0; 3], radius: 1.0 }
        };
        check(sphere(1.0), Some(5.0));
        check(sphere(1.0f64.next_up()), None);
        // The double 0.6 is not 3/5, so t is only near 4.2.
        check(sphere(0.6), right(&sphere(0.6)).and_then(|f| f.t).map(|t| t.f64()));
        let within = line([0.0, 0.0, 0.5], [0.0, 0.0, -2.0]);
        check(Question::Sphere { line: within, center: [0.0; 3], radius: 1.0 }, Some(0.75));
        let on_it = line([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
        check(Question::Sphere { line: on_it, center: [0.0; 3], radius: 1.0 }, Some(2.0));
        let leaving = line([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
        check(Question::Sphere { line: leaving, center: [0.0; 3], radius: 1.0 }, None);
    }

    #[test]
    fn flat_shapes_have_closed_borders() {
        check(Question::Square { line: line([0.5, -0.5, 2.0], [0.0, 0.0, -1.0]) }, Some(2.0));
        check(
            Question::Square { line: line([0.5f64.next_up(), -0.5, 2.0], [0.0, 0.0, -1.0]) },
            None,
        );
        check(Question::Square { line: line([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]) }, None);
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        check(
            Question::Triangle { line: line([0.5, 0.5, 1.0], [0.0, 0.0, -1.0]), corners },
            Some(1.0),
        );
        check(
            Question::Triangle {
                line: line([0.5, 0.5f64.next_up(), 1.0], [0.0, 0.0, -1.0]),
                corners,
            },
            None,
        );
        check(
            Question::Triangle { line: line([0.0, 0.0, -1.0], [0.0, 0.0, 0.5]), corners },
            Some(2.0),
        );
        check(
            Question::Plane {
                line: line([0.0; 3], [0.0, 1.0, 0.0]),
                normal: [0.6, 0.8, 0.0],
                k: 2.0,
            },
            Some(2.5),
        );
    }

    #[test]
    fn boxes_are_hit_at_the_lower_axis() {
        let (min, max) = ([0.0; 3], [1.0, 2.0, 3.0]);
        let edge = Question::Cuboid { line: line([-1.0, -1.0, 1.0], [1.0, 1.0, 0.0]), min, max };
        check(edge, Some(1.0));
        let normal = right(&edge).and_then(|found| found.vector).map(|n| n.map(|x| x.f64()));
        assert_eq!(normal, Some([-1.0, 0.0, 0.0]));
        check(
            Question::Cuboid { line: line([-1.0, 2.0, 1.0], [1.0, -0.0, 0.0]), min, max },
            Some(1.0),
        );
        check(
            Question::Cuboid { line: line([0.5, 1.0, 1.0], [0.0, -2.0, 0.0]), min, max },
            Some(0.5),
        );
    }

    #[test]
    fn directions_are_those_of_the_paper() {
        let found =
            |question| right(&question).and_then(|found| found.vector).map(|v| v.map(|x| x.f64()));
        let direction = [3.0, -4.0, 0.0];
        assert_eq!(
            found(Question::Reflect { direction, normal: [0.0, 2.0, 0.0] }),
            Some([3.0, 4.0, 0.0])
        );
        // η = 4/3 and sin θ_i = 3/5 give sin θ_t = 4/5.
        let bent =
            found(Question::Refract { direction, normal: [0.0, 2.0, 0.0], eta_i: 4.0, eta_t: 3.0 })
                .expect("T");
        assert!((bent[0] - 0.8).abs() < 1e-16 && (bent[1] + 0.6).abs() < 1e-16, "{bent:?}");
        let steep = Question::Refract {
            direction: [4.0, -3.0, 0.0],
            normal: [0.0, 1.0, 0.0],
            eta_i: 5.0,
            eta_t: 4.0,
        };
        assert_eq!(found(steep), Some([1.0, 0.0, 0.0]), "exactly critical");
        let mirrored = Question::Normal {
            rows: [[-2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            normal: [1.0, 0.0, 0.0],
        };
        assert_eq!(found(mirrored), Some([-1.0, 0.0, 0.0]));
        let flat = Question::Normal {
            rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]],
            normal: [1.0, 0.0, 0.0],
        };
        assert_eq!(found(flat), None);
    }

    #[test]
    fn a_transformed_sphere_is_hit() {
        let rows = [[2.0, 0.0, 0.0], [0.0, -2.0, 0.0], [0.0, 0.0, 8.0]];
        let question = Question::Transformed {
            line: line([1.0, 0.0, -9.0], [0.0, 0.0, 1.0]),
            form: Form::SPHERE,
            rows,
            translation: [1.0, 0.0, 0.0],
        };
        check(question, Some(5.0));
        let normal = right(&question).and_then(|found| found.vector).map(|n| n.map(|x| x.f64()));
        assert_eq!(normal, Some([0.0, 0.0, -1.0]));
    }
}
