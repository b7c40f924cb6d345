#include "geometry/normals.h"

#include "geometry/face.h"

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

zr_triangle_normals_fn *zr_triangle_normals_of(enum zr_isa isa)
{
    static zr_triangle_normals_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_triangle_normals);
    return table[isa];
}

void zr_face_normals_begin(struct zr_face_normals *normals, enum zr_isa isa, const struct zr_mesh *mesh)
{
    normals->mesh = mesh;
    normals->make_many = zr_mesh_is_of_triangles(mesh) ? zr_triangle_normals_of(isa) : NULL;
    normals->first = normals->count = 0;
}

void zr_face_normals_make(struct zr_face_normals *normals, uint32_t face)
{
    const uint32_t left = normals->mesh->face_count - face;
    normals->first = face;
    normals->count = left < ZR_NORMALS_AT_ONCE ? left : ZR_NORMALS_AT_ONCE;
    normals->make_many(normals->mesh, face, normals->count, normals->normals);
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
