#include "effects/edges.h"

#include "base/run.h"
#include "base/trig.h"
#include "effects/edge_marks.h"

enum { SIZE = ZR_TILE_SIZE };

/* Least distance of a silhouette from the other's plane, in sample widths. */
static const float jump = 1.5f;

static float clamped(float v, float least, float most)
{
    return v < least ? least : v > most ? most : v;
}

float zr_edges_width_in(const struct zr_edges *edges, uint32_t width, uint32_t height)
{
    const float side = (float)(width < height ? width : height);
    return edges->keeps_width ? edges->width : edges->width * clamped(sqrtf(side / 600.0f), 0.6f, 2.5f);
}

/* Returns the side of the largest box of creases that are dropped, in pixels between centres. */
static uint32_t speck_pixels_of(uint32_t width, uint32_t height)
{
    const uint32_t side = ((width < height ? width : height) + 25) / 50;
    return side < 5 ? 5 : side > 64 ? 64 : side;
}

static struct zr_edge_rule make_rule(const struct zr_edges *edges, const struct zr_pixel_scale *scale, uint32_t side)
{
    double sine, cosine;
    zr_sine_cosine((double)edges->crease_degrees, &sine, &cosine);
    return (struct zr_edge_rule){
        .scale = *scale, .limit = jump / (scale->scale * (float)side), .cosine = (float)cosine};
}

struct zr_edge_marks *zr_edge_marks_make(struct zr_arena *arena, uint32_t width, uint32_t height, uint32_t side,
                                         const struct zr_edges *edges, const struct zr_pixel_scale *scale)
{
    const uint32_t columns = width * side, rows = height * side, words = zr_tile_across(columns);
    struct zr_edge_marks *marks = zr_arena_alloc(arena, 1, sizeof *marks);
    uint64_t *silhouettes = zr_arena_alloc(arena, (size_t)rows * words, sizeof *silhouettes);
    uint64_t *creases = zr_arena_alloc(arena, (size_t)rows * words, sizeof *creases);
    struct zr_edge_tile *tiles = zr_arena_alloc(arena, zr_tile_count(columns, rows), sizeof *tiles);
    if (!zr_arena_ok(arena)) return NULL;
    *marks = (struct zr_edge_marks){.width = width,
                                    .height = height,
                                    .side = side,
                                    .columns = columns,
                                    .rows = rows,
                                    .words = words,
                                    .line_width = zr_edges_width_in(edges, width, height),
                                    .silhouette_opacity = edges->silhouette_opacity,
                                    .crease_opacity = edges->crease_opacity,
                                    .speck_pixels = speck_pixels_of(width, height),
                                    .rule = make_rule(edges, scale, side),
                                    .silhouettes = silhouettes,
                                    .creases = creases,
                                    .tiles = tiles};
    return marks;
}

bool zr_edges_set_faces(struct zr_edge_marks *marks, struct zr_arena *arena, const struct zr_geometry *geometry,
                        const struct zr_scene_attributes *attributes)
{
    marks->faces = (struct zr_edge_faces){geometry, attributes->of_draw};
    marks->rule.faces = &marks->faces;
    return zr_edge_caps_list(arena, geometry, &marks->rule.caps);
}

/* ---- within tiles ---- */

/* Returns the index of the tile's word in its row y. */
static size_t word_of(const struct zr_edge_marks *marks, uint32_t number, uint32_t y)
{
    const uint32_t row = number / marks->words * SIZE + y;
    return (size_t)row * marks->words + number % marks->words;
}

static uint32_t rows_of(const struct zr_edge_marks *marks, uint32_t number)
{
    const uint32_t left = marks->rows - number / marks->words * SIZE;
    return left < SIZE ? left : SIZE;
}

static uint32_t columns_of(const struct zr_edge_marks *marks, uint32_t number)
{
    const uint32_t left = marks->columns - number % marks->words * SIZE;
    return left < SIZE ? left : SIZE;
}

/* Copies `count` samples from `at` on, `step` apart. */
static void keep_side(const struct zr_gbuffer *tile, ptrdiff_t at, ptrdiff_t step, int32_t count,
                      struct zr_edge_side *side)
{
    for (int32_t i = 0; i < count; i++)
        side->owner[i] = tile->owner[at + i * step];
    for (int k = 0; k < 3; k++)
        for (int32_t i = 0; i < count; i++) {
            side->normal[k][i] = tile->normal[k][at + i * step];
            side->point[k][i] = tile->point[k][at + i * step];
        }
}

void zr_edges_mark_tile(struct zr_edge_marks *marks, enum zr_isa isa, uint32_t number, const struct zr_gbuffer *tile,
                        const struct zr_sample_pairs *pairs)
{
    struct zr_edge_bits bits[SIZE];
    struct zr_sample_pairs all;
    if (!pairs) memset(&all, 0xFF, sizeof all);
    zr_edge_tile_of(isa)(&marks->rule, tile, pairs ? pairs : &all, bits);
    for (int32_t y = 0; y < tile->height; y++) {
        const size_t word = word_of(marks, number, (uint32_t)y);
        marks->silhouettes[word] = bits[y].silhouettes;
        marks->creases[word] = bits[y].creases;
    }
    struct zr_edge_tile *kept = &marks->tiles[number];
    kept->is_empty = false;
    keep_side(tile, 0, 1, tile->width, &kept->sides[ZR_EDGE_BOTTOM]);
    keep_side(tile, (tile->height - 1) * tile->stride, 1, tile->width, &kept->sides[ZR_EDGE_TOP]);
    keep_side(tile, 0, tile->stride, tile->height, &kept->sides[ZR_EDGE_LEFT]);
    keep_side(tile, tile->width - 1, tile->stride, tile->height, &kept->sides[ZR_EDGE_RIGHT]);
}

