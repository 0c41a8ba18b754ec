//! Tests of `effects --measure`: a picture without each of its effects in turn.

use cases::{Course, Effect, effects};
use reference::cost::bench::Bench;
use reference::cost::idle::EffectCosts;
use reference::cost::measure::measure;
use reference::cost::need::Need;
use reference::cost::sweep::Sweep;
use reference::rules::Rules;

use crate::common::cost::{FakeClock, scene};

/// Measures the scene without each of its effects. A picture takes half a second.
fn effect_costs(text: &str) -> EffectCosts {
    let scene = scene(text);
    let mut bench = Bench::new(&scene, &Rules::LECTURE);
    let sweep = Sweep::of_effects(&scene);
    let measured = measure(&mut bench, &sweep, 1, &mut FakeClock::until(usize::MAX)).unwrap();
    EffectCosts::new(&scene, effects::reasons(&scene, &Course::default()), &measured)
}

/// A red lamp shines on a ball above a floor, both of red paint.
const LAMP: &str = r#"
[render]
size = [12, 9]
[scene.camera]
eye = [0, 1, 4]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y_deg = 60
[scene.materials]
paint = { kd = [0.5, 0, 0] }
[[scene.lights]]
point = { position = [0, 3, 0], colour = [1, 0, 0] }
[[scene.objects]]
sphere = { radius = 0.5 }
material = "paint"
[[scene.objects]]
plane = { normal = [0, 1, 0], k = -0.7 }
material = "paint"
"#;

#[test]
fn an_effect_that_is_called_for_and_changes_no_pixel_is_idle() {
    let shadows = |text: &str| {
        let costs = effect_costs(text);
        assert_eq!((costs.n_pixels, costs.rounds, costs.time_ms.median), (108, 1, 500.0));
        let row = costs.effects.iter().find(|row| row.effect == Effect::Shadows).unwrap().clone();
        assert!(row.called_for, "{row:?}");
        let without = row.without.unwrap();
        // The eye rays are left.
        assert_eq!((without.rays.total(), costs.rays.eye), (108, 108), "{costs:?}");
        (row, costs.rays.shadow)
    };
    let (red, n_rays) = shadows(LAMP);
    assert!(
        red.need() == Need::CalledFor && red.without.unwrap().n_changed > 0 && n_rays > 0,
        "{red:?}"
    );
    // The shadow of the ball lies behind the eye.
    let beside = LAMP.replace("sphere = { radius", "sphere = { center = [0, 0, 50], radius");
    let (unseen, n_rays) = shadows(&beside);
    assert!(unseen.need() == Need::Idle && n_rays > 0, "{unseen:?}");
}

#[test]
fn an_effect_that_is_not_simulated_is_not_measured() {
    let costs = effect_costs(LAMP);
    assert_eq!(costs.effects.len(), Effect::ALL.len());
    for row in costs.effects.iter().filter(|row| row.effect != Effect::Shadows) {
        assert!(row.without.is_none() && row.need() == Need::NotCalledFor, "{row:?}");
    }
}
