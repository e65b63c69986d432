//! Identities that every family satisfies, for random constants and random laws.

use core::cell::Cell;

use nalgebra::{Matrix3, Vector3};
use piola_fields::{Coordinates, Motion};
use piola_numerics::linear::matrix3::determinant;
use piola_solutions::families::{
    AsMotion, AzimuthalShearing, BlockBending, Datum, Family, IsochoricDeformation, Orientation, SectorStraightening,
    SphereDeformation, TubeDeformation,
};
use piola_solutions::{LocalDeformation, ResponseFunctions};
use piola_tensor::internal::rows::{product, transpose};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::fixtures::{elastic, rubber};

/// What the equations of equilibrium leave, beside the largest stress over the size of the body.
const MOMENTUM: Tol = Tol::stated(1e-11, "the bound of the specification; the terms leave some 1e-13");

fn check(family: &impl Family, law: &impl ResponseFunctions, datum: [f64; 3], at: [f64; 3]) {
    let local = family.deformation(at).expect("deformation");
    assert_close("det F", &[determinant(local.gradient)], &[1.0], Tol::ulps(32.0));
    let unit = product(local.left_cauchy_green.rows(), local.inverse.rows());
    let size = local.left_cauchy_green.norm() * local.inverse.norm();
    assert_close_at_scale("B B⁻¹", unit.as_flattened(), Matrix3::identity().as_slice(), size, Tol::ulps(32.0));

    let datum = Datum::free_at(datum);
    let stress = family.stress(law, &datum, at).expect("stress").cauchy.0;
    let residual = family.equilibrium_residual(law, &datum, at).expect("residual");
    let scale = stress.norm().max(residual.scale.amax());
    assert_close_at_scale("div T", residual.value.as_slice(), &[0.0; 3], scale, MOMENTUM);
    assert!(residual.scale.iter().all(|scale| scale.is_finite()));

    gradients_agree(family, at, &local);
}

/// F by exact derivatives of the Cartesian place, against the closed form.
fn gradients_agree<F: Family>(family: &F, at: [f64; 3], local: &LocalDeformation) {
    let (reference, current) = (F::Reference::default(), F::Current::default());
    let particle = reference.place(&Vector3::from(at));
    let place = Vector3::from(family.place(at));
    let motion = AsMotion(family_ref(family));
    let cartesian = motion.deformation_gradient(&particle, 0.0).expect("F").matrix().clone_owned();
    let rows = |frame: [[f64; 3]; 3]| frame;
    let here = current.physical_frame(&place).expect("frame").directions;
    let there = reference.physical_frame(&Vector3::from(at)).expect("frame").directions;
    let f = [0, 1, 2].map(|i| [0, 1, 2].map(|j| cartesian[(i, j)]));
    let physical = product(product(rows(here), f), transpose(there));
    let size = local.left_cauchy_green.trace().sqrt();
    assert_close_at_scale(
        "F of the place",
        physical.as_flattened(),
        local.gradient.as_flattened(),
        size,
        Tol::ulps_because(256.0, "through angles of a few radians and back"),
    );
}

const fn family_ref<F>(family: &F) -> Borrowed<'_, F> {
    Borrowed(family)
}

/// A family by reference, for a motion of it.
struct Borrowed<'a, F>(&'a F);

impl<F: Family> Family for Borrowed<'_, F> {
    type Reference = F::Reference;
    type Current = F::Current;
    fn place<T: piola_numerics::Real>(&self, reference: [T; 3]) -> [T; 3] {
        self.0.place(reference)
    }
    fn gradient<T: piola_numerics::Real>(&self, reference: [T; 3]) -> [[T; 3]; 3] {
        self.0.gradient(reference)
    }
    fn check_domain(&self, reference: [f64; 3]) -> Result<(), piola_solutions::SolutionsError> {
        self.0.check_domain(reference)
    }
    fn rise(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [f64; 3],
    ) -> Result<f64, piola_solutions::SolutionsError> {
        self.0.rise(law, from, to)
    }
    fn rise_and_slope(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [f64; 3],
    ) -> Result<(f64, [f64; 3]), piola_solutions::SolutionsError> {
        self.0.rise_and_slope(law, from, to)
    }
}

/// B E − C D is at least a half.
fn block() -> impl Strategy<Value = [f64; 4]> {
    (0.6..1.8, -0.4..0.4, -0.4..0.4, 0.9..1.8).prop_map(|(b, c, d, e)| [b, c, d, e])
}

