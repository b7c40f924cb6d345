#include "reference/floats.h"

#include <stdio.h>

#include "geometry/clip.h"
#include "raster/setup.h"
#include "reference/gl/glsl_math.h"
#include "reference/gl/reference_program.h"
#include "shade/lights/light.h"
#include "support/random.h"

enum { WIDTH = 61, HEIGHT = 47, PIXELS = WIDTH * HEIGHT, LIGHTS_MAX = 5 };

/* No plane of ours gives it. */
static const zr_vec4 nothing = {-1e9f, -1e9f, -1e9f, -1e9f};

/* One random triangle in clip space, and its light. */
struct sample {
    zr_vec4 positions[3], values[3];
    zr_vec3 normals[3];
    struct zr_normal_matrix to_eye;
    zr_vec3 ambient, to_light[LIGHTS_MAX], colors[LIGHTS_MAX];
    uint32_t light_count;
    uint32_t clipped;
};

/* What is left of it in the window, turned as rule 6 has it. */
struct piece {
    struct zr_setup setup;
    bool back;
    struct zr_plane oow, over_w[4]; /* over_w: of a value's channels times 1/w */
};

struct pieces {
    int count;
    struct piece list[ZR_CLIP_MAX];
};

struct part {
    const char *name, *vertex,
        *fragment; /* vertex: one that has the attribute `value`, or NULL; both NULL: it is lit */
    const struct reference_uniform *uniform; /* or NULL */
    /* Four floats of a pixel that the piece covers. */
    void (*expect)(const struct sample *sample, const struct piece *piece, int32_t x, int32_t y, float out[4]);
};

/* ---- random triangles ---- */

static float random_float(struct random *r, double low, double high)
{
    return (float)random_range(r, low, high);
}

static zr_vec3 random_vec3(struct random *r, double low, double high)
{
    float v[3];
    for (int k = 0; k < 3; k++)
        v[k] = random_float(r, low, high);
    return (zr_vec3){v[0], v[1], v[2]};
}

/* Half of them inside, and of the others most stick out somewhere; w of one triangle differs a hundredfold at most. */
static void sample_make(struct sample *s, struct random *r)
{
    /* The squares of the last two are too small and too large for a float. */
    static const float lengths[4] = {1, 2, 0x1p-90f, 0x1p90f};
    const double reach = random_below(r, 2) ? 0.98 : 2;
    *s = (struct sample){.light_count = random_below(r, LIGHTS_MAX + 1)};
    for (int k = 0; k < 3; k++) {
        const float w = random_float(r, 0.1, 10);
        const zr_vec3 at = random_vec3(r, -reach, reach), value = random_vec3(r, 0, 1);
        s->positions[k] = (zr_vec4){at.x * w, at.y * w, at.z * w, w};
        s->values[k] = (zr_vec4){value.x, value.y, value.z, 1};
        s->normals[k] = zr_vec3_scale(random_vec3(r, -1, 1), lengths[random_below(r, 4)]);
        s->to_eye.rows[k] = random_vec3(r, -1, 1);
    }
    s->ambient = random_vec3(r, 0, 0.4);
    for (uint32_t i = 0; i < s->light_count; i++) {
        s->to_light[i] = zr_vec3_normalize(random_vec3(r, -1, 1));
        s->colors[i] = random_vec3(r, 0, 0.7);
    }
}

/* ---- ours ---- */

static float channel(zr_vec4 v, int k)
{
    const float channels[4] = {v.x, v.y, v.z, v.w};
    return channels[k];
}

/* In clip space. */
struct corner {
    zr_vec4 position, value;
};

