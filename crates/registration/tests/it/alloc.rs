//! Steps allocate nothing: buffers are made once for each level.

use piola_registration::{Registration, RegistrationError, RegistrationModel, SimilarityMeasure};
use piola_testkit::allocations_in;

use crate::fixtures::{phantom, unit_box};

#[test]
fn allocations_do_not_depend_on_the_number_of_steps() -> Result<(), RegistrationError> {
    let [fixed, moving] = phantom::<2, f64>(unit_box(32)?, 0.05)?;
    let mut compared = 0;
    for model in [RegistrationModel::elastic(0.0, 0.1)?, RegistrationModel::viscous_fluid(0.0, 1.0)?] {
        for measure in
            [SimilarityMeasure::SumOfSquares, SimilarityMeasure::CrossCorrelation, SimilarityMeasure::MutualInformation]
        {
            let method = Registration::new(model).with_measure(measure).with_levels(1).with_tolerance(0.0);
            let count = |steps: usize| -> Result<usize, RegistrationError> {
                let (count, found) = allocations_in(|| method.with_steps(steps).run(&fixed, &moving));
                assert_eq!(found?.levels[0].steps, steps);
                Ok(count)
            };
            count(1)?;
            assert_eq!(count(2)?, count(12)?, "{method:?}");
            compared += 1;
        }
    }
    assert_eq!(compared, 6);
    Ok(())
}
