#include "output/json/comparison_json.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "output/json/features_json.h"
#include "output/json/json_print.h"
#include "scene/picture.h"

enum { SUMMARY_SIZE = 512, TEXT_SIZE = 96 };

/* ---- one line ---- */

/* Returns the decimals of a number whose error is `error`: one digit of that. */
static int decimals_of(double error)
{
    int decimals = 1;
    while (decimals < 9 && error < 1.0) {
        error *= 10.0;
        decimals++;
    }
    return decimals - 1;
}

/* A text of limited length that grows. */
struct line {
    char text[SUMMARY_SIZE];
    size_t size;
};

__attribute__((format(printf, 2, 3))) static void add(struct line *line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(line->text + line->size, sizeof line->text - line->size, format, arguments);
    va_end(arguments);
    line->size += length > 0 ? (size_t)length : 0;
    if (line->size >= sizeof line->text) line->size = sizeof line->text - 1;
}

static struct zr_world_place place_of(const struct zr_comparison *c, struct zr_world_place at)
{
    return (struct zr_world_place){at.x + c->a.middle.x, at.y + c->a.middle.y, at.z + c->a.middle.z};
}

/* Returns a coordinate for people: rounding errors beside the middle become 0. */
static double plain(double value, double diagonal)
{
    return fabs(value) < 1e-9 * diagonal ? 0.0 : value;
}

/* Returns the change of the volume in percent. Errors, and coordinates rounded to float, change nothing. */
static double percent_of(const struct zr_own_volume *a, const struct zr_own_volume *b)
{
    const double change = b->volume - a->volume, nothing = a->error + b->error + 2e-7 * a->volume;
    return fabs(change) <= nothing ? 0.0 : 100.0 * change / a->volume;
}

static void add_volumes(struct line *line, const struct zr_comparison *c)
{
    if (c->volumes.error > 1e-9)
        add(line, "IoU %.*f \u00b1 %.1g", decimals_of(c->volumes.error), c->volumes.iou, c->volumes.error);
    else
        add(line, "IoU %.9g", c->volumes.iou);
    if (c->volumes.a.volume > 0.0) add(line, "; volume %+.3g %%", percent_of(&c->volumes.a, &c->volumes.b));
}

static void add_distances(struct line *line, const struct zr_comparison *c)
{
    const struct zr_world_place at = place_of(c, c->hausdorff_at);
    const double size = c->a.diagonal;
    if (line->size > 0) add(line, "; ");
    add(line, "largest deviation %.3g", plain(c->hausdorff, 1e-3 * size));
    if (c->hausdorff > 0.0 && !c->is_same)
        add(line, " at (%.4g, %.4g, %.4g)", plain(at.x, size), plain(at.y, size), plain(at.z, size));
}

static void add_regions(struct line *line, const struct zr_comparison *c)
{
    const uint32_t count = c->regions.count + c->regions.omitted;
    if (count > 0) add(line, "; %u region%s", count, count == 1 ? "" : "s");
}

/* True if a hole is through or blind in b, and was the other one in a. */
static bool becomes(const struct zr_hole_change *change, enum zr_hole_reach reach)
{
    return change->kind == ZR_HOLE_CHANGED && change->b.reach == reach && change->a.reach != reach &&
           change->a.reach != ZR_REACH_UNKNOWN;
}

/* Adds how many of the changed holes became through or blind. */
static void add_reaches(struct line *line, const struct zr_comparison *c)
{
    uint32_t through = 0, blind = 0;
    for (uint32_t i = 0; i < c->holes.count; i++) {
        through += becomes(&c->holes.at[i], ZR_REACH_THROUGH);
        blind += becomes(&c->holes.at[i], ZR_REACH_BLIND);
    }
    if (through > 0 && blind > 0)
        add(line, " (%u now through, %u now blind)", through, blind);
    else if (through + blind > 0)
        add(line, " (%u now %s)", through + blind, through > 0 ? "through" : "blind");
}

static void add_holes(struct line *line, const struct zr_comparison *c)
{
    static const char *const words[] = {"removed", "added", "moved", "changed"};
    uint32_t counts[ZR_HOLE_CHANGE_KINDS] = {0};
    for (uint32_t i = 0; i < c->holes.count; i++)
        counts[c->holes.at[i].kind]++;
    for (int kind = 0; kind < ZR_HOLE_CHANGE_KINDS; kind++)
        if (counts[kind] > 0)
            add(line, "%s%u hole%s %s", line->size > 0 ? "; " : "", counts[kind], counts[kind] == 1 ? "" : "s",
                words[kind]);
    add_reaches(line, c); /* of changed ones, the last kind */
}

