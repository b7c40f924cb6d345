#include "geometry/cap_samples.h"

enum { WORD = 64 };

/* Counts the caps of each plane, over all instances. */
static void count_caps(const struct zr_scene *scene, uint64_t counts[ZR_SECTION_PLANES_MAX])
{
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        for (uint32_t cap = 0; mesh->cap_planes && cap < mesh->cap_count; cap++)
            counts[mesh->cap_planes[cap]]++;
    }
}

bool zr_cap_samples_make(struct zr_arena *arena, const struct zr_scene *scene, uint32_t width, uint32_t height,
                         struct zr_cap_samples *cap_samples)
{
    uint64_t counts[ZR_SECTION_PLANES_MAX] = {0};
    *cap_samples = (struct zr_cap_samples){.words = width / WORD + 1};
    count_caps(scene, counts);
    for (int k = 0; k < ZR_SECTION_PLANES_MAX; k++) {
        if (counts[k] < 2) continue;
        cap_samples->bits[k] = zr_arena_zero(arena, (size_t)cap_samples->words * height, sizeof *cap_samples->bits[k]);
        if (!cap_samples->bits[k]) return false;
    }
    return true;
}

int32_t zr_cap_samples_run(const struct zr_cap_samples *cap_samples, uint32_t plane, int32_t row, int32_t column,
                           int32_t end, bool *is_taken)
{
    const uint64_t *bits = cap_samples->bits[plane] + (size_t)row * cap_samples->words;
    *is_taken = bits[column / WORD] >> column % WORD & 1;
    while (column < end) {
        const uint64_t other = (*is_taken ? ~bits[column / WORD] : bits[column / WORD]) >> column % WORD;
        const int32_t next = (column / WORD + 1) * WORD;
        if (other != 0) {
            column += __builtin_ctzll(other);
            break;
        }
        column = next;
    }
    return column < end ? column : end;
}

void zr_cap_samples_take(const struct zr_cap_samples *cap_samples, uint32_t plane, int32_t row, int32_t begin,
                         int32_t end)
{
    uint64_t *bits = cap_samples->bits[plane] + (size_t)row * cap_samples->words;
    while (begin < end) {
        const int32_t next = (begin / WORD + 1) * WORD, stop = next < end ? next : end;
        const uint64_t mask = (stop - begin == WORD ? ~UINT64_C(0) : (UINT64_C(1) << (stop - begin)) - 1);
        bits[begin / WORD] |= mask << begin % WORD;
        begin = stop;
    }
}
