#include "tracer.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static real number(const Json *json) { return json ? (real)json->number : 0; }

Vec read_vec(const Json *json) {
    return vec(number(json_at(json, 0)), number(json_at(json, 1)), number(json_at(json, 2)));
}

static Vec vec_of(const Json *json, const char *key) { return read_vec(json_get(json, key)); }
static real real_of(const Json *json, const char *key) { return number(json_get(json, key)); }

Material read_material(const Json *json) {
    return (Material){
        .ke = vec_of(json, "ke"), .ka = vec_of(json, "ka"), .kd = vec_of(json, "kd"), .ks = vec_of(json, "ks"),
        .kt = vec_of(json, "kt"), .kr = vec_of(json, "kr"), .ns = real_of(json, "ns"), .index = real_of(json, "index"),
    };
}

Light read_light(const Json *json) {
    const Json *point = json_get(json, "point"), *light = point ? point : json_get(json, "directional");
    Light read = {.directional = !point, .colour = vec_of(light, "colour"), .ambient = vec_of(light, "ambient")};
    read.place = vec_of(light, point ? "position" : "direction");
    const Json *weak = json_get(light, "attenuation");
    read.quadratic = real_of(weak, "quadratic"), read.linear = real_of(weak, "linear");
    read.constant = real_of(weak, "constant");
    return read;
}

Affine read_affine(const Json *rows) {
    Affine read;
    real *columns[4] = {&read.columns[0].x, &read.columns[1].x, &read.columns[2].x, &read.shift.x};
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 3; row++) columns[column][row] = number(json_at(json_at(rows, row), column));
    return read;
}

static bool is_identity(const Affine *m) {
    const Affine one = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    return !memcmp(m, &one, sizeof one);
}

static Object read_object(const Json *json) {
    Object o = {.material = (int)number(json_get(json, "material"))};
    o.object_from_world = read_affine(json_get(json, "object_from_world"));
    o.moved = !is_identity(&o.object_from_world);
    const Json *one, *shape = json_get(json, "shape");
    if ((one = json_get(shape, "sphere"))) o.kind = SPHERE, o.a = vec_of(one, "center"), o.size = real_of(one, "radius");
    if ((one = json_get(shape, "plane"))) o.kind = PLANE, o.a = vec_of(one, "normal"), o.size = real_of(one, "k");
    if (json_get(shape, "square")) o.kind = SQUARE;
    if ((one = json_get(shape, "box"))) o.kind = BOX, o.a = vec_of(one, "min"), o.b = vec_of(one, "max");
    if ((one = json_get(shape, "cylinder"))) o.kind = CONE, o.size = o.size_2 = real_of(one, "radius");
    else if ((one = json_get(shape, "cone")))
        o.kind = CONE, o.size = real_of(one, "bottom_radius"), o.size_2 = real_of(one, "top_radius");
    if (o.kind == CONE) {
        o.from = real_of(one, "z_min"), o.to = real_of(one, "z_max");
        o.capped = json_get(one, "capped")->number != 0;
    }
    if ((one = json_get(shape, "mesh"))) o.kind = MESH, o.mesh = (int)real_of(one, "mesh");
    return o;
}

static Vec *read_vecs(const Json *list) {
    if (!list || list->kind != '[') return NULL;
    Vec *vecs = calloc(json_count(list) + 1, sizeof *vecs);
    int n = 0;
    for (const Json *one = list->first; one; one = one->next) vecs[n++] = read_vec(one);
    return vecs;
}

static Mesh read_mesh(const Json *json) {
    const Json *triangles = json_get(json, "triangles");
    Mesh mesh = {.n_triangles = (int)json_count(triangles)};
    mesh.vertices = read_vecs(json_get(json, "vertices")), mesh.normals = read_vecs(json_get(json, "normals"));
    mesh.triangles = calloc((size_t)mesh.n_triangles + 1, sizeof *mesh.triangles);
    int n = 0;
    for (const Json *one = triangles->first; one; one = one->next, n++)
        for (int corner = 0; corner < 3; corner++) mesh.triangles[n][corner] = (int)json_at(one, corner)->number;
    return mesh;
}

static bool lists(const Json *effects, const char *name) {
    for (const Json *one = effects->first; one; one = one->next)
        if (!strcmp(one->string, name)) return true;
    return false;
}

#define READ_ALL(list, items, n, read)                                                                                \
    do {                                                                                                              \
        const Json *all = (list);                                                                                     \
        items = calloc(json_count(all) + 1, sizeof *items);                                                           \
        n = 0;                                                                                                        \
        for (const Json *one = all->first; one; one = one->next) items[n++] = read(one);                              \
    } while (0)

