#include "support/pictures/replay.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/cmocka_all.h"
#include "support/pictures/replay_parts.h"

struct replay_play replay_play;

void replay_fail(const char *condition, const char *format, ...)
{
    char text[400];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    fail_msg("%s: %s (%s)", replay_play.name, text, condition);
}

/* ---- geometry ---- */

/* Returns the first column whose centre is not left of the edge. */
static int64_t crossing(const int64_t edge[4], int y)
{
    const int64_t rise = edge[3] - edge[1], step = rise * 256;
    const int64_t parts = edge[0] * rise + (edge[2] - edge[0]) * (256 * (int64_t)y - edge[1]);
    return parts > 0 ? (parts + step - 1) / step : -(-parts / step);
}

static bool crosses(const int64_t edge[4], int y)
{
    return edge[1] <= 256 * (int64_t)y && 256 * (int64_t)y < edge[3];
}

bool replay_covers(const struct primitive *p, int x, int y)
{
    bool is_inside = false;
    for (uint32_t i = 0; i < p->edge_count; i++)
        if (crosses(replay_play.edges[p->first_edge + i], y) && crossing(replay_play.edges[p->first_edge + i], y) <= x)
            is_inside = !is_inside;
    return is_inside;
}

static int compare_wholes(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

/* Lists where edges cross a row, clamped to the window; sorted. */
static int list_crossings(const struct primitive *p, int y, int *xs)
{
    int count = 0;
    for (uint32_t i = 0; i < p->edge_count; i++) {
        const int64_t *edge = replay_play.edges[p->first_edge + i];
        if (!crosses(edge, y)) continue;
        const int64_t x = crossing(edge, y);
        xs[count++] = x < 0 ? 0 : x > replay_play.width ? replay_play.width : (int)x;
    }
    qsort(xs, (size_t)count, sizeof *xs, compare_wholes);
    return count;
}

static void read_primitives(const cJSON *list)
{
    const cJSON *item, *edge;
    cJSON_ArrayForEach(item, list)
    {
        struct primitive *p = &replay_play.primitives[++replay_play.count];
        CHECK(replay_play.count <= PRIMITIVES && whole(item, "id") == replay_play.count, "id of primitive %d",
              replay_play.count);
        p->face_id = (uint32_t)whole(item, "faceId");
        p->first_edge = replay_play.edge_count;
        p->is_triangle = strcmp(member(item, "kind")->valuestring, "triangle") == 0;
        p->is_flat = !has(item, "triangles") || length(member(item, "triangles")) == 1;
        replay_play.out->polygons += strcmp(member(item, "kind")->valuestring, "polygon") == 0;
        CHECK(length(member(item, p->is_triangle || !has(item, "triangles") ? "corners" : "triangles")) > 0, "corners");
        cJSON_ArrayForEach(edge, member(item, "edges"))
        {
            for (int k = 0; k < 4; k++) {
                const double grid = 256.0 * number_of(at(edge, k));
                replay_play.edges[replay_play.edge_count][k] = (int64_t)grid;
                CHECK(grid == (double)(int64_t)grid, "%g is beside the grid", grid);
            }
            CHECK(replay_play.edges[replay_play.edge_count][1] < replay_play.edges[replay_play.edge_count][3],
                  "an edge runs down");
            CHECK(++replay_play.edge_count < EDGES, "too many edges");
        }
        p->edge_count = replay_play.edge_count - p->first_edge;
    }
}

/* ---- z-buffer ---- */

/* Plays back spans with their z-tests, and marks their samples. */
static void draw_spans(const cJSON *row, int id, int y, bool drawn[SIDE])
{
    const cJSON *spans = member(row, "spans"), *z = member(row, "z");
    const cJSON *written = member(row, "written")->child, *lost = member(row, "lost")->child;
    CHECK(y >= 0 && y < replay_play.height && length(spans) == length(z), "row %d", y);
    for (int i = 0; i < length(spans); i++) {
        const int x0 = whole_of(at(at(spans, i), 0)), x1 = whole_of(at(at(spans, i), 1));
        CHECK(x0 >= 0 && x0 < x1 && x1 <= replay_play.width && length(at(z, i)) == x1 - x0, "span %d, %d", x0, x1);
        for (int x = x0; x < x1; x++) {
            const float depth = (float)number_of(at(at(z, i), x - x0));
            const bool passes = depth < replay_play.depth[y][x];
            const cJSON **list = passes ? &written : &lost;
            CHECK(*list && whole_of(*list) == x, "the z-test of %d, %d: %.9g", x, y, (double)depth);
            *list = (*list)->next;
            drawn[x] = true;
            replay_play.out->lost += !passes;
            if (!passes) continue;
            replay_play.depth[y][x] = depth;
            replay_play.shown[y][x] = (uint32_t)id;
        }
    }
    CHECK(!written && !lost, "more samples than the spans of row %d have", y);
}

static void check_covered(const struct primitive *p, int y, const bool drawn[SIDE])
{
    for (int x = 0; x < replay_play.width; x++)
        CHECK(drawn[x] == replay_covers(p, x, y), "coverage of %d, %d", x, y);
}

/* Checks that the spans are those between crossings, in pairs. */
static void check_pairs(const cJSON *spans, const int *xs, int count)
{
    const cJSON *span = spans->child;
    for (int i = 0; i + 1 < count; i += 2) {
        if (xs[i] >= xs[i + 1]) continue;
        CHECK(span && whole_of(at(span, 0)) == xs[i] && whole_of(at(span, 1)) == xs[i + 1], "span %d, %d", xs[i],
              xs[i + 1]);
        span = span->next;
    }
    CHECK(!span, "a span too many");
}

static void play_edgelist(const cJSON *step)
{
    static int xs[EDGES];
    const int id = whole(step, "primitive"), y = whole(step, "row");
    const struct primitive *p = primitive_of(id);
    const int count = list_crossings(p, y, xs);
    bool drawn[SIDE] = {false};
    CHECK(length(member(step, "xs")) == count, "crossings of row %d", y);
    for (int i = 0; i < count; i++)
        CHECK(whole_of(at(member(step, "xs"), i)) == xs[i], "crossing %d of row %d", i, y);
    check_pairs(member(step, "spans"), xs, count);
    draw_spans(step, id, y, drawn);
    check_covered(p, y, drawn);
}

/* ---- trapezoids ---- */

static struct {
    int id, row, top, count;
    struct side {
        int64_t x, excess, step, rest, parts;
    } sides[EDGES];
} band;

static void read_side(const cJSON *item, const struct primitive *p, struct side *side)
{
    const int edge = whole(item, "edge");
    *side = (struct side){long_at(item, "x"), long_at(item, "excess"), long_at(item, "step"), long_at(item, "rest"),
                          long_at(item, "parts")};
    CHECK(edge >= 0 && (uint32_t)edge < p->edge_count, "edge %d", edge);
    CHECK(crossing(replay_play.edges[p->first_edge + (uint32_t)edge], band.row) == side->x, "the first x of edge %d",
          edge);
    CHECK(side->excess >= 0 && side->excess < side->parts && side->rest >= 0 && side->rest < side->parts, "parts");
}

static void begin_band(const cJSON *step)
{
    const cJSON *item;
    CHECK(band.id == 0 || band.id != whole(step, "primitive") || whole(step, "bottom") >= band.row, "a band goes down");
    band.id = whole(step, "primitive");
    band.row = whole(step, "bottom");
    band.top = whole(step, "top");
    band.count = 0;
    cJSON_ArrayForEach(item, member(step, "trapezoids"))
    {
        read_side(member(item, "left"), primitive_of(band.id), &band.sides[band.count++]);
        read_side(member(item, "right"), primitive_of(band.id), &band.sides[band.count++]);
    }
}

static void play_trapezoid(const cJSON *step)
{
    static int xs[EDGES];
    bool drawn[SIDE] = {false};
    if (has(step, "trapezoids")) {
        begin_band(step);
        return;
    }
    CHECK(whole(step, "primitive") == band.id && whole(step, "row") == band.row && band.row < band.top, "row %d",
          band.row);
    for (int i = 0; i < band.count; i++) {
        struct side *side = &band.sides[i];
        xs[i] = side->x < 0 ? 0 : side->x > replay_play.width ? replay_play.width : (int)side->x;
        side->x += side->step;
        side->excess -= side->rest;
        if (side->excess >= 0) continue;
        side->x++;
        side->excess += side->parts;
    }
    check_pairs(member(step, "spans"), xs, band.count);
    draw_spans(step, band.id, band.row, drawn);
    check_covered(primitive_of(band.id), band.row, drawn);
    band.row++;
}

/* ---- scanline ---- */

static bool lists(const cJSON *list, int id)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list) if (whole_of(item) == id) return true;
    return false;
}

