// Traces rays with Embree 4 on one thread, and prints times and sizes as JSON.
//
//     embree default|robust|packets MESH.ply RAYS ANSWERS PASSES
//
// `packets` traces 16 rays at a time. RAYS is the file that the benchmark writes; ANSWERS becomes a float a ray: the distance, 0 for
// anything in the way of an any-hit ray, infinity for a miss. The wheel from which the library comes has no headers: what is used
// of its C interface is declared here.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

extern "C" {
typedef struct RTCDeviceTy *RTCDevice;
typedef struct RTCSceneTy *RTCScene;
typedef struct RTCGeometryTy *RTCGeometry;
typedef bool (*RTCMemoryMonitorFunction)(void *user, ptrdiff_t bytes, bool post);
RTCDevice rtcNewDevice(const char *config);
ptrdiff_t rtcGetDeviceProperty(RTCDevice, int property);
void rtcSetDeviceMemoryMonitorFunction(RTCDevice, RTCMemoryMonitorFunction, void *user);
RTCScene rtcNewScene(RTCDevice);
void rtcSetSceneFlags(RTCScene, int flags);
void rtcSetSceneBuildQuality(RTCScene, int quality);
RTCGeometry rtcNewGeometry(RTCDevice, int type);
void *rtcSetNewGeometryBuffer(RTCGeometry, int type, unsigned slot, int format, size_t stride, size_t count);
void rtcCommitGeometry(RTCGeometry);
unsigned rtcAttachGeometry(RTCScene, RTCGeometry);
void rtcCommitScene(RTCScene);
void rtcIntersect1(RTCScene, void *ray_hit, void *arguments);
void rtcOccluded1(RTCScene, void *ray, void *arguments);
void rtcIntersect16(const int *valid, RTCScene, void *ray_hit, void *arguments);
void rtcOccluded16(const int *valid, RTCScene, void *ray, void *arguments);
}

enum { PROPERTY_VERSION = 0, TRIANGLES = 0, INDEX = 0, VERTEX = 1, UINT3 = 0x5003, FLOAT3 = 0x9003, ROBUST = 1 << 2, MEDIUM = 1 };
const unsigned COHERENT = 1 << 16, NONE = ~0u;

// Room is left behind each hit for members that later versions add.
struct alignas(16) RayHit {
    float org[3], tnear, dir[3], time, tfar;
    unsigned mask, id, flags;
    float normal[3], u, v;
    unsigned prim, geom, more[6];
};
struct alignas(64) RayHit16 {
    float org[3][16], tnear[16], dir[3][16], time[16], tfar[16];
    unsigned mask[16], id[16], flags[16];
    float normal[3][16], u[16], v[16];
    unsigned prim[16], geom[16], more[6][16];
};
struct Arguments {
    unsigned flags, features;
    void *context, *filter, *intersect;
    void *more[4];
};

static double cpu_s() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static std::string all_of(const char *path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) { std::fprintf(stderr, "cannot read %s\n", path); std::exit(1); }
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Mesh {
    std::vector<float> vertices;
    std::vector<unsigned> corners;
};

// A PLY file as the benchmark writes it: vertices of floats, x, y and z first; then triangles.
static Mesh read_mesh(const char *path) {
    const std::string bytes = all_of(path);
    const std::string end = "end_header\n";
    const size_t body = bytes.find(end) + end.size();
    std::istringstream header(bytes.substr(0, body));
    size_t n_vertices = 0, n_faces = 0, n_floats = 0;
    for (std::string word; header >> word;) {
        if (word == "vertex") header >> n_vertices;
        if (word == "face") header >> n_faces;
        if (word == "float") n_floats++;
    }
    Mesh mesh;
    const char *at = bytes.data() + body;
    for (size_t i = 0; i < n_vertices; i++, at += 4 * n_floats) {
        float xyz[3];
        std::memcpy(xyz, at, 12);
        mesh.vertices.insert(mesh.vertices.end(), xyz, xyz + 3);
    }
    for (size_t i = 0; i < n_faces; i++, at += 13) {
        unsigned abc[3];
        std::memcpy(abc, at + 1, 12);
        mesh.corners.insert(mesh.corners.end(), abc, abc + 3);
    }
    return mesh;
}

struct Set {
    bool is_any_hit;
    std::vector<float> rays;
};

static std::vector<Set> read_rays(const char *path) {
    const std::string bytes = all_of(path);
    std::vector<Set> sets;
    for (size_t at = 0; at < bytes.size();) {
        uint32_t head[2];
        std::memcpy(head, &bytes[at], 8);
        Set set{head[0] == 1, std::vector<float>(7 * head[1])};
        std::memcpy(set.rays.data(), &bytes[at + 8], 28 * head[1]);
        at += 8 + 28 * head[1];
        sets.push_back(std::move(set));
    }
    return sets;
}

