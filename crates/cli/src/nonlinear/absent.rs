//! The command `nonlinear` of a program that is built without it.

use crate::Exit;
pub(crate) use crate::absent::AnyArguments as NonlinearArguments;

pub(crate) fn fit(_: &NonlinearArguments) -> Exit {
    crate::absent::refuse("viscoelastic fluids", "nonlinear", "nonlinear START.csv STEADY.csv")
}
