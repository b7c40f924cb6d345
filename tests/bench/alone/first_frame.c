#include "bench/alone/first_frame.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "reference/gl/reference.h"

static void *take(size_t count, size_t size)
{
    char *bytes = malloc(count * size + 1);
    size_t got = 0;
    while (bytes && got < count * size) {
        ssize_t more = read(STDIN_FILENO, bytes + got, count * size - got);
        if (more <= 0) exit(2);
        got += (size_t)more;
    }
    return bytes;
}

int main(void)
{
    struct reference_error error = {""};
    struct reference_options options = {.driver = "llvmpipe", .native = true, .threads = 1};
    const struct first_frame *frame = take(1, sizeof *frame);
    const zr_vec4 *positions = take(frame->position_count, sizeof *positions);
    const zr_vec4 *colors = take(frame->position_count, sizeof *colors);
    const uint32_t *indices = take(frame->index_count, sizeof *indices);
    uint8_t *rgba = malloc((size_t)frame->width * frame->height * 4);
    float *depth = malloc((size_t)frame->width * frame->height * sizeof *depth);
    struct reference_batch batch = {
        .mode = REFERENCE_TRIANGLES, .count = frame->index_count, .modelview = &frame->modelview, .smooth = true};
    struct reference_arrays arrays = {.positions = positions,
                                      .front = colors,
                                      .indices = indices,
                                      .batch_count = 1,
                                      .batches = &batch,
                                      .projection = frame->projection,
                                      .background = {0, 0, 0, 1}};
    struct reference *reference = reference_open(&options, &error);
    if (reference && rgba && depth && reference_resize(reference, frame->width, frame->height, false, &error) &&
        reference_draw(reference, &arrays, &error) && reference_read(reference, rgba, depth, &error))
        return write(STDOUT_FILENO, "1", 1) == 1 ? 0 : 1;
    fprintf(stderr, "first_frame: %s\n", error.text);
    return 1;
}
