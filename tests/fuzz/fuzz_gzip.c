/* A body with Content-Encoding: gzip. The same bytes are also deflated first: what comes back must be they. */
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "fuzz/fuzz.h"
#include "routes/gunzip.h"

enum { INFLATED_MAX = 1 << 17, WINDOW_BITS_GZIP = 15 + 16, MEMORY_LEVEL = 8 };

static size_t gzip(const uint8_t *data, size_t size, char *out, size_t room)
{
    z_stream stream = {0};
    fuzz_expect(
        deflateInit2(&stream, (int)(size % 10), Z_DEFLATED, WINDOW_BITS_GZIP, MEMORY_LEVEL, Z_DEFAULT_STRATEGY) == Z_OK,
        "zlib starts");
    stream.next_in = (z_const Bytef *)(uintptr_t)data;
    stream.avail_in = (uInt)size;
    stream.next_out = (Bytef *)out;
    stream.avail_out = (uInt)room;
    fuzz_expect(deflate(&stream, Z_FINISH) == Z_STREAM_END, "the room is enough");
    const size_t used = room - stream.avail_out;
    deflateEnd(&stream);
    return used;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct zr_arena arena;
    const char *out = (const char *)data;
    size_t out_size = size;
    if (!arena.ceiling) zr_arena_init(&arena, 4 * INFLATED_MAX);
    enum gunzip_status status = gunzip(&arena, NULL, INFLATED_MAX, &out, &out_size);
    fuzz_accepted = status == GUNZIP_OK;
    fuzz_expect(status != GUNZIP_NO_MEMORY, "the arena is large enough for all that may come out");
    fuzz_expect(status != GUNZIP_OK || out_size <= INFLATED_MAX, "no more comes out than may");

    const size_t room = size + size / 2 + 64;
    char *zipped = malloc(room);
    fuzz_expect(zipped, "memory");
    const size_t zipped_size = gzip(data, size, zipped, room);
    zr_arena_reset(&arena, ZR_ARENA_BLOCK);
    out = zipped;
    out_size = zipped_size;
    status = gunzip(&arena, NULL, size, &out, &out_size);
    fuzz_expect(status == GUNZIP_OK && out_size == size && memcmp(out, data, size) == 0, "what went in comes out");
    out = zipped;
    out_size = zipped_size;
    if (size > 0)
        fuzz_expect(gunzip(&arena, NULL, size - 1, &out, &out_size) == GUNZIP_TOO_LARGE,
                    "a limit of one byte less gives GUNZIP_TOO_LARGE");
    free(zipped);
    zr_arena_reset(&arena, ZR_ARENA_BLOCK);
    return 0;
}
