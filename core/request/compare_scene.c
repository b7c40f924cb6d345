#include "request/compare_scene.h"

#include <stdio.h>
#include <string.h>

#include "measure/refined.h"
#include "mesh/facts/ray_grid.h"
#include "output/json/json_print.h"
#include "request/change.h"

enum { MESHES_MOST = 4, NAME_SIZE = 8, SHARE = 64, FINE_SHARE = 384, MARKS_MOST = 24 };

/* Distance between models side by side, in widths. */
#define BESIDE 1.2

const char *const zr_compare_show_words[ZR_SHOW_COUNT] = {"none", "difference", "deviation", "side"};

/* A mesh of the scene: triangles of a class, which share no corners. */
struct shown {
    const char *name;
    uint32_t triangles;
    const double *positions; /* three corners of three numbers per triangle */
    const uint32_t *faces;
    const double *scalars; /* per corner; NULL: one colour */
    char assets[3][NAME_SIZE];
};

struct showing {
    const struct zr_run *run;
    const struct zr_comparison *c;
    struct shown meshes[MESHES_MOST];
    uint32_t count;
    double range; /* of the distances */
};

/* ---- meshes ---- */

static enum zr_status refine(const struct showing *s, bool is_b, bool by_class, struct zr_refined *out)
{
    const struct zr_run inner = zr_run_in(s->run, s->run->scratch);
    const double size = s->c->a.diagonal, near = zr_most_of(ZR_COMPARISON_THIN * size, s->c->tolerance);
    const struct zr_refining how = {size / SHARE, by_class ? size / FINE_SHARE : HUGE_VAL, near,
                                    by_class ? zr_most_of(near, size / SHARE) : HUGE_VAL};
    const struct zr_solid *solid = is_b ? &s->c->b : &s->c->a;
    const enum zr_status status = zr_refined_make(&inner, solid, &s->c->trees[is_b ? 0 : 1], &how, out);
    if (status != ZR_OK || !out->is_omitted) return status;
    return zr_error_add(s->run->error, ZR_BAD_SCENE, NULL,
                        "the differences cannot be drawn: too many triangles overlap to search them");
}

/* Adds the triangles of some classes as a mesh, unless there are none. `classes`: a bit per class. */
static bool add_mesh(struct showing *s, const char *name, const struct zr_refined *all, unsigned classes, double shift,
                     bool has_scalars)
{
    struct zr_arena *arena = s->run->arena;
    const struct zr_world_place middle = s->c->a.middle;
    uint32_t count = 0;
    for (uint32_t i = 0; i < all->count; i++)
        count += classes >> all->at[i].own & 1u;
    if (count == 0) return true;
    double *positions = zr_arena_alloc(arena, 9 * (size_t)count, sizeof *positions);
    double *scalars = zr_arena_alloc(arena, has_scalars ? 3 * (size_t)count : 0, sizeof *scalars);
    uint32_t *faces = zr_arena_alloc(arena, 3 * (size_t)count, sizeof *faces);
    if (!zr_arena_ok(arena)) return false;
    struct shown *mesh = &s->meshes[s->count];
    *mesh = (struct shown){name, 0, positions, faces, has_scalars ? scalars : NULL, {{0}}};
    for (uint32_t i = 0; i < all->count; i++) {
        const struct zr_refined_triangle *t = &all->at[i];
        if (!(classes >> t->own & 1u)) continue;
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = 3 * mesh->triangles + k;
            positions[3 * (size_t)corner] = t->at[k].x + (middle.x + shift);
            positions[3 * (size_t)corner + 1] = t->at[k].y + middle.y;
            positions[3 * (size_t)corner + 2] = t->at[k].z + middle.z;
            faces[corner] = corner;
            if (has_scalars) scalars[corner] = zr_most_of(-s->range, zr_least_of(t->distance[k], s->range));
        }
        mesh->triangles++;
    }
    for (int k = 0; k < 3; k++)
        snprintf(mesh->assets[k], NAME_SIZE, "%c%u", "pfs"[k], s -> count);
    s->count++;
    return true;
}

