//! Sources of several quantities, side by side: a stress and a tangent, a stress and the velocity gradient.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::{Element, Lanes};

use super::{Destination, Source};
use crate::rates::strain::GreenStrainRate;
use crate::rates::{AccelerationGradient, GradientRate, RateOfDeformation, VelocityGradient};
use crate::stress::tangents::{
    CauchyGreenNaghdiTangent, CauchyJaumannTangent, CauchyLogarithmicTangent, CauchyLowerConvectedTangent,
    CauchyUpperConvectedTangent, FirstPiolaTangent, GreenNaghdiTangent, JaumannTangent, LieTangent, LogarithmicTangent,
    LowerConvectedTangent, MaterialTangent, TruesdellTangent,
};
use crate::tensor::MajorSymmetric;
use crate::{
    BiotStress, CauchyStress, BatchError, FirstPiola, KirchhoffStress, MandelStress, SecondPiola, Symmetric,
};

/// A tuple of sources is a source of the components of all of them, one after the other.
macro_rules! tuples {
    ($($($name:ident $quantity:ty, $place:tt [$k:literal]);+ => $total:literal;)*) => { $(
        impl<T, $($name),+> Source<($($quantity,)+), T, $total> for ($($name,)+)
        where
            T: Element,
            $($name: Source<$quantity, T, $k>,)+
        {
            fn count(&self) -> Option<usize> {
                let counts = [$(self.$place.count()),+];
                // Parts of different lengths are as long as no batch.
                if counts.iter().all(|count| *count == counts[0]) { counts[0] } else { Some(usize::MAX) }
            }
            #[inline(always)]
            fn point(&self, index: usize) -> [T; $total] {
                let (mut all, mut at) = ([T::zero(); $total], 0);
                $(at = put(&mut all, at, self.$place.point(index));)+
                debug_assert_eq!(at, $total);
                all
            }
            #[inline(always)]
            fn load<const N: usize>(&self, first: usize, count: usize) -> [Lanes<T, N>; $total] {
                let (mut all, mut at) = ([Lanes([T::zero(); N]); $total], 0);
                $(at = put(&mut all, at, self.$place.load::<N>(first, count));)+
                debug_assert_eq!(at, $total);
                all
            }
            fn check(&self, quantity: &'static str, index: usize) -> Result<(), BatchError> {
                $(self.$place.check(quantity, index)?;)+
                Ok(())
            }
        }
    )* };
}

/// Writes a part and says where the next begins.
#[inline(always)]
fn put<X: Copy, const K: usize, const TOTAL: usize>(all: &mut [X; TOTAL], at: usize, part: [X; K]) -> usize {
    let mut k = 0;
    while k < K {
        all[at + k] = part[k];
        k += 1;
    }
    at + K
}

/// Components of a part of the input.
#[inline(always)]
pub(super) fn part<X: Copy, const K: usize, const TOTAL: usize>(all: &[X; TOTAL], at: usize) -> [X; K] {
    let mut part = [all[at]; K];
    let mut k = 0;
    while k < K {
        part[k] = all[at + k];
        k += 1;
    }
    part
}

tuples! {
    A Symmetric, 0 [6]; B Symmetric, 1 [6] => 12;
    A Symmetric, 0 [6]; B Symmetric, 1 [6]; C Symmetric, 2 [6] => 18;
    A Matrix3<f64>, 0 [9]; B Matrix3<f64>, 1 [9] => 18;
    A Symmetric, 0 [6]; B Matrix3<f64>, 1 [9] => 15;
    A MajorSymmetric, 0 [21]; B Matrix3<f64>, 1 [9] => 30;
    A SecondPiola, 0 [6]; B GreenStrainRate, 1 [6] => 12;
    A CauchyStress, 0 [6]; B Vector3<f64>, 1 [3] => 9;
    A FirstPiola, 0 [9]; B Vector3<f64>, 1 [3] => 12;
    A CauchyStress, 0 [6]; B VelocityGradient, 1 [9] => 15;
    A FirstPiola, 0 [9]; B GradientRate, 1 [9] => 18;
    A CauchyStress, 0 [6]; B CauchyStress, 1 [6]; C VelocityGradient, 2 [9] => 21;
    A KirchhoffStress, 0 [6]; B KirchhoffStress, 1 [6]; C VelocityGradient, 2 [9] => 21;
    A SecondPiola, 0 [6]; B SecondPiola, 1 [6]; C GradientRate, 2 [9] => 21;
    A KirchhoffStress, 0 [6]; B VelocityGradient, 1 [9] => 15;
    A BiotStress, 0 [9]; B Symmetric, 1 [6] => 15;
    A MandelStress, 0 [9]; B Matrix3<f64>, 1 [9] => 18;
    A Vector3<f64>, 0 [3]; B Vector3<f64>, 1 [3] => 6;
    A AccelerationGradient, 0 [9]; B VelocityGradient, 1 [9] => 18;
    A MaterialTangent, 0 [21]; B GreenStrainRate, 1 [6] => 27;
    A LieTangent, 0 [21]; B RateOfDeformation, 1 [6] => 27;
    A TruesdellTangent, 0 [21]; B RateOfDeformation, 1 [6] => 27;
    A JaumannTangent, 0 [21]; B RateOfDeformation, 1 [6] => 27;
    A LowerConvectedTangent, 0 [21]; B RateOfDeformation, 1 [6] => 27;
    A FirstPiolaTangent, 0 [81]; B GradientRate, 1 [9] => 90;
    A SecondPiola, 0 [6]; B MaterialTangent, 1 [21] => 27;
    A CauchyStress, 0 [6]; B TruesdellTangent, 1 [21] => 27;
    A CauchyStress, 0 [6]; B JaumannTangent, 1 [21] => 27;
    A CauchyStress, 0 [6]; B LowerConvectedTangent, 1 [21] => 27;
    A CauchyStress, 0 [6]; B GreenNaghdiTangent, 1 [36] => 42;
    A CauchyStress, 0 [6]; B LogarithmicTangent, 1 [36] => 42;
    A CauchyStress, 0 [6]; B CauchyJaumannTangent, 1 [36] => 42;
    A CauchyStress, 0 [6]; B CauchyUpperConvectedTangent, 1 [36] => 42;
    A CauchyStress, 0 [6]; B CauchyLowerConvectedTangent, 1 [36] => 42;
    A CauchyStress, 0 [6]; B CauchyGreenNaghdiTangent, 1 [36] => 42;
    A CauchyStress, 0 [6]; B CauchyLogarithmicTangent, 1 [36] => 42;
    A SecondPiola, 0 [6]; B FirstPiolaTangent, 1 [81] => 87;
}

impl<Q, T: Element> Source<Q, T, 3> for &[Vector3<T>] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[inline(always)]
    fn point(&self, index: usize) -> [T; 3] {
        let [[x, y, z]] = self[index].data.0;
        [x, y, z]
    }
}

impl<Q, T: Element> Destination<Q, T, 3> for &mut [Vector3<T>] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[inline(always)]
    fn put(&mut self, index: usize, [x, y, z]: [T; 3]) {
        self[index] = Vector3::new(x, y, z);
    }
}
