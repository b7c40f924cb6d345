/* Whole requests at 512x512: looks of the bunny to PNG, against its plain flat picture; lines of the mesh against those
 * of samples, and as SVG. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/http/wire.h"
#include "bench/looks.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/works.h"
#include "reference/models.h"
#include "server/support/daemon.h"

enum { OURS, THEIRS, SIDES };

#define FLAT                                                                                                           \
    "\"shading\":\"flat\",\"view\":{\"azimuthDegrees\":35,\"elevationDegrees\":28,\"perspective\":{\"yfovDegrees\":"   \
    "30},"                                                                                                             \
    "\"fit\":{\"padding\":0.07}}"
#define LOOK(name) "\"look\":\"" name "\""
#define SVG        ",\"outputs\":[{\"channel\":\"color\",\"encoding\":\"svg\"}]"

/* Keys of the scenes of both sides. */
static const struct {
    const char *name, *mesh; /* mesh: a model; NULL: the animal of works.h */
    const char *ours, *theirs;
    struct bar bar;
} looks[] = {
    {"studio of %.30s to PNG against flat", NULL, LOOK("studio"), FLAT, {1.0 / 6, 0.25}},
    {"technical of %.30s to PNG against flat", NULL, LOOK("technical"), FLAT, {0, 0}},
    {"outdoor of %.30s to PNG against flat", NULL, LOOK("outdoor"), FLAT, {0, 0}},
    {"technical of %.30s to PNG against flat", "gear", LOOK("technical"), FLAT, {0, 0}},
    {"SVG of %.30s, 100 ms, against technical", NULL, LOOK("technical") SVG, LOOK("technical"), {0, 0}},
};
enum { LOOKS = sizeof looks / sizeof *looks };

struct task {
    const struct work *work;
    int number;
};

static void name_row(const struct task *task, char *name, size_t size)
{
    const char *mesh = looks[task->number].mesh;
    char what[72];
    snprintf(what, sizeof what, looks[task->number].name, mesh ? mesh : task->work->name);
    snprintf(name, size, "HTTP: %s 2T %s", what, machine_isa_name());
}

struct asking {
    struct wire wire;
    char *documents[SIDES];
};

/* The mesh of a drawing, in the view of a look. To be freed; NULL where there is no memory. */
static char *document_of(const struct drawing *drawing, const char *head)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    fprintf(out, "{\"window\":{\"width\":512,\"height\":512},%s,\"meshes\":[{\"doubleSided\":true,\"positions\":[",
            head);
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        const zr_vec4 *p = &drawing->positions[i];
        fprintf(out, "%s[%.6g,%.6g,%.6g]", i ? "," : "", (double)p->x, (double)p->y, (double)p->z);
    }
    fprintf(out, "],\"faces\":[");
    for (uint32_t f = 0; f < drawing->face_count; f++) {
        fprintf(out, "%s[", f ? "," : "");
        for (uint32_t c = drawing->face_offsets[f]; c < drawing->face_offsets[f + 1]; c++)
            fprintf(out, "%s%u", c > drawing->face_offsets[f] ? "," : "", drawing->indices[c]);
        fprintf(out, "]");
    }
    fprintf(out, "]}]}");
    return fclose(out) == 0 ? text : NULL;
}

static bool run_round(void *context, struct series *series)
{
    struct asking *asking = context;
    for (int side = OURS; side < SIDES; side++) {
        struct wire_answer answer = {0};
        const char *body = asking->documents[side];
        const double begin = now_ms();
        if (!wire_ask(&asking->wire, "POST", "/v1/render", body, strlen(body), &answer)) return false;
        if (answer.status != 200)
            return bench_complain("the daemon answered %d: %.*s", answer.status, (int)answer.size, answer.body);
        series_add(&series[side], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    const char *mesh = looks[task->number].mesh;
    struct asking asking = {.wire = {.fd = -1}};
    struct drawing model = {0};
    char folder[600];
    snprintf(folder, sizeof folder, "%s/parts", bench->models);
    const bool has_model = !mesh || models_drawing(&model, folder, mesh, 0, 512, 512);
    const struct drawing *drawing = mesh ? &model : &task->work->drawing;
    asking.documents[OURS] = has_model ? document_of(drawing, looks[task->number].ours) : NULL;
    asking.documents[THEIRS] = has_model ? document_of(drawing, looks[task->number].theirs) : NULL;
    drawing_free(&model);
    struct daemon daemon = daemon_start((const char *const[]){"--workers=1", "--threads=2", NULL});
    const bool ok = asking.documents[OURS] && asking.documents[THEIRS] && wire_open(&asking.wire, daemon.port) &&
                    series_run(series, SIDES, bench->rounds, run_round, &asking);
    struct row row = {.ours_ms = series_median(&series[OURS]),
                      .theirs_ms = series_median(&series[THEIRS]),
                      .bar = looks[task->number].bar};
    name_row(task, row.work, sizeof row.work);
    wire_close(&asking.wire);
    daemon_stop(&daemon);
    free(asking.documents[OURS]);
    free(asking.documents[THEIRS]);
    if (ok) sink_row(sink, &row);
    return ok;
}

static bool has_mesh(const struct bench *bench, const char *mesh)
{
    char path[600];
    snprintf(path, sizeof path, "%s/parts/%s.obj", bench->models, mesh ? mesh : "");
    return !mesh || access(path, R_OK) == 0;
}

void looks_over_http(struct bench *bench)
{
    struct work work;
    struct task task = {.work = &work};
    if (bench->check_only) return;
    if (!works_make(WORK_BUNNY_SMALL, bench->models, &work)) bench->results.failed = true;
    for (task.number = 0; work.corners && task.number < LOOKS; task.number++) {
        char name[ROW_NAME_SIZE];
        name_row(&task, name, sizeof name);
        if (!bench_wants(bench, name)) continue;
        if (!has_mesh(bench, looks[task.number].mesh)) {
            bench_complain("LEFT OUT: %s: no %s.obj in %s/parts", name, looks[task.number].mesh, bench->models);
            continue;
        }
        results_begin_table(&bench->results, "looks, over HTTP: \"theirs\" is our plain flat picture, or technical");
        bench_in_child(bench, measure, &task, NULL);
    }
    works_free(&work);
}
