//! Nanson's formula against areas measured on the image of a surface.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{DeformationGradient, ReferenceNormal};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{deformation, direction};

/// x = A X + (b · X)(C X): a motion of the second degree.
struct Motion {
    linear: Matrix3<f64>,
    along: Vector3<f64>,
    bending: Matrix3<f64>,
}

impl Motion {
    fn place(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.linear * x + self.bending * x * self.along.dot(x)
    }
    fn gradient(&self, x: &Vector3<f64>) -> Matrix3<f64> {
        self.linear + self.bending * self.along.dot(x) + self.bending * x * self.along.transpose()
    }
}

/// ½ ∫ x × dx along the image of a straight edge, from three places of it alone: exact where they lie on a parabola.
fn half_moment(motion: &Motion, from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    let [x, y, z] = [from, (from + to) * 0.5, to].map(|point| motion.place(&point));
    let first = y * 4.0 - x * 3.0 - z;
    let last = z * 3.0 - y * 4.0 + x;
    (x.cross(&first) + y.cross(&(z - x)) * 4.0 + z.cross(&last)) / 12.0
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn area_of_a_curved_image_by_its_edge_equals_nansons_over_the_patch(
        a in deformation(), along in direction(), bending in deformation(),
        corner in direction(), s in direction(), t in direction(),
    ) {
        let motion = Motion { linear: *a.matrix(), along, bending: bending.matrix() * 0.05 };
        let sides = s.cross(&t);
        prop_assume!(0.01 < sides.norm());
        let corners = [corner, corner + s, corner + s + t, corner + t, corner];
        let by_edge: Vector3<f64> = corners.windows(2).map(|edge| half_moment(&motion, edge[0], edge[1])).sum();
        // J F⁻ᵀ (s × t) is of the second degree over the patch: two Gauss points each way integrate it.
        let node = 0.5 / 3.0_f64.sqrt();
        let normal = ReferenceNormal::new(sides).expect("a direction");
        let mut by_nanson = Vector3::zeros();
        for (u, v) in [(-node, -node), (-node, node), (node, -node), (node, node)] {
            let f = DeformationGradient::new(motion.gradient(&(corner + s * (0.5 + u) + t * (0.5 + v))));
            prop_assume!(f.is_ok());
            by_nanson += normal.deformed(&f.expect("0 < det F")).vector * (0.25 * sides.norm());
        }
        // Places within 8, products of two of them in the moments; cofactors of F.
        let scale = corners.iter().map(|x| motion.place(x).norm_squared()).fold(1.0, f64::max);
        assert_close_at_scale("∫ n da", by_nanson.as_slice(), by_edge.as_slice(), scale, Tol::ulps(64.0));
    }
}
