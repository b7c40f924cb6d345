#include "shade/paint.h"

#include "raster/tile_simd.h"
#include "shade/models_simd.h"
#include "shade/parts_simd.h"
#include "shade/planes_simd.h"
#include "shade/words_simd.h"

/* Parts that follow one another, up to ZR_LANES of them, all of one batch; NULL: nobody's. */
struct run {
    const struct zr_batch *batch;
    uint32_t first, count;
};

/* What is known of parts. A part is flat, and has a word, or has planes. */
struct shading {
    const struct zr_geometry *geometry;
    const struct zr_batch *batch; /* of the last run: at first the first one */
    uint32_t nothing;
    struct zr_parts parts;
    uint32_t run_count;
    struct run runs[ZR_PARTS_MOST];
    bool any_planes;
    bool has_planes[ZR_PARTS_ROOM];
    uint32_t words[ZR_PARTS_ROOM];
    const struct zr_material
        *materials[ZR_PARTS_ROOM]; /* NULL: what planes show is what is seen; said where any is late */
    bool any_late;
    struct zr_model_context model;
    /* Some for each part, one part after the other: of 1/w, and of each of its values. */
    float planes[ZR_PARTS_ROOM * (1 + ZR_VALUES_MOST)][4]; /* a0, dadx, dady */
};

/* ---- runs of parts ---- */

/* Numbers of the run's triangles in its batch; lanes behind its end have the first one's. */
static inline zr_vi numbers_of(const struct shading *s, const struct run *run)
{
    const uint32_t *owners = s->parts.owners + run->first;
    const zr_vi owner = zr_vi_select(zr_vm_first(run->count), zr_vi_load(owners), zr_vi_set((int32_t)owners[0]));
    return owner - zr_vi_set((int32_t)run->batch->first + 1);
}

static inline void find_runs(struct shading *s)
{
    uint32_t *owners = s->parts.owners;
    s->run_count = 0;
    for (uint32_t i = 0, count; i < s->parts.count; i += count) {
        const uint32_t left = s->parts.count - i;
        struct run *run = &s->runs[s->run_count++];
        if (owners[i] == 0) {
            *run = (struct run){NULL, i, count = 1};
            continue;
        }
        s->batch = zr_batch_next(s->geometry, s->batch, owners[i] - 1);
        const zr_vi t = zr_vi_load(owners + i) - zr_vi_set((int32_t)s->batch->first + 1);
        const zr_vm of_batch = zr_vi_lt_where(zr_vi_lt(zr_vi_set(-1), t), t, zr_vi_set((int32_t)s->batch->count));
        const uint32_t others = zr_vm_bits(of_batch) ^ ZR_ALL_BITS;
        count = others ? (uint32_t)zr_lowest_bit(others) : ZR_LANES;
        count = count < left ? count : left;
        *run = (struct run){s->batch, i, count};
    }
}

static inline void put_words(struct shading *s, const struct run *run, zr_vi words)
{
    zr_vi_store(s->words + run->first, words);
    memset(s->has_planes + run->first, false, ZR_LANES);
}

/* ---- colours ---- */

/* Where they stand is found, and asked for: by the time that it is looked at, it has come from memory. */
static inline void expect_colors(struct shading *s, const struct run *run)
{
    if (!run->batch || !zr_batch_is_gathered(run->batch)) return;
    const zr_vi numbers = numbers_of(s, run);
    if (zr_batch_is_smooth(run->batch)) {
        zr_smooth_expect(run->batch, s->geometry->vertices, numbers);
        return;
    }
    int32_t places[ZR_LANES];
    zr_vi_store(places, zr_flat_number(run->batch, ZR_ALL_LANES, numbers));
    for (int i = 0; i < ZR_LANES; i++)
        __builtin_prefetch(run->batch->packed ? (const void *)&run->batch->packed[places[i]]
                                              : (const void *)zr_flat_at(run->batch, places[i]));
}

