#include "input/query/cloud.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "render_request.h"
#include "scene/camera/camera.h"
#include "scene/parsed_picture.h"

/* ---- the distance of neighbouring points ---- */

enum { LEVELS = 8, SIDE = 1 << (LEVELS - 1), WORD = 64, WORDS = SIDE * SIDE * SIDE / WORD, POINTS_PER_RANGE = 1 << 14 };

static const double POINTS_PER_CELL = 4.0, OVERLAP = 1.5, SIZES_PER_SIDE = 40.0, SIZE_MOST = 64.0;

struct grid {
    const struct zr_mesh *mesh;
    const struct zr_cancel *cancel;
    zr_vec3 min;
    double per_cell;         /* cells per scene unit */
    _Atomic uint64_t *words; /* one bit per cell, x fastest */
};

static uint32_t cell_of(const struct grid *grid, float at, float min)
{
    const double cell = ((double)at - (double)min) * grid->per_cell;
    return cell >= SIDE - 1 ? SIDE - 1 : cell > 0.0 ? (uint32_t)cell : 0;
}

static void mark_range(void *context, size_t begin, size_t end)
{
    const struct grid *grid = context;
    if (zr_is_cancelled(grid->cancel)) return;
    for (size_t i = begin; i < end; i++) {
        const zr_vec4 *p = &grid->mesh->positions[zr_mesh_point(grid->mesh, (uint32_t)i)];
        const uint32_t x = cell_of(grid, p->x, grid->min.x), y = cell_of(grid, p->y, grid->min.y),
                       z = cell_of(grid, p->z, grid->min.z);
        const uint32_t cell = (z * SIDE + y) * SIDE + x;
        const uint64_t bit = UINT64_C(1) << cell % WORD;
        _Atomic uint64_t *word = &grid->words[cell / WORD];
        if (!(atomic_load_explicit(word, memory_order_relaxed) & bit))
            atomic_fetch_or_explicit(word, bit, memory_order_relaxed);
    }
}

/* Counts the blocks of `step` cells per side that hold a point. */
static uint64_t count_blocks(const struct grid *grid, uint32_t step, uint8_t *blocks)
{
    const uint32_t side = SIDE / step;
    uint64_t count = 0;
    memset(blocks, 0, (size_t)side * side * side);
    for (uint32_t i = 0; i < WORDS; i++)
        for (uint64_t left = grid->words[i]; left; left &= left - 1) {
            const uint32_t cell = i * WORD + (uint32_t)__builtin_ctzll(left);
            const uint32_t x = cell % SIDE / step, y = cell / SIDE % SIDE / step, z = cell / SIDE / SIDE / step;
            uint8_t *block = &blocks[(z * side + y) * side + x];
            count += !*block;
            *block = 1;
        }
    return count;
}

static uint64_t count_points(const struct zr_scene *scene)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        count += scene->meshes[i].point_count;
    return count;
}

/* Returns the spacing of `points` marked points in cells of the finest grid. */
static double spacing_of(const struct grid *grid, uint64_t points, uint8_t *blocks)
{
    for (uint32_t step = 1;; step *= 2) {
        const uint64_t count = count_blocks(grid, step, blocks);
        if (step == SIDE || (double)points >= POINTS_PER_CELL * (double)count)
            return (double)step * sqrt((double)count / (double)points);
    }
}

