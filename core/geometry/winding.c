#include "geometry/winding.h"

/* A place in a row where the winding number changes. */
struct change {
    int32_t column, sign;
};

/* A vertical edge that is not ended yet. */
struct wall {
    int32_t column, begin;
};

struct winding {
    struct zr_builder *builder;
    const struct zr_wound_edge *edges;
    const struct zr_cap_samples *cap_samples; /* NULL: no other cap lies in the plane */
    uint32_t plane;
    uint32_t *starts; /* per row from first_row on: 1 + the first edge that begins there; 0: none */
    uint32_t *next;   /* per edge: 1 + the next one that begins in the same row; 0: none */
    uint32_t *active;
    uint32_t active_count;
    struct change *changes;             /* of the row, from left to right */
    struct wall *walls, *earlier;       /* of this row, and of the one before it; ascending columns */
    uint32_t wall_count, earlier_count; /* even */
    int32_t first_row, end_row;         /* that edges cross */
};

/* ---- rows ---- */

static int32_t first_row(const struct zr_wound_edge *e)
{
    const int32_t row = zr_viewport_first_centre(e->edge.y0);
    return row > 0 ? row : 0;
}

static int32_t end_row(const struct winding *w, const struct zr_wound_edge *e)
{
    const int32_t row = zr_viewport_first_centre(e->edge.y1), height = (int32_t)w->builder->geometry->window.height;
    return row < height ? row : height;
}

/* Returns the first column whose centre is not left of the edge, within 0..width. */
static int32_t column_of(const struct winding *w, const struct zr_grid_edge *e, int32_t row)
{
    const int64_t rise = (int64_t)e->y1 - e->y0, run = (int64_t)e->x1 - e->x0, step = rise * ZR_SUBPIXELS;
    const int64_t numerator = e->x0 * rise + run * ((int64_t)row * ZR_SUBPIXELS - e->y0);
    const int32_t width = (int32_t)w->builder->geometry->window.width;
    int64_t column = numerator / step;
    if (column * step < numerator) column++;
    return column < 0 ? 0 : column < width ? (int32_t)column : width;
}

/* Sorts by column (Shell sort). Few rows have more than two changes, and most are already in order. */
static void sort(struct change *changes, uint32_t count)
{
    static const uint32_t gaps[] = {1750, 701, 301, 132, 57, 23, 10, 4, 1}; /* Ciura 2001 */
    for (size_t g = 0; g < sizeof gaps / sizeof gaps[0]; g++)
        for (uint32_t i = gaps[g]; i < count; i++) {
            const struct change value = changes[i];
            uint32_t to = i;
            for (; to >= gaps[g] && changes[to - gaps[g]].column > value.column; to -= gaps[g])
                changes[to] = changes[to - gaps[g]];
            changes[to] = value;
        }
}

static void begin_row(struct winding *w, int32_t row)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < w->active_count; i++)
        if (end_row(w, &w->edges[w->active[i]]) > row) w->active[kept++] = w->active[i];
    for (uint32_t number = w->starts[row - w->first_row]; number > 0; number = w->next[number - 1])
        w->active[kept++] = number - 1;
    w->active_count = kept;
    for (uint32_t i = 0; i < kept; i++) {
        const struct zr_wound_edge *e = &w->edges[w->active[i]];
        w->changes[i] = (struct change){column_of(w, &e->edge, row), e->sign};
    }
    sort(w->changes, kept);
}

/* Returns true if the rules differ at a sample of the row, or if another cap has taken one. */
static bool row_differs(const struct winding *w, int32_t row)
{
    int32_t number = 0;
    for (uint32_t i = 0; i < w->active_count; i++) {
        const int32_t from = i > 0 ? w->changes[i - 1].column : 0, to = w->changes[i].column;
        if (from < to && number != 0) {
            bool is_taken = false;
            if ((number & 1) == 0) return true;
            if (w->cap_samples &&
                (zr_cap_samples_run(w->cap_samples, w->plane, row, from, to, &is_taken) < to || is_taken))
                return true;
        }
        number += w->changes[i].sign;
    }
    return false;
}

/* Two walls in one column are a run without samples, or a gap without samples. */
static void add_wall(struct winding *w, int32_t column, int32_t row)
{
    if (w->wall_count > 0 && w->walls[w->wall_count - 1].column == column)
        w->wall_count--;
    else
        w->walls[w->wall_count++] = (struct wall){column, row};
}