/* Edges left of the window count as at 0. */
static void check_active(const cJSON *active, int y)
{
    int count = 0, before = 0;
    const cJSON *item;
    for (int id = 1; id <= replay_play.count; id++)
        for (uint32_t i = 0; i < replay_play.primitives[id].edge_count; i++) {
            const int64_t *edge = replay_play.edges[replay_play.primitives[id].first_edge + i];
            count += crosses(edge, y) && crossing(edge, y) < replay_play.width;
        }
    CHECK(length(active) == count, "active edges of row %d", y);
    cJSON_ArrayForEach(item, active)
    {
        const int x = whole_of(at(item, 1)) > 0 ? whole_of(at(item, 1)) : 0;
        CHECK(x >= before, "active edges are not sorted");
        before = x;
    }
}

/* Checks that a primitive is left out only behind another. */
static void check_left(const cJSON *span)
{
    double least_far = 1.0;
    const cJSON *item;
    cJSON_ArrayForEach(item, member(span, "inside"))
    {
        const double a = number_of(at(item, 1)), b = number_of(at(item, 2)), far = a > b ? a : b;
        if (primitive_of(whole_of(at(item, 0)))->is_flat && far < least_far) least_far = far;
    }
    cJSON_ArrayForEach(item, member(span, "inside"))
    {
        const double a = number_of(at(item, 1)), b = number_of(at(item, 2)), near = a < b ? a : b;
        const int id = whole_of(at(item, 0));
        const bool may_show = near <= least_far || !primitive_of(id)->is_flat;
        CHECK(lists(member(span, "left"), id) == may_show, "primitive %d is left", id);
    }
}

