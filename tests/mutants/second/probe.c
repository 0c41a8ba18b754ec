#include "tracer.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_vec(Vec v) { printf("[%.9g,%.9g,%.9g]", (double)v.x, (double)v.y, (double)v.z); }

static void print_number(real x) {
    if (isinf(x)) printf("\"inf\"");
    else printf("%.9g", (double)x);
}

static void say_vec(const char *kind, Vec v) {
    printf("\"%s\":", kind);
    print_vec(v);
}

static void say_hit(Hit hit) {
    if (!hit.hit) {
        printf("\"miss\":true");
        return;
    }
    printf("\"hit\":{\"t\":%.9g,\"normal\":", (double)hit.t);
    print_vec(hit.geometric);
    printf("}");
}

static void say_ray(Ray ray) {
    printf("\"ray\":{\"origin\":");
    print_vec(ray.origin);
    printf(",\"direction\":");
    print_vec(ray.direction);
    printf("}");
}

static void say_direction(bool there, Vec direction) {
    if (there) say_vec("vector", direction);
    else printf("\"miss\":true");
}

/* What stands under a key of the question. */
static const Json *asked;
static const Json *get(const char *key) { return json_get(asked, key); }
static Vec v(const char *key) { return read_vec(get(key)); }
static real x(const char *key) { return (real)get(key)->number; }

static Ray ray(void) {
    const Json *json = get("ray");
    return (Ray){
        read_vec(json_get(json, "origin")), read_vec(json_get(json, "direction")),
        (real)json_get(json, "t_min")->number, (real)json_get(json, "t_max")->number,
    };
}

/* Shapes, rays and scenes; false where it is about something else. */
static bool answer_scene(const char *fn) {
    if (!strcmp(fn, "eye_ray")) {
        const Json *camera = get("camera"), *pixel = get("pixel");
        Scene s = {.width = (int)x("width"), .height = (int)x("height")};
        s.eye = read_vec(json_get(camera, "eye")), s.right = read_vec(json_get(camera, "right"));
        s.up = read_vec(json_get(camera, "up")), s.forward = read_vec(json_get(camera, "forward"));
        s.fov = (real)json_get(camera, "fov_y_deg")->number;
        say_ray(eye_ray(&s, (int)json_at(pixel, 0)->number, (int)json_at(pixel, 1)->number));
    } else if (!strcmp(fn, "sphere")) {
        Ray r = ray();
        say_hit(sphere(&r, v("center"), x("radius")));
    } else if (!strcmp(fn, "plane")) {
        Ray r = ray();
        say_hit(plane(&r, v("normal"), x("k")));
    } else if (!strcmp(fn, "square")) {
        Ray r = ray();
        say_hit(square(&r));
    } else if (!strcmp(fn, "box")) {
        Ray r = ray();
        say_hit(box(&r, v("min"), v("max")));
    } else if (!strcmp(fn, "triangle")) {
        Ray r = ray();
        say_hit(triangle(&r, v("a"), v("b"), v("c")));
    } else if (!strcmp(fn, "nearest")) {
        Ray r = ray();
        Scene scene = read_scene(get("scene"));
        Hit hit = nearest(&scene, &r);
        if (hit.hit) printf("\"found\":{\"t\":%.9g,\"object\":%d}", (double)hit.t, hit.object);
        else printf("\"miss\":true");
    } else if (!strcmp(fn, "shade")) {
        Scene scene = read_scene(get("scene"));
        const Material *m = &scene.materials[scene.objects[(int)x("object")].material];
        say_vec("colour", shade(&scene, m, v("point"), v("normal"), v("to_viewer"), get("inside")->number != 0));
    } else if (!strcmp(fn, "shadow")) {
        Scene scene = read_scene(get("scene"));
        say_vec("colour", shadow(&scene, &scene.lights[(int)x("light")], v("point")));
    } else if (!strcmp(fn, "trace")) {
        Scene scene = read_scene(get("scene"));
        say_vec("colour", trace(&scene, ray(), (int)x("depth")));
    } else if (!strcmp(fn, "ray_to_object")) {
        Ray r = ray();
        Affine m = read_affine(get("object_from_world"));
        say_ray(to_object(&r, &m));
    } else if (!strcmp(fn, "transformed_sphere")) {
        Ray r = ray();
        Object ball = {.kind = SPHERE, .size = (real)0.5, .moved = true};
        ball.object_from_world = read_affine(get("object_from_world"));
        Scene scene = {.objects = &ball, .n_objects = 1};
        say_hit(meet(&scene, 0, &r));
    } else {
        return false;
    }
    return true;
}

