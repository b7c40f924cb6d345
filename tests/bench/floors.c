/* What no renderer can go below here. */
#include <stdlib.h>
#include <string.h>

#include "bench/growth.h"
#include "bench/series.h"

enum floor { CLEAR_BOTH, CLEAR_COLOR, COPY_RGBA, COPY_RGB };

static const struct {
    const char *name;
    enum floor floor;
    size_t pixels;
} floors[] = {{"floor: memset of colour and depth, 1080p", CLEAR_BOTH, 1920 * 1080},
              {"floor: memset of colour, 1080p", CLEAR_COLOR, 1920 * 1080},
              {"floor: memset of colour and depth, 512x512", CLEAR_BOTH, 512 * 512},
              {"floor: memset of colour and depth, 256x256", CLEAR_BOTH, 256 * 256},
              {"floor: memcpy of RGBA pixels, 1080p", COPY_RGBA, 1920 * 1080},
              {"floor: memcpy of RGB pixels, 1080p", COPY_RGB, 1920 * 1080}};

struct buffers {
    enum floor floor;
    size_t pixels;
    int value; /* another one each round */
    char *to, *from;
};

static bool run_round(void *context, struct series *series)
{
    struct buffers *b = context;
    double begin = now_ms();
    b->value ^= 1;
    switch (b->floor) {
    case CLEAR_BOTH:
        memset(b->to + 4 * b->pixels, b->value, 4 * b->pixels);
        memset(b->to, b->value, 4 * b->pixels);
        break;
    case CLEAR_COLOR:
        memset(b->to, b->value, 4 * b->pixels);
        break;
    case COPY_RGBA:
        memcpy(b->to, b->from, 4 * b->pixels);
        break;
    case COPY_RGB:
        memcpy(b->to, b->from, 3 * b->pixels);
        break;
    }
    __asm__ volatile("" : : "r"(b->to) : "memory"); /* somebody might look */
    series_add(series, now_ms() - begin);
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series;
    const size_t number = *(const size_t *)context, pixels = floors[number].pixels;
    struct buffers buffers = {floors[number].floor, pixels, 0, malloc(8 * pixels), malloc(4 * pixels)};
    if (!buffers.to || !buffers.from) return false;
    memset(buffers.from, 1, 4 * pixels);
    bool ok = series_run(&series, 1, bench->rounds, run_round, &buffers);
    struct row row = {.ours_ms = series_median(&series)};
    snprintf(row.work, sizeof row.work, "%s", floors[number].name);
    if (ok) sink_row(sink, &row);
    free(buffers.to);
    free(buffers.from);
    return ok;
}

void growth_floors(struct bench *bench)
{
    if (bench->check_only) return;
    for (size_t i = 0; i < sizeof floors / sizeof *floors; i++) {
        if (!bench_wants(bench, floors[i].name)) continue;
        results_begin_table(&bench->results, "floors, on 1 thread");
        bench_in_child(bench, measure, &i, NULL);
    }
}
