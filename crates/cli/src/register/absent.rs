//! The command `register` of a program that is built without it.

use crate::Exit;
pub(crate) use crate::absent::AnyArguments as RegisterArguments;

pub(crate) fn register(_: &RegisterArguments) -> Exit {
    crate::absent::refuse("registration of images", "register", "register FIXED MOVING --out DIR")
}
