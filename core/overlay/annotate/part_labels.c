#include "overlay/annotate/part_labels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"
#include "overlay/annotate/leader_note.h"
#include "scene/parts/part_list.h"

/* Sizes in heights of capitals. */
static const double apart = 2.3, inside = 2.2, dot = 0.36, stub = 1.2, number_radius = 1.1, border = 1.2;

enum { PARTS_MAX = 1000, DEPTH_MAX = 60000, NAME_MAX = 200, OTHERS = 3 };

/* A part that is visible. */
struct label {
    const char *name;
    double x, y;                    /* anchor: the rightmost place, then the topmost one */
    struct zr_point others[OTHERS]; /* the topmost, lowest and leftmost places: anchors if no leader is free */
    double at;                      /* middle of its line in the column */
    uint32_t depth;
};

/* The parts of pixels, and how deep pixels lie inside of them. */
struct part_map {
    uint32_t *parts; /* per pixel: 1 + number in the list; 0: none of them */
    uint16_t *depths;
};

/* ---- parts of pixels ---- */

/* Finds the parts of face ids: those of one instance are adjacent, and most neighbours are of one instance. */
struct finder {
    const struct zr_scene *scene;
    const uint32_t *first_ids, *first_parts; /* per instance, and one more */
    uint32_t instance, part_count;
};

static uint32_t part_of(struct finder *f, uint32_t id)
{
    const uint32_t count = f->scene->instance_count;
    if (id < f->first_ids[0] || id >= f->first_ids[count]) return 0;
    if (id < f->first_ids[f->instance] || id >= f->first_ids[f->instance + 1]) {
        uint32_t low = 0, high = count;
        while (high - low > 1) {
            const uint32_t middle = low + (high - low) / 2;
            if (f->first_ids[middle] <= id)
                low = middle;
            else
                high = middle;
        }
        f->instance = low;
    }
    const struct zr_mesh *mesh = &f->scene->meshes[f->scene->instances[f->instance].mesh];
    const uint32_t face = id - f->first_ids[f->instance];
    const uint32_t number = mesh->face_parts && face < mesh->face_count ? mesh->face_parts[face] : 0;
    const uint32_t part = f->first_parts[f->instance] + number;
    return part < f->part_count ? part + 1 : 0;
}

static bool open_finder(struct zr_layout *l, uint32_t part_count, struct finder *f)
{
    const struct zr_scene *scene = l->scene;
    uint32_t *ids = zr_arena_alloc(l->arena, (size_t)scene->instance_count + 1, sizeof *ids);
    uint32_t *parts = zr_arena_alloc(l->arena, (size_t)scene->instance_count + 1, sizeof *parts);
    if (!ids || !parts) return false;
    ids[0] = l->frame->base ? l->frame->base->first_face_id : 1;
    parts[0] = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        ids[i + 1] = ids[i] + (uint32_t)zr_mesh_ids(mesh);
        parts[i + 1] = parts[i] + zr_mesh_part_count(mesh);
    }
    *f = (struct finder){scene, ids, parts, 0, part_count};
    return true;
}

/* Fills in depths: steps to the nearest pixel of another part, or to the border, by rows down and up again. */
static void find_depths(const struct zr_layout *l, const struct part_map *map)
{
    const int64_t width = l->frame->width, height = l->frame->height;
    for (int pass = 0; pass < 2; pass++)
        for (int64_t k = 0; k < height && !zr_is_cancelled(l->cancel); k++) {
            const int64_t y = pass == 0 ? k : height - 1 - k, dy = pass == 0 ? -1 : 1;
            for (int64_t j = 0; j < width; j++) {
                const int64_t x = pass == 0 ? j : width - 1 - j, i = y * width + x;
                const int64_t near[4][2] = {{x + dy, y}, {x - 1, y + dy}, {x, y + dy}, {x + 1, y + dy}};
                uint32_t least = pass == 0 ? DEPTH_MAX : map->depths[i];
                for (int n = 0; n < 4; n++) {
                    const bool is_in = near[n][0] >= 0 && near[n][0] < width && near[n][1] >= 0 && near[n][1] < height;
                    const int64_t other = near[n][1] * width + near[n][0];
                    const uint32_t depth = is_in && map->parts[other] == map->parts[i] ? map->depths[other] : 0u;
                    if (depth + 1 < least) least = depth + 1;
                }
                map->depths[i] = (uint16_t)least;
            }
        }
}

