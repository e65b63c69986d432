//! Membrane and thin plate against values by hand: exact in doubles.

use nalgebra::{Matrix3, Vector3};
use piola_solids::{Membrane, ThinPlate};
use piola_testkit::{Tol, assert_close};

const EXACT: Tol = Tol::ulps(0.0);

/// u₁ = X₁² + X₁ X₂, u₂ = 2 X₂² − X₃, u₃ = ½ X₁² X₃ at X = (1, 2, 4):
/// ∇u = (2 X₁ + X₂, X₁, 0; 0, 4 X₂, −1; X₁ X₃, 0, ½ X₁²), Δu = (2, 4, X₃).
#[test]
fn membrane_equals_values_by_hand() {
    let membrane = Membrane::new(3.0).expect("bounds");
    let gradient = Matrix3::new(4.0, 1.0, 0.0, 0.0, 8.0, -1.0, 4.0, 0.0, 0.5);
    // ½ · 3 · (16 + 1 + 64 + 1 + 16 + ¼).
    assert_close("½ τ |∇u|²", &[membrane.energy_density(&gradient)], &[147.375], EXACT);
    let stress = Matrix3::new(12.0, 3.0, 0.0, 0.0, 24.0, -3.0, 12.0, 0.0, 1.5);
    assert_close("τ ∇u", membrane.stress(&gradient).as_slice(), stress.as_slice(), EXACT);
    let entries = membrane.tangent::<f64>().0.components;
    for (row, entries) in entries.iter().enumerate() {
        let expected: [f64; 9] = core::array::from_fn(|column| if row == column { 3.0 } else { 0.0 });
        assert_close("τ δᵢₖ δⱼₗ", entries, &expected, EXACT);
    }
    // f = −τ Δu is in equilibrium, and ten times as much is not.
    let laplacian = Vector3::new(2.0, 4.0, 4.0);
    let force = Vector3::new(-6.0, -12.0, -12.0);
    assert_close("f + τ Δu", membrane.residual(&force, &laplacian).as_slice(), &[0.0; 3], EXACT);
    let more = membrane.residual(&(force * 10.0), &laplacian);
    assert_close("9 f", more.as_slice(), (force * 9.0).as_slice(), EXACT);
    // τ Δ sin(k · X) = −τ |k|² sin(k · X), |k|² = 1 + 4 + 4.
    assert_close("−τ |k|²", &[membrane.symbol(&Vector3::new(1.0, -2.0, 2.0))], &[-27.0], EXACT);
}

/// u₁ = X₁⁴ + X₁² X₂², u₂ = X₂³, u₃ = X₁ X₃ at X = (1, 2, 4): Δ²u = (24 + 8, 0, 0).
#[test]
fn thin_plate_equals_values_by_hand() {
    let plate = ThinPlate::new(3.0).expect("bounds");
    // ∂₁₁u₁ = 12 X₁² + 2 X₂², ∂₁₂u₁ = 4 X₁ X₂, ∂₂₂u₁ = 2 X₁²; ∂₂₂u₂ = 6 X₂; ∂₁₃u₃ = 1.
    let o = 0.0;
    let second = [
        [[20.0, 8.0, o], [8.0, 2.0, o], [o, o, o]],
        [[o, o, o], [o, 12.0, o], [o, o, o]],
        [[o, o, 1.0], [o, o, o], [1.0, o, o]],
    ];
    // ½ · 3 · (400 + 64 + 64 + 4 + 144 + 1 + 1): the mixed derivatives count twice.
    assert_close("½ D |∇∇u|²", &[plate.energy_density(&second)], &[1017.0], EXACT);
    let moment = plate.moment(&second);
    let expected = second.map(|rows| rows.map(|row| row.map(|x| 3.0 * x)));
    let flat = |a: &[[[f64; 3]; 3]; 3]| a.as_flattened().as_flattened().to_vec();
    assert_close("D ∇∇u", &flat(&moment), &flat(&expected), EXACT);
    assert_close("D", &[plate.tangent::<f64>()], &[3.0], EXACT);
    // f = +D Δ²u is in equilibrium; the sign of the text would leave 2 f.
    let (force, bilaplacian) = (Vector3::new(96.0, 0.0, 0.0), Vector3::new(32.0, 0.0, 0.0));
    assert_close("f − D Δ²u", plate.residual(&force, &bilaplacian).as_slice(), &[0.0; 3], EXACT);
    assert_close("2 f", plate.residual(&(-force), &bilaplacian).as_slice(), &[-192.0, 0.0, 0.0], EXACT);
    // −D Δ² sin(k · X) = −D |k|⁴ sin(k · X).
    assert_close("−D |k|⁴", &[plate.symbol(&Vector3::new(1.0, -2.0, 2.0))], &[-243.0], EXACT);
}