/* Checks the nearest at an end of the interval: the first in scene order on a tie. */
static void check_end(const cJSON *span, int end, int shown)
{
    double nearest = 1.0;
    int first = 0;
    const cJSON *item;
    cJSON_ArrayForEach(item, member(span, "inside"))
    {
        const double z = number_of(at(item, end));
        const int id = whole_of(at(item, 0));
        if (z < nearest || (z == nearest && first > 0 && id < first)) nearest = z, first = id;
    }
    CHECK(shown == first, "%d at an end, and %d is nearest", shown, first);
}

static void play_interval(const cJSON *span, int y)
{
    const int x0 = whole(span, "x0"), x1 = whole(span, "x1");
    const cJSON *shown = member(span, "shown"), *item;
    int x = x0, count = 0;
    for (int id = 1; id <= replay_play.count; id++) {
        const bool is_inside = replay_covers(&replay_play.primitives[id], x0, y);
        count += is_inside;
        for (int k = x0 + 1; k < x1; k++)
            CHECK(replay_covers(&replay_play.primitives[id], k, y) == is_inside, "primitive %d ends in the interval",
                  id);
    }
    CHECK(length(member(span, "inside")) == count && count > 0, "primitives at %d, %d", x0, y);
    cJSON_ArrayForEach(item, member(span, "inside"))
        CHECK(replay_covers(primitive_of(whole_of(at(item, 0))), x0, y), "a primitive is not there");
    check_left(span);
    cJSON_ArrayForEach(item, shown)
    {
        const int id = whole_of(at(item, 2));
        CHECK(whole_of(at(item, 0)) == x && (id == 0 || lists(member(span, "left"), id)), "a run at %d", x);
        for (; x < whole_of(at(item, 1)); x++)
            replay_play.shown[y][x] = (uint32_t)id;
    }
    CHECK(x == x1 && x1 <= replay_play.width, "runs end at %d", x);
    check_end(span, 1, whole_of(at(at(shown, 0), 2)));
    check_end(span, 2, whole_of(at(at(shown, length(shown) - 1), 2)));
}

static void play_scanline(const cJSON *step)
{
    const int y = whole(step, "row");
    const cJSON *span;
    bool is_in[SIDE] = {false};
    check_active(member(step, "active"), y);
    cJSON_ArrayForEach(span, member(step, "spans"))
    {
        play_interval(span, y);
        for (int x = whole(span, "x0"); x < whole(span, "x1"); x++)
            is_in[x] = true;
    }
    for (int x = 0; x < replay_play.width; x++)
        for (int id = 1; id <= replay_play.count && !is_in[x]; id++)
            CHECK(!replay_covers(&replay_play.primitives[id], x, y), "%d, %d is in no interval", x, y);
}

/* ---- halfspace ---- */

static int64_t edge_at(const cJSON *edges, int k, int x, int y)
{
    return long_of(at(at(edges, k), 0)) * x + long_of(at(at(edges, k), 1)) * y + long_of(at(at(edges, k), 2));
}