static bool make_map(struct zr_layout *l, struct finder *f, struct part_map *map)
{
    const size_t width = l->frame->width, pixels = width * l->frame->height;
    map->parts = zr_arena_alloc(l->arena, pixels, sizeof *map->parts);
    map->depths = zr_arena_alloc(l->arena, pixels, sizeof *map->depths);
    if (!map->parts || !map->depths) return false;
    for (size_t i = 0; i < pixels; i++) {
        if (i % width == 0 && zr_is_cancelled(l->cancel)) return false;
        map->parts[i] = l->ids[i] ? part_of(f, l->ids[i]) : 0;
    }
    find_depths(l, map);
    return true;
}

/* ---- anchors ---- */

/* Rows are read from the top, and a place is never at x = 0. */
static void keep_others(struct label *label, double x, double y)
{
    struct zr_point *top = &label->others[0], *low = &label->others[1], *left = &label->others[2];
    if (top->x == 0.0) *top = (struct zr_point){x, y};
    if (low->x == 0.0 || y > low->y) *low = (struct zr_point){x, y};
    if (left->x == 0.0 || x < left->x) *left = (struct zr_point){x, y};
}

/* Finds the anchors of all parts, which are numbered from 1. */
static void find_anchors(const struct zr_layout *l, const struct part_map *map, struct label *labels)
{
    const uint32_t width = l->frame->width, height = l->frame->height;
    for (size_t i = 0; i < (size_t)width * height; i++) {
        struct label *label = &labels[map->parts[i]];
        if (map->depths[i] > label->depth) label->depth = map->depths[i];
    }
    for (uint32_t y = 0; y < height && !zr_is_cancelled(l->cancel); y++)
        for (uint32_t x = 0; x < width; x++) {
            const size_t i = (size_t)y * width + x;
            struct label *label = &labels[map->parts[i]];
            const double wanted = fmin(inside * l->letters, (double)label->depth);
            if ((double)map->depths[i] < wanted) continue;
            keep_others(label, (double)x + 0.5, (double)y + 0.5);
            if ((double)x + 0.5 <= label->x) continue;
            label->x = (double)x + 0.5;
            label->y = (double)y + 0.5;
        }
}

static int compare_labels(const void *a, const void *b)
{
    const struct label *p = a, *q = b;
    if (p->y != q->y) return p->y < q->y ? -1 : 1;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return strcmp(p->name, q->name);
}

/* ---- the column ---- */

struct column {
    double x, right, top, bottom;
};

/* Finds the column right of the model and of dimensions, between marks in corners. */
static struct column find_column(const struct zr_layout *l, double widest)
{
    const double h = l->letters;
    const uint32_t width = l->frame->width, height = l->frame->height;
    struct column c = {0.0, l->width - border * h, border * h, l->height - border * h};
    uint32_t covered = 0;
    for (uint32_t y = 0; y < height && !zr_is_cancelled(l->cancel); y++)
        for (uint32_t x = width; x > covered; x--)
            if (l->ids[(size_t)y * width + x - 1] != 0) covered = x;
    double reach = (double)covered;
    for (uint32_t i = 0; i < l->segment_count; i++)
        reach = fmax(reach, fmax(l->segments[i].from.x, l->segments[i].to.x));
    for (uint32_t i = l->corner_count; i < l->rect_count; i++)
        reach = fmax(reach, l->rects[i].x1);
    for (uint32_t i = 0; i < l->corner_count; i++) /* a colour bar */
        if (l->rects[i].x0 > reach && l->rects[i].y1 - l->rects[i].y0 > 0.5 * l->height)
            c.right = fmin(c.right, l->rects[i].x0 - h);
    c.x = fmin(reach + 2.6 * h, c.right - widest);
    c.x = fmax(c.x, reach + stub * h + 0.8 * h);
    for (uint32_t i = 0; i < l->corner_count; i++) {
        const struct zr_rect r = l->rects[i];
        if (r.x1 < c.x - stub * h || r.x0 > c.right) continue;
        if (r.y1 < 0.5 * l->height) c.top = fmax(c.top, r.y1 + 0.6 * h);
        if (r.y0 > 0.5 * l->height) c.bottom = fmin(c.bottom, r.y0 - 0.6 * h);
    }
    c.top += 0.6 * h;
    c.bottom -= 0.6 * h;
    return c;
}

