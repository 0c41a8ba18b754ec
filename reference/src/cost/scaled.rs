//! Scales a scene. In exact arithmetic its picture does not change.

use cases::glam::{DAffine3, DVec3};
use cases::scene::Attenuation;
use cases::{Light, Object, Scene};

/// Returns `scene` with every length multiplied by `factor`, such as a power of ten or two.
/// Attenuation is adjusted, so that lights weaken by as much over the scaled distances.
pub fn scaled(scene: &Scene, factor: f64) -> Scene {
    let mut scene = scene.clone();
    scene.camera.eye *= factor;
    for light in &mut scene.lights {
        if let Light::Point { position, attenuation, .. } = light {
            *position *= factor;
            *attenuation = Attenuation {
                quadratic: attenuation.quadratic / (factor * factor),
                linear: attenuation.linear / factor,
                ..*attenuation
            };
        }
    }
    let to = DAffine3::from_scale(DVec3::splat(factor));
    let back = DAffine3::from_scale(DVec3::splat(1.0 / factor));
    for Object { world_from_object, object_from_world, .. } in &mut scene.objects {
        *world_from_object = to * *world_from_object;
        *object_from_world *= back;
    }
    scene
}