/* Plane k of ZR_LANES parts. */
static inline void put_plane(struct shading *s, uint32_t first, int k, int count, const struct zr_plane_v *plane)
{
    float fours[4 * ZR_LANES];
    zr_vf_store4(fours, plane->a0, plane->dadx, plane->dady, zr_vf_set(0.0f));
    for (uint32_t i = 0; i < ZR_LANES; i++)
        memcpy(s->planes[(first + i) * (uint32_t)count + (uint32_t)k], fours + 4 * i, 4 * sizeof(float));
}

static inline void put_three(struct shading *s, uint32_t first, int k, int count, const struct zr_color_planes *planes)
{
    put_plane(s, first, k, count, &planes->red);
    put_plane(s, first, k + 1, count, &planes->green);
    put_plane(s, first, k + 2, count, &planes->blue);
}

static void put_surface(struct shading *s, uint32_t i, const struct zr_surface *surface, int count)
{
    for (int k = 0; k < count; k++)
        memcpy(s->planes[i * (uint32_t)count + (uint32_t)k], &surface->planes[k], sizeof surface->planes[k]);
    s->has_planes[i] = s->any_planes = true;
}

/* One by itself: one that is written out, which may be a line, or of a batch with more than 32 bits can number. */
static void make_alone(struct shading *s, uint32_t i, const struct zr_batch *batch, int count)
{
    const struct zr_surface surface = zr_surface_make(s->geometry, batch, s->parts.owners[i] - 1);
    s->words[i] = surface.color;
    s->has_planes[i] = false;
    s->materials[i] = surface.material;
    s->any_late |= surface.material != NULL;
    if (!surface.flat) put_surface(s, i, &surface, count);
}

/* Of triangles whose normals and points are wanted beside their colours. */
static inline void put_late(struct shading *s, const struct run *run, int count)
{
    const struct zr_batch *batch = run->batch;
    const zr_vi numbers = numbers_of(s, run);
    struct zr_smooth_corners corners = zr_smooth_corners_of(batch, batch->colors, numbers);
    struct zr_corner_v v[3], again[3];
    struct zr_color_v values[3];
    const zr_vm turned = zr_smooth_load_corners(&corners, s->geometry->vertices, v);
    memcpy(again, v, sizeof v);
    zr_normals_load(batch, numbers, turned, values);
    const struct zr_color_planes normals = zr_color_planes_of(turned, again, values);
    memcpy(again, v, sizeof v);
    zr_values_load(s->geometry->points, corners.vertex, values);
    const struct zr_color_planes points = zr_color_planes_of(turned, again, values);
    put_three(s, run->first, 4, count, &normals);
    put_three(s, run->first, 7, count, &points);
    for (uint32_t i = run->first; i < run->first + ZR_LANES; i++)
        s->materials[i] = batch->material;
    s->any_late = true;
}

static inline void make_colors(struct shading *s, const struct run *run, int count)
{
    const struct zr_batch *batch = run->batch;
    const uint32_t first = run->first;
    if (count > 1 + ZR_VALUES_FEW)
        for (uint32_t i = first; i < first + ZR_LANES; i++)
            s->materials[i] = NULL;
    if (!batch) {
        put_words(s, run, zr_vi_set((int32_t)s->nothing));
    } else if (!zr_batch_is_gathered(batch)) {
        for (uint32_t i = first; i < first + run->count; i++)
            make_alone(s, i, batch, count);
    } else if (zr_batch_is_smooth(batch)) {
        const struct zr_color_planes planes = zr_color_planes_make(batch, s->geometry->vertices, numbers_of(s, run));
        put_plane(s, first, 0, count, &planes.oow);
        put_three(s, first, 1, count, &planes);
        memset(s->has_planes + first, true, ZR_LANES);
        s->any_planes = true;
        if (count > 1 + ZR_VALUES_FEW && zr_material_is_shaded_late(batch->material)) put_late(s, run, count);
    } else {
        const zr_vi numbers = zr_flat_number(batch, ZR_ALL_LANES, numbers_of(s, run));
        put_words(s, run, zr_flat_look_up(batch, numbers));
    }
}

