#include "output/idat.h"

#include "output/deflate.h"
#include "output/matcher.h"

/* STRIP_PIXELS: large enough for the beginning of a block (70 bytes, 10 us) to be lost in what it describes, small
 * enough for 16 threads to find work in 1920x1080 pixels. LANES: threads that can work on one picture, each of which
 * wants a matcher of half a megabyte. WAVE: strips whose bytes are in memory at once. */
enum { STRIP_PIXELS = 1 << 17, LANES = 8, WAVE = 64 };

/* The two bytes that a zlib stream begins with: deflate, a window of 32 KiB, the fastest of algorithms. */
static const uint8_t HEAD[2] = {0x78, 0x01};
enum { CHECK_SUM_BYTES = 4 };

struct strip {
    uint8_t *bytes;
    size_t size;
    struct zr_adler sum;
    bool done;
};

struct job {
    const struct zr_idat_image *image;
    const struct zr_cancel *cancel;
    const uint8_t *zeros; /* what is above the first row */
    uint32_t strip_rows, strip_count, wave_begin, wave_end;
    struct strip strips[WAVE];
    struct zr_matcher matchers[LANES];
    atomic_uint next;
};

static void deflate_tokens(struct zr_matcher *matcher, struct zr_deflate *deflate)
{
    zr_deflate_block(deflate, matcher->tokens.at, matcher->tokens.count);
    matcher->tokens.count = 0;
}

static void make_strip(struct job *job, struct zr_matcher *matcher, uint32_t number, struct strip *strip)
{
    const struct zr_idat_image *image = job->image;
    size_t stride = (size_t)image->width * zr_layout_memory(image->layout);
    uint32_t begin = number * job->strip_rows, end = begin + job->strip_rows;
    if (end > image->height) end = image->height;
    struct zr_deflate deflate = {.out = strip->bytes};
    strip->sum = (struct zr_adler){0, 0};
    if (number == 0)
        for (size_t i = 0; i < sizeof HEAD; i++)
            *deflate.out++ = HEAD[i];
    zr_matcher_begin(matcher);
    for (uint32_t y = begin; y < end; y++) {
        const uint8_t *row = image->pixels + y * stride;
        while (!zr_matcher_row(matcher, row, y > 0 ? row - stride : job->zeros, &strip->sum))
            deflate_tokens(matcher, &deflate);
    }
    deflate_tokens(matcher, &deflate);
    zr_deflate_align(&deflate, number == job->strip_count - 1);
    strip->size = (size_t)(deflate.out - strip->bytes);
}

static void work(void *context, size_t lane, size_t end)
{
    struct job *job = context;
    (void)end;
    for (;;) {
        uint32_t number = job->wave_begin + atomic_fetch_add_explicit(&job->next, 1, memory_order_relaxed);
        if (number >= job->wave_end || zr_is_cancelled(job->cancel)) return;
        struct strip *strip = &job->strips[number - job->wave_begin];
        make_strip(job, &job->matchers[lane], number, strip);
        strip->done = true;
    }
}

static size_t strip_bytes(const struct zr_idat_image *image, uint32_t rows)
{
    return rows * ((size_t)image->width * zr_layout_file(image->layout) + 1);
}

static struct job *make_job(const struct zr_idat_image *image, struct zr_arena *arena, bool alone,
                            const struct zr_cancel *cancel)
{
    struct job *job = zr_arena_zero(arena, 1, sizeof *job);
    uint8_t *zeros = zr_arena_zero(arena, image->width, zr_layout_memory(image->layout));
    if (!zr_arena_ok(arena)) return NULL;
    uint32_t rows = STRIP_PIXELS / image->width;
    if (rows > ZR_MATCHER_ROWS_MAX) rows = ZR_MATCHER_ROWS_MAX;
    if (rows < 1) rows = 1;
    if (rows > image->height) rows = image->height;
    *job = (struct job){.image = image, .cancel = cancel, .zeros = zeros, .strip_rows = rows};
    job->strip_count = (image->height - 1) / rows + 1;
    size_t raw = strip_bytes(image, rows),
           room = ZR_DEFLATE_BOUND(raw, raw / ZR_MATCHER_BLOCK_MIN + 2) + sizeof HEAD + 8;
    for (uint32_t i = 0; i < WAVE && i < job->strip_count; i++)
        job->strips[i].bytes = zr_arena_alloc(arena, room, 1);
    for (uint32_t i = 0; i < (alone ? 1 : LANES) && i < job->strip_count; i++)
        zr_matcher_init(&job->matchers[i], arena, image->layout, image->width);
    return zr_arena_ok(arena) ? job : NULL;
}

/* The whole stream's sum, in four bytes behind the last strip. */
static void end_stream(const struct zr_adler *sum, struct strip *last)
{
    uint32_t value = sum->b << 16 | sum->a;
    for (int i = 0; i < CHECK_SUM_BYTES; i++)
        last->bytes[last->size++] = (uint8_t)(value >> (24 - 8 * i));
}

enum zr_status zr_idat_make(const struct zr_idat_image *image, struct zr_arena *arena, struct zr_team *team,
                            const struct zr_cancel *cancel,
                            void (*take)(void *context, const uint8_t *bytes, size_t size), void *context)
{
    struct job *job = make_job(image, arena, team == NULL, cancel);
    if (!job) return ZR_NO_MEMORY;
    struct zr_adler sum = zr_adler_begin();
    for (uint32_t begin = 0; begin < job->strip_count; begin += WAVE) {
        uint32_t count = job->strip_count - begin < WAVE ? job->strip_count - begin : WAVE;
        job->wave_begin = begin;
        job->wave_end = begin + count;
        atomic_store(&job->next, 0);
        for (uint32_t i = 0; i < count; i++)
            job->strips[i].done = false;
        zr_team_ranges(team, team && count < LANES ? count : team ? LANES : 1, 1, work, job);
        for (uint32_t i = 0; i < count; i++) {
            struct strip *strip = &job->strips[i];
            if (!strip->done) return ZR_CANCELLED;
            uint32_t rows =
                begin + i == job->strip_count - 1 ? image->height - (begin + i) * job->strip_rows : job->strip_rows;
            zr_adler_add(&sum, strip_bytes(image, rows), strip->sum.a, strip->sum.b);
            if (begin + i == job->strip_count - 1) end_stream(&sum, strip);
            take(context, strip->bytes, strip->size);
        }
    }
    return ZR_OK;
}
