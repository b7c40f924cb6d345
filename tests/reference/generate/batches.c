#include "reference/generate/batches_builder.h"

#include "base/run.h"
#include "geometry/cap_hull.h"
#include "geometry/clip.h"
#include "geometry/face.h"
#include "geometry/place.h"
#include "geometry/triangulate.h"
#include "mesh/crease_normals.h"
#include "mesh/face_normals.h"
#include "mesh/vertex_normals.h"
#include "scene/picture.h"
#include "shade/colors.h"
#include "shade/lights/light.h"

/* ---- what is lit ---- */

static const zr_vec3 no_normal = {0, 0, 0};

/* The surface's own colour; a flat face has that of its first corner. */
static zr_vec4 base_color(const struct batches_source *s, uint32_t slot)
{
    const struct zr_mesh *mesh = s->mesh;
    zr_vec4 color = s->material->base_color;
    if (mesh->face_colors) color = zr_vec4_mul(color, mesh->face_colors[s->face]);
    if (mesh->colors)
        color = zr_vec4_mul(color, mesh->colors[mesh->indices[s->smooth ? slot : mesh->face_offsets[s->face]]]);
    return color;
}

/* The one given, or the mean of the faces around the vertex, or of those within the crease angle. */
static zr_vec3 vertex_normal(const struct batches_source *s, uint32_t slot)
{
    const struct zr_mesh *mesh = s->mesh;
    const uint32_t vertex = mesh->indices[slot];
    zr_vec3 given = no_normal;
    if (mesh->normal_count > 0) given = mesh->normals[mesh->normal_indices ? mesh->normal_indices[slot] : vertex];
    if (given.x != 0.0f || given.y != 0.0f || given.z != 0.0f) return given;
    if (s->creases) return zr_crease_normal_of(s->creases, slot);
    if (!s->computed) return no_normal;
    return (zr_vec3){s->computed[vertex].x, s->computed[vertex].y, s->computed[vertex].z};
}

/* In linear light all but flat surfaces have normals of corners. */
static bool find_creases(struct batches_builder *b, struct batches_source *s)
{
    s->face_normal = no_normal;
    s->has_vertex_normals = s->material->shading != ZR_SHADING_FLAT;
    s->smooth = zr_material_is_smooth(s->mesh, s->material);
    if (!s->has_vertex_normals) s->face_normal = zr_normal_of_face(s->mesh, s->face);
    if (s->has_vertex_normals && !s->creases && zr_mesh_lacks_normals(s->mesh))
        s->creases =
            zr_crease_normals_make(&(struct zr_run){.arena = b->arena}, s->mesh, b->scene->picture->crease_degrees);
    return zr_arena_ok(b->arena);
}

/* Readies s for its face. */
static bool find_normals(struct batches_builder *b, struct batches_source *s)
{
    const enum zr_shading shading = s->material->shading;
    const bool channels = b->options.purpose == BATCHES_CHANNELS;
    if (b->options.purpose == BATCHES_LIGHT) return find_creases(b, s);
    s->face_normal = no_normal;
    const bool wants_any = shading == ZR_SHADING_UNLIT || shading > ZR_SHADING_NORMALS; /* those that are given */
    s->has_vertex_normals = wants_any ? channels && s->mesh->normal_count > 0 : shading >= ZR_SHADING_GOURAUD;
    s->smooth = channels ? s->has_vertex_normals : zr_material_is_smooth(s->mesh, s->material);
    if (b->options.purpose == BATCHES_OWNERS) return true;
    if (!s->has_vertex_normals && (channels || shading == ZR_SHADING_FLAT))
        s->face_normal = zr_normal_of_face(s->mesh, s->face);
    if (s->has_vertex_normals && !s->computed)
        s->computed = zr_vertex_normals_make(&(struct zr_run){.arena = b->arena}, s->mesh);
    return !s->has_vertex_normals || s->computed;
}

/* Corner `slot` of the mesh's indices, in the colours of its face. */
static void append_corner(struct batches_builder *b, const struct batches_source *s, uint32_t slot)
{
    uint32_t vertex = s->mesh->indices[slot];
    if (b->options.purpose == BATCHES_OWNERS) {
        batches_append_vertex(b, s, vertex, batches_owner_color(b->owner + s->face), no_normal);
        return;
    }
    batches_append_vertex(b, s, vertex, base_color(s, slot),
                          s->has_vertex_normals ? vertex_normal(s, slot) : s->face_normal);
}

