#include "shade/colors.h"

#include "base/fast.h"
#include "base/rgba.h"
#include "base/run.h"
#include "geometry/face.h"
#include "mesh/face_normals.h"
#include "mesh/vertex_normals.h"

/* Inputs and outputs of one mesh's colours. */
struct coloring {
    const struct zr_scene *scene;
    const struct zr_mesh *mesh;
    const struct zr_lights *lighting;
    struct zr_normal_matrix to_eye;
    const zr_mat4 *object_to_eye;
    const zr_vec4 *computed; /* vertex normals; NULL: not needed */
    enum zr_isa isa;
    zr_vec4 *front, *back;
    uint32_t *packed; /* instead of front and back */
    uint32_t count;   /* colours per side, if packed */
    bool two_sided_colors;
    bool per_corner; /* else per vertex, or per face */
    bool per_vertex;
    const struct zr_cancel *cancel;
};

bool zr_material_is_smooth(const struct zr_mesh *mesh, const struct zr_material *material)
{
    return zr_shading_varies(material->shading) ||
           (zr_shading_is_at(material->shading, ZR_SHADED_NEVER) && mesh->colors && !material->uniform_color);
}

/* Light evaluations per range, between two checks for cancellation: less than a millisecond. */
enum { EVALUATIONS_PER_RANGE = 1 << 14 };

/* Returns the points or faces per range. Each is lit by all lights. */
static uint32_t points_a_range(const struct coloring *coloring)
{
    return EVALUATIONS_PER_RANGE / (coloring->lighting->count + 1) + 1;
}

enum zr_rate zr_colors_rate(const struct zr_scene *scene, const struct zr_mesh *mesh)
{
    bool smooth = false;
    if (!mesh->face_materials)
        smooth = zr_material_is_smooth(mesh, &scene->materials[mesh->material]);
    else
        for (uint32_t f = 0; f < mesh->face_count && !smooth; f++)
            smooth = zr_material_is_smooth(mesh, zr_material_of_face(scene, mesh, f));
    if (!smooth) return ZR_RATE_FACE;
    bool shared = !mesh->face_materials && !mesh->face_colors && !mesh->normal_indices;
    return shared ? ZR_RATE_VERTEX : ZR_RATE_CORNER;
}

static uint32_t count_at(const struct zr_mesh *mesh, enum zr_rate rate)
{
    if (rate == ZR_RATE_FACE) return mesh->face_count;
    return rate == ZR_RATE_VERTEX ? mesh->position_count : mesh->face_offsets[mesh->face_count];
}

uint32_t zr_colors_count(const struct zr_scene *scene, const struct zr_mesh *mesh)
{
    return count_at(mesh, zr_colors_rate(scene, mesh));
}

static bool is_lit(const struct coloring *coloring, const struct zr_material *material)
{
    return !coloring->lighting->is_per_pixel && zr_material_is_lit_before(material);
}

/* ---- lighting many points at a time ---- */

enum { LIT_AT_ONCE = 64 };

/* Points to light, in consecutive slots. */
struct points {
    uint32_t first, count;
    zr_vec4 normals[LIT_AT_ONCE], bases[LIT_AT_ONCE];
};

/* Returns the vertex at which a slot is lit: for a flat face, that of its first corner. */
static inline uint32_t vertex_of_slot(const struct coloring *coloring, uint32_t slot)
{
    const struct zr_mesh *mesh = coloring->mesh;
    if (coloring->per_vertex) return slot;
    return mesh->indices[coloring->per_corner ? slot : mesh->face_offsets[slot]];
}