static struct line summary_of(const struct zr_comparison *c)
{
    struct line line = {.size = 0};
    if (c->has_volumes) add_volumes(&line, c);
    if (c->has_volumes) add_regions(&line, c);
    add_holes(&line, c);
    if (c->has_deviation) add_distances(&line, c);
    if (!c->has_volumes) add(&line, "%sno IoU: open surfaces", line.size > 0 ? "; " : "");
    if (c->is_same) add(&line, "; same");
    return line;
}

/* ---- values ---- */

static void print_place(struct zr_print *print, const char *key, const struct zr_comparison *c,
                        struct zr_world_place at)
{
    const struct zr_world_place p = place_of(c, at);
    const double numbers[3] = {p.x + 0.0, p.y + 0.0, p.z + 0.0};
    zr_print_doubles(print, key, numbers, 3);
}

static void print_box(struct zr_print *print, const struct zr_comparison *c, const double min[3], const double max[3])
{
    zr_print_begin(print, "box", '{');
    print_place(print, "min", c, (struct zr_world_place){min[0], min[1], min[2]});
    print_place(print, "max", c, (struct zr_world_place){max[0], max[1], max[2]});
    zr_print_end(print, '}');
}

static void print_solid(struct zr_print *print, const char *key, const struct zr_comparison *c,
                        const struct zr_scene *scene, const struct zr_solid *solid, const struct zr_own_volume *own)
{
    zr_print_begin(print, key, '{');
    if (scene->file.unit) zr_print_string(print, "unit", scene->file.unit);
    zr_print_count(print, "triangles", solid->count);
    print_box(print, c, solid->min, solid->max);
    zr_print_double(print, "area", solid->area);
    zr_print_bool(print, "closed", solid->is_closed);
    if (!solid->is_closed) zr_print_count(print, "openEdges", solid->odd_edges);
    if (solid->is_closed) zr_print_double(print, "volume", c->has_volumes ? own->volume : fabs(solid->volume));
    if (c->has_volumes && own->has_overlap) zr_print_double(print, "volumeError", own->error);
    if (solid->is_closed) {
        const bool is_turned = solid->volume < 0.0;
        zr_print_count(print, "solids", is_turned ? solid->inward : solid->outward);
        zr_print_count(print, "cavities", is_turned ? solid->outward : solid->inward);
    }
    if (solid->has_handles) zr_print_count(print, "handles", (uint64_t)solid->handles);
    zr_print_end(print, '}');
}

static void print_volumes(struct zr_print *print, const struct zr_volumes *volumes)
{
    zr_print_begin(print, "volume", '{');
    zr_print_double(print, "both", volumes->both);
    zr_print_double(print, "onlyA", volumes->only_a);
    zr_print_double(print, "onlyB", volumes->only_b);
    zr_print_double(print, "volumeError", volumes->volume_error);
    zr_print_double(print, "iou", volumes->iou);
    zr_print_double(print, "error", volumes->error);
    zr_print_count(print, "rays", volumes->rays);
    zr_print_end(print, '}');
}

