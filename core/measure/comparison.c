#include "measure/comparison.h"

#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/status.h"
#include "measure/silhouettes.h"

enum { QUICK_RAYS = 128, QUICK_POINTS = 10000 };

/* Shares by which areas differ at most: of a model and its moved copy, and of a model and a copy with changes. */
#define SAME_AREA 1e-3
#define NEAR_AREA 0.05

/* Boxes that differ by more than this share of the diagonal are in other places, or of another size. */
#define ELSEWHERE 1e-3

static const char sides[2][2] = {"a", "b"};

/* Factors between usual units, and what they are. */
static const struct {
    double factor;
    const char *words;
} units[] = {{25.4, "inches and millimetres"},      {2.54, "inches and centimetres"},
             {10.0, "centimetres and millimetres"}, {1000.0, "metres and millimetres"},
             {100.0, "metres and centimetres"},     {39.37, "metres and inches"}};

/* True if a ratio, or its inverse, is the factor to 2 %. */
static bool is_factor(double ratio, double factor)
{
    const double up = ratio / factor, down = ratio * factor;
    return (up > 0.98 && up < 1.02) || (down > 0.98 && down < 1.02);
}

/* Warns if the files name different units, or if one model is larger by the factor of two units, to 2 %. */
static void warn_of_units(const struct zr_run *run, const struct zr_scene *const scenes[2], bool can_scale,
                          struct zr_comparison *c)
{
    const char *const names[2] = {scenes[0]->file.unit, scenes[1]->file.unit};
    if (names[0] && names[1] && strcmp(names[0], names[1]) != 0)
        zr_warning_list_add(run->arena, &c->warnings, "a is in the unit %s, b in %s: lengths are not converted",
                            names[0], names[1]);
    const double of_boxes = c->a.diagonal > 0.0 ? c->b.diagonal / c->a.diagonal : 1.0,
                 of_areas = c->a.area > 0.0 ? sqrt(c->b.area / c->a.area) : 1.0; /* also of a turned model */
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        const bool is_box = is_factor(of_boxes, units[i].factor), is_area = is_factor(of_areas, units[i].factor);
        const double ratio = is_box ? of_boxes : of_areas;
        if (is_box || is_area)
            zr_warning_list_add(run->arena, &c->warnings,
                                "b is %.4g times as large as a, as if one had other units: %s%s", ratio, units[i].words,
                                can_scale ? "" : "; align=principal and rescale=on compare both in one size");
    }
}

static void warn_of_alignment(const struct zr_run *run, struct zr_comparison *c)
{
    if (c->alignment.is_omitted)
        zr_warning_list_add(run->arena, &c->warnings, "nothing is aligned: too many triangles overlap to search them");
    if (c->alignment.is_mirrored)
        zr_warning_list_add(run->arena, &c->warnings, "a mirror image of b fits a much better than b does");
    if (c->alignment.ambiguous_count > 0)
        zr_warning_list_add(run->arena, &c->warnings, "b fits a in other ways, too: alignment.ambiguous has %u",
                            c->alignment.ambiguous_count);
}

/* Returns how far apart two boxes are, as an axis tells: below 0 if they overlap. */
static double gap_of(const struct zr_comparison *c)
{
    double gap = -HUGE_VAL;
    for (int k = 0; k < 3; k++)
        gap = fmax(gap, fmax(c->a.min[k] - c->b.max[k], c->b.min[k] - c->a.max[k]));
    return gap;
}

static bool is_elsewhere(const struct zr_comparison *c)
{
    const double nothing = ELSEWHERE * c->a.diagonal;
    for (int k = 0; k < 3; k++)
        if (fabs(c->a.min[k] - c->b.min[k]) > nothing || fabs(c->a.max[k] - c->b.max[k]) > nothing) return true;
    return false;
}

/* Warns if b seems to be a itself, moved: it has the area of a beside it, or elsewhere without any hole of a. */
static void warn_of_motion(const struct zr_run *run, struct zr_comparison *c)
{
    const double change = fabs(c->a.area - c->b.area);
    bool has[ZR_HOLE_CHANGE_KINDS] = {false};
    for (uint32_t i = 0; i < c->holes.count; i++)
        has[c->holes.at[i].kind] = true;
    const bool has_none = c->holes.equal == 0 && !has[ZR_HOLE_CHANGED];
    if (c->align != ZR_ALIGN_NONE) return;
    if (change <= SAME_AREA * c->a.area && (gap_of(c) > 0.0 || (has_none && has[ZR_HOLE_MOVED] && is_elsewhere(c))))
        zr_warning_list_add(run->arena, &c->warnings,
                            "b has the area of a, but lies elsewhere: align=principal moves it if it fits");
    else if (has_none && !has[ZR_HOLE_MOVED] && has[ZR_HOLE_REMOVED] && has[ZR_HOLE_ADDED] &&
             change <= NEAR_AREA * c->a.area)
        zr_warning_list_add(
            run->arena, &c->warnings,
            "a and b have no hole in common, but nearly the same area: align=principal turns b if it fits");
}