/* ---- normals ---- */

/* Flat ones have planes that are the same all over, over a w of 1. */
static inline void make_normals(struct shading *s, const struct run *run)
{
    enum { COUNT = 1 + ZR_VALUES_FEW };
    const struct zr_batch *batch = run->batch;
    const uint32_t first = run->first;
    if (!batch || !zr_batch_is_gathered(batch)) {
        static const struct zr_surface none = {.planes = {{1, 0, 0}}};
        for (uint32_t i = first; i < first + run->count; i++) {
            const struct zr_surface surface =
                batch ? zr_surface_normals(s->geometry, batch, s->parts.owners[i] - 1) : none;
            put_surface(s, i, &surface, COUNT);
        }
        return;
    }
    const zr_vi numbers = numbers_of(s, run);
    const struct zr_smooth_corners corners = zr_smooth_corners_of(batch, batch->normals_rate, numbers);
    struct zr_corner_v v[3];
    struct zr_color_v values[3];
    const zr_vm turned = zr_smooth_load_corners(&corners, s->geometry->vertices, v);
    zr_normals_load(batch, numbers, turned, values);
    struct zr_color_planes planes;
    if (batch->normals_rate == ZR_BATCH_PER_FACE) {
        const zr_vf zero = zr_vf_set(0.0f);
        planes = (struct zr_color_planes){{zr_vf_set(1.0f), zero, zero},
                                          {values[0].red, zero, zero},
                                          {values[0].green, zero, zero},
                                          {values[0].blue, zero, zero}};
    } else {
        planes = zr_color_planes_of(turned, v, values);
    }
    put_plane(s, first, 0, COUNT, &planes.oow);
    put_three(s, first, 1, COUNT, &planes);
    memset(s->has_planes + first, true, ZR_LANES);
}

/* ---- ids ---- */

static inline void make_instances(struct shading *s, const struct run *run)
{
    put_words(s, run, zr_vi_set((int32_t)(run->batch ? run->batch->instance + 1 : 0)));
}

static inline void make_faces(struct shading *s, const struct run *run)
{
    const struct zr_batch *batch = run->batch;
    if (!batch)
        put_words(s, run, zr_vi_set((int32_t)s->nothing));
    else if (!batch->written)
        put_words(s, run, zr_flat_face(batch, numbers_of(s, run)));
    for (uint32_t i = run->first; batch && batch->written && i < run->first + run->count; i++) {
        s->words[i] = zr_face_id(s->geometry, batch, s->parts.owners[i] - 1);
        s->has_planes[i] = false;
    }
}

/* ---- pixels ---- */

/* What `count` parts from `first` on show in a patch, whose pixels x, y are. */
static inline zr_vi words_at(const struct shading *s, uint32_t first, uint32_t count, zr_vi owner)
{
    zr_vi words = zr_vi_set((int32_t)s->nothing);
    for (uint32_t i = first; i < first + count; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i]));
        words = zr_vi_select(here, zr_vi_set((int32_t)s->words[i]), words);
    }
    return words;
}

/* The planes of each lane, of the parts whose owners they are; of others anything. */
static inline void select_planes(const struct shading *s, uint32_t first, uint32_t count, zr_vi owner, int planes,
                                 zr_vf (*out)[3])
{
    const float(*from)[4] = &s->planes[first * (uint32_t)planes];
    for (int k = 0; k < planes; k++)
        for (int j = 0; j < 3; j++)
            out[k][j] = zr_vf_set(from[k][j]);
    for (uint32_t i = first + 1; i < first + count; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i]));
        from = &s->planes[i * (uint32_t)planes];
        for (int k = 0; k < planes; k++)
            for (int j = 0; j < 3; j++)
                out[k][j] = zr_vf_select(here, zr_vf_set(from[k][j]), out[k][j]);
    }
}

