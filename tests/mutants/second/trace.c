#include "tracer.h"
#include <stdlib.h>

Ray eye_ray(const Scene *s, int i, int j) {
    real half = tan(s->fov * (real)0.008726646259971648), pixel = 2 * half / s->height;
    real x = (i + (real)0.5 - s->width * (real)0.5) * pixel, y = (s->height * (real)0.5 - j - (real)0.5) * pixel;
    Vec direction = unit(add(s->forward, add(scale(x, s->right), scale(y, s->up))));
    return (Ray){s->eye, direction, EPSILON, INFINITY};
}

Vec to_light(const Light *light, Vec point, real *distance) {
    if (light->directional) return *distance = INFINITY, neg(light->place);
    Vec way = sub(light->place, point);
    *distance = norm(way);
    return *distance == 0 ? way : scale(1 / *distance, way);
}

real attenuation(const Light *light, real r) {
    if (light->directional) return 1;
    real denominator = (light->quadratic * r + light->linear) * r + light->constant;
    return denominator > 1 ? 1 / denominator : 1;
}

bool facing(Vec direction, Vec *normal) {
    if (dot(direction, *normal) <= 0) return false;
    *normal = neg(*normal);
    return true;
}

Vec ambient(const Material *m, const Light *light, bool inside) {
    Vec part = times(m->ka, light->ambient);
    return inside ? times(part, m->kt) : part;
}

Vec light_term(const Material *m, Vec arriving, Vec normal, Vec to_viewer, Vec to_light) {
    real cosine = dot(normal, to_light);
    if (!(cosine > 0)) return vec(0, 0, 0);
    Vec sum = add(to_light, to_viewer), part = scale(cosine, times(arriving, m->kd));
    real length = norm(sum);
    if (length == 0) return part;
    real n_dot_h = fmax(dot(normal, sum) / length, (real)0);
    return add(part, scale(pow(n_dot_h, m->ns), times(arriving, m->ks)));
}

Vec shadow(const Scene *scene, const Light *light, Vec point) {
    Vec share = vec(1, 1, 1);
    real distance;
    Vec direction = to_light(light, point, &distance);
    if (!scene->shadows || distance == 0) return share;
    for (int n = 0; n < scene->n_objects; n++) {
        Vec kt = scene->tinted ? scene->materials[scene->objects[n].material].kt : vec(0, 0, 0);
        Ray ray = {point, direction, EPSILON, distance};
        for (Hit hit = meet(scene, n, &ray); hit.hit; hit = meet(scene, n, &ray)) {
            share = times(share, kt);
            if (black(share)) return share;
            ray.t_min = hit.t + EPSILON;
        }
    }
    return share;
}

Vec shade(const Scene *scene, const Material *m, Vec point, Vec normal, Vec to_viewer, bool inside) {
    Vec sum = vec(0, 0, 0);
    for (int n = scene->n_lights - 1; n >= 0; n--) {
        const Light *light = &scene->lights[n];
        real distance;
        Vec direction = to_light(light, point, &distance);
        sum = add(sum, ambient(m, light, inside));
        if (!(dot(normal, direction) > 0)) continue;
        Vec arriving = times(scale(attenuation(light, distance), light->colour), shadow(scene, light, point));
        sum = add(sum, light_term(m, arriving, normal, to_viewer, direction));
    }
    return add(sum, m->ke);
}

Vec reflect(Vec d, Vec n) { return sub(d, scale(2 * dot(d, n), n)); }

bool refract(Vec d, Vec n, real eta_i, real eta_t, Vec *transmitted) {
    real ratio = eta_i / eta_t, cosine = -dot(d, n), under = 1 - ratio * ratio * (1 - cosine * cosine);
    if (under < 0) return false;
    *transmitted = add(scale(ratio, d), scale(ratio * cosine - sqrt(under), n));
    return true;
}

Vec smooth_reflect(Vec d, Vec geometric, Vec shading) {
    Vec mirrored = reflect(d, shading);
    return dot(mirrored, geometric) > 0 ? mirrored : reflect(d, geometric);
}

bool smooth_refract(Vec d, Vec geometric, Vec shading, real eta_i, real eta_t, Vec *transmitted) {
    if (dot(d, shading) < 0) {
        if (!refract(d, shading, eta_i, eta_t, transmitted)) return false;
        if (dot(*transmitted, geometric) < 0) return true;
    }
    return refract(d, geometric, eta_i, eta_t, transmitted);
}

bool goes_on(int depth, int max_depth, Vec weight, real threshold) {
    return depth < max_depth && (threshold <= 0 || most(weight) >= threshold);
}

/* A ray that is still to be followed, and what its light counts for. */
typedef struct { Ray ray; Vec weight; int depth; } Task;

Vec trace(const Scene *scene, Ray first, int depth) {
    enum { ROOM = 4096 };
    static Task stack[ROOM];
    int n_tasks = 0;
    Vec sum = vec(0, 0, 0);
    stack[n_tasks++] = (Task){first, vec(1, 1, 1), depth};
    while (n_tasks > 0) {
        Task task = stack[--n_tasks];
        Hit hit = nearest(scene, &task.ray);
        if (!hit.hit) {
            sum = add(sum, times(task.weight, scene->background));
            continue;
        }
        const Material *m = &scene->materials[scene->objects[hit.object].material];
        Vec d = task.ray.direction, point = at(&task.ray, hit.t);
        bool inside = facing(d, &hit.geometric);
        if (inside) hit.shading = neg(hit.shading);
        sum = add(sum, times(task.weight, shade(scene, m, point, hit.shading, neg(d), inside)));
        if (!goes_on(task.depth, scene->max_depth, task.weight, scene->adaptive ? scene->threshold : 0)) continue;
        if (n_tasks + 2 > ROOM) abort();
        if (scene->reflection && !black(m->kr)) {
            Ray ray = {point, smooth_reflect(d, hit.geometric, hit.shading), EPSILON, INFINITY};
            stack[n_tasks++] = (Task){ray, times(task.weight, m->kr), task.depth + 1};
        }
        Vec transmitted;
        real eta_i = inside ? m->index : AIR, eta_t = inside ? AIR : m->index;
        if (scene->refraction && !black(m->kt)
            && smooth_refract(d, hit.geometric, hit.shading, eta_i, eta_t, &transmitted)) {
            Ray ray = {point, transmitted, EPSILON, INFINITY};
            stack[n_tasks++] = (Task){ray, times(task.weight, m->kt), task.depth + 1};
        }
    }
    return sum;
}
