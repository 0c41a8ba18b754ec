//! The page `docs/effects.md` on what effects do in pictures.

use pages::figures::percent;
use pages::page::{Serde, Value, context, text};
use serde::Serialize;

use super::view::{Done, EffectInView, View};

/// The scenes of the page, as on the command line in the folder that contains `docs`. The first six
/// have effects that their pictures need, the others effects that they do not.
pub const SCENES: [&str; 14] = [
    "docs/showcase.toml",
    "02_shadows/stained_glass",
    "03_reflection/hall_of_mirrors",
    "04_refraction/crystal_ball",
    "05_transforms/pebbles",
    "06_smooth_normals/three_corners",
    "docs/effects/red_lamp.toml",
    "docs/effects/faint_lamp.toml",
    "docs/effects/glass_off_screen.toml",
    "docs/effects/glass_under_the_floor.toml",
    "docs/effects/lone_mirror.toml",
    "docs/effects/clamped_lamp.toml",
    "docs/effects/glowing_mesh.toml",
    "docs/effects/matt_balls.toml",
];

/// A scene of the page.
#[derive(Debug)]
pub struct Subject {
    /// The name, one of [`SCENES`].
    pub named: &'static str,
    /// What its effects do.
    pub view: View,
}

#[derive(Debug, Serialize)]
struct Table {
    named: &'static str,
    n_pixels: u64,
    n_rays: u64,
    rows: Vec<[String; 5]>,
}

/// Returns the page in Markdown.
pub fn markdown(subjects: Vec<Subject>) -> String {
    let table = |Subject { named, view }: Subject| Table {
        named,
        n_pixels: view.n_pixels,
        n_rays: view.rays.map_or(0, |rays| rays.total()),
        rows: view.effects.iter().map(|effect| row(effect, view.n_pixels)).collect(),
    };
    let tables: Vec<Table> = subjects.into_iter().map(table).collect();
    text(include_str!("effects.md.in"), &context! { tables => Value::from(Serde(tables)) })
}

/// Returns the cells of an effect in a picture of `n_pixels` pixels.
fn row(row: &EffectInView, n_pixels: u64) -> [String; 5] {
    let [made, changed] = match row.done {
        None => [String::new(), String::new()],
        Some(Done { made, of, n_changed }) => {
            let share = percent(n_changed as f64 / n_pixels.max(1) as f64);
            [format!("{made} {of}"), format!("{n_changed} ({share})")]
        }
    };
    [row.effect.name().to_owned(), row.need().says().to_owned(), row.because.clone(), made, changed]
}
