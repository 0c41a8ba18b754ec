//! The command `reference cost --store`: measures what accuracy costs in each public case, for
//! students to compare themselves with.

use std::collections::BTreeMap;
use std::path::Path;

use cases::Scene;
use cases::course::course_of;
use cases::files;
use cases::front::{FrontPoint, Fronts, fronts_path, fronts_to_string, rmse_levels, workspace_of};
use cases::stage;
use pages::say;

use super::args::CostArgs;
use super::cost_session::{Session, measured_on, put};
use super::find;
use super::output::Talk;
use super::stop::Stop;
use super::values::STAGES;
use crate::cost::bench::Bench;
use crate::cost::setting::{Formula, Setting};
use crate::cost::sweep::{About, Sweep};
use crate::cost::times::Times;
use crate::expect::variations::Precision;
use crate::rules::Rules;

/// Measures every case and stores the points. An interrupt leaves the stored file unchanged.
pub(super) fn run(args: &CostArgs, session: &Session) -> Result<(), Stop> {
    let stages = Path::new(STAGES);
    let path = fronts_path(stages);
    files::check(&path)?;
    let course = match find::given(&args.course)? {
        Some(course) => course,
        None => course_of(stages)?,
    };
    let rules = Rules::of(&course);
    let mut points = BTreeMap::new();
    for case in stage::load_all(stages, &course)?.iter().flat_map(|stage| &stage.cases) {
        if session.talk >= Talk::Verbose {
            say::err(&case.id);
        }
        points.insert(case.id.clone(), of_case(&case.scene, &rules, args.rounds, session)?);
    }
    let n_cases = points.len();
    let machine = session.machine();
    let fronts = Fronts {
        machine: format!("{}, {} of one thread", machine.processor, machine.clock),
        measured_on: measured_on(&workspace_of(stages))?,
        cases: points,
    };
    let text = fronts_to_string(&fronts).map_err(Stop::machine("cannot encode the fronts"))?;
    put(&path, text.as_bytes(), session.talk)?;
    if session.talk >= Talk::Normal {
        say::err(&format!("wrote {}: {n_cases} cases", path.display()));
    }
    Ok(())
}

/// Measures both precisions with all formulas, then the scene's own setting at each lesser depth.
/// There is one ray per pixel, as in judged pictures.
fn of_case(
    scene: &Scene,
    rules: &Rules,
    rounds: u16,
    session: &Session,
) -> Result<Vec<FrontPoint>, Stop> {
    let own = Setting::of(scene);
    let both = |formula| [Precision::F64, Precision::F32].map(|precision| (precision, formula));
    let mut settings: Vec<(Setting, String)> = Formula::ALL
        .into_iter()
        .rev()
        .flat_map(both)
        .map(|(precision, formula)| {
            (
                Setting { precision, formula, alike: true, ..own },
                format!("{}, {} formulas", precision.says(), formula.name()),
            )
        })
        .collect();
    if scene.effects.has(cases::Effect::Reflection) || scene.effects.has(cases::Effect::Refraction)
    {
        let shallower = (0..own.max_depth).rev();
        settings.extend(shallower.map(|max_depth| {
            (Setting { max_depth, ..own }, format!("f64, robust formulas, depth {max_depth}"))
        }));
    }
    let subjects = settings.iter().map(|(setting, _)| (*setting, About::Accuracy)).collect();
    let sweep = Sweep::against(own, subjects);
    let measured = session.sweep(scene, rules, &sweep, usize::from(rounds))?;
    session.end(measured.first().map_or(0, |one| one.times_s.len()), rounds)?;
    let mut bench = Bench::new(scene, rules);
    let (expected, _) = bench.render(&own);
    let point =
        |((setting, name), one): ((Setting, String), &crate::cost::measure::Measured)| FrontPoint {
            setting: name,
            time_s: Times::of(&one.times_s).median,
            rmse_levels: rmse_levels(&expected, &bench.render(&setting).0),
        };
    Ok(settings.into_iter().zip(&measured).map(point).collect())
}