/* Sets the lines of sorted labels: the nearest ones to the anchors that are `step` apart, by pooling neighbours to
 * their mean. */
static void set_lines(struct zr_arena *arena, struct label *labels, uint32_t count, double step, struct column c)
{
    double *means = zr_arena_alloc(arena, count, sizeof *means);
    uint32_t *sizes = zr_arena_alloc(arena, count, sizeof *sizes);
    uint32_t pools = 0;
    if (!means || !sizes) return;
    for (uint32_t i = 0; i < count; i++) {
        means[pools] = labels[i].y - step * i;
        sizes[pools++] = 1;
        while (pools > 1 && means[pools - 2] > means[pools - 1]) {
            const uint32_t sum = sizes[pools - 2] + sizes[pools - 1];
            means[pools - 2] = (means[pools - 2] * sizes[pools - 2] + means[pools - 1] * sizes[pools - 1]) / sum;
            sizes[pools - 2] = sum;
            pools--;
        }
    }
    const double last = c.bottom - step * (count - 1);
    for (uint32_t pool = 0, i = 0; pool < pools; pool++)
        for (uint32_t k = 0; k < sizes[pool]; k++, i++)
            labels[i].at = fmax(c.top, fmin(last, means[pool])) + step * i;
}

static struct zr_segment leader_of(const struct zr_layout *l, const struct label *label, struct column c)
{
    return (struct zr_segment){{label->x, label->y}, {c.x - stub * l->letters, label->at}};
}

static double side_of(struct zr_segment s, struct zr_point p)
{
    return (s.to.x - s.from.x) * (p.y - s.from.y) - (s.to.y - s.from.y) * (p.x - s.from.x);
}

static bool leaders_cross(struct zr_segment a, struct zr_segment b)
{
    return side_of(a, b.from) * side_of(a, b.to) < 0.0 && side_of(b, a.from) * side_of(b, a.to) < 0.0;
}

/* Swaps lines of labels until no leaders cross. Each swap makes the leaders shorter together. */
static void uncross(const struct zr_layout *l, struct label *labels, uint32_t count, struct column c)
{
    bool has_swapped = true;
    for (int round = 0; has_swapped && round < 64 && !zr_is_cancelled(l->cancel); round++) {
        has_swapped = false;
        for (uint32_t i = 0; i < count; i++)
            for (uint32_t k = i + 1; k < count; k++) {
                if (!leaders_cross(leader_of(l, &labels[i], c), leader_of(l, &labels[k], c))) continue;
                const double at = labels[i].at;
                labels[i].at = labels[k].at;
                labels[k].at = at;
                has_swapped = true;
            }
    }
}

/* Returns the name, cut to a width. */
static const char *shorten(const struct zr_layout *l, const char *name, double most)
{
    size_t end = strnlen(name, NAME_MAX);
    if (zr_type_width(name, l->letters) <= most) return name;
    char *cut = zr_arena_alloc(l->arena, end + 4, 1);
    while (cut && end > 0) {
        do
            end--;
        while (end > 0 && ((unsigned char)name[end] & 0xc0) == 0x80);
        memcpy(cut, name, end);
        memcpy(cut + end, "...", 4);
        if (zr_type_width(cut, l->letters) <= most) return cut;
    }
    return "...";
}

