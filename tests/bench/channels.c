/* What a channel, a shading or fog takes: a picture with it against the same picture without it. */
#include "bench/growth.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"
#include "scene/defaults.h"

enum { WITHOUT, WITH, SIDES };

/* The picture and `beside` it, against the picture and `instead`. Colour stands for itself, and is drawn once. */
struct pair {
    const char *name;
    enum works work;
    enum zr_channel beside, instead;
    enum zr_shading shading[SIDES]; /* ZR_SHADING_UNLIT: colours as they are */
    bool in_fog;
    struct bar bar;
};

#define PICTURE ZR_CHANNEL_COLOR
#define UNLIT                                                                                                          \
    {                                                                                                                  \
        ZR_SHADING_UNLIT, ZR_SHADING_UNLIT                                                                             \
    }
static const struct pair pairs[] = {
    {"metric depth", WORK_BUNNY, ZR_CHANNEL_DEPTH, ZR_CHANNEL_WINDOW_DEPTH, UNLIT, false, {0, 0}},
    {"metric depth", WORK_DENSE, ZR_CHANNEL_DEPTH, ZR_CHANNEL_WINDOW_DEPTH, UNLIT, false, {0, 0}},
    {"metric depth", WORK_CUBE, ZR_CHANNEL_DEPTH, ZR_CHANNEL_WINDOW_DEPTH, UNLIT, false, {0, 0}},
    {"faceId", WORK_BUNNY, ZR_CHANNEL_FACE_ID, PICTURE, UNLIT, false, {0, 0}},
    {"instanceId", WORK_BUNNY, ZR_CHANNEL_INSTANCE_ID, PICTURE, UNLIT, false, {0, 0}},
    {"frontFacing", WORK_BUNNY, ZR_CHANNEL_FRONT_FACING, PICTURE, UNLIT, false, {0, 0}},
    {"normals", WORK_BUNNY, ZR_CHANNEL_NORMALS, PICTURE, UNLIT, false, {0, 0}},
    {"distance", WORK_BUNNY, ZR_CHANNEL_DISTANCE, PICTURE, UNLIT, false, {0.5, 0}},
    {"position", WORK_BUNNY, ZR_CHANNEL_POSITION, PICTURE, UNLIT, false, {0.5, 0}},
    {"barycentrics", WORK_BUNNY, ZR_CHANNEL_BARYCENTRICS, PICTURE, UNLIT, false, {0.5, 0}},
    {"lit", WORK_BUNNY, PICTURE, PICTURE, {ZR_SHADING_UNLIT, ZR_SHADING_GOURAUD}, false, {0, 0}},
    {"phong against lit", WORK_BUNNY, PICTURE, PICTURE, {ZR_SHADING_GOURAUD, ZR_SHADING_PHONG}, false, {0.5, 0}},
    {"fog", WORK_BUNNY, PICTURE, PICTURE, UNLIT, true, {0, 0}},
    {"lit fog", WORK_BUNNY, PICTURE, PICTURE, {ZR_SHADING_GOURAUD, ZR_SHADING_GOURAUD}, true, {0, 0}},
};

struct task {
    const struct work *work;
    const struct pair *pair;
};

static const struct variant drawn = {WORK_GOURAUD, true};

static void name_row(const struct task *task, char *name, size_t size)
{
    char what[80];
    works_variant_name(task->work, &drawn, what, sizeof what);
    snprintf(name, size, "%s: %.60s 1T %s", task->pair->name, what, machine_isa_name());
}

/* One lamp, and a surface that shines. */
static void take(struct ours *ours, const struct task *task, int side)
{
    static const struct zr_light lamp = {.direction = {-0.6f, 0, -0.8f}, .color = {1, 1, 1}};
    struct subject *subject = &ours->subject;
    ours_take(ours, task->work, &drawn);
    if (task->pair->in_fog && side == WITH)
        subject->scene.fog = (struct zr_fog){.is_on = true, .color = {1, 1, 1}, .near = 0, .far = 10};
    if (task->pair->shading[side] == ZR_SHADING_UNLIT) return;
    subject->materials[0].shading = task->pair->shading[side];
    subject->materials[0].specular = (zr_vec3){0.5f, 0.5f, 0.5f};
    subject->materials[0].shininess = zr_look_textbook()->material.shininess;
    subject->scene.ambient = zr_default_ambient_of_own_lights();
    subject->scene.lights = &lamp;
    subject->scene.light_count = 1;
}

struct measuring {
    const struct pair *pair;
    struct ours ours[SIDES];
};

static bool run_round(void *context, struct series *series)
{
    struct measuring *m = context;
    for (int side = WITHOUT; side < SIDES; side++) {
        const enum zr_channel second = side == WITH ? m->pair->beside : m->pair->instead;
        const struct zr_output outputs[2] = {{.channel = PICTURE, .encoding = ZR_ENCODING_PNG},
                                             {.channel = second, .encoding = ZR_ENCODING_NPY}};
        double begin = now_ms();
        if (!ours_render(&m->ours[side], outputs, second == PICTURE ? 1 : 2)) return false;
        series_add(&series[side], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    static struct measuring measuring;
    const struct task *task = context;
    measuring.pair = task->pair;
    for (int side = WITHOUT; side < SIDES; side++) {
        if (!ours_open(&measuring.ours[side], 1)) return false;
        take(&measuring.ours[side], task, side);
    }
    if (!series_run(series, SIDES, bench->rounds, run_round, &measuring)) return false;
    struct row row = {
        .ours_ms = series_median(&series[WITH]), .theirs_ms = series_median(&series[WITHOUT]), .bar = task->pair->bar};
    name_row(task, row.work, sizeof row.work);
    sink_row(sink, &row);
    return true;
}

void growth_of_channels(struct bench *bench)
{
    if (bench->check_only) return;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        struct work work;
        struct task task = {&work, &pairs[i]};
        char name[ROW_NAME_SIZE];
        if (!works_make(pairs[i].work, bench->models, &work)) bench->results.failed = true;
        name_row(&task, name, sizeof name);
        if (work.corners && bench_wants(bench, name)) {
            results_begin_table(&bench->results, "channels and shadings: \"theirs\" is ours without (of metric "
                                                 "depth: with the window's depth)");
            bench_in_child(bench, measure, &task, NULL);
        }
        works_free(&work);
    }
}
