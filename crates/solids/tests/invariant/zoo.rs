//! One of each law.

use piola_solids::SolidsError;
use piola_solids::isochoric::{self, ArrudaBoyce, ArrudaBoyceSeries, Gent, Rivlin, RivlinTerm, Yeoh};
use piola_solids::volumetric::{
    HartmannNeff, Liu, Logarithmic, Miehe, OgdenVolumetric, Quadratic, QuadraticLogarithmic, SimoTaylor,
};
use piola_solids::{
    BlatzKo, Compressible, ElasticConstants, Hyperelastic, IncompressibleSolid, LinearElastic, MooneyRivlin,
    NeoHookeanCiarlet, NeoHookeanLogarithmic, Polynomial, PolynomialTerm, SaintVenantKirchhoff,
};

use super::once::Once;

/// What is done with each law.
pub(super) trait Visitor {
    /// A law with the name of it.
    fn visit<L: Hyperelastic>(&mut self, name: &str, law: &L);
}

pub(super) fn rivlin() -> Result<Rivlin, SolidsError> {
    let term = |first, second, coefficient| RivlinTerm { first, second, coefficient };
    Rivlin::new(vec![term(1, 0, 0.4), term(0, 1, 0.1), term(1, 1, 0.05), term(0, 2, 0.02), term(3, 0, 0.01)])
}

pub(super) fn polynomial() -> Result<Polynomial, SolidsError> {
    let term = |first, second, third, coefficient| PolynomialTerm { first, second, third, coefficient };
    Polynomial::stress_free(vec![
        term(1, 0, 0, 0.5),
        term(0, 1, 0, 0.25),
        term(0, 0, 1, -1.0),
        term(1, 1, 0, 0.125),
        term(0, 0, 2, 0.75),
        term(2, 0, 1, 0.0625),
    ])
}

/// Laws whose reference is free of stress.
pub(super) fn stress_free(visitor: &mut impl Visitor) -> Result<(), SolidsError> {
    visitor.visit(
        "neo-Hookean, quadratic",
        &Once(&Compressible::new(isochoric::NeoHookean::new(0.8)?, Quadratic::new(20.0)?)),
    );
    let mooney = isochoric::MooneyRivlin::new(0.5, 0.25)?;
    visitor.visit("Mooney–Rivlin, logarithmic", &Once(&Compressible::new(mooney, Logarithmic::new(5.0)?)));
    visitor.visit("Yeoh, Simo–Taylor", &Once(&Compressible::new(Yeoh::new(0.5, -0.05, 0.01)?, SimoTaylor::new(5.0)?)));
    visitor.visit("Gent, Liu", &Once(&Compressible::new(Gent::new(0.8, 30.0)?, Liu::new(5.0)?)));
    visitor.visit("Arruda–Boyce, Miehe", &Once(&Compressible::new(ArrudaBoyce::new(0.8, 9.0)?, Miehe::new(5.0)?)));
    let series = ArrudaBoyceSeries::new(0.8, 9.0)?;
    visitor.visit("Arruda–Boyce series, Ogden", &Once(&Compressible::new(series, OgdenVolumetric::new(5.0, 9.0)?)));
    visitor.visit("Rivlin, Hartmann–Neff", &Once(&Compressible::new(rivlin()?, HartmannNeff::new(5.0)?)));
    let plain = isochoric::NeoHookean::new(0.8)?;
    visitor.visit("neo-Hookean, mixed", &Once(&Compressible::new(plain, QuadraticLogarithmic::new(5.0)?)));
    visitor.visit("neo-Hookean of ln J", &Once(&NeoHookeanLogarithmic::with_constants(0.8, 3.0)?));
    visitor.visit("neo-Hookean of Ciarlet", &Once(&NeoHookeanCiarlet::with_constants(0.8, 3.0)?));
    visitor.visit("St. Venant–Kirchhoff", &Once(&SaintVenantKirchhoff::new(1.5, 0.75)?));
    visitor.visit("linear elastic", &Once(&LinearElastic::new(ElasticConstants::from_lame(1.5, 0.75)?)?));
    visitor.visit("polynomial", &Once(&polynomial()?));
    visitor.visit("Blatz–Ko foam", &Once(&BlatzKo::foam(0.8)?));
    visitor.visit("Blatz–Ko", &Once(&BlatzKo::new(0.8, 0.4, 0.7)?));
    visitor.visit("Mooney–Rivlin", &Once(&MooneyRivlin::stress_free(0.5, 0.25, 1.25)?));
    visitor.visit("incompressible Mooney–Rivlin", &Once(&IncompressibleSolid::new(mooney)));
    visitor.visit("incompressible Gent", &Once(&IncompressibleSolid::new(Gent::new(0.8, 30.0)?)));
    Ok(())
}

/// Laws whose reference carries stress.
pub(super) fn stressed(visitor: &mut impl Visitor) -> Result<(), SolidsError> {
    let mooney = isochoric::MooneyRivlin::new(0.5, 0.25)?;
    visitor.visit("incompressible at p", &Once(&IncompressibleSolid::new(mooney).at_pressure(1.75)?));
    visitor.visit("incompressible at q", &Once(&IncompressibleSolid::new(rivlin()?).at_excess_pressure(0.5)?));
    visitor.visit("Mooney–Rivlin with stress", &Once(&MooneyRivlin::new(0.5, 0.25, 1.25, 3.0)?));
    Ok(())
}
