//! A step and its correctors: the exact motions of the two parts of a Hamiltonian in turn.

use super::splitting::{CORRECTOR_MOTION, Stages};

/// The two parts of a Hamiltonian whose motions are known.
pub(crate) trait Parts {
    /// Why a motion of the first part can fail.
    type Error;

    /// The motion of the first part for a time: Kepler's, and what goes with it.
    fn motion(&mut self, time: f64) -> Result<(), Self::Error>;

    /// The motion of the second part for a time: the attractions between planets, and what goes with them.
    fn attraction(&mut self, time: f64);

    /// A step, from after its first motion to its end, or to after the first motion of the next one.
    fn step(&mut self, step: f64, Stages { motions, attractions }: Stages, goes_on: bool) -> Result<(), Self::Error> {
        // The last motion of a step and the first of the next are one.
        let ends = if goes_on { motions[0] } else { 0.0 } + motions[motions.len() - 1];
        for (stage, attraction) in attractions.iter().enumerate() {
            self.attraction(attraction * step);
            let motion = if stage + 1 == attractions.len() { ends } else { motions[stage + 1] };
            self.motion(motion * step)?;
        }
        Ok(())
    }

    /// The corrector of these attractions for a step, or its inverse.
    fn correct(&mut self, attractions: &[f64], step: f64, is_inverse: bool) -> Result<(), Self::Error> {
        let last = attractions.len();
        for index in 0..last {
            // The inverse takes the same way back.
            let (index, sign) = if is_inverse { (index, -1.0) } else { (last - 1 - index, 1.0) };
            let motion = (index + 1) as f64 * CORRECTOR_MOTION * step;
            let attraction = sign * attractions[index] * step;
            self.difference(motion, attraction)?;
            self.difference(-motion, -attraction)?;
        }
        Ok(())
    }

    /// Motion, attraction backwards, motion back, attraction, motion: together the commutator of the two parts, to first order.
    fn difference(&mut self, motion: f64, attraction: f64) -> Result<(), Self::Error> {
        self.motion(motion)?;
        self.attraction(-attraction);
        self.motion(-2.0 * motion)?;
        self.attraction(attraction);
        self.motion(motion)
    }
}
