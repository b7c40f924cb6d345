/* What no renderer can go below here. */
#include <stdlib.h>
#include <string.h>

#include "bench/growth.h"
#include "bench/series.h"

enum { WARM_UP = 2 };

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

static void run(enum floor floor, size_t pixels, int round, char *to, const char *from)
{
    switch (floor) {
    case CLEAR_BOTH:
        memset(to + 4 * pixels, round, 4 * pixels);
        memset(to, round, 4 * pixels);
        break;
    case CLEAR_COLOR:
        memset(to, round, 4 * pixels);
        break;
    case COPY_RGBA:
        memcpy(to, from, 4 * pixels);
        break;
    case COPY_RGB:
        memcpy(to, from, 3 * pixels);
        break;
    }
    __asm__ volatile("" : : "r"(to) : "memory"); /* somebody might look */
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series;
    const size_t number = *(const size_t *)context, pixels = floors[number].pixels;
    char *to = malloc(8 * pixels), *from = malloc(4 * pixels);
    if (!to || !from) return false;
    memset(from, 1, 4 * pixels);
    int rounds = series_rounds(bench->rounds, 1.0);
    for (int i = -WARM_UP; i < rounds; i++) {
        double begin = now_ms();
        run(floors[number].floor, pixels, i & 1, to, from);
        if (i >= 0) series_add(&series, now_ms() - begin);
    }
    struct row row = {.ours_ms = series_median(&series)};
    snprintf(row.work, sizeof row.work, "%s", floors[number].name);
    sink_row(sink, &row);
    free(to);
    free(from);
    return true;
}

void growth_floors(struct bench *bench)
{
    bool heading = false;
    if (bench->check_only) return;
    for (size_t i = 0; i < sizeof floors / sizeof *floors; i++) {
        if (!bench_wants(bench, floors[i].name)) continue;
        if (!heading) results_print_heading("floors, on 1 thread");
        heading = true;
        bench_in_child(bench, measure, &i, NULL);
    }
}