static inline zr_vf value_at(zr_vf (*planes)[3], int k, zr_vf x, zr_vf y)
{
    const struct zr_plane_v plane = {planes[k][0], planes[k][1], planes[k][2]};
    return zr_plane_at_v(&plane, x, y);
}

/* Three values from plane k on, over w. */
static inline struct zr_vec3_v three_at(zr_vf (*planes)[3], int k, zr_vf w, zr_vf x, zr_vf y)
{
    return (struct zr_vec3_v){value_at(planes, k, x, y) * w, value_at(planes, k + 1, x, y) * w,
                              value_at(planes, k + 2, x, y) * w};
}

/* Pixels of parts that are shaded late take their model's colour; the others stay. */
static inline zr_vi shade_late(const struct shading *s, uint32_t first, uint32_t count, zr_vi owner, zr_vf (*planes)[3],
                               zr_vf x, zr_vf y, zr_vi words)
{
    const zr_vf w = zr_vf_set(1.0f) / value_at(planes, 0, x, y);
    const struct zr_model_inputs in = {three_at(planes, 1, w, x, y), three_at(planes, 4, w, x, y),
                                       three_at(planes, 7, w, x, y)};
    const struct zr_material *done = NULL; /* most often there is one */
    for (uint32_t i = first; i < first + count; i++) {
        const struct zr_material *material = s->materials[i];
        if (!material || material == done) continue;
        zr_vm of_it = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
        for (uint32_t other = i; other < first + count; other++)
            if (s->materials[other] == material)
                of_it = zr_vm_or(of_it, zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[other])));
        const struct zr_vec3_v color = zr_model_color(&s->model, material, &in);
        words = zr_vi_select(of_it, zr_rgba_opaque_v(color.x, color.y, color.z), words);
        done = material;
    }
    return words;
}

static inline zr_vi shade_at(const struct shading *s, uint32_t first, uint32_t count, zr_vi owner, zr_vf x, zr_vf y,
                             int plane_count)
{
    if (!s->any_planes || count == 0) return words_at(s, first, count, owner);
    zr_vi words = zr_vi_set((int32_t)s->nothing);
    zr_vf planes[1 + ZR_VALUES_MOST][3];
    zr_vm smooth = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
    select_planes(s, first, count, owner, plane_count, planes);
    for (uint32_t i = first; i < first + count; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i]));
        if (s->has_planes[i])
            smooth = zr_vm_or(smooth, here);
        else
            words = zr_vi_select(here, zr_vi_set((int32_t)s->words[i]), words);
    }
    words = zr_vi_select(smooth,
                         zr_color_over_w(value_at(planes, 0, x, y), value_at(planes, 1, x, y),
                                         value_at(planes, 2, x, y), value_at(planes, 3, x, y)),
                         words);
    if (plane_count > 1 + ZR_VALUES_FEW && s->any_late) return shade_late(s, first, count, owner, planes, x, y, words);
    return words;
}

/* A block before it is written. */
struct block {
    _Alignas(64) uint32_t pixels[ZR_BLOCK_HEIGHT][ZR_BLOCK_WIDTH];
};

/* All of one part's. */
static inline void shade_whole_block(const struct shading *s, const struct zr_tile *tile, int number, int plane_count,
                                     struct block *out)
{
    const uint32_t part = s->parts.blocks[number].first;
    const zr_vi word = zr_vi_set((int32_t)s->words[part]), owner = zr_vi_set((int32_t)s->parts.owners[part]);
    const bool has_planes = s->has_planes[part], late = plane_count > 1 + ZR_VALUES_FEW && s->materials[part];
    zr_vf planes[1 + ZR_VALUES_MOST][3];
    const int32_t left = tile->x + number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
    zr_vf y = zr_vf_set((float)(tile->y + number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT));
    select_planes(s, part, 1, owner, plane_count, planes);
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, y = y + zr_vf_set(1.0f))
        for (int v = 0; v < ZR_BLOCK_WIDTH; v += ZR_LANES) {
            const zr_vf x = zr_vf_of(zr_vi_set(left + v) + zr_vi_ramp());
            zr_vi words = word;
            if (late)
                words = shade_late(s, part, 1, owner, planes, x, y, words);
            else if (has_planes)
                words = zr_color_over_w(value_at(planes, 0, x, y), value_at(planes, 1, x, y), value_at(planes, 2, x, y),
                                        value_at(planes, 3, x, y));
            zr_vi_store(&out->pixels[row][v], words);
        }
}