static void add_piece(struct pieces *pieces, const struct corner *corners[3])
{
    struct piece *piece = &pieces->list[pieces->count];
    struct zr_window_vertex v[3];
    const struct zr_viewport viewport = zr_viewport_make(WIDTH, HEIGHT);
    for (int k = 0; k < 3; k++)
        if (!zr_viewport_apply(&viewport, corners[k]->position, &v[k])) return;
    const int64_t area = zr_window_area(&v[0], &v[1], &v[2]);
    if (area == 0) return;
    /* Counter-clockwise in the window is the front, which rule 6 turns around. */
    const int first = area < 0 ? zr_swapped_corner() : 0, swapped = area < 0 ? 0 : zr_swapped_corner();
    struct zr_triangle turned = {.v = {(uint32_t)first, 1, 2}};
    turned.v[zr_swapped_corner()] = (uint32_t)swapped;
    const uint32_t *t = turned.v;
    const struct zr_plane_basis basis = zr_plane_basis_make(&v[t[0]], &v[t[1]], &v[t[2]]);
    piece->setup = zr_setup_make(v, &turned);
    piece->back = area > 0;
    piece->oow = zr_plane_make(&basis, v[t[0]].oow, v[t[1]].oow, v[t[2]].oow);
    for (int k = 0; k < 4; k++) {
        float over_w[3];
        for (int i = 0; i < 3; i++)
            over_w[i] = channel(corners[t[i]]->value, k) * v[t[i]].oow;
        piece->over_w[k] = zr_plane_make(&basis, over_w[0], over_w[1], over_w[2]);
    }
    pieces->count++;
}

static void pieces_make(struct pieces *pieces, struct sample *s)
{
    struct zr_clipped clipped;
    zr_vec4 values[ZR_CLIP_VALUES];
    struct corner corners[ZR_CLIP_MAX];
    unsigned any = 0, all = ~0u;
    for (int k = 0; k < 3; k++) {
        const unsigned code = zr_clip_outcode(s->positions[k]);
        any |= code;
        all &= code;
        values[k] = s->values[k];
    }
    pieces->count = 0;
    s->clipped = any != 0 && all == 0;
    if (all != 0) return;
    const int count = zr_clip_triangle(s->positions, any, NULL, &clipped);
    zr_clip_replay(clipped.made, clipped.made_count, clipped.corners, values);
    for (int i = 0; i < count; i++)
        corners[i] = (struct corner){clipped.vertices[i].position, values[clipped.vertices[i].id]};
    if (count > 0 && any == 0) add_piece(pieces, (const struct corner *[3]){&corners[0], &corners[1], &corners[2]});
    for (int i = 2; any && i < count; i++)
        add_piece(pieces, (const struct corner *[3]){&corners[i - 1], &corners[i], &corners[0]});
}

static void expect_varying(const struct sample *s, const struct piece *piece, int32_t x, int32_t y, float out[4])
{
    const float reciprocal = 1.0f / zr_plane_at(&piece->oow, (float)x, (float)y);
    (void)s;
    for (int k = 0; k < 4; k++)
        out[k] = zr_plane_at(&piece->over_w[k], (float)x, (float)y) * reciprocal;
}

static void expect_place(const struct sample *s, const struct piece *piece, int32_t x, int32_t y, float out[4])
{
    (void)s;
    out[0] = (float)x + 0.5f;
    out[1] = (float)y + 0.5f;
    out[2] = zr_plane_at(&piece->setup.depth.plane, (float)x, (float)y);
    out[3] = zr_plane_at(&piece->oow, (float)x, (float)y);
}

static const float exponent = 17.5f;

static void expect_math(const struct sample *s, const struct piece *piece, int32_t x, int32_t y, float out[4])
{
    float v[4];
    expect_varying(s, piece, x, y, v);
    const float to_unit = 1.0f / sqrtf((v[2] * v[2] + v[1] * v[1]) + v[0] * v[0]);
    out[0] = glsl_pow(v[0], exponent);
    out[1] = glsl_exp2(v[2]) / v[1];
    out[2] = glsl_log2(v[1]);
    out[3] = ((v[2] * to_unit) * v[1] + (v[1] * to_unit) * v[0]) + (v[0] * to_unit) * v[2];
}

