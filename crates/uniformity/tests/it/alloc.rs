//! Evaluations at a point allocate nothing.

use nalgebra::Vector3;
use piola_testkit::allocations_in;
use piola_uniformity::{
    AffineConnection, CharacteristicMetric, DislocationDensity, LieAlgebra, MaterialConnection, MetricGeometry,
};

use super::fixtures::Golden;

#[test]
fn geometry_at_a_point_allocates_nothing() {
    let place = Vector3::new(0.5, -0.25, 0.75);
    let connection = MaterialConnection::new(Golden::Smooth, LieAlgebra::rotations());
    let metric = CharacteristicMetric(Golden::Smooth);
    let (allocations, found) = allocations_in(|| {
        let torsion = connection.torsion(&place).is_ok();
        let curvature = connection.curvature(&place).is_ok();
        let density = DislocationDensity::of(&Golden::Smooth, &place).is_ok();
        torsion && curvature && density && MetricGeometry::of(&metric, &place).is_ok()
    });
    assert!(found);
    assert_eq!(allocations, 0);
}
