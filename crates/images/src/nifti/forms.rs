//! The place of a picture from the two forms of its header, and back.

use ::nifti::NiftiHeader;

use crate::contents::{Contents, usual_directions};
use crate::forms::Forms;
use crate::sample_type::single;

/// Spacings that agree so far are the same number, rounded differently.
const SAME: f64 = 1e-4;

/// From RAS to LPS and back.
const SIGNS: [f64; 3] = [-1.0, -1.0, 1.0];

impl Forms {
    /// Those of a header; lengths in metres and micrometres become mm.
    pub(crate) fn of(header: &NiftiHeader) -> Self {
        let unit = match header.xyzt_units & 7 {
            1 => 1e3,
            3 => 1e-3,
            _ => 1.0,
        };
        let length = |number: f32| single(unit * f64::from(number));
        let &NiftiHeader { pixdim, quatern_b: b, quatern_c: c, quatern_d: d, srow_x, srow_y, srow_z, .. } = header;
        Self {
            pixdim: [pixdim[0], length(pixdim[1]), length(pixdim[2]), length(pixdim[3])],
            qform_code: header.qform_code,
            quaternion: [b, c, d, length(header.quatern_x), length(header.quatern_y), length(header.quatern_z)],
            sform_code: header.sform_code,
            rows: [srow_x, srow_y, srow_z].map(|row| row.map(length)),
        }
    }

    /// Origin, directions and spacing in LPS, for the axes in reverse.
    ///
    /// The affine map (`sform`) comes first, then the quaternion (`qform`). Without either, the axes are those of ITK: x, y and z in LPS.
    pub(crate) fn placement(&self, axes: usize) -> ([f64; 3], Vec<[f64; 3]>, Vec<f64>) {
        let [_, spacings @ ..] = self.pixdim.map(|spacing| f64::from(spacing).abs());
        if self.sform_code <= 0 && self.qform_code <= 0 {
            return ([0.0; 3], usual_directions(axes), spacings[..axes].iter().rev().copied().collect());
        }
        let (mut columns, mut origin) = if 0 < self.sform_code { self.affine() } else { self.turned(spacings) };
        let mut directions = Vec::new();
        let mut lengths = Vec::new();
        for axis in (0..axes).rev() {
            let column = &mut columns[axis];
            let length = column[0].hypot(column[1]).hypot(column[2]);
            // A column of zero length becomes a spacing of zero, which is refused with its axis.
            let direction =
                std::array::from_fn(|row| if length > 0.0 { SIGNS[row] * column[row] / length } else { 0.0 });
            directions.push(direction);
            lengths.push(if (length - spacings[axis]).abs() <= SAME * length { spacings[axis] } else { length });
        }
        for (coordinate, sign) in origin.iter_mut().zip(SIGNS) {
            *coordinate *= sign;
        }
        (origin, directions, lengths)
    }

    /// Columns and offset of the affine map.
    fn affine(&self) -> ([[f64; 3]; 3], [f64; 3]) {
        let rows = self.rows.map(|row| row.map(f64::from));
        (std::array::from_fn(|axis| rows.map(|row| row[axis])), rows.map(|row| row[3]))
    }

    /// Columns and offset of the rotation by the quaternion, after the spacings.
    fn turned(&self, spacings: [f64; 3]) -> ([[f64; 3]; 3], [f64; 3]) {
        let [b, c, d, offset @ ..] = self.quaternion.map(f64::from);
        let square = b * b + c * c + d * d;
        // Rounding takes half a turn beyond one; such a quaternion is normalised.
        let (a, scale) = if square < 1.0 { ((1.0 - square).sqrt(), 1.0) } else { (0.0, square.sqrt()) };
        let [b, c, d] = [b, c, d].map(|part| part / scale);
        let rotation = [
            [a * a + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)],
            [2.0 * (b * c + a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d - a * b)],
            [2.0 * (b * d - a * c), 2.0 * (c * d + a * b), a * a + d * d - b * b - c * c],
        ];
        let handedness = if self.pixdim[0] < 0.0 { -1.0 } else { 1.0 };
        let columns = std::array::from_fn(|axis| {
            let sign = if axis == 2 { handedness } else { 1.0 };
            rotation.map(|row| sign * spacings[axis] * row[axis])
        });
        (columns, offset)
    }

    /// Those of a picture that has none: both forms, as positions in a scanner.
    pub(crate) fn placing(contents: &Contents) -> Self {
        let axes = contents.sizes.len();
        let mut columns = [[0.0; 3]; 3];
        let mut pixdim = [1.0; 4];
        for axis in 0..axes {
            let (direction, spacing) = (contents.directions[axes - 1 - axis], contents.spacing[axes - 1 - axis]);
            columns[axis] = std::array::from_fn(|row| SIGNS[row] * direction[row]);
            pixdim[axis + 1] = spacing;
        }
        if axes == 2 {
            columns[2] = cross(columns[0], columns[1]);
        }
        let offset: [f64; 3] = std::array::from_fn(|row| SIGNS[row] * contents.origin[row]);
        let is_right_handed = 0.0 < dot(cross(columns[0], columns[1]), columns[2]);
        pixdim[0] = if is_right_handed { 1.0 } else { -1.0 };
        let mut proper = columns;
        proper[2] = columns[2].map(|component| pixdim[0] * component);
        let [b, c, d] = quaternion(proper);
        let rows = std::array::from_fn(|row| {
            std::array::from_fn(|axis| {
                single(if axis < 3 { columns[axis][row] * pixdim[axis + 1] } else { offset[row] })
            })
        });
        Self {
            pixdim: pixdim.map(single),
            qform_code: 1,
            quaternion: [b, c, d, offset[0], offset[1], offset[2]].map(single),
            sform_code: 1,
            rows,
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// b, c, d of the unit quaternion with 0 ≤ a, from the columns of a rotation.
///
/// The largest of the four components is found from the diagonal, the others by division by it.
fn quaternion([x, y, z]: [[f64; 3]; 3]) -> [f64; 3] {
    let squares =
        [1.0 + x[0] + y[1] + z[2], 1.0 + x[0] - y[1] - z[2], 1.0 - x[0] + y[1] - z[2], 1.0 - x[0] - y[1] + z[2]];
    let largest = (0..4).fold(0, |best, next| if squares[best] < squares[next] { next } else { best });
    let twice = squares[largest].max(0.0).sqrt();
    let parts = match largest {
        0 => [twice * twice, y[2] - z[1], z[0] - x[2], x[1] - y[0]],
        1 => [y[2] - z[1], twice * twice, x[1] + y[0], z[0] + x[2]],
        2 => [z[0] - x[2], x[1] + y[0], twice * twice, y[2] + z[1]],
        _ => [x[1] - y[0], z[0] + x[2], y[2] + z[1], twice * twice],
    };
    let [a, b, c, d] = parts.map(|part| 0.5 * part / twice);
    let sign = if a < 0.0 { -1.0 } else { 1.0 };
    [sign * b, sign * c, sign * d]
}