/* ---- faces ---- */

bool batches_face_is_parity(const struct zr_mesh *mesh, uint32_t face)
{
    if (zr_mesh_face_is_cap(mesh, face)) return true;
    if (mesh->faces_are_fans) return false;
    if (mesh->face_rings && mesh->face_rings[face + 1] - mesh->face_rings[face] > 1) return true;
    return mesh->face_offsets[face + 1] - mesh->face_offsets[face] > 3 && zr_face_is_concave(mesh, face);
}

/* The fan (i - 1, i, 0), as GL_POLYGON has it. */
static void append_fan(struct batches_builder *b, const struct batches_source *s, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin + 2; i < end; i++) {
        append_corner(b, s, i - 1);
        append_corner(b, s, i);
        append_corner(b, s, begin);
    }
}

/* Which side of the whole face is seen: the sign of the volume between the eye and the outer ring, which a
 * corner behind the eye does not turn around. */
static bool shows_back(const struct batches_builder *b, const struct batches_source *s)
{
    const struct zr_mesh *mesh = s->mesh;
    struct zr_rings rings = zr_mesh_rings(mesh, s->face);
    double first[4], last[4], next[4], volume = 0.0;
    const uint32_t *indices = mesh->indices + rings.offsets[0];
    batches_transform(b->camera, &s->instance->object_to_world, mesh->positions[indices[0]], first);
    batches_transform(b->camera, &s->instance->object_to_world, mesh->positions[indices[1]], last);
    for (uint32_t i = 2; i < rings.offsets[1] - rings.offsets[0]; i++) {
        batches_transform(b->camera, &s->instance->object_to_world, mesh->positions[indices[i]], next);
        volume += first[0] * (last[1] * next[3] - next[1] * last[3]) -
                  first[1] * (last[0] * next[3] - next[0] * last[3]) +
                  first[3] * (last[0] * next[1] - next[0] * last[1]);
        for (int k = 0; k < 4; k++)
            last[k] = next[k];
    }
    return volume != 0.0 && (volume < 0.0) != s->mirrored;
}

/* Gives both sides the colours of the one that is seen: single pieces may be turned otherwise. */
static void light_one_side(struct reference_batch *batch, bool back)
{
    if (batch->light != REFERENCE_UNLIT) batch->light = back ? REFERENCE_LIT_BACK : REFERENCE_LIT_FRONT;
}

/* A fan over most of the cap, and the fans of all rings: any triangle of a cap has its plane. */
static bool cut_cap(struct zr_arena *arena, const struct zr_mesh *mesh, const struct zr_rings *rings,
                    struct batches_cut *cut)
{
    const uint32_t begin = rings->offsets[0];
    uint32_t hull[ZR_CAP_HULL_MAX];
    const uint32_t around = zr_cap_hull_find(mesh, rings, hull);
    cut->triangles =
        zr_arena_alloc(arena, rings->offsets[rings->count] - begin + ZR_CAP_HULL_MAX, sizeof *cut->triangles);
    cut->count = 0;
    for (uint32_t i = 2; cut->triangles && i < around; i++, cut->count++) {
        const uint32_t fan[3] = {hull[i - 1] - begin, hull[i] - begin, hull[0] - begin};
        memcpy(cut->triangles[cut->count], fan, sizeof fan);
    }
    for (uint32_t r = 0; cut->triangles && r < rings->count; r++) {
        const uint32_t first = rings->offsets[r] - begin;
        for (uint32_t i = first + 2; i < rings->offsets[r + 1] - begin; i++, cut->count++) {
            const uint32_t fan[3] = {i - 1, i, first};
            memcpy(cut->triangles[cut->count], fan, sizeof fan);
        }
    }
    return cut->triangles != NULL;
}

