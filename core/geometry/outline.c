#include "geometry/outline.h"

#include "base/mutant.h"

unsigned zr_outline_fan_edges(uint32_t i, uint32_t count)
{
    const unsigned ring = 1u | (i + 1 == count ? 2u : 0u) | (i == 2 ? 4u : 0u);
    return ZR_MUTANT(outlines_of_the_fan, ring, 7u);
}

/* One triangle of the fan, and the edges that it may draw. */
struct piece {
    int corner[3];
    bool draws[3]; /* edges 2 to 0, 0 to 1, 1 to 2, in this order */
};

/* Returns twice the area, positive for counterclockwise corners. */
static float area(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                  const struct zr_window_vertex *v2)
{
    float ex = v0->x - v2->x, ey = v0->y - v2->y, fx = v1->x - v2->x, fy = v1->y - v2->y;
    return ex * fy - ey * fx;
}

static int append_piece(const struct zr_window_vertex *vertices, const struct piece *piece, unsigned faces,
                        struct zr_outline_line *out)
{
    static const int starts[3] = {2, 0, 1}, ends[3] = {0, 1, 2};
    const int *from = ZR_MUTANT(outlines_turned, starts, ends), *to = ZR_MUTANT(outlines_turned, ends, starts);
    float a = area(&vertices[piece->corner[0]], &vertices[piece->corner[1]], &vertices[piece->corner[2]]);
    unsigned sides = ZR_MUTANT(outlines_of_backs, a > 0.0f, a < 0.0f) ? ZR_SIDE_FRONT
                     : a < 0.0f                                       ? ZR_SIDE_BACK | ZR_SIDE_MIRRORED_FRONT
                                                                      : ZR_SIDE_BACK;
    if (!(faces & sides)) return 0;
    int count = 0;
    for (int k = 0; k < 3; k++) {
        if (!piece->draws[k]) continue;
        out[count++] = (struct zr_outline_line){
            .from = (uint8_t)piece->corner[from[k]], .to = (uint8_t)piece->corner[to[k]], .back = a < 0.0f};
    }
    return count;
}

int zr_outline_make(const struct zr_window_vertex *vertices, int count, unsigned edges, bool clipped, unsigned faces,
                    struct zr_outline_line out[ZR_CLIP_MAX])
{
    if (!clipped) {
        struct piece whole = {.corner = {0, 1, 2}, .draws = {edges >> 2 & 1u, edges & 1u, edges >> 1 & 1u}};
        return append_piece(vertices, &whole, faces, out);
    }
    int lines = 0;
    for (int i = 2; i < count; i++) {
        struct piece piece = {
            .corner = {i - 1, i, 0},
            .draws = {i == 2 && (edges & 1u), edges >> (i - 1) & 1u, i == count - 1 && (edges >> i & 1u)}};
        lines += append_piece(vertices, &piece, faces, out + lines);
    }
    return lines;
}
