#include "reference/gl/twins.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "reference/generate/batches.h"
#include "reference/gl/glsl_unit.h"
#include "reference/gl/layers_twin.h"
#include "reference/gl/reference_program.h"
#include "reference/interpolation.h"
#include "reference/subject.h"

/* How much may be off, in losses of interpolation.h. RULES.md has what was measured. */
static const double losses_max = 2.0;

/* `value` is a vec3 of GLSL, made of what `fragment` below has. On lines all that is exact is compared, and shares and
 * texture coordinates, which are 0 there. */
static const struct twin {
    const char *name;
    enum zr_channel channel;
    enum zr_space space;
    const char *value;
    enum { EXACT, ROUNDED } bar;
    enum interpolation_of of; /* what rounding changes */
} table[] = {
    {"depth", ZR_CHANNEL_DEPTH, ZR_SPACE_CAMERA, "-point(eye).zzz", ROUNDED, INTERPOLATION_EYE},
    {"distance", ZR_CHANNEL_DISTANCE, ZR_SPACE_CAMERA, "way(point(eye), viewer)", ROUNDED, INTERPOLATION_EYE},
    {"position", ZR_CHANNEL_POSITION, ZR_SPACE_CAMERA, "point(eye)", ROUNDED, INTERPOLATION_EYE},
    {"position-world", ZR_CHANNEL_POSITION, ZR_SPACE_WORLD, "point(world)", ROUNDED, INTERPOLATION_WORLD},
    {"position-object", ZR_CHANNEL_POSITION, ZR_SPACE_OBJECT, "point(object)", ROUNDED, INTERPOLATION_OBJECT},
    {"barycentrics", ZR_CHANNEL_BARYCENTRICS, ZR_SPACE_CAMERA, "point(shares)", ROUNDED, INTERPOLATION_SHARES},
    {"texcoord", ZR_CHANNEL_TEXCOORD, ZR_SPACE_CAMERA, "place()", ROUNDED, INTERPOLATION_TEXCOORD},
    {"normals", ZR_CHANNEL_NORMALS, ZR_SPACE_CAMERA, "own_normal(axes)", EXACT, 0},
    {"normals-world", ZR_CHANNEL_NORMALS, ZR_SPACE_WORLD, "own_normal(axes)", EXACT, 0},
    {"instanceId", ZR_CHANNEL_INSTANCE_ID, ZR_SPACE_CAMERA, "facts.xxx", EXACT, 0},
    {"frontFacing", ZR_CHANNEL_FRONT_FACING, ZR_SPACE_CAMERA, "side()", EXACT, 0},
};
enum { TWINS = sizeof table / sizeof *table };
_Static_assert(sizeof table / sizeof *table <= TWINS_MAX, "there are more twins than room for them");

/* ---- programs ---- */

/* What a corner tells, as gl_Color: 1 + its instance; which side is seen: 0 that which GL finds, 1 the front, 2 the
 * back; whether its normal varies; which corner of its triangle it is. */
enum { CORNER_OF_LINE = 3 };

#define VERSION "#version 400 compatibility\n" GLSL_UNIT
#define ROWS_TIMES                                                                                                     \
    "vec3 rows_times(vec3 rows[3], vec3 n)\n"                                                                          \
    "{\n"                                                                                                              \
    "    return vec3(sum_of_products(rows[0], n), sum_of_products(rows[1], n), sum_of_products(rows[2], n));\n"        \
    "}\n"

static const char *const vertex =
    VERSION ROWS_TIMES "uniform vec3 normal_rows[3];\n"
                       "uniform mat4 to_world;\n"
                       "out vec4 eye, world, object, shares;\n"
                       "out vec2 texcoord;\n"
                       "out vec3 normal;\n"
                       "flat out vec3 flat_normal;\n"
                       "flat out vec4 facts;\n"
                       "flat out float corner;\n"
                       "void main()\n"
                       "{\n"
                       "    normal = flat_normal = unit(rows_times(normal_rows, unit(gl_Normal)));\n"
                       "    texcoord = gl_MultiTexCoord0.xy;\n"
                       "    object = gl_Vertex;\n"
                       "    world = to_world * gl_Vertex;\n"
                       "    eye = gl_ModelViewMatrix * gl_Vertex;\n"
                       "    shares = eye.w * vec4(equal(vec4(gl_Color.www, 3.0), vec4(0.0, 1.0, 2.0, 3.0)));\n"
                       "    facts = gl_Color;\n"
                       "    corner = float(gl_VertexID);\n"
                       "    gl_Position = ftransform();\n"
                       "}\n";

