#include "output/images/idat.h"

#include <string.h>

#include "base/isa.h"
#include "base/run.h"

/* STRIP_PIXELS: large enough to hide the cost of a strip, whose empty history takes 0.1 % more bytes. Small enough for
 * its bytes to fit the second-level cache, and for 8 threads to find work in 1920x1080 pixels. LANES: maximum number of
 * threads per picture; each needs buffers and tables of up to a megabyte. WAVE: strips whose streams are in memory at
 * once. */
enum { STRIP_PIXELS = 1 << 18, LANES = 8, WAVE = 64 };

/* The first two bytes of a zlib stream: deflate, a window of 32 KiB, the fastest algorithm. */
static const uint8_t HEAD[2] = {0x78, 0x01};
enum { CHECK_SUM_BYTES = 4 };

_Static_assert((int)ZR_DEFLATE_TAIL >= (int)ZR_FILTER_PADDING, "the last row's padding must fit");

enum { STORED_MAX = 65535, STORED_HEAD = 5 }; /* an uncompressed block */

struct strip {
    uint8_t *bytes; /* room for the strip in stored blocks, HEAD and the checksum */
    size_t size;
    struct zr_adler sum;
    bool done;
};

/* Buffers of one thread. */
struct lane {
    uint8_t *filtered;
    uint8_t *rows[2]; /* the last two generated rows */
    uint8_t *table;   /* match table */
    struct isal_zstream stream;
};

struct job {
    const struct zr_idat_image *image;
    const struct zr_cancel *cancel;
    const uint8_t *zeros; /* stands in for a row above the first */
    uint32_t strip_rows, strip_count, wave_begin, wave_end;
    struct strip strips[WAVE];
    struct lane *lanes[LANES];
    atomic_uint next;
};

static size_t filtered_size(const struct zr_idat_image *image, uint32_t rows)
{
    return rows * ((size_t)image->width * zr_layout_file(image->layout) + 1);
}

static size_t stored_size(size_t size)
{
    return size + (size / STORED_MAX + 1) * STORED_HEAD;
}

static uint32_t rows_of(const struct job *job, uint32_t number)
{
    uint32_t begin = number * job->strip_rows, left = job->image->height - begin;
    return left < job->strip_rows ? left : job->strip_rows;
}

/* ---- one part of the stream ---- */

/* A first call with up to 16 bytes does not enter ISA-L's main loop, and by the next call the stream has begun. This
 * avoids the header's fault through ISA-L's documented interface, and costs 7 bytes per part. */
enum { FIRST = 8 };

/* Returns true if all bytes fit. */
static bool add(struct isal_zstream *stream, const uint8_t *bytes, size_t size, bool last)
{
    stream->end_of_stream = last;
    stream->flush = last ? NO_FLUSH : SYNC_FLUSH; /* ends on a whole byte */
    stream->next_in = (uint8_t *)(uintptr_t)bytes;
    stream->avail_in = (uint32_t)size;
    const bool done = isal_deflate(stream) == COMP_OK;
    zr_isa_clear_upper_halves();
    return done && stream->avail_in == 0 && stream->avail_out > 0;
}

size_t zr_deflate(struct isal_zstream *stream, uint8_t table[ZR_DEFLATE_TABLE], const uint8_t *bytes, size_t size,
                  bool last, uint8_t *out, size_t room)
{
    memset(stream, 0, sizeof *stream);
    isal_deflate_init(stream);
    stream->level = 1;
    stream->level_buf = table;
    stream->level_buf_size = ZR_DEFLATE_TABLE;
    stream->next_out = out;
    stream->avail_out = (uint32_t)room;
    size_t first = size > FIRST ? FIRST : 0;
    if (first > 0 && !add(stream, bytes, first, false)) return 0;
    return add(stream, bytes + first, size - first, last) ? stream->total_out : 0;
}

/* ---- one strip ---- */

static size_t row_size(const struct zr_idat_image *image)
{
    return (size_t)image->width * zr_layout_memory(image->layout);
}

static const uint8_t *row_at(const struct zr_idat_image *image, const struct lane *lane, uint32_t y, bool again)
{
    if (image->pixels) return image->pixels + y * row_size(image);
    image->rows.make(image->rows.source, y, lane->rows[y % 2], again);
    return lane->rows[y % 2];
}

static struct zr_adler filter_rows(const struct job *job, const struct lane *lane, uint32_t number)
{
    const struct zr_idat_image *image = job->image;
    const uint32_t begin = number * job->strip_rows, end = begin + rows_of(job, number);
    const uint8_t *above = begin > 0 ? row_at(image, lane, begin - 1, true) : job->zeros;
    uint8_t *out = lane->filtered;
    struct zr_adler sum = {0, 0};
    for (uint32_t y = begin; y < end; y++) {
        const uint8_t *row = row_at(image, lane, y, false);
        zr_filter_row(image->layout, row, above, image->width, zr_column_span_of_rows(image->spans, y, image->width),
                      out, &sum);
        out += filtered_size(image, 1);
        above = row;
    }
    return sum;
}

static size_t store(const uint8_t *bytes, size_t size, uint8_t *out, bool last)
{
    uint8_t *at = out;
    while (size > 0) {
        size_t some = size < STORED_MAX ? size : STORED_MAX;
        const uint8_t head[STORED_HEAD] = {last && some == size, (uint8_t)some, (uint8_t)(some >> 8), (uint8_t)~some,
                                           (uint8_t)(~some >> 8)};
        memcpy(at, head, sizeof head);
        memcpy(at + sizeof head, bytes, some);
        at += sizeof head + some;
        bytes += some;
        size -= some;
    }
    return (size_t)(at - out);
}

