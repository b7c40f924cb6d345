#include "geometry/face.h"

#include <math.h>

/* ---- convexity ---- */

/* A vector in double. Differences of float32 coordinates are exact, unless their exponents are far apart. */
struct exact {
    double x, y, z;
};

static struct exact exact_corner(const struct zr_mesh *mesh, uint32_t slot)
{
    zr_vec4 p = mesh->positions[mesh->indices[slot]];
    struct exact c = {(double)p.x, (double)p.y, (double)p.z};
    if (p.w == 1.0f) return c;
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

bool zr_face_is_line(const struct zr_mesh *mesh, uint32_t face)
{
    uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    struct exact first = exact_corner(mesh, begin), along = {0, 0, 0};
    for (uint32_t slot = begin + 1; slot < end; slot++) {
        struct exact to = minus(exact_corner(mesh, slot), first), turn = cross(along, to);
        double sizes =
            (along.x * along.x + along.y * along.y + along.z * along.z) * (to.x * to.x + to.y * to.y + to.z * to.z);
        if (!(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z <= 1e-12 * sizes)) return false;
        if (is_zero(along)) along = to;
    }
    return true;
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

/* Counts how often one coordinate of the edges changes its sign along the ring: twice for a convex ring, more often for
 * one that goes round twice. */
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

/* Returns true if the corner turns against the normal. A ring without a normal, such as a bow tie, must not turn at
 * all. */
static bool turns_back(struct exact before, struct exact edge, struct exact normal)
{
    struct exact turn = cross(before, edge);
    if (is_zero(normal)) return !is_zero(turn);
    return !(turn.x * normal.x + turn.y * normal.y + turn.z * normal.z >= 0.0);
}

/* ---- convexity of cones ---- */

/* Returns a corner as a ray of homogeneous space, projected along one of its four axes: a face spans three of the four
 * dimensions, as it spans two of three in space. */
static struct exact ray_of(const struct zr_mesh *mesh, uint32_t slot, int axis)
{
    zr_vec4 p = mesh->positions[mesh->indices[slot]];
    const double v[4] = {(double)p.x, (double)p.y, (double)p.z, (double)p.w};
    return (struct exact){v[(axis + 1) % 4], v[(axis + 2) % 4], v[(axis + 3) % 4]};
}

static double dot(struct exact a, struct exact b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Returns the signed volume between three rays: its sign is the direction of their turn. */
static double turn_of(struct exact a, struct exact b, struct exact c)
{
    return dot(cross(a, b), c);
}

/* Returns twice the summed volumes of the fan's triangles, projected along an axis. Sets *any if some volume is not
 * 0. */
static double volume_of(const struct zr_mesh *mesh, uint32_t begin, uint32_t end, int axis, bool *any)
{
    struct exact first = ray_of(mesh, begin, axis), previous = ray_of(mesh, begin + 1, axis);
    double sum = 0.0;
    for (uint32_t slot = begin + 2; slot < end; slot++) {
        struct exact current = ray_of(mesh, slot, axis);
        double turn = turn_of(first, previous, current);
        *any = *any || turn != 0.0;
        sum += turn;
        previous = current;
    }
    return sum;
}

/* Progress of the corners around the first one: up to half a turn, in one direction. */
struct around {
    struct exact first, start, at;
    bool has_start, away, back; /* the path has left the plane of `first` and `start`; it has returned */
};

static bool goes_round(struct around *around, struct exact to, double side)
{
    if (!around->has_start) {
        around->start = around->at = to;
        around->has_start = true;
        return true;
    }
    double step = side * turn_of(around->first, around->at, to), all = side * turn_of(around->first, around->start, to);
    if (step < 0.0 || all < 0.0 || (around->back && all > 0.0)) return false;
    around->back = around->away && all == 0.0;
    around->away = around->away || all > 0.0;
    around->at = to;
    return true;
}

/* Returns true if the cone of the corners' rays is not convex. Opposite rays have no well-defined edge between them, so
 * a face with such neighbours counts as concave. */
static bool cone_is_concave(const struct zr_mesh *mesh, uint32_t begin, uint32_t end)
{
    double volume = 0.0, most = 0.0; /* not fabs(volume): see outside_of in lines/line_pieces.c */
    int axis = 0;
    bool any = false;
    for (int i = 0; i < 4; i++) {
        double along = volume_of(mesh, begin, end, i, &any);
        if (!(fabs(along) > most)) continue;
        most = fabs(along);
        volume = along;
        axis = i;
    }
    if (volume == 0.0) return any;
    const double side = volume > 0.0 ? 1.0 : -1.0;
    struct exact first = ray_of(mesh, begin, axis), at = first, before = first;
    for (uint32_t slot = end - 1; slot > begin && is_zero(cross(before, first)); slot--)
        before = ray_of(mesh, slot, axis);
    struct around around = {.first = first};
    for (uint32_t slot = begin + 1; slot <= end; slot++) {
        struct exact to = slot < end ? ray_of(mesh, slot, axis) : first;
        bool along = is_zero(cross(at, to)), along_first = is_zero(cross(first, to));
        if ((along && dot(at, to) <= 0.0) || (along_first && dot(first, to) <= 0.0)) return true;
        if (along) continue; /* repeated corner */
        if (side * turn_of(before, at, to) < 0.0) return true;
        if (!along_first && !goes_round(&around, to, side)) return true;
        before = at;
        at = to;
    }
    return false;
}

static bool has_corner_behind(const struct zr_mesh *mesh, uint32_t begin, uint32_t end)
{
    for (uint32_t slot = begin; slot < end; slot++)
        if (!(mesh->positions[mesh->indices[slot]].w > 0.0f)) return true;
    return false;
}

/* ---- faces ---- */

bool zr_face_is_concave(const struct zr_mesh *mesh, uint32_t face)
{
    uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    if (end - begin < 4) return false;
    if (ZR_MUTANT(corners_behind_divided, has_corner_behind(mesh, begin, end), false))
        return cone_is_concave(mesh, begin, end);
    struct exact normal = exact_normal(mesh, begin, end);
    /* Project along the axis that is most perpendicular to the face. */
    double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    bool drop_x = x >= y && x >= z, drop_y = !drop_x && y >= z;
    /* Repeated corners make no edge: the first corner turns from the last edge that has a length. */
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
    if (zr_mesh_face_is_cap(mesh, face)) return true;
    if (mesh->faces_are_fans) return false;
    return zr_mesh_rings(mesh, face).count > 1 || zr_face_is_concave(mesh, face);
}
