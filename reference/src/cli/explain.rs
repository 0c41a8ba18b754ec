//! The command `reference explain`.

use cases::ray_tree;

use super::args::ExplainArgs;
use super::find::{self, Found};
use super::output::{print, print_json};
use super::stop::{Stop, too_many_rays};
use crate::rules::Rules;
use crate::trace::kernel::Kernel;
use crate::watch::Recorder;
use crate::watch::metered::{Metered, RayBudget};
use crate::world::World;

/// Runs the command.
pub(super) fn run(args: &ExplainArgs) -> Result<(), Stop> {
    let Found { scene, course, .. } = find::found(&args.scene, &args.course)?;
    let (width, height) = (scene.render.width, scene.render.height);
    if args.x >= width || args.y >= height {
        let (x, y) = (args.x, args.y);
        return Err(Stop::Usage(format!(
            "pixel ({x}, {y}) does not lie in a picture of {width}×{height}"
        )));
    }
    let world = World::<f64>::new(&scene);
    let rules = Rules::of(&course);
    let kernel = Kernel::new(&world, &rules, scene.effects);
    let budget = args.max_rays.map(RayBudget::new);
    let tree = ray_tree::record(|| {
        let mut watch = Metered::new(Recorder, budget.as_ref());
        kernel.eye((args.x, args.y), (0.5, 0.5), &mut watch);
        watch.settled();
    });
    if let Some(most) = args.max_rays
        && budget.is_some_and(|budget| budget.is_exceeded())
    {
        return Err(too_many_rays("the pixel", most));
    }
    match tree {
        Some(tree) if args.json => print_json(&tree),
        Some(tree) => print(tree.to_string().as_bytes()),
        None => {
            Err(Stop::Machine { what: "no tree to show", source: "no ray was recorded".into() })
        }
    }
}