bool batches_cut_face(struct zr_arena *arena, const struct zr_mesh *mesh, uint32_t face, struct batches_cut *cut)
{
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    struct zr_triangulator triangulator = {.node_capacity = 0};
    uint32_t begin = rings.offsets[0], corners = rings.offsets[rings.count] - begin;
    if (zr_mesh_face_is_cap(mesh, face)) return cut_cap(arena, mesh, &rings, cut);
    zr_vec4 *points = zr_arena_alloc(arena, corners, sizeof *points);
    uint32_t *offsets = zr_arena_alloc(arena, (size_t)rings.count + 1, sizeof *offsets);
    cut->triangles = zr_arena_alloc(arena, zr_triangulate_count_max(corners, rings.count), sizeof *cut->triangles);
    if (!zr_arena_ok(arena) || !zr_triangulator_reserve(arena, &triangulator, corners, rings.count)) return false;
    for (uint32_t i = 0; i < corners; i++)
        points[i] = mesh->positions[mesh->indices[begin + i]];
    for (uint32_t r = 0; r <= rings.count; r++)
        offsets[r] = rings.offsets[r] - begin;
    cut->count = zr_triangulate(&triangulator, points, offsets, rings.count, cut->triangles);
    return true;
}

static void append_thin(struct batches_builder *b, const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                        const struct zr_window_vertex *v2)
{
    struct batches *out = b->out;
    if (!zr_place_is_thin(v0, v1, v2)) return;
    if (out->thin_count == b->thin_room) {
        uint32_t room = b->thin_room * 2 + 64;
        out->thin = zr_arena_grow(b->arena, out->thin, b->thin_room, room, sizeof *out->thin);
        if (!out->thin) return;
        b->thin_room = room;
    }
    const struct zr_window_vertex *v[3] = {v0, v1, v2};
    for (int k = 0; k < 3; k++) {
        out->thin[out->thin_count].x[k] = zr_snapped_x(v[k]);
        out->thin[out->thin_count].y[k] = zr_snapped_y(v[k]);
    }
    out->thin_count++;
}

/* Pieces of a shape's triangle that the core finds too thin to tell a plane. */
static void find_thin(struct batches_builder *b, const struct batches_source *s, const uint32_t slots[3])
{
    struct zr_viewport viewport = zr_viewport_make(b->scene->views[0].width, b->scene->views[0].height);
    zr_mat4 object_to_eye = zr_mat4_mul(&b->camera->world_to_eye, &s->instance->object_to_world);
    zr_mat4 object_to_clip = zr_mat4_mul(&b->camera->projection, &object_to_eye);
    struct zr_clipped clipped;
    zr_vec4 in[3];
    struct zr_window_vertex v[ZR_CLIP_MAX];
    unsigned any = 0;
    for (int k = 0; k < 3; k++) {
        in[k] = zr_mat4_apply(&object_to_clip, s->mesh->positions[s->mesh->indices[slots[k]]]);
        any |= zr_clip_outcode(in[k]);
    }
    int count = zr_clip_triangle(in, any, NULL, &clipped);
    for (int i = 0; i < count; i++)
        if (!zr_viewport_apply(&viewport, clipped.vertices[i].position, &v[i])) return;
    for (int i = 2; i < count; i++)
        append_thin(b, &v[i - 1], &v[i], &v[0]);
}

static bool append_triangles(struct batches_builder *b, const struct batches_source *s)
{
    struct batches_cut cut;
    uint32_t begin = s->mesh->face_offsets[s->face];
    if (!batches_cut_face(b->arena, s->mesh, s->face, &cut) || !batches_reserve_corners(b, 3 * (uint64_t)cut.count))
        return false;
    for (uint32_t i = 0; i < cut.count; i++) {
        const uint32_t *t = cut.triangles[i], slots[3] = {begin + t[0], begin + t[1], begin + t[2]};
        find_thin(b, s, slots);
        for (int k = 0; k < 3; k++)
            append_corner(b, s, slots[k]);
    }
    return true;
}

/* A stencil bit per plane, which has room for three: its opaque caps share no samples. */
static uint8_t claim_of(const struct batches_source *s)
{
    const struct zr_mesh *mesh = s->mesh;
    const uint32_t plane = mesh->cap_planes ? mesh->cap_planes[s->face - (mesh->face_count - mesh->cap_count)] : 3;
    return plane < 3 && s->material->alpha_mode == ZR_ALPHA_OPAQUE ? (uint8_t)(16u << plane) : 0;
}

