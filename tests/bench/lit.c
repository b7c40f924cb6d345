/* A lit mesh seen by a view that is fitted to it, as it is drawn when it is posted by itself, against the same unlit,
 * in the colours of the other tables, through the matrices that such a view comes to; and its depth map alone, for
 * which nothing need be lit, against its picture alone. */
#include "base/run.h"
#include "bench/growth.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"
#include "scene/camera/camera.h"
#include "scene/camera/resolved_view.h"
#include "scene/defaults.h"
#include "support/pictures/look.h"

enum { PLAIN, LIT, DEPTH, SIDES };
enum { THREADS_MOST = 2 };

static const enum works measured[] = {WORK_BUNNY, WORK_BUNNY_SMALL, WORK_DENSE};
static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
static const struct zr_output depth = {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_NPY};

struct task {
    const struct work *work;
    int threads;
    enum work_shade shade;
};

static void name_row(const struct task *task, const char *what, char *name, size_t size)
{
    char drawn[80];
    works_variant_name(task->work, &(struct variant){task->shade, false}, drawn, sizeof drawn);
    snprintf(name, size, "lit and fitted%s: %.60s %dT %s", what, drawn, task->threads, machine_isa_name());
}

/* Into a side's own subject, which points into itself. */
static bool take(struct ours *ours, const struct task *task, bool lit)
{
    struct subject *subject = &ours->subject;
    struct zr_scene defaults;
    struct zr_camera camera;
    struct zr_error error = {.status = ZR_OK};
    zr_scene_defaults(&defaults);
    ours_take(ours, task->work, &(struct variant){task->shade, false});
    scene_look(&subject->scene, defaults.views[0]);
    if (lit) {
        subject->mesh.colors = subject->mesh.face_colors = NULL;
        subject->materials[0].base_color = zr_default_base_color(defaults.look, false);
        subject->materials[0].shading = zr_default_shading(defaults.look, task->shade != WORK_FLAT);
        subject->scene.ambient = defaults.ambient;
        subject->scene.lights = defaults.lights;
        subject->scene.light_count = defaults.light_count;
        return true;
    }
    const struct zr_bounds bounds = zr_bounds_of(&subject->scene, NULL, NULL);
    if (zr_camera_resolve(&(struct zr_run){.error = &error}, &subject->scene, &subject->scene.views[0], &bounds,
                          &camera) != ZR_OK)
        return false;
    subject->scene.views[0].pose = ZR_POSE_MATRIX;
    subject->scene.views[0].projection = ZR_PROJECTION_MATRIX;
    subject->scene.views[0].world_to_camera = camera.world_to_eye;
    subject->scene.views[0].projection_matrix = camera.projection;
    return true;
}

static bool run_round(void *context, struct series *series)
{
    struct ours *ours = context;
    for (int side = PLAIN; side < SIDES; side++) {
        double begin = now_ms();
        if (!ours_render(&ours[side], side == DEPTH ? &depth : &color, 1)) return false;
        series_add(&series[side], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    struct ours ours[SIDES];
    for (int side = PLAIN; side < SIDES; side++)
        if (!ours_open(&ours[side], task->threads) || !take(&ours[side], task, side != PLAIN)) return false;
    if (!series_run(series, SIDES, bench->rounds, run_round, ours)) return false;
    struct row lit = {.ours_ms = series_median(&series[LIT]), .theirs_ms = series_median(&series[PLAIN])};
    struct row alone = {.ours_ms = series_median(&series[DEPTH]), .theirs_ms = series_median(&series[LIT])};
    name_row(task, "", lit.work, sizeof lit.work);
    name_row(task, ", depth alone", alone.work, sizeof alone.work);
    sink_row(sink, &lit);
    sink_row(sink, &alone);
    return true;
}

static void measure_work(struct bench *bench, const struct work *work)
{
    for (int i = 0; i < THREADS_MOST * WORK_SHADES; i++) {
        struct task task = {work, 1 + i / WORK_SHADES, (enum work_shade)(i % WORK_SHADES)};
        char name[ROW_NAME_SIZE];
        name_row(&task, "", name, sizeof name);
        if (task.threads > machine_cores() || !bench_wants(bench, name)) continue;
        results_begin_table(
            &bench->results,
            "lit and fitted: \"theirs\" is ours unlit, through matrices; of depth alone, ours with colours alone");
        bench_in_child(bench, measure, &task, NULL);
    }
}

void growth_of_light(struct bench *bench)
{
    if (bench->check_only) return;
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        struct work work;
        if (!works_make(measured[i], bench->models, &work)) bench->results.failed = true;
        if (work.corners) measure_work(bench, &work);
        works_free(&work);
    }
}