Scene read_scene(const Json *json) {
    Scene s = {0};
    const Json *render = json_get(json, "render"), *camera = json_get(json, "camera"), *effects = json_get(json, "effects");
    s.width = (int)real_of(render, "width"), s.height = (int)real_of(render, "height");
    s.max_depth = (int)real_of(render, "max_depth"), s.threshold = real_of(render, "threshold");
    s.shadows = lists(effects, "shadows"), s.tinted = lists(effects, "tinted_shadows");
    s.reflection = lists(effects, "reflection"), s.refraction = lists(effects, "refraction");
    s.smooth = lists(effects, "smooth_normals"), s.adaptive = lists(effects, "adaptive_depth");
    s.eye = vec_of(camera, "eye"), s.right = vec_of(camera, "right"), s.up = vec_of(camera, "up");
    s.forward = vec_of(camera, "forward"), s.fov = real_of(camera, "fov_y_deg");
    s.background = vec_of(json, "background");
    int n;
    READ_ALL(json_get(json, "lights"), s.lights, s.n_lights, read_light);
    READ_ALL(json_get(json, "materials"), s.materials, n, read_material);
    READ_ALL(json_get(json, "meshes"), s.meshes, n, read_mesh);
    READ_ALL(json_get(json, "objects"), s.objects, s.n_objects, read_object);
    return s;
}

static uint8_t to_byte(real light) {
    real clamped = light < 0 ? 0 : light > 1 ? 1 : light;
    return (uint8_t)(clamped * 255);
}

static void big_endian(uint8_t *to, uint32_t number) {
    for (int n = 0; n < 4; n++) to[n] = (uint8_t)(number >> (24 - 8 * n));
}

/* A chunk of a PNG: length, name, data, checksum. */
static void chunk(FILE *file, const char *name, const uint8_t *data, uint32_t length) {
    uint8_t word[4];
    uint32_t crc = ~0u;
    for (uint32_t n = 0; n < length + 4; n++) {
        crc ^= n < 4 ? (uint8_t)name[n] : data[n - 4];
        for (int bit = 0; bit < 8; bit++) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    big_endian(word, length), fwrite(word, 1, 4, file);
    fwrite(name, 1, 4, file), fwrite(data, 1, length, file);
    big_endian(word, ~crc), fwrite(word, 1, 4, file);
}

/* Rows of a filter byte and RGB each, stored without compression. */
static bool write_png(const char *path, const uint8_t *rows, int width, int height) {
    uint32_t stride = 1 + 3 * (uint32_t)width, a = 1, b = 0, length = 2;
    uint8_t header[13] = {[8] = 8, [9] = 2}, *data = malloc((size_t)height * (stride + 5) + 6);
    big_endian(header, (uint32_t)width), big_endian(header + 4, (uint32_t)height);
    data[0] = 0x78, data[1] = 1;
    for (int j = 0; j < height; j++) {
        const uint8_t *row = rows + (size_t)j * stride;
        uint8_t block[5] = {j == height - 1, stride & 255, stride >> 8, ~stride & 255, ~stride >> 8 & 255};
        memcpy(data + length, block, 5), memcpy(data + length + 5, row, stride);
        length += stride + 5;
        for (uint32_t n = 0; n < stride; n++) a = (a + row[n]) % 65521, b = (b + a) % 65521;
    }
    big_endian(data + length, b << 16 | a);
    FILE *file = fopen(path, "wb");
    if (!file) return false;
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, file);
    chunk(file, "IHDR", header, 13), chunk(file, "IDAT", data, length + 4), chunk(file, "IEND", NULL, 0);
    return fclose(file) == 0;
}

static char *read_file(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) exit(2);
    fseek(file, 0, SEEK_END);
    long length = ftell(file);
    rewind(file);
    char *text = calloc((size_t)length + 1, 1);
    if (fread(text, 1, (size_t)length, file) != (size_t)length) exit(2);
    fclose(file);
    return text;
}

static int render(const char *from, const char *to) {
    Scene scene = read_scene(json_parse(read_file(from)));
    size_t stride = 1 + 3 * (size_t)scene.width;
    uint8_t *rows = calloc((size_t)scene.height, stride);
    for (int j = 0; j < scene.height; j++)
        for (int i = 0; i < scene.width; i++) {
            Vec light = trace(&scene, eye_ray(&scene, i, j), 0);
            uint8_t *pixel = rows + (size_t)j * stride + 1 + 3 * i;
            pixel[0] = to_byte(light.x), pixel[1] = to_byte(light.y), pixel[2] = to_byte(light.z);
        }
    return write_png(to, rows, scene.width, scene.height) ? 0 : 2;
}

int main(int argc, char **argv) {
    if (argc == 4 && !strcmp(argv[1], "render")) return render(argv[2], argv[3]);
    if (argc == 2 && !strcmp(argv[1], "probe")) return probe();
    return 2;
}
