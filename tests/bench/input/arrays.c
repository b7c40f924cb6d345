#include "bench/input/arrays.h"

#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "bench/input/documents.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/works.h"
#include "core.h"
#include "render_request.h"
#include "scene/scene.h"
#include "support/input/npy.h"

enum { NPY, COPIED, LENT, DOUBLES, WAYS, THEIRS = WAYS, SIDES };
static const char *const ways[WAYS] = {"NPY of f4 and u4", "arrays of f4 and u4", "lent arrays of f4 and u4",
                                       "arrays of f8 and i8"};
static const struct bar bars[WAYS] = {[NPY] = {1 / 0.15, 10}};

static const size_t ARENA_BYTES = (size_t)4 << 30;
static const char scene_text[] = "{\"outputs\":[{\"channel\":\"color\"}],\"view\":{\"eye\":[0,0,9]},\"shading\":"
                                 "\"unlit\",\"meshes\":[{\"doubleSided\":true,\"positions\":{\"asset\":\"p\"},"
                                 "\"faces\":{\"asset\":\"f\"}}]}";

/* Positions and faces of a drawing, which are triangles. */
struct numbers {
    float *f4;
    double *f8;
    long long *i8;
    char *p, *f; /* NPY files */
    size_t p_size, f_size;
};

struct task {
    const struct work *work;
    bool wanted[WAYS];
};

struct reading {
    const struct task *task;
    struct document json;
    struct zr_asset assets[WAYS][2];
    struct zr_arena arena;
};

static void name_row(const struct task *task, int way, char *name, size_t size)
{
    snprintf(name, size, "%s, %u triangles, against JSON 1T %s", ways[way], task->work->drawing.face_count,
             machine_isa_name());
}

static bool make_numbers(const struct drawing *drawing, struct numbers *out)
{
    const size_t rows = drawing->position_count, corners = drawing->corner_count;
    char shape[64];
    out->f4 = calloc(3 * rows, sizeof *out->f4);
    out->f8 = calloc(3 * rows, sizeof *out->f8);
    out->i8 = calloc(corners, sizeof *out->i8);
    if (!out->f4 || !out->f8 || !out->i8) return false;
    for (size_t i = 0; i < 3 * rows; i++) {
        out->f4[i] = (&drawing->positions[i / 3].x)[i % 3];
        out->f8[i] = (double)out->f4[i];
    }
    for (size_t i = 0; i < corners; i++)
        out->i8[i] = drawing->indices[i];
    snprintf(shape, sizeof shape, "(%zu, 3)", rows);
    out->p = npy_file("<f4", "False", shape, out->f4, 12 * rows, &out->p_size);
    snprintf(shape, sizeof shape, "(%zu, 3)", corners / 3);
    out->f = npy_file("<u4", "False", shape, drawing->indices, 4 * corners, &out->f_size);
    return out->p && out->f;
}

static struct zr_asset array_asset(const char *name, enum zr_number_type type, const void *data, size_t numbers,
                                   bool is_lent)
{
    return (struct zr_asset){.name = name, .array = {data, type, 2, {numbers / 3, 3}}, .is_lent = is_lent};
}

static void make_assets(const struct drawing *drawing, const struct numbers *n, struct zr_asset assets[WAYS][2])
{
    const size_t p = 3 * (size_t)drawing->position_count, f = drawing->corner_count;
    assets[NPY][0] = (struct zr_asset){.name = "p", .bytes = n->p, .size = n->p_size};
    assets[NPY][1] = (struct zr_asset){.name = "f", .bytes = n->f, .size = n->f_size};
    for (int way = COPIED; way <= LENT; way++) {
        assets[way][0] = array_asset("p", ZR_F4, n->f4, p, way == LENT);
        assets[way][1] = array_asset("f", ZR_U4, drawing->indices, f, way == LENT);
    }
    assets[DOUBLES][0] = array_asset("p", ZR_F8, n->f8, p, false);
    assets[DOUBLES][1] = array_asset("f", ZR_I8, n->i8, f, false);
}

