#include "bench/works.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/input/meshes.h"
#include "reference/models.h"

enum shape { FILL_BACK_FIRST, FILL_FRONT_FIRST, BUNNY, DENSE_BUNNY, CUBE, POLYGONS };

enum { BALL_RINGS = 132, POLYGON_COUNT = 80000 };

/* From its feet to its ears it has two thirds of the window's height. */
static const float ANIMAL_ZOOM = 1.3f;

static const struct {
    const char *name;
    enum shape shape;
    uint32_t width, height;
    enum work_culling culling;
    struct bar bars[WORK_SHADES];
} works[WORKS] = {
    [WORK_FILL_BACK_FIRST] =
        {"fill back to front 1080p", FILL_BACK_FIRST, 1920, 1080, WORK_NOT_CULLED, {{14, 30}, {9, 20}}},
    [WORK_FILL_FRONT_FIRST] =
        {"fill front to back 1080p", FILL_FRONT_FIRST, 1920, 1080, WORK_NOT_CULLED, {{14, 30}, {9, 20}}},
    [WORK_BUNNY] = {"69 k 1080p", BUNNY, 1920, 1080, WORK_BAR_IF_CULLED, {{6, 10}, {4.5, 7}}},
    [WORK_BUNNY_SMALL] = {"69 k 512x512", BUNNY, 512, 512, WORK_BAR_IF_CULLED, {{9, 14}, {6.5, 10}}},
    [WORK_DENSE] = {"1.1 M 1080p", DENSE_BUNNY, 1920, 1080, WORK_BAR_ALWAYS, {{13, 22}, {8.5, 15}}},
    [WORK_DENSE_SMALL] = {"1.1 M 512x512", DENSE_BUNNY, 512, 512, WORK_BAR_ALWAYS, {{17, 28}, {12, 20}}},
    [WORK_CUBE] = {"cube 256x256", CUBE, 256, 256, WORK_BAR_ALWAYS, {{3.5, 8}, {1.7, 5}}},
    [WORK_POLYGONS] = {"80 000 polygons 1080p", POLYGONS, 1920, 1080, WORK_BAR_IF_CULLED, {{0, 0}, {0, 0}}},
};

/* ---- shapes ---- */

static const char bunny[] = "bunny", ball[] = "generated ball";

const char *works_animal(const char *directory)
{
    char path[600];
    snprintf(path, sizeof path, "%s/stanford-bunny.obj", directory);
    return access(path, R_OK) == 0 ? bunny : ball;
}

/* The bunny, or, where it is not there, a ball of as many triangles and about its size in the window. */
static const char *make_animal(struct drawing *drawing, const char *directory, uint32_t width, uint32_t height)
{
    const char *animal = works_animal(directory);
    if (animal == ball)
        meshes_ball(drawing, BALL_RINGS);
    else if (!models_drawing(drawing, directory, "stanford-bunny", 0, width, height))
        return NULL;
    meshes_look(drawing, false, ANIMAL_ZOOM, width, height);
    return drawing->failed ? NULL : animal;
}

static const char *make_dense_animal(struct drawing *drawing, const char *directory, uint32_t width, uint32_t height)
{
    struct drawing coarse = {0}, finer = {0};
    const char *animal = make_animal(&coarse, directory, width, height);
    if (animal) {
        meshes_subdivide(&coarse, &finer);
        meshes_subdivide(&finer, drawing);
    }
    drawing_free(&coarse);
    drawing_free(&finer);
    return drawing->failed ? NULL : animal;
}

/* What the name begins with; NULL on failure. */
static const char *make_shape(enum shape shape, struct drawing *drawing, const char *directory, uint32_t width,
                              uint32_t height)
{
    switch (shape) {
    case FILL_BACK_FIRST:
    case FILL_FRONT_FIRST:
        meshes_fill(drawing, width, height, shape == FILL_FRONT_FIRST);
        break;
    case BUNNY:
        return make_animal(drawing, directory, width, height);
    case DENSE_BUNNY:
        return make_dense_animal(drawing, directory, width, height);
    case CUBE:
        meshes_cube(drawing, width, height);
        break;
    case POLYGONS:
        meshes_polygons(drawing, width, height, POLYGON_COUNT);
        break;
    }
    return drawing->failed ? NULL : "";
}

