//! Energies whose parameters differ from point to point.

use core::error::Error;

use piola_batch::{BatchError, Components, LaneBlocks, Source};
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_laws::per_point::{Bound, EnergyOfParameters, first_piola, first_piola_and_tangent};
use piola_laws::{EnergyOfInvariants, Excesses, OfInvariants};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError, batch};
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale};

type Fallible = Result<(), Box<dyn Error>>;

/// W = C₁₀ (I₁ − 3 − 2 ln J) + C₀₁ (I₂ − 3 − 4 ln J) + c (J² − 1 − 2 ln J), and ½ k (I₄ − 1)² of fibres.
fn energy<T: Real>([c10, c01, c, k]: [T; 4], at: &impl Excesses<T>) -> T {
    let (change, fibre) = (at.volume_change(), at.fourth(0));
    c10 * at.first_excess()
        + c01 * at.second_excess()
        + c * (change * change + T::lit(2.0) * at.volume_excess())
        + T::lit(0.5) * k * fibre * fibre
}

/// With parameters of the point.
#[derive(Clone, Copy)]
struct Graded;

impl EnergyOfParameters<4> for Graded {
    const PARAMETERS: [(&'static str, Bound); 4] =
        [("c10", Bound::Positive), ("c01", Bound::NotNegative), ("c", Bound::Positive), ("k", Bound::Finite)];
    const FIBRES: usize = 1;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, parameters: &[T; 4], at: &impl Excesses<T>) -> T {
        energy(*parameters, at)
    }
    fn fibre(&self, _family: usize) -> [f64; 3] {
        [0.6, 0.8, 0.0]
    }
}

/// With the same parameters everywhere.
#[derive(Clone, Copy)]
struct Uniform([f64; 4]);

impl EnergyOfInvariants for Uniform {
    const FIBRES: usize = 1;
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        energy(self.0.map(T::lit), at)
    }
    fn fibre(&self, family: usize) -> [f64; 3] {
        Graded.fibre(family)
    }
}

const COUNT: usize = 19;

/// Deformations, and parameters as structures of arrays.
type Points = (Vec<DeformationGradient>, [Vec<f64>; 4]);

fn points() -> Result<Points, Box<dyn Error>> {
    let mut random = Random::new(5);
    let mut f = Vec::new();
    let mut parameters = [const { Vec::new() }; 4];
    for _ in 0..COUNT {
        let stretches = [0, 1, 2].map(|_| (0.4 * random.symmetric()).exp());
        f.push(DeformationGradient::from_rows(with_stretches(&random.rotation(), stretches, &random.rotation()))?);
        for column in &mut parameters {
            column.push(1.5 + random.symmetric());
        }
    }
    Ok((f, parameters))
}

/// P and ∂P/∂F at all points.
fn answers<S: Source<piola_laws::per_point::OfEnergyOfParameters<Graded, 4>, f64, 4>>(
    f: &[DeformationGradient],
    parameters: S,
) -> Result<(Vec<FirstPiola>, Vec<[f64; 45]>), SolidsError> {
    let (mut stresses, mut tangents) = (vec![FirstPiola::zero(); COUNT], vec![[0.0; 45]; COUNT]);
    let request = first_piola_and_tangent(Graded, parameters, &mut stresses[..], &mut tangents[..]);
    batch::evaluate(f, request)?;
    Ok((stresses, tangents))
}

#[test]
fn answers_of_points_with_parameters_equal_those_of_laws_with_them() -> Fallible {
    let (f, parameters) = points()?;
    let columns = Components::new(parameters.each_ref().map(Vec::as_slice))?;
    let (stresses, tangents) = answers(&f, columns)?;
    let mut alone = vec![FirstPiola::zero(); COUNT];
    batch::evaluate(&f[..], first_piola(Graded, columns, &mut alone[..]))?;
    let tol = Tol::ulps_because(256.0, "two orders of summation of some hundred terms");
    for index in 0..COUNT {
        let law = OfInvariants(Uniform(parameters.each_ref().map(|column| column[index])));
        let (stress, tangent) = law.first_piola_and_tangent(&f[index]);
        let scale = tangent.0.components.concat().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        assert_close_at_scale("P", stresses[index].0.as_slice(), stress.0.as_slice(), scale, tol);
        assert_close_at_scale("P alone", alone[index].0.as_slice(), stress.0.as_slice(), scale, tol);
        let mut upper = Vec::new();
        for (row, entries) in tangent.0.components.iter().enumerate() {
            upper.extend_from_slice(&entries[row..]);
        }
        assert_close("∂P/∂F", &tangents[index], &upper, tol);
    }
    // The same bits from an array for each point, and from blocks of lanes.
    let records: Vec<[f64; 4]> = (0..COUNT).map(|index| parameters.each_ref().map(|column| column[index])).collect();
    assert_eq!(answers(&f, &records[..])?, (stresses.clone(), tangents.clone()));
    let mut blocks = vec![[[1.0; 4]; 4]; COUNT.div_ceil(4)];
    for (index, record) in records.iter().enumerate() {
        for (k, value) in record.iter().enumerate() {
            blocks[index / 4][k][index % 4] = *value;
        }
    }
    assert_eq!(answers(&f, LaneBlocks::new(&blocks, COUNT)?)?, (stresses, tangents));
    Ok(())
}

#[test]
fn parameters_out_of_bounds_are_named_and_all_other_points_are_computed() -> Fallible {
    let (f, mut parameters) = points()?;
    parameters[1][3] = -1.0;
    parameters[2][7] = f64::NAN;
    let columns = Components::new(parameters.each_ref().map(Vec::as_slice))?;
    let mut stresses = vec![FirstPiola::zero(); COUNT];
    let result = batch::evaluate(&f[..], first_piola(Graded, columns, &mut stresses[..]));
    let Err(SolidsError::BadPoints { points, count: COUNT, .. }) = result else {
        return Err("two points are bad".into());
    };
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), [3, 7]);
    assert!(matches!(points[0].error, SolidsError::OutOfBounds { parameter: "c01", value: -1.0, .. }), "{points:?}");
    let not_finite = BatchError::NotFinite { quantity: "parameters of the points", index: 2, value: f64::NAN };
    assert_eq!(points[1].error.to_string(), not_finite.to_string());
    for (index, stress) in stresses.iter().enumerate() {
        assert_eq!(stress.0[(0, 0)].is_nan(), index == 3 || index == 7);
    }
    // Arrays of the wrong length are refused before anything is computed.
    parameters[3].pop();
    assert!(Components::new(parameters.each_ref().map(Vec::as_slice)).is_err());
    for column in &mut parameters {
        column.truncate(COUNT - 1);
    }
    let short = Components::new(parameters.each_ref().map(Vec::as_slice))?;
    let result = batch::evaluate(&f[..], first_piola(Graded, short, &mut stresses[..]));
    let Err(SolidsError::Batch(BatchError::WrongLength { quantity, .. })) = result else {
        return Err("a short array".into());
    };
    assert_eq!(quantity, "parameters of the points");
    Ok(())
}

#[test]
fn allocations_of_points_with_parameters_equal_zero() -> Fallible {
    let (f, parameters) = points()?;
    let columns = Components::new(parameters.each_ref().map(Vec::as_slice))?;
    let mut stresses = vec![FirstPiola::zero(); COUNT];
    let (count, result) = allocations_in(|| batch::evaluate(&f[..], first_piola(Graded, columns, &mut stresses[..])));
    result?;
    assert_eq!(count, 0);
    Ok(())
}