static void warn(const struct zr_run *run, const struct zr_comparison_options *options, struct zr_comparison *c)
{
    const struct zr_solid *solids[2] = {&c->a, &c->b};
    const struct zr_own_volume *volumes[2] = {&c->volumes.a, &c->volumes.b};
    for (int i = 0; i < 2; i++) {
        if (!solids[i]->is_closed)
            zr_warning_list_add(run->arena, &c->warnings,
                                "%s is not closed (%u open edges): volumes, IoU and signs of distances need closed "
                                "surfaces and are left out",
                                sides[i], solids[i]->odd_edges);
        if (!c->has_volumes) continue;
        if (volumes[i]->has_overlap)
            zr_warning_list_add(run->arena, &c->warnings, "shells of %s overlap; its volume counts the overlap once",
                                sides[i]);
        if (volumes[i]->is_inside_out)
            zr_warning_list_add(run->arena, &c->warnings, "the faces of %s look inwards; it is compared turned round",
                                sides[i]);
    }
    warn_of_alignment(run, c);
    warn_of_motion(run, c);
    if (!c->has_deviation && !options->has_no_deviation)
        zr_warning_list_add(run->arena, &c->warnings,
                            "distances are left out: too many triangles overlap to search them");
    if (c->holes.is_omitted && !options->has_no_features)
        zr_warning_list_add(run->arena, &c->warnings, "holes are left out: their search takes too much work or memory");
}

static void find_distances(struct zr_comparison *c)
{
    const struct zr_deviation *a = &c->a_to_b, *b = &c->b_to_a;
    c->has_deviation = a->points > 0 && b->points > 0;
    c->is_same = c->has_volumes && c->volumes.only_a == 0.0 && c->volumes.only_b == 0.0;
    if (!c->has_deviation) return;
    const bool is_of_a = fabs(a->max) >= fabs(b->max);
    c->hausdorff = fabs(is_of_a ? a->max : b->max);
    c->hausdorff_at = is_of_a ? a->at : b->at;
    c->chamfer = a->abs + b->abs;
    c->chamfer_square = a->square + b->square;
    c->f1 = a->within + b->within > 0.0 ? 2.0 * a->within * b->within / (a->within + b->within) : 0.0;
    c->normal_consistency = 0.5 * (a->alignment + b->alignment);
    c->is_same = c->hausdorff <= c->tolerance;
}

static enum zr_status measure_distances(const struct zr_run *run, const struct zr_comparison_options *options,
                                        struct zr_comparison *c)
{
    const uint32_t points = options->is_quick ? QUICK_POINTS : ZR_DEVIATION_POINTS;
    const struct zr_deviation_side a = {&c->trees[0], c->volumes.a.has_overlap},
                                   b = {&c->trees[1], c->volumes.b.has_overlap};
    c->threshold = ZR_COMPARISON_NEAR * c->a.diagonal;
    enum zr_status status = zr_deviation_find(run, &a, &b, points, c->threshold, &c->a_to_b);
    if (status == ZR_OK) status = zr_deviation_find(run, &b, &a, points, c->threshold, &c->b_to_a);
    if (status == ZR_OK) find_distances(c);
    return status;
}

/* Finds the part of each region: that of the nearest triangle of its solid. */
static void find_region_parts(const struct zr_part_list lists[2], struct zr_comparison *c)
{
    for (uint32_t i = 0; i < c->regions.count; i++) {
        const struct zr_region *region = &c->regions.at[i];
        const struct zr_surface_tree *tree = &c->trees[region->is_b];
        const struct zr_part_list *list = &lists[region->is_b];
        struct zr_surface_hit hit = {.triangle = 0};
        uint64_t steps = 0;
        zr_surface_tree_nearest(tree, region->at, -1.0, &hit, &steps);
        const uint32_t part = tree->solid->parts[hit.triangle];
        c->region_parts[i] = part < list->count ? list->at[part].name : "";
    }
}

static enum zr_status measure_volumes(const struct zr_run *run, const struct zr_comparison_options *options,
                                      struct zr_comparison *c)
{
    const double thin = zr_most_of(ZR_COMPARISON_THIN * c->a.diagonal, options->tolerance);
    c->has_volumes = c->a.is_closed && c->b.is_closed && c->a.diagonal > 0.0 && c->b.diagonal > 0.0;
    if (!c->has_volumes) return ZR_OK;
    return zr_volumes_find(run, &c->a, &c->b, options->is_quick ? QUICK_RAYS : ZR_VOLUME_RAYS, thin, &c->volumes,
                           &c->regions);
}

