#include "tracer.h"

static const Hit MISS = {0};

static Hit found(real t, Vec normal) { return (Hit){.t = t, .geometric = normal, .shading = normal, .hit = true}; }

Hit sphere(const Ray *ray, Vec center, real radius) {
    Vec f = sub(ray->origin, center);
    real a = dot(ray->direction, ray->direction), middle = -dot(f, ray->direction) / a;
    Vec across = add(f, scale(middle, ray->direction));
    real half = (radius * radius - dot(across, across)) / a;
    if (half < 0) return MISS;
    half = sqrt(half);
    real t = middle - half;
    if (!counts(ray, t)) t = middle + half;
    if (!counts(ray, t)) return MISS;
    return found(t, unit(sub(at(ray, t), center)));
}

Hit plane(const Ray *ray, Vec normal, real k) {
    real slope = dot(normal, ray->direction), t = (k - dot(normal, ray->origin)) / slope;
    return slope != 0 && counts(ray, t) ? found(t, normal) : MISS;
}

Hit square(const Ray *ray) {
    Hit hit = plane(ray, vec(0, 0, 1), 0);
    Vec q = at(ray, hit.t);
    return hit.hit && fabs(q.x) <= (real)0.5 && fabs(q.y) <= (real)0.5 ? hit : MISS;
}

Hit box(const Ray *ray, Vec min, Vec max) {
    const real *low = &min.x, *high = &max.x, *p = &ray->origin.x, *d = &ray->direction.x;
    real entry = -INFINITY, leave = INFINITY;
    int in = 0, out = 0;
    for (int axis = 0; axis < 3; axis++) {
        if (d[axis] == 0) {
            if (p[axis] < low[axis] || p[axis] > high[axis]) return MISS;
            continue;
        }
        real one = (low[axis] - p[axis]) / d[axis], two = (high[axis] - p[axis]) / d[axis];
        real near = fmin(one, two), far = fmax(one, two);
        if (near > entry) entry = near, in = axis;
        if (far < leave) leave = far, out = axis;
    }
    if (entry > leave) return MISS;
    Vec normal = vec(0, 0, 0);
    if (counts(ray, entry)) {
        (&normal.x)[in] = d[in] > 0 ? -1 : 1;
        return found(entry, normal);
    }
    (&normal.x)[out] = d[out] > 0 ? 1 : -1;
    return counts(ray, leave) ? found(leave, normal) : MISS;
}

static Hit cap(const Ray *ray, real radius, real z, real sense) {
    real t = (z - ray->origin.z) / ray->direction.z;
    Vec q = at(ray, t);
    bool inside = radius > 0 && q.x * q.x + q.y * q.y <= radius * radius;
    return inside && counts(ray, t) ? found(t, vec(0, 0, sense)) : MISS;
}

Hit cone(const Ray *ray, const Object *o) {
    Vec p = ray->origin, d = ray->direction;
    real slope = (o->size_2 - o->size) / (o->to - o->from);
    real r = o->size + slope * (p.z - o->from), dr = slope * d.z;
    real a = d.x * d.x + d.y * d.y - dr * dr, b = p.x * d.x + p.y * d.y - r * dr, c = p.x * p.x + p.y * p.y - r * r;
    Hit best = MISS;
    real discriminant = b * b - a * c;
    if (discriminant >= 0) {
        real q = b < 0 ? sqrt(discriminant) - b : -sqrt(discriminant) - b;
        real roots[2] = {fmin(q / a, c / q), fmax(q / a, c / q)};
        for (int n = 1; n >= 0; n--) {
            Vec on = at(ray, roots[n]);
            if (!counts(ray, roots[n]) || on.z < o->from || on.z > o->to) continue;
            real radius = o->size + slope * (on.z - o->from);
            best = found(roots[n], unit(vec(on.x, on.y, -slope * radius)));
        }
    }
    if (o->capped) {
        Hit ends[2] = {cap(ray, o->size, o->from, -1), cap(ray, o->size_2, o->to, 1)};
        for (int n = 0; n < 2; n++)
            if (ends[n].hit && (!best.hit || ends[n].t < best.t)) best = ends[n];
    }
    return best;
}