/* Adds the free samples of a run. */
static void add_free(struct winding *w, int32_t row, int32_t begin, int32_t end)
{
    while (begin < end) {
        bool is_taken = false;
        const int32_t next =
            w->cap_samples ? zr_cap_samples_run(w->cap_samples, w->plane, row, begin, end, &is_taken) : end;
        if (!is_taken) add_wall(w, begin, row);
        if (!is_taken) add_wall(w, next, row);
        begin = next;
    }
}

/* Calls `visit` with each run of the row whose winding numbers are not 0. */
static void for_each_run(struct winding *w, int32_t row,
                         void (*visit)(struct winding *w, int32_t row, int32_t begin, int32_t end))
{
    int32_t number = 0, begin = 0;
    for (uint32_t i = 0; i < w->active_count; i++) {
        const int32_t before = number, column = w->changes[i].column;
        number += w->changes[i].sign;
        if (before == 0) begin = column;
        if (before != 0 && number == 0 && begin < column) visit(w, row, begin, column);
    }
}

static void take(struct winding *w, int32_t row, int32_t begin, int32_t end)
{
    zr_cap_samples_take(w->cap_samples, w->plane, row, begin, end);
}

/* Appends a vertical edge up to the begin of `row`. */
static bool end_wall(struct winding *w, const struct wall *wall, int32_t row)
{
    struct zr_geometry *geometry = w->builder->geometry;
    const int32_t x = wall->column * ZR_SUBPIXELS;
    if (!zr_builder_reserve_shape(w->builder, 1)) return false;
    geometry->edges[geometry->edge_count++] =
        (struct zr_grid_edge){x, wall->begin * ZR_SUBPIXELS, x, row * ZR_SUBPIXELS};
    return true;
}

/* Ends the walls of the row before that do not go on, and lets the others begin where they began. */
static bool join_walls(struct winding *w, int32_t row)
{
    uint32_t i = 0;
    for (uint32_t k = 0; k < w->earlier_count; k++) {
        while (i < w->wall_count && w->walls[i].column < w->earlier[k].column)
            i++;
        if (i < w->wall_count && w->walls[i].column == w->earlier[k].column)
            w->walls[i].begin = w->earlier[k].begin;
        else if (!end_wall(w, &w->earlier[k], row))
            return false;
    }
    struct wall *walls = w->walls;
    w->walls = w->earlier;
    w->earlier = walls;
    w->earlier_count = w->wall_count;
    return true;
}

/* ---- all rows ---- */

static void list_starts(struct winding *w, uint32_t count)
{
    for (int32_t row = w->first_row; row < w->end_row; row++)
        w->starts[row - w->first_row] = 0;
    for (uint32_t i = 0; i < count; i++) {
        const int32_t row = first_row(&w->edges[i]);
        if (row >= end_row(w, &w->edges[i])) continue;
        w->next[i] = w->starts[row - w->first_row];
        w->starts[row - w->first_row] = i + 1;
    }
    w->active_count = 0;
}

static void find_rows(struct winding *w, uint32_t count)
{
    w->first_row = (int32_t)w->builder->geometry->window.height;
    w->end_row = 0;
    for (uint32_t i = 0; i < count; i++) {
        const int32_t first = first_row(&w->edges[i]), end = end_row(w, &w->edges[i]);
        if (first >= end) continue;
        if (first < w->first_row) w->first_row = first;
        if (end > w->end_row) w->end_row = end;
    }
}

/* Returns true if the rules differ somewhere. */
static bool differs(struct winding *w, uint32_t count)
{
    list_starts(w, count);
    for (int32_t row = w->first_row; row < w->end_row; row++) {
        begin_row(w, row);
        if (!zr_builder_go_on(w->builder, w->active_count)) return false;
        if (row_differs(w, row)) return true;
    }
    return false;
}

static bool add_walls(struct winding *w, uint32_t count)
{
    list_starts(w, count);
    for (int32_t row = w->first_row; row < w->end_row; row++) {
        begin_row(w, row);
        if (!zr_builder_go_on(w->builder, w->active_count)) return false;
        w->wall_count = 0;
        for_each_run(w, row, add_free);
        if (w->cap_samples) for_each_run(w, row, take);
        if (!join_walls(w, row)) return false;
    }
    w->wall_count = 0;
    return join_walls(w, w->end_row);
}