/* Flat: the last corner's. */
static void expect_light(const struct sample *s, const struct piece *piece, int32_t x, int32_t y, float out[4])
{
    struct zr_lamp lamps[LIGHTS_MAX];
    const struct zr_lights lights = {.ambient = s->ambient, .count = s->light_count, .lamps = lamps};
    const zr_vec4 normal = {s->normals[2].x, s->normals[2].y, s->normals[2].z, 0};
    zr_vec4 front, back;
    (void)x, (void)y;
    for (uint32_t i = 0; i < s->light_count; i++)
        lamps[i] = (struct zr_lamp){.to_light = s->to_light[i], .color = s->colors[i]};
    zr_light_of(zr_isa_best())(&lights, &s->to_eye, &normal, &s->values[2], 1, &front, &back);
    for (int k = 0; k < 4; k++)
        out[k] = channel(piece->back ? back : front, k);
}

/* ---- both ---- */

static const char passes_value[] = "#version 120\n"
                                   "attribute vec4 value;\n"
                                   "varying vec4 varied;\n"
                                   "void main()\n"
                                   "{\n"
                                   "    gl_Position = ftransform();\n"
                                   "    varied = value;\n"
                                   "}\n";
static const char shows_varied[] = "#version 120\n"
                                   "varying vec4 varied;\n"
                                   "void main()\n"
                                   "{\n"
                                   "    gl_FragColor = varied;\n"
                                   "}\n";
static const char shows_place[] = "#version 120\n"
                                  "void main()\n"
                                  "{\n"
                                  "    gl_FragColor = gl_FragCoord;\n"
                                  "}\n";
static const char computes[] =
    "#version 120\n"
    "uniform float exponent;\n"
    "varying vec4 varied;\n"
    "void main()\n"
    "{\n"
    "    gl_FragColor = vec4(pow(varied.x, exponent), exp2(varied.z) / varied.y, log2(varied.y),\n"
    "                        dot(normalize(varied.xyz), varied.zxy));\n"
    "}\n";
static const struct reference_uniform exponent_uniform = {"exponent", 1, 1, &exponent};

static const struct part parts[] = {{"floats-varying", passes_value, shows_varied, NULL, expect_varying},
                                    {"floats-frag-coord", NULL, shows_place, NULL, expect_place},
                                    {"floats-math", passes_value, computes, &exponent_uniform, expect_math},
                                    {"floats-lit", NULL, NULL, NULL, expect_light}};

/* The light of a sample on the reference's side, and wrong where a test wants that. */
static struct reference_lighting reference_light(const struct harness_options *options, const struct sample *s,
                                                 zr_vec3 to_light[LIGHTS_MAX])
{
    const float more = options->more_ambient;
    for (uint32_t i = 0; i < s->light_count; i++) {
        to_light[i] = s->to_light[i];
        to_light[i].x += options->more_to_x;
    }
    return (struct reference_lighting){.ambient = zr_vec3_add(s->ambient, (zr_vec3){more, more, more}),
                                       .count = s->light_count,
                                       .to_light = to_light,
                                       .colors = s->colors};
}

static bool draw(struct harness *harness, const struct sample *s, const struct part *part, unsigned program,
                 float *rgba)
{
    const zr_mat4 identity = zr_mat4_identity();
    const struct reference_batch batch = {.mode = REFERENCE_TRIANGLES,
                                          .count = 3,
                                          .modelview = &identity,
                                          .light = program ? REFERENCE_UNLIT : REFERENCE_LIT,
                                          .normal_rows = s->to_eye.rows};
    zr_vec3 to_light[LIGHTS_MAX];
    const struct reference_lighting lighting = reference_light(&harness->options, s, to_light);
    struct reference_arrays arrays = {.positions = s->positions,
                                      .front = s->values,
                                      .normals = program ? NULL : s->normals,
                                      .lighting = program ? NULL : &lighting,
                                      .batch_count = 1,
                                      .batches = &batch,
                                      .projection = identity,
                                      .background = nothing};
    arrays.projection.m[12] += (float)harness->options.perturbation;
    const struct reference_attribute value = {"value", 4, &s->values[0].x};
    const struct reference_shader shader = {.program = program,
                                            .attribute_count = part->vertex ? 1 : 0,
                                            .uniform_count = part->uniform ? 1 : 0,
                                            .attributes = &value,
                                            .uniforms = part->uniform};
    struct reference_error error = {""};
    if (reference_resize(harness->reference, WIDTH, HEIGHT, false, &error) &&
        reference_draw_floats(harness->reference, &arrays, &shader, rgba, &error))
        return true;
    fprintf(stderr, "reference: %s\n", error.text);
    return false;
}

