/* Meshes whose middle is many of their sizes from the origin: it is taken off in double, in every format. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/input/zip_file.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

/* A tetrahedron of corners that doubles have and floats far from 0 have not. */
static double corners[4][3] = {{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {0.1, 1.2, 0.3}, {0.1, 0.2, 1.3}};
static const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

static char text[1 << 13];
static size_t size;

static void put_text(const char *words)
{
    size += (size_t)snprintf(text + size, sizeof text - size, "%s", words);
}

static void put_corner(const char *form, int corner, const double by[3])
{
    size += (size_t)snprintf(text + size, sizeof text - size, form, corners[corner][0] + by[0],
                             corners[corner][1] + by[1], corners[corner][2] + by[2]);
}

static void put_face(const char *form, int face, int first)
{
    size += (size_t)snprintf(text + size, sizeof text - size, form, first + faces[face][0], first + faces[face][1],
                             first + faces[face][2]);
}

static void write_obj(const double by[3])
{
    for (int i = 0; i < 4; i++)
        put_corner("v %.17g %.17g %.17g\n", i, by);
    for (int i = 0; i < 4; i++)
        put_face("f %d %d %d\n", i, 1);
}

static void write_stl(const double by[3])
{
    put_text("solid t\n");
    for (int i = 0; i < 4; i++) {
        put_text("facet normal 0 0 0\nouter loop\n");
        for (int k = 0; k < 3; k++)
            put_corner("vertex %.17g %.17g %.17g\n", faces[i][k], by);
        put_text("endloop\nendfacet\n");
    }
    put_text("endsolid t\n");
}

static void write_xyz(const double by[3])
{
    for (int i = 0; i < 4; i++)
        put_corner("%.17g %.17g %.17g\n", i, by);
}

static void put_faces(void)
{
    for (int i = 0; i < 4; i++)
        put_face("3 %d %d %d\n", i, 0);
}

static void write_ply_head(const char *form)
{
    put_text("ply\nformat ");
    put_text(form);
    put_text(" 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 4\n"
             "property list uchar int vertex_indices\nend_header\n");
}

static void write_ply(const double by[3])
{
    write_ply_head("ascii");
    write_xyz(by);
    put_faces();
}

static void write_binary_ply(const double by[3])
{
    write_ply_head("binary_little_endian");
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            const double at = corners[i][k] + by[k];
            memcpy(text + size, &at, sizeof at);
            size += sizeof at;
        }
    for (int i = 0; i < 4; i++) {
        text[size++] = 3;
        memcpy(text + size, faces[i], sizeof faces[i]);
        size += sizeof faces[i];
    }
}

static void write_off(const double by[3])
{
    put_text("OFF\n4 4 0\n");
    write_xyz(by);
    put_faces();
}

static void write_pcd(const double by[3])
{
    put_text("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\n"
             "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\n");
    write_xyz(by);
}

/* `place`: of the mesh; `by`: of the item of the build. */
static void put_3mf(const double place[3], const double by[3])
{
    put_text("<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><object id=\"1\">"
             "<mesh><vertices>");
    for (int i = 0; i < 4; i++)
        put_corner("<vertex x=\"%.17g\" y=\"%.17g\" z=\"%.17g\"/>", i, place);
    put_text("</vertices><triangles>");
    for (int i = 0; i < 4; i++)
        put_face("<triangle v1=\"%d\" v2=\"%d\" v3=\"%d\"/>", i, 0);
    put_text("</triangles></mesh></object></resources><build><item objectid=\"1\" transform=\"");
    size +=
        (size_t)snprintf(text + size, sizeof text - size, "1 0 0 0 1 0 0 0 1 %.17g %.17g %.17g", by[0], by[1], by[2]);
    put_text("\"/></build></model>");
}

static void write_3mf(const double by[3])
{
    put_3mf(by, (const double[3]){0, 0, 0});
}

static void write_3mf_item(const double by[3])
{
    put_3mf((const double[3]){0, 0, 0}, by);
}

static void put_json(const char *nodes, const double by[3])
{
    put_text("{\"meshes\": [{\"positions\": [");
    for (int i = 0; i < 4; i++)
        put_corner(i > 0 ? ", [%.17g, %.17g, %.17g]" : "[%.17g, %.17g, %.17g]", i, by);
    put_text("], \"faces\": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}]");
    put_text(nodes);
}

static void write_json(const double by[3])
{
    put_json("}", by);
}

