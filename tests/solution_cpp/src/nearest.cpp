// The nearest hit in a scene. Stage 01.
#include "functions.hpp"
#include "object.hpp"
#include "todo.hpp"

// Returns the nearest hit of `ray` among all objects of the scene, or nothing. [rule 2]
//
// - `ray` and the hit are in world space. `intersect_object(scene, index, ray)` returns the hit
//   with one object.
// - The least t counts. Of two hits at the same t, the one with the object that is listed first
//   wins: a later one replaces it only if it is strictly nearer.
// - An empty scene gives nothing.
std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray) {
    std::optional<Hit> nearest;
    for (std::size_t index = 0; index < scene.objects.size(); ++index) {
        const std::optional<Hit> hit = intersect_object(scene, index, ray);
        if (hit && (!nearest || hit->t < nearest->t)) {
            nearest = hit;
        }
    }
    return nearest;
}