/* Where the patches of a block lie in the window. */
struct patch_place {
    zr_vi column, row; /* of each lane in its patch */
    int32_t left, low; /* of the block */
};

static inline struct patch_place place_of(const struct zr_tile *tile, int number)
{
    const zr_vi lane = zr_vi_ramp(), column = lane & zr_vi_set(ZR_PATCH_COLUMNS - 1);
    return (struct patch_place){column, (lane - column) >> (ZR_PATCH_COLUMNS == 4 ? 2 : 0),
                                tile->x + number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH,
                                tile->y + number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT};
}

static inline void shade_block(const struct shading *s, const struct zr_tile *tile, int number, int plane_count,
                               struct block *out)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    if (block->is_whole) {
        shade_whole_block(s, tile, number, plane_count, out);
        return;
    }
    const struct patch_place place = place_of(tile, number);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p++) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const uint32_t count = block->patches[p];
        const zr_vi owner = zr_vi_load_patch(tile->owner + zr_patch_first(number, p), ZR_TILE_STRIDE);
        const zr_vf fx = zr_vf_of(place.column + zr_vi_set(place.left + x));
        const zr_vf fy = zr_vf_of(place.row + zr_vi_set(place.low + y));
        zr_vi_store_patch(&out->pixels[y][x], ZR_BLOCK_WIDTH, shade_at(s, part, count, owner, fx, fy, plane_count));
        part += count;
    }
}
_Static_assert(ZR_PATCH_COLUMNS == 4 || ZR_LANES == 1, "rows are a shift");

/* Where nobody is seen, what is behind. */
static inline void put_behind(const struct zr_tile *tile, int number, const struct zr_pixel_rows *behind,
                              struct block *out)
{
    const uint32_t *owners = &tile->owner[zr_block_first(number)], *from = behind->first;
    const int32_t left = number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH, low = number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    for (int32_t y = 0; y < ZR_BLOCK_HEIGHT && low + y < tile->height; y++)
        for (int32_t x = 0; x < ZR_BLOCK_WIDTH && left + x < tile->width; x++)
            if (owners[y * ZR_TILE_STRIDE + x] == 0) out->pixels[y][x] = from[(low + y) * behind->stride + left + x];
}

static inline void put_known(const struct zr_tile *tile, int number, struct block *out)
{
    const uint32_t *known = &tile->color[zr_block_first(number)];
    for (int y = 0; y < ZR_BLOCK_HEIGHT; y++, known += ZR_TILE_STRIDE)
        for (int x = 0; x < ZR_BLOCK_WIDTH; x += ZR_LANES) {
            const zr_vi color = zr_vi_load(known + x);
            const zr_vm unknown = zr_vi_eq(color, zr_vi_set(0));
            zr_vi_store(&out->pixels[y][x], zr_vi_select(unknown, zr_vi_load(&out->pixels[y][x]), color));
        }
}

/* The part of the block that lies in the window. */
static inline void write_block(const struct zr_tile *tile, int number, const struct block *block,
                               const struct zr_pixel_rows *out)
{
    const int32_t left = number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH, low = number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    const int32_t columns = tile->width - left < ZR_BLOCK_WIDTH ? tile->width - left : ZR_BLOCK_WIDTH;
    uint32_t *to = out->first + low * out->stride + left;
    for (int32_t y = 0; y < ZR_BLOCK_HEIGHT && low + y < tile->height; y++, to += out->stride) {
        int32_t x = 0;
        for (; x + ZR_LANES <= columns; x += ZR_LANES)
            zr_vi_put(to + x, zr_vi_load(&block->pixels[y][x]), out->streamed);
        if (x < columns) zr_vi_store_first(to + x, zr_vi_load(&block->pixels[y][x]), (uint32_t)(columns - x));
    }
}

