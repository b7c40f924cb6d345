#include "bench/input/formats.h"

#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "bench/input/documents.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/works.h"
#include "core.h"
#include "render_request.h"
#include "request/change.h"

static const size_t ARENA_BYTES = (size_t)4 << 30;

enum side { READ_AND_DRAW, COPY_AND_DRAW, POSE_AND_DRAW, DRAW };

/* A row: two requests with the same picture. */
static const struct {
    const char *name;
    bool is_dense; /* 1.1 M triangles, else 69 k */
    struct document (*file[2])(const struct drawing *drawing);
    const char *look[2]; /* clay: smooth normals; textbook: flat */
    enum side side[2];
    double most; /* bar: ours / theirs */
} rows[] = {
    {"GLB against binary STL",
     false,
     {document_glb, document_stl},
     {"clay", "clay"},
     {READ_AND_DRAW, READ_AND_DRAW},
     1.0},
    {"binary PLY against STL",
     false,
     {document_ply, document_stl},
     {"clay", "clay"},
     {READ_AND_DRAW, READ_AND_DRAW},
     1.0},
    {"GLB against memcpy and drawing",
     true,
     {document_glb, document_glb},
     {"textbook", "textbook"},
     {READ_AND_DRAW, COPY_AND_DRAW},
     1.5},
    {"smooth STL against flat",
     true,
     {document_stl, document_stl},
     {"clay", "textbook"},
     {READ_AND_DRAW, READ_AND_DRAW},
     2.0},
    {"another pose against drawing",
     true,
     {document_glb, document_glb},
     {"textbook", "textbook"},
     {POSE_AND_DRAW, DRAW},
     1.15},
};
enum { ROWS = sizeof rows / sizeof *rows };

struct task {
    const struct drawing *drawing;
    int row;
};

/* One side of a row. */
struct contest {
    enum side side;
    struct document file;
    struct zr_request request;
    struct zr_asset asset; /* the file, for a scene that names it as a mesh */
    struct zr_arena arena, kept_arena;
    struct zr_kept *kept;
    const struct zr_scene *scene; /* read before */
    char *copy;
};

static const char posed[] = "{\"shading\":\"flat\",\"window\":{\"width\":512,\"height\":512},"
                            "\"nodes\":[{\"name\":\"n\",\"mesh\":0}],\"meshes\":[{\"asset\":\"m\"}]}";
static const char pose[] = "{\"poses\":{\"n\":[[0.8,0,0.6,0],[0,1,0,0],[-0.6,0,0.8,0],[0,0,0,1]]}}";

static bool complain(const char *what, const struct zr_error *error)
{
    return bench_complain("%s: %s: %s", what, error->items[0].pointer, error->items[0].detail);
}

static bool open_contest(struct contest *contest, int row, int which, const struct drawing *drawing)
{
    const struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.status = ZR_OK};
    const bool is_flat = strcmp(rows[row].look[which], "textbook") == 0;
    contest->side = rows[row].side[which];
    contest->file = rows[row].file[which](drawing);
    if (!contest->file.bytes) return false;
    contest->request = (struct zr_request){.format = ZR_FORMAT_UNKNOWN,
                                           .bytes = contest->file.bytes,
                                           .size = contest->file.size,
                                           .look = rows[row].look[which],
                                           .shading = is_flat ? "flat" : NULL,
                                           .samples = is_flat ? NULL : "1",
                                           .occlusion = is_flat ? NULL : "false",
                                           .groundShadow = is_flat ? NULL : "false",
                                           .edges = is_flat ? NULL : "false",
                                           .width = "512",
                                           .height = "512",
                                           .up = "y"};
    if (rows[row].side[0] == POSE_AND_DRAW) {
        contest->asset = (struct zr_asset){.name = "m", .bytes = contest->file.bytes, .size = contest->file.size};
        contest->request = (struct zr_request){.format = ZR_FORMAT_JSON,
                                               .bytes = posed,
                                               .size = sizeof posed - 1,
                                               .assets = &contest->asset,
                                               .asset_count = 1};
    }
    zr_arena_init(&contest->arena, ARENA_BYTES);
    zr_arena_init(&contest->kept_arena, ARENA_BYTES);
    contest->copy = malloc(contest->file.size);
    if (!contest->copy) return false;
    if (zr_scene_keep(&(struct zr_run){.arena = &contest->kept_arena, .error = &error}, &contest->request, &limits,
                      &contest->kept) != ZR_OK)
        return complain("zr_scene_keep", &error);
    contest->scene = zr_kept_scene(contest->kept);
    return true;
}

