#include "geometry/face.h"

#include <math.h>

/* ---- corners ---- */

static bool same_place(const struct zr_mesh *mesh, uint32_t a, uint32_t b)
{
    const zr_vec4 *p = &mesh->positions[a], *q = &mesh->positions[b];
    return a == b || (p->x == q->x && p->y == q->y && p->z == q->z && p->w == q->w);
}

bool zr_face_is_degenerate(const struct zr_mesh *mesh, uint32_t face)
{
    const uint32_t *indices = mesh->indices + mesh->face_offsets[face];
    uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
    uint32_t second = 1;
    while (second < count && same_place(mesh, indices[0], indices[second]))
        second++;
    for (uint32_t i = second + 1; i < count; i++)
        if (!same_place(mesh, indices[0], indices[i]) && !same_place(mesh, indices[second], indices[i])) return false;
    return true;
}

/* ---- convexity ---- */

/* Differences of float32 coordinates are exact in double, unless their exponents are far apart. */
struct exact {
    double x, y, z;
};

static struct exact exact_corner(const struct zr_mesh *mesh, uint32_t slot)
{
    zr_vec4 p = mesh->positions[mesh->indices[slot]];
    struct exact c = {(double)p.x, (double)p.y, (double)p.z};
    if (p.w == 1.0f || p.w == 0.0f) return c;
    double w = (double)p.w;
    return (struct exact){c.x / w, c.y / w, c.z / w};
}

static struct exact minus(struct exact a, struct exact b)
{
    return (struct exact){a.x - b.x, a.y - b.y, a.z - b.z};
}

static struct exact cross(struct exact a, struct exact b)
{
    return (struct exact){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static bool is_zero(struct exact v)
{
    return v.x == 0.0 && v.y == 0.0 && v.z == 0.0;
}

static struct exact exact_normal(const struct zr_mesh *mesh, uint32_t begin, uint32_t end)
{
    struct exact origin = exact_corner(mesh, begin), sum = {0, 0, 0};
    struct exact previous = minus(exact_corner(mesh, begin + 1), origin);
    for (uint32_t slot = begin + 2; slot < end; slot++) {
        struct exact current = minus(exact_corner(mesh, slot), origin), turn = cross(previous, current);
        sum = (struct exact){sum.x + turn.x, sum.y + turn.y, sum.z + turn.z};
        previous = current;
    }
    return sum;
}

/* How often one coordinate of the edges changes its sign on the way round: twice for a
 * convex ring, more often for one that goes round twice. */
struct turning {
    int first, last, changes;
};

static void take_edge(struct turning *turning, double along)
{
    if (along == 0.0) return;
    int sign = along > 0.0 ? 1 : -1;
    if (turning->first == 0) turning->first = sign;
    if (turning->last != 0 && turning->last != sign) turning->changes++;
    turning->last = sign;
}

static int changes_of(const struct turning *turning)
{
    return turning->changes + (turning->first != turning->last);
}

/* A ring without a normal, such as a bow tie, has a side only where it has no turns. */
static bool turns_back(struct exact before, struct exact edge, struct exact normal)
{
    struct exact turn = cross(before, edge);
    if (is_zero(normal)) return !is_zero(turn);
    return !(turn.x * normal.x + turn.y * normal.y + turn.z * normal.z >= 0.0);
}

bool zr_face_is_concave(const struct zr_mesh *mesh, uint32_t face)
{
    uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    if (end - begin < 4) return false;
    struct exact normal = exact_normal(mesh, begin, end);
    /* Seen along the axis that the face is most square to. */
    double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    bool drop_x = x >= y && x >= z, drop_y = !drop_x && y >= z;
    /* Repeated corners make no edge: the first corner turns from the last edge that is one. */
    struct exact first = exact_corner(mesh, begin), at = first, before = {0, 0, 0};
    for (uint32_t slot = end - 1; slot > begin && is_zero(before); slot--)
        before = minus(first, exact_corner(mesh, slot));
    struct turning u = {0, 0, 0}, v = {0, 0, 0};
    for (uint32_t slot = begin + 1; slot <= end; slot++) {
        struct exact to = slot < end ? exact_corner(mesh, slot) : first, edge = minus(to, at);
        if (is_zero(edge)) continue;
        if (turns_back(before, edge, normal)) return true;
        take_edge(&u, drop_x ? edge.y : edge.x);
        take_edge(&v, drop_x || drop_y ? edge.z : edge.y);
        before = edge;
        at = to;
    }
    return changes_of(&u) > 2 || changes_of(&v) > 2;
}

bool zr_face_is_shape(const struct zr_mesh *mesh, uint32_t face)
{
    if (mesh->faces_are_fans) return false;
    return zr_mesh_rings(mesh, face).count > 1 || zr_face_is_concave(mesh, face);
}