/* Formulas. */
static bool answer_formula(const char *fn) {
    Vec out;
    if (!strcmp(fn, "to_light")) {
        Light light = read_light(get("light"));
        real distance;
        out = to_light(&light, v("point"), &distance);
        printf("\"to_light\":{\"direction\":");
        print_vec(out);
        printf(",\"t\":");
        print_number(distance);
        printf("}");
    } else if (!strcmp(fn, "attenuation")) {
        Light light = read_light(get("light"));
        printf("\"value\":%.9g", (double)attenuation(&light, x("r")));
    } else if (!strcmp(fn, "facing_normal")) {
        out = v("normal");
        bool inside = facing(v("direction"), &out);
        printf("\"facing\":{\"normal\":");
        print_vec(out);
        printf(",\"inside\":%s}", inside ? "true" : "false");
    } else if (!strcmp(fn, "ambient")) {
        Material material = read_material(get("material"));
        Light light = read_light(get("light"));
        say_vec("colour", ambient(&material, &light, get("inside")->number != 0));
    } else if (!strcmp(fn, "light_term")) {
        Material material = read_material(get("material"));
        say_vec("colour", light_term(&material, v("arriving"), v("normal"), v("to_viewer"), v("to_light")));
    } else if (!strcmp(fn, "reflect")) {
        say_vec("vector", reflect(v("direction"), v("normal")));
    } else if (!strcmp(fn, "goes_on")) {
        bool yes = goes_on((int)x("depth"), (int)x("max_depth"), v("weight"), x("threshold"));
        printf("\"goes_on\":%s", yes ? "true" : "false");
    } else if (!strcmp(fn, "indices")) {
        real index = x("index");
        bool inside = get("inside")->number != 0;
        printf("\"indices\":{\"eta_i\":%.9g,\"eta_t\":%.9g}", (double)(inside ? index : AIR), (double)(inside ? AIR : index));
    } else if (!strcmp(fn, "refract")) {
        bool there = refract(v("direction"), v("normal"), x("eta_i"), x("eta_t"), &out);
        say_direction(there, out);
    } else if (!strcmp(fn, "normal_to_world")) {
        Affine m = read_affine(get("object_from_world"));
        say_vec("vector", to_world(v("normal"), &m));
    } else if (!strcmp(fn, "barycentric")) {
        say_vec("vector", weights(v("a"), v("b"), v("c"), v("q")));
    } else if (!strcmp(fn, "interpolate")) {
        const Json *n = get("normals");
        say_vec("vector", interpolate(v("weights"), read_vec(json_at(n, 0)), read_vec(json_at(n, 1)), read_vec(json_at(n, 2))));
    } else if (!strcmp(fn, "smooth_reflect")) {
        say_vec("vector", smooth_reflect(v("direction"), v("n_geom"), v("n_shading")));
    } else if (!strcmp(fn, "smooth_refract")) {
        bool there = smooth_refract(v("direction"), v("n_geom"), v("n_shading"), x("eta_i"), x("eta_t"), &out);
        say_direction(there, out);
    } else {
        return false;
    }
    return true;
}

int probe(void) {
    static char line[1 << 22];
    while (fgets(line, sizeof line, stdin)) {
        asked = json_parse(line);
        const char *fn = get("fn")->string;
        printf("{\"id\":\"%s\",", get("id")->string);
        if (!answer_scene(fn) && !answer_formula(fn)) printf("\"todo\":true");
        printf("}\n");
        fflush(stdout);
    }
    return 0;
}