/* Lights up to LIT_AT_ONCE points in consecutive slots. Some light has a position. */
static void light_placed(const struct coloring *coloring, size_t first, const zr_vec4 *normals, const zr_vec4 *bases,
                         size_t count, zr_vec4 *front, zr_vec4 *back)
{
    const struct zr_lights *lighting = coloring->lighting;
    const zr_vec3 start = lighting->start;
    zr_vec4 points[LIT_AT_ONCE];
    for (size_t i = 0; i < count; i++) {
        const zr_vec4 position = coloring->mesh->positions[vertex_of_slot(coloring, (uint32_t)(first + i))];
        const zr_vec4 p = zr_mat4_apply(coloring->object_to_eye, position);
        points[i] = (zr_vec4){p.x - start.x, p.y - start.y, p.z - start.z, 0.0f};
    }
    zr_light_placed_of(coloring->isa)(lighting, &coloring->to_eye, normals, points, bases, count, front, back);
}

static void light_some(const struct coloring *coloring, size_t first, const zr_vec4 *normals, const zr_vec4 *bases,
                       size_t count, zr_vec4 *front, zr_vec4 *back)
{
    if (coloring->lighting->placed_count > 0)
        light_placed(coloring, first, normals, bases, count, front, back);
    else
        zr_light_of(coloring->isa)(coloring->lighting, &coloring->to_eye, normals, bases, count, front, back);
}

/* Lights up to LIT_AT_ONCE points, and packs their colours if wanted. */
static void put_lit(const struct coloring *coloring, size_t first, const zr_vec4 *normals, const zr_vec4 *bases,
                    size_t count)
{
    zr_rgba_pack_fn *pack = zr_rgba_pack_of(coloring->isa);
    zr_vec4 front[LIT_AT_ONCE], back[LIT_AT_ONCE];
    if (!coloring->packed) {
        light_some(coloring, first, normals, bases, count, coloring->front + first, coloring->back + first);
        return;
    }
    light_some(coloring, first, normals, bases, count, front, coloring->two_sided_colors ? back : front);
    pack(front, count, coloring->packed + first);
    if (coloring->two_sided_colors) pack(back, count, coloring->packed + coloring->count + first);
}

static void light_points(const struct coloring *coloring, struct points *points)
{
    if (points->count > 0) put_lit(coloring, points->first, points->normals, points->bases, points->count);
    points->count = 0;
}

static inline void add_point(const struct coloring *coloring, struct points *points, uint32_t slot, zr_vec3 normal,
                             zr_vec4 base)
{
    if (points->count == LIT_AT_ONCE || slot != points->first + points->count) light_points(coloring, points);
    if (points->count == 0) points->first = slot;
    points->normals[points->count] = (zr_vec4){normal.x, normal.y, normal.z, 0.0f};
    points->bases[points->count++] = base;
}

static void put_unlit(const struct coloring *coloring, uint32_t slot, zr_vec4 base)
{
    if (!coloring->packed) {
        coloring->front[slot] = coloring->back[slot] = base;
        return;
    }
    coloring->packed[slot] = zr_rgba_opaque(base);
    if (coloring->two_sided_colors) coloring->packed[coloring->count + slot] = coloring->packed[slot];
}

static void color_vertices(void *context, size_t begin, size_t end)
{
    const struct coloring *coloring = context;
    const struct zr_mesh *mesh = coloring->mesh;
    const struct zr_material *material = &coloring->scene->materials[mesh->material];
    struct points points = {.count = 0};
    if (zr_is_cancelled(coloring->cancel)) return;
    for (uint32_t v = (uint32_t)begin; v < end; v++) {
        zr_vec4 base = material->base_color;
        if (mesh->colors) base = zr_vec4_mul(base, mesh->colors[v]);
        if (!is_lit(coloring, material))
            put_unlit(coloring, v, base);
        else
            add_point(coloring, &points, v, zr_corner_normal(mesh, coloring->computed, v, 0), base);
    }
    light_points(coloring, &points);
}

static void color_flat_face(const struct coloring *coloring, const struct zr_material *material, zr_vec4 base,
                            uint32_t face, struct zr_face_normals *normals, struct points *points)
{
    const struct zr_mesh *mesh = coloring->mesh;
    const uint32_t begin = mesh->face_offsets[face], slot = coloring->per_corner ? begin : face;
    if (mesh->colors) base = zr_vec4_mul(base, mesh->colors[mesh->indices[begin]]);
    if (!is_lit(coloring, material))
        put_unlit(coloring, slot, base);
    else
        add_point(coloring, points, slot, zr_face_normal(normals, face), base);
}