static void one_by_one(RTCScene scene, const Set &set, float *answers) {
    for (size_t i = 0; i < set.rays.size() / 7; i++) {
        const float *r = &set.rays[7 * i];
        RayHit ray = {{r[0], r[1], r[2]}, 0, {r[3], r[4], r[5]}, 0, r[6], ~0u, 0, 0, {}, 0, 0, NONE, NONE, {NONE, NONE, NONE, NONE, NONE, NONE}};
        if (set.is_any_hit) {
            rtcOccluded1(scene, &ray, nullptr);
            answers[i] = ray.tfar < 0 ? 0 : INFINITY;
        } else {
            rtcIntersect1(scene, &ray, nullptr);
            answers[i] = ray.geom == NONE ? INFINITY : ray.tfar;
        }
    }
}

/* The place of the i-th primary ray of a picture of 640 x 480 in packets of 4 x 4 pixels; of other rays their own. */
static size_t place(size_t i, bool is_coherent, size_t n) {
    if (!is_coherent || n != 640 * 480) return i;
    size_t block = i / 16, k = i % 16;
    return (block / 160 * 4 + k / 4) * 640 + block % 160 * 4 + k % 4;
}

static void by_packets(RTCScene scene, const Set &set, bool is_coherent, float *answers) {
    Arguments arguments = {};
    arguments.flags = is_coherent ? COHERENT : 0;
    arguments.features = ~0u;
    const size_t n = set.rays.size() / 7;
    for (size_t first = 0; first < n; first += 16) {
        RayHit16 ray = {};
        int valid[16];
        for (size_t k = 0; k < 16; k++) {
            const float *r = &set.rays[7 * place(first + k < n ? first + k : first, is_coherent, n)];
            valid[k] = first + k < n ? -1 : 0;
            for (int axis = 0; axis < 3; axis++) { ray.org[axis][k] = r[axis]; ray.dir[axis][k] = r[3 + axis]; }
            ray.tfar[k] = r[6];
            ray.mask[k] = ~0u;
            ray.geom[k] = NONE;
        }
        if (set.is_any_hit) rtcOccluded16(valid, scene, &ray, &arguments);
        else rtcIntersect16(valid, scene, &ray, &arguments);
        for (size_t k = 0; k < 16 && first + k < n; k++) {
            float &answer = answers[place(first + k, is_coherent, n)];
            if (set.is_any_hit) answer = ray.tfar[k] < 0 ? 0 : INFINITY;
            else answer = ray.geom[k] == NONE ? INFINITY : ray.tfar[k];
        }
    }
}

static bool count_bytes(void *user, ptrdiff_t bytes, bool) {
    *static_cast<ptrdiff_t *>(user) += bytes;
    return true;
}

int main(int argc, char **argv) {
    if (argc != 6) { std::fprintf(stderr, "embree default|robust|packets MESH.ply RAYS ANSWERS PASSES\n"); return 2; }
    const std::string mode = argv[1];
    const Mesh mesh = read_mesh(argv[2]);
    const std::vector<Set> sets = read_rays(argv[3]);
    RTCDevice device = rtcNewDevice("threads=1");
    ptrdiff_t bytes = 0;
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, &bytes);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, mode == "robust" ? ROBUST : 0);
    rtcSetSceneBuildQuality(scene, MEDIUM);
    RTCGeometry geometry = rtcNewGeometry(device, TRIANGLES);
    const size_t n_vertices = mesh.vertices.size() / 3, n_faces = mesh.corners.size() / 3;
    void *to = rtcSetNewGeometryBuffer(geometry, VERTEX, 0, FLOAT3, 12, n_vertices);
    std::memcpy(to, mesh.vertices.data(), 12 * n_vertices);
    to = rtcSetNewGeometryBuffer(geometry, INDEX, 0, UINT3, 12, n_faces);
    std::memcpy(to, mesh.corners.data(), 12 * n_faces);
    const double begun = cpu_s();
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    const double build_s = cpu_s() - begun;
    std::ofstream answers_file(argv[4], std::ios::binary);
    const long version = rtcGetDeviceProperty(device, PROPERTY_VERSION);
    std::printf("{\"version\": \"%ld.%ld.%ld\", \"build_s\": %.6f, \"bytes\": %td, \"seconds\": [", version / 10000, version / 100 % 100,
                version % 100, build_s, bytes);
    for (size_t s = 0; s < sets.size(); s++) {
        std::vector<float> answers(sets[s].rays.size() / 7);
        std::printf("%s[", s ? ", " : "");
        for (int pass = -1; pass < std::atoi(argv[5]); pass++) {
            const double start = cpu_s();
            if (mode == "packets") by_packets(scene, sets[s], s == 0, answers.data());
            else one_by_one(scene, sets[s], answers.data());
            const double took = cpu_s() - start;
            if (pass >= 0) std::printf("%s%.6f", pass ? ", " : "", took); // the first warms up
        }
        std::printf("]");
        answers_file.write(reinterpret_cast<const char *>(answers.data()), 4 * answers.size());
    }
    std::printf("]}\n");
    return 0;
}