/* Alpha is 1 + the number of the last corner, so that the comparison knows the triangle. */
static const char *const fragment =
    VERSION ROWS_TIMES "uniform vec4 viewer;\n"
                       "uniform vec3 axes[3];\n"
                       "in vec4 eye, world, object, shares;\n"
                       "in vec2 texcoord;\n"
                       "in vec3 normal;\n"
                       "flat in vec3 flat_normal;\n"
                       "flat in vec4 facts;\n"
                       "flat in float corner;\n"
                       "vec3 point(vec4 p)\n"
                       "{\n"
                       "    return p.xyz / p.w;\n"
                       "}\n"
                       "vec3 place()\n"
                       "{\n"
                       "    return facts.w == 3.0 ? vec3(0.0) : vec3(texcoord, 0.0);\n"
                       "}\n"
                       "vec3 way(vec3 to, vec4 from)\n"
                       "{\n"
                       "    return from.w == 0.0 ? -to.zzz : vec3(length(to - from.xyz));\n"
                       "}\n"
                       "bool is_back()\n"
                       "{\n"
                       "    return facts.y == 0.0 ? !gl_FrontFacing : facts.y == 2.0;\n"
                       "}\n"
                       "vec3 side()\n"
                       "{\n"
                       "    return vec3(facts.w == 3.0 ? 0.0 : is_back() ? 2.0 : 1.0);\n"
                       "}\n"
                       "vec3 own_normal(vec3 space[3])\n"
                       "{\n"
                       "    vec3 n = facts.z != 0.0 ? normal : flat_normal;\n"
                       "    return facts.w == 3.0 ? vec3(0.0) : unit(rows_times(space, unit(is_back() ? -n : n)));\n"
                       "}\n"
                       "void main()\n"
                       "{\n"
                       "    gl_FragColor = vec4(%s, 1.0 + corner);\n"
                       "}\n";

static unsigned program_of(struct twins *twins, size_t i, struct reference_error *error)
{
    static char source[1 << 13];
    if (twins->programs[i]) return twins->programs[i];
    snprintf(source, sizeof source, fragment, table[i].value);
    return twins->programs[i] = reference_program(vertex, source, error);
}

/* ---- the reference's side ---- */

/* One scene, and one row of the table. */
struct checking {
    struct harness *harness;
    const struct zr_scene *scene;
    const char *label;
    const struct harness_pictures *pictures;
    struct reference_arrays arrays;
    bool has_parity;         /* some are drawn by the odd-even rule */
    struct zr_camera camera; /* the reference's */
    const struct twin *twin;
    struct interpolation interpolation;
    struct twin_sum *sum;
    int told; /* pixels that differ, to people */
};

static void put_facts(const struct reference_batch *batch, zr_vec4 *front)
{
    const bool line = batch->outline || batch->mode == REFERENCE_LINES || batch->mode == REFERENCE_POINTS;
    const float side = batch->light == REFERENCE_LIT_FRONT ? 1.0f : batch->light == REFERENCE_LIT_BACK ? 2.0f : 0.0f;
    for (uint32_t i = 0; i < batch->count; i++)
        front[batch->first + i] = (zr_vec4){(float)batch->instance + 1.0f, side, batch->smooth ? 1.0f : 0.0f,
                                            line ? (float)CORNER_OF_LINE : (float)(i % 3)};
}

static bool make_arrays(struct checking *c)
{
    enum { EXACT_FLOATS = 1 << 24 };
    static const struct batches_only opaque = {.mode = ZR_ALPHA_OPAQUE};
    const struct batches_options options = {.purpose = BATCHES_CHANNELS,
                                            .only = layers_twin_is_for(c->scene) ? &opaque : NULL,
                                            .all_parity = c->harness->options.all_parity};
    struct zr_arena *arena = &c->harness->arena;
    struct batches batches;
    uint32_t corners = 0;
    if (!batches_make(arena, c->scene, &c->camera, &options, &batches)) return false;
    c->arrays = batches.arrays;
    c->has_parity = batches.parity_faces > 0;
    c->arrays.background = (zr_vec4){0, 0, 0, 0};
    for (uint32_t i = 0; i < c->arrays.batch_count; i++)
        corners = c->arrays.batches[i].first + c->arrays.batches[i].count;
    zr_vec4 *front = zr_arena_alloc(arena, corners, sizeof *front);
    if (!front || corners >= EXACT_FLOATS) return false;
    memset(front, 0, corners * sizeof *front);
    for (uint32_t i = 0; i < c->arrays.batch_count; i++)
        put_facts(&c->arrays.batches[i], front);
    c->arrays.front = front;
    return true;
}

