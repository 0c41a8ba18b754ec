//! Asks a program what the cases ask: each picture in a process and folder of its own, the unit checks of a stage in one
//! process where it holds out.

mod explain;
mod pictures;
mod probes;
mod replies;

use std::ffi::OsString;
use std::path::Path;
use std::time::Duration;

use crate::build::Program;
use crate::sandbox::{self, Call, Finished, Limits, Outcome};

pub use explain::explain;
pub use pictures::{NoPicture, Shot, read, shoot};
pub use probes::{Probed, probe};
pub use replies::Got;

/// What a program may use for one picture.
pub const RENDER: Limits = Limits {
    wall: Duration::from_secs(30),
    cpu: Duration::from_secs(60),
    memory: 1 << 30,
    file_size: 64 << 20,
    output: 16 << 20,
    processes: 64,
};

/// What a program may use for the unit checks of a stage.
pub const PROBE: Limits = Limits { wall: Duration::from_secs(10), cpu: Duration::from_secs(20), ..RENDER };

/// Runs `program` with more arguments in `folder`; once again where the machine kept it from starting.
fn run(program: &Program, args: &[OsString], folder: &Path, stdin: Vec<u8>, limits: Limits) -> Finished {
    let environment = [
        ("PATH", program.search.clone()),
        ("HOME", folder.into()),
        ("TMPDIR", folder.into()),
        ("LANG", "C.UTF-8".into()),
    ];
    let call = Call {
        program: program.path.clone(),
        args: program.args.iter().chain(args).cloned().collect(),
        folder: folder.to_owned(),
        environment: environment.map(|(name, value)| (name.into(), value)).to_vec(),
        stdin,
        limits,
    };
    let finished = sandbox::run(&call);
    if matches!(finished.outcome, Outcome::CouldNotStart(_)) { sandbox::run(&call) } else { finished }
}

#[cfg(test)]
mod tests;
