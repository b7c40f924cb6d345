#include "effects/edge_marks.h"

#include "shade/draw_attributes.h"

/* Corners of a drawn triangle, relative to the eye like the points of samples. */
struct corners {
    zr_vec3 at[3];
};

static struct corners corners_of(const struct zr_edge_faces *faces, uint32_t owner)
{
    const struct zr_draw *draw = zr_draw_of(faces->geometry, owner - 1);
    const struct zr_draw_attributes *of_draw = &faces->of_draw[draw - faces->geometry->draws];
    struct corners out;
    for (uint32_t k = 0; k < 3; k++) {
        const zr_vec4 p =
            zr_draw_point(of_draw, zr_draw_is_cloud(draw) ? zr_cloud_position(draw, owner - 1)
                                                          : zr_draw_corner(draw, owner - 1 - draw->first, k));
        out.at[k] = (zr_vec3){p.x, p.y, p.z};
    }
    return out;
}

static bool share_a_corner(const struct corners *a, const struct corners *b)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (a->at[i].x == b->at[j].x && a->at[i].y == b->at[j].y && a->at[i].z == b->at[j].z) return true;
    return false;
}

/* Returns the distance from the triangle's plane after moving by `between` from a point on it; 0 for a triangle without
 * area. */
static float distance_from(const struct corners *c, zr_vec3 between)
{
    const zr_vec3 normal = zr_vec3_cross(zr_vec3_sub(c->at[1], c->at[0]), zr_vec3_sub(c->at[2], c->at[0]));
    return fabsf(zr_vec3_dot(zr_vec3_normalize(normal), between));
}

static zr_vec3 point_of(const struct zr_edge_line *line, int32_t at)
{
    return (zr_vec3){line->point[0][at], line->point[1][at], line->point[2][at]};
}

static float width_at(const struct zr_edge_rule *rule, zr_vec3 p)
{
    const struct zr_pixel_scale *scale = &rule->scale;
    return (scale->slope[0] * p.x + scale->slope[1] * p.y) + (scale->slope[2] * p.z + scale->offset);
}

static bool are_joined(const struct zr_edge_rule *rule, const struct zr_edge_line *a, const struct zr_edge_line *b,
                       int32_t at)
{
    if (a->owner[at] == b->owner[at]) return true;
    const struct corners c1 = corners_of(rule->faces, a->owner[at]), c2 = corners_of(rule->faces, b->owner[at]);
    if (!share_a_corner(&c1, &c2)) return false;
    const zr_vec3 p1 = point_of(a, at), p2 = point_of(b, at), between = zr_vec3_sub(p2, p1);
    const float limit = rule->limit * fmaxf(width_at(rule, p1), width_at(rule, p2));
    return distance_from(&c1, between) <= limit || distance_from(&c2, between) <= limit;
}

uint32_t zr_edge_faces_apart(const struct zr_edge_rule *rule, const struct zr_edge_line *a,
                             const struct zr_edge_line *b, int32_t first, uint32_t pairs)
{
    for (uint32_t bits = pairs; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        if (are_joined(rule, a, b, first + i)) pairs &= ~(1u << i);
    }
    return pairs;
}

/* ---- caps ---- */

uint32_t zr_edge_caps_apart(const struct zr_edge_rule *rule, const struct zr_edge_line *a, const struct zr_edge_line *b,
                            int32_t first, uint32_t pairs)
{
    for (uint32_t bits = pairs; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        if (rule->caps[a->owner[first + i] - 1] == rule->caps[b->owner[first + i] - 1]) pairs &= ~(1u << i);
    }
    return pairs;
}

bool zr_edge_caps_list(struct zr_arena *arena, const struct zr_geometry *geometry, const uint32_t **caps)
{
    bool has_caps = false;
    *caps = NULL;
    for (uint32_t i = 0; i < geometry->draw_count; i++)
        has_caps = has_caps || geometry->draws[i].mesh->cap_count > 0;
    if (!has_caps) return true;
    uint32_t *list = zr_arena_zero(arena, geometry->primitive_count, sizeof *list);
    for (uint32_t i = 0; list && i < geometry->draw_count; i++) {
        const struct zr_draw *draw = &geometry->draws[i];
        for (uint32_t k = 0; k < draw->count && draw->kind == ZR_DRAW_SHAPES; k++)
            if (zr_mesh_face_is_cap(draw->mesh, draw->faces[k]))
                list[draw->first + k] = draw->first_id + draw->faces[k];
    }
    *caps = list;
    return list != NULL;
}