/* Returns the distance that 99.5 % of the corners do not exceed, rounded up to one digit. */
static double range_of(const struct showing *s, const struct zr_refined *all)
{
    const uint32_t count = 3 * all->count;
    uint64_t *bits = zr_arena_alloc(s->run->scratch, 2 * (size_t)count, sizeof *bits);
    double value, unit = 1.0;
    if (!bits) return 1.0;
    for (uint32_t i = 0; i < count; i++) {
        value = fabs(all->at[i / 3].distance[i % 3]);
        memcpy(&bits[i], &value, sizeof value);
    }
    zr_ray_sort(bits, count, bits + count, s->run->cancel);
    memcpy(&value, &bits[(uint64_t)(count - 1) * 995 / 1000], sizeof value);
    value = zr_most_of(value, s->c->tolerance);
    if (!(value > 0.0)) return 1.0;
    while (unit > value)
        unit /= 10.0;
    while (10.0 * unit <= value)
        unit *= 10.0;
    return ceil(value / unit - 1e-9) * unit;
}

/* Returns how far the second model is shifted along x beside the first one. */
static double shift_of(const struct showing *s)
{
    return BESIDE * zr_most_of(s->c->a.max[0] - s->c->a.min[0], s->c->b.max[0] - s->c->b.min[0]);
}

static enum zr_status make_meshes(struct showing *s, int show)
{
    enum { NEAR = 1 << ZR_SURFACE_NEAR, OUTSIDE = 1 << ZR_SURFACE_OUTSIDE, INSIDE = 1 << ZR_SURFACE_INSIDE };
    struct zr_refined a = {.count = 0}, b;
    const double shift = shift_of(s);
    enum zr_status status = refine(s, true, show != ZR_SHOW_DEVIATION, &b);
    if (status == ZR_OK && show != ZR_SHOW_DEVIATION) status = refine(s, false, true, &a);
    if (status != ZR_OK) return status;
    bool ok = true;
    if (show == ZR_SHOW_DEVIATION) {
        s->range = range_of(s, &b);
        ok = add_mesh(s, "deviation", &b, NEAR | OUTSIDE | INSIDE, 0.0, true);
    } else if (show == ZR_SHOW_DIFFERENCE) {
        ok = add_mesh(s, "common", &a, NEAR, 0.0, false) && add_mesh(s, "onlyA", &a, OUTSIDE, 0.0, false) &&
             add_mesh(s, "onlyB", &b, OUTSIDE, 0.0, false);
    } else {
        ok = add_mesh(s, "common", &a, NEAR | INSIDE, 0.0, false) && add_mesh(s, "onlyA", &a, OUTSIDE, 0.0, false) &&
             add_mesh(s, "common", &b, NEAR | INSIDE, shift, false) && add_mesh(s, "onlyB", &b, OUTSIDE, shift, false);
    }
    return ok ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- the scene ---- */

static void print_material(struct zr_print *print, const char *name, const char *color)
{
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "name", name);
    zr_print_string(print, "baseColorFactor", color);
    zr_print_end(print, '}');
}

static bool has_mesh(const struct showing *s, const char *name)
{
    for (uint32_t i = 0; i < s->count; i++)
        if (strcmp(s->meshes[i].name, name) == 0) return true;
    return false;
}

static void print_asset(struct zr_print *print, const char *key, const char *asset)
{
    zr_print_begin(print, key, '{');
    zr_print_string(print, "asset", asset);
    zr_print_end(print, '}');
}

static void print_mesh(struct zr_print *print, const struct showing *s, const struct shown *mesh)
{
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "name", mesh->name);
    print_asset(print, "positions", mesh->assets[0]);
    print_asset(print, "faces", mesh->assets[1]);
    zr_print_bool(print, "doubleSided", true);
    if (mesh->scalars) {
        const double range[2] = {-s->range, s->range};
        print_asset(print, "scalars", mesh->assets[2]);
        zr_print_string(print, "colormap", "coolwarm");
        zr_print_doubles(print, "range", range, 2);
    } else
        zr_print_string(print, "material", mesh->name);
    zr_print_end(print, '}');
}

