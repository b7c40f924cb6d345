#include "shade/draw_attributes.h"

#include <string.h>

#include "base/fast.h"
#include "base/run.h"
#include "mesh/mesh_tables.h"
#include "scene/camera/camera.h"
#include "shade/colors.h"
#include "shade/texcoords.h"

struct making {
    const struct zr_run *run;
    const struct zr_scene *scene;
    const struct zr_geometry *geometry;
    struct zr_scene_attributes *out;
    const struct zr_attribute_wants *wants;
    bool colors, backs;             /* wanted; backs: in colours of their own */
    bool any_see_through;           /* some material is masked or blended: colours must be floats */
    const zr_vec4 **vertex_normals; /* per mesh; NULL: not needed so far */

    /* the current instance */
    const struct zr_source_instance *instance;
    const struct zr_mesh *mesh;
    uint32_t made;               /* number of clipped vertices */
    uint32_t cut_begin, cut_end; /* range of their cuts */
    bool has_colors;
    struct zr_colors mesh_colors;
    const zr_vec4 *line_colors;
    const zr_vec4 *points, *normals[ZR_RATE_CORNER + 1]; /* arrays; NULL: not made */
    const struct zr_eye_vectors *loaded_points;          /* instead of arrays */
    const struct zr_eye_vectors *cloud_points;
    const struct zr_eye_normals *loaded_normals[ZR_RATE_CORNER + 1];
    const zr_vec4 *texcoords; /* transformed by texcoords_of; that NULL: as in the mesh */
    const struct zr_texture *texcoords_of;
    unsigned repeat;         /* of `texcoords` */
    bool is_far;             /* the mesh's coordinates */
    const zr_vec4 *tangents; /* in eye space; NULL: not made */
};

/* ---- clipped vertices ---- */

/* Returns the number of the instance's values, with those of clipped vertices. */
static size_t count_with_made(const struct making *m, enum zr_rate rate, uint32_t own)
{
    return (size_t)own + (zr_rate_is_flat(rate) ? 0 : m->made);
}

/* Returns true if the request is cancelled; looks at it every 4096 cuts, which take less than a millisecond. */
static bool is_stopped(const struct making *m, uint32_t cut)
{
    return cut % 4096 == 0 && zr_is_cancelled(m->run->cancel);
}

/* Writes the values of clipped vertices behind the instance's `own` ones. */
static void extend(const struct making *m, enum zr_rate rate, uint32_t own, zr_vec4 *values)
{
    if (zr_rate_is_flat(rate)) return;
    const uint32_t first = m->instance->first_vertex + m->mesh->position_count;
    for (uint32_t i = m->cut_begin; i < m->cut_end && !is_stopped(m, i); i++) {
        const struct zr_cut *cut = &m->geometry->cuts[i];
        zr_cut_values(cut, values, rate == ZR_RATE_VERTEX ? cut->corners : cut->slots,
                      values + own + (cut->first_vertex - first));
    }
}

static void begin_instance(struct making *m, uint32_t number)
{
    const struct zr_geometry *g = m->geometry;
    const bool is_last = number + 1 == m->scene->instance_count;
    const uint32_t end = is_last ? g->vertex_count : g->instances[number + 1].first_vertex;
    uint32_t cut = m->cut_end;
    m->instance = &g->instances[number];
    m->mesh = m->instance->mesh;
    while (cut < g->cut_count && g->cuts[cut].first_vertex < m->instance->first_vertex)
        cut++;
    m->cut_begin = cut;
    while (cut < g->cut_count && g->cuts[cut].first_vertex < end)
        cut++;
    m->cut_end = cut;
    m->made = end - m->instance->first_vertex - m->instance->vertex_count;
    m->has_colors = false;
    m->loaded_points = m->cloud_points = NULL;
    m->line_colors = m->points = m->texcoords = m->tangents = NULL;
    memset(m->normals, 0, sizeof m->normals);
    memset(m->loaded_normals, 0, sizeof m->loaded_normals);
}

/* ---- colours ---- */

/* Copies the mesh's own colours if clipped vertices need room behind them. */
static bool copy_given(struct making *m)
{
    struct zr_colors *colors = &m->mesh_colors;
    if (zr_rate_is_flat(colors->rate) || m->made == 0) return true;
    zr_vec4 *copy = zr_arena_alloc(m->run->arena, count_with_made(m, colors->rate, colors->count), sizeof *copy);
    if (!copy) return false;
    memcpy(copy, colors->front, colors->count * sizeof *copy);
    extend(m, colors->rate, colors->count, copy);
    colors->front = colors->back = copy;
    return true;
}

