#include "bench/versus/versus_cjson.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

#include "base/run.h"
#include "base/team.h"
#include "bench/input/documents.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/works.h"
#include "core.h"
#include "render_request.h"
#include "scene/scene.h"

/* Ours in an arena that is warm, in a new one, and in a warm one by two threads; cJSON. */
enum { WARM, FRESH, SHARED, WAYS, THEIRS = WAYS, SIDES };
static const char *const ways[WAYS] = {"warm arena 1T", "new arena 1T", "warm arena 2T"};

static const size_t ARENA_BYTES = (size_t)4 << 30;
static const struct bar time_bar = {12, 20}, memory_bar = {1.5, 1.1};

static struct document make_indexed(const struct drawing *drawing)
{
    return document_indexed(drawing, false);
}

/* Only JSON can be read by both; files of other formats are measured against the same triangles as indexed JSON. */
static const struct {
    enum zr_format format;
    const char *name, *kind;
    struct document (*make)(const struct drawing *drawing);
} forms[] = {{ZR_FORMAT_JSON, "JSON", "soup", document_soup},
             {ZR_FORMAT_JSON, "JSON", "indexed", make_indexed},
             {ZR_FORMAT_JSON, "JSON", "indexed 17 digits", document_digits},
             {ZR_FORMAT_JSON, "JSON", "indexed spaced", document_spaced},
             {ZR_FORMAT_OBJ, "OBJ", "text", document_obj},
             {ZR_FORMAT_STL, "STL", "text", document_stl_text},
             {ZR_FORMAT_STL, "STL", "binary", document_stl},
             {ZR_FORMAT_PLY, "PLY", "text", document_ply_text},
             {ZR_FORMAT_PLY, "PLY", "binary", document_ply}};
enum { FORMS = sizeof forms / sizeof forms[0] };

struct task {
    const struct work *work;
    int form;
    bool wanted[WAYS];
};

static void name_row(const struct task *task, int way, char *name, size_t size)
{
    snprintf(name, size, "%s of %u triangles, %s, %s %s", forms[task->form].name, task->work->drawing.face_count,
             forms[task->form].kind, ways[way], machine_isa_name());
}

static size_t bytes_of(const void *array, size_t count, size_t size)
{
    return array ? count * size : 0;
}

/* What a scene of meshes cannot do without. */
static size_t array_bytes(const struct zr_scene *scene)
{
    size_t sum = 0;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const struct zr_mesh *m = &scene->meshes[i];
        size_t rings = m->face_rings ? m->face_rings[m->face_count] : 0;
        sum += bytes_of(m->positions, m->position_count, sizeof *m->positions) +
               bytes_of(m->colors, m->position_count, sizeof *m->colors) +
               bytes_of(m->face_offsets, m->face_count + (size_t)1, sizeof *m->face_offsets) +
               bytes_of(m->indices, m->face_offsets[m->face_count], sizeof *m->indices) +
               bytes_of(m->face_rings, m->face_count + (size_t)1, sizeof *m->face_rings) +
               bytes_of(m->ring_offsets, rings + 1, sizeof *m->ring_offsets) +
               bytes_of(m->normals, m->normal_count, sizeof *m->normals) +
               bytes_of(m->face_colors, m->face_count, sizeof *m->face_colors) +
               bytes_of(m->face_materials, m->face_count, sizeof *m->face_materials);
    }
    return sum;
}

/* NULL on failure, of which nothing is said where memory alone was short. */
static const struct zr_scene *read_scene(struct zr_arena *arena, struct zr_team *team, enum zr_format format,
                                         const struct document *document)
{
    struct zr_limits limits = zr_limits_default();
    struct zr_request request = {.format = format, .bytes = document->bytes, .size = document->size};
    struct zr_error error = {.status = ZR_OK};
    const struct zr_scene *scene = NULL;
    enum zr_status status =
        zr_scene_read(&(struct zr_run){.arena = arena, .team = team, .error = &error}, &request, &limits, &scene);
    if (status == ZR_OK) return scene;
    if (status != ZR_NO_MEMORY) bench_complain("zr_scene_read: %s: %s", error.items[0].pointer, error.items[0].detail);
    return NULL;
}

