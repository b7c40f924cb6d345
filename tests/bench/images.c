/* Images of a glTF file, decoded by two threads and by one. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "base/team.h"
#include "bench/input/formats.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "core.h"
#include "render_request.h"
#include "support/pictures/png.h"

enum { FILES = 8, SIDE = 1024, GLB_HEAD = 12, CHUNK_HEAD = 8, CORNER_BYTES = 36, TEXT_BYTES = 4096 };

static const size_t ARENA_BYTES = (size_t)1 << 30;
static const struct bar bar = {1.6, 1.95};

struct side {
    struct zr_arena arena;
    struct zr_team *team; /* NULL: one thread */
};

struct contest {
    char *bytes; /* a GLB */
    size_t size;
    struct side sides[2]; /* two threads, one */
};

/* ---- the file ---- */

/* Makes texels with as much detail as a photo: waves, and noise in the lower bits. */
static void paint(uint8_t *rgba, int number)
{
    uint32_t seed = (uint32_t)number + 1;
    for (size_t k = 0; k < (size_t)SIDE * SIDE; k++) {
        const size_t x = k % SIDE, y = k / SIDE;
        seed = seed * 1664525u + 1013904223u;
        for (size_t c = 0; c < 3; c++)
            rgba[4 * k + c] = (uint8_t)((x * (c + 1) / 8 ^ y / (4 + (size_t)number)) + (seed >> (8 * c + 4) & 7));
        rgba[4 * k + 3] = 255;
    }
}

static size_t put_text(char text[TEXT_BYTES], const size_t sizes[FILES])
{
    static const char head[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{"
        "\"buffer\":0,\"byteLength\":36}";
    char *at = text, *const end = text + TEXT_BYTES;
    size_t offset = CORNER_BYTES;
#define PUT(...) (at += snprintf(at, (size_t)(end - at), __VA_ARGS__))
    PUT("%s", head);
    for (int i = 0; i < FILES; i++, offset += sizes[i - 1])
        PUT(",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", offset, sizes[i]);
    PUT("],\"buffers\":[{\"byteLength\":%zu}],\"images\":[", offset);
    for (int i = 0; i < FILES; i++)
        PUT("%s{\"bufferView\":%d,\"mimeType\":\"image/png\"}", i ? "," : "", i + 1);
    PUT("],\"textures\":[");
    for (int i = 0; i < FILES; i++)
        PUT("%s{\"source\":%d}", i ? "," : "", i);
    PUT("],\"materials\":[");
    for (int i = 0; i < FILES; i++)
        PUT("%s{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":%d}}}", i ? "," : "", i);
    PUT("],\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < FILES; i++)
        PUT("%s{\"attributes\":{\"POSITION\":0},\"material\":%d}", i ? "," : "", i);
    PUT("]}]}");
#undef PUT
    while ((at - text) % 4 != 0)
        *at++ = ' ';
    return (size_t)(at - text);
}

static char *put_words(char *at, const uint32_t *words, size_t count)
{
    memcpy(at, words, count * sizeof *words);
    return at + count * sizeof *words;
}

static bool make_file(struct contest *contest)
{
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    uint8_t *files[FILES], *rgba = malloc((size_t)SIDE * SIDE * 4);
    size_t sizes[FILES], binary = CORNER_BYTES;
    char text[TEXT_BYTES];
    bool good = rgba != NULL;
    for (int i = 0; i < FILES; i++) {
        if (good) paint(rgba, i);
        files[i] = good ? png_memory_write(rgba, SIDE, SIDE, &sizes[i]) : NULL;
        good = files[i] != NULL;
        if (good) binary += sizes[i];
    }
    const size_t length = good ? put_text(text, sizes) : 0, padded = (binary + 3) / 4 * 4;
    contest->size = GLB_HEAD + 2 * CHUNK_HEAD + length + padded;
    contest->bytes = good ? calloc(1, contest->size) : NULL;
    if (contest->bytes) {
        const uint32_t begin[] = {0x46546C67, 2, (uint32_t)contest->size, (uint32_t)length, 0x4E4F534A};
        char *at = put_words(contest->bytes, begin, 5);
        memcpy(at, text, length);
        at = put_words(at + length, (const uint32_t[]){(uint32_t)padded, 0x004E4942}, 2);
        memcpy(at, corners, sizeof corners);
        at += CORNER_BYTES;
        for (int i = 0; i < FILES; at += sizes[i], i++)
            memcpy(at, files[i], sizes[i]);
    }
    for (int i = 0; i < FILES; i++)
        free(files[i]);
    free(rgba);
    return contest->bytes != NULL;
}

/* ---- the row ---- */

static bool run_round(void *context, struct series *series)
{
    struct contest *contest = context;
    const struct zr_limits limits = zr_limits_default();
    const struct zr_request request = {.format = ZR_FORMAT_UNKNOWN, .bytes = contest->bytes, .size = contest->size};
    for (int i = 0; i < 2; i++) {
        struct zr_error error = {.status = ZR_OK};
        const struct zr_scene *scene;
        zr_arena_reset(&contest->sides[i].arena, ARENA_BYTES);
        const double begin = now_ms();
        if (zr_scene_read(
                &(struct zr_run){.arena = &contest->sides[i].arena, .team = contest->sides[i].team, .error = &error},
                &request, &limits, &scene) != ZR_OK)
            return bench_complain("zr_scene_read: %s: %s", error.items[0].pointer, error.items[0].detail);
        series_add(&series[i], now_ms() - begin);
    }
    return true;
}

static void name_row(char *name, size_t size)
{
    snprintf(name, size, "2T against 1T: GLB of %d PNG textures of %d x %d", FILES, SIDE, SIDE);
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[2];
    struct contest contest = {.bytes = NULL};
    (void)context;
    for (int i = 0; i < 2; i++)
        zr_arena_init(&contest.sides[i].arena, ARENA_BYTES);
    contest.sides[0].team = zr_team_create(2);
    bool ok = contest.sides[0].team && make_file(&contest) && series_run(series, 2, bench->rounds, run_round, &contest);
    if (ok) {
        struct row row = {.ours_ms = series_median(&series[0]), .theirs_ms = series_median(&series[1]), .bar = bar};
        name_row(row.work, sizeof row.work);
        snprintf(row.note, sizeof row.note, "%.1f MB", (double)contest.size / 1e6);
        sink_row(sink, &row);
    }
    zr_team_destroy(contest.sides[0].team);
    for (int i = 0; i < 2; i++)
        zr_arena_free(&contest.sides[i].arena);
    free(contest.bytes);
    return ok;
}

void images_by_threads(struct bench *bench)
{
    char name[ROW_NAME_SIZE];
    name_row(name, sizeof name);
    if (bench->check_only || machine_cores() < 2 || !bench_wants(bench, name)) return;
    results_begin_table(&bench->results, "images of a file: zr_scene_read; \"theirs\" is ours on 1 thread");
    bench_in_child(bench, measure, NULL, NULL);
}