/* Möller and Trumbore. */
Hit triangle(const Ray *ray, Vec a, Vec b, Vec c) {
    Vec u = sub(b, a), v = sub(c, a), p = cross(ray->direction, v);
    real determinant = dot(u, p);
    if (determinant == 0) return MISS;
    Vec s = sub(ray->origin, a), q = cross(s, u);
    real beta = dot(s, p) / determinant, gamma = dot(ray->direction, q) / determinant, t = dot(v, q) / determinant;
    bool inside = beta >= 0 && gamma >= 0 && beta + gamma <= 1;
    return inside && counts(ray, t) ? found(t, unit(cross(u, v))) : MISS;
}

/* Areas in the plane of the two axes along which the normal is shorter. */
Vec weights(Vec a, Vec b, Vec c, Vec q) {
    Vec n = cross(sub(b, a), sub(c, a));
    int axis = fabs(n.x) >= fabs(n.y) && fabs(n.x) >= fabs(n.z) ? 0 : fabs(n.y) >= fabs(n.z) ? 1 : 2;
    Vec qa = sub(a, q), qb = sub(b, q), qc = sub(c, q), one = cross(qb, qc), two = cross(qc, qa), three = cross(qa, qb);
    real whole = (&n.x)[axis];
    return vec((&one.x)[axis] / whole, (&two.x)[axis] / whole, (&three.x)[axis] / whole);
}

Vec interpolate(Vec w, Vec a, Vec b, Vec c) { return unit(add(scale(w.x, a), add(scale(w.y, b), scale(w.z, c)))); }

static Vec linear(const Affine *m, Vec v) {
    return add(scale(v.x, m->columns[0]), add(scale(v.y, m->columns[1]), scale(v.z, m->columns[2])));
}

Ray to_object(const Ray *ray, const Affine *m) {
    return (Ray){add(linear(m, ray->origin), m->shift), linear(m, ray->direction), ray->t_min, ray->t_max};
}

Vec to_world(Vec n, const Affine *m) { return unit(vec(dot(m->columns[0], n), dot(m->columns[1], n), dot(m->columns[2], n))); }

static Hit in_mesh(const Mesh *mesh, bool smooth, Ray ray) {
    Hit best = MISS;
    const int *corners = NULL;
    for (int n = 0; n < mesh->n_triangles; n++) {
        const int *one = mesh->triangles[n];
        Hit hit = triangle(&ray, mesh->vertices[one[0]], mesh->vertices[one[1]], mesh->vertices[one[2]]);
        if (hit.hit) best = hit, ray.t_max = hit.t, corners = one;
    }
    if (best.hit && smooth && mesh->normals) {
        const Vec *v = mesh->vertices, *n = mesh->normals;
        Vec w = weights(v[corners[0]], v[corners[1]], v[corners[2]], at(&ray, best.t));
        best.shading = interpolate(w, n[corners[0]], n[corners[1]], n[corners[2]]);
    }
    return best;
}

Hit meet(const Scene *scene, int index, const Ray *world) {
    const Object *o = &scene->objects[index];
    Ray ray = o->moved ? to_object(world, &o->object_from_world) : *world;
    Hit hit = MISS;
    switch (o->kind) {
    case SPHERE: hit = sphere(&ray, o->a, o->size); break;
    case PLANE: hit = plane(&ray, o->a, o->size); break;
    case SQUARE: hit = square(&ray); break;
    case BOX: hit = box(&ray, o->a, o->b); break;
    case CONE: hit = cone(&ray, o); break;
    case MESH: hit = in_mesh(&scene->meshes[o->mesh], scene->smooth, ray); break;
    }
    hit.object = index;
    if (hit.hit && o->moved) {
        hit.geometric = to_world(hit.geometric, &o->object_from_world);
        hit.shading = to_world(hit.shading, &o->object_from_world);
    }
    return hit;
}

Hit nearest(const Scene *scene, const Ray *ray) {
    Hit best = MISS;
    Ray left = *ray;
    for (int n = 0; n < scene->n_objects; n++) {
        Hit hit = meet(scene, n, &left);
        if (hit.hit) best = hit, left.t_max = hit.t;
    }
    return best;
}
