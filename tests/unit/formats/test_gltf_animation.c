/* Tests the poses of animations of glTF files: curves, times, targets and refusals. */
#include "base/run.h"
#include "scene/camera/view_set.h"
#include "support/tests.h"
#include "unit/common/input_check.h"
#include "unit/common/kept_check.h"
#include "unit/common/same_scene.h"

/* Bytes of the part "b". */
static struct {
    float corners[3][3];   /* at 0 */
    float times[3];        /* at 36: 1, 2 and 4 seconds */
    float moves[3][3];     /* at 48 */
    int16_t turns[3][4];   /* at 84: no turn, a quarter and a half turn around z */
    float cubic[2][3][3];  /* at 108: two keys */
    uint8_t weights[3][2]; /* at 180 */
    uint16_t unused;
    float falling[2]; /* at 188 */
} numbers = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
             {1, 2, 4},
             {{0, 0, 0}, {10, 0, 2}, {20, 0, 0}},
             {{0, 0, 0, 32767}, {0, 0, 23170, 23170}, {0, 0, -32767, 0}},
             {{{9, 9, 9}, {0, 0, 0}, {8, 0, 0}}, {{0, 4, 0}, {1, 1, 1}, {9, 9, 9}}},
             {{0, 0}, {255, 0}, {0, 51}},
             0,
             {2, 1}};

#define VIEW(at, bytes) "{\"buffer\":0,\"byteOffset\":" #at ",\"byteLength\":" #bytes "}"
#define ACCESSOR(view, type, count, shape)                                                                             \
    "{\"bufferView\":" #view ",\"componentType\":" #type ",\"count\":" #count ",\"type\":\"" shape "\""
/* clang-format off */
#define HEAD                                                                                                           \
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":196,\"uri\":\"b\"}],\"bufferViews\":["              \
    VIEW(0, 36) "," VIEW(36, 12) "," VIEW(48, 36) "," VIEW(84, 24) "," VIEW(108, 72) "," VIEW(180, 6) "," VIEW(188, 8) \
    "],\"accessors\":["                                                                                                \
    ACCESSOR(0, 5126, 3, "VEC3") "}," ACCESSOR(1, 5126, 3, "SCALAR") "}," ACCESSOR(2, 5126, 3, "VEC3") "},"            \
    ACCESSOR(3, 5122, 3, "VEC4") ",\"normalized\":true}," ACCESSOR(4, 5126, 6, "VEC3") "},"                            \
    ACCESSOR(5, 5121, 6, "SCALAR") ",\"normalized\":true}," ACCESSOR(1, 5126, 2, "SCALAR") "},"                        \
    ACCESSOR(6, 5126, 2, "SCALAR") "}," ACCESSOR(2, 5126, 2, "VEC3") "}]"