/* NULL: none is seen there. A piece cut by the far plane may round to its depth, which is no less than what is there.
 */
static const struct piece *find_piece(const struct pieces *pieces, int32_t x, int32_t y)
{
    for (int k = 0; k < pieces->count; k++) {
        const struct piece *piece = &pieces->list[k];
        if (zr_setup_covers(&piece->setup, x, y) && zr_depth_at(&piece->setup.depth, x, y) < 1.0f) return piece;
    }
    return NULL;
}

/* Four floats a pixel, row 0 on top. */
static void compare(const struct part *part, const struct sample *s, const struct pieces *pieces, const float *want,
                    struct comparison *sum)
{
    for (int32_t i = 0; i < PIXELS; i++, want += 4) {
        const int32_t x = i % WIDTH, y = HEIGHT - 1 - i / WIDTH;
        const struct piece *piece = find_piece(pieces, x, y);
        const bool drawn = want[0] != nothing.x;
        sum->pixels++;
        sum->visible += drawn || piece;
        sum->coverage += drawn != (piece != NULL);
        if (!drawn || !piece) continue;
        float got[4];
        uint32_t most = 0;
        part->expect(s, piece, x, y, got);
        for (int k = 0; k < 4; k++) {
            const uint32_t ulp = compare_ulp(want[k], got[k]);
            most = ulp > most ? ulp : most;
        }
        sum->depth += most > 0;
        sum->depth_max_ulp = most > sum->depth_max_ulp ? most : sum->depth_max_ulp;
    }
}

static bool check_triangles(struct harness *harness, const struct part *part, unsigned program, struct random *r,
                            uint64_t triangles, struct tally *tally)
{
    static float rgba[4 * PIXELS];
    for (uint64_t i = 0; i < triangles; i++) {
        struct sample sample;
        struct pieces pieces;
        sample_make(&sample, r);
        pieces_make(&pieces, &sample);
        if (!draw(harness, &sample, part, program, rgba)) return false;
        compare(part, &sample, &pieces, rgba, &tally->comparison);
        tally->pictures++;
        tally->triangles++;
        tally->clipped += sample.clipped;
    }
    return true;
}

static enum verdict check_part(struct harness *harness, const struct part *part, uint64_t seed, uint64_t triangles,
                               struct tally *tally)
{
    struct random r = random_seeded(seed);
    struct reference_error error = {""};
    unsigned program = part->fragment ? reference_program(part->vertex, part->fragment, &error) : 0;
    bool drawn = (program || !part->fragment) && check_triangles(harness, part, program, &r, triangles, tally);
    reference_program_delete(program);
    if (error.text[0]) fprintf(stderr, "reference: %s\n", error.text);
    const struct comparison *c = &tally->comparison;
    if (!drawn || c->visible == 0 || tally->clipped == 0) return VERDICT_UNPROVED;
    return c->coverage || c->depth ? VERDICT_DIFFERENT : VERDICT_EQUAL;
}

enum verdict floats_check(struct harness *harness, struct report *report, uint64_t seed, uint64_t triangles,
                          struct tally *sum)
{
    enum verdict worst = VERDICT_EQUAL;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        struct tally tally = {0};
        enum verdict verdict = check_part(harness, &parts[i], seed, triangles, &tally);
        report_line(report, parts[i].name, verdict, &tally);
        tally_add(sum, &tally);
        worst = verdict > worst ? verdict : worst;
    }
    return worst;
}