/* A block that is one word, all of which lies in the window. */
static inline void write_word(int number, zr_vi word, const struct zr_pixel_rows *out)
{
    const int32_t left = number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH, low = number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    uint32_t *to = out->first + low * out->stride + left;
    for (int32_t y = 0; y < ZR_BLOCK_HEIGHT; y++, to += out->stride)
        for (int32_t x = 0; x < ZR_BLOCK_WIDTH; x += ZR_LANES)
            zr_vi_put(to + x, word, out->streamed);
}

static inline void finish_block(const struct shading *s, const struct zr_tile *tile, int number, bool with_known,
                                int plane_count, const struct zr_pixel_rows *behind, const struct zr_pixel_rows *out)
{
    const struct zr_block_parts *parts = &s->parts.blocks[number];
    struct block block;
    if (parts->is_whole && !s->has_planes[parts->first] && !behind && zr_tile_has_whole_blocks(tile)) {
        write_word(number, zr_vi_set((int32_t)s->words[parts->first]), out);
        return;
    }
    shade_block(s, tile, number, plane_count, &block);
    if (with_known) put_known(tile, number, &block);
    if (behind) put_behind(tile, number, behind, &block);
    write_block(tile, number, &block, out);
}

/* Blocks begin .. end - 1 of a channel, whose parts have been made. */
static inline void finish_blocks(const struct shading *s, const struct zr_tile *tile, int begin, int end,
                                 bool with_known, int plane_count, const struct zr_pixel_rows *behind,
                                 const struct zr_pixel_rows *out)
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    for (int b = begin; b < end; b++)
        if (b % ZR_BLOCK_COLUMNS < across) finish_block(s, tile, b, with_known, plane_count, behind, out);
}

/* Finds what is seen from block `begin` on, as many rows of blocks as there is room for. Returns where it ended. */
static inline int find_parts(struct shading *s, const struct zr_tile *tile, int begin, bool without_known)
{
    const int end = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    int row = begin;
    s->parts.count = 0;
    for (; row < end && s->parts.count + ZR_PARTS_A_ROW <= ZR_PARTS_MOST; row += ZR_BLOCK_COLUMNS)
        for (int b = row; b < row + across; b++)
            zr_parts_find(&s->parts, tile, b, without_known);
    find_runs(s);
    return row;
}

static inline void shade_colors_by(struct shading *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_shaded *to, int plane_count)
{
    for (uint32_t i = 0; i < s->run_count; i++)
        expect_colors(s, &s->runs[i]);
    for (uint32_t i = 0; i < s->run_count; i++)
        make_colors(s, &s->runs[i], plane_count);
    finish_blocks(s, tile, begin, end, tile->has_colors, plane_count, to->behind.first ? &to->behind : NULL,
                  &to->colors);
}

/* How many planes there are is known when this is compiled: else they would not stay in registers. */
static inline void shade_colors(struct shading *s, const struct zr_tile *tile, int begin, int end,
                                const struct zr_shaded *to)
{
    s->nothing = to->nothing;
    s->any_planes = s->any_late = false;
    if (to->is_shaded_late)
        shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_MOST);
    else
        shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_FEW);
}

/* ---- normals of pixels ---- */

/* To three floats a pixel, one after the other; lanes that are nobody's are left out. */
static inline void put_normals(struct zr_vec3_v n, uint32_t lanes, const struct zr_shaded *to, const float *x,
                               const float *y, int32_t tile_x, int32_t tile_y)
{
    float each[3][ZR_LANES];
    zr_vf_store(each[0], n.x);
    zr_vf_store(each[1], n.y);
    zr_vf_store(each[2], n.z);
    for (; lanes; lanes &= lanes - 1) {
        const int i = zr_lowest_bit(lanes);
        float *out =
            (float *)to->normals.first + ((int32_t)y[i] - tile_y) * to->normals.stride + 3 * ((int32_t)x[i] - tile_x);
        for (int k = 0; k < 3; k++)
            out[k] = each[k][i];
    }
}