static bool append_parity(struct batches_builder *b, const struct batches_source *s, struct reference_batch *batch)
{
    struct zr_rings rings = zr_mesh_rings(s->mesh, s->face);
    bool back = shows_back(b, s);
    if (back && batch->cull) return true;
    if (!batches_reserve_corners(b, 3 * (uint64_t)(rings.offsets[rings.count] - rings.offsets[0]))) return false;
    batch->rings_first = b->corner_count;
    for (uint32_t r = 0; r < rings.count; r++)
        append_fan(b, s, rings.offsets[r], rings.offsets[r + 1]);
    batch->rings_count = b->corner_count - batch->rings_first;
    batch->first = b->corner_count;
    if (!append_triangles(b, s)) return false;
    batch->count = b->corner_count - batch->first;
    light_one_side(batch, back);
    batch->mode = REFERENCE_PARITY;
    batch->winding = zr_mesh_face_is_cap(s->mesh, s->face);
    batch->claim = batch->winding ? claim_of(s) : 0;
    batch->cull = false;
    b->out->parity_faces++;
    return batches_append(b, batch);
}

/* A convex polygon as GL_POLYGON would cut it, by parity: it must change nothing. Done wherever a corner is at infinity
 * or behind the eye (w <= 0), where it is easily mistaken what is convex. */
static bool is_fan_by_parity(const struct batches_builder *b, const struct batches_source *s)
{
    uint32_t begin = s->mesh->face_offsets[s->face], end = s->mesh->face_offsets[s->face + 1];
    bool behind = false;
    for (uint32_t slot = begin; slot < end; slot++)
        behind |= !(s->mesh->positions[s->mesh->indices[slot]].w > 0.0f);
    return end - begin > 3 && (behind || b->options.all_parity);
}

static bool append_fan_by_parity(struct batches_builder *b, const struct batches_source *s,
                                 struct reference_batch *batch)
{
    uint32_t begin = s->mesh->face_offsets[s->face], end = s->mesh->face_offsets[s->face + 1];
    if (!batches_reserve_corners(b, 6 * (uint64_t)(end - begin))) return false;
    batch->mode = REFERENCE_PARITY;
    batch->rings_first = b->corner_count;
    append_fan(b, s, begin, end);
    batch->first = b->corner_count;
    batch->rings_count = batch->count = batch->first - batch->rings_first;
    append_fan(b, s, begin, end);
    b->out->parity_faces++;
    return batches_append(b, batch);
}

static bool shows_textures(const struct batches_builder *b, const struct batches_source *s)
{
    if (!s->mesh->texcoords) return false;
    if (b->options.purpose == BATCHES_LIGHT) return zr_material_is_mapped(s->material);
    return b->options.purpose == BATCHES_COLORS && s->material->textures[ZR_TEXTURE_BASE_COLOR] > 0 &&
           s->material->shading != ZR_SHADING_NORMALS;
}

static struct reference_batch state_of(const struct batches_builder *b, const struct batches_source *s)
{
    bool owners = b->options.purpose == BATCHES_OWNERS, light = b->options.purpose == BATCHES_LIGHT;
    bool channels = b->options.purpose == BATCHES_CHANNELS || light;
    bool lit = channels || (s->material->shading != ZR_SHADING_UNLIT && !owners);
    return (struct reference_batch){.modelview = s->modelview,
                                    .to_world = &s->instance->object_to_world,
                                    .instance = (uint32_t)(s->instance - b->scene->instances),
                                    .light = !lit                        ? REFERENCE_UNLIT
                                             : s->material->double_sided ? REFERENCE_LIT
                                                                         : REFERENCE_LIT_FRONT,
                                    .normal_rows = lit ? s->normal_rows : NULL,
                                    .late = lit && s->material->shading > ZR_SHADING_GOURAUD ? s->material : NULL,
                                    .material = light ? s->material : NULL,
                                    .textured = shows_textures(b, s) ? s->material : NULL,
                                    .to_eye = b->options.transformed ? b->clip_to_eye : s->modelview,
                                    .eye = zr_camera_eye(b->camera),
                                    .smooth = s->smooth && !owners,
                                    .cull = !s->material->double_sided,
                                    .mirrored = s->mirrored};
}