/* ---- a work ---- */

static bool cut_into_triangles(struct work *work)
{
    const struct drawing *d = &work->drawing;
    work->corners = malloc(3 * (size_t)(d->corner_count + 1) * sizeof *work->corners);
    if (!work->corners) return false;
    for (uint32_t f = 0; f < d->face_count; f++) {
        const uint32_t *v = d->indices + d->face_offsets[f];
        uint32_t count = d->face_offsets[f + 1] - d->face_offsets[f];
        for (uint32_t i = 2; i < count; i++) {
            const uint32_t triangle[3] = {count == 3 ? v[0] : v[i - 1], count == 3 ? v[1] : v[i],
                                          count == 3 ? v[2] : v[0]};
            memcpy(work->corners + work->corner_count, triangle, sizeof triangle);
            work->corner_count += 3;
        }
    }
    return true;
}

static void *copied(struct zr_arena *arena, const void *array, size_t count, size_t size)
{
    void *copy = zr_arena_alloc(arena, count, size);
    if (copy) memcpy(copy, array, count * size);
    return copy;
}

/* Into the arena: memory of a request is in pages of another size than what malloc gives. */
static bool settle(struct work *work)
{
    struct drawing made = work->drawing, *d = &work->drawing;
    uint32_t *made_corners = work->corners;
    zr_arena_init(&work->arena, SIZE_MAX);
    d->positions = copied(&work->arena, made.positions, made.position_count, sizeof *made.positions);
    d->colors = copied(&work->arena, made.colors, made.position_count, sizeof *made.colors);
    d->indices = copied(&work->arena, made.indices, made.corner_count, sizeof *made.indices);
    work->corners = copied(&work->arena, made_corners, work->corner_count, sizeof *made_corners);
    free(made.positions);
    free(made.colors);
    free(made.indices);
    free(made_corners);
    return zr_arena_ok(&work->arena);
}

bool works_make(enum works number, const char *directory, struct work *work)
{
    *work = (struct work){.culling = works[number].culling, .bars = {works[number].bars[0], works[number].bars[1]}};
    const char *animal =
        make_shape(works[number].shape, &work->drawing, directory, works[number].width, works[number].height);
    if (animal && cut_into_triangles(work) && settle(work)) {
        work->drawing.smooth = true;
        snprintf(work->name, sizeof work->name, "%s%s%s", animal, animal[0] ? " " : "", works[number].name);
        return true;
    }
    fprintf(stderr, "zraster-bench: %s could not be made\n", works[number].name);
    return false;
}

void works_look(struct work *work, uint32_t width, uint32_t height)
{
    meshes_look(&work->drawing, false, ANIMAL_ZOOM, width, height);
}

void works_free(struct work *work)
{
    if (work->arena.ceiling > 0) {
        work->drawing.positions = work->drawing.colors = NULL;
        work->drawing.indices = work->corners = NULL;
        zr_arena_free(&work->arena);
    }
    drawing_free(&work->drawing);
    free(work->corners);
    *work = (struct work){.name = ""};
}

void works_variant_name(const struct work *work, const struct variant *variant, char *name, size_t size)
{
    const char *culled = work->culling == WORK_NOT_CULLED ? "" : variant->culled ? " culled" : " not culled";
    snprintf(name, size, "%s %s%s", work->name, variant->shade == WORK_FLAT ? "flat" : "Gouraud", culled);
}

struct bar works_bar(const struct work *work, const struct variant *variant)
{
    if (work->culling == WORK_BAR_IF_CULLED && !variant->culled) return (struct bar){0, 0};
    return work->bars[variant->shade];
}

int works_variants(const struct work *work, struct variant variants[WORK_VARIANTS_MAX])
{
    int count = 0;
    for (int culled = work->culling == WORK_NOT_CULLED ? 0 : 1; culled >= 0; culled--)
        for (int shade = 0; shade < WORK_SHADES; shade++)
            variants[count++] = (struct variant){(enum work_shade)shade, culled};
    return count;
}
