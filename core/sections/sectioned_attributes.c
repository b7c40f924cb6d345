#include "sections/sectioned_attributes.h"

/* ---- positions ---- */

static zr_vec4 blend(zr_vec4 a, zr_vec4 b, double t)
{
    const double s = 1.0 - t;
    return (zr_vec4){(float)(s * (double)a.x + t * (double)b.x), (float)(s * (double)a.y + t * (double)b.y),
                     (float)(s * (double)a.z + t * (double)b.z), (float)(s * (double)a.w + t * (double)b.w)};
}

/* Extends values of positions to those of made corners and of the ends of lines. Corners of caps get `cap`. */
static zr_vec4 *extend(const struct zr_sectioning *m, const zr_vec4 *values, zr_vec4 cap)
{
    const uint32_t old = m->mesh->position_count, made = m->slices.corner_count - m->slices.slot_count;
    if (!values) return NULL;
    zr_vec4 *out = zr_arena_alloc(m->arena, (size_t)old + made + m->wires.end_count, sizeof *out);
    if (!out) return NULL;
    memcpy(out, values, old * sizeof *out);
    for (uint32_t i = 0; i < made && !zr_sectioning_stops(m, i); i++) {
        const struct zr_slice_corner *c = &m->slices.made[i];
        out[old + i] = c->a == ZR_SLICE_NONE
                           ? cap
                           : blend(out[zr_sectioning_position(m, c->a)], out[zr_sectioning_position(m, c->b)], c->t);
    }
    for (uint32_t i = 0; i < m->wires.end_count; i++) {
        const struct zr_mesh_blend *end = &m->wires.ends[i];
        out[old + made + i] = blend(values[end->a], values[end->b], end->t);
    }
    return out;
}

static const zr_vec4 *extend_positions(const struct zr_sectioning *m)
{
    const uint32_t old = m->mesh->position_count, made = m->slices.corner_count - m->slices.slot_count;
    zr_vec4 *out = zr_arena_alloc(m->arena, (size_t)old + made + m->wires.end_count, sizeof *out);
    if (!out) return NULL;
    memcpy(out, m->mesh->positions, old * sizeof *out);
    for (uint32_t i = 0; i < made && !zr_sectioning_stops(m, i); i++) {
        const zr_vec3 p = m->slices.points[m->slices.made[i].vertex];
        out[old + i] = (zr_vec4){p.x, p.y, p.z, 1.0f};
    }
    for (uint32_t i = 0; i < m->wires.end_count; i++) {
        const struct zr_mesh_blend *end = &m->wires.ends[i];
        const zr_vec3 a = zr_vec4_over_w(out[end->a]), b = zr_vec4_over_w(out[end->b]);
        out[old + made + i] = blend((zr_vec4){a.x, a.y, a.z, 1.0f}, (zr_vec4){b.x, b.y, b.z, 1.0f}, end->t);
    }
    return out;
}

static zr_vec3 normal_between(zr_vec3 a, zr_vec3 b, double t)
{
    const zr_vec3 ua = zr_vec3_normalize(a), ub = zr_vec3_normalize(b);
    if (zr_normal_is_zero(a) || zr_normal_is_zero(b)) return (zr_vec3){0, 0, 0};
    const zr_vec4 sum = blend((zr_vec4){ua.x, ua.y, ua.z, 0}, (zr_vec4){ub.x, ub.y, ub.z, 0}, t);
    return (zr_vec3){sum.x, sum.y, sum.z};
}

static zr_vec3 outward(const struct zr_slice_plane *plane)
{
    return zr_vec3_normalize((zr_vec3){(float)-plane->normal[0], (float)-plane->normal[1], (float)-plane->normal[2]});
}

/* Gives caps the normals of their planes. Other corners keep theirs, and made ones get interpolated normals, or (0, 0,
 * 0) if they are computed. In the new list of normals: one per plane, then the zero one or those of the mesh, then
 * those of made corners. */
static bool make_normals(const struct zr_sectioning *m, struct zr_mesh *out)
{
    const struct zr_mesh *mesh = m->mesh;
    const uint32_t planes = m->cut->plane_count, first_made = m->slices.slot_count;
    const uint32_t made = mesh->normal_count > 0 ? m->slices.corner_count - first_made : 0;
    const uint32_t given = mesh->normal_count > 0 ? mesh->normal_count : 1;
    zr_vec3 *normals = zr_arena_alloc(m->arena, (size_t)planes + given + made, sizeof *normals);
    uint32_t *indices = zr_arena_alloc(m->arena, m->corner_count, sizeof *indices);
    if (!normals || !indices) return false;
    for (uint32_t k = 0; k < planes; k++)
        normals[k] = outward(&m->cut->planes[k]);
    normals[planes] = (zr_vec3){0, 0, 0};
    if (mesh->normal_count > 0) memcpy(normals + planes, mesh->normals, given * sizeof *normals);
#define INDEX(corner)                                                                                                  \
    (planes + ((corner) >= first_made ? given + ((corner)-first_made)                                                  \
                                      : (mesh->normal_indices ? mesh->normal_indices : mesh->indices)[corner]))
    for (uint32_t i = 0; i < made && !zr_sectioning_stops(m, i); i++) {
        const struct zr_slice_corner *c = &m->slices.made[i];
        normals[planes + given + i] = c->a == ZR_SLICE_NONE
                                          ? (zr_vec3){0, 0, 0}
                                          : normal_between(normals[INDEX(c->a)], normals[INDEX(c->b)], c->t);
    }
    const uint32_t first_cap = m->offsets[out->face_count - out->cap_count];
    for (uint32_t i = 0; i < first_cap && !zr_sectioning_stops(m, i); i++)
        indices[i] = mesh->normal_count > 0 ? INDEX(m->corners[i]) : planes;
#undef INDEX
    for (uint32_t face = out->face_count - out->cap_count; face < out->face_count; face++)
        for (uint32_t i = m->offsets[face]; i < m->offsets[face + 1]; i++)
            indices[i] = m->slices.caps[m->cap_numbers[face]].plane;
    out->normal_count = planes + given + made;
    out->normals = normals;
    out->normal_indices = indices;
    return true;
}