/* True if a label's text and its leader are free, the label being moved. */
static bool is_label_free(const struct zr_layout *l, const struct label *label, double width, struct column c)
{
    const double h = l->letters;
    const struct zr_segment leader = leader_of(l, label, c);
    const struct zr_rect rect = zr_layout_text_rect(c.x, label->at + 0.5 * h, width, h, 0.1 * h);
    const struct zr_rect wide = zr_layout_text_rect(c.x, label->at + 0.5 * h, width, h, 0.3 * h);
    if (!zr_layout_is_inside(l, rect) || !zr_layout_is_background(l, rect)) return false;
    for (uint32_t i = 0; i < l->rect_count; i++) {
        const struct zr_rect r = l->rects[i];
        if (zr_layout_line_meets(leader, r)) return false;
        if (wide.x0 < r.x1 && r.x0 < wide.x1 && wide.y0 < r.y1 && r.y0 < wide.y1) return false;
    }
    for (uint32_t i = 0; i < l->segment_count; i++)
        if (zr_layout_line_meets(l->segments[i], rect)) return false;
    for (uint32_t i = 0; i < l->segment_count; i++)
        if (leaders_cross(l->segments[i], leader)) return false;
    return true;
}

static bool find_tip(const void *context, double dx, double dy, struct zr_point *tip)
{
    (void)dx;
    (void)dy;
    *tip = *(const struct zr_point *)context;
    return true;
}

/* Draws a label that has no line in the column: anywhere beside the model. */
static void draw_beside(struct zr_layout *l, const struct label *label, const char *name, double width,
                        const struct zr_model_map *map)
{
    struct zr_leader_note note = {.cost = HUGE_VAL};
    const struct zr_point first = {label->x, label->y};
    if (map) zr_leader_note_find(l, map, find_tip, &first, width, &note);
    for (int i = 0; i < OTHERS && map; i++)
        zr_leader_note_find(l, map, find_tip, &label->others[i], width, &note);
    if (note.cost == HUGE_VAL) {
        zr_layout_leave_out(l, label->name, "no room", ZR_LEFT_OUT_NO_ROOM);
        return;
    }
    zr_leader_note_draw(l, &note, name, l->ink);
    zr_marks_add_disc(l->marks, note.leader.from, dot * l->letters, zr_layout_ink(l, l->ink, 0.0, true));
    zr_leader_note_take(l, &note);
}

/* Draws a label on its line of the column, or on the nearest free place. */
static void draw_label(struct zr_layout *l, const struct label *given, struct column c, const struct zr_model_map *map)
{
    enum { TRIES = 48 };
    const double h = l->letters;
    const char *name = shorten(l, given->name, c.right - c.x);
    const double width = zr_type_width(name, h);
    struct label moved = *given;
    bool is_free = is_label_free(l, &moved, width, c);
    for (int anchor = 0; anchor <= OTHERS && !is_free; anchor++) {
        if (anchor > 0) moved.x = given->others[anchor - 1].x;
        if (anchor > 0) moved.y = given->others[anchor - 1].y;
        for (int i = anchor > 0 ? 0 : 2; !is_free && i < TRIES && !zr_is_cancelled(l->cancel); i++) {
            moved.at = given->at + (i % 2 ? -0.5 : 0.5) * h * (i / 2);
            is_free = moved.at >= c.top && moved.at <= c.bottom && is_label_free(l, &moved, width, c);
        }
    }
    if (!is_free) {
        draw_beside(l, given, name, width, map);
        return;
    }
    const struct zr_segment leader = leader_of(l, &moved, c);
    const struct zr_point points[] = {leader.from, leader.to, {c.x - 0.45 * h, moved.at}};
    zr_marks_add_line(l->marks, points, 3, zr_layout_ink(l, l->ink, 0.55, true));
    zr_marks_add_disc(l->marks, leader.from, dot * h, zr_layout_ink(l, l->ink, 0.0, true));
    zr_layout_write(l, name, c.x, moved.at + 0.5 * h, h, l->ink, true);
    zr_layout_take_rect(l, zr_layout_text_rect(c.x, moved.at + 0.5 * h, width, h, 0.1 * h));
    zr_layout_take_line(l, leader);
}

/* ---- numbers ---- */

