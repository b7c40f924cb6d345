#include "bench/versus/versus_glsl.h"

#include <stdlib.h>

#include "base/run.h"
#include "bench/looks.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/shaded.h"
#include "bench/texels.h"
#include "bench/versus/likeness.h"
#include "bench/versus/sides.h"
#include "mesh/vertex_normals.h"
#include "scene/defaults.h"

enum { OURS, THEIRS, SIDES, THREADS_MAX = 2, IMAGE_SIDE = 1024 };

/* Colours may be so many steps of 255 apart: where all is as RULES.md says, and where it is timed, with the liberties
 * that compilers take; in one pixel of `one_in` they may be farther. Trilinear textures are sampled by a plain
 * texture2D on their side: its level is one for 2x2 pixels and comes from differences, ours from the derivatives at
 * each pixel. Both sides keep their levels. */
static const struct shading {
    const char *name;
    enum zr_shading shading;
    bool is_textured;
    int exact_steps, steps;
    size_t one_in;
    struct bar bar;
} shadings[] = {
    {"Phong", ZR_SHADING_PHONG, false, 0, 1, 1000, {4, 8}},
    {"pbr, a trilinear texture", ZR_SHADING_PBR, true, 1, 2, 100, {5, 8}},
};
enum { SHADINGS = sizeof shadings / sizeof *shadings };

static const enum works measured[] = {WORK_BUNNY, WORK_BUNNY_SMALL};

static const struct variant drawn = {WORK_GOURAUD, true};

struct task {
    const struct work *work;
    const struct shading *shading;
    int threads;
    bool wrong[BENCH_CHECKS_MAX];
};

static void name_row(const struct task *task, char *name, size_t size)
{
    snprintf(name, size, "%s %s culled %dT %s", task->shading->name, task->work->name, task->threads,
             machine_isa_name());
}

/* ---- the scene: both sides draw it ---- */

struct lit {
    struct ours ours;
    struct shaded theirs;
    struct zr_texture texture;
    struct zr_image image;
    struct zr_image_levels levels;
};

/* As a file would have brought them. Vertices of no face have some, too: where one is missing, all are computed. */
static bool give_normals(struct lit *lit)
{
    struct zr_mesh *mesh = &lit->ours.subject.mesh;
    struct zr_arena *arena = &lit->theirs.arena;
    const zr_vec4 *made = zr_vertex_normals_make(&(struct zr_run){.arena = arena}, mesh);
    zr_vec3 *normals = zr_arena_alloc(arena, mesh->position_count, sizeof *normals);
    for (uint32_t i = 0; made && normals && i < mesh->position_count; i++) {
        normals[i] = (zr_vec3){made[i].x, made[i].y, made[i].z};
        if (zr_normal_is_zero(normals[i])) normals[i].z = 1.0f;
    }
    mesh->normals = normals;
    mesh->normal_count = mesh->position_count;
    return made && normals;
}

/* Along z, twice over the height: so that two levels are mixed nearly everywhere. */
static bool give_texture(struct lit *lit)
{
    struct subject *subject = &lit->ours.subject;
    struct zr_mesh *mesh = &subject->mesh;
    zr_vec4 *texcoords = zr_arena_zero(&lit->theirs.arena, mesh->position_count, sizeof *texcoords);
    float low = mesh->positions[0].y, high = low;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        low = mesh->positions[i].y < low ? mesh->positions[i].y : low;
        high = mesh->positions[i].y > high ? mesh->positions[i].y : high;
    }
    for (uint32_t i = 0; texcoords && i < mesh->position_count; i++) {
        texcoords[i].x = 2.0f * mesh->positions[i].x / (high - low);
        texcoords[i].y = 2.0f * (high - mesh->positions[i].y) / (high - low);
    }
    lit->image = (struct zr_image){IMAGE_SIDE, IMAGE_SIDE, 8, texels_make(TEXELS_CLOUDS, IMAGE_SIDE), &lit->levels};
    lit->levels.texels = zr_arena_alloc(&lit->theirs.arena, zr_image_levels_bytes(&lit->image), 1);
    lit->texture = (struct zr_texture){.magnify = ZR_FILTER_LINEAR,
                                       .minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR,
                                       .is_color = true,
                                       .rows = {{1, 0, 0}, {0, 1, 0}}};
    mesh->texcoords = texcoords;
    subject->scene.images = &lit->image;
    subject->scene.textures = &lit->texture;
    subject->scene.image_count = subject->scene.texture_count = 1;
    subject->materials[0].textures[ZR_TEXTURE_BASE_COLOR] = 1;
    return texcoords && lit->image.texels && lit->levels.texels;
}

