//! No rate allocates.

use nalgebra::Matrix3;
use piola_continuum::{CauchyStress, DeformationGradient};
use piola_continuum::{
    rates::{
        ExponentialMotion, GradientRate, HomogeneousMotion, RivlinEricksen, StretchRates, VelocityGradient, logarithm,
        steady_gradients, strain,
    },
    stress::rates::{GreenNaghdiRate, MaterialRate},
};
use piola_testkit::allocations_in;

#[test]
fn rates_allocate_nothing() {
    let gradient = Matrix3::new(1.0, 0.5, 0.0, 0.25, 2.0, 0.0, 0.0, -0.5, 1.0);
    let (count, _) = allocations_in(|| {
        let f = DeformationGradient::new(gradient)?;
        let rate = GradientRate::new(gradient)?;
        let l = VelocityGradient::of(&f, &rate);
        let rates = StretchRates::of(&f, &rate);
        let stress = CauchyStress::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)?;
        let objective = GreenNaghdiRate::of(&stress, &MaterialRate(stress), &rates.polar_spin());
        let motion = ExponentialMotion::new(gradient, Matrix3::identity())?;
        let tensors = RivlinEricksen::of_gradients(&steady_gradients::<_, 4>(&l));
        Ok::<_, piola_continuum::ContinuumError>((
            rates.right_stretch() + rates.left_stretch() + rates.hencky_material() + rates.hencky_spatial(),
            (rates.logarithmic_spin(), rates.spatial_twirl()?, rates.rotation()),
            (objective, strain::almansi_rate(&f, &l), tensors),
            (motion.rates(0.5)?, motion.relative(0.5, -0.25)?, logarithm(&(gradient * 0.125))?),
        ))
    });
    assert_eq!(count, 0);
}
