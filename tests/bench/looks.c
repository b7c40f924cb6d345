/* What samples, linear light and each effect take: a picture with them against the same picture without. And 16 samples
 * against llvmpipe's picture of 4x4 the size, read back and averaged.
 */
#include "bench/looks.h"

#include <stdlib.h>
#include <string.h>

#include "bench/machine.h"
#include "bench/series.h"
#include "bench/sides.h"
#include "scene/looks.h"

enum { WITHOUT, WITH, SIDES, THREADS_MAX = 2, SIDE = 4 };

/* ---- ours with and without ---- */

/* What is added to a picture: to the textbook's way, or to linear light with one sample and no effect. */
enum added { SAMPLES_4, SAMPLES_16, SAMPLES_64, LINEAR, SIXTEEN, OCCLUSION, GROUND, SHADOWS, EDGES, ALL, ADDED_COUNT };

static const struct {
    const char *name;
    enum work_shade shade; /* of the textbook's way */
    bool is_linear;        /* what it is added to */
    struct bar bar;
} rows[ADDED_COUNT] = {
    [SAMPLES_4] = {"4 samples", WORK_GOURAUD, false, {0, 0}},
    [SAMPLES_16] = {"16 samples", WORK_GOURAUD, false, {0, 0}},
    [SAMPLES_64] = {"64 samples", WORK_GOURAUD, false, {0, 0}},
    [LINEAR] = {"pbr in linear light, no effect", WORK_GOURAUD, false, {0, 0}},
    [SIXTEEN] = {"pbr, 16 samples", WORK_GOURAUD, true, {0, 0}},
    [OCCLUSION] = {"pbr, occlusion", WORK_GOURAUD, true, {0, 0}},
    [GROUND] = {"pbr, shadow on the ground", WORK_GOURAUD, true, {0, 0}},
    [SHADOWS] = {"pbr, a lamp with shadows", WORK_GOURAUD, true, {0, 0}},
    [EDGES] = {"pbr, edges", WORK_GOURAUD, true, {0, 0}},
    [ALL] = {"studio complete", WORK_GOURAUD, false, {0, 0}},
};

struct task {
    const struct work *work;
    enum added added;
    int threads;
    bool culled; /* and smooth; else two-sided and flat: of the rows beside llvmpipe */
};

static void name_row(const struct task *task, char *name, size_t size)
{
    const struct variant variant = {WORK_GOURAUD, true};
    char what[80];
    works_variant_name(task->work, &variant, what, sizeof what);
    snprintf(name, size, "%s: %.50s %dT %s", rows[task->added].name, what, task->threads, machine_isa_name());
}

/* Studio with one sample and no effect. */
static void make_linear(struct ours *ours)
{
    static const struct zr_light lamp = {
        .direction = {-0.6f, 0, -0.8f}, .color = {0.5f, 0.5f, 0.5f}, .lit = ZR_LIT_PBR, .camera_frame = true};
    const struct zr_look *studio = zr_look_find("studio");
    struct zr_scene *scene = &ours->subject.scene;
    scene->picture = studio->picture;
    scene->picture.side = 1;
    scene->picture.occlusion.is_on = scene->picture.has_ground = false;
    scene->lights = &lamp;
    scene->light_count = 1;
    ours->subject.material.shading = ZR_SHADING_PBR;
    ours->subject.material.roughness = studio->material.roughness;
}

static void add(struct ours *ours, enum added added)
{
    static struct zr_light lamp;
    struct zr_scene *scene = &ours->subject.scene;
    struct zr_picture *picture = &scene->picture;
    if (added == SAMPLES_4) picture->side = 2;
    if (added == SAMPLES_16 || added == SIXTEEN) picture->side = 4;
    if (added == SAMPLES_64) picture->side = 8;
    if (added == LINEAR || added == ALL) make_linear(ours);
    if (added == ALL) *picture = zr_look_find("studio")->picture;
    if (added == OCCLUSION) picture->occlusion.is_on = true;
    if (added == GROUND) picture->has_ground = true;
    if (added == EDGES) picture->edges.is_on = true;
    if (added != SHADOWS) return;
    lamp = scene->lights[0];
    lamp.has_shadows = true;
    scene->lights = &lamp;
}

static void take(struct ours *ours, const struct task *task, int side)
{
    ours_take(ours, task->work, &(struct variant){rows[task->added].shade, true});
    if (rows[task->added].is_linear) make_linear(ours);
    if (side == WITH) add(ours, task->added);
}

static bool draw(struct ours *ours)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    return ours_render(ours, &color, 1);
}

