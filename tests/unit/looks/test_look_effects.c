/* Values and small stages of looks: what they add to a picture. */
#include "base/run.h"
#include "scene/camera/extent_view.h"
#include "scene/looks.h"
#include "shade/frame.h"
#include "shade/models/xray.h"
#include "support/isas.h"
#include "support/tests.h"
#include "unit/common/json_check.h"
#include "unit/common/lit_samples.h"

static double decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static double encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

/* ---- dither ---- */

static const struct zr_frame *draw(struct reading *reading, struct zr_arena *arena, struct zr_team *team)
{
    struct zr_error error = {.status = ZR_OK};
    const struct zr_frame *frame;
    assert_read(reading);
    zr_arena_init(arena, (size_t)1 << 28);
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = arena, .team = team, .error = &error}, reading->scene, NULL, &frame),
        ZR_OK);
    return frame;
}

/* The byte nearest to the gradient, moved by the pattern; what is a tie may be either. */
static void assert_dithered(const struct zr_frame *frame, uint32_t x, uint32_t y)
{
    static const int pattern[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    const double up = (double)y / (frame->height - 1), bottom = decode(0x20 / 255.0), top = decode(0x50 / 255.0);
    const double moved = (pattern[y & 3][x & 3] + 0.5) / 16.0 - 0.5;
    const double want = 255.0 * encode(bottom + (top - bottom) * up) + moved;
    const uint8_t *pixel = frame->color + 4 * ((size_t)(frame->height - 1 - y) * frame->width + x);
    for (int k = 0; k < 3; k++)
        assert_true(fabs((double)pixel[k] - want) < 0.5 + 1e-3);
    assert_int_equal(pixel[3], 255);
}

#define GRADIENT "\"background\": {\"top\": \"#505050\", \"bottom\": \"#202020\"}, "
#define SPECK    "\"polygons\": [{\"vertices\": [[0,0,0], [1,0,0], [0,1,0]]}]}"

TEST_EACH_ISA(gradients_are_dithered_beside_what_is_drawn)
{
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    struct reading *reading =
        read_scene("{\"look\": \"xray\", \"window\": {\"width\": 147, \"height\": 61}, " GRADIENT SPECK);
    struct zr_arena arena;
    const struct zr_frame *frame = draw(reading, &arena, team);
    for (uint32_t y = 0; y < frame->height; y++)
        for (uint32_t x = 0; x < 40; x++)
            assert_dithered(frame, x, y);
    zr_arena_free(&arena);
    reading_free(reading);
    zr_team_destroy(team);
}

TEST(plain_backgrounds_are_not_dithered)
{
    struct reading *reading = read_scene("{\"look\": \"xray\", \"window\": {\"width\": 40, \"height\": 30}, "
                                         "\"background\": \"#77787a\", " SPECK);
    struct zr_arena arena;
    const struct zr_frame *frame = draw(reading, &arena, NULL);
    for (uint32_t i = 0; i < 40; i++)
        assert_true(frame->color[4 * i] == 0x77 && frame->color[4 * i + 1] == 0x78 && frame->color[4 * i + 2] == 0x7a);
    zr_arena_free(&arena);
    reading_free(reading);
}

/* ---- surfaces ---- */

static struct lit_samples samples, others;

/* Seen along z, from everywhere. */
static struct zr_linear_lighting parallel_light(const struct zr_material *materials)
{
    struct zr_linear_lighting lighting = no_light(materials);
    lighting.is_parallel = true;
    lighting.to_eye = (zr_vec3){0, 0, 1};
    return lighting;
}

TEST_EACH_ISA(a_cool_colour_is_a_share_of_the_surfaces)
{
    const struct zr_material material = {.shading = ZR_SHADING_GOOCH, .cool = {0.5f, 0.6f, 0.7f}};
    const zr_vec3 away = zr_vec3_normalize((zr_vec3){0.45f, -0.65f, -0.61f}), base = {0.8f, 0.4f, 0.2f};
    const double cool[3] = {decode(0.5), decode(0.6), decode(0.7)}, own[3] = {decode(0.8), decode(0.4), decode(0.2)};
    struct zr_linear_lighting lighting = parallel_light(&material);
    lighting.gooch = (struct zr_gooch){0.25f, 0.75f};
    samples_clear(&samples);
    samples_set(&samples, 0, 0, base, away, (zr_vec3){0, 0, 0});
    samples_set(&samples, 1, 0, base, zr_vec3_scale(away, -1.0f), (zr_vec3){0, 0, 0});
    samples.open[1] = 0.5f;
    samples_light(&samples, isa_under_test(state), &lighting);
    for (int k = 0; k < 3; k++) {
        assert_true(fabs((double)samples.out[k][0] - cool[k] * own[k]) < 1e-5);
        assert_true(fabs((double)samples.out[k][1] - own[k] * (0.25 + 0.75 * 0.5)) < 1e-5);
    }
}

/* Even samples face the eye, odd ones turn their backs. */
TEST_EACH_ISA(xrays_are_denser_along_the_view_and_on_the_left)
{
    const struct zr_material material = {.shading = ZR_SHADING_XRAY};
    struct zr_linear_lighting lighting = parallel_light(&material);
    float opacity[ROOM];
    samples_clear(&samples);
    for (int i = 0; i < ROOM; i++)
        opacity[i] = 0.5f;
    for (size_t i = 0; i < 200; i++) {
        const float x = ((float)i + 0.5f) / 100.0f - 1.0f, z = sqrtf(fmaxf(1.0f - x * x, 0.0f));
        samples_set(&samples, i, 0, (zr_vec3){1, 1, 1}, (zr_vec3){i % 2 ? -x : x, 0, i % 2 ? -z : z},
                    (zr_vec3){0, 0, 0});
    }
    zr_xray_of(isa_under_test(state))(&lighting, &samples.g, opacity);
    for (int i = 0; i < 200; i++) {
        const double x = (i + 0.5) / 100.0 - 1.0, along = 1.0 - sqrt(fmax(1.0 - x * x, 0.0));
        const double want = (0.15 + 0.76 * along * along) * (1.0 - 0.4 * x);
        assert_true(fabs((double)opacity[i] - 0.5 * fmin(want, 1.0)) < 1e-4);
    }
}

/* A plane seen in one direction has one colour under an environment far away. Near, it has a gradient; in the middle
 * of the scene nothing changes. */
TEST_EACH_ISA(near_environments_give_planes_a_gradient)
{
    const struct zr_material material = {
        .shading = ZR_SHADING_PBR, ZR_MATERIAL_PLASTIC, .metallic = 1, .roughness = 0.3f};
    const enum zr_isa isa = isa_under_test(state);
    const zr_vec3 normal = zr_vec3_normalize((zr_vec3){0.3f, 0.5f, 0.8f}), across = {0.8f, 0, -0.3f};
    struct zr_linear_lighting lighting = parallel_light(&material);
    lighting.has_environment = zr_environment_make(ZR_ENVIRONMENT_METAL, &lighting.environment);
    lighting.middle = (zr_vec3){7, -2, -9};
    samples_clear(&samples);
    for (size_t i = 0; i < 101; i++) {
        const zr_vec3 aside = zr_vec3_scale(across, ((float)i - 50.0f) / 50.0f);
        samples_set(&samples, i, 0, (zr_vec3){1, 1, 1}, normal, zr_vec3_add(lighting.middle, aside));
    }
    others = samples;
    for (int k = 0; k < 3; k++) {
        others.g.base[k] = others.planes[k];
        others.g.normal[k] = others.planes[3 + k];
        others.g.point[k] = others.planes[6 + k];
    }
    others.g.owner = others.owner;
    others.g.material = others.material;
    samples_light(&others, isa, &lighting);
    lighting.nearness = 0.5f;
    samples_light(&samples, isa, &lighting);
    assert_true(others.out[0][0] == others.out[0][50] && others.out[0][50] == others.out[0][100]);
    assert_true(fabsf(samples.out[0][50] - others.out[0][50]) < 1e-6f);
    assert_true(fabsf(samples.out[0][0] - samples.out[0][50]) > 0.02f);
    assert_true(fabsf(samples.out[0][100] - samples.out[0][50]) > 0.02f);
}

/* ---- views ---- */

TEST(views_suit_the_extent)
{
    static const struct {
        zr_vec3 size;
        bool z_is_up;
        double azimuth, elevation;
    } cases[] = {
        {{1, 1, 1}, false, 35, 28},        {{10, 1.77f, 10}, false, 35, 28.09083},
        {{10, 10, 1}, true, 35, 34.10013}, {{10, 0.1f, 10}, false, 35, 41.20806},
        {{10, 10, 0.001f}, false, 0, 0},   {{0.001f, 10, 10}, false, 90, 0},
        {{10, 0.001f, 10}, false, 0, 90},  {{10, 10, 0.001f}, true, 0, 90},
        {{10, 0.001f, 10}, true, 0, 0},    {{0, 0, 0}, false, 35, 28},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int suits = 0; suits < 2; suits++) {
            struct zr_view view = {
                .pose = ZR_POSE_ORBIT, .azimuth_degrees = 35, .elevation_degrees = 28, .suits_extent = suits};
            const struct zr_bounds bounds = {true, {0, 0, 0}, cases[i].size};
            zr_view_suit_extent(&view, &bounds, cases[i].z_is_up);
            print_message("%zu: %g %g\n", i, view.azimuth_degrees, view.elevation_degrees);
            assert_true(fabs(view.azimuth_degrees - (suits ? cases[i].azimuth : 35)) < 1e-3);
            assert_true(fabs(view.elevation_degrees - (suits ? cases[i].elevation : 28)) < 1e-3);
        }
}

/* Only the look's own angles are changed. */
TEST(angles_that_are_given_stay)
{
    static const struct {
        struct zr_request request;
        bool suits;
    } cases[] = {{{.look = "studio"}, true},
                 {{.look = "studio", .padding = "0.2"}, true},
                 {{.look = "technical"}, false},
                 {{.look = "studio", .elevation = "10"}, false},
                 {{.look = "studio", .azimuth = "10"}, false}};
    static const char mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct zr_request request = cases[i].request;
        request.format = ZR_FORMAT_OBJ;
        struct reading *reading = read_request(request, mesh, strlen(mesh), zr_limits_default(), (size_t)1 << 24);
        assert_read(reading);
        assert_int_equal(reading->scene->views[0].suits_extent, cases[i].suits);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