static enum zr_status measure_parts(const struct zr_run *run, const struct zr_scene *const scenes[2],
                                    struct zr_part_list lists[2], struct zr_comparison *c)
{
    for (int i = 0; i < 2; i++)
        lists[i] = zr_part_list_make(run->arena, scenes[i], ZR_PART_CHANGES_PARTS);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    c->has_parts = lists[0].total > 1 || lists[1].total > 1;
    if (!c->has_parts) return ZR_OK;
    return zr_part_changes_find(run, &c->a, &lists[0], &c->b, &lists[1], c->tolerance, &c->parts);
}

/* Moves b. */
static enum zr_status align(const struct zr_run *run, bool can_scale, struct zr_comparison *c)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct zr_surface_tree tree;
    struct zr_rigid size = zr_rigid_none();
    if (can_scale) size = zr_align_size(&c->a, &c->b, c->align, run->cancel);
    if (can_scale) zr_align_move(&c->b, &size, run->cancel);
    enum zr_status status = zr_surface_tree_make(&inner, &c->a, &tree);
    if (status == ZR_OK) status = zr_align_find(&inner, &tree, &c->b, c->align, can_scale, &c->alignment);
    if (status == ZR_OK) zr_align_move(&c->b, &c->alignment.motion, run->cancel);
    zr_arena_close_scratch(&scratch, run->arena);
    if (status != ZR_OK || !can_scale) return status;
    c->alignment.motion = zr_rigid_after(&size, &c->alignment.motion);
    c->alignment.scale = zr_rigid_scale(&c->alignment.motion);
    for (uint32_t i = 0; i < c->alignment.ambiguous_count; i++)
        c->alignment.ambiguous[i] = zr_rigid_after(&size, &c->alignment.ambiguous[i]);
    return status;
}

static enum zr_status measure(const struct zr_run *run, const struct zr_scene *const scenes[2],
                              const struct zr_comparison_options *options, struct zr_comparison *c)
{
    struct zr_part_list lists[2];
    enum zr_status status = measure_volumes(run, options, c);
    if (status == ZR_OK)
        status =
            zr_silhouettes_find(run, &c->a, &c->b, options->is_quick ? QUICK_RAYS : ZR_SILHOUETTE_RAYS, c->silhouettes);
    c->tolerance = options->tolerance >= 0.0 ? options->tolerance : ZR_COMPARISON_SAME * c->a.diagonal;
    if (status == ZR_OK) status = measure_parts(run, scenes, lists, c);
    c->holes.is_omitted = true;
    if (status == ZR_OK && !options->has_no_features)
        status = zr_hole_changes_find(run, &c->a, &c->b, c->tolerance, &c->holes);
    const bool needs_trees = options->is_drawn || c->has_parts || !options->has_no_deviation;
    if (status == ZR_OK && needs_trees) status = zr_surface_tree_make(run, &c->a, &c->trees[0]);
    if (status == ZR_OK && needs_trees) status = zr_surface_tree_make(run, &c->b, &c->trees[1]);
    if (status == ZR_OK && !options->has_no_deviation) status = measure_distances(run, options, c);
    if (status == ZR_OK && options->has_no_deviation) find_distances(c);
    if (status == ZR_OK && c->has_parts) find_region_parts(lists, c);
    return status;
}

enum zr_status zr_comparison_make(const struct zr_run *run, const struct zr_scene *a, const struct zr_scene *b,
                                  const struct zr_comparison_options *options, struct zr_comparison *out)
{
    *out = (struct zr_comparison){.align = options->align};
    if (a->csg || b->csg)
        return zr_error_add(run->error, ZR_BAD_SCENE, "/csg",
                            "combined solids have no mesh to compare: leave out csg of %s", sides[a->csg ? 0 : 1]);
    enum zr_status status = zr_solid_make(run, a, NULL, &out->a);
    if (status == ZR_OK) status = zr_solid_make(run, b, &out->a.middle, &out->b);
    if (status != ZR_OK) return status;
    for (int i = 0; i < 2; i++)
        if ((i == 0 ? &out->a : &out->b)->count == 0)
            return zr_error_add(run->error, ZR_BAD_SCENE, NULL,
                                "%s has no faces with an area; comparing needs surfaces, not lines or points",
                                sides[i]);
    warn_of_units(run, (const struct zr_scene *const[2]){a, b}, options->can_scale, out);
    if (out->align != ZR_ALIGN_NONE) status = align(run, options->can_scale, out);
    if (status != ZR_OK) return status;
    status = measure(run, (const struct zr_scene *const[2]){a, b}, options, out);
    if (status != ZR_OK) return status;
    warn(run, options, out);
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}
