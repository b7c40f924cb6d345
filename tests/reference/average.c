#include "reference/average.h"
#include "scene/picture.h"

#include <string.h>

enum { CHANNELS = 4 };

/* Where the arena fails, points are as they were. */
static const struct zr_mesh *meshes_of_large(struct zr_arena *arena, const struct zr_scene *scene)
{
    struct zr_mesh *meshes = zr_arena_alloc(arena, scene->mesh_count, sizeof *meshes);
    for (uint32_t i = 0; meshes && i < scene->mesh_count; i++) {
        meshes[i] = scene->meshes[i];
        meshes[i].point_size *= (float)scene->picture->side;
    }
    return meshes ? meshes : scene->meshes;
}

struct zr_scene average_scene(struct zr_arena *arena, const struct zr_scene *scene, struct zr_picture *picture)
{
    struct zr_scene large = *scene;
    const uint32_t side = scene->picture->side;
    large.views[0].width *= side;
    large.views[0].height *= side;
    *picture = *scene->picture;
    picture->line_width *= (float)side;
    picture->side = 1;
    large.picture = picture;
    large.meshes = meshes_of_large(arena, scene);
    return large;
}

static uint8_t half_up(uint64_t sum, uint64_t by)
{
    return (uint8_t)((sum + by / 2) / by);
}

/* What cannot be seen has no colour, but where all samples have the same one. */
static void average_pixel(const uint8_t *corner, uint32_t side, size_t row_bytes, uint8_t *out)
{
    uint64_t sums[CHANNELS] = {0};
    bool alike = true;
    for (uint32_t i = 0; i < side * side; i++) {
        const uint8_t *sample = corner + i / side * row_bytes + i % side * CHANNELS;
        for (int k = 0; k < 3; k++)
            sums[k] += (uint64_t)sample[k] * sample[3];
        sums[3] += sample[3];
        alike = alike && memcmp(sample, corner, CHANNELS) == 0;
    }
    memcpy(out, corner, CHANNELS);
    for (int k = 0; k < 3 && !alike; k++)
        out[k] = sums[3] > 0 ? half_up(sums[k], sums[3]) : 0;
    if (!alike) out[3] = half_up(sums[3], (uint64_t)side * side);
}

void average_bytes(const uint8_t *samples, uint32_t side, uint32_t width, uint32_t height, uint8_t *out)
{
    const size_t row_bytes = (size_t)width * side * CHANNELS;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++, out += CHANNELS)
            average_pixel(samples + (size_t)y * side * row_bytes + (size_t)x * side * CHANNELS, side, row_bytes, out);
}

void average_gaps(const uint8_t *samples, uint32_t side, uint32_t width, uint32_t height, uint8_t *gaps)
{
    for (size_t y = 0; y < (size_t)height * side; y++)
        for (size_t x = 0; x < (size_t)width * side; x++)
            gaps[y / side * width + x / side] |= samples[y * width * side + x];
}