static inline struct zr_vec3_v normals_at(const struct shading *s, uint32_t first, uint32_t count, zr_vi owner,
                                          const struct zr_shaded *to, zr_vf x, zr_vf y)
{
    zr_vf planes[1 + ZR_VALUES_FEW][3];
    select_planes(s, first, count, owner, 1 + ZR_VALUES_FEW, planes);
    const zr_vf w = zr_vf_set(1.0f) / value_at(planes, 0, x, y);
    const struct zr_vec3_v n = zr_normalize_v(three_at(planes, 1, w, x, y));
    const float(*m)[3] = to->normals_to_space;
    return zr_normalize_v((struct zr_vec3_v){zr_dot_v(zr_spread_v((zr_vec3){m[0][0], m[0][1], m[0][2]}), n),
                                             zr_dot_v(zr_spread_v((zr_vec3){m[1][0], m[1][1], m[1][2]}), n),
                                             zr_dot_v(zr_spread_v((zr_vec3){m[2][0], m[2][1], m[2][2]}), n)});
}

static inline void shade_normals_of_block(const struct shading *s, const struct zr_tile *tile, int number,
                                          const struct zr_shaded *to)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    const struct patch_place place = place_of(tile, number);
    const zr_vi width = zr_vi_set(tile->x + tile->width), height = zr_vi_set(tile->y + tile->height);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p++) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const uint32_t count = block->is_whole ? 1 : block->patches[p];
        const zr_vi owner = block->is_whole ? zr_vi_set((int32_t)s->parts.owners[part])
                                            : zr_vi_load_patch(tile->owner + zr_patch_first(number, p), ZR_TILE_STRIDE);
        const zr_vi column = place.column + zr_vi_set(place.left + x), row = place.row + zr_vi_set(place.low + y);
        const zr_vm within = zr_vm_and(zr_vi_lt(column, width), zr_vi_lt(row, height));
        const zr_vf fx = zr_vf_of(column), fy = zr_vf_of(row), zero = zr_vf_set(0.0f);
        struct zr_vec3_v n = {zero, zero, zero};
        float xs[ZR_LANES], ys[ZR_LANES];
        if (count > 0) n = zr_choose_v(zr_vi_lt(zr_vi_set(0), owner), normals_at(s, part, count, owner, to, fx, fy), n);
        zr_vf_store(xs, fx);
        zr_vf_store(ys, fy);
        put_normals(n, zr_vm_bits(within), to, xs, ys, tile->x, tile->y);
        if (!block->is_whole) part += count;
    }
}

static inline void shade_normals(struct shading *s, const struct zr_tile *tile, int begin, int end,
                                 const struct zr_shaded *to)
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    for (uint32_t i = 0; i < s->run_count; i++)
        make_normals(s, &s->runs[i]);
    for (int b = begin; b < end; b++)
        if (b % ZR_BLOCK_COLUMNS < across) shade_normals_of_block(s, tile, b, to);
}

/* Ids, of which there are some for each run. */
static inline void shade_ids(struct shading *s, const struct zr_tile *tile, int begin, int end,
                             void (*make)(struct shading *s, const struct run *run), const struct zr_pixel_rows *out)
{
    s->nothing = 0;
    s->any_planes = false;
    for (uint32_t i = 0; i < s->run_count; i++)
        make(s, &s->runs[i]);
    finish_blocks(s, tile, begin, end, false, 1 + ZR_VALUES_FEW, NULL, out);
}

static void shade_parts(struct shading *s, const struct zr_tile *tile, const struct zr_shaded *to, bool colors,
                        bool others)
{
    const int all = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    for (int begin = 0, end; (colors || others) && begin < all; begin = end) {
        end = find_parts(s, tile, begin, tile->has_colors && !others);
        if (colors) shade_colors(s, tile, begin, end, to);
        if (others && to->faces.first) shade_ids(s, tile, begin, end, make_faces, &to->faces);
        if (others && to->normals.first) shade_normals(s, tile, begin, end, to);
        if (others && to->instances.first) shade_ids(s, tile, begin, end, make_instances, &to->instances);
    }
}

