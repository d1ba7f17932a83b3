//! `eyebeam figures`.
use crate::args::FiguresArgs;
use crate::error::Error;

pub(super) fn run(_args: &FiguresArgs) -> Result<(), Error> {
    Ok(())
}
