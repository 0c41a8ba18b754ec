/* A Whitted tracer in C, by another hand than the solution: single precision throughout, a stack in the place of recursion,
   textbook formulas, colours truncated to bytes. */
#pragma once
#include "json.h"
#include <math.h>
#include <tgmath.h>

typedef float real;
/* A new ray leaves out what is nearer than this. */
#define EPSILON ((real)3e-4)
#define AIR ((real)1.0003)

typedef struct { real x, y, z; } Vec;
typedef struct { Vec origin, direction; real t_min, t_max; } Ray;
typedef struct { Vec columns[3], shift; } Affine;
typedef struct { real t; Vec geometric, shading; int object; bool hit; } Hit;

typedef struct { Vec ke, ka, kd, ks, kt, kr; real ns, index; } Material;
typedef struct { bool directional; Vec place, colour, ambient; real quadratic, linear, constant; } Light;
typedef struct { int n_triangles; int (*triangles)[3]; Vec *vertices, *normals; } Mesh;
typedef enum { SPHERE, PLANE, SQUARE, BOX, CONE, MESH } Kind;
typedef struct {
    Kind kind;
    Vec a, b;                       /* centre; normal; corners */
    real size, size_2, from, to;    /* radius or k, upper radius, ends along z */
    bool capped, moved;
    int mesh, material;
    Affine object_from_world;
} Object;

typedef struct {
    int width, height, max_depth;
    real threshold;
    bool shadows, tinted, reflection, refraction, smooth, adaptive;
    Vec eye, right, up, forward, background;
    real fov;
    int n_lights, n_objects;
    Light *lights;
    Material *materials;
    Mesh *meshes;
    Object *objects;
} Scene;

static inline Vec vec(real x, real y, real z) { return (Vec){x, y, z}; }
static inline Vec add(Vec a, Vec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec sub(Vec a, Vec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec scale(real s, Vec a) { return vec(s * a.x, s * a.y, s * a.z); }
static inline Vec times(Vec a, Vec b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline Vec neg(Vec a) { return vec(-a.x, -a.y, -a.z); }
static inline real dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec cross(Vec a, Vec b) {
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline real norm(Vec a) { return sqrt(dot(a, a)); }
static inline Vec unit(Vec a) { return scale(1 / norm(a), a); }
static inline Vec at(const Ray *ray, real t) { return add(ray->origin, scale(t, ray->direction)); }
static inline bool counts(const Ray *ray, real t) { return ray->t_min < t && t < ray->t_max; }
static inline bool black(Vec a) { return a.x == 0 && a.y == 0 && a.z == 0; }
static inline real most(Vec a) { return fmax(a.x, fmax(a.y, a.z)); }

/* shapes.c: all in the frame of the ray; normals point outwards. */
Hit sphere(const Ray *ray, Vec center, real radius);
Hit plane(const Ray *ray, Vec normal, real k);
Hit square(const Ray *ray);
Hit box(const Ray *ray, Vec min, Vec max);
Hit cone(const Ray *ray, const Object *object);
Hit triangle(const Ray *ray, Vec a, Vec b, Vec c);
Vec weights(Vec a, Vec b, Vec c, Vec q);
Vec interpolate(Vec weights, Vec a, Vec b, Vec c);
Ray to_object(const Ray *ray, const Affine *object_from_world);
Vec to_world(Vec normal, const Affine *object_from_world);
Hit meet(const Scene *scene, int object, const Ray *ray);
Hit nearest(const Scene *scene, const Ray *ray);

/* trace.c */
Ray eye_ray(const Scene *scene, int i, int j);
Vec to_light(const Light *light, Vec point, real *distance);
real attenuation(const Light *light, real r);
bool facing(Vec direction, Vec *normal);
Vec ambient(const Material *material, const Light *light, bool inside);
Vec light_term(const Material *material, Vec arriving, Vec normal, Vec to_viewer, Vec to_light);
Vec shadow(const Scene *scene, const Light *light, Vec point);
Vec shade(const Scene *scene, const Material *material, Vec point, Vec normal, Vec to_viewer, bool inside);
Vec reflect(Vec direction, Vec normal);
bool refract(Vec direction, Vec normal, real eta_i, real eta_t, Vec *transmitted);
Vec smooth_reflect(Vec direction, Vec geometric, Vec shading);
bool smooth_refract(Vec direction, Vec geometric, Vec shading, real eta_i, real eta_t, Vec *transmitted);
bool goes_on(int depth, int max_depth, Vec weight, real threshold);
Vec trace(const Scene *scene, Ray ray, int depth);

/* tracer.c and probe.c */
Scene read_scene(const Json *json);
Vec read_vec(const Json *json);
Material read_material(const Json *json);
Light read_light(const Json *json);
Affine read_affine(const Json *rows);
int probe(void);