static bool draw(struct checking *c, unsigned program, float *rgba, struct reference_error *error)
{
    const zr_vec4 viewer = zr_camera_eye(&c->camera);
    zr_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const float *m = c->camera.world_to_eye.m; /* its columns lead normals back */
    for (int k = 0; c->twin->space == ZR_SPACE_WORLD && k < 3; k++)
        axes[k] = (zr_vec3){m[4 * k], m[4 * k + 1], m[4 * k + 2]};
    const struct reference_uniform known[] = {{"viewer", 4, 1, &viewer.x}, {"axes", 3, 3, &axes[0].x}};
    struct reference_uniform used[2];
    struct reference_shader shader = {.program = program, .uniforms = used};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strstr(c->twin->value, known[i].name)) used[shader.uniform_count++] = known[i];
    return reference_resize(c->harness->reference, c->scene->views[0].width, c->scene->views[0].height, c->has_parity,
                            error) &&
           reference_draw_floats(c->harness->reference, &c->arrays, &shader, rgba, error);
}

/* ---- pixels ---- */

struct pixel {
    const float *want; /* the fourth is 1 + the number of a corner, or 0 */
    float got[3];
    uint32_t words, x, y; /* y up */
    bool is_exact;
};

static void tell(struct checking *c, const struct pixel *p, double off)
{
    enum { TOLD_MAX = 3 };
    const float *want = p->want, *got = p->got;
    if (c->told++ >= TOLD_MAX) return;
    printf("# %s: %s at %" PRIu32 ", %" PRIu32 ": wanted %.9g %.9g %.9g, got %.9g %.9g %.9g: %g %s\n", c->label,
           c->twin->name, p->x, c->scene->views[0].height - 1 - p->y, (double)want[0], (double)want[1], (double)want[2],
           (double)got[0], (double)got[1], (double)got[2], off, p->is_exact ? "ulp" : "losses");
}

/* How much is off, as struct twin_sum has it. */
static double measure(struct checking *c, const struct pixel *p)
{
    uint32_t ulp = 0;
    double off = 0.0, size = 0.0;
    for (uint32_t k = 0; k < p->words; k++) {
        const uint32_t between = compare_ulp(p->want[k], p->got[k]);
        ulp = between > ulp ? between : ulp;
        off = fmax(off, fabs((double)p->want[k] - (double)p->got[k]));
        size = fmax(size, fabs((double)p->want[k]));
        if (between > 0 && !(isfinite(p->want[k]) && isfinite(p->got[k]))) off = HUGE_VAL;
    }
    c->sum->equal += ulp == 0;
    if (p->is_exact) return (double)ulp;
    const double loss = interpolation_loss(&c->interpolation, p->x, p->y, size);
    c->sum->sharp += losses_max * loss < 1e-4 * size;
    return off > 0.0 ? off / loss : 0.0;
}

static bool is_left_out(struct checking *c, bool is_line)
{
    const enum interpolation_of of = c->twin->of;
    const bool is_rounded = c->twin->bar == ROUNDED;
    const bool line = is_rounded && is_line && of != INTERPOLATION_SHARES && of != INTERPOLATION_TEXCOORD;
    c->sum->lines += line;
    return line;
}

static void compare_pixel(struct checking *c, struct pixel *p)
{
    const bool is_drawn = p->want[3] > 0.0f;
    const uint32_t last = is_drawn ? (uint32_t)p->want[3] - 1 : 0;
    const bool is_line = is_drawn && c->arrays.front[last].w == (float)CORNER_OF_LINE;
    p->is_exact = is_line || c->twin->bar == EXACT;
    if (is_drawn && !p->is_exact) interpolation_enter(&c->interpolation, last - 2);
    if (is_drawn && is_left_out(c, is_line)) return;
    const double off = is_drawn ? measure(c, p) : HUGE_VAL;
    const bool is_beyond = !(off <= (p->is_exact ? 0.0 : losses_max));
    c->sum->pixels++;
    c->sum->beyond += is_beyond;
    c->sum->most = fmax(c->sum->most, off);
    if (is_beyond) tell(c, p, off);
}