static const struct zr_scene *read_scene(struct reading *reading, int way)
{
    const struct zr_limits limits = zr_limits_default();
    struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = reading->json.bytes, .size = reading->json.size};
    struct zr_error error = {.status = ZR_OK};
    const struct zr_scene *scene = NULL;
    if (way < WAYS) {
        request.bytes = scene_text;
        request.size = sizeof scene_text - 1;
        request.assets = reading->assets[way];
        request.asset_count = 2;
    }
    zr_arena_reset(&reading->arena, ARENA_BYTES);
    if (zr_scene_read(&(struct zr_run){.arena = &reading->arena, .error = &error}, &request, &limits, &scene) != ZR_OK)
        bench_complain("zr_scene_read: %s: %s", error.items[0].pointer, error.items[0].detail);
    return scene;
}

/* True if the scene has the floats and the corners of the drawing. */
static bool is_right(const struct zr_scene *scene, const struct drawing *drawing)
{
    const struct zr_mesh *mesh = scene ? scene->meshes : NULL;
    return mesh && mesh->face_count == drawing->face_count &&
           memcmp(mesh->indices, drawing->indices, drawing->corner_count * sizeof *mesh->indices) == 0 &&
           memcmp(mesh->face_offsets, drawing->face_offsets, drawing->face_count * sizeof *mesh->face_offsets) == 0 &&
           memcmp(&mesh->positions[mesh->indices[0]], &drawing->positions[drawing->indices[0]], sizeof(zr_vec4)) == 0;
}

static bool run_round(void *context, struct series *series)
{
    struct reading *reading = context;
    for (int way = 0; way < SIDES; way++) {
        if (way < WAYS && !reading->task->wanted[way]) continue;
        const double begin = now_ms();
        if (!read_scene(reading, way)) return false;
        series_add(&series[way], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    const struct drawing *drawing = &task->work->drawing;
    struct numbers numbers = {.f4 = NULL};
    struct reading reading = {.task = task, .json = document_indexed(drawing, false)};
    bool wrong[WAYS];
    zr_arena_init(&reading.arena, ARENA_BYTES);
    if (!reading.json.bytes || !make_numbers(drawing, &numbers)) return false;
    make_assets(drawing, &numbers, reading.assets);
    for (int way = 0; way < WAYS; way++)
        wrong[way] = !is_right(read_scene(&reading, way), drawing);
    if (!bench->check_only && !series_run(series, SIDES, bench->rounds, run_round, &reading)) return false;
    for (int way = 0; way < WAYS; way++) {
        struct row row = {.ours_ms = series_median(&series[way]),
                          .theirs_ms = series_median(&series[THEIRS]),
                          .bar = bars[way],
                          .wrong = wrong[way]};
        name_row(task, way, row.work, sizeof row.work);
        snprintf(row.note, sizeof row.note, "%.1f MB, JSON %.1f MB",
                 (double)(way == DOUBLES ? 2 : 1) * (double)(numbers.p_size + numbers.f_size) / 1e6,
                 (double)reading.json.size / 1e6);
        if (task->wanted[way]) sink_row(sink, &row);
    }
    zr_arena_free(&reading.arena);
    return true;
}

void arrays_against_json(struct bench *bench)
{
    struct work work;
    struct task task = {.work = &work};
    bool any = false;
    if (!works_make(WORK_BUNNY, bench->models, &work)) bench->results.failed = true;
    for (int way = 0; way < WAYS && work.corners; way++) {
        char name[ROW_NAME_SIZE];
        name_row(&task, way, name, sizeof name);
        any |= task.wanted[way] = bench_wants(bench, name);
    }
    if (any && bench->check_only) bench_check_in_child(bench, measure, &task, NULL);
    if (any && !bench->check_only) {
        results_begin_table(&bench->results, "a mesh as arrays against JSON: zr_scene_read");
        bench_in_child(bench, measure, &task, NULL);
    }
    works_free(&work);
}
