//! Residual stress to first order: incompatibility, meshes.

use nalgebra::Vector3;
use piola_continuum::Symmetric;
use piola_fields::compatibility::incompatibility;
use piola_fields::integral::{Cuboid, QuadraticTetrahedra, TetrahedralMesh};
use piola_fields::{Field, Material, Motion};
use piola_numerics::{Gradient, Real};
use piola_solids::Stiffness;
use piola_testkit::{Tol, assert_close_at_scale, assert_order};
use piola_uniformity::residual_stress::{LinearResidualStress, NaturalStrain, incompatibility_of_dislocations};
use piola_uniformity::{CharacteristicMetric, InverseMap, UniformityMap};
use proptest::prelude::*;

use super::fixtures::{Waves, point, waves};

/// sym K⁻¹ of a map that is given by K⁻¹.
struct DualStrain(Waves);

impl Field for DualStrain {
    type Value = Symmetric;
    fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
        let dual = self.0.at(place);
        Symmetric::symmetric_part([0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| dual[(i, j)])))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn dislocations_make_the_incompatibility_of_the_dual_strain(dual in waves(), x in point()) {
        let eta = incompatibility_of_dislocations(&InverseMap(dual), &x)?;
        let expected = incompatibility(&Material(DualStrain(dual)), &x, 0.0)?;
        let scale = expected.scale.components.iter().fold(1.0_f64, |a, b| a.max(b.abs()));
        let tol = Tol::ulps_because(512.0, "K⁻¹ is inverted twice and differentiated twice");
        assert_close_at_scale("η", &eta.components, &expected.value.components, scale, tol);
    }

    #[test]
    fn natural_strain_is_that_of_the_dual_to_first_order(dual in waves(), x in point()) {
        // ½ (M − 1) with M = K⁻ᵀK⁻¹ and K⁻¹ = 1 + s β: sym β s + ½ s² βᵀβ.
        struct Small(Waves, f64);
        impl UniformityMap for Small {
            fn at<T: Real>(&self, place: &Vector3<T>) -> nalgebra::Matrix3<T> {
                let k = self.0.at(place);
                nalgebra::Matrix3::from_fn(|i, j| {
                    let one = if i == j { T::one() } else { T::zero() };
                    one + T::lit(self.1) * (k[(i, j)] - one)
                })
            }
        }
        let s = 1e-6;
        let strain = NaturalStrain(CharacteristicMetric(InverseMap(Small(dual, s)))).at(&x, 0.0);
        let expected = (DualStrain(dual).at(&x, 0.0) - Symmetric::identity()) * s;
        let tol = Tol::stated(3.0 * s, "terms of second order");
        assert_close_at_scale("ε*", &strain.components, &expected.components, s, tol);
    }
}

/// A displacement that is no polynomial, and the strain it has.
#[derive(Clone, Copy)]
struct Compatible;

impl Motion for Compatible {
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        reference + self.displacement(reference, t)
    }
    fn displacement<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
        let [x, y, z] = (*reference).into();
        let n = T::lit;
        Vector3::new(n(0.3) * (x + y).sin(), n(0.2) * (z * x).cos(), n(0.1) * (y * z).exp())
    }
}

fn strain_of<T: Real>(place: &Vector3<T>) -> Symmetric<T> {
    let variables = Vector3::from_fn(|i, _| Gradient::<T, 3>::variable(place[i], i));
    let u = Compatible.displacement(&variables, Gradient::constant(T::zero()));
    Symmetric::symmetric_part([0, 1, 2].map(|i: usize| u[i].partials))
}

