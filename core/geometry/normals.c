#include "geometry/normals.h"

static zr_vec3 corner(const struct zr_mesh *mesh, uint32_t slot)
{
    zr_vec4 p = mesh->positions[mesh->indices[slot]];
    if (p.w == 1.0f || p.w == 0.0f) return (zr_vec3){p.x, p.y, p.z};
    return (zr_vec3){p.x / p.w, p.y / p.w, p.z / p.w};
}

/* Cross products are taken from the first corner, so that a small face far from
 * the origin loses nothing. */
zr_vec3 zr_normal_of_face(const struct zr_mesh *mesh, uint32_t face)
{
    uint32_t begin = mesh->face_offsets[face], end = zr_mesh_rings(mesh, face).offsets[1];
    zr_vec3 origin = corner(mesh, begin), sum = {0, 0, 0};
    zr_vec3 previous = zr_vec3_sub(corner(mesh, begin + 1), origin);
    for (uint32_t slot = begin + 2; slot < end; slot++) {
        zr_vec3 current = zr_vec3_sub(corner(mesh, slot), origin);
        sum = zr_vec3_add(sum, zr_vec3_cross(previous, current));
        previous = current;
    }
    return sum;
}

zr_vec3 *zr_normals_of_vertices(struct zr_arena *arena, const struct zr_mesh *mesh)
{
    zr_vec3 *normals = zr_arena_zero(arena, mesh->position_count, sizeof *normals);
    if (!normals) return NULL;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        zr_vec3 normal = zr_normal_of_face(mesh, face);
        for (uint32_t slot = mesh->face_offsets[face]; slot < mesh->face_offsets[face + 1]; slot++) {
            uint32_t vertex = mesh->indices[slot];
            normals[vertex] = zr_vec3_add(normals[vertex], normal);
        }
    }
    for (uint32_t i = 0; i < mesh->position_count; i++)
        normals[i] = zr_vec3_normalize(normals[i]);
    return normals;
}

enum { STRAIGHT = 0 };
static const float ANGLE_MIN = 1e-4f;

/* How often one coordinate of the edges changes its sign on the way round: twice for a
 * convex ring, more often for one that has dents or goes round twice. */
struct turning {
    int first, last, changes;
};

static void take_edge(struct turning *turning, float along, float length)
{
    int sign = along > ANGLE_MIN * length ? 1 : along < -ANGLE_MIN * length ? -1 : STRAIGHT;
    if (sign == STRAIGHT) return;
    if (turning->first == STRAIGHT) turning->first = sign;
    if (turning->last != STRAIGHT && turning->last != sign) turning->changes++;
    turning->last = sign;
}

static int changes_of(const struct turning *turning)
{
    return turning->changes + (turning->first != turning->last);
}

static float length_of(zr_vec3 v)
{
    return sqrtf(zr_vec3_dot(v, v));
}

/* Rings whose parts cancel out, such as a bow tie, have next to no normal. */
static bool cancels_out(const struct zr_mesh *mesh, uint32_t begin, uint32_t count, zr_vec3 normal)
{
    zr_vec3 origin = corner(mesh, begin), previous = zr_vec3_sub(corner(mesh, begin + 1), origin);
    float sum = 0.0f;
    for (uint32_t i = 2; i < count; i++) {
        zr_vec3 current = zr_vec3_sub(corner(mesh, begin + i), origin);
        sum += length_of(zr_vec3_cross(previous, current));
        previous = current;
    }
    return length_of(normal) < 1e-3f * sum;
}

bool zr_face_is_concave(const struct zr_mesh *mesh, uint32_t face, zr_vec3 normal)
{
    uint32_t begin = mesh->face_offsets[face], count = mesh->face_offsets[face + 1] - begin;
    if (count < 4) return false;
    if (cancels_out(mesh, begin, count, normal)) return true;
    zr_vec3 unit = zr_vec3_normalize(normal), before = {0, 0, 0};
    /* Seen along the axis that the face is most square to. */
    float x = fabsf(unit.x), y = fabsf(unit.y), z = fabsf(unit.z);
    bool drop_x = x >= y && x >= z, drop_y = !drop_x && y >= z;
    struct turning u = {0, 0, 0}, v = {0, 0, 0};
    /* From the last edge on, so that each corner is met; the last edge twice does no harm. */
    for (uint32_t i = count - 1; i < 2 * count; i++) {
        zr_vec3 edge = zr_vec3_sub(corner(mesh, begin + (i + 1) % count), corner(mesh, begin + i % count));
        float length = length_of(edge);
        if (!(length > 0.0f)) continue;
        zr_vec3 turn = zr_vec3_cross(before, edge);
        if (zr_vec3_dot(turn, unit) < -ANGLE_MIN * length_of(before) * length) return true;
        take_edge(&u, drop_x ? edge.y : edge.x, length);
        take_edge(&v, drop_x || drop_y ? edge.z : edge.y, length);
        before = edge;
    }
    return changes_of(&u) > 2 || changes_of(&v) > 2;
}
