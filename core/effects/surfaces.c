#include "effects/surfaces.h"

#include "base/mutant.h"

enum { SIDE = ZR_SURFACES_SIDE, COLUMNS = ZR_SURFACES_COLUMNS };

struct zr_gbuffer zr_surfaces_gbuffer(struct zr_surfaces *surfaces)
{
    struct zr_gbuffer out = {.width = (int32_t)surfaces->list.count,
                             .height = 1,
                             .stride = ZR_SAMPLES_ROOM,
                             .owner = surfaces->list.owner,
                             .material = surfaces->material};
    for (int k = 0; k < 3; k++) {
        out.base[k] = surfaces->floats[k];
        out.normal[k] = surfaces->floats[3 + k];
        out.point[k] = surfaces->floats[6 + k];
    }
    return out;
}

void zr_surfaces_put(const struct zr_surfaces *surfaces, int32_t row, float *const out[4])
{
    const uint32_t *first = surfaces->first + row * surfaces->columns;
    for (int32_t x = 0; x < surfaces->columns; x++) {
        float sum[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        for (uint32_t i = first[x]; i < first[x + 1]; i++) {
            const float by_samples = (float)surfaces->samples[i] * (1.0f / (SIDE * SIDE));
            const float share = ZR_MUTANT(shares_by_surfaces, by_samples, 1.0f / (float)(first[x + 1] - first[x]));
            for (int k = 0; k < 3; k++)
                sum[k] += surfaces->color[k][i] * share;
            sum[3] += share;
        }
        for (int k = 0; k < 4; k++)
            out[k][x] = sum[k];
    }
}

/* ---- where surfaces end ---- */

static void keep_pixel(const struct zr_surfaces *surfaces, uint32_t pixel, int32_t at, struct zr_surface_pixels *out)
{
    const uint32_t lead = surfaces->first[pixel];
    if (lead == surfaces->first[pixel + 1]) {
        out->owner[at] = 0;
        out->is_split[at] = false;
        for (int k = 0; k < 6; k++)
            out->floats[k][at] = 0.0f;
        return;
    }
    out->owner[at] = surfaces->list.owner[lead];
    out->is_split[at] = surfaces->first[pixel + 1] - lead > 1;
    for (int k = 0; k < 6; k++)
        out->floats[k][at] = surfaces->floats[3 + k][lead];
}

void zr_surfaces_keep(const struct zr_surfaces *surfaces, int32_t from, struct zr_surface_pixels *out)
{
    out->columns = surfaces->columns;
    out->rows = from + surfaces->rows;
    for (int32_t y = 0; y < surfaces->rows; y++)
        for (int32_t x = 0; x < surfaces->columns; x++)
            keep_pixel(surfaces, (uint32_t)(y * surfaces->columns + x), (from + y) * COLUMNS + x, out);
}

void zr_surfaces_list_row(const struct zr_sample_pairs *pairs, const struct zr_tile *tile, const uint32_t *owners,
                          int32_t row, struct zr_edge_samples *out)
{
    const uint64_t all = UINT64_MAX >> (ZR_TILE_SIZE - tile->width);
    uint64_t bits = pairs->along[row] | pairs->along[row] << 1 | pairs->upwards[row] | 1 | (all ^ all >> 1);
    if (row > 0) bits |= pairs->upwards[row - 1];
    if (row == 0 || row == tile->height - 1) bits = all;
    for (bits &= all; bits; bits &= bits - 1) {
        const int32_t column = __builtin_ctzll(bits), place = row * ZR_TILE_STRIDE + column;
        const uint32_t count = out->list.count;
        out->place[count] = (uint32_t)place;
        out->list.x[count] = (float)(tile->x + column);
        out->list.y[count] = (float)(tile->y + row);
        out->list.owner[count] = owners[place];
        out->list.count += owners[place] != 0;
    }
}