/* Where colours are known already, what is left of them has parts of its own. */
static void shade(const struct zr_geometry *geometry, const struct zr_tile *tile, const struct zr_shaded *to)
{
    struct shading s;
    const bool together = !tile->has_colors, colors = to->colors.first;
    const bool others = to->faces.first || to->instances.first || to->normals.first;
    s.geometry = geometry;
    s.batch = &geometry->batches[0];
    s.model = (struct zr_model_context){&geometry->lighting, to->eye.w == 0.0f, {to->eye.x, to->eye.y, to->eye.z}};
    shade_parts(&s, tile, to, colors, others && together);
    if (!together) shade_parts(&s, tile, to, false, others);
}

/* ---- arrays ---- */

/* A row has room behind its end, so that the last vector may look one owner farther. */
static uint64_t ends(const uint32_t *owners, int32_t width)
{
    uint64_t out = 0;
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vi same = zr_vi_load(owners + x), next = zr_vi_load(owners + x + 1);
        out |= (uint64_t)(zr_vm_bits(zr_vi_eq(same, next)) ^ ZR_ALL_BITS) << x;
    }
    const uint64_t last = UINT64_C(1) << (width - 1);
    return (out & (last - 1)) | last;
}

static uint32_t count(const struct zr_tile *tile)
{
    uint32_t owned = 0;
    for (uint32_t bits = zr_tile_blocks(tile); bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        if (tile->knows_owners && tile->block_owner[block] != ZR_BLOCK_SHARED) {
            owned += tile->block_owner[block] > 0 ? ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT : 0;
            continue;
        }
        const uint32_t *owners = &tile->owner[zr_block_first(block)];
        for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, owners += ZR_TILE_STRIDE)
            for (int v = 0; v < ZR_BLOCK_PARTS; v++)
                owned +=
                    (uint32_t)__builtin_popcount(zr_vm_bits(zr_vi_lt(zr_vi_set(0), zr_vi_load(owners + v * ZR_LANES))));
    }
    return owned;
}

static void fill(const struct zr_pixel_rows *out, int32_t width, int32_t height, uint32_t value)
{
    const zr_vi values = zr_vi_set((int32_t)value);
    uint32_t *to = out->first;
    for (int32_t y = 0; y < height; y++, to += out->stride) {
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            zr_vi_put(to + x, values, out->streamed);
        if (x < width) zr_vi_store_first(to + x, values, (uint32_t)(width - x));
    }
}

static void copy(const struct zr_pixel_rows *out, int32_t width, int32_t height, const void *in)
{
    const uint32_t *from = in;
    uint32_t *to = out->first;
    for (int32_t y = 0; y < height; y++, from += ZR_TILE_STRIDE, to += out->stride) {
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            zr_vi_put(to + x, zr_vi_load(from + x), out->streamed);
        if (x < width) zr_vi_store_first(to + x, zr_vi_load(from + x), (uint32_t)(width - x));
    }
}

static void depths(const struct zr_tile *tile, const struct zr_pixel_rows *out)
{
    if (tile->unwritten == 0) {
        copy(out, tile->width, tile->height, tile->depth);
        return;
    }
    for (uint32_t bits = zr_tile_blocks(tile); bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        struct zr_pixel_rows to = *out;
        to.first +=
            block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT * out->stride + block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
        if (tile->unwritten >> block & 1)
            zr_block_write_depths(tile, block, (float *)to.first, to.stride, to.streamed);
        else
            copy(&to, ZR_BLOCK_WIDTH, ZR_BLOCK_HEIGHT, tile->depth + zr_block_first(block));
    }
}

const struct zr_paint ZR_KERNEL(zr_paint) = {shade, depths, count, ends, fill, copy};