/// The stress of a function φ = [x(1 − x) y(1 − y) z(1 − z)]² b: T = curl curl φ A is in equilibrium and leaves the faces of the unit cube free.
fn exact_stress(place: &Vector3<f64>) -> Symmetric {
    struct Function;
    impl Field for Function {
        type Value = Symmetric;
        fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
            let bump = (0..3).fold(T::one(), |product, i| product * place[i] * (T::one() - place[i]));
            let factor = T::lit(4096.0) * bump * bump;
            Symmetric { components: [1.0, 0.5, -0.7, 0.3, 0.4, -0.2].map(|a| T::lit(a) * factor) }
        }
    }
    // inc is symmetric and free of divergence (Beltrami), and on the faces φ and its gradient vanish.
    incompatibility(&Material(Function), place, 0.0).expect("finite").value
}

/// ε* = sym ∇u − C⁻¹ T: the body at rest has the stress T and the displacement u.
struct Manufactured(piola_tensor::MajorSymmetric);

impl Field for Manufactured {
    type Value = Symmetric;
    fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
        use piola_tensor::PairSymmetric as _;
        let primal = place.map(|x| x.primal(0));
        let elastic = self.0.contract(&exact_stress(&primal));
        strain_of(place) - Symmetric { components: elastic.components.map(T::lit) }
    }
}

#[test]
fn residual_stress_of_a_cube_converges_to_the_manufactured_one() {
    let stiffness = Stiffness::isotropic(1.5, 1.0).expect("moduli");
    let compliance = stiffness.tensor().inverse().expect("regular");
    let cube = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a cube");
    let cells = [5_usize, 7];
    let errors = cells.map(|cells| {
        let mesh = TetrahedralMesh::of_cuboid(&cube, [cells; 3]).expect("a mesh");
        let elements = QuadraticTetrahedra::new(mesh, 4).expect("elements");
        let rest = LinearResidualStress::of(&elements, &stiffness, &Manufactured(compliance), 1e-8).expect("at rest");
        assert!(rest.residual <= 1e-8 && rest.stresses.len() == elements.point_count());
        let (mut error, mut size) = (0.0, 0.0);
        for (point, stress) in &rest.stresses {
            let exact = exact_stress(&point.position);
            let difference = stress.0 - exact;
            error += point.weight * difference.double_contraction(&difference);
            size += point.weight * exact.double_contraction(&exact);
        }
        assert!(0.1 < size);
        (error / size).sqrt()
    });
    assert_order("stress", &cells.map(|cells| 1.0 / cells as f64), &errors, 2.0, 0.15);
}

#[test]
fn compatible_natural_strains_leave_no_stress_and_others_do() {
    struct Quadratic;
    impl Field for Quadratic {
        type Value = Symmetric;
        fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
            // u = (xy, z² − x², yz + x).
            let o = T::zero();
            let [x, y, z] = (*place).into();
            let gradient = [[y, x, o], [-(x + x), o, z + z], [T::one(), z, y]];
            Symmetric::symmetric_part(gradient)
        }
    }
    struct Hot;
    impl Field for Hot {
        type Value = Symmetric;
        fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
            Symmetric::diagonal([place.x * place.x; 3])
        }
    }
    let stiffness = Stiffness::isotropic(1.5, 1.0).expect("moduli");
    let cube = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0)).expect("a cube");
    let mesh = TetrahedralMesh::of_cuboid(&cube, [2, 2, 2]).expect("a mesh");
    let elements = QuadraticTetrahedra::new(mesh, 2).expect("elements");
    let none = LinearResidualStress::of(&elements, &stiffness, &Quadratic, 1e-13).expect("at rest");
    assert!(none.square_integral().sqrt() < 1e-11, "{:e}", none.square_integral().sqrt());
    let some = LinearResidualStress::of(&elements, &stiffness, &Hot, 1e-10).expect("at rest");
    assert!(1e-2 < some.square_integral().sqrt());
    // Self-equilibrated: the mean stress of a body with free faces vanishes.
    let mean = some.stresses.iter().fold(Symmetric::zero(), |sum, (point, t)| sum + t.0 * point.weight);
    assert!(mean.components.iter().all(|t| t.abs() < 1e-9), "{mean:?}");
}