static void play_tile(const cJSON *tile, const cJSON *edges, int id, bool drawn[SIDE][SIDE], int *area)
{
    const int x0 = whole(tile, "x"), y0 = whole(tile, "y"), width = whole(tile, "width"),
              height = whole(tile, "height");
    const char *is = member(tile, "is")->valuestring;
    const cJSON *row;
    int inside = 0, outside = 0;
    for (int y = y0; y < y0 + height; y++)
        for (int x = x0; x < x0 + width; x++)
            inside += edge_at(edges, 0, x, y) > 0 && edge_at(edges, 1, x, y) > 0 && edge_at(edges, 2, x, y) > 0;
    for (int k = 0; k < 3; k++) {
        bool any = false;
        for (int y = y0; y < y0 + height; y++)
            for (int x = x0; x < x0 + width; x++)
                any |= edge_at(edges, k, x, y) > 0;
        outside += !any;
    }
    CHECK(strcmp(is, outside > 0 ? "outside" : inside == width * height ? "inside" : "mixed") == 0, "a tile is %s", is);
    replay_play.out->inner_tiles += is[0] == 'i';
    cJSON_ArrayForEach(row, member(tile, "rows")) draw_spans(row, id, whole(row, "row"), drawn[whole(row, "row")]);
    *area += width * height;
}

static void play_flips(const cJSON *row, const struct primitive *p, int id, const int box[4], bool drawn[SIDE])
{
    const int y = whole(row, "row");
    bool flags[SIDE] = {false};
    const cJSON *flip;
    CHECK(y >= box[1] && y <= box[3], "row %d", y);
    cJSON_ArrayForEach(flip, member(row, "flips")) for (int x = whole_of(flip); x <= box[2]; x++) flags[x] = !flags[x];
    draw_spans(row, id, y, drawn);
    for (int x = 0; x < replay_play.width; x++)
        CHECK(flags[x] == drawn[x] && drawn[x] == replay_covers(p, x, y), "flips of %d, %d", x, y);
}

static void play_halfspace(const cJSON *step)
{
    static bool drawn[SIDE][SIDE];
    const int id = whole(step, "primitive");
    const struct primitive *p = primitive_of(id);
    const cJSON *item;
    int box[4], area = 0;
    memset(drawn, 0, sizeof drawn);
    for (int k = 0; k < 4; k++)
        box[k] = whole_of(at(member(step, "box"), k));
    if (p->is_triangle) {
        cJSON_ArrayForEach(item, member(step, "tiles")) play_tile(item, member(step, "edges"), id, drawn, &area);
        CHECK(area == (box[2] - box[0] + 1) * (box[3] - box[1] + 1), "tiles do not fill the box");
    } else {
        cJSON_ArrayForEach(item, member(step, "rows")) play_flips(item, p, id, box, drawn[whole(item, "row")]);
    }
    for (int y = 0; y < replay_play.height; y++)
        check_covered(p, y, drawn[y]);
}

/* ---- all ---- */

static const struct {
    const char *name;
    void (*step)(const cJSON *step);
    bool has_depth;
} players[] = {{"edgelist", play_edgelist, true},
               {"trapezoid", play_trapezoid, true},
               {"scanline", play_scanline, false},
               {"painter", replay_painter, false},
               {"halfspace", play_halfspace, true}};
enum { PLAYERS = sizeof players / sizeof *players };

static void begin(const char *name, const cJSON *trace, struct replay *out)
{
    memset(&replay_play, 0, sizeof replay_play);
    memset(&band, 0, sizeof band);
    replay_painter_begin();
    memset(out, 0, sizeof *out);
    replay_play.name = name;
    replay_play.out = out;
    CHECK(trace, "not JSON");
    replay_play.width = whole(member(trace, "window"), "width");
    replay_play.height = whole(member(trace, "window"), "height");
    CHECK(replay_play.width <= SIDE && replay_play.height <= SIDE, "the window");
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            replay_play.depth[y][x] = 1.0f;
    read_primitives(member(trace, "primitives"));
}

static void end(struct replay *out)
{
    replay_painter_end();
    out->width = (uint32_t)replay_play.width;
    out->height = (uint32_t)replay_play.height;
    out->primitives = (uint32_t)replay_play.count;
    for (int y = 0; y < replay_play.height; y++)
        for (int x = 0; x < replay_play.width; x++) {
            const int place = (replay_play.height - 1 - y) * replay_play.width + x;
            const uint32_t id = replay_play.shown[y][x];
            out->face_id[place] = id > 0 ? replay_play.primitives[id].face_id : 0;
            out->depth[place] = replay_play.depth[y][x];
        }
}

void replay_trace(const char *name, const char *json, struct replay *out)
{
    cJSON *trace = cJSON_Parse(json);
    const cJSON *step;
    size_t player = 0;
    begin(name, trace, out);
    while (player < PLAYERS && strcmp(member(trace, "algorithm")->valuestring, players[player].name) != 0)
        player++;
    CHECK(player < PLAYERS, "no such algorithm");
    cJSON_ArrayForEach(step, member(trace, "steps"))
    {
        players[player].step(step);
        out->steps++;
    }
    out->has_depth = players[player].has_depth;
    end(out);
    cJSON_Delete(trace);
}