static bool make_packed(struct making *m)
{
    const size_t count = (size_t)m->mesh->face_count << m->backs;
    uint32_t *packed = zr_arena_alloc(m->run->arena, count, sizeof *packed);
    if (!packed) return false;
    m->mesh_colors =
        zr_colors_make_packed(m->run, m->scene, m->mesh, &m->out->lighting, &m->instance->to_eye, m->backs, packed);
    return true;
}

static bool make_floats(struct making *m)
{
    const enum zr_rate rate = zr_colors_rate(m->scene, m->mesh);
    const uint32_t own = zr_colors_count(m->scene, m->mesh);
    const size_t count = count_with_made(m, rate, own);
    zr_vec4 *front = zr_arena_alloc(m->run->arena, count, sizeof *front);
    zr_vec4 *back = m->backs ? zr_arena_alloc(m->run->arena, count, sizeof *back) : front;
    if (!zr_arena_ok(m->run->arena)) return false;
    m->mesh_colors = zr_colors_make(m->run, m->scene, m->mesh, &m->out->lighting, &m->instance->to_eye,
                                    &m->vertex_normals[m->mesh - m->scene->meshes], front, back);
    if (!zr_arena_ok(m->run->arena)) return false;
    extend(m, rate, own, front);
    if (back != front) extend(m, rate, own, back);
    return true;
}

/* Finds the mesh's own colours if they serve, or makes them for this instance. */
static bool find_mesh_colors(struct making *m)
{
    if (m->has_colors) return true;
    m->has_colors = true;
    if (ZR_FAST(given_colors, zr_colors_are_given(m->scene, m->mesh, &m->mesh_colors))) return copy_given(m);
    return ZR_FAST(packed_colors, !m->out->fog.is_on && !m->wants->samples && !m->any_see_through &&
                                      !m->out->any_textured && zr_colors_can_be_packed(m->scene, m->mesh))
               ? make_packed(m)
               : make_floats(m);
}

/* Makes the vertex colours times the material's. */
static bool find_line_colors(struct making *m)
{
    const struct zr_mesh *mesh = m->mesh;
    const zr_vec4 base = m->scene->materials[mesh->material].base_color;
    if (m->line_colors) return true;
    zr_vec4 *colors =
        zr_arena_alloc(m->run->arena, count_with_made(m, ZR_RATE_VERTEX, mesh->position_count), sizeof *colors);
    if (!colors) return false;
    for (uint32_t i = 0; i < mesh->position_count; i++)
        colors[i] = zr_vec4_mul(base, mesh->colors[i]);
    extend(m, ZR_RATE_VERTEX, mesh->position_count, colors);
    m->line_colors = colors;
    return true;
}

/* Gives a cloud the mesh's own colours (cloud_values.h). */
static void color_cloud(const struct zr_draw *draw, struct zr_draw_attributes *of_draw)
{
    const zr_vec4 *colors = draw->mesh->colors;
    of_draw->attributes[ZR_ATTRIBUTE_COLOR] = colors ? (struct zr_attribute){ZR_RATE_VERTEX, colors}
                                                     : (struct zr_attribute){ZR_RATE_DRAW, &draw->material->base_color};
    of_draw->color_count = 1;
}

static bool color_lines(struct making *m, const struct zr_draw *draw, struct zr_draw_attributes *of_draw)
{
    struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    if (m->mesh->colors) {
        if (!find_line_colors(m)) return false;
        *color = (struct zr_attribute){ZR_RATE_VERTEX, m->line_colors};
    } else {
        *color = (struct zr_attribute){ZR_RATE_DRAW, &draw->material->base_color};
    }
    of_draw->color_count = 1;
    return true;
}

static bool color_faces(struct making *m, const struct zr_draw *draw, struct zr_draw_attributes *of_draw)
{
    struct zr_attribute *attributes = of_draw->attributes;
    const struct zr_colors *colors = &m->mesh_colors;
    if (m->wants->samples && !m->mesh->colors && !m->mesh->face_colors) {
        attributes[ZR_ATTRIBUTE_COLOR] = (struct zr_attribute){ZR_RATE_DRAW, &draw->material->base_color};
        of_draw->color_count = 1;
        return true;
    }
    if (!find_mesh_colors(m)) return false;
    enum zr_rate rate = colors->rate;
    if (rate == ZR_RATE_CORNER && !zr_material_is_smooth(m->mesh, draw->material)) rate = ZR_RATE_FIRST_CORNER;
    attributes[ZR_ATTRIBUTE_COLOR] = (struct zr_attribute){rate, colors->front};
    of_draw->packed = colors->packed;
    of_draw->color_count = colors->count;
    of_draw->two_sided_colors = colors->two_sided_colors && draw->material->double_sided;
    if (of_draw->two_sided_colors) attributes[ZR_ATTRIBUTE_BACK_COLOR] = (struct zr_attribute){rate, colors->back};
    return true;
}