/* Lists the numbers with names in the column, as many as have room. */
static void draw_table(struct zr_layout *l, const struct label *labels, uint32_t count, struct column c)
{
    const double h = l->letters, step = 1.7 * h, from = c.x - stub * h;
    const uint32_t lines = c.bottom > c.top ? 1 + (uint32_t)((c.bottom - c.top) / step) : 0;
    if (c.right - from < 5.0 * h) return;
    for (uint32_t i = 0; i < count && i < lines && !zr_is_cancelled(l->cancel); i++) {
        char text[NAME_MAX + 32];
        const double y = c.top + step * i + 0.5 * h;
        if (count > lines && i + 1 == lines)
            snprintf(text, sizeof text, "and %u more", count - i);
        else
            snprintf(text, sizeof text, "%u  %.*s", i + 1, NAME_MAX, labels[i].name);
        const char *line = shorten(l, text, c.right - from);
        const struct zr_rect rect = zr_layout_text_rect(from, y, zr_type_width(line, h), h, 0.0);
        if (!zr_layout_is_inside(l, rect) || !zr_layout_is_background(l, rect) || !zr_layout_is_apart(l, rect))
            continue;
        const char *kept = zr_arena_copy(l->arena, line, strlen(line) + 1);
        if (!kept) return;
        zr_layout_write(l, kept, from, y, h, l->ink, true);
        zr_layout_take_rect(l, rect);
    }
}

static void draw_numbers(struct zr_layout *l, struct label *labels, uint32_t count,
                         const struct zr_numbered_part **numbered, uint32_t *numbered_count)
{
    const double h = l->letters, r = number_radius * h;
    struct zr_numbered_part *list = zr_arena_alloc(l->arena, count, sizeof *list);
    if (!list) return;
    for (uint32_t i = 0; i < count && !zr_is_cancelled(l->cancel); i++) {
        char text[16];
        snprintf(text, sizeof text, "%u", i + 1);
        const double width = zr_type_width(text, h), half = fmax(r, 0.5 * width + 0.62 * h);
        const double x = fmin(fmax(labels[i].x, half + 1.0), l->width - half - 1.0);
        const double y = fmin(fmax(labels[i].y, half + 1.0), l->height - half - 1.0);
        const struct zr_rect rect = {x - half, y - half, x + half, y + half};
        list[i] = (struct zr_numbered_part){i + 1, labels[i].name};
        if (!zr_layout_is_apart(l, rect)) {
            zr_layout_leave_out(l, labels[i].name, "no room", ZR_LEFT_OUT_NO_ROOM);
            continue;
        }
        const struct zr_point center = {x, y};
        zr_marks_add_disc(l->marks, center, half, zr_layout_ink(l, l->paper, 0.0, false));
        zr_marks_add_ring(l->marks, center, half, zr_layout_ink(l, l->ink, 0.7, false));
        zr_layout_write(l, text, x - 0.5 * width, y + 0.5 * h, h, l->ink, false);
        zr_layout_take_rect(l, rect);
    }
    *numbered = list;
    *numbered_count = count;
}

void zr_part_labels_place(struct zr_layout *l, const struct zr_numbered_part **numbered, uint32_t *count)
{
    const struct zr_part_list list = zr_part_list_make(l->arena, l->scene, PARTS_MAX);
    struct label *labels = zr_arena_zero(l->arena, (size_t)list.count + 1, sizeof *labels);
    struct part_map map;
    struct zr_model_map around;
    struct finder finder;
    uint32_t seen = 0;
    double widest = 0.0;
    if (!labels || !l->ids || list.count == 0 || !open_finder(l, list.count, &finder)) return;
    if (!make_map(l, &finder, &map)) return;
    find_anchors(l, &map, labels);
    for (uint32_t i = 1; i <= list.count; i++) {
        if (labels[i].depth == 0) continue;
        labels[seen] = labels[i];
        labels[seen].name = list.at[i - 1].name;
        widest = fmax(widest, zr_type_width(labels[seen++].name, l->letters));
    }
    if (seen == 0) return;
    qsort(labels, seen, sizeof *labels, compare_labels);
    const struct column c = find_column(l, widest);
    const double step = apart * l->letters;
    if (c.right - c.x < 3.0 * l->letters || c.bottom - c.top < step * (seen - 1)) {
        draw_table(l, labels, seen, c);
        draw_numbers(l, labels, seen, numbered, count);
        return;
    }
    set_lines(l->arena, labels, seen, step, c);
    uncross(l, labels, seen, c);
    const bool has_map = zr_model_map_make(l, &around);
    for (uint32_t i = 0; i < seen; i++)
        draw_label(l, &labels[i], c, has_map ? &around : NULL);
}