static void close_contest(struct contest *contest)
{
    zr_arena_free(&contest->arena);
    zr_arena_free(&contest->kept_arena);
    free(contest->file.bytes);
    free(contest->copy);
}

static bool run(struct contest *contest)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_request change = {.bytes = pose, .size = sizeof pose - 1};
    struct zr_error error = {.status = ZR_OK};
    const struct zr_scene *scene = contest->scene;
    const struct zr_frame *frame;
    zr_arena_reset(&contest->arena, ARENA_BYTES);
    if (contest->side == READ_AND_DRAW && zr_scene_read(&(struct zr_run){.arena = &contest->arena, .error = &error},
                                                        &contest->request, &limits, &scene) != ZR_OK)
        return complain("zr_scene_read", &error);
    if (contest->side == POSE_AND_DRAW && zr_scene_change(&(struct zr_run){.arena = &contest->arena, .error = &error},
                                                          contest->kept, &change, &scene) != ZR_OK)
        return complain("zr_scene_change", &error);
    if (contest->side == COPY_AND_DRAW) memcpy(contest->copy, contest->file.bytes, contest->file.size);
    return zr_render(&(struct zr_run){.arena = &contest->arena, .error = &error}, scene, NULL, &frame) == ZR_OK ||
           complain("zr_render", &error);
}

static bool run_round(void *context, struct series *series)
{
    struct contest *contests = context;
    for (int i = 0; i < 2; i++) {
        const double begin = now_ms();
        if (!run(&contests[i])) return false;
        series_add(&series[i], now_ms() - begin);
    }
    return true;
}

static void name_row(const struct task *task, char *name, size_t size)
{
    snprintf(name, size, "%s, %s triangles, 1T %s", rows[task->row].name, rows[task->row].is_dense ? "1.1 M" : "69 k",
             machine_isa_name());
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[2];
    const struct task *task = context;
    static struct contest contests[2];
    for (int i = 0; i < 2; i++)
        if (!open_contest(&contests[i], task->row, i, task->drawing)) return false;
    if (!series_run(series, 2, bench->rounds, run_round, contests)) return false;
    struct row row = {.ours_ms = series_median(&series[0]),
                      .theirs_ms = series_median(&series[1]),
                      .bar = {1.0 / rows[task->row].most, 10}};
    name_row(task, row.work, sizeof row.work);
    snprintf(row.note, sizeof row.note, "%.1f MB", (double)contests[0].file.size / 1e6);
    sink_row(sink, &row);
    for (int i = 0; i < 2; i++)
        close_contest(&contests[i]);
    return true;
}

void formats_against_each_other(struct bench *bench)
{
    struct work works[2] = {{.corners = NULL}};
    bool has_begun = false;
    for (int i = 0; i < ROWS; i++) {
        struct work *work = &works[rows[i].is_dense];
        struct task task = {.row = i};
        char name[ROW_NAME_SIZE];
        name_row(&task, name, sizeof name);
        if (bench->check_only || !bench_wants(bench, name)) continue;
        if (!work->corners &&
            !works_make(rows[i].is_dense ? WORK_DENSE_SMALL : WORK_BUNNY_SMALL, bench->models, work)) {
            bench->results.failed = true;
            break;
        }
        if (!has_begun) results_begin_table(&bench->results, "files of one mesh: zr_scene_read and zr_render");
        has_begun = true;
        task.drawing = &work->drawing;
        bench_in_child(bench, measure, &task, NULL);
    }
    for (int i = 0; i < 2; i++)
        works_free(&works[i]);
}