static bool append_face(struct batches_builder *b, const struct batches_source *s)
{
    uint32_t begin = s->mesh->face_offsets[s->face], end = s->mesh->face_offsets[s->face + 1];
    struct reference_batch batch = state_of(b, s);
    b->out->triangles += end - begin - 2;
    if (s->material->unfilled) return true;
    batch.depth_offset = s->material->outline != ZR_OUTLINE_NONE;
    if (batches_face_is_parity(s->mesh, s->face)) return append_parity(b, s, &batch);
    if (is_fan_by_parity(b, s)) return append_fan_by_parity(b, s, &batch);
    const bool as_triangles = end - begin == 3 || b->options.purpose >= BATCHES_LIGHT;
    if (!batches_reserve_corners(b, 3 * (uint64_t)(end - begin))) return false;
    batch.mode = as_triangles ? REFERENCE_TRIANGLES : REFERENCE_POLYGON;
    batch.first = b->corner_count;
    if (as_triangles && end - begin > 3)
        append_fan(b, s, begin, end);
    else
        for (uint32_t slot = begin; slot < end; slot++)
            append_corner(b, s, slot);
    batch.count = b->corner_count - batch.first;
    return batches_append(b, &batch);
}

/* ---- outlines ---- */

/* One ring of a face, as a polygon of which only the edges are drawn. */
static bool append_ring(struct batches_builder *b, const struct batches_source *s, uint32_t begin, uint32_t end,
                        bool concave, bool back)
{
    struct reference_batch batch = state_of(b, s);
    bool colored = s->material->outline == ZR_OUTLINE_COLORED && b->options.purpose <= BATCHES_LIGHT &&
                   b->options.purpose != BATCHES_OWNERS;
    if (!batches_reserve_corners(b, end - begin)) return false;
    batch.mode = end - begin == 3 ? REFERENCE_TRIANGLES : REFERENCE_POLYGON;
    batch.outline = true;
    batch.first = b->corner_count;
    batch.count = end - begin;
    for (uint32_t slot = begin; slot < end; slot++)
        if (colored)
            batches_append_vertex(b, s, s->mesh->indices[slot], s->material->outline_color, no_normal);
        else
            append_corner(b, s, slot);
    if (batch.late) batch.light = REFERENCE_UNLIT;
    batch.late = NULL; /* lines are not shaded by normals */
    batch.textured = NULL;
    if (concave) {
        light_one_side(&batch, back);
        batch.cull = false;
    }
    if (colored) {
        batch.light = REFERENCE_UNLIT;
        batch.smooth = false;
    }
    return batches_append(b, &batch);
}

static bool append_outline(struct batches_builder *b, const struct batches_source *s)
{
    struct zr_rings rings = zr_mesh_rings(s->mesh, s->face);
    if (s->material->outline == ZR_OUTLINE_NONE) return true;
    bool concave = batches_face_is_parity(s->mesh, s->face), back = concave && shows_back(b, s);
    if (back && !s->material->double_sided) return true;
    for (uint32_t r = 0; r < rings.count; r++)
        if (!append_ring(b, s, rings.offsets[r], rings.offsets[r + 1], concave, back)) return false;
    return true;
}

/* ---- what is drawn ---- */

static bool is_drawn(const struct batches_builder *b, const struct batches_source *s, enum batches_kind kind,
                     uint32_t number, const struct zr_material *material)
{
    const struct batches_only *only = b->options.only;
    if (!only) return true;
    if (material->alpha_mode != only->mode) return false;
    return !only->one || (only->instance == (uint32_t)(s->instance - b->scene->instances) && only->kind == kind &&
                          only->number == number);
}

/* Lines or points of the mesh. */
static bool
append_wires(struct batches_builder *b, const struct batches_source *s, enum batches_kind kind, uint32_t count,
             bool (*append)(struct batches_builder *b, const struct batches_source *s, uint32_t begin, uint32_t end))
{
    const struct zr_material *material = &b->scene->materials[s->mesh->material];
    if (!b->options.only || !b->options.only->one)
        return append(b, s, 0, is_drawn(b, s, kind, 0, material) ? count : 0);
    for (uint32_t i = 0; i < count; i++)
        if (is_drawn(b, s, kind, i, material) && !append(b, s, i, i + 1)) return false;
    return true;
}

/* ---- instances ---- */

static bool for_each_face(struct batches_builder *b, struct batches_source *s, enum batches_kind kind,
                          bool (*work)(struct batches_builder *b, const struct batches_source *s))
{
    for (s->face = 0; s->face < s->mesh->face_count; s->face++) {
        s->material = zr_material_of_face(b->scene, s->mesh, s->face);
        if (!is_drawn(b, s, kind, s->face, s->material)) continue;
        if (!find_normals(b, s) || !work(b, s)) return false;
    }
    return true;
}

