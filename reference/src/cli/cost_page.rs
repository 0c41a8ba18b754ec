//! The command `reference cost --page`: writes docs/accuracy.md and its pictures.

use std::path::Path;

use pages::say;

use super::args::CostArgs;
use super::cost_session::{Session, measured_on, of_functions, of_scene, put};
use super::find::{self, Found};
use super::output::Talk;
use super::stop::Stop;
use crate::cost::document::{self, Document, EPSILONS, SCENES, SIZED};
use crate::cost::plot::{self, Place};
use crate::cost::setting::Setting;
use crate::cost::starts;
use crate::expect::variations::Precision;
use crate::rules::Rules;

/// Measures what the page shows, and writes it. An interrupt leaves the old page: half a page would
/// mix two measurements.
pub(super) fn run(args: &CostArgs, path: &Path, session: &Session) -> Result<(), Stop> {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.ok_or_else(|| Stop::Usage(format!("`{}` names no file", path.display())))?;
    let functions = of_functions(args, session)?;
    session.end(functions.rounds, args.rounds)?;
    let mut scenes = Vec::new();
    for named in SCENES {
        let report = of_scene(named, args, session)?;
        session.end(report.rounds, args.rounds)?;
        scenes.push(report);
    }
    let Found { scene, course, .. } = find::found(SIZED, &args.course)?;
    let (rules, n_rounds) = (Rules::of(&course), usize::from(args.rounds));
    let precisions = [Precision::F64, Precision::F32];
    let ways = starts::ways(&rules, &Setting::of(&scene), &precisions, &EPSILONS);
    let starts = session.starts(&scene, &ways, n_rounds)?;
    let threads = session.threads(&scene, &rules, n_rounds)?;
    let measured_on = measured_on(Path::new("."))?;
    let page = Document { measured_on, functions, scenes, starts, threads };
    let beside = |name: String| path.with_file_name(name);
    for scene in &page.scenes {
        let picture = plot::stack(&crate::cost::page::plots(scene), Place::File);
        put(
            &beside(document::picture_name(&stem, &scene.scene)),
            picture.as_bytes(),
            session.talk,
        )?;
    }
    let functions = ["sphere", "triangle"].map(|function| page.functions.plot(function));
    put(
        &beside(format!("{stem}-functions.svg")),
        plot::stack(&functions, Place::File).as_bytes(),
        session.talk,
    )?;
    put(path, document::markdown(&page, &stem).as_bytes(), session.talk)?;
    if session.talk >= Talk::Normal {
        say::err(&format!("wrote {} and {} pictures beside it", path.display(), SCENES.len() + 1));
    }
    Ok(())
}