static bool run_round(void *context, struct series *series)
{
    struct ours *ours = context;
    for (int side = WITHOUT; side < SIDES; side++) {
        const double begin = now_ms();
        if (!draw(&ours[side])) return false;
        series_add(&series[side], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    static struct ours ours[SIDES];
    const struct task *task = context;
    for (int side = WITHOUT; side < SIDES; side++) {
        if (!ours_open(&ours[side], task->threads)) return false;
        take(&ours[side], task, side);
    }
    if (!series_run(series, SIDES, bench->rounds, run_round, ours)) return false;
    struct row row = {.ours_ms = series_median(&series[WITH]),
                      .theirs_ms = series_median(&series[WITHOUT]),
                      .bar = rows[task->added].bar};
    name_row(task, row.work, sizeof row.work);
    sink_row(sink, &row);
    return true;
}

void looks_against_plain(struct bench *bench)
{
    struct work work;
    struct task task = {.work = &work};
    if (bench->check_only) return;
    if (!works_make(WORK_BUNNY_SMALL, bench->models, &work)) bench->results.failed = true;
    for (task.threads = 1; work.corners && task.threads <= THREADS_MAX; task.threads++)
        for (int added = 0; added < ADDED_COUNT; added++) {
            char name[ROW_NAME_SIZE];
            task.added = (enum added)added;
            name_row(&task, name, sizeof name);
            if (!bench_wants(bench, name)) continue;
            results_begin_table(&bench->results, "samples, linear light, effects: \"theirs\" is ours without");
            bench_in_child(bench, measure, &task, NULL);
        }
    works_free(&work);
}

/* ---- 16 samples against llvmpipe ---- */

static void name_samples_row(const struct task *task, char *name, size_t size)
{
    const struct variant variant = {task->culled ? WORK_GOURAUD : WORK_FLAT, task->culled};
    char what[80];
    works_variant_name(task->work, &variant, what, sizeof what);
    snprintf(name, size, "16 samples: %.60s %dT %s", what, task->threads, machine_isa_name());
}

struct sampling {
    struct ours ours;
    struct theirs theirs;
    uint32_t width, height;
    uint8_t *large, *small; /* theirs, RGBA */
};

/* Half up. Simple loops, which compilers make vectors of. */
static void average(const struct sampling *s)
{
    const size_t row = (size_t)s->width * SIDE * 4;
    for (uint32_t y = 0; y < s->height; y++) {
        const uint8_t *from = s->large + y * SIDE * row;
        for (uint32_t x = 0; x < s->width; x++)
            for (int c = 0; c < 4; c++) {
                unsigned sum = 0;
                for (int i = 0; i < SIDE; i++)
                    for (int k = 0; k < SIDE; k++)
                        sum += from[(size_t)i * row + (x * SIDE + (unsigned)k) * 4 + (unsigned)c];
                s->small[((size_t)y * s->width + x) * 4 + (unsigned)c] =
                    (uint8_t)((2 * sum + SIDE * SIDE) / (2 * SIDE * SIDE));
            }
    }
}

static bool draw_theirs(struct sampling *s)
{
    struct reference_error error = {""};
    if (!theirs_draw(&s->theirs) || !reference_read(s->theirs.reference, s->large, NULL, &error)) return false;
    average(s);
    return true;
}

static bool run_sampling_round(void *context, struct series *series)
{
    struct sampling *s = context;
    double begin = now_ms();
    if (!draw(&s->ours)) return false;
    series_add(&series[WITH], now_ms() - begin);
    begin = now_ms();
    if (!draw_theirs(s)) return false;
    series_add(&series[WITHOUT], now_ms() - begin);
    return true;
}

static bool measure_samples(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    static struct sampling s;
    const struct task *task = context;
    const struct variant variant = {task->culled ? WORK_GOURAUD : WORK_FLAT, task->culled};
    struct work larger = *task->work;
    struct reference_error error = {""};
    s.width = larger.drawing.width;
    s.height = larger.drawing.height;
    s.large = malloc((size_t)s.width * s.height * SIDE * SIDE * 4);
    s.small = malloc((size_t)s.width * s.height * 4);
    if (!s.large || !s.small || !ours_open(&s.ours, task->threads) || !theirs_open(&s.theirs, false, task->threads))
        return false;
    ours_take(&s.ours, task->work, &variant);
    s.ours.subject.scene.picture.side = SIDE;
    if (!theirs_take(&s.theirs, &larger, &variant) ||
        !reference_resize(s.theirs.reference, s.width * SIDE, s.height * SIDE, false, &error))
        return bench_complain("llvmpipe: %s", error.text);
    if (!series_run(series, SIDES, bench->rounds, run_sampling_round, &s)) return false;
    struct row row = {.ours_ms = series_median(&series[WITH]),
                      .theirs_ms = series_median(&series[WITHOUT]),
                      .bar = {task->culled ? 4 : 5.5, 8}};
    name_samples_row(task, row.work, sizeof row.work);
    sink_row(sink, &row);
    free(s.large);
    free(s.small);
    return true;
}

void looks_against_llvmpipe(struct bench *bench)
{
    struct work work;
    struct task task = {.work = &work};
    if (bench->check_only) return;
    if (!works_make(WORK_BUNNY_SMALL, bench->models, &work)) bench->results.failed = true;
    for (task.threads = 1; work.corners && task.threads <= THREADS_MAX; task.threads++)
        for (int culled = 1; culled >= 0; culled--) {
            char name[ROW_NAME_SIZE];
            task.culled = culled;
            name_samples_row(&task, name, sizeof name);
            if (!bench_wants(bench, name)) continue;
            results_begin_table(&bench->results, "16 samples a pixel against llvmpipe at 4x4 the size, averaged");
            bench_in_child(bench, measure_samples, &task, NULL);
        }
    works_free(&work);
}