void zr_edges_mark_empty(struct zr_edge_marks *marks, uint32_t number)
{
    for (uint32_t y = 0; y < rows_of(marks, number); y++) {
        const size_t word = word_of(marks, number, y);
        marks->silhouettes[word] = 0;
        marks->creases[word] = 0;
    }
    marks->tiles[number].is_empty = true;
}

/* ---- between tiles ---- */

static struct zr_edge_line line_of(const struct zr_edge_tile *tile, int which)
{
    static const struct zr_edge_side uncovered;
    const struct zr_edge_side *side = tile->is_empty ? &uncovered : &tile->sides[which];
    struct zr_edge_line line = {.owner = side->owner};
    for (int k = 0; k < 3; k++) {
        line.normal[k] = side->normal[k];
        line.point[k] = side->point[k];
    }
    return line;
}

struct join {
    struct zr_edge_marks *marks;
    zr_edge_pairs_fn *compare;
    const struct zr_cancel *cancel;
};

/* Compares side `which` of a tile with the opposite side of its neighbour. */
static struct zr_edge_bits compare_sides(const struct join *join, uint32_t number, int which, uint32_t neighbour,
                                         uint32_t count)
{
    static const int opposite[ZR_EDGE_SIDES] = {[ZR_EDGE_BOTTOM] = ZR_EDGE_TOP,
                                                [ZR_EDGE_TOP] = ZR_EDGE_BOTTOM,
                                                [ZR_EDGE_LEFT] = ZR_EDGE_RIGHT,
                                                [ZR_EDGE_RIGHT] = ZR_EDGE_LEFT};
    const struct zr_edge_tile *own = &join->marks->tiles[number], *other = &join->marks->tiles[neighbour];
    if (own->is_empty && other->is_empty) return (struct zr_edge_bits){0, 0};
    const struct zr_edge_line a = line_of(own, which), b = line_of(other, opposite[which]);
    return join->compare(&join->marks->rule, &a, &b, (int32_t)count);
}

static void mark_row(struct zr_edge_marks *marks, uint32_t number, uint32_t y, struct zr_edge_bits bits)
{
    const size_t word = word_of(marks, number, y);
    marks->silhouettes[word] |= bits.silhouettes;
    marks->creases[word] |= bits.creases;
}

static void mark_column(struct zr_edge_marks *marks, uint32_t number, uint32_t x, struct zr_edge_bits bits)
{
    if (!(bits.silhouettes | bits.creases)) return;
    for (uint32_t y = 0; y < rows_of(marks, number); y++) {
        const struct zr_edge_bits bit = {(bits.silhouettes >> y & 1) << x, (bits.creases >> y & 1) << x};
        mark_row(marks, number, y, bit);
    }
}

/* Marks the tile's own samples only: each pair is compared twice, so that no two threads write to one word. */
static void join_tile(const struct join *join, uint32_t number)
{
    struct zr_edge_marks *marks = join->marks;
    const uint32_t words = marks->words, x = number % words, width = columns_of(marks, number),
                   height = rows_of(marks, number);
    if (x > 0) mark_column(marks, number, 0, compare_sides(join, number, ZR_EDGE_LEFT, number - 1, height));
    if (x + 1 < words)
        mark_column(marks, number, width - 1, compare_sides(join, number, ZR_EDGE_RIGHT, number + 1, height));
    if (number >= words) mark_row(marks, number, 0, compare_sides(join, number, ZR_EDGE_BOTTOM, number - words, width));
    if ((number / words + 1) * SIZE < marks->rows)
        mark_row(marks, number, height - 1, compare_sides(join, number, ZR_EDGE_TOP, number + words, width));
}

static void join_tiles(void *context, size_t begin, size_t end)
{
    const struct join *join = context;
    if (zr_is_cancelled(join->cancel)) return;
    for (size_t number = begin; number < end; number++)
        join_tile(join, (uint32_t)number);
}

const float *zr_edges_finish(const struct zr_run *run, struct zr_edge_marks *marks)
{
    const size_t pixels = (size_t)marks->width * marks->height;
    float *opacity = zr_arena_alloc(run->arena, pixels + ZR_EDGE_ROOM, sizeof *opacity);
    if (!opacity) return NULL;
    memset(opacity + pixels, 0, ZR_EDGE_ROOM * sizeof *opacity);
    struct join join = {marks, zr_edge_pairs_of(zr_team_isa(run->team)), run->cancel};
    zr_team_ranges(run->team, zr_tile_count(marks->columns, marks->rows), marks->words, join_tiles, &join);
    if (!zr_edge_specks_drop(run, marks) || !zr_edge_width_cover(run, marks, opacity)) return NULL;
    return opacity;
}