/* The matrices of an instance, for GL: in memory of their own, since batches point to them. */
struct placement {
    zr_mat4 modelview, object_to_eye;
    struct zr_normal_matrix normals;
};

static bool append_instance(struct batches_builder *b, const struct zr_instance *instance)
{
    const struct zr_mesh *mesh = &b->scene->meshes[instance->mesh];
    struct placement *placement = zr_arena_alloc(b->arena, 1, sizeof *placement);
    if (!placement) return false;
    zr_mat4 object_to_eye = zr_mat4_mul(&b->camera->world_to_eye, &instance->object_to_world);
    placement->modelview = b->options.transformed ? zr_mat4_identity() : object_to_eye;
    placement->object_to_eye = object_to_eye;
    placement->normals = zr_normal_matrix_make(&object_to_eye);
    struct batches_source source = {.mesh = mesh,
                                    .instance = instance,
                                    .modelview = &placement->modelview,
                                    .normal_rows = placement->normals.rows,
                                    .object_to_eye = &placement->object_to_eye,
                                    .mirrored = zr_camera_reverses_windings(b->camera, &instance->object_to_world)};
    if (b->owner + zr_mesh_ids(mesh) > (uint64_t)BATCHES_OWNERS_MAX + 1) return false;
    if (!for_each_face(b, &source, BATCHES_FACE, append_face) ||
        !for_each_face(b, &source, BATCHES_OUTLINE, append_outline))
        return false;
    if (!append_wires(b, &source, BATCHES_LINE, mesh->line_count, batches_append_lines) ||
        !append_wires(b, &source, BATCHES_POINT, mesh->point_count, batches_append_points))
        return false;
    b->owner += (uint32_t)zr_mesh_ids(mesh);
    return true;
}

/* Whole pixels, half up, and at least one. */
static float line_width_of(const struct zr_picture *picture)
{
    const float whole = floorf(picture->line_width + 0.5f);
    return whole > 1.0f ? whole : 1.0f;
}

bool batches_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                  const struct batches_options *options, struct batches *batches)
{
    *batches = (struct batches){.triangles = 0};
    struct batches_builder builder = {
        .arena = arena, .scene = scene, .camera = camera, .options = *options, .out = batches, .owner = 1};
    builder.clip_to_eye = zr_arena_alloc(arena, 1, sizeof *builder.clip_to_eye);
    if (!builder.clip_to_eye) return false;
    if (!zr_mat4_invert(&camera->projection, builder.clip_to_eye)) *builder.clip_to_eye = zr_mat4_identity();
    for (uint32_t i = 0; i < scene->instance_count; i++)
        if (!append_instance(&builder, &scene->instances[i])) return false;
    struct reference_arrays *arrays = &batches->arrays;
    arrays->positions = builder.positions;
    arrays->front = builder.front;
    if (options->purpose != BATCHES_OWNERS) arrays->normals = builder.normals;
    arrays->unit_normals = builder.unit_normals;
    arrays->light_points = builder.light_points;
    if (options->purpose == BATCHES_COLORS) {
        arrays->lighting = batches_light(arena, scene, camera, options);
        if (!arrays->lighting) return false;
    }
    arrays->batches = builder.batches;
    if (options->purpose == BATCHES_COLORS) arrays->fog = scene->fog;
    if (options->purpose == BATCHES_CHANNELS) arrays->texcoords = builder.texcoords;
    if (scene->texture_count > 0 && (options->purpose == BATCHES_COLORS || options->purpose == BATCHES_LIGHT)) {
        arrays->texcoords = builder.texcoords;
        arrays->tangents = builder.tangents;
        arrays->textures_of = scene;
        arrays->decode = options->purpose == BATCHES_LIGHT;
    }
    arrays->line_width = line_width_of(scene->picture);
    arrays->projection = options->transformed ? zr_mat4_identity() : camera->projection;
    arrays->background = (zr_vec4){0, 0, 0, options->purpose == BATCHES_LIGHT ? 0 : 1};
    if (options->purpose == BATCHES_COLORS) arrays->background = scene->background;
    return true;
}
