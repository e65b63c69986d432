//! The command `specimen` of a program that is built without it.

use crate::Exit;
pub(crate) use crate::absent::AnyArguments as SpecimenArguments;

pub(crate) fn load(_: &SpecimenArguments) -> Exit {
    crate::absent::refuse("specimens of solids", "specimens", "specimen uniaxial --solid SOLID --path stretch=1..3")
}
