//! Tractions and stress power.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::parts::part;
use super::point::Point;
use super::requests::{Quantity, Request};
use crate::rates::strain::GreenStrainRate;
use crate::rates::{GradientRate, VelocityGradient};
use crate::tensor::rows::{Rows, apply};
use crate::{
    BiotStress, CauchyStress, Deformation, FirstPiola, KirchhoffStress, MandelStress, SecondPiola, Symmetric,
    UnitNormal,
};

#[inline(always)]
fn rows<T: Copy>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> Rows<T> {
    [[a, b, c], [d, e, f], [g, h, i]]
}

/// What is computed from a stress and something else.
macro_rules! pairs {
    ($($(#[$documentation:meta])* $function:ident $name:ident $stress:ident [$i:literal] $other:ident: $of:ty
        [$total:literal => $k:literal] $what:literal |$point:ident, $input:ident| $value:expr;)*) => { $(
        $(#[$documentation])*
        #[must_use]
        pub fn $function<S, R, V>(stress: S, $other: R, to: V) -> Request<$name, (S, R), V, $total, $k> {
            Request { quantity: $name, source: (stress, $other), to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<$total, $k> for $name {
            type Input = ($stress, $of);
            type Output = Self;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = $what;

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, $point: &Point<T, D>, $input: [T; $total]) -> [T; $k] {
                $value
            }
        }
    )* };
}

pairs! {
    /// t = T n, Pa: see [`CauchyStress::traction`].
    ///
    /// With elements of area n da for n it is the force on them.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 5.0, 0.0, 0.0)?; 3];
    /// let (normal, mut traction) = ([Vector3::x(); 3], [Vector3::zeros(); 3]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::traction(&stress[..], &normal[..], &mut traction[..]);
    /// assert_eq!(request.at(&any, 2), [10.0, 5.0, 0.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    traction Traction CauchyStress [6] normal: Vector3<f64> [9 => 3] "stress and normal"
        |_point, input| Symmetric { components: part(&input, 0) }.apply(part(&input, 6));
    /// P N, Pa per area of the reference body: see [`FirstPiola::nominal_traction`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, FirstPiola};
    /// let stress = [FirstPiola::new(Matrix3::new(2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))?; 3];
    /// let (normal, mut traction) = ([Vector3::x(); 3], [Vector3::zeros(); 3]);
    /// let any = DeformationGradient::identity();
    /// let request = batch::nominal_traction(&stress[..], &normal[..], &mut traction[..]);
    /// assert_eq!(request.at(&any, 2), [2.0, 3.0, 0.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    nominal_traction NominalTraction FirstPiola [9] normal: Vector3<f64> [12 => 3] "stress and normal"
        |_point, input| apply(rows(part(&input, 0)), part(&input, 9));
    /// tr(T L), W per deformed m³: see [`CauchyStress::power_per_deformed_volume`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient, rates::VelocityGradient};
    /// let stress = [CauchyStress::new(0.0, 0.0, 0.0, 5.0, 0.0, 0.0)?; 3];
    /// let shearing = [VelocityGradient::new(Matrix3::new(0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))?; 3];
    /// let mut power = [0.0; 3];
    /// let any = DeformationGradient::identity();
    /// let request = batch::power_of_cauchy(&stress[..], &shearing[..], &mut power[..]);
    /// assert_eq!(request.at(&any, 2), [15.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    power_of_cauchy PowerOfCauchy CauchyStress [6] velocity_gradient: VelocityGradient [15 => 1]
        "stress and velocity gradient" |_point, input| {
            let stress = CauchyStress(Symmetric { components: part(&input, 0) });
            [stress.power_per_deformed_volume(&VelocityGradient(from_rows(rows(part(&input, 6)))))]
        };
    /// P : Ḟ, W per reference m³: see [`FirstPiola::power_per_reference_volume`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, FirstPiola, rates::GradientRate};
    /// let pull = Matrix3::from_diagonal(&[5.0, 0.0, 0.0].into());
    /// let (stress, rate) = ([FirstPiola::new(pull)?; 3], [GradientRate::new(pull)?; 3]);
    /// let mut power = [0.0; 3];
    /// let any = DeformationGradient::identity();
    /// let request = batch::power_of_first_piola(&stress[..], &rate[..], &mut power[..]);
    /// assert_eq!(request.at(&any, 2), [25.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    power_of_first_piola PowerOfFirstPiola FirstPiola [9] rate: GradientRate [18 => 1] "stress and rate of F"
        |_point, input| {
            let stress = FirstPiola(from_rows(rows(part(&input, 0))));
            [stress.power_per_reference_volume(&GradientRate(from_rows(rows(part(&input, 9)))))]
        };
    /// S : Ė, W per reference m³: see [`SecondPiola::power_per_reference_volume`].
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, SecondPiola, Symmetric};
    /// let stress = [SecondPiola::new(5.0, 0.0, 0.0, 1.0, 0.0, 0.0)?; 3];
    /// let rate = [Symmetric::new(3.0, 0.0, 0.0, 2.0, 0.0, 0.0); 3];
    /// let mut power = [0.0; 3];
    /// let any = DeformationGradient::identity();
    /// let request = batch::power_of_second_piola(&stress[..], &rate[..], &mut power[..]);
    /// assert_eq!(request.at(&any, 2), [19.0]); // 5·3 + 2·1·2
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    power_of_second_piola PowerOfSecondPiola SecondPiola [6] rate: GreenStrainRate [12 => 1]
        "stress and rate of Green's strain" |_point, input| {
            let stress = SecondPiola(Symmetric { components: part(&input, 0) });
            [stress.power_per_reference_volume(&GreenStrainRate(Symmetric { components: part(&input, 6) }))]
        };
    /// n · T n, Pa: see [`CauchyStress::normal_traction`]; n has length 1.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 5.0, 0.0, 0.0)?; 3];
    /// let (normal, mut out) = ([Vector3::x(); 3], [0.0; 3]);
    /// let request = batch::normal_traction(&stress[..], &normal[..], &mut out[..]);
    /// assert!((request.at(&DeformationGradient::identity(), 2)[0] - 10.0_f64).abs() < 1e-14);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    normal_traction NormalTraction CauchyStress [6] normal: Vector3<f64> [9 => 1] "stress and normal" |_point, input| {
        let stress = CauchyStress(Symmetric { components: part(&input, 0) });
        [stress.normal_traction(&UnitNormal::trusted(part(&input, 6)))]
    };
    /// T n less its part along n, Pa: see [`CauchyStress::shear_traction`]; n has length 1.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// let stress = [CauchyStress::new(10.0, 0.0, 0.0, 5.0, 0.0, 0.0)?; 3];
    /// let (normal, mut out) = ([Vector3::x(); 3], [Vector3::zeros(); 3]);
    /// let request = batch::shear_traction(&stress[..], &normal[..], &mut out[..]);
    /// assert_eq!(request.at(&DeformationGradient::identity(), 2), [0.0, 5.0, 0.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    shear_traction ShearTraction CauchyStress [6] normal: Vector3<f64> [9 => 3] "stress and normal" |_point, input| {
        let stress = CauchyStress(Symmetric { components: part(&input, 0) });
        stress.shear_traction(&UnitNormal::trusted(part(&input, 6))).into()
    };
    /// tr(τ L), W per reference m³: see [`KirchhoffStress::power_per_reference_volume`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, KirchhoffStress, rates::VelocityGradient};
    /// let stress = [KirchhoffStress::new(0.0, 0.0, 0.0, 5.0, 0.0, 0.0)?; 3];
    /// let shearing = [VelocityGradient::new(Matrix3::new(0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))?; 3];
    /// let mut power = [0.0; 3];
    /// let request = batch::power_of_kirchhoff(&stress[..], &shearing[..], &mut power[..]);
    /// assert_eq!(request.at(&DeformationGradient::identity(), 2), [15.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    power_of_kirchhoff PowerOfKirchhoff KirchhoffStress [6] velocity_gradient: VelocityGradient [15 => 1]
        "stress and velocity gradient" |_point, input| {
            let stress = KirchhoffStress(Symmetric { components: part(&input, 0) });
            [stress.power_per_reference_volume(&VelocityGradient(from_rows(rows(part(&input, 6)))))]
        };
    /// sym(Rᵀ P) : U̇, W per reference m³: see [`BiotStress::power_per_reference_volume`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_batch as batch;
    /// use piola_continuum::{BiotStress, DeformationGradient, Symmetric};
    /// let stress = [BiotStress::new(Matrix3::from_diagonal(&[5.0, 0.0, 0.0].into()))?; 3];
    /// let (rate, mut power) = ([Symmetric::diagonal([3.0, 0.0, 0.0]); 3], [0.0; 3]);
    /// let request = batch::power_of_biot(&stress[..], &rate[..], &mut power[..]);
    /// assert_eq!(request.at(&DeformationGradient::identity(), 2), [15.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    power_of_biot PowerOfBiot BiotStress [9] rate: Symmetric [15 => 1] "stress and rate of U" |_point, input| {
        let stress = BiotStress(from_rows(rows(part(&input, 0))));
        [stress.power_per_reference_volume(&Symmetric { components: part(&input, 9) })]
    };
    /// M : F⁻¹ L F, W per reference m³, of M and the velocity gradient pulled back: see
    /// [`MandelStress::power_per_reference_volume`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_batch as batch;
    /// use piola_continuum::{DeformationGradient, MandelStress};
    /// let pull = Matrix3::from_diagonal(&[5.0, 0.0, 0.0].into());
    /// let (stress, rate, mut power) = ([MandelStress::new(pull)?; 3], [pull; 3], [0.0; 3]);
    /// let request = batch::power_of_mandel(&stress[..], &rate[..], &mut power[..]);
    /// assert_eq!(request.at(&DeformationGradient::identity(), 2), [25.0]);
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    power_of_mandel PowerOfMandel MandelStress [9] rate: Matrix3<f64> [18 => 1] "stress and pulled-back gradient"
        |_point, input| {
            let stress = MandelStress(from_rows(rows(part(&input, 0))));
            [stress.power_per_reference_volume(&from_rows(rows(part(&input, 9))))]
        };
}