static void color_smooth_face(const struct coloring *coloring, const struct zr_material *material, zr_vec4 base,
                              uint32_t face, struct points *points)
{
    const struct zr_mesh *mesh = coloring->mesh;
    for (uint32_t slot = mesh->face_offsets[face]; slot < mesh->face_offsets[face + 1]; slot++) {
        const uint32_t vertex = mesh->indices[slot];
        const zr_vec4 color = mesh->colors ? zr_vec4_mul(base, mesh->colors[vertex]) : base;
        if (!is_lit(coloring, material))
            put_unlit(coloring, slot, color);
        else
            add_point(coloring, points, slot, zr_corner_normal(mesh, coloring->computed, vertex, slot), color);
    }
}

/* Colours faces. Flat faces take the colour of their first vertex and fill one slot. */
static void color_faces(void *context, size_t begin, size_t end)
{
    const struct coloring *coloring = context;
    const struct zr_mesh *mesh = coloring->mesh;
    struct points points = {.count = 0};
    struct zr_face_normals normals;
    if (zr_is_cancelled(coloring->cancel)) return;
    zr_face_normals_begin(&normals, coloring->isa, mesh);
    for (uint32_t face = (uint32_t)begin; face < end; face++) {
        const struct zr_material *material = zr_material_of_face(coloring->scene, mesh, face);
        zr_vec4 base = material->base_color;
        if (mesh->face_colors) base = zr_vec4_mul(base, mesh->face_colors[face]);
        if (zr_material_is_smooth(mesh, material))
            color_smooth_face(coloring, material, base, face, &points);
        else
            color_flat_face(coloring, material, base, face, &normals, &points);
    }
    light_points(coloring, &points);
}

/* Returns true if all faces have one material, shading and colour, as in most meshes posted alone. The general path
 * took a sixth of the time of a million triangles. */
static bool is_of_one_color(const struct coloring *coloring, enum zr_shading_rate rate)
{
    const struct zr_mesh *mesh = coloring->mesh;
    return !coloring->lighting->is_per_pixel &&
           zr_shading_is_at(coloring->scene->materials[mesh->material].shading, rate) && !mesh->face_materials &&
           !mesh->face_colors && !mesh->colors;
}

static bool are_alike_triangles(const struct coloring *coloring)
{
    return is_of_one_color(coloring, ZR_SHADED_PER_FACE) && zr_mesh_is_of_triangles(coloring->mesh);
}

static bool are_alike_vertices(const struct coloring *coloring)
{
    return is_of_one_color(coloring, ZR_SHADED_PER_VERTEX) && coloring->mesh->normal_count == 0;
}

/* Lights vertices with their computed normals, or triangles with normals computed here; all have one base colour. */
static void color_alike(void *context, size_t begin, size_t end)
{
    const struct coloring *coloring = context;
    const zr_vec4 base = coloring->scene->materials[coloring->mesh->material].base_color;
    zr_vec4 bases[LIT_AT_ONCE], made[LIT_AT_ONCE];
    if (zr_is_cancelled(coloring->cancel)) return;
    for (int i = 0; i < LIT_AT_ONCE; i++)
        bases[i] = base;
    for (size_t first = begin, count; first < end; first += count) {
        const zr_vec4 *normals = made;
        count = end - first < LIT_AT_ONCE ? end - first : LIT_AT_ONCE;
        if (coloring->computed)
            normals = coloring->computed + first;
        else
            zr_triangle_normals_of(coloring->isa)(coloring->mesh, (uint32_t)first, count, made);
        put_lit(coloring, first, normals, bases, count);
    }
}

/* ---- a mesh ---- */

static bool changes_nothing(const struct zr_material *material)
{
    const zr_vec4 white = {1, 1, 1, 1};
    return zr_shading_is_at(material->shading, ZR_SHADED_NEVER) && zr_vec4_equal(material->base_color, white);
}

