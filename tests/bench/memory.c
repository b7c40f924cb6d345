/* What a pixel and a triangle cost in memory: the most that a daemon ever held, of a request twice as large less that
 * of one, so that what it holds anyway does not count. Bodies and answers do.
 */
#include <stdlib.h>

#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/input/documents.h"
#include "bench/input/meshes.h"
#include "bench/works.h"
#include "server/support/daemon.h"

enum kind { PIXELS, TRIANGLES, KINDS };

static const char *const names[KINDS] = {"HTTP: memory a pixel, 2048x2048 to 2048x4096, to PNG",
                                         "HTTP: memory a triangle, 125 k to 250 k, indexed JSON"};

/* The most that a new daemon holds, with how many bytes of that in the body; 0 on failure. */
static double peak_bytes(enum kind kind, bool twice, double *units, double *body_bytes)
{
    struct work work = {.name = ""};
    struct wire wire;
    struct wire_answer answer = {0};
    meshes_ball(&work.drawing, kind == PIXELS ? 32 : twice ? 354 : 250);
    works_look(&work, kind == PIXELS ? 2048 : 512, kind == PIXELS ? twice ? 4096 : 2048 : 512);
    struct document document = document_indexed(&work.drawing, false);
    *units = kind == PIXELS ? (double)work.drawing.width * work.drawing.height : work.drawing.face_count;
    *body_bytes = (double)document.size;
    struct daemon daemon = daemon_start((const char *const[]){"--workers=1", "--threads=1", NULL});
    bool ok = document.bytes && wire_open(&wire, daemon.port) &&
              wire_ask(&wire, "POST", "/v1/render", document.bytes, document.size, &answer) && answer.status == 200;
    double bytes = 1024.0 * (double)daemon_memory_kib(&daemon, "VmHWM:");
    if (document.bytes) wire_close(&wire);
    daemon_stop(&daemon);
    free(document.bytes);
    works_free(&work);
    return ok ? bytes : 0.0;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    enum kind kind = *(const enum kind *)context;
    double units, body, more_units, more_body;
    double bytes = peak_bytes(kind, false, &units, &body), more_bytes = peak_bytes(kind, true, &more_units, &more_body);
    if (bytes <= 0 || more_bytes <= 0) return bench_complain("the daemon did not answer, or its memory is not told");
    struct row row = {.work = ""};
    double added = more_units - units;
    snprintf(row.work, sizeof row.work, "%s", names[kind]);
    int used = snprintf(row.note, sizeof row.note, "%.1f bytes a %s", (more_bytes - bytes) / added,
                        kind == PIXELS ? "pixel" : "triangle");
    if (kind == TRIANGLES)
        snprintf(row.note + used, sizeof row.note - (size_t)used, ", of which the body has %.1f",
                 (more_body - body) / added);
    sink_row(sink, &row);
    return true;
}

void service_memory(struct bench *bench)
{
    if (bench->check_only) return;
    for (enum kind kind = PIXELS; kind < KINDS; kind++) {
        if (!bench_wants(bench, names[kind])) continue;
        results_begin_table(&bench->results, "memory of the daemon");
        bench_in_child(bench, measure, &kind, NULL);
    }
}