static bool color(struct making *m, const struct zr_draw *draw, struct zr_draw_attributes *of_draw)
{
    if (zr_draw_is_cloud(draw)) {
        color_cloud(draw, of_draw);
        return true;
    }
    if (draw->kind == ZR_DRAW_LINES || draw->kind == ZR_DRAW_POINTS) return color_lines(m, draw, of_draw);
    if (draw->kind != ZR_DRAW_OUTLINES || draw->material->outline != ZR_OUTLINE_COLORED)
        return color_faces(m, draw, of_draw);
    of_draw->attributes[ZR_ATTRIBUTE_COLOR] = (struct zr_attribute){ZR_RATE_DRAW, &draw->material->outline_color};
    of_draw->color_count = 1;
    return true;
}

/* ---- normals and points ---- */

/* Writes the values of `count` numbers to out[]. */
typedef void put_fn(const struct making *m, const void *from, const uint32_t *numbers, uint32_t count, zr_vec4 *out);

static bool are_loaded(const struct making *m)
{
    return m->geometry->vertex_count >= ZR_LOADED_VERTICES && m->mesh->position_count >= ZR_LOADED_MESH;
}

/* Makes the values of clipped vertices alone. `put` writes those of three numbers of `from`. */
static const zr_vec4 *make_cut(const struct making *m, enum zr_rate rate, put_fn *put, const void *from)
{
    static const uint32_t own[3] = {0, 1, 2};
    if (m->made == 0 || zr_rate_is_flat(rate)) return NULL;
    const uint32_t first = m->instance->first_vertex + m->mesh->position_count;
    zr_vec4 *values = zr_arena_alloc(m->run->arena, m->made, sizeof *values);
    for (uint32_t i = m->cut_begin; values && i < m->cut_end && !is_stopped(m, i); i++) {
        const struct zr_cut *cut = &m->geometry->cuts[i];
        zr_vec4 corners[3];
        put(m, from, rate == ZR_RATE_VERTEX ? cut->corners : cut->slots, cut->corner_count, corners);
        zr_cut_values(cut, corners, own, values + (cut->first_vertex - first));
    }
    return values;
}

static void put_normals(const struct making *m, const void *from, const uint32_t *numbers, uint32_t count, zr_vec4 *out)
{
    zr_eye_normals_of(m->run, from, numbers, count, out);
}

/* Makes the normals of the mesh for the instance: an array, or their input. */
static bool make_normals(struct making *m, struct zr_eye_normals *from)
{
    const enum zr_rate rate = from->rate;
    if (are_loaded(m) && zr_eye_normals_are_single(from)) {
        from->cut = make_cut(m, rate, put_normals, from);
        m->loaded_normals[rate] = zr_arena_copy(m->run->arena, from, sizeof *from);
    } else {
        zr_vec4 *made = zr_arena_alloc(m->run->arena, count_with_made(m, rate, from->count), sizeof *made);
        if (!made) return false;
        zr_eye_normals_make(m->run, from, made);
        extend(m, rate, from->count, made);
        m->normals[rate] = made;
    }
    return zr_arena_ok(m->run->arena);
}

static bool find_normals(struct making *m, const struct zr_draw *draw, struct zr_draw_attributes *of_draw)
{
    const size_t number = (size_t)(m->mesh - m->scene->meshes);
    const struct zr_crease_normals *crease =
        m->wants->samples && m->wants->crease_normals ? m->wants->crease_normals[number] : NULL;
    const enum zr_rate rate = zr_eye_normals_rate(m->mesh, draw->material, crease != NULL);
    struct zr_eye_normals from;
    if (!m->normals[rate] && !m->loaded_normals[rate] &&
        (!zr_eye_normals_find(m->run, m->mesh, &m->instance->to_eye, rate, crease, &m->vertex_normals[number], &from) ||
         !make_normals(m, &from)))
        return false;
    of_draw->normals = m->loaded_normals[rate];
    of_draw->attributes[ZR_ATTRIBUTE_NORMAL] = (struct zr_attribute){rate, m->normals[rate]};
    return true;
}

