#include "support/replay.h"

#include <cjson/cJSON.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/cmocka_all.h"

enum { SIDE = REPLAY_SIDE_MAX, PRIMITIVES = 64, EDGES = 8192, PIECES = 40000 };

struct primitive {
    uint32_t face_id, first_edge, edge_count;
    bool is_triangle, is_flat; /* is_flat: one plane has its depth */
};

/* Rows count from the bottom, as in the trace. */
static struct {
    const char *name;
    int width, height, count;
    struct primitive primitives[PRIMITIVES + 1]; /* by id */
    int64_t edges[EDGES][4];                     /* in 1/256 */
    uint32_t edge_count;
    uint32_t shown[SIDE][SIDE]; /* ids */
    float depth[SIDE][SIDE];
    struct replay *out;
} play;

#define CHECK(condition, ...)                                                                                          \
    if (!(condition)) replay_fail(#condition, __VA_ARGS__)

static void replay_fail(const char *condition, const char *format, ...)
{
    char text[400];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    fail_msg("%s: %s (%s)", play.name, text, condition);
}

/* ---- values ---- */

static const cJSON *member(const cJSON *object, const char *key)
{
    const cJSON *found = cJSON_GetObjectItemCaseSensitive(object, key);
    CHECK(found, "no %s", key);
    return found;
}

static double number_of(const cJSON *item)
{
    CHECK(cJSON_IsNumber(item), "no number");
    return item->valuedouble;
}

static int whole_of(const cJSON *item)
{
    const double value = number_of(item);
    CHECK(value == (double)(int)value, "%g is no integer", value);
    return (int)value;
}

static int whole(const cJSON *object, const char *key)
{
    return whole_of(member(object, key));
}

static int64_t long_of(const cJSON *item)
{
    return (int64_t)number_of(item);
}

static int64_t long_at(const cJSON *object, const char *key)
{
    return long_of(member(object, key));
}

static const cJSON *at(const cJSON *list, int place)
{
    const cJSON *item = cJSON_GetArrayItem(list, place);
    CHECK(item, "a list is shorter than %d", place + 1);
    return item;
}

static int length(const cJSON *list)
{
    CHECK(cJSON_IsArray(list), "no list");
    return cJSON_GetArraySize(list);
}

static bool has(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static const struct primitive *primitive_of(int id)
{
    CHECK(id >= 1 && id <= play.count, "primitive %d", id);
    return &play.primitives[id];
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

static bool covers(const struct primitive *p, int x, int y)
{
    bool is_inside = false;
    for (uint32_t i = 0; i < p->edge_count; i++)
        if (crosses(play.edges[p->first_edge + i], y) && crossing(play.edges[p->first_edge + i], y) <= x)
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
        const int64_t *edge = play.edges[p->first_edge + i];
        if (!crosses(edge, y)) continue;
        const int64_t x = crossing(edge, y);
        xs[count++] = x < 0 ? 0 : x > play.width ? play.width : (int)x;
    }
    qsort(xs, (size_t)count, sizeof *xs, compare_wholes);
    return count;
}

static void read_primitives(const cJSON *list)
{
    const cJSON *item, *edge;
    cJSON_ArrayForEach(item, list)
    {
        struct primitive *p = &play.primitives[++play.count];
        CHECK(play.count <= PRIMITIVES && whole(item, "id") == play.count, "id of primitive %d", play.count);
        p->face_id = (uint32_t)whole(item, "faceId");
        p->first_edge = play.edge_count;
        p->is_triangle = strcmp(member(item, "kind")->valuestring, "triangle") == 0;
        p->is_flat = !has(item, "triangles") || length(member(item, "triangles")) == 1;
        play.out->polygons += strcmp(member(item, "kind")->valuestring, "polygon") == 0;
        CHECK(length(member(item, p->is_triangle || !has(item, "triangles") ? "corners" : "triangles")) > 0, "corners");
        cJSON_ArrayForEach(edge, member(item, "edges"))
        {
            for (int k = 0; k < 4; k++) {
                const double grid = 256.0 * number_of(at(edge, k));
                play.edges[play.edge_count][k] = (int64_t)grid;
                CHECK(grid == (double)(int64_t)grid, "%g is beside the grid", grid);
            }
            CHECK(play.edges[play.edge_count][1] < play.edges[play.edge_count][3], "an edge runs down");
            CHECK(++play.edge_count < EDGES, "too many edges");
        }
        p->edge_count = play.edge_count - p->first_edge;
    }
}

/* ---- z-buffer ---- */

/* Plays back spans with their z-tests, and marks their samples. */
static void draw_spans(const cJSON *row, int id, int y, bool drawn[SIDE])
{
    const cJSON *spans = member(row, "spans"), *z = member(row, "z");
    const cJSON *written = member(row, "written")->child, *lost = member(row, "lost")->child;
    CHECK(y >= 0 && y < play.height && length(spans) == length(z), "row %d", y);
    for (int i = 0; i < length(spans); i++) {
        const int x0 = whole_of(at(at(spans, i), 0)), x1 = whole_of(at(at(spans, i), 1));
        CHECK(x0 >= 0 && x0 < x1 && x1 <= play.width && length(at(z, i)) == x1 - x0, "span %d, %d", x0, x1);
        for (int x = x0; x < x1; x++) {
            const float depth = (float)number_of(at(at(z, i), x - x0));
            const bool passes = depth < play.depth[y][x];
            const cJSON **list = passes ? &written : &lost;
            CHECK(*list && whole_of(*list) == x, "the z-test of %d, %d: %.9g", x, y, (double)depth);
            *list = (*list)->next;
            drawn[x] = true;
            play.out->lost += !passes;
            if (!passes) continue;
            play.depth[y][x] = depth;
            play.shown[y][x] = (uint32_t)id;
        }
    }
    CHECK(!written && !lost, "more samples than the spans of row %d have", y);
}

static void check_covered(const struct primitive *p, int y, const bool drawn[SIDE])
{
    for (int x = 0; x < play.width; x++)
        CHECK(drawn[x] == covers(p, x, y), "coverage of %d, %d", x, y);
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
    CHECK(crossing(play.edges[p->first_edge + (uint32_t)edge], band.row) == side->x, "the first x of edge %d", edge);
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
        xs[i] = side->x < 0 ? 0 : side->x > play.width ? play.width : (int)side->x;
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
    for (int id = 1; id <= play.count; id++)
        for (uint32_t i = 0; i < play.primitives[id].edge_count; i++) {
            const int64_t *edge = play.edges[play.primitives[id].first_edge + i];
            count += crosses(edge, y) && crossing(edge, y) < play.width;
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
    for (int id = 1; id <= play.count; id++) {
        const bool is_inside = covers(&play.primitives[id], x0, y);
        count += is_inside;
        for (int k = x0 + 1; k < x1; k++)
            CHECK(covers(&play.primitives[id], k, y) == is_inside, "primitive %d ends in the interval", id);
    }
    CHECK(length(member(span, "inside")) == count && count > 0, "primitives at %d, %d", x0, y);
    cJSON_ArrayForEach(item, member(span, "inside"))
        CHECK(covers(primitive_of(whole_of(at(item, 0))), x0, y), "a primitive is not there");
    check_left(span);
    cJSON_ArrayForEach(item, shown)
    {
        const int id = whole_of(at(item, 2));
        CHECK(whole_of(at(item, 0)) == x && (id == 0 || lists(member(span, "left"), id)), "a run at %d", x);
        for (; x < whole_of(at(item, 1)); x++)
            play.shown[y][x] = (uint32_t)id;
    }
    CHECK(x == x1 && x1 <= play.width, "runs end at %d", x);
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
    for (int x = 0; x < play.width; x++)
        for (int id = 1; id <= play.count && !is_in[x]; id++)
            CHECK(!covers(&play.primitives[id], x, y), "%d, %d is in no interval", x, y);
}

/* ---- painter ---- */

struct piece {
    const cJSON *item; /* NULL: cut or drawn */
    int box[4], size;
};
static struct piece pieces[PIECES];
static int piece_end; /* 1 + the greatest number so far */

static struct piece *piece_of(int number)
{
    CHECK(number > 0 && number < PIECES && pieces[number].item, "piece %d is not there", number);
    return &pieces[number];
}

static struct piece *add_piece(const cJSON *item)
{
    const int number = whole(item, "piece"), id = whole(item, "primitive");
    const cJSON *span;
    CHECK(number > 0 && number < PIECES && !pieces[number].item, "piece %d", number);
    struct piece *piece = &pieces[number];
    if (number >= piece_end) piece_end = number + 1;
    *piece = (struct piece){item, {SIDE, SIDE, -1, -1}, 0};
    cJSON_ArrayForEach(span, member(item, "spans"))
    {
        const int y = whole_of(at(span, 0)), x0 = whole_of(at(span, 1)), x1 = whole_of(at(span, 2));
        for (int x = x0; x < x1; x++, piece->size++)
            CHECK(covers(primitive_of(id), x, y), "piece %d at %d, %d", number, x, y);
        if (x0 < piece->box[0]) piece->box[0] = x0;
        if (y < piece->box[1]) piece->box[1] = y;
        if (x1 - 1 > piece->box[2]) piece->box[2] = x1 - 1;
        if (y > piece->box[3]) piece->box[3] = y;
    }
    return piece;
}

static void mark(const struct piece *piece, int marks[SIDE][SIDE], int by)
{
    const cJSON *span;
    cJSON_ArrayForEach(span, member(piece->item, "spans")) for (int x = whole_of(at(span, 1));
                                                                x < whole_of(at(span, 2)); x++)
        marks[whole_of(at(span, 0))][x] += by;
}

static void play_compare(const cJSON *step)
{
    const struct piece *p = piece_of(whole_of(at(member(step, "compare"), 0))),
                       *q = piece_of(whole_of(at(member(step, "compare"), 1)));
    const char *test = member(step, "test")->valuestring;
    const bool nearer = cJSON_IsTrue(member(step, "nearer")), farther = cJSON_IsTrue(member(step, "farther"));
    const bool is_apart = number_of(member(q->item, "far")) < number_of(member(p->item, "near"));
    const bool boxes =
        p->box[0] <= q->box[2] && q->box[0] <= p->box[2] && p->box[1] <= q->box[3] && q->box[1] <= p->box[3];
    CHECK(strcmp(test, is_apart ? "depth" : boxes ? "pixels" : "box") == 0, "the test %s", test);
    CHECK(strcmp(test, "pixels") == 0 || (!nearer && !farther), "the test %s finds something", test);
}

static void play_split(const cJSON *step)
{
    static int marks[SIDE][SIDE];
    struct piece *whole_one = piece_of(whole(step, "split"));
    const struct piece *by = piece_of(whole(step, "by"));
    memset(marks, 0, sizeof marks);
    mark(whole_one, marks, 1);
    const struct piece *rest = add_piece(at(member(step, "into"), 0)), *inside = add_piece(at(member(step, "into"), 1));
    CHECK(rest->size > 0 && inside->size > 0, "a part is empty");
    mark(rest, marks, -1);
    mark(inside, marks, -1);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            CHECK(marks[y][x] == 0, "parts do not make the piece at %d, %d", x, y);
    mark(by, marks, 1);
    const cJSON *span;
    cJSON_ArrayForEach(span, member(inside->item, "spans")) for (int x = whole_of(at(span, 1));
                                                                 x < whole_of(at(span, 2)); x++)
        CHECK(marks[whole_of(at(span, 0))][x] == 1, "the inner part is beside the other piece");
    whole_one->item = NULL;
    play.out->cuts++;
}

static void play_draw(int number)
{
    struct piece *piece = piece_of(number);
    const int id = whole(piece->item, "primitive");
    const cJSON *span;
    cJSON_ArrayForEach(span, member(piece->item, "spans")) for (int x = whole_of(at(span, 1));
                                                                x < whole_of(at(span, 2)); x++)
        play.shown[whole_of(at(span, 0))][x] = (uint32_t)id;
    piece->item = NULL;
}

static void play_painter(const cJSON *step)
{
    const cJSON *item;
    double far = 2.0;
    play.out->cycles += has(step, "cycle");
    if (has(step, "compare")) play_compare(step);
    if (has(step, "split")) play_split(step);
    if (has(step, "draw")) play_draw(whole(step, "draw"));
    if (!has(step, "order")) return;
    cJSON_ArrayForEach(item, member(step, "order"))
    {
        CHECK(number_of(member(item, "far")) <= far, "the farthest is not first");
        far = number_of(member(item, "far"));
        add_piece(item);
        CHECK(whole(item, "piece") == whole(item, "primitive"), "the number of a piece");
    }
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
    play.out->inner_tiles += is[0] == 'i';
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
    for (int x = 0; x < play.width; x++)
        CHECK(flags[x] == drawn[x] && drawn[x] == covers(p, x, y), "flips of %d, %d", x, y);
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
    for (int y = 0; y < play.height; y++)
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
               {"painter", play_painter, false},
               {"halfspace", play_halfspace, true}};

static void begin(const char *name, const cJSON *trace, struct replay *out)
{
    memset(&play, 0, sizeof play);
    memset(&band, 0, sizeof band);
    memset(pieces, 0, (size_t)piece_end * sizeof *pieces);
    piece_end = 0;
    memset(out, 0, sizeof *out);
    play.name = name;
    play.out = out;
    CHECK(trace, "not JSON");
    play.width = whole(member(trace, "window"), "width");
    play.height = whole(member(trace, "window"), "height");
    CHECK(play.width <= SIDE && play.height <= SIDE, "the window");
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            play.depth[y][x] = 1.0f;
    read_primitives(member(trace, "primitives"));
}

static void end(struct replay *out)
{
    for (int i = 0; i < piece_end; i++)
        CHECK(!pieces[i].item, "piece %d is left", i);
    out->width = (uint32_t)play.width;
    out->height = (uint32_t)play.height;
    out->primitives = (uint32_t)play.count;
    for (int y = 0; y < play.height; y++)
        for (int x = 0; x < play.width; x++) {
            const int place = (play.height - 1 - y) * play.width + x;
            const uint32_t id = play.shown[y][x];
            out->face_id[place] = id > 0 ? play.primitives[id].face_id : 0;
            out->depth[place] = play.depth[y][x];
        }
}

void replay_trace(const char *name, const char *json, struct replay *out)
{
    cJSON *trace = cJSON_Parse(json);
    const cJSON *step;
    size_t player = 0;
    begin(name, trace, out);
    while (player < 4 && strcmp(member(trace, "algorithm")->valuestring, players[player].name) != 0)
        player++;
    cJSON_ArrayForEach(step, member(trace, "steps"))
    {
        players[player].step(step);
        out->steps++;
    }
    out->has_depth = players[player].has_depth;
    end(out);
    cJSON_Delete(trace);
}