/* The same triangles, as many, with the same corners. */
static bool is_right(const struct zr_scene *scene, const struct drawing *drawing)
{
    const struct zr_mesh *mesh = scene->meshes;
    if (scene->mesh_count != 1 || mesh->face_count != drawing->face_count) return false;
    if (mesh->face_offsets[mesh->face_count] != drawing->corner_count) return false;
    for (uint32_t i = 0; i < drawing->corner_count; i++) {
        zr_vec4 a = mesh->positions[mesh->indices[i]], b = drawing->positions[drawing->indices[i]];
        if (fabsf(a.x - b.x) > 1e-5f || fabsf(a.y - b.y) > 1e-5f || fabsf(a.z - b.z) > 1e-5f) return false;
    }
    return true;
}

struct reading {
    const struct task *task;
    const struct document *document, *json; /* ours to read, and theirs */
    struct zr_arena warm;
    struct zr_team *team;
};

static bool run_round(void *context, struct series *series)
{
    struct reading *reading = context;
    const struct document *document = reading->document, *json = reading->json;
    const enum zr_format format = forms[reading->task->form].format;
    double begin = now_ms();
    cJSON *tree = cJSON_ParseWithLength(json->bytes, json->size);
    cJSON_Delete(tree);
    series_add(&series[THEIRS], now_ms() - begin);
    bool ok = tree != NULL;
    for (int way = 0; ok && way < WAYS; way++) {
        struct zr_arena cold;
        if (!reading->task->wanted[way]) continue;
        zr_arena_init(&cold, ARENA_BYTES);
        begin = now_ms();
        struct zr_arena *arena = way == FRESH ? &cold : &reading->warm;
        if (way != FRESH) zr_arena_reset(arena, ARENA_BYTES);
        ok = read_scene(arena, way == SHARED ? reading->team : NULL, format, document) != NULL;
        if (way == FRESH) zr_arena_free(arena);
        series_add(&series[way], now_ms() - begin);
    }
    return ok;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    const struct drawing *drawing = &task->work->drawing;
    const enum zr_format format = forms[task->form].format;
    const bool is_json = format == ZR_FORMAT_JSON;
    struct document document = forms[task->form].make(drawing), indexed = {NULL, 0};
    struct reading reading = {.task = task, .document = &document, .json = is_json ? &document : &indexed};
    if (!is_json) indexed = make_indexed(drawing);
    zr_arena_init(&reading.warm, ARENA_BYTES);
    reading.team = zr_team_create_for(2, machine_isa());
    const struct zr_scene *scene = document.bytes && reading.json->bytes && reading.team
                                       ? read_scene(&reading.warm, reading.team, format, &document)
                                       : NULL;
    if (!scene) return false;
    double needed = (double)reading.warm.peak;
    size_t arrays = array_bytes(scene);
    bool wrong = !is_right(scene, drawing);
    if (!bench->check_only && !series_run(series, SIDES, bench->rounds, run_round, &reading)) return false;
    for (int way = 0; way < WAYS; way++) {
        struct row row = {.ours_ms = series_median(&series[way]),
                          .theirs_ms = series_median(&series[THEIRS]),
                          .side = ROW_MEMORY,
                          .side_ratio = needed / (double)arrays,
                          .wrong = wrong};
        if (way == WARM && is_json) row.bar = time_bar, row.side_bar = memory_bar;
        name_row(task, way, row.work, sizeof row.work);
        if (bench->check_only)
            snprintf(row.note, sizeof row.note, "the scene has %sthe mesh's triangles", wrong ? "not " : "");
        else
            snprintf(row.note, sizeof row.note, "%.1f MB%s", (double)document.size / 1e6,
                     is_json ? " of JSON" : "; theirs is indexed JSON");
        if (task->wanted[way]) sink_row(sink, &row);
    }
    zr_arena_free(&reading.warm);
    zr_team_destroy(reading.team);
    free(document.bytes);
    free(indexed.bytes);
    return true;
}

void versus_cjson(struct bench *bench)
{
    struct work work;
    struct task task = {.work = &work};
    if (!works_make(WORK_BUNNY, bench->models, &work)) bench->results.failed = true;
    for (task.form = 0; task.form < FORMS && work.corners; task.form++) {
        for (int way = 0; way < WAYS; way++) {
            char name[ROW_NAME_SIZE];
            name_row(&task, way, name, sizeof name);
            task.wanted[way] = bench_wants(bench, name);
        }
        if (!task.wanted[WARM] && !task.wanted[FRESH] && !task.wanted[SHARED]) continue;
        if (bench->check_only) {
            bench_check_in_child(bench, measure, &task, NULL);
            continue;
        }
        results_begin_table(&bench->results, "zr_scene_read against cJSON's parse and delete");
        bench_in_child(bench, measure, &task, NULL);
    }
    works_free(&work);
}