float zr_point_size_for(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                        const struct zr_view *view)
{
    const struct zr_bounds bounds = zr_bounds_of(scene, team, arena->cancel);
    const uint64_t points = count_points(scene);
    const double diagonal = (double)zr_diagonal_of(&bounds);
    const double side = (double)(view->width < view->height ? view->width : view->height);
    const double widest =
        fmax(fmax((double)bounds.max.x - (double)bounds.min.x, (double)bounds.max.y - (double)bounds.min.y),
             (double)bounds.max.z - (double)bounds.min.z);
    const double most = fmin(side / SIZES_PER_SIDE, SIZE_MOST);
    if (points == 0 || !bounds.valid) return 1.0f;
    if (!(widest > 0.0)) return (float)fmax(most, 1.0);
    struct grid grid = {.cancel = arena->cancel,
                        .min = bounds.min,
                        .per_cell = SIDE / widest,
                        .words = zr_arena_zero(arena, WORDS, sizeof *grid.words)};
    uint8_t *blocks = zr_arena_alloc(arena, (size_t)SIDE * SIDE * SIDE, sizeof *blocks);
    if (!grid.words || !blocks) return 1.0f;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        grid.mesh = &scene->meshes[i];
        zr_team_ranges(team, grid.mesh->point_count, POINTS_PER_RANGE, mark_range, &grid);
    }
    const double spacing = spacing_of(&grid, points, blocks) / grid.per_cell;
    zr_arena_trim(arena, blocks, (size_t)SIDE * SIDE * SIDE, 0, sizeof *blocks);
    zr_arena_trim(arena, (void *)grid.words, WORDS, 0, sizeof *grid.words);
    return (float)fmax(fmin(OVERLAP * spacing * side / diagonal, most), 1.0);
}

/* ---- edges, colours and sizes ---- */

struct numbers {
    uint64_t faces, lines, points;
};

static struct numbers count(const struct zr_scene *scene)
{
    struct numbers sum = {0, 0, 0};
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        sum.faces += scene->meshes[i].face_count;
        sum.lines += scene->meshes[i].line_count;
        sum.points += scene->meshes[i].point_count;
    }
    return sum;
}

/* True if the meshes have points, and neither faces nor lines. */
static bool is_cloud(const struct zr_scene *scene)
{
    const struct numbers sum = count(scene);
    return sum.points > 0 && sum.faces == 0 && sum.lines == 0;
}

bool zr_cloud_take_edges(struct zr_parsed_scene *root)
{
    struct zr_edges *edges = &root->picture->merged.edges;
    if (!is_cloud(root->scene) || !edges->is_on || zr_picture_gives(root->picture, ZR_PICTURE_EDGES)) return false;
    edges->is_on = false;
    return true;
}

static void color_meshes(const struct zr_query *query, zr_vec4 color)
{
    const struct zr_scene_builder *builder = query->given.builder;
    for (uint32_t i = 0; i < builder->scene->mesh_count && !query->request->color; i++)
        if (!builder->meshes[i].colors) builder->materials[builder->meshes[i].material].base_color = color;
}

void zr_wire_color(const struct zr_query *query)
{
    const struct zr_scene *scene = query->given.builder->scene;
    const struct numbers sum = count(scene);
    if (scene->look->wire.w > 0.0f && sum.lines > 0 && sum.faces == 0) color_meshes(query, scene->look->wire);
}

void zr_cloud_draw_in_ink(const struct zr_query *query)
{
    const struct zr_scene_builder *builder = query->given.builder;
    const struct zr_look *look = builder->scene->look;
    const zr_vec3 edges = builder->scene->picture->edges.color, own = look->picture->edges.color;
    const bool is_own = edges.x == own.x && edges.y == own.y && edges.z == own.z;
    const zr_vec4 ink = is_own && look->cloud.w > 0.0f ? look->cloud : (zr_vec4){edges.x, edges.y, edges.z, 1};
    if (look->material.shading == ZR_SHADING_PBR) return;
    color_meshes(query, ink);
}

void zr_cloud_size_points(const struct zr_query *query)
{
    const struct zr_scene_builder *builder = query->given.builder;
    const struct zr_scene *scene = builder->scene;
    float size = 0.0f;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        struct zr_mesh *mesh = &builder->meshes[i];
        if (mesh->point_count == 0 || mesh->point_size > 0.0f) continue;
        if (size == 0.0f) size = zr_point_size_for(builder->arena, builder->team, scene, &scene->views[0]);
        mesh->point_size = size;
        mesh->points_are_round = scene->look->picture->side > 1;
    }
}