/* clang-format on */
#define MESHES                                                                                                         \
    ",\"meshes\":[{\"weights\":[1],\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":0},"    \
    "{\"POSITION\":2}]}]}]"
#define NODES                                                                                                          \
    ",\"nodes\":[{\"mesh\":0,\"translation\":[3,3,3]},{\"mesh\":0},{\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]"
#define ANIMATION(name, sampler, target)                                                                               \
    "{\"name\":\"" name "\",\"samplers\":[{" sampler "}],\"channels\":[{\"sampler\":0,\"target\":{" target "}}]}"
#define ON(node, path)   "\"node\":" #node ",\"path\":\"" path "\""
#define ANIMATIONS(list) HEAD MESHES NODES ",\"animations\":[" list "]}"

/* clang-format off */
static const char text[] = ANIMATIONS(
    ANIMATION("move", "\"input\":1,\"output\":2", ON(0, "translation")) ","
    ANIMATION("step", "\"input\":1,\"output\":2,\"interpolation\":\"STEP\"", ON(0, "translation")) ","
    ANIMATION("turn", "\"input\":1,\"output\":3", ON(0, "rotation")) ","
    ANIMATION("grow", "\"input\":6,\"output\":4,\"interpolation\":\"CUBICSPLINE\"", ON(0, "scale")) ","
    ANIMATION("melt", "\"input\":1,\"output\":5", ON(0, "weights")) ","
    ANIMATION("", "\"input\":1,\"output\":2", "\"path\":\"pointer\""));
/* clang-format on */

static struct zr_asset parts[] = {{.name = "b", .bytes = &numbers, .size = sizeof numbers}};

static struct reading *read_over(struct zr_request request, const char *of)
{
    return read_with_part(ZR_FORMAT_GLTF, request, parts, of);
}

TEST(a_node_has_the_pose_of_the_time)
{
    static const float right = 0.70710678f;
    static const struct {
        const char *name, *time;
        int at; /* index in the matrix */
        float wanted;
    } cases[] = {
        {"move", NULL, 12, 0},      {"move", "1.5", 12, 5},    {"move", "1.5", 14, 1},    {"move", "2", 12, 10},
        {"move", "2.5", 12, 12.5f}, {"move", "4", 12, 20},     {"move", "99", 12, 20},    {"0", "3", 12, 15},
        {NULL, "3", 12, 15},        {"step", "1.99", 12, 0},   {"step", "2", 12, 10},     {"step", "9", 12, 20},
        {"turn", "0", 0, 1},        {"turn", "1.5", 0, right}, {"turn", "1.5", 1, right}, {"turn", "2", 1, 1},
        {"turn", "3", 0, -right},   {"turn", "3", 1, right},   {"turn", "4", 0, -1},      {"turn", "2", 12, 3},
        {"grow", "0", 0, 0},        {"grow", "1.5", 0, 1.5f},  {"grow", "1.5", 5, 0},     {"grow", "1.5", 10, 0.5f},
        {"grow", "2", 0, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading =
            read_over((struct zr_request){.animation = cases[i].name, .time = cases[i].time}, text);
        assert_read(reading);
        assert_int_equal(reading->scene->warning_count, 0);
        const float found = reading->scene->instances[0].object_to_world.m[cases[i].at];
        if (!(fabsf(found - cases[i].wanted) < 1e-4f))
            fail_msg("%s at %s: m[%d] is %g", cases[i].name ? cases[i].name : "the first",
                     cases[i].time ? cases[i].time : "0", cases[i].at, (double)found);
        reading_free(reading);
    }
}

TEST(weights_of_an_animation_belong_to_its_node)
{
    static const struct {
        const char *time;
        float x, z;
    } cases[] = {{"1", 1, 0}, {"2", 2, 0}, {"1.5", 1.5f, 0}, {"4", 3, 0.4f}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_over((struct zr_request){.animation = "melt", .time = cases[i].time}, text);
        assert_read(reading);
        const struct zr_scene *scene = reading->scene;
        assert_int_equal(scene->mesh_count, 2);
        const zr_vec4 moved = scene->meshes[scene->instances[0].mesh].positions[1],
                      other = scene->meshes[scene->instances[1].mesh].positions[1];
        if (!(fabsf(moved.x - cases[i].x) < 1e-5f && fabsf(moved.z - cases[i].z) < 1e-5f))
            fail_msg("at %s: %g %g", cases[i].time, (double)moved.x, (double)moved.z);
        assert_true(other.x == 2.0f);
        reading_free(reading);
    }
}

TEST(without_the_parameters_the_file_has_its_pose)
{
    struct reading *reading = read_over((struct zr_request){.color = NULL}, text);
    assert_read(reading);
    assert_true(reading->scene->instances[0].object_to_world.m[12] == 3.0f);
    assert_int_equal(reading->scene->warning_count, 1);
    assert_string_equal(reading->scene->warnings[0], "left out: animations of the file");
    reading_free(reading);
}

TEST(what_an_animation_cannot_move_is_warned_of)
{
    static const struct {
        const char *name, *of, *warning;
    } cases[] = {{"5", text, "/animations/5/channels/0: targets a property that is not read"},
                 {NULL, HEAD MESHES NODES "}", "the parameter time has no effect: the file has no animations"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_over((struct zr_request){.animation = cases[i].name, .time = "1"}, cases[i].of);
        assert_read(reading);
        assert_int_equal(reading->scene->warning_count, 1);
        assert_string_equal(reading->scene->warnings[0], cases[i].warning);
        reading_free(reading);
    }
}

TEST(wrong_animations_are_refused)
{
    static const struct {
        const char *name, *of, *pointer, *detail;
    } cases[] = {
        {"6", text, "", "parameter animation: the file has no animation '6'; its animations: 'move', 'step', 'turn'"},
        {"a", HEAD MESHES NODES "}", "", "parameter animation: the file has no animations"},
        {"0", ANIMATIONS(ANIMATION("", "\"input\":7,\"output\":8", ON(0, "scale"))), "/animations/0/samplers/0/input",
         "key 1 is at 1 seconds, before the key at 2"},
        {"0", ANIMATIONS(ANIMATION("", "\"input\":2,\"output\":2", ON(0, "scale"))), "/animations/0/samplers/0/input",
         "accessor 2 has no times"},
        {"0", ANIMATIONS(ANIMATION("", "\"input\":1,\"output\":3", ON(0, "scale"))), "/animations/0/samplers/0/output",
         "accessor 3 does not fit 3 keys"},
        {"0", ANIMATIONS(ANIMATION("", "\"input\":1,\"output\":4", ON(0, "scale"))), "/animations/0/samplers/0/output",
         "accessor 4 does not fit 3 keys: it has 6 elements of 3 numbers"},
        {"0", ANIMATIONS(ANIMATION("", "\"input\":1,\"output\":2", ON(2, "scale"))), "/animations/0/channels/0/target",
         "node 2 has a matrix"},
        {"0", ANIMATIONS(ANIMATION("", "\"input\":1,\"output\":2", ON(3, "scale"))),
         "/animations/0/channels/0/target/node", "index 3 of 3 nodes"},
        {"0", ANIMATIONS(ANIMATION("", "\"input\":1", ON(0, "scale"))), "/animations/0/samplers/0",
         "output is missing"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_over((struct zr_request){.animation = cases[i].name}, cases[i].of);
        assert_complaint(reading, ZR_BAD_SCENE, cases[i].pointer, cases[i].detail);
        reading_free(reading);
    }
    struct reading *reading = read_over((struct zr_request){.time = "-1"}, text);
    assert_complaint(reading, ZR_BAD_REQUEST, "", "parameter time: '-1' is not a number of seconds from 0 to 1e+06");
    reading_free(reading);
}

TEST(a_kept_file_keeps_its_pose)
{
    const struct zr_request request = {.format = ZR_FORMAT_GLTF, .assets = parts, .asset_count = 1, .time = "2"};
    struct keeping *keeping = keep(request, text, sizeof text - 1);
    assert_int_equal(keeping_change(keeping, (struct zr_request){.bytes = "", .time = "1"}), ZR_BAD_REQUEST);
    assert_int_equal(keeping_change(keeping, (struct zr_request){.bytes = "", .look = "clay"}), ZR_OK);
    assert_true(keeping->scene->instances[0].object_to_world.m[12] == 10.0f);
    keeping_free(keeping);
}

/* ---- frames ---- */

static const struct zr_view_set *set_of(const struct keeping *keeping)
{
    return zr_kept_scene(keeping->kept)->view_set;
}

/* A frame is the file at its time, even once the request's body is freed. */
TEST(a_frame_equals_the_file_at_its_time)
{
    static const struct {
        const char *name, *time, *end;
        const char *times[3];
        double seconds;
    } cases[] = {{"move", NULL, NULL, {"0", "1.333333", "2.666667"}, 4},
                 {"melt", "1", "2.5", {"1", "1.5", "2"}, 1.5},
                 {"turn", "0.5", NULL, {"0.5", "1.666667", "2.833333"}, 3.5},
                 {NULL, "3", "9", {"3", "5", "7"}, 6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_request request = {.format = ZR_FORMAT_GLTF,
                                           .assets = parts,
                                           .asset_count = 1,
                                           .animation = cases[i].name,
                                           .time = cases[i].time,
                                           .timeEnd = cases[i].end,
                                           .frames = "3"};
        struct keeping *keeping = keep(request, text, sizeof text - 1);
        assert_int_equal(set_of(keeping)->count, 3);
        assert_true(set_of(keeping)->seconds == cases[i].seconds);
        for (uint32_t k = 0; k < 3; k++) {
            const struct zr_scene *frame;
            struct zr_error error = {0};
            struct reading *alone =
                read_over((struct zr_request){.animation = cases[i].name, .time = cases[i].times[k]}, text);
            assert_read(alone);
            zr_arena_reset(&keeping->other, 0);
            assert_int_equal(
                zr_scene_frame(&(struct zr_run){.arena = &keeping->other, .error = &error}, keeping->kept, k, &frame),
                ZR_OK);
            assert_same_scene(frame, alone->scene);
            assert_int_equal(frame->instance_count, alone->scene->instance_count);
            for (uint32_t n = 0; n < frame->instance_count; n++)
                assert_memory_equal(&frame->instances[n].object_to_world, &alone->scene->instances[n].object_to_world,
                                    sizeof(zr_mat4));
            reading_free(alone);
        }
        keeping_free(keeping);
    }
}

TEST(wrong_frames_are_refused)
{
    static const struct {
        const char *of;
        struct zr_request request;
        enum zr_status status;
        const char *detail;
    } cases[] = {
        {text, {.frames = "0"}, ZR_BAD_REQUEST, "parameter frames: '0' is not a whole number from 1 to 4096"},
        {text, {.frames = "-1"}, ZR_BAD_REQUEST, "parameter frames: '-1' is not a whole number"},
        {text,
         {.frames = "2", .time = "4"},
         ZR_BAD_SCENE,
         "parameter frames: an animation without duration: from 4 to 4 seconds"},
        {text,
         {.frames = "2", .time = "1", .timeEnd = "0.5"},
         ZR_BAD_SCENE,
         "parameter timeEnd: an animation without duration: from 1 to 0.5 seconds"},
        {text, {.timeEnd = "2"}, ZR_BAD_SCENE, "parameter timeEnd: needs the parameter frames"},
        {text,
         {.frames = "2", .turntable = "3"},
         ZR_BAD_SCENE,
         "parameter frames: a scene has one of views, turntable"},
        {text, {.frames = "2", .animation = "none"}, ZR_BAD_SCENE, "the file has no animation 'none'"},
        {HEAD MESHES NODES "}", {.frames = "2"}, ZR_BAD_SCENE, "parameter frames: the file has no animations"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_over(cases[i].request, cases[i].of);
        assert_complaint(reading, cases[i].status, "", cases[i].detail);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