/* Returns the face of the whole mesh whose properties a face has. */
static uint32_t face_of(const struct zr_sectioning *m, uint32_t face)
{
    const uint32_t number = m->numbers[face];
    return number < m->mesh->face_count ? number : m->slices.caps[number - m->mesh->face_count].face;
}

static const uint32_t *pick(const struct zr_sectioning *m, const uint32_t *values)
{
    if (!values) return NULL;
    uint32_t *out = zr_arena_alloc(m->arena, m->face_count, sizeof *out);
    for (uint32_t face = 0; out && face < m->face_count && !zr_sectioning_stops(m, face); face++)
        out[face] = values[face_of(m, face)];
    return out;
}

static const zr_vec4 *pick_colors(const struct zr_sectioning *m)
{
    if (!m->mesh->face_colors) return NULL;
    zr_vec4 *out = zr_arena_alloc(m->arena, m->face_count, sizeof *out);
    for (uint32_t face = 0; out && face < m->face_count && !zr_sectioning_stops(m, face); face++)
        out[face] = m->mesh->face_colors[face_of(m, face)];
    return out;
}

static const struct zr_mesh_source *make_source(const struct zr_sectioning *m)
{
    const uint32_t made = m->slices.corner_count - m->slices.slot_count;
    struct zr_mesh_source *source = zr_arena_alloc(m->arena, 1, sizeof *source);
    struct zr_mesh_blend *blends = zr_arena_alloc(m->arena, made, sizeof *blends);
    if (!source || !blends) return NULL;
    for (uint32_t i = 0; i < made; i++)
        blends[i] = (struct zr_mesh_blend){m->slices.made[i].a, m->slices.made[i].b, m->slices.made[i].t};
    *source = (struct zr_mesh_source){m->mesh, made, blends, m->corners, m->mesh->position_count};
    return source;
}

/* Gives each cap the mean colour of the corners of a face that it touches. */
static const zr_vec4 *color_caps(const struct zr_sectioning *m, const struct zr_mesh *out, zr_vec4 *colors)
{
    const struct zr_mesh *mesh = m->mesh;
    if (!colors) return NULL;
    for (uint32_t face = out->face_count - out->cap_count; face < out->face_count; face++) {
        const uint32_t from = face_of(m, face), begin = mesh->face_offsets[from], end = mesh->face_offsets[from + 1];
        zr_vec4 mean = {0, 0, 0, 0};
        for (uint32_t i = begin; i < end; i++) {
            const zr_vec4 *c = &mesh->colors[mesh->indices[i]];
            mean = (zr_vec4){mean.x + c->x, mean.y + c->y, mean.z + c->z, mean.w + c->w};
        }
        const float count = (float)(end - begin);
        mean = (zr_vec4){mean.x / count, mean.y / count, mean.z / count, mean.w / count};
        for (uint32_t i = m->offsets[face]; i < m->offsets[face + 1]; i++)
            colors[m->indices[i]] = mean;
    }
    return colors;
}

/* ---- all attributes ---- */

bool zr_sectioned_attributes_make(const struct zr_sectioning *m, struct zr_mesh *mesh)
{
    mesh->positions = extend_positions(m);
    mesh->texcoords = extend(m, m->mesh->texcoords, (zr_vec4){0, 0, 0, 0});
    mesh->tangents = extend(m, m->mesh->tangents, (zr_vec4){0, 0, 0, 1});
    mesh->colors = color_caps(m, mesh, extend(m, m->mesh->colors, (zr_vec4){1, 1, 1, 1}));
    mesh->face_offsets = m->offsets;
    mesh->indices = m->indices;
    mesh->faces_are_fans = false;
    mesh->face_rings = m->ring_count > m->face_count ? m->face_rings : NULL;
    mesh->ring_offsets = m->ring_count > m->face_count ? m->ring_offsets : NULL;
    mesh->face_groups = pick(m, m->mesh->face_groups);
    mesh->face_materials = pick(m, m->mesh->face_materials);
    mesh->face_parts = pick(m, m->mesh->face_parts);
    mesh->face_colors = pick_colors(m);
    if (!make_normals(m, mesh)) return false;
    mesh->source = make_source(m);
    return zr_arena_ok(m->arena);
}