static void put_points(const struct making *m, const void *from, const uint32_t *numbers, uint32_t count, zr_vec4 *out)
{
    (void)m;
    for (uint32_t k = 0; k < count; k++)
        out[k] = zr_eye_vector(from, numbers[k]);
}

static struct zr_eye_vectors points_of(const struct making *m)
{
    return (struct zr_eye_vectors){.positions = m->mesh->positions,
                                   .count = m->mesh->position_count,
                                   .to_eye = m->instance->to_eye,
                                   .eye = m->out->eye};
}

/* Points of clouds are made for visible ones alone. */
static bool find_cloud_points(struct making *m, struct zr_draw_attributes *of_draw)
{
    const struct zr_eye_vectors from = points_of(m);
    if (!m->cloud_points) m->cloud_points = zr_arena_copy(m->run->arena, &from, sizeof from);
    of_draw->points = m->cloud_points;
    return m->cloud_points != NULL;
}

/* Makes the points of the instance: an array, or their input. */
static bool make_points(struct making *m)
{
    const uint32_t own = m->mesh->position_count;
    struct zr_eye_vectors from = points_of(m);
    if (are_loaded(m)) {
        from.cut = make_cut(m, ZR_RATE_VERTEX, put_points, &from);
        m->loaded_points = zr_arena_copy(m->run->arena, &from, sizeof from);
    } else {
        zr_vec4 *made = zr_arena_alloc(m->run->arena, count_with_made(m, ZR_RATE_VERTEX, own), sizeof *made);
        if (!made) return false;
        zr_eye_vectors_make(m->run, &from, made);
        extend(m, ZR_RATE_VERTEX, own, made);
        m->points = made;
    }
    return zr_arena_ok(m->run->arena);
}

static bool find_points(struct making *m, const struct zr_draw *draw, struct zr_draw_attributes *of_draw)
{
    if (zr_draw_is_cloud(draw)) return find_cloud_points(m, of_draw);
    if (!m->points && !m->loaded_points && !make_points(m)) return false;
    of_draw->points = m->loaded_points;
    of_draw->attributes[ZR_ATTRIBUTE_POINT] = (struct zr_attribute){ZR_RATE_VERTEX, m->points};
    return true;
}

/* ---- textures ---- */

static bool is_textured(const struct making *m, const struct zr_draw *draw)
{
    return m->colors && m->out->textures.of && !zr_draw_is_of_wires(draw) && draw->mesh->texcoords &&
           (m->wants->samples ? zr_material_is_mapped(draw->material)
                              : draw->material->textures[ZR_TEXTURE_BASE_COLOR] > 0);
}

static bool find_texcoords(struct making *m, const struct zr_draw *draw, struct zr_attribute *out)
{
    const uint32_t own = m->mesh->position_count, base = draw->material->textures[ZR_TEXTURE_BASE_COLOR];
    const struct zr_texture *texture = m->wants->samples ? NULL : &m->scene->textures[base - 1];
    if (!m->texcoords) m->is_far = m->wants->samples && zr_texcoords_are_far(m->mesh);
    const unsigned repeat = m->is_far ? zr_texcoords_repeat(m->scene, draw->material) : 0;
    if (!m->texcoords || m->texcoords_of != texture || m->repeat != repeat) {
        zr_vec4 *made = zr_arena_alloc(m->run->arena, count_with_made(m, ZR_RATE_VERTEX, own), sizeof *made);
        if (!made) return false;
        zr_texcoords_put(m->mesh, texture, repeat, made);
        extend(m, ZR_RATE_VERTEX, own, made);
        m->texcoords = made;
        m->texcoords_of = texture;
        m->repeat = repeat;
    }
    *out = (struct zr_attribute){ZR_RATE_VERTEX, m->texcoords};
    return true;
}

/* Writes tangents in eye space. Mirroring flips the bitangent's sign. */
static void put_tangents(const struct zr_mesh *mesh, const zr_mat4 *to_eye, zr_vec4 *out)
{
    const float turn = zr_mat4_is_mirror(to_eye) ? -1.0f : 1.0f;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        const zr_vec4 given = mesh->tangents[i];
        const zr_vec4 t = zr_mat4_apply(to_eye, (zr_vec4){given.x, given.y, given.z, 0.0f});
        out[i] = (zr_vec4){t.x, t.y, t.z, given.w < 0.0f ? -turn : turn};
    }
}