static bool take_rows(struct winding *w, uint32_t count)
{
    list_starts(w, count);
    for (int32_t row = w->first_row; row < w->end_row; row++) {
        begin_row(w, row);
        if (!zr_builder_go_on(w->builder, w->active_count)) return false;
        for_each_run(w, row, take);
    }
    return true;
}

/* ---- scratch ---- */

/* Bytes per edge of the arrays by edge. */
enum { NUMBER_BYTES = 2 * sizeof(uint32_t) + sizeof(struct change) };

static bool make_rooms(struct zr_builder *builder, uint32_t count, struct winding *w)
{
    struct zr_winding_scratch *scratch = &builder->winding;
    const struct zr_window *window = &builder->geometry->window;
    const size_t columns = (size_t)window->width + 1;
    if (!scratch->rows) {
        scratch->rows = zr_arena_alloc(builder->run->arena, window->height, sizeof *w->starts);
        scratch->walls = zr_arena_alloc(builder->run->arena, 2 * columns, sizeof *w->walls);
        if (!zr_cap_samples_make(builder->run->arena, builder->scene, window->width, window->height,
                                 &scratch->cap_samples))
            return false;
    }
    if (count > scratch->number_room) {
        scratch->number_room = scratch->edge_room; /* grows by doubling */
        scratch->numbers = zr_arena_alloc(builder->run->arena, scratch->number_room, NUMBER_BYTES);
    }
    if (!zr_arena_ok(builder->run->arena)) return false;
    const size_t room = scratch->number_room;
    w->starts = scratch->rows;
    w->walls = scratch->walls;
    w->earlier = w->walls + columns;
    w->changes = scratch->numbers;
    w->next = (uint32_t *)(void *)(w->changes + room);
    w->active = w->next + room;
    return true;
}

void zr_winding_note(struct zr_builder *builder, const struct zr_grid_edge *edge, int32_t sign)
{
    enum { EDGES_AT_FIRST = 64 };
    struct zr_winding_scratch *scratch = &builder->winding;
    if (scratch->edge_count == scratch->edge_room) {
        const uint32_t room = scratch->edge_room == 0 ? EDGES_AT_FIRST : 2 * scratch->edge_room;
        void *grown = room < ZR_GEOMETRY_MAX ? zr_arena_grow(builder->run->arena, scratch->edges, scratch->edge_count,
                                                             room, sizeof *scratch->edges)
                                             : NULL;
        if (!grown) {
            builder->run->arena->failed = true;
            return;
        }
        scratch->edges = grown;
        scratch->edge_room = room;
    }
    scratch->edges[scratch->edge_count++] = (struct zr_wound_edge){*edge, sign};
}

bool zr_winding_add(struct zr_builder *builder, uint32_t cap)
{
    struct zr_geometry *geometry = builder->geometry;
    const uint32_t count = builder->winding.edge_count;
    struct winding w = {.builder = builder, .edges = builder->winding.edges};
    builder->winding.edge_count = 0;
    if (count == 0) return zr_arena_ok(builder->run->arena);
    if (!zr_arena_ok(builder->run->arena) || !make_rooms(builder, count, &w)) return false;
    w.plane = builder->mesh->cap_planes ? builder->mesh->cap_planes[cap] : 0;
    const uint32_t face = builder->mesh->face_count - builder->mesh->cap_count + cap;
    const struct zr_material *material = zr_material_of_face(builder->scene, builder->mesh, face);
    const bool takes_samples = material->alpha_mode == ZR_ALPHA_OPAQUE && !material->is_operand;
    if (takes_samples && builder->winding.cap_samples.bits[w.plane]) w.cap_samples = &builder->winding.cap_samples;
    find_rows(&w, count);
    if (differs(&w, count)) return add_walls(&w, count);
    if (zr_is_cancelled(builder->run->cancel) || !zr_builder_reserve_shape(builder, count)) return false;
    for (uint32_t i = 0; i < count; i++)
        geometry->edges[geometry->edge_count++] = w.edges[i].edge;
    return !w.cap_samples || take_rows(&w, count);
}
