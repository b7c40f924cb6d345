/* What large pictures are written with: past the caches, by one thread and by two. Where the second adds nothing here,
 * as where both have one way to the memory, it adds little to pictures that are mostly written. */
#if defined __SSE2__
#include <emmintrin.h>
#endif
#include <stdlib.h>

#include "base/team.h"
#include "bench/growth.h"
#include "bench/machine.h"
#include "bench/series.h"

enum { ONE, TWO, SIDES };
enum { BYTES_PER_RANGE = 1 << 15 };

static const size_t BYTES = (size_t)1920 * 1080 * 8; /* colour and depth */
static const char *const names[SIDES] = {"floor: colour and depth past the caches, 1080p 1T",
                                         "floor: colour and depth past the caches, 1080p 2T"};

struct memory {
    struct zr_team *teams[SIDES];
    char *to;
    int32_t value; /* another one each round; some machines write zeros in half the time */
};

static void write_range(void *context, size_t begin, size_t end)
{
    const struct memory *memory = context;
#if defined __SSE2__
    const __m128i value = _mm_set1_epi32(memory->value);
    for (size_t i = begin; i < end; i += sizeof value)
        _mm_stream_si128((__m128i *)(void *)(memory->to + i), value);
#else
    (void)memory, (void)begin, (void)end;
#endif
}

static bool run_round(void *context, struct series *series)
{
    struct memory *memory = context;
    memory->value = memory->value % 1000 + 1;
    for (int side = ONE; side <= TWO; side++) {
        zr_team_ranges(memory->teams[side], BYTES, BYTES_PER_RANGE, write_range, memory); /* which wakes the second */
        double begin = now_ms();
        zr_team_ranges(memory->teams[side], BYTES, BYTES_PER_RANGE, write_range, memory);
        series_add(&series[side], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    (void)context;
    struct memory memory = {{zr_team_create(1), zr_team_create(2)}, aligned_alloc(64, BYTES), 0};
    if (!memory.teams[ONE] || !memory.teams[TWO] || !memory.to) return false;
    bool ok = series_run(series, SIDES, bench->rounds, run_round, &memory);
    for (int side = ONE; ok && side <= TWO; side++) {
        struct row row = {.ours_ms = series_median(&series[side])};
        if (side == TWO) row.theirs_ms = series_median(&series[ONE]);
        snprintf(row.work, sizeof row.work, "%s", names[side]);
        sink_row(sink, &row);
    }
    zr_team_destroy(memory.teams[ONE]);
    zr_team_destroy(memory.teams[TWO]);
    free(memory.to);
    return ok;
}

void growth_past_caches(struct bench *bench)
{
#if defined __SSE2__
    if (bench->check_only || machine_cores() < 2) return;
    const bool wanted[SIDES] = {bench_wants(bench, names[ONE]), bench_wants(bench, names[TWO])};
    if (!wanted[ONE] && !wanted[TWO]) return;
    results_begin_table(&bench->results, "floors of memory: \"theirs\" is 1 thread");
    bench_in_child(bench, measure, NULL, NULL);
#else
    (void)bench;
#endif
}