proptest! {
    #[test]
    fn homogeneous_deformations_are_in_equilibrium(
        law in elastic(), entries in prop::array::uniform9(-0.5..0.5_f64), at in prop::array::uniform3(-2.0..2.0_f64),
    ) {
        let f = Matrix3::identity() + Matrix3::from_row_slice(&entries);
        prop_assume!(0.1 < f.determinant());
        let family = IsochoricDeformation::new(f / f.determinant().cbrt(), [1.0, 2.0, 3.0]).expect("isochoric");
        check(&family, &law, [0.0; 3], at);
    }

    #[test]
    fn bent_blocks_are_in_equilibrium(
        law in elastic(), block in block(), x in 0.3..3.0_f64, y in -0.5..0.5_f64, z in -0.5..0.5_f64,
    ) {
        check(&BlockBending::isochoric(block).expect("constants"), &law, [1.0, 0.0, 0.0], [x, y, z]);
    }

    #[test]
    fn straightened_sectors_are_in_equilibrium(
        law in elastic(), block in block(), r in 0.5..2.0_f64, theta in -1.0..1.0_f64, z in -1.0..1.0_f64,
    ) {
        check(&SectorStraightening::isochoric(block).expect("constants"), &law, [1.0, 0.0, 0.0], [r, theta, z]);
    }

    #[test]
    fn tubes_are_in_equilibrium(
        law in elastic(), block in block(), b in -0.1..2.0_f64, r in 0.8..2.0_f64, theta in -0.7..0.7_f64, z in -0.5..0.5_f64,
    ) {
        let [c, d, e, f] = block;
        check(&TubeDeformation::isochoric([b, c, d, e, f]).expect("constants"), &law, [1.0, 0.0, 0.0], [r, theta, z]);
        // Turned inside out.
        let everted = TubeDeformation::isochoric([b + 8.0, c, d, e, -f]);
        let everted = everted.expect("constants");
        check(&everted, &law, [1.0, 0.0, 0.0], [r, theta, z]);
    }

    #[test]
    fn spheres_are_in_equilibrium(
        law in elastic(), a in -0.3..5.0_f64, r in 0.8..2.0_f64, theta in -2.0..2.0_f64, phi in 0.3..2.8_f64,
    ) {
        let inflated = SphereDeformation::new(Orientation::Kept, a).expect("A");
        check(&inflated, &law, [1.0, 0.0, 1.0], [r, theta, phi]);
        let everted = SphereDeformation::new(Orientation::Everted, a + 9.0).expect("A");
        check(&everted, &law, [1.0, 0.0, 1.0], [r, theta, phi]);
    }

    #[test]
    fn sheared_sectors_are_in_equilibrium(
        law in elastic(), a in 0.6..1.6_f64, b in -1.0..1.0_f64, c in 0.6..1.6_f64, r in 0.5..2.0_f64, theta in -1.0..1.0_f64,
    ) {
        let family = AzimuthalShearing::isochoric([a, b, c]).expect("constants");
        check(&family, &law, [1.0, 0.25, 0.0], [r, theta, 0.5]);
    }

    #[test]
    fn laws_with_an_energy_have_twice_its_slopes(law in rubber(), x in 0.0..2.0_f64, y in 0.0..2.0_f64) {
        use piola_numerics::Dual;
        use piola_solids::isochoric::Isochoric;
        let [direct, inverse] = law.response(x, y);
        let by_first = law.energy(Dual::variable(x), Dual::constant(y)).tangent;
        let by_second = law.energy(Dual::constant(x), Dual::variable(y)).tangent;
        assert_close("W(25.7)", &[direct, inverse], &[2.0 * by_first, -2.0 * by_second], Tol::ulps(32.0));
    }
}

/// A law that is refused beyond a limit: the refusal comes through integrals, too.
#[test]
fn pressure_of_a_torn_body_is_refused_by_the_law() {
    use piola_solids::SolidsError;
    use piola_solids::isochoric::Gent;
    use piola_solutions::SolutionsError;
    let count = Cell::new(0);
    let law = Gent::new(1.0, 2.0).expect("law");
    let sphere = SphereDeformation::new(Orientation::Kept, 20.0).expect("A");
    for at in [0.5, 1.0] {
        let refused = sphere.stress(&law, &Datum::free_at([2.0, 0.0, 1.0]), [at, 0.0, 1.0]);
        assert!(matches!(refused, Err(SolutionsError::Solids(SolidsError::BeyondLimit { .. }))), "{refused:?}");
        count.set(count.get() + 1);
    }
    assert_eq!(count.get(), 2);
}