/* Views by the axes of the first file: front, right and top. */
static void print_silhouettes(struct zr_print *print, const struct zr_comparison *c, const struct zr_scene *a)
{
    const bool z_is_up = a->picture->z_is_up || (a->file.up && strcmp(a->file.up, "z") == 0);
    const struct {
        const char *view;
        int axis;
    } rows[3] = {{"front", z_is_up ? 1 : 2}, {"right", 0}, {"top", z_is_up ? 2 : 1}};
    zr_print_begin(print, "silhouettes", '[');
    for (int i = 0; i < 3; i++) {
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "view", rows[i].view);
        zr_print_double(print, "iou", c->silhouettes[rows[i].axis]);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

static void print_deviation(struct zr_print *print, const char *key, const struct zr_comparison *c,
                            const struct zr_deviation *deviation)
{
    zr_print_begin(print, key, '{');
    if (deviation->is_signed) zr_print_double(print, "mean", deviation->mean);
    zr_print_double(print, "abs", deviation->abs);
    zr_print_double(print, "rms", deviation->rms);
    zr_print_double(print, "p95", deviation->p95);
    zr_print_double(print, "max", deviation->max);
    print_place(print, "at", c, deviation->at);
    zr_print_count(print, "points", deviation->points);
    zr_print_end(print, '}');
}

static void print_distances(struct zr_print *print, const struct zr_comparison *c)
{
    zr_print_begin(print, "deviation", '{');
    print_deviation(print, "aToB", c, &c->a_to_b);
    print_deviation(print, "bToA", c, &c->b_to_a);
    zr_print_double(print, "hausdorff", c->hausdorff);
    zr_print_double(print, "chamfer", c->chamfer);
    zr_print_double(print, "chamferSquare", c->chamfer_square);
    zr_print_begin(print, "f1", '{');
    zr_print_double(print, "threshold", c->threshold);
    zr_print_double(print, "value", c->f1);
    zr_print_end(print, '}');
    zr_print_double(print, "normalConsistency", c->normal_consistency);
    zr_print_end(print, '}');
}

static void print_region(struct zr_print *print, const struct zr_comparison *c, uint32_t number)
{
    const struct zr_region *region = &c->regions.at[number];
    zr_print_begin(print, NULL, '{');
    zr_print_count(print, "mark", number + 1);
    zr_print_string(print, "in", region->is_b ? "b" : "a");
    zr_print_string(print, "kind", region->is_b ? "added" : "removed");
    zr_print_double(print, "volume", region->volume);
    print_box(print, c, region->min, region->max);
    print_place(print, "center", c, (struct zr_world_place){region->center[0], region->center[1], region->center[2]});
    zr_print_double(print, "thickness", region->thickness);
    if (c->has_parts) zr_print_string(print, "part", c->region_parts[number]);
    zr_print_end(print, '}');
}

static void print_regions(struct zr_print *print, const struct zr_comparison *c)
{
    zr_print_begin(print, "regions", '[');
    for (uint32_t i = 0; i < c->regions.count; i++)
        print_region(print, c, i);
    zr_print_end(print, ']');
    if (c->regions.omitted > 0) zr_print_count(print, "regionsOmitted", c->regions.omitted);
}

static void print_changes(struct zr_print *print, const struct zr_part_changes *changes)
{
    static const char *const keys[] = {"removed", "added", "moved", "changed"};
    zr_print_begin(print, "parts", '{');
    for (int kind = 0; kind < 4; kind++) {
        zr_print_begin(print, keys[kind], '[');
        for (uint32_t i = 0; i < changes->count; i++) {
            const struct zr_part_change *change = &changes->at[i];
            if ((int)change->kind != kind) continue;
            zr_print_begin(print, NULL, '{');
            zr_print_string(print, "name", change->name);
            if (kind == ZR_PART_MOVED) zr_print_doubles(print, "by", change->by, 3);
            zr_print_end(print, '}');
        }
        zr_print_end(print, ']');
    }
    if (changes->omitted > 0) zr_print_count(print, "omitted", changes->omitted);
    zr_print_end(print, '}');
}

static struct zr_world_place place_of_hole(const struct zr_hole *hole)
{
    return (struct zr_world_place){hole->at.x, hole->at.y, hole->at.z};
}

static void print_hole(struct zr_print *print, const struct zr_comparison *c, const struct zr_hole_change *change)
{
    const bool is_in_b = change->kind == ZR_HOLE_ADDED, has_both = change->kind >= ZR_HOLE_MOVED;
    const struct zr_hole *hole = is_in_b ? &change->b : &change->a;
    const double axis[3] = {hole->axis.x + 0.0, hole->axis.y + 0.0, hole->axis.z + 0.0};
    zr_print_begin(print, NULL, '{');
    zr_print_double(print, "diameter", hole->diameter);
    if (change->kind == ZR_HOLE_CHANGED) zr_print_double(print, "newDiameter", change->b.diameter);
    zr_print_double(print, "depth", hole->depth);
    if (change->kind == ZR_HOLE_CHANGED) zr_print_double(print, "newDepth", change->b.depth);
    if (hole->reach != ZR_REACH_UNKNOWN) zr_print_bool(print, "through", hole->reach == ZR_REACH_THROUGH);
    if (change->kind == ZR_HOLE_CHANGED && change->b.reach != ZR_REACH_UNKNOWN)
        zr_print_bool(print, "newThrough", change->b.reach == ZR_REACH_THROUGH);
    if (hole->step_count > 0) zr_hole_steps_print(print, "steps", hole);
    if (change->kind == ZR_HOLE_CHANGED && hole->step_count + change->b.step_count > 0)
        zr_hole_steps_print(print, "newSteps", &change->b);
    zr_print_doubles(print, "axis", axis, 3);
    print_place(print, "at", c, place_of_hole(hole));
    if (has_both) print_place(print, "newAt", c, place_of_hole(&change->b));
    print_box(print, c, change->min, change->max);
    zr_print_end(print, '}');
}

static void print_features(struct zr_print *print, const struct zr_comparison *c)
{
    static const char *const keys[] = {"removed", "added", "moved", "changed"};
    zr_print_begin(print, "features", '{');
    zr_print_begin(print, "holes", '{');
    for (int kind = 0; kind < ZR_HOLE_CHANGE_KINDS; kind++) {
        zr_print_begin(print, keys[kind], '[');
        for (uint32_t i = 0; i < c->holes.count; i++)
            if ((int)c->holes.at[i].kind == kind) print_hole(print, c, &c->holes.at[i]);
        zr_print_end(print, ']');
    }
    if (c->holes.omitted > 0) zr_print_count(print, "omitted", c->holes.omitted);
    zr_print_end(print, '}');
    zr_print_end(print, '}');
}

/* Prints a motion of places in the files as the matrix of a node: column by column. */
static void print_motion(struct zr_print *print, const char *key, const struct zr_comparison *c,
                         const struct zr_rigid *motion)
{
    const struct zr_world_place m = c->a.middle,
                                back = zr_rigid_apply(motion, (struct zr_world_place){-m.x, -m.y, -m.z});
    double matrix[16] = {0};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            matrix[4 * column + row] = motion->turn[row][column] + 0.0;
    matrix[12] = back.x + m.x + 0.0;
    matrix[13] = back.y + m.y + 0.0;
    matrix[14] = back.z + m.z + 0.0;
    matrix[15] = 1.0;
    zr_print_doubles(print, key, matrix, 16);
}

static void print_alignment(struct zr_print *print, const struct zr_comparison *c)
{
    const struct zr_alignment *own = &c->alignment;
    zr_print_begin(print, "alignment", '{');
    zr_print_string(print, "align", zr_align_words[c->align]);
    print_motion(print, "matrix", c, &own->motion);
    if (own->scale > 0.0) zr_print_double(print, "scale", own->scale);
    if (!own->is_omitted) zr_print_double(print, "rmsBefore", own->before);
    if (!own->is_omitted) zr_print_double(print, "rmsAfter", own->after);
    if (c->align == ZR_ALIGN_PRINCIPAL) zr_print_bool(print, "mirrored", own->is_mirrored);
    zr_print_begin(print, "ambiguous", '[');
    for (uint32_t i = 0; i < own->ambiguous_count; i++)
        print_motion(print, NULL, c, &own->ambiguous[i]);
    zr_print_end(print, ']');
    zr_print_end(print, '}');
}

enum zr_status zr_comparison_json_write(const struct zr_comparison *c, const struct zr_scene *a,
                                        const struct zr_scene *b, struct zr_buffer *out)
{
    struct zr_print root = {.out = out}, *print = &root;
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "summary", summary_of(c).text);
    zr_print_bool(print, "same", c->is_same);
    zr_print_double(print, "tolerance", c->tolerance);
    print_solid(print, "a", c, a, &c->a, &c->volumes.a);
    print_solid(print, "b", c, b, &c->b, &c->volumes.b);
    if (c->align != ZR_ALIGN_NONE) print_alignment(print, c);
    if (c->has_volumes) print_volumes(print, &c->volumes);
    print_silhouettes(print, c, a);
    if (c->has_deviation) print_distances(print, c);
    if (c->has_volumes) print_regions(print, c);
    if (c->has_parts) print_changes(print, &c->parts);
    if (!c->holes.is_omitted) print_features(print, c);
    zr_print_begin(print, "warnings", '[');
    for (size_t i = 0; i < c->warnings.count; i++)
        zr_print_string(print, NULL, c->warnings.texts[i]);
    zr_print_end(print, ']');
    zr_print_end(print, '}');
    return zr_buffer_add(out, "\n", 1) && zr_arena_ok(out->arena) ? ZR_OK : ZR_NO_MEMORY;
}
