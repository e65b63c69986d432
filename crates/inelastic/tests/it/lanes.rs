//! Points in lanes end where they end alone.

use core::error::Error;

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_inelastic::{Evolution, InelasticError, StepControl, advance_components, advance_in_lanes};
use piola_tensor::FourthOrder;
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, allocations_in, assert_close_at_scale};

use super::paths::{bergstrom_boyce, driven_growth, kinematic, mullins, reese_govindjee, viscoplastic};
use super::stress_alone::Counted;

type Fallible = Result<(), Box<dyn Error>>;

const COUNT: usize = 11;

/// States, stresses and tangents of some points.
#[derive(Clone)]
struct Body {
    states: Vec<Vec<f64>>,
    stresses: Vec<FirstPiola>,
    tangents: Vec<FirstPiolaTangent>,
}

impl Body {
    fn new<L: Evolution<S, X>, const S: usize, const X: usize>(law: &L) -> Self {
        Self {
            states: law.initial().iter().map(|value| vec![*value; COUNT]).collect(),
            stresses: vec![FirstPiola::zero(); COUNT],
            tangents: vec![FirstPiolaTangent(FourthOrder::zero()); COUNT],
        }
    }

    /// Advances in lanes or one by one.
    fn advance<L: Evolution<S, X>, const S: usize, const X: usize>(
        &mut self,
        law: &L,
        path: [&[DeformationGradient]; 2],
        dt: f64,
        in_lanes: bool,
    ) -> Result<(), InelasticError> {
        let mut columns = self.states.iter_mut().map(Vec::as_mut_slice);
        let mut columns: [&mut [f64]; S] = core::array::from_fn(|_| columns.next().unwrap_or_default());
        let (stresses, tangents) = (&mut self.stresses[..], &mut self.tangents[..]);
        if in_lanes {
            advance_in_lanes(law, &mut columns, path, dt, stresses, tangents)
        } else {
            let control = StepControl::one_step();
            advance_components(|_| Ok(Counted::of(law)), &mut columns, path, (dt, &control), stresses, tangents)
        }
    }
}

fn deformations(seed: u64, size: f64) -> Result<Vec<DeformationGradient>, Box<dyn Error>> {
    let mut random = Random::new(seed);
    let one = |random: &mut Random| {
        let stretches = [0, 1, 2].map(|_| (size * random.symmetric()).exp());
        let rotation = random.rotation();
        with_stretches(&rotation, stretches, &rotation)
    };
    (0..COUNT).map(|_| Ok(DeformationGradient::from_rows(one(&mut random))?)).collect()
}

fn check<L: Evolution<S, X>, const S: usize, const X: usize>(what: &str, law: &L) -> Fallible {
    let tol = Tol::ulps_because(4096.0, "two solutions of the same equations, of condition to a hundred");
    let (mut alone, mut together) = (Body::new(law), Body::new(law));
    let mut before = vec![DeformationGradient::identity(); COUNT];
    // Small steps first, in which some points of a plastic body are elastic and some flow.
    for (number, size) in [0.06, 0.2, 0.3, 0.1].into_iter().enumerate() {
        let after = deformations(number as u64, size)?;
        alone.advance(law, [&before, &after], 0.2, false)?;
        together.advance(law, [&before, &after], 0.2, true)?;
        let scale = |x: &[f64]| x.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        for index in 0..COUNT {
            let of = |body: &Body| body.states.iter().map(|column| column[index]).collect::<Vec<_>>();
            assert_close_at_scale(&format!("{what}: z"), &of(&together), &of(&alone), 1.0, tol);
            let (found, expected) = (&together.tangents[index].0.components, &alone.tangents[index].0.components);
            let modulus = scale(expected.as_flattened());
            assert_close_at_scale(
                &format!("{what}: dP/dF"),
                found.as_flattened(),
                expected.as_flattened(),
                modulus,
                tol,
            );
            let (found, expected) = (&together.stresses[index].0, &alone.stresses[index].0);
            assert_close_at_scale(&format!("{what}: P"), found.as_slice(), expected.as_slice(), modulus, tol);
        }
        before = after;
    }
    Ok(())
}

#[test]
fn points_in_lanes_equal_points_alone() -> Fallible {
    check("Reese–Govindjee", &reese_govindjee()?)?;
    check("Bergström–Boyce", &bergstrom_boyce()?)?;
    check("Mullins", &mullins()?)?;
    check("driven growth", &driven_growth()?)?;
    check("viscoplastic", &viscoplastic(0.5)?)?;
    check("plastic", &viscoplastic(0.0)?)?;
    check("kinematic", &kinematic(0.0)?)
}

#[test]
fn points_in_lanes_are_refused_by_name_and_the_others_advanced() -> Fallible {
    let law = reese_govindjee()?;
    let (before, after) = (vec![DeformationGradient::identity(); COUNT], deformations(3, 0.2)?);
    let mut body = Body::new(&law);
    let short = body.advance(&law, [&before[1..], &after], 0.1, true);
    assert!(matches!(short, Err(InelasticError::WrongLength { quantity: "states", .. })), "{short:?}");
    let backwards = body.advance(&law, [&before, &after], -0.1, true);
    assert!(matches!(backwards, Err(InelasticError::OutOfBounds { parameter: "dt", .. })), "{backwards:?}");
    let mut good = body.clone();
    good.advance(&law, [&before, &after], 0.1, true)?;
    body.states[4][5] = f64::NAN;
    let error = body.advance(&law, [&before, &after], 0.1, true);
    let Err(InelasticError::AtPoint { index: 5, error }) = error else {
        return Err("a state that is not finite".into());
    };
    assert!(matches!(*error, InelasticError::NotFinite { quantity: "state", index: 4, .. }), "{error}");
    for index in (0..COUNT).filter(|index| *index != 5) {
        assert_eq!(body.stresses[index], good.stresses[index]);
    }
    assert!(body.stresses[5].0[(0, 0)].is_nan());
    Ok(())
}

#[test]
fn allocations_in_lanes_equal_zero() -> Fallible {
    let law = reese_govindjee()?;
    let (before, after) = (vec![DeformationGradient::identity(); COUNT], deformations(3, 0.2)?);
    let mut body = Body::new(&law);
    let (count, result) = allocations_in(|| body.advance(&law, [&before, &after], 0.1, true));
    result?;
    assert_eq!(count, 0);
    Ok(())
}
