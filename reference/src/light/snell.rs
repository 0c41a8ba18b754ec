//! Refraction by Snell's law without assuming unit vectors, with a certain decision on total
//! internal reflection. [rule 8] [rule 10]

use crate::numbers::real::{Real, exponent, scaled};
use crate::numbers::two::{Two, Two3};
use crate::numbers::vec3::Vec3;

/// Returns the unit vector T for a ray along `d` through a surface with the normal `n`, of any
/// length.
///
/// The result is `None` beyond the critical angle, or if the direction or the normal is 0. Exactly
/// at the critical angle T runs along the surface.
///
/// With m = d × N and w = ‖d‖‖N‖, the sign of K = (η_t w)² − (η_i ‖m‖)² decides. K is a product
/// where θ_i is small, and has the form of D13 elsewhere. It therefore cancels only near the
/// critical angle. T = (η_i N × m − √K N) / (η_t ‖N‖² ‖d‖).
///
/// With u half an ulp, m is off by 4u w at most, and so K by 24u (η_i² + η_t²) w² in either form.
/// Where K is not far greater than twice that, it is computed again in two words.
#[inline(always)]
pub fn transmitted<T: Real>(d: Vec3<T>, n: Vec3<T>, eta_i: T, eta_t: T) -> Option<Vec3<T>> {
    let (dd, nn, along) = (d.dot(d), n.dot(n), d.dot(n));
    let m = d.cross(n);
    let (mm, ww) = (m.dot(m), dd * nn);
    let w = ww.sqrt();
    let k = if mm < along * along {
        let sine = eta_i * mm.sqrt();
        (eta_t * w - sine) * (eta_t * w + sine)
    } else {
        (eta_t - eta_i) * (eta_t + eta_i) * ww + (eta_i * along) * (eta_i * along)
    };
    let doubt = (eta_i * eta_i + eta_t * eta_t) * ww * (T::of(32.0) * T::ULP);
    let is_certain = k.abs() > doubt * T::MARGIN
        && doubt.is_safe()
        && dd.is_safe()
        && nn.is_safe()
        && eta_t.is_safe();
    if !is_certain {
        return settled(d, n, eta_i, eta_t);
    }
    if k < T::ZERO {
        return None;
    }
    Some((n.cross(m) * eta_i - n * k.sqrt()) * (T::ONE / (eta_t * nn * dd.sqrt())))
}

/// Returns the same T as [`transmitted`], computed in two words of f64.
#[cold]
#[inline(never)]
fn settled<T: Real>(d: Vec3<T>, n: Vec3<T>, eta_i: T, eta_t: T) -> Option<Vec3<T>> {
    let (d, n) = (near_one([d.x, d.y, d.z]), near_one([n.x, n.y, n.z]));
    let [eta_i, eta_t] = near_one([eta_i, eta_t]);
    let vector = |v: [f64; 3]| Two3::of(Vec3::new(v[0], v[1], v[2]));
    let terms: f64 = (0..3).map(|axis| (d[axis] * n[axis]).abs()).sum();
    let (d, n) = (vector(d), vector(n));
    let (dd, nn, along, m) = (d.dot(d), n.dot(n), d.dot(n).certain(terms), d.cross(n));
    let difference = Two::sum(eta_t, -eta_i) * Two::sum(eta_t, eta_i) * dd * nn;
    let rest = Two::of(eta_i) * along;
    let in_rest = eta_i * terms * 2.0 * rest.f64().abs();
    let k = (difference + rest * rest).certain(difference.f64().abs() + in_rest);
    let is_through = k >= Two::ZERO && dd.f64() > 0.0 && nn.f64() > 0.0 && eta_t != 0.0;
    is_through.then(|| {
        let size = Two::of(eta_t) * nn * dd.sqrt();
        let t = (n.cross(m) * (Two::of(eta_i) / size) - n * (k.sqrt() / size)).f64();
        Vec3::new(T::of(t.x), T::of(t.y), T::of(t.z))
    })
}

/// Returns the numbers multiplied by a common power of two, so that the greatest is about 1.
fn near_one<T: Real, const N: usize>(values: [T; N]) -> [f64; N] {
    let values = values.map(T::f64);
    let greatest = values.iter().map(|x| exponent(*x)).max().unwrap_or(0);
    values.map(|x| scaled(x, -greatest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(d: [f64; 3], n: [f64; 3], etas: [f64; 2], expected: Option<[f64; 3]>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let found = transmitted(vec(d), vec(n), etas[0], etas[1]);
        let is_right = match (found, expected) {
            (Some(t), Some(wanted)) => (t - vec(wanted)).abs().max_element() <= f64::EPSILON,
            _ => found.is_none() && expected.is_none(),
        };
        assert!(is_right, "{d:?} through {n:?} with {etas:?}: {found:?} is not {expected:?}");
    }

    #[test]
    fn directions_computed_on_paper() {
        check([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.5], Some([0.0, -1.0, 0.0]));
        // sin 4/5 becomes 3/5
        check([4.0, -3.0, 0.0], [0.0, 2.0, 0.0], [3.0, 4.0], Some([0.6, -0.8, 0.0]));
        check([3.0, -4.0, 0.0], [0.0, 1.0, 0.0], [1.5, 1.5], Some([0.6, -0.8, 0.0]));
        check([4.0, -3.0, 0.0], [0.0, 1.0, 0.0], [5.0, 3.0], None);
        check([0.0; 3], [0.0, 1.0, 0.0], [1.0, 1.5], None);
    }

    #[test]
    fn the_critical_angle_is_exact_to_the_last_place() {
        let (d, n) = ([4.0, -3.0, 0.0], [0.0, 1.0, 0.0]);
        check(d, n, [5.0, 4.0], Some([1.0, 0.0, 0.0])); // sin 4/5 becomes 1
        check(d, n, [5.0, 4f64.next_down()], None);
        check([4.0, (-3f64).next_up(), 0.0], n, [5.0, 4.0], None);
        check(
            d.map(|x| scaled(x, 900)),
            n.map(|x| scaled(x, -900)),
            [5.0, 4.0],
            Some([1.0, 0.0, 0.0]),
        );
    }
}
