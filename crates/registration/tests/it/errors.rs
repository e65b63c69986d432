//! Bad input is refused by name and with its number.

use piola_registration::{
    DisplacementMap, Image, ImageGrid, Registration, RegistrationError, RegistrationModel, SimilarityMeasure,
};

use crate::fixtures::{texture, unit_box};

#[test]
fn impossible_grids_are_refused() {
    let few = |found| Err(RegistrationError::TooFewSamples { axis: 1, found, least: 2 });
    assert_eq!(ImageGrid::new([4, 0], [1.0, 1.0]), few(0));
    assert_eq!(ImageGrid::new([4, 1], [1.0, 1.0]), few(1));
    assert_eq!(ImageGrid::new([4], [1.0]), Err(RegistrationError::Dimension { found: 1 }));
    assert_eq!(ImageGrid::new([4; 4], [1.0; 4]), Err(RegistrationError::Dimension { found: 4 }));
    for value in [0.0, -1.0] {
        let expected = RegistrationError::OutOfBounds { quantity: "spacing", value, bound: "0 < spacing" };
        assert_eq!(ImageGrid::new([4, 4], [1.0, value]), Err(expected));
    }
    let infinite = ImageGrid::new([4, 4], [1.0, f64::INFINITY]);
    assert!(matches!(infinite, Err(RegistrationError::NotFinite { quantity: "spacing", .. })));
    let huge = ImageGrid::new([usize::MAX, 4], [1.0, 1.0]);
    assert!(matches!(huge, Err(RegistrationError::TooManySamples { .. })));
}

#[test]
fn impossible_values_are_refused_where_they_stand() -> Result<(), RegistrationError> {
    let grid = unit_box::<2>(4)?;
    let length = RegistrationError::WrongLength { quantity: "values", found: 15, expected: 16 };
    assert_eq!(Image::new(grid, vec![0.0; 15]), Err(length));
    let mut values = vec![0.0; 16];
    values[7] = f64::NAN;
    assert!(matches!(Image::new(grid, values), Err(RegistrationError::NotFinite { quantity: "values", index: 7, .. })));
    let mut displacements = vec![[0.0; 2]; 16];
    displacements[3][1] = f64::INFINITY;
    let refused = DisplacementMap::new(grid, displacements);
    assert!(matches!(refused, Err(RegistrationError::NotFinite { quantity: "displacements", index: 7, .. })));
    assert!(matches!(
        DisplacementMap::new(grid, vec![[0.0; 2]; 3]),
        Err(RegistrationError::WrongLength { quantity: "displacements", found: 3, expected: 16 })
    ));
    Ok(())
}

#[test]
fn images_that_do_not_fit_are_refused() -> Result<(), RegistrationError> {
    let image = |grid| Image::from_fn(grid, texture);
    let fixed = image(unit_box::<2>(16)?)?;
    let method = Registration::new(RegistrationModel::elastic(0.0, 1.0)?);
    let sizes = method.run(&fixed, &image(ImageGrid::new([16, 15], [1.0 / 16.0; 2])?)?);
    assert_eq!(sizes, Err(RegistrationError::UnequalSizes { axis: 1, fixed: 16, moving: 15 }));
    let spacings = method.run(&fixed, &image(ImageGrid::new([16, 16], [0.0625, 0.0626])?)?);
    assert_eq!(spacings, Err(RegistrationError::UnequalSpacings { axis: 1, fixed: 0.0625, moving: 0.0626 }));
    let constant = Image::from_fn(*fixed.grid(), |_| 3.0)?;
    let moving = RegistrationError::ConstantImage { image: "moving", value: 3.0 };
    assert_eq!(method.run(&fixed, &constant), Err(moving.clone()));
    assert_eq!(SimilarityMeasure::MutualInformation.of(&fixed, &constant), Err(moving.clone()));
    let refused = RegistrationError::ConstantImage { image: "fixed", value: 3.0 };
    assert_eq!(method.run(&constant, &fixed), Err(refused));
    assert_eq!(
        moving.to_string(),
        "the moving image has the constant value 3e0; at least two different values are needed"
    );
    Ok(())
}

#[test]
fn impossible_methods_are_refused() -> Result<(), RegistrationError> {
    for [first, shear] in [[0.0, 0.0], [0.0, -1.0], [-2.5, 1.0]] {
        assert!(matches!(RegistrationModel::elastic(first, shear), Err(RegistrationError::OutOfBounds { .. })));
        assert!(matches!(RegistrationModel::viscous_fluid(first, shear), Err(RegistrationError::OutOfBounds { .. })));
    }
    // λ + 2μ is the modulus of a stretch between walls: it may be small.
    assert!(RegistrationModel::elastic(-1.5, 1.0).is_ok() && RegistrationModel::viscous_fluid(-1.99, 1.0).is_ok());
    assert!(matches!(
        RegistrationModel::elastic(f64::NAN, 1.0),
        Err(RegistrationError::NotFinite { quantity: "λ", .. })
    ));
    let image = Image::from_fn(unit_box::<2>(16)?, texture)?;
    let good = Registration::new(RegistrationModel::elastic(0.0, 1.0)?);
    let unchecked = RegistrationModel::Elastic { first_lame_parameter: 0.0, shear_modulus: -1.0 };
    let bad = [
        (good.with_levels(0), "levels"),
        (good.with_levels(4), "levels"),
        (good.with_tolerance(-1.0), "tolerance"),
        (good.with_largest_step(0.0), "largest step"),
        (good.with_jacobian_bounds(1.0, 0.1), "regrid below"),
        (good.with_jacobian_bounds(0.5, 0.0), "least Jacobian"),
        (Registration::new(unchecked), "μ"),
    ];
    for (method, expected) in bad {
        match method.run(&image, &image) {
            Err(RegistrationError::OutOfBounds { quantity, .. }) => assert_eq!(quantity, expected),
            other => assert!(other.is_err(), "{expected} is not refused"),
        }
    }
    Ok(())
}