/* Where both sides give a pixel to one face, and tell it. */
static void compare_words(struct checking *c, const float *want, const void *words)
{
    const struct zr_channel_row *row = &zr_channel_rows[c->twin->channel];
    const struct picture *a = &c->pictures->want, *b = &c->pictures->got;
    const uint32_t width = c->scene->views[0].width, height = c->scene->views[0].height;
    for (size_t i = 0; i < (size_t)width * height; i++) {
        struct pixel p = {.want = want + 4 * i, .words = row->words};
        if (b->owner[i] == 0 || b->owner[i] != a->owner[i] || a->gaps[i]) continue;
        p.x = (uint32_t)(i % width);
        p.y = height - 1 - (uint32_t)(i / width);
        for (size_t k = 0, at = i * row->words; k < row->words; k++, at++)
            p.got[k] =
                row->values == ZR_VALUES_UINT32 ? (float)((const uint32_t *)words)[at] : ((const float *)words)[at];
        compare_pixel(c, &p);
    }
}

static bool check_row(struct checking *c, unsigned program, struct reference_error *error)
{
    struct zr_arena *arena = &c->harness->arena;
    float *want = zr_arena_alloc(arena, (size_t)c->scene->views[0].width * c->scene->views[0].height, 4 * sizeof *want);
    if (!program || !want || !draw(c, program, want, error)) return false;
    const void *got = subject_channel(arena, c->harness->team, c->scene, c->twin->channel, c->twin->space);
    c->interpolation = (struct interpolation){.arrays = &c->arrays,
                                              .world_to_eye = &c->camera.world_to_eye,
                                              .width = c->scene->views[0].width,
                                              .height = c->scene->views[0].height,
                                              .of = c->twin->of};
    c->told = 0;
    if (got) compare_words(c, want, got);
    return got;
}

/* Whose samples a program would have to be told. */
static bool has_masks(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].alpha_mode == ZR_ALPHA_MASK) return true;
    return false;
}

enum verdict twins_check(struct twins *twins, struct harness *harness, const struct zr_scene *scene, const char *label,
                         const struct harness_pictures *pictures, struct tally *tally)
{
    struct reference_error error = {"nothing was drawn"};
    struct checking c = {.harness = harness, .scene = scene, .label = label, .pictures = pictures};
    const uint64_t beyond = tally->twins_beyond;
    if (harness->options.bar != COMPARE_EXACT || !pictures->frame || has_masks(scene)) return VERDICT_EQUAL;
    c.camera = pictures->frame->camera;
    c.camera.projection.m[12] += (float)harness->options.perturbation;
    bool ok = make_arrays(&c);
    for (size_t i = 0; ok && i < TWINS; i++) {
        const struct twin_sum before = twins->sums[i];
        c.twin = &table[i];
        c.sum = &twins->sums[i];
        ok = check_row(&c, program_of(twins, i, &error), &error);
        tally->twins_pixels += c.sum->pixels - before.pixels;
        tally->twins_beyond += c.sum->beyond - before.beyond;
    }
    if (!ok) fprintf(stderr, "%s: channels: %s\n", label, error.text);
    return !ok ? VERDICT_UNPROVED : tally->twins_beyond > beyond ? VERDICT_DIFFERENT : VERDICT_EQUAL;
}

enum verdict twins_report(const struct twins *twins, struct report *report)
{
    enum verdict worst = VERDICT_EQUAL;
    for (size_t i = 0; i < TWINS; i++) {
        const struct twin_sum *s = &twins->sums[i];
        const bool proved = s->pixels + s->lines > 0;
        const enum verdict verdict = s->beyond ? VERDICT_DIFFERENT : proved ? VERDICT_EQUAL : VERDICT_UNPROVED;
        char figures[400], most[120], left_out[160] = "";
        if (table[i].bar == EXACT)
            snprintf(most, sizeof most, "max %.0f ulp", s->most);
        else
            snprintf(most, sizeof most, "max %.3f of %.0f losses  bound below 1e-4 at %" PRIu64, s->most, losses_max,
                     s->sharp);
        if (s->lines) snprintf(left_out, sizeof left_out, "  left out: %" PRIu64 " pixels of lines", s->lines);
        snprintf(figures, sizeof figures, "pixels %10" PRIu64 "  equal %10" PRIu64 "  beyond %" PRIu64 "  %s%s",
                 s->pixels, s->equal, s->beyond, most, left_out);
        report_channel(report, table[i].name, verdict, figures);
        worst = verdict > worst ? verdict : worst;
    }
    return worst;
}
