/* Whole requests: looks of the bunny at 512x512 to PNG, against its plain flat picture. */
#include <stdlib.h>
#include <string.h>

#include "bench/looks.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/wire.h"
#include "bench/works.h"
#include "server/daemon.h"

enum { OURS, THEIRS, SIDES };

static const struct {
    const char *look;
    struct bar bar;
} looks[] = {
    {"studio", {1.0 / 6, 0.25}},
    {"technical", {0, 0}},
    {"outdoor", {0, 0}},
};
enum { LOOKS = sizeof looks / sizeof *looks };

struct task {
    const struct work *work;
    int number;
};

static void name_row(const struct task *task, char *name, size_t size)
{
    snprintf(name, size, "HTTP: %s of %.30s to PNG against flat 2T %s", looks[task->number].look, task->work->name,
             machine_isa_name());
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
    struct asking asking = {.wire = {.fd = -1}};
    char head[64];
    snprintf(head, sizeof head, "\"look\":\"%s\"", looks[task->number].look);
    asking.documents[OURS] = document_of(&task->work->drawing, head);
    asking.documents[THEIRS] = document_of(
        &task->work->drawing, "\"shading\":\"flat\",\"view\":{\"azimuthDegrees\":35,\"elevationDegrees\":28,"
                              "\"perspective\":{\"yfovDegrees\":30},\"fit\":{\"padding\":0.07}}");
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
        results_begin_table(&bench->results, "looks, over HTTP: \"theirs\" is our plain flat picture");
        bench_in_child(bench, measure, &task, NULL);
    }
    works_free(&work);
}
