//! The cost of an effect that a scene does not call for, compared with a kernel from which it is
//! deleted.

use reference::cost::measure::Outside;
pub use reference::cost::uncalled::UncalledRow;
use reference::cost::uncalled::price;
use rustix::time::{ClockId, clock_gettime};

use super::bench::Bench;

/// The factor on the rounds of the other sections, because the pictures are small.
const TIMES_THE_ROUNDS: usize = 10;

/// Renders each scene by each kernel in turn on one thread, and returns CPU seconds.
///
/// # Errors
/// Returns an error if threads cannot be started or there are no rounds.
pub fn measure(bench: &Bench) -> Result<Vec<UncalledRow>, String> {
    bench.say("effects that are not called for");
    let pool =
        rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|why| why.to_string())?;
    let rows = pool.install(|| price(TIMES_THE_ROUNDS * bench.n_rounds, &mut Processor));
    rows.ok_or_else(|| "there are no rounds".to_owned())
}

/// The CPU clock of this process. The measurement is never interrupted.
struct Processor;

impl Outside for Processor {
    fn now_s(&mut self) -> f64 {
        let now = clock_gettime(ClockId::ProcessCPUTime);
        now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
    }

    fn goes_on(&mut self) -> bool {
        true
    }

    fn done(&mut self, _work: u64) {}
}