/* The node turns the mesh, so that the numbers of the matrix count, too. */
static void write_node(const double by[3])
{
    const double near[3] = {0, 0, 0};
    put_json(", \"nodes\": [{\"mesh\": 0, \"rotation\": [0.5, 0.5, 0.5, 0.5], \"translation\": [", near);
    size += (size_t)snprintf(text + size, sizeof text - size, "%.17g, %.17g, %.17g]}]}", by[0], by[1], by[2]);
}

/* Both are far. */
static void write_far_node(const double by[3])
{
    put_json(", \"nodes\": [{\"mesh\": 0, \"scale\": [0.5, 0.5, 0.5], \"translation\": [", by);
    size += (size_t)snprintf(text + size, sizeof text - size, "%.17g, %.17g, %.17g]}]}", -0.25 * by[0], -0.25 * by[1],
                             -0.25 * by[2]);
}

/* The node is far, and has the digits. */
static void put_gltf(const char *form, const double by[3])
{
    put_text("{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{");
    put_corner(form, 0, by);
    put_text("]}], \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}}]}], \"accessors\": "
             "[{\"bufferView\": 0, "
             "\"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\", \"min\": [0, 0, 0], \"max\": [1, 1, 0]}], "
             "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}], \"buffers\": [{\"byteLength\": 36, \"uri\": "
             "\"data:;base64,"
             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
}

static void write_gltf(const double by[3])
{
    put_gltf("\"mesh\": 0, \"translation\": [%.17g, %.17g, %.17g", by);
}

/* A matrix below a node that turns it back, as exporters turn z up. */
static void write_gltf_matrix(const double by[3])
{
    put_gltf("\"children\": [1], \"rotation\": [-0.70710678118654757, 0, 0, 0.70710678118654757]}, {\"mesh\": 0, "
             "\"matrix\": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, %.17g, %.17g, %.17g, 1",
             by);
}

static const struct {
    const char *name;
    enum zr_format format;
    void (*write)(const double by[3]);
} formats[] = {{"OBJ", ZR_FORMAT_OBJ, write_obj},
               {"STL", ZR_FORMAT_STL, write_stl},
               {"PLY", ZR_FORMAT_PLY, write_ply},
               {"binary PLY", ZR_FORMAT_PLY, write_binary_ply},
               {"OFF", ZR_FORMAT_OFF, write_off},
               {"PCD", ZR_FORMAT_PCD, write_pcd},
               {"XYZ", ZR_FORMAT_XYZ, write_xyz},
               {"3MF", ZR_FORMAT_3MF, write_3mf},
               {"3MF with an item", ZR_FORMAT_3MF, write_3mf_item},
               {"glTF", ZR_FORMAT_GLTF, write_gltf},
               {"glTF with a matrix", ZR_FORMAT_GLTF, write_gltf_matrix},
               {"JSON", ZR_FORMAT_JSON, write_json},
               {"JSON with a node", ZR_FORMAT_JSON, write_node},
               {"JSON with a far node", ZR_FORMAT_JSON, write_far_node}};
enum { FORMATS = sizeof formats / sizeof *formats };

static struct reading *read_at(size_t format, const double by[3])
{
    size = 0;
    formats[format].write(by);
    assert_true(size < sizeof text);
    const struct zip_entry part = {"3D/3dmodel.model", text, size, true};
    unsigned char *package = formats[format].format == ZR_FORMAT_3MF ? zip_3mf(&part, 1, &size) : NULL;
    struct reading *reading = read_bytes(formats[format].format, package ? (const char *)package : text, size);
    free(package);
    if (reading->status != ZR_OK) fail_msg("%s: %s", formats[format].name, reading->error.items[0].detail);
    return reading;
}

/* Returns a corner relative to another one, in world space. */
static zr_vec4 side_of(const struct zr_scene *scene, uint32_t from, uint32_t to)
{
    const struct zr_instance *instance = &scene->instances[0];
    const zr_vec4 *p = scene->meshes[instance->mesh].positions;
    const zr_vec4 a = zr_mat4_apply(&instance->object_to_world, p[from]),
                  b = zr_mat4_apply(&instance->object_to_world, p[to]);
    return (zr_vec4){b.x - a.x, b.y - a.y, b.z - a.z, 0};
}

/* A vertex that is not finite does not hide that a mesh is far, whether or not a face names it. */
TEST(far_meshes_with_holes_are_moved)
{
    static const struct {
        enum zr_format format;
        const char *text;
    } cases[] = {
        {ZR_FORMAT_PLY, "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
                        "property double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                        "500000 500000 0\n500002 500000 0\n500000 500002 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n"},
        {ZR_FORMAT_OBJ, "v 500000 500000 0\nv 500002 500000 0\nv 500000 500002 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n"},
        {ZR_FORMAT_STL, "solid\nfacet normal 0 0 0 outer loop vertex 500000 500000 0 vertex 500002 500000 0\n"
                        "vertex 500000 500002 0 endloop endfacet\nfacet normal 0 0 0 outer loop\n"
                        "vertex nan 0 0 vertex 0 0 0 vertex 1 0 0 endloop endfacet\nendsolid\n"},
        {ZR_FORMAT_OFF, "OFF\n4 2 0\n500000 500000 0\n500002 500000 0\n500000 500002 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_text(cases[i].format, cases[i].text);
        assert_origin(reading, 500001, 500001, 0);
        assert_true(reading->scene->meshes[0].positions[1].x == 1.0f);
        assert_int_equal(reading->scene->meshes[0].face_count, 1);
        reading_free(reading);
    }
}

TEST(remote_meshes_keep_their_digits)
{
    static const double far[][3] = {{5000, 0, 0}, {0, -1e5, 3}, {408205, 580925, 5}, {9e5, 9e5, -9e5}};
    for (size_t f = 0; f < FORMATS; f++) {
        struct reading *near = read_at(f, (const double[3]){0, 0, 0});
        assert_null(near->scene->origin);
        for (size_t i = 0; i < sizeof far / sizeof *far; i++) {
            struct reading *reading = read_at(f, far[i]);
            const double *origin = reading->scene->origin;
            if (!origin) fail_msg("%s, %zu: no origin", formats[f].name, i);
            for (uint32_t k = 0; k < 3; k++) {
                const zr_vec4 own = side_of(reading->scene, k, (k + 1) % 3),
                              want = side_of(near->scene, k, (k + 1) % 3);
                if (fabsf(own.x - want.x) > 1e-6f || fabsf(own.y - want.y) > 1e-6f || fabsf(own.z - want.z) > 1e-6f)
                    fail_msg("%s, %zu: %.9g %.9g %.9g", formats[f].name, i, (double)own.x, (double)own.y,
                             (double)own.z);
            }
            reading_free(reading);
        }
        reading_free(near);
    }
}

/* The same in object space. */
static zr_vec4 own_side_of(const struct zr_scene *scene, uint32_t from, uint32_t to)
{
    const zr_vec4 *p = scene->meshes[0].positions;
    return (zr_vec4){p[to].x - p[from].x, p[to].y - p[from].y, p[to].z - p[from].z, 0};
}

static double random_within(double low, double high)
{
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * ((double)(state >> 11) / 9007199254740992.0);
}

static double side_in_doubles(int from, int to, int axis)
{
    return corners[to][axis] - corners[from][axis];
}

/* FAR_MESHES: how many. */
TEST(random_far_meshes_are_those_of_doubles)
{
    const char *wanted = getenv("FAR_MESHES");
    const long count = wanted ? strtol(wanted, NULL, 10) : 300;
    double worst = 0.0;
    for (long i = 0; i < count; i++) {
        const size_t f = (size_t)i % FORMATS;
        const double unit = pow(10.0, random_within(-1.5, 2.0));
        double by[3];
        for (int k = 0; k < 4; k++)
            for (int axis = 0; axis < 3; axis++)
                corners[k][axis] = random_within(-unit, unit);
        for (int axis = 0; axis < 3; axis++)
            by[axis] = random_within(-1, 1) * 4e5;
        by[i % 3] = (i & 1 ? -1.0 : 1.0) * fmax(6e3 * fmax(unit, 1.0), random_within(0, 8e5));
        struct reading *reading = read_at(f, by);
        if (!reading->scene->origin) fail_msg("%s, mesh %ld: no origin", formats[f].name, i);
        for (int k = 0; k < 3 && formats[f].format != ZR_FORMAT_GLTF; k++) {
            const double scale = formats[f].write == write_far_node ? 0.5 : 1.0;
            const int turn = formats[f].write == write_node;          /* x, y, z becomes z, x, y */
            const bool is_json = formats[f].format == ZR_FORMAT_JSON; /* others may be turned upright */
            const zr_vec4 own =
                is_json ? side_of(reading->scene, 0, (uint32_t)k + 1) : own_side_of(reading->scene, 0, (uint32_t)k + 1);
            const float at[3] = {own.x, own.y, own.z};
            const bool is_stl = formats[f].format == ZR_FORMAT_STL; /* corners of its first face: 0, 2, 1 */
            for (int axis = 0; axis < 3 && (!is_stl || k < 2); axis++) {
                const int to = is_stl ? 2 - k : k + 1;
                const double want = scale * side_in_doubles(0, to, turn ? (axis + 2) % 3 : axis);
                worst = fmax(worst, fabs((double)at[axis] - want) / (scale * unit));
                if (fabs((double)at[axis] - want) > 1e-6 * scale * unit)
                    fail_msg("%s, mesh %ld, side %d: %.9g, not %.9g", formats[f].name, i, k, (double)at[axis], want);
            }
        }
        reading_free(reading);
    }
    if (wanted) print_message("%ld far meshes: at most %.3g of their size\n", count, worst);
    memcpy(corners, (const double[4][3]){{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {0.1, 1.2, 0.3}, {0.1, 0.2, 1.3}},
           sizeof corners);
}

/* Places of a scene are moved with it, in doubles, from the numbers of the text. */
TEST(places_of_a_far_scene_are_moved_in_doubles)
{
#define FAR_SCENE(view)                                                                                                \
    "{\"meshes\": [{\"positions\": [[500000,0,0],[500001,0,0],[500000,1,0]], \"faces\": [[0,1,2]]}], \"view\": {" view \
    "}, \"lights\": [{\"type\": \"point\", \"position\": [500000.123, 1, 2]}, {\"type\": \"point\", \"frame\": "       \
    "\"camera\", \"position\": [1, 2, 3]}], \"sections\": {\"planes\": [{\"axis\": \"x\", \"offset\": 500000.321}, "   \
    "{\"point\": [500000.4567, 0, 0], \"normal\": [1, 1, 0]}]}}"
    struct reading *reading =
        read_text(ZR_FORMAT_JSON, FAR_SCENE("\"eye\": [500000.0123, 0.5, 4], \"target\": [500000.25, 0.5, 0]"));
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    const double *o = scene->origin;
    assert_non_null(o);
    assert_true(scene->adds_origin);
    assert_true(fabs((double)scene->views[0].eye.x + o[0] - 500000.0123) < 1e-7);
    assert_true(fabs((double)scene->views[0].target.x + o[0] - 500000.25) < 1e-7);
    assert_true(fabs((double)scene->lights[0].position.x + o[0] - 500000.123) < 1e-7);
    assert_true(scene->lights[1].position.x == 1.0f);
    assert_true(fabs(scene->sections.planes[0].point[0] + o[0] - 500000.321) < 1e-7);
    assert_true(fabs(scene->sections.planes[1].point[0] + o[0] - 500000.4567) < 1e-7);
    reading_free(reading);
    reading = read_text(ZR_FORMAT_JSON, FAR_SCENE("\"R\": [1,0,0,0,1,0,0,0,1], \"t\": [-500000.0123, 0.5, 4]"));
    assert_read(reading);
    o = reading->scene->origin;
    assert_true(fabs((double)reading->scene->views[0].world_to_camera.m[12] - (o[0] - 500000.0123)) < 1e-7);
    reading_free(reading);
    reading = read_text(ZR_FORMAT_JSON, FAR_SCENE("\"cameraToWorld\": [1,0,0,0,0,1,0,0,0,0,1,0,500000.0123,0.5,4,1]"));
    assert_read(reading);
    o = reading->scene->origin;
    assert_true(fabs((double)reading->scene->views[0].world_to_camera.m[12] - (o[0] - 500000.0123)) < 1e-7);
    reading_free(reading);
#undef FAR_SCENE
}

#define NEAR_LIST "{\"positions\": [[0,0,0],[1,0,0],[0,1,0]], \"faces\": [[0,1,2]]}"
#define FAR_LIST  "{\"positions\": [[500000.1,0.2,0],[500001.1,0.2,0],[500000.1,1.2,0]], \"faces\": [[0,1,2]]}"

/* Checks the sides of the last instance, which are 1, and the origin of the scene. */
static void assert_digits(const char *scene_text, double origin)
{
    struct reading *reading = read_text(ZR_FORMAT_JSON, scene_text);
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    const struct zr_instance *last = &scene->instances[scene->instance_count - 1];
    const zr_vec4 *p = scene->meshes[last->mesh].positions, a = zr_mat4_apply(&last->object_to_world, p[0]),
                  b = zr_mat4_apply(&last->object_to_world, p[1]);
    const double found = scene->origin ? scene->origin[0] : 0.0;
    if (fabs(found - origin) > 1.0) fail_msg("%s: origin %.9g, not %.9g", scene_text, found, origin);
    if (fabsf(b.x - a.x - 1.0f) > 1e-6f) fail_msg("%s: %.9g, not 1", scene_text, (double)(b.x - a.x));
    reading_free(reading);
}

TEST(a_far_list_that_a_node_brings_back_keeps_its_digits)
{
    assert_digits("{\"meshes\": [" NEAR_LIST "," FAR_LIST
                  "], \"nodes\": [{\"mesh\": 0}, {\"mesh\": 1, \"translation\": "
                  "[-500000.1, 0, 0]}]}",
                  0.0);
}

/* Columns are computed in doubles. */
TEST(grids_of_heights_far_from_the_origin_keep_their_steps)
{
    struct reading *reading =
        read_text(ZR_FORMAT_JSON, "{\"meshes\": [{\"heights\": {\"values\": [[0,1,0],[1,2,1]], "
                                  "\"x\": [500000.1, 500000.3], \"y\": [-300000.3, -300000.2]}}]}");
    assert_read(reading);
    const zr_vec4 *p = reading->scene->meshes[0].positions;
    assert_true(fabsf(p[1].x - p[0].x - 0.1f) < 1e-6f);
    assert_true(fabsf(p[3].y - p[0].y - 0.1f) < 1e-6f);
    reading_free(reading);
}

/* Cameras may be as far from the origin as files. */
TEST(an_eye_may_be_at_a_map_coordinate)
{
    static const char obj[] = "v 500000 5400000 0\nv 500001 5400000 0\nv 500001 5400001 0\nf 1 2 3\n";
    const struct zr_request request = {
        .format = ZR_FORMAT_OBJ, .eye = "500000.71,5400000.4,4", .target = "500000.51,5400000.4,0"};
    struct reading *reading = read_request(request, obj, strlen(obj), zr_limits_default(), 1 << 20);
    assert_read(reading);
    const zr_vec3 eye = reading->scene->views[0].eye;
    assert_true(fabsf(eye.x - 0.21f) < 1e-6f && fabsf(eye.y + 0.1f) < 1e-6f && eye.z == 4.0f);
    reading_free(reading);
    reading = read_text(
        ZR_FORMAT_JSON,
        "{\"meshes\": [{\"uri\": \"data:model/obj;base64,diA1MDAwMDAgNTQwMDAwMCAwCnYgNTAwMDAxIDU0MDAwMDAgMAp2IDUwMDAw"
        "MSA1NDAwMDAxIDAKZiAxIDIgMwo=\"}], \"view\": {\"eye\": [500000.71, 5400000.4, 4], \"target\": [500000.51, "
        "5400000.4, "
        "0]}, \"lights\": [{\"type\": \"point\", \"position\": [500000.25, 5400000.5, 9]}]}");
    assert_read(reading);
    const double *o = reading->scene->origin;
    assert_non_null(o);
    assert_true(fabs((double)reading->scene->views[0].eye.y + o[1] - 5400000.4) < 1e-6);
    assert_true(fabs((double)reading->scene->lights[0].position.x + o[0] - 500000.25) < 1e-6);
    reading_free(reading);
}

/* The rule is relative: a small mesh is remote at a distance at which a large one is not. */
TEST(meshes_near_their_size_keep_their_coordinates)
{
    static const struct {
        const char *text;
        bool has_origin;
    } cases[] = {{"v 900 0 0\nv 901 0 0\nv 900 1 0\nf 1 2 3\n", false},
                 {"v 1100 0 0\nv 1101 0 0\nv 1100 1 0\nf 1 2 3\n", true},
                 {"v 9 0 0\nv 9.001 0 0\nv 9 0.001 0\nf 1 2 3\n", true},
                 {"v 100000 0 0\nv 100500 0 0\nv 100000 500 0\nf 1 2 3\n", false},
                 {"v 900000 0 0\nv 900000 0 0\nv 900000 0 0\nf 1 2 3\n", false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_text(ZR_FORMAT_OBJ, cases[i].text);
        assert_int_equal(reading->status, ZR_OK);
        if ((reading->scene->origin != NULL) != cases[i].has_origin) fail_msg("case %zu", i);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
