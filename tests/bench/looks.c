/* What samples, linear light and each effect take: a picture with them against the same picture without. */
#include "bench/looks.h"

#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"
#include "scene/looks.h"

enum { WITHOUT, WITH, SIDES, THREADS_MAX = 2 };

/* What is added to a picture: to the textbook's way, or to linear light with one sample and no effect. */
enum added { SAMPLES_4, SAMPLES_16, SAMPLES_64, LINEAR, OCCLUSION, GROUND, SHADOWS, EDGES, ALL };

static const struct {
    const char *name;
    enum added added;
    enum work_shade shade; /* of the textbook's way */
    bool is_linear;        /* what it is added to */
} rows[] = {
    {"4 samples", SAMPLES_4, WORK_FLAT, false},
    {"16 samples", SAMPLES_16, WORK_FLAT, false},
    {"64 samples", SAMPLES_64, WORK_FLAT, false},
    {"4 samples", SAMPLES_4, WORK_GOURAUD, false},
    {"16 samples", SAMPLES_16, WORK_GOURAUD, false},
    {"64 samples", SAMPLES_64, WORK_GOURAUD, false},
    {"pbr in linear light, no effect", LINEAR, WORK_GOURAUD, false},
    {"pbr, 16 samples", SAMPLES_16, WORK_GOURAUD, true},
    {"pbr, occlusion", OCCLUSION, WORK_GOURAUD, true},
    {"pbr, shadow on the ground", GROUND, WORK_GOURAUD, true},
    {"pbr, a lamp with shadows", SHADOWS, WORK_GOURAUD, true},
    {"pbr, edges", EDGES, WORK_GOURAUD, true},
    {"studio complete", ALL, WORK_GOURAUD, false},
};
enum { ROWS = sizeof rows / sizeof *rows };

struct task {
    const struct work *work;
    int row;
    int threads;
};

static void name_row(const struct task *task, char *name, size_t size)
{
    const struct variant variant = {rows[task->row].shade, true};
    char what[80];
    works_variant_name(task->work, &variant, what, sizeof what);
    snprintf(name, size, "%s: %.50s %dT %s", rows[task->row].name, what, task->threads, machine_isa_name());
}

void looks_make_linear(struct ours *ours)
{
    const struct zr_look *studio = zr_look_find("studio");
    struct zr_picture *picture = &ours->subject.picture;
    *picture = *studio->picture;
    picture->side = 1;
    picture->occlusion.is_on = picture->has_ground = picture->edges.is_on = false;
    ours->subject.materials[0].shading = ZR_SHADING_PBR;
    ours->subject.materials[0].roughness = studio->material.roughness;
}

static void add(struct ours *ours, enum added added)
{
    struct zr_picture *picture = &ours->subject.picture;
    if (added == SAMPLES_4) picture->side = 2;
    if (added == SAMPLES_16) picture->side = 4;
    if (added == SAMPLES_64) picture->side = 8;
    if (added == LINEAR || added == ALL) looks_make_linear(ours);
    if (added == ALL) *picture = *zr_look_find("studio")->picture;
    if (added == OCCLUSION) picture->occlusion.is_on = true;
    if (added == GROUND) picture->has_ground = true;
    if (added == EDGES) picture->edges.is_on = true;
}

/* Where shadows are added, the lamp that casts them is there without them, too. */
static void light_lamp(struct ours *ours, bool has_shadows)
{
    static struct zr_light lamps[SIDES];
    struct zr_light *lamp = &lamps[has_shadows ? WITH : WITHOUT];
    *lamp = (struct zr_light){.direction = {-0.6f, 0, -0.8f},
                              .color = {0.5f, 0.5f, 0.5f},
                              .lit = ZR_LIT_PBR,
                              .camera_frame = true,
                              .has_shadows = has_shadows};
    ours->subject.scene.lights = lamp;
    ours->subject.scene.light_count = 1;
}

static void take(struct ours *ours, const struct task *task, int side)
{
    ours_take(ours, task->work, &(struct variant){rows[task->row].shade, true});
    if (rows[task->row].is_linear) looks_make_linear(ours);
    if (rows[task->row].added == SHADOWS) light_lamp(ours, side == WITH);
    if (side == WITH) add(ours, rows[task->row].added);
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
    struct row row = {.ours_ms = series_median(&series[WITH]), .theirs_ms = series_median(&series[WITHOUT])};
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
        for (task.row = 0; task.row < ROWS; task.row++) {
            char name[ROW_NAME_SIZE];
            name_row(&task, name, sizeof name);
            if (!bench_wants(bench, name)) continue;
            results_begin_table(&bench->results, "samples, linear light, effects: \"theirs\" is ours without");
            bench_in_child(bench, measure, &task, NULL);
        }
    works_free(&work);
}
