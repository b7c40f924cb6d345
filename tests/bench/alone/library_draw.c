/* library_draw FILE QUERY THREADS: libzraster's calls alone, for tests/bench/python/compare.py. For each number N in a
 * line of standard input, draws the file N times to a PNG and prints the nanoseconds that this took, by the clock and
 * of processors. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "api/zraster.h"

static char body[64 << 20];

static int64_t now(clockid_t clock)
{
    struct timespec time;
    clock_gettime(clock, &time);
    return time.tv_sec * INT64_C(1000000000) + time.tv_nsec;
}

static void draw(zraster *renderer, const struct zraster_request *request)
{
    zraster_picture *picture;
    struct zraster_bytes png;
    zraster_error *error;
    if (zraster_draw(renderer, request, &picture, &error) != ZRASTER_OK ||
        zraster_picture_encode(picture, NULL, &png, &error) != ZRASTER_OK) {
        fprintf(stderr, "%s\n", zraster_error_text(error));
        exit(1);
    }
    zraster_picture_free(picture);
}

int main(int argc, char **argv)
{
    zraster *renderer;
    FILE *file = argc == 4 ? fopen(argv[1], "rb") : NULL;
    if (!file) return fprintf(stderr, "usage: library_draw FILE QUERY THREADS\n"), 2;
    const struct zraster_request request = {
        .struct_size = sizeof request, .body = body, .body_size = fread(body, 1, sizeof body, file), .query = argv[2]};
    const struct zraster_options options = {.struct_size = sizeof options, .threads = (uint32_t)atoi(argv[3])};
    fclose(file);
    if (zraster_open(&options, &renderer) != ZRASTER_OK) return 1;
    for (int count; scanf("%d", &count) == 1;) {
        const int64_t start = now(CLOCK_MONOTONIC), used = now(CLOCK_PROCESS_CPUTIME_ID);
        for (int i = 0; i < count; i++)
            draw(renderer, &request);
        printf("%" PRId64 " %" PRId64 "\n", now(CLOCK_MONOTONIC) - start, now(CLOCK_PROCESS_CPUTIME_ID) - used);
        fflush(stdout);
    }
    zraster_close(renderer);
    return 0;
}