/* One lamp, and a surface that shines; or the environment of the look studio, with its tone mapping. */
static void give_light(struct lit *lit, enum zr_shading shading)
{
    static const struct zr_light lamp = {.direction = {-0.6f, 0, -0.8f}, .color = {1, 1, 1}};
    struct subject *subject = &lit->ours.subject;
    if (shading == ZR_SHADING_PBR) {
        looks_make_linear(&lit->ours);
        subject->picture.has_gradient = false;
        return;
    }
    subject->materials[0].shading = shading;
    subject->materials[0].specular = (zr_vec3){0.5f, 0.5f, 0.5f};
    subject->materials[0].shininess = zr_look_textbook()->material.shininess;
    subject->scene.ambient = zr_default_ambient_of_own_lights();
    subject->scene.lights = &lamp;
    subject->scene.light_count = 1;
}

static bool open_sides(struct lit *lit, const struct task *task, bool exact)
{
    if (!ours_open(&lit->ours, task->threads) || !shaded_open(&lit->theirs, exact, exact ? 1 : task->threads))
        return false;
    ours_take(&lit->ours, task->work, &drawn);
    give_light(lit, task->shading->shading);
    return give_normals(lit) && (!task->shading->is_textured || give_texture(lit)) &&
           shaded_take(&lit->theirs, &lit->ours.subject.scene);
}

/* ---- is it the same picture? ---- */

static bool find_likeness(struct lit *lit, int steps, struct likeness *likeness)
{
    const struct zr_frame *frame = ours_draw(&lit->ours, false);
    return frame && shaded_draw(&lit->theirs) && likeness_find(frame, lit->theirs.reference, steps, likeness);
}

static bool is_alike(const struct likeness *likeness, const struct shading *shading)
{
    return likeness->seen > 0 && likeness->off <= likeness->seen / shading->one_in;
}

static bool compare(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    static struct lit lit;
    const struct task *task = context;
    struct likeness likeness;
    struct row row = {.work = ""};
    if (!open_sides(&lit, task, true) || !find_likeness(&lit, task->shading->exact_steps, &likeness)) return false;
    row.wrong = !is_alike(&likeness, task->shading) || likeness.deep > 0;
    if (task->shading->exact_steps == 0) row.wrong |= likeness.off > 0;
    name_row(task, row.work, sizeof row.work);
    snprintf(row.note, sizeof row.note, "of %zu pixels %zu are %d steps off or more, %zu in depth", likeness.seen,
             likeness.off, task->shading->exact_steps + 1, likeness.deep);
    sink_row(sink, &row);
    return true;
}

/* ---- is it fast? ---- */

static bool run_round(void *context, struct series *series)
{
    struct lit *lit = context;
    double begin = now_ms();
    if (!shaded_draw(&lit->theirs)) return false;
    series_add(&series[THEIRS], now_ms() - begin);
    begin = now_ms();
    if (!ours_draw(&lit->ours, false)) return false;
    series_add(&series[OURS], now_ms() - begin);
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    static struct lit lit;
    const struct task *task = context;
    struct likeness likeness;
    if (!open_sides(&lit, task, false) || !series_run(series, SIDES, bench->rounds, run_round, &lit) ||
        !find_likeness(&lit, task->shading->steps, &likeness))
        return false;
    struct row row = {.ours_ms = series_median(&series[OURS]),
                      .theirs_ms = series_median(&series[THEIRS]),
                      .wrong = task->wrong[0] || !is_alike(&likeness, task->shading)};
    if (machine_has_bars())
        row.bar = (struct bar){task->shading->bar.must / machine_bar_divisor(),
                               task->shading->bar.goal / machine_bar_divisor()};
    snprintf(row.note, sizeof row.note, "%zu of %zu pixels are %d steps off or more", likeness.off, likeness.seen,
             task->shading->steps + 1);
    name_row(task, row.work, sizeof row.work);
    sink_row(sink, &row);
    return true;
}

static void run_shading(struct bench *bench, struct task *task)
{
    bool checked = false;
    for (task->threads = 1; task->threads <= THREADS_MAX; task->threads++) {
        char name[ROW_NAME_SIZE];
        name_row(task, name, sizeof name);
        if (!bench_wants(bench, name)) continue;
        if (!checked) bench_check_in_child(bench, compare, task, task->wrong);
        checked = true;
        if (bench->check_only) return;
        results_begin_table(&bench->results, "shaded pixel by pixel, against llvmpipe running the same as GLSL");
        bench_in_child(bench, measure, task, NULL);
    }
}

void versus_glsl(struct bench *bench)
{
    for (size_t w = 0; w < sizeof measured / sizeof *measured; w++) {
        struct work work;
        if (!works_make(measured[w], bench->models, &work)) bench->results.failed = true;
        for (int i = 0; work.corners && i < SHADINGS; i++)
            run_shading(bench, &(struct task){.work = &work, .shading = &shadings[i]});
        works_free(&work);
    }
}
