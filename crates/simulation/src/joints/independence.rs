//! Whether the coordinates of a placement map are independent where it starts.
//!
//! ```text
//! rank J = n,    J = ( √m ∂x/∂q ;  √M ∂ξ/∂q ;  √I ω_Δ )        W(3.4)
//! ```
//! The columns are scaled to unit length, so that metres and radians do not enter the decision.

use nalgebra::{DMatrix, Vector3};
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};
use piola_numerics::Dual;

/// A singular value below this, of columns of unit length, means that some combination moves nothing.
const SMALL: f64 = 1e-10;

/// Groups of coordinates that are dependent at `q`: a single one moves nothing with mass.
pub(super) fn dependent_coordinates(system: &impl Holonomic, q: &[f64]) -> Vec<Vec<usize>> {
    let columns: Vec<Vec<f64>> = (0..q.len()).map(|direction| column(system, q, direction)).collect();
    let length = |column: &[f64]| column.iter().map(|x| x * x).sum::<f64>().sqrt();
    let scale = columns.iter().map(|column| length(column)).fold(0.0, f64::max);
    let (moving, still): (Vec<usize>, Vec<usize>) =
        (0..q.len()).partition(|&i| SMALL * scale < length(&columns[i]) && 0.0 < length(&columns[i]));
    let mut groups: Vec<Vec<usize>> = still.into_iter().map(|i| vec![i]).collect();
    let Some(&first) = moving.first() else { return groups };
    let rows = columns[first].len();
    let matrix = DMatrix::from_fn(rows.max(moving.len()), moving.len(), |row, i| {
        let column = &columns[moving[i]];
        column.get(row).map_or(0.0, |x| x / length(column))
    });
    let Some(decomposition) = matrix.try_svd(false, true, f64::EPSILON, 1000) else { return groups };
    let Some(right) = decomposition.v_t else { return groups };
    for (index, value) in decomposition.singular_values.iter().enumerate() {
        if SMALL <= *value {
            continue;
        }
        let null = right.row(index);
        let largest = null.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        groups.push((0..moving.len()).filter(|i| 1e-6 * largest < null[*i].abs()).map(|i| moving[i]).collect());
    }
    groups
}

/// One column of the mass-weighted Jacobian.
fn column(system: &impl Holonomic, q: &[f64], direction: usize) -> Vec<f64> {
    let seeded: Vec<Dual<f64>> = q
        .iter()
        .enumerate()
        .map(|(i, &value)| if i == direction { Dual::variable(value) } else { Dual::constant(value) })
        .collect();
    let mut column = Column(Vec::new());
    system.place(&seeded, Dual::constant(0.0), &mut column);
    column.0
}

struct Column(Vec<f64>);

impl Placement<Dual<f64>> for Column {
    fn particle(&mut self, mass: f64, position: Vector3<Dual<f64>>) {
        self.0.extend(position.iter().map(|x| mass.sqrt() * x.tangent));
    }

    fn body(&mut self, body: &RigidBody, centre: Vector3<Dual<f64>>, attitude: Attitude<Dual<f64>>) {
        self.particle(body.mass(), centre);
        let Attitude { w, x, y, z } = attitude;
        let rate = [w, x, y, z].map(|component| component.tangent);
        let attitude = Attitude { w: w.value, x: x.value, y: y.value, z: z.value };
        let spin = attitude.angular_velocity_in_body(rate);
        // I = L Lᵀ: the length of Lᵀω is the root of ω·Iω.
        if let Some(factors) = body.inertia().matrix().cholesky() {
            self.0.extend((factors.l().transpose() * spin).iter());
        }
    }
}