static bool find_tangents(struct making *m, struct zr_attribute *out)
{
    const uint32_t own = m->mesh->position_count;
    if (!m->mesh->tangents) return true;
    if (!m->tangents) {
        zr_vec4 *made = zr_arena_alloc(m->run->arena, count_with_made(m, ZR_RATE_VERTEX, own), sizeof *made);
        if (!made) return false;
        put_tangents(m->mesh, &m->instance->to_eye, made);
        extend(m, ZR_RATE_VERTEX, own, made);
        m->tangents = made;
    }
    *out = (struct zr_attribute){ZR_RATE_VERTEX, m->tangents};
    return true;
}

/* ---- all ---- */

static bool make_of_draw(struct making *m, const struct zr_draw *draw, struct zr_draw_attributes *of_draw)
{
    of_draw->draw = draw;
    of_draw->material = (uint32_t)(draw->material - m->scene->materials);
    of_draw->eye = m->out->eye;
    if (m->colors && !color(m, draw, of_draw)) return false;
    const bool of_wires = zr_draw_is_of_wires(draw);
    const bool by_normals = m->colors && !of_wires && zr_material_is_per_pixel(draw->material);
    const bool textured = is_textured(m, draw);
    of_draw->is_per_pixel = by_normals || textured || (m->colors && m->out->fog.is_on);
    if (textured && !find_texcoords(m, draw, &of_draw->attributes[ZR_ATTRIBUTE_TEXCOORD])) return false;
    if (textured && m->wants->samples && zr_material_has_tangents(draw->material) &&
        !find_tangents(m, &of_draw->attributes[ZR_ATTRIBUTE_TANGENT]))
        return false;
    if ((of_draw->is_per_pixel || m->wants->samples) && !find_points(m, draw, of_draw)) return false;
    return of_wires || !(by_normals || m->wants->normals || m->wants->samples) || find_normals(m, draw, of_draw);
}

static void look_at_scene(struct making *m)
{
    if (m->wants->colors) m->out->fog = m->scene->fog;
    if (m->colors) m->out->textures = m->wants->textures;
    m->out->texcoords_as_given = m->wants->samples;
    m->out->any_per_pixel = m->out->fog.is_on;
    for (uint32_t i = 0; m->wants->colors && i < m->scene->material_count; i++) {
        const struct zr_material *material = &m->scene->materials[i];
        m->out->any_textured |= m->out->textures.of && material->textures[ZR_TEXTURE_BASE_COLOR] > 0;
        m->out->any_per_pixel |= zr_material_is_per_pixel(material) || m->out->any_textured;
        m->backs |= material->double_sided && zr_material_is_lit_before(material);
    }
}

/* Masked surfaces always need their colours: alpha decides coverage. */
static struct zr_attribute_wants with_masks(const struct zr_scene *scene, const struct zr_attribute_wants *wants,
                                            bool *any_see_through)
{
    struct zr_attribute_wants out = *wants;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const enum zr_alpha_mode mode = scene->materials[i].alpha_mode;
        *any_see_through |= mode != ZR_ALPHA_OPAQUE;
        out.colors |= mode == ZR_ALPHA_MASK && !wants->samples;
    }
    return out;
}

enum zr_status zr_scene_attributes_make(const struct zr_run *run, const struct zr_scene *scene,
                                        const struct zr_camera *camera, const struct zr_geometry *geometry,
                                        const struct zr_attribute_wants *wants, struct zr_scene_attributes *attributes)
{
    struct making m = {.run = run,
                       .scene = scene,
                       .geometry = geometry,
                       .out = attributes,
                       .vertex_normals = zr_arena_zero(run->arena, scene->mesh_count, sizeof *m.vertex_normals)};
    const struct zr_attribute_wants all = with_masks(scene, wants, &m.any_see_through);
    for (uint32_t i = 0; m.vertex_normals && scene->tables && i < scene->mesh_count; i++)
        m.vertex_normals[i] = zr_mesh_table_normals(scene->tables, scene, i);
    m.wants = &all;
    m.colors = all.colors || all.samples;
    *attributes = (struct zr_scene_attributes){.eye = zr_camera_eye(camera)};
    attributes->of_draw = zr_arena_zero(run->arena, (size_t)geometry->draw_count + 1, sizeof *attributes->of_draw);
    if (wants->samples)
        attributes->lighting.is_per_pixel = true;
    else
        attributes->lighting = zr_lights_make(run->arena, scene, camera);
    look_at_scene(&m);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < geometry->draw_count; i++) {
        const struct zr_draw *draw = &geometry->draws[i];
        if (m.instance != &geometry->instances[draw->instance]) begin_instance(&m, draw->instance);
        if (!make_of_draw(&m, draw, &attributes->of_draw[i])) return ZR_NO_MEMORY;
        if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    }
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}
