//! Converts transforms to matrices. [rule 20]

use glam::{DAffine3, DMat3, DVec3};

use super::raw::objects::{RawRotation, RawScale, RawShear, RawTransform};
use crate::maths;

/// Volume below which a matrix counts as singular.
///
/// The volume is |det| over the product of the lengths of the columns (or of the rows, if that is
/// larger). It is 1 for every rotation and scale, and does not change with the unit of length.
const LEAST_VOLUME: f64 = 1e-9;

/// Returns the matrix of one step, or the reason why it has none.
pub(crate) fn matrix(step: &RawTransform) -> Result<DAffine3, &'static str> {
    let map = match step {
        RawTransform::Translate(by) => DAffine3::from_translation(by.get()),
        RawTransform::Rotate(turn) => DAffine3::from_mat3(rotation(turn)),
        RawTransform::Scale(RawScale::Uniform(factor)) => {
            DAffine3::from_scale(DVec3::splat(factor.get()))
        }
        RawTransform::Scale(RawScale::Axes(factors)) => DAffine3::from_scale(factors.get()),
        RawTransform::Shear(shear) => DAffine3::from_mat3(slant(shear)),
        RawTransform::Matrix(rows) => {
            let rows = rows.map(|row| row.map(|number| number.get()));
            if rows[3] != [0.0, 0.0, 0.0, 1.0] {
                return Err("the last row of a matrix is [0, 0, 0, 1]");
            }
            let column = |j: usize| DVec3::new(rows[0][j], rows[1][j], rows[2][j]);
            DAffine3 {
                matrix3: DMat3::from_cols(column(0), column(1), column(2)),
                translation: column(3),
            }
        }
    };
    if is_invertible(&map) {
        Ok(map)
    } else {
        Err("this matrix is singular, or nearly so: it flattens space")
    }
}

/// Returns whether `map` has a reliable inverse. The unit of length makes no difference.
pub(crate) fn is_invertible(map: &DAffine3) -> bool {
    let matrix = map.matrix3;
    map.is_finite() && volume(matrix).max(volume(matrix.transpose())) >= LEAST_VOLUME
}

/// Returns |det| of the matrix with its columns normalised, or 0 if one of them is zero.
fn volume(matrix: DMat3) -> f64 {
    let unit = |column| super::raw::numbers::unit(column).unwrap_or(DVec3::ZERO);
    DMat3::from_cols(unit(matrix.x_axis), unit(matrix.y_axis), unit(matrix.z_axis))
        .determinant()
        .abs()
}

/// Returns the matrix of a rotation by Rodrigues' formula. Multiples of 90 degrees are exact.
fn rotation(turn: &RawRotation) -> DMat3 {
    let (axis, (sin, cos)) = (turn.axis.get(), sin_cos_deg(turn.angle_deg.get()));
    let cross = DMat3::from_cols(axis.cross(DVec3::X), axis.cross(DVec3::Y), axis.cross(DVec3::Z));
    let outer = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
    DMat3::IDENTITY * cos + outer * (1.0 - cos) + cross * sin
}

fn sin_cos_deg(degrees: f64) -> (f64, f64) {
    let degrees = degrees % 360.0;
    let quarters = (degrees / 90.0).round();
    let rest = (degrees - 90.0 * quarters).to_radians();
    let (sin, cos) = (maths::sin(rest), maths::cos(rest));
    match (quarters as i64).rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

fn slant(shear: &RawShear) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(1.0, shear.yx.get(), shear.zx.get()),
        DVec3::new(shear.xy.get(), 1.0, shear.zy.get()),
        DVec3::new(shear.xz.get(), shear.yz.get(), 1.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        for (degrees, sin, cos) in
            [(0.0, 0.0, 1.0), (90.0, 1.0, 0.0), (180.0, 0.0, -1.0), (-90.0, -1.0, 0.0)]
        {
            for turns in [-720.0, 0.0, 360.0] {
                assert_eq!(sin_cos_deg(degrees + turns), (sin, cos), "{degrees} + {turns}");
            }
        }
        let (sin, cos) = sin_cos_deg(30.0);
        assert!((sin - 0.5).abs() < 1e-15 && (cos - 0.75f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn singular_means_the_same_in_every_unit_of_length() {
        let skewed = DMat3::from_cols(DVec3::ONE, DVec3::new(1.0, 1.0, 1.0 + 1e-12), DVec3::Y);
        let table = [
            (DMat3::IDENTITY, true),
            (DMat3::from_diagonal(DVec3::new(1.0, 1.0, 1e-12)), true),
            (rows_of_unequal_length(), true),
            (skewed, false),
            (DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0)), false),
            (DMat3::from_cols(DVec3::ONE, DVec3::ONE, DVec3::Y), false),
        ];
        for (matrix, expected) in table {
            for unit in [1e-15, 1.0, 1e15] {
                assert_eq!(
                    is_invertible(&DAffine3::from_mat3(matrix * unit)),
                    expected,
                    "{matrix} in {unit}"
                );
            }
        }
    }

    fn rows_of_unequal_length() -> DMat3 {
        DMat3::from_diagonal(DVec3::new(1.0, 1.0, 1e-12)) * DMat3::from_rotation_y(1.0)
    }
}