/* Marks the regions by their numbers. `shift`: of the second model along x. */
static void print_marks(struct zr_print *print, const struct showing *s, double shift)
{
    const struct zr_world_place middle = s->c->a.middle;
    zr_print_begin(print, "marks", '[');
    for (uint32_t i = 0; i < s->c->regions.count && i < MARKS_MOST; i++) {
        const struct zr_region *region = &s->c->regions.at[i];
        const double at[3] = {region->at.x + middle.x + (region->is_b ? shift : 0.0), region->at.y + middle.y,
                              region->at.z + middle.z};
        char text[NAME_SIZE];
        snprintf(text, sizeof text, "%u", i + 1);
        zr_print_begin(print, NULL, '{');
        zr_print_doubles(print, "at", at, 3);
        zr_print_string(print, "text", text);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

static bool print_scene(const struct showing *s, const struct zr_compare_picture *picture, bool z_is_up,
                        struct zr_buffer *out)
{
    struct zr_print root = {.out = out}, *print = &root;
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "look", *picture->look ? picture->look : "studio");
    if (*picture->view) {
        zr_print_begin(print, "view", '{');
        zr_print_string(print, "preset", picture->view);
        zr_print_end(print, '}');
    }
    if (z_is_up) zr_print_string(print, "up", "z");
    if (s->meshes[0].scalars) {
        zr_print_begin(print, "colorBar", '{');
        zr_print_bool(print, "room", true);
        zr_print_end(print, '}');
    }
    if (picture->show != ZR_SHOW_DEVIATION) print_marks(print, s, picture->show == ZR_SHOW_SIDE ? shift_of(s) : 0.0);
    zr_print_begin(print, "materials", '[');
    if (has_mesh(s, "common")) print_material(print, "common", "#d4d6d8");
    if (has_mesh(s, "onlyA")) print_material(print, "onlyA", "#f0a01e");
    if (has_mesh(s, "onlyB")) print_material(print, "onlyB", "#d73228");
    zr_print_end(print, ']');
    zr_print_begin(print, "meshes", '[');
    for (uint32_t i = 0; i < s->count; i++)
        print_mesh(print, s, &s->meshes[i]);
    zr_print_end(print, ']');
    zr_print_end(print, '}');
    return zr_arena_ok(out->arena);
}

static struct zr_asset asset_of(const char *name, const void *data, enum zr_number_type type, size_t rows,
                                size_t columns)
{
    struct zr_asset asset = {.name = name, .bytes = data, .is_lent = true};
    asset.array = (struct zr_array){.data = data, .type = type, .ndim = columns > 1 ? 2 : 1, .shape = {rows, columns}};
    zr_array_bytes(&asset.array, &asset.size);
    return asset;
}

static enum zr_status keep(const struct showing *s, const struct zr_compare_picture *picture, bool z_is_up,
                           struct zr_kept **scene)
{
    const struct zr_limits limits = zr_limits_default();
    struct zr_buffer body = {.arena = s->run->arena};
    struct zr_asset *assets = zr_arena_alloc(s->run->arena, 3 * (size_t)s->count, sizeof *assets);
    if (!assets || !print_scene(s, picture, z_is_up, &body)) return ZR_NO_MEMORY;
    size_t count = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        const struct shown *mesh = &s->meshes[i];
        const size_t corners = 3 * (size_t)mesh->triangles;
        const char *const names[3] = {zr_arena_copy(s->run->arena, mesh->assets[0], NAME_SIZE),
                                      zr_arena_copy(s->run->arena, mesh->assets[1], NAME_SIZE),
                                      zr_arena_copy(s->run->arena, mesh->assets[2], NAME_SIZE)};
        if (!zr_arena_ok(s->run->arena)) return ZR_NO_MEMORY;
        assets[count++] = asset_of(names[0], mesh->positions, ZR_F8, corners, 3);
        assets[count++] = asset_of(names[1], mesh->faces, ZR_U4, mesh->triangles, 3);
        if (mesh->scalars) assets[count++] = asset_of(names[2], mesh->scalars, ZR_F8, corners, 1);
    }
    return zr_scene_keep_text(s->run, (const char *)body.bytes, body.size, assets, count, &limits, scene);
}

enum zr_status zr_compare_scene_make(const struct zr_run *run, const struct zr_comparison *comparison,
                                     const struct zr_compare_picture *picture, bool z_is_up, struct zr_kept **scene)
{
    struct showing s = {.run = run, .c = comparison};
    enum zr_status status = make_meshes(&s, picture->show);
    if (status == ZR_OK && s.count == 0)
        status = zr_error_add(run->error, ZR_BAD_SCENE, NULL, "there is no surface to draw");
    return status == ZR_OK ? keep(&s, picture, z_is_up, scene) : status;
}
