#include "raster/textbook/piece.h"

enum { FIRST_ROOM = 1024 };

/* ---- memory ---- */

/* Ensures room for one more item. The arena does not reuse the old array, so the size doubles. */
static bool reserve(struct zr_arena *arena, void **items, uint32_t count, uint32_t *room, size_t size)
{
    if (count < *room) return true;
    uint32_t more = *room < FIRST_ROOM ? FIRST_ROOM : 2 * *room;
    void *grown = *room <= UINT32_MAX / 2 ? zr_arena_grow(arena, *items, count, more, size) : NULL;
    if (!grown) return false;
    *items = grown;
    *room = more;
    return true;
}

/* Returns an empty piece, or 0 if memory ran out. */
static uint32_t new_piece(struct zr_pieces *pieces, uint32_t primitive, uint32_t id)
{
    uint32_t number = pieces->free;
    if (number > 0) {
        pieces->free = pieces->items[number].next;
    } else {
        void *items = pieces->items;
        if (!reserve(pieces->arena, &items, pieces->count, &pieces->room, sizeof *pieces->items)) return 0;
        pieces->items = items;
        number = pieces->count++;
    }
    pieces->items[number] = (struct zr_piece){.id = id,
                                              .primitive = primitive,
                                              .min_x = UINT16_MAX,
                                              .min_y = UINT16_MAX,
                                              .near = 1.0f}; /* far and max are 0: an empty range */
    return number;
}

/* Returns a span of one sample, or 0 if memory ran out. */
static uint32_t new_span(struct zr_pieces *pieces, int32_t x, int32_t y)
{
    uint32_t number = pieces->free_span;
    if (number > 0) {
        pieces->free_span = pieces->spans[number].next;
    } else {
        void *spans = pieces->spans;
        if (!reserve(pieces->arena, &spans, pieces->span_count, &pieces->span_room, sizeof *pieces->spans)) return 0;
        pieces->spans = spans;
        number = pieces->span_count++;
    }
    pieces->spans[number] = (struct zr_span){(uint16_t)y, (uint16_t)x, (uint16_t)(x + 1), 0};
    return number;
}

void zr_pieces_free(struct zr_pieces *pieces, uint32_t number)
{
    struct zr_piece *piece = &pieces->items[number];
    for (uint32_t span = piece->first_span, next; span > 0; span = next) {
        next = pieces->spans[span].next;
        pieces->spans[span].next = pieces->free_span;
        pieces->free_span = span;
    }
    piece->next = pieces->free;
    pieces->free = number;
}

/* ---- sample by sample ---- */

static void find_hits(const struct zr_pieces *pieces, const struct zr_piece *piece, int32_t y, int32_t begin,
                      int32_t end, struct zr_hit *hits)
{
    zr_primitive_hits(pieces->geometry, &pieces->primitives.items[piece->primitive], y, begin, end, hits);
}

static bool is_nearer(struct zr_hit a, struct zr_hit b)
{
    return a.depth < b.depth || (a.depth == b.depth && a.owner < b.owner);
}

/* Adds a sample to a piece whose last span is *last. Samples must come in the order of spans. */
static bool add(struct zr_pieces *pieces, uint32_t number, uint32_t *last, int32_t x, int32_t y, float depth)
{
    struct zr_span *span = &pieces->spans[*last];
    if (*last > 0 && span->y == y && span->end == x) {
        span->end++;
    } else {
        uint32_t begun = new_span(pieces, x, y);
        if (begun == 0) return false;
        if (*last > 0)
            pieces->spans[*last].next = begun;
        else
            pieces->items[number].first_span = begun;
        *last = begun;
    }
    struct zr_piece *piece = &pieces->items[number];
    piece->size++;
    if (x < piece->min_x) piece->min_x = (uint16_t)x;
    if (x > piece->max_x) piece->max_x = (uint16_t)x;
    if (y < piece->min_y) piece->min_y = (uint16_t)y;
    if (y > piece->max_y) piece->max_y = (uint16_t)y;
    if (depth < piece->near) piece->near = depth;
    if (depth > piece->far) piece->far = depth;
    return true;
}

/* ---- primitives -> pieces ---- */

/* Returns a negative number if the sample is left of the edge. */
static int64_t side_of(const struct zr_grid_edge *edge, int32_t x, int32_t y)
{
    int64_t along = (int64_t)y * ZR_SUBPIXELS - edge->y0, aside = (int64_t)x * ZR_SUBPIXELS - edge->x0;
    return aside * ((int64_t)edge->y1 - edge->y0) - along * ((int64_t)edge->x1 - edge->x0);
}