bool zr_colors_are_given(const struct zr_scene *scene, const struct zr_mesh *mesh, struct zr_colors *colors)
{
    const struct zr_material *material = &scene->materials[mesh->material];
    bool one_source = (mesh->colors != NULL) != (mesh->face_colors != NULL);
    if (mesh->face_materials || !changes_nothing(material) || !one_source) return false;
    bool smooth = zr_material_is_smooth(mesh, material);
    const zr_vec4 *given = mesh->colors ? mesh->colors : mesh->face_colors;
    *colors = (struct zr_colors){.rate = smooth         ? ZR_RATE_VERTEX
                                         : mesh->colors ? ZR_RATE_FIRST_VERTEX
                                                        : ZR_RATE_FACE,
                                 .front = given,
                                 .back = given,
                                 .count = mesh->colors ? mesh->position_count : mesh->face_count};
    return true;
}

bool zr_colors_can_be_packed(const struct zr_scene *scene, const struct zr_mesh *mesh)
{
    return zr_colors_rate(scene, mesh) == ZR_RATE_FACE;
}

static struct coloring coloring_make(const struct zr_run *run, const struct zr_scene *scene, const struct zr_mesh *mesh,
                                     const struct zr_lights *lighting, const zr_mat4 *object_to_eye)
{
    return (struct coloring){.scene = scene,
                             .mesh = mesh,
                             .lighting = lighting,
                             .to_eye = zr_normal_matrix_make(object_to_eye),
                             .object_to_eye = object_to_eye,
                             .isa = zr_team_isa(run->team),
                             .cancel = run->cancel};
}

static void make_of_faces(struct zr_team *team, struct coloring *coloring)
{
    zr_team_ranges(team, coloring->mesh->face_count, points_a_range(coloring),
                   ZR_FAST(alike_points, are_alike_triangles(coloring)) ? color_alike : color_faces, coloring);
}

struct zr_colors zr_colors_make_packed(const struct zr_run *run, const struct zr_scene *scene,
                                       const struct zr_mesh *mesh, const struct zr_lights *lighting,
                                       const zr_mat4 *object_to_eye, bool two_sided_colors, uint32_t *out)
{
    struct coloring coloring = coloring_make(run, scene, mesh, lighting, object_to_eye);
    coloring.count = mesh->face_count;
    coloring.two_sided_colors = two_sided_colors;
    coloring.packed = out;
    make_of_faces(run->team, &coloring);
    return (struct zr_colors){
        .rate = ZR_RATE_FACE, .two_sided_colors = two_sided_colors, .packed = out, .count = coloring.count};
}

struct zr_colors zr_colors_make(const struct zr_run *run, const struct zr_scene *scene, const struct zr_mesh *mesh,
                                const struct zr_lights *lighting, const zr_mat4 *object_to_eye, const zr_vec4 **normals,
                                zr_vec4 *front, zr_vec4 *back)
{
    enum zr_rate rate = zr_colors_rate(scene, mesh);
    struct zr_colors colors = {
        .rate = rate, .two_sided_colors = front != back, .front = front, .back = back, .count = count_at(mesh, rate)};
    struct coloring coloring = coloring_make(run, scene, mesh, lighting, object_to_eye);
    coloring.front = front;
    coloring.back = back;
    coloring.per_corner = rate == ZR_RATE_CORNER;
    coloring.per_vertex = rate == ZR_RATE_VERTEX;
    if (rate != ZR_RATE_FACE && !lighting->is_per_pixel && zr_mesh_is_lit_by_computed_normals(scene, mesh)) {
        if (!*normals) *normals = zr_vertex_normals_make(run, mesh);
        coloring.computed = *normals;
    }
    if (!zr_arena_ok(run->arena)) return colors;
    if (rate == ZR_RATE_VERTEX)
        zr_team_ranges(run->team, mesh->position_count, points_a_range(&coloring),
                       ZR_FAST(alike_points, are_alike_vertices(&coloring)) ? color_alike : color_vertices, &coloring);
    else
        make_of_faces(run->team, &coloring);
    return colors;
}