static void make_strip(const struct job *job, struct lane *lane, uint32_t number, struct strip *strip)
{
    size_t size = filtered_size(job->image, rows_of(job, number)), head = number == 0 ? sizeof HEAD : 0;
    bool last = number == job->strip_count - 1;
    memcpy(strip->bytes, HEAD, head);
    strip->sum = filter_rows(job, lane, number);
    memset(lane->filtered + size, 0, ZR_DEFLATE_TAIL);
    strip->size =
        zr_deflate(&lane->stream, lane->table, lane->filtered, size, last, strip->bytes + head, stored_size(size));
    if (strip->size == 0) strip->size = store(lane->filtered, size, strip->bytes + head, last);
    strip->size += head;
}

static void work(void *context, size_t lane, size_t end)
{
    struct job *job = context;
    (void)end;
    for (;;) {
        uint32_t number = job->wave_begin + atomic_fetch_add_explicit(&job->next, 1, memory_order_relaxed);
        if (number >= job->wave_end || zr_is_cancelled(job->cancel)) return;
        struct strip *strip = &job->strips[number - job->wave_begin];
        make_strip(job, job->lanes[lane], number, strip);
        strip->done = true;
    }
}

/* ---- all strips ---- */

static struct lane *make_lane(struct zr_arena *arena, const struct zr_idat_image *image, size_t size)
{
    struct lane *lane = zr_arena_zero(arena, 1, sizeof *lane);
    uint8_t *filtered = zr_arena_alloc(arena, size + ZR_DEFLATE_TAIL, 1);
    uint8_t *table = zr_arena_alloc(arena, ZR_DEFLATE_TABLE, 1);
    for (int i = 0; lane && !image->pixels && i < 2; i++)
        lane->rows[i] = zr_arena_alloc(arena, row_size(image), 1);
    if (!zr_arena_ok(arena)) return NULL;
    lane->filtered = filtered;
    lane->table = table;
    return lane;
}

/* Allocates all memory beforehand, since threads that share an arena must not allocate. */
static struct job *make_job(const struct zr_idat_image *image, struct zr_arena *arena, uint32_t threads,
                            const struct zr_cancel *cancel)
{
    struct job *job = zr_arena_alloc(arena, 1, sizeof *job);
    uint8_t *zeros = zr_arena_zero(arena, image->width, zr_layout_memory(image->layout));
    if (!job || !zeros) return NULL;
    uint32_t rows = STRIP_PIXELS / image->width;
    if (rows < 1) rows = 1;
    if (rows > image->height) rows = image->height;
    *job = (struct job){.image = image, .cancel = cancel, .zeros = zeros, .strip_rows = rows};
    job->strip_count = (image->height - 1) / rows + 1;
    size_t size = filtered_size(image, rows), room = stored_size(size) + sizeof HEAD + CHECK_SUM_BYTES;
    for (uint32_t i = 0; i < WAVE && i < job->strip_count; i++)
        job->strips[i].bytes = zr_arena_alloc(arena, room, 1);
    for (uint32_t i = 0; i < LANES && i < threads && i < job->strip_count; i++)
        job->lanes[i] = make_lane(arena, image, size);
    return zr_arena_ok(arena) ? job : NULL;
}

static void make_wave(struct job *job, struct zr_team *team)
{
    uint32_t count = job->wave_end - job->wave_begin, lanes = 0;
    for (uint32_t i = 0; i < count; i++)
        job->strips[i].done = false;
    atomic_store_explicit(&job->next, 0, memory_order_relaxed);
    while (lanes < LANES && lanes < count && job->lanes[lanes])
        lanes++;
    zr_team_ranges(team, lanes, 1, work, job);
}

/* Appends the checksum of the whole stream to the last strip. */
static void end_stream(const struct zr_adler *sum, struct strip *last)
{
    uint32_t value = sum->b << 16 | sum->a;
    for (int i = 0; i < CHECK_SUM_BYTES; i++)
        last->bytes[last->size++] = (uint8_t)(value >> (24 - 8 * i));
}

enum zr_status zr_idat_make(const struct zr_run *run, const struct zr_idat_image *image,
                            void (*take)(void *context, const uint8_t *bytes, size_t size), void *context)
{
    struct job *job = make_job(image, run->arena, (uint32_t)zr_team_size(run->team), run->cancel);
    if (!job) return ZR_NO_MEMORY;
    struct zr_adler sum = zr_adler_begin();
    for (uint32_t next = 0; next < job->strip_count; next = job->wave_end) {
        job->wave_begin = next;
        job->wave_end = job->strip_count - next < WAVE ? job->strip_count : next + WAVE;
        make_wave(job, run->team);
        for (uint32_t number = next; number < job->wave_end; number++) {
            struct strip *strip = &job->strips[number - next];
            if (!strip->done) return ZR_CANCELLED;
            zr_adler_add(&sum, filtered_size(image, rows_of(job, number)), strip->sum.a, strip->sum.b);
            if (number == job->strip_count - 1) end_stream(&sum, strip);
            take(context, strip->bytes, strip->size);
        }
    }
    return ZR_OK;
}