/* Returns the first column of low .. high that is not left of the edge, by bisection; assumes that `high` is not. */
static int32_t crossing(const struct zr_grid_edge *edge, int32_t y, int32_t low, int32_t high)
{
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if (side_of(edge, middle, y) >= 0)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* Toggles the marks of columns in the box at which the inside begins or ends. */
static void mark_row(const struct zr_primitive *primitive, int32_t y, bool *marks)
{
    const struct zr_grid_edge *edges = zr_primitive_edges(primitive);
    int64_t level = (int64_t)y * ZR_SUBPIXELS;
    for (uint32_t i = 0; i < primitive->edge_count; i++) {
        if (level < edges[i].y0 || level >= edges[i].y1) continue;
        int32_t x = crossing(&edges[i], y, primitive->min_x, primitive->max_x + 1);
        marks[x] = !marks[x];
    }
}

/* Adds the samples of a run, except those not nearer than the initial depth, which are never visible. */
static bool add_run(struct zr_pieces *pieces, uint32_t number, uint32_t *last, int32_t y, int32_t begin, int32_t end)
{
    const float *start = pieces->samples->depth + (size_t)y * pieces->samples->width;
    find_hits(pieces, &pieces->items[number], y, begin, end, pieces->hits);
    for (int32_t x = begin; x < end; x++) {
        float depth = pieces->hits[x - begin].depth;
        if (depth < start[x] && !add(pieces, number, last, x, y, depth)) return false;
    }
    return true;
}

static bool add_row(struct zr_pieces *pieces, uint32_t number, uint32_t *last, int32_t y)
{
    const struct zr_primitive *primitive = &pieces->primitives.items[pieces->items[number].primitive];
    int32_t end = primitive->max_x + 1, begin = end; /* start of the current run; `end`: outside */
    for (int32_t x = primitive->min_x; x <= end; x++) {
        bool ends = pieces->marks[x] || x == end;
        pieces->marks[x] = false;
        if (!ends) continue;
        if (begin < x && !add_run(pieces, number, last, y, begin, x)) return false;
        begin = begin < x ? end : x;
    }
    return true;
}

enum zr_status zr_pieces_make(struct zr_arena *arena, const struct zr_geometry *geometry,
                              const struct zr_cancel *cancel, struct zr_samples *samples, struct zr_pieces *pieces)
{
    *pieces = (struct zr_pieces){
        .arena = arena, .geometry = geometry, .cancel = cancel, .samples = samples, .count = 1, .span_count = 1};
    enum zr_status status = zr_primitives_make(arena, geometry, samples, cancel, &pieces->primitives);
    if (status != ZR_OK) return status;
    pieces->marks = zr_arena_zero(arena, (size_t)samples->width + 1, sizeof *pieces->marks);
    pieces->hits = zr_arena_alloc(arena, samples->width, sizeof *pieces->hits);
    pieces->other_hits = zr_arena_alloc(arena, samples->width, sizeof *pieces->other_hits);
    pieces->last_id = pieces->primitives.count;
    pieces->room = pieces->span_room = pieces->primitives.count + 1;
    pieces->items = zr_arena_zero(arena, pieces->room, sizeof *pieces->items);
    pieces->spans = zr_arena_zero(arena, pieces->span_room, sizeof *pieces->spans);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    for (uint32_t p = 0; p < pieces->primitives.count; p++) {
        const struct zr_primitive *primitive = &pieces->primitives.items[p];
        uint32_t number = new_piece(pieces, p, p + 1), last = 0;
        if (number == 0) return ZR_NO_MEMORY;
        for (int32_t y = primitive->min_y; y <= primitive->max_y; y++) {
            if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
            mark_row(primitive, y, pieces->marks);
            if (!add_row(pieces, number, &last, y)) return ZR_NO_MEMORY;
        }
        if (pieces->items[number].size == 0) pieces->count--; /* the newest piece: its number is reused */
    }
    return ZR_OK;
}

/* ---- two pieces ---- */

/* Counts the samples of a run, until both counts are above 0. */
static void compare_run(const struct zr_pieces *pieces, int32_t count, struct zr_overlap *overlap)
{
    for (int32_t k = 0; k < count && (overlap->nearer == 0 || overlap->farther == 0); k++) {
        if (is_nearer(pieces->hits[k], pieces->other_hits[k]))
            overlap->nearer++;
        else
            overlap->farther++;
    }
}

struct zr_overlap zr_pieces_compare(struct zr_pieces *pieces, const struct zr_piece *p, const struct zr_piece *q)
{
    struct zr_overlap overlap = {0, 0};
    uint32_t a = p->first_span, b = q->first_span;
    while (a > 0 && b > 0 && (overlap.nearer == 0 || overlap.farther == 0) && !zr_is_cancelled(pieces->cancel)) {
        const struct zr_span *s = &pieces->spans[a], *t = &pieces->spans[b];
        pieces->work++;
        int32_t begin = s->begin > t->begin ? s->begin : t->begin, end = s->end < t->end ? s->end : t->end;
        if (s->y == t->y && begin < end) {
            find_hits(pieces, p, s->y, begin, end, pieces->hits);
            find_hits(pieces, q, s->y, begin, end, pieces->other_hits);
            pieces->work += (uint64_t)(end - begin);
            compare_run(pieces, end - begin, &overlap);
        }
        bool s_ends_first = s->y < t->y || (s->y == t->y && s->end < t->end);
        if (s_ends_first)
            a = s->next;
        else
            b = t->next;
    }
    return overlap;
}

/* Marks the samples of p's run that lie in q, and with `nearer` those at which p is nearer as well. pieces->hits must
 * hold the run's hits. Advances *span to the first of q's spans that does not end before the run. */
static void mark_run(struct zr_pieces *pieces, const struct zr_span *run, uint32_t q, bool nearer, uint32_t *span)
{
    for (int32_t x = run->begin; x < run->end; x++)
        pieces->marks[x] = false;
    const struct zr_span *t = &pieces->spans[*span];
    for (; *span > 0 && (t->y < run->y || (t->y == run->y && t->end <= run->begin)); t = &pieces->spans[*span])
        *span = t->next;
    for (uint32_t s = *span; s > 0 && t->y == run->y && t->begin < run->end; s = t->next, t = &pieces->spans[s]) {
        int32_t begin = t->begin > run->begin ? t->begin : run->begin, end = t->end < run->end ? t->end : run->end;
        if (nearer) find_hits(pieces, &pieces->items[q], run->y, begin, end, pieces->other_hits);
        for (int32_t x = begin; x < end; x++)
            pieces->marks[x] = !nearer || is_nearer(pieces->hits[x - run->begin], pieces->other_hits[x - begin]);
    }
}

bool zr_pieces_split(struct zr_pieces *pieces, uint32_t p, uint32_t q, bool nearer, uint32_t *inside, uint32_t *rest)
{
    pieces->work += pieces->items[p].size;
    uint32_t primitive = pieces->items[p].primitive, in_q = pieces->items[q].first_span;
    uint32_t last[2] = {0, 0};
    uint32_t parts[2] = {new_piece(pieces, primitive, pieces->last_id + 1),
                         new_piece(pieces, primitive, pieces->last_id + 2)};
    pieces->last_id += 2;
    if (parts[0] == 0 || parts[1] == 0) return false;
    for (uint32_t number = pieces->items[p].first_span, next; number > 0 && !zr_is_cancelled(pieces->cancel);
         number = next) {
        const struct zr_span span = pieces->spans[number]; /* copied, since the array may move */
        next = span.next;
        find_hits(pieces, &pieces->items[p], span.y, span.begin, span.end, pieces->hits);
        mark_run(pieces, &span, q, nearer, &in_q);
        for (int32_t x = span.begin; x < span.end; x++) {
            int part = pieces->marks[x] ? 0 : 1;
            if (!add(pieces, parts[part], &last[part], x, span.y, pieces->hits[x - span.begin].depth)) return false;
        }
    }
    *inside = parts[0];
    *rest = parts[1];
    return true;
}

void zr_pieces_paint(struct zr_pieces *pieces, uint32_t number)
{
    const struct zr_piece *piece = &pieces->items[number];
    for (uint32_t s = piece->first_span; s > 0 && !zr_is_cancelled(pieces->cancel); s = pieces->spans[s].next) {
        const struct zr_span *span = &pieces->spans[s];
        size_t row = (size_t)span->y * pieces->samples->width;
        find_hits(pieces, piece, span->y, span->begin, span->end, pieces->hits);
        for (int32_t x = span->begin; x < span->end; x++) {
            pieces->samples->depth[row + (size_t)x] = pieces->hits[x - span->begin].depth;
            pieces->samples->owner[row + (size_t)x] = pieces->hits[x - span->begin].owner;
        }
    }
}
