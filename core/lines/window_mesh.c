#include "lines/window_mesh.h"

#include "base/cancel.h"
#include "base/run.h"

enum { ITEMS_PER_RANGE = 2048 };

/* Triangles with less area have no plane in the window. */
static const double area_least = 1e-9;

struct making {
    const struct zr_scene *scene;
    const struct zr_cancel *cancel;
    struct zr_window_mesh *mesh;
    struct zr_drawn_instance *instances;
    struct zr_window_point *points;
    double (*eyes)[3];
    uint8_t *outside;
    float (*normals)[3], *areas;
    uint32_t (*corners)[3];
    uint8_t *traits;
    uint32_t *sources;
};

/* ---- instances ---- */

uint32_t zr_drawn_instance_of(const struct zr_window_mesh *mesh, size_t offset, uint32_t number)
{
    uint32_t low = 0, high = mesh->instance_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        uint32_t first;
        memcpy(&first, (const char *)&mesh->instances[middle] + offset, sizeof first);
        if (first <= number)
            low = middle;
        else
            high = middle;
    }
    return low;
}

uint32_t zr_drawn_piece_of(const struct zr_window_mesh *mesh, uint32_t triangle)
{
    const struct zr_drawn_instance *of =
        &mesh->instances[zr_drawn_instance_of(mesh, offsetof(struct zr_drawn_instance, first_triangle), triangle)];
    return of->first_piece + of->table->pieces[triangle - of->first_triangle];
}

static bool is_mirror(const struct zr_matrix *m)
{
    const double *c = m->m;
    const double x = c[5] * c[10] - c[6] * c[9], y = c[6] * c[8] - c[4] * c[10], z = c[4] * c[9] - c[5] * c[8];
    return (c[0] * x + c[1] * y) + c[2] * z < 0.0;
}

/* Numbers all vertices, triangles, edges and pieces. False if a number would exceed 32 bits. */
static bool place_instances(const struct making *m, const struct zr_edge_mesh *tables)
{
    uint64_t vertices = 0, triangles = 0, edges = 0, pieces = 0;
    for (uint32_t i = 0; i < m->scene->instance_count; i++) {
        const struct zr_instance *instance = &m->scene->instances[i];
        const struct zr_edge_mesh *table = &tables[instance->mesh];
        const struct zr_matrix to_world = zr_matrix_of(&instance->object_to_world);
        struct zr_drawn_instance *out = &m->instances[i];
        *out = (struct zr_drawn_instance){.table = table,
                                          .mesh = &m->scene->meshes[instance->mesh],
                                          .first_vertex = (uint32_t)vertices,
                                          .first_triangle = (uint32_t)triangles,
                                          .first_edge = (uint32_t)edges,
                                          .first_piece = (uint32_t)pieces,
                                          .to_eye = zr_matrix_mul(&m->mesh->view.world_to_eye, &to_world)};
        out->to_clip = zr_matrix_mul(&m->mesh->view.eye_to_clip, &out->to_eye);
        out->is_mirror = is_mirror(&out->to_eye);
        vertices += table->vertex_count;
        triangles += table->triangle_count;
        edges += table->edge_count;
        pieces += table->piece_count;
        if (3 * triangles > UINT32_MAX / 4) return false;
    }
    m->mesh->instance_count = m->scene->instance_count;
    m->mesh->vertex_count = (uint32_t)vertices;
    m->mesh->triangle_count = (uint32_t)triangles;
    m->mesh->edge_count = (uint32_t)edges;
    m->mesh->piece_count = (uint32_t)pieces;
    return true;
}

/* ---- vertices ---- */

static void place_vertex(const struct making *m, const struct zr_drawn_instance *of, uint32_t vertex)
{
    const zr_vec4 *p = &of->mesh->positions[of->table->positions[vertex - of->first_vertex]];
    const double object[4] = {(double)p->x, (double)p->y, (double)p->z, (double)p->w};
    double eye[4], clip[4];
    zr_matrix_apply(&of->to_eye, object, eye);
    zr_matrix_apply(&of->to_clip, object, clip);
    for (int k = 0; k < 3; k++)
        m->eyes[vertex][k] = eye[3] == 1.0 ? eye[k] : eye[k] / eye[3];
    m->outside[vertex] = (uint8_t)zr_window_outside(clip);
    if (m->outside[vertex] == 0) m->points[vertex] = zr_window_point_of(&m->mesh->view, clip);
}

static void place_vertices(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    if (zr_is_cancelled(m->cancel)) return;
    uint32_t i = zr_drawn_instance_of(m->mesh, offsetof(struct zr_drawn_instance, first_vertex), (uint32_t)begin);
    for (uint32_t v = (uint32_t)begin; v < end; v++) {
        while (v - m->instances[i].first_vertex >= m->instances[i].table->vertex_count)
            i++;
        place_vertex(m, &m->instances[i], v);
    }
}

/* ---- triangles ---- */

static double area_of(const struct zr_window_point *a, const struct zr_window_point *b, const struct zr_window_point *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* Box in the window. */
struct box {
    double low_x, high_x, low_y, high_y;
};

static struct box box_of(const struct zr_window_point *points, const uint32_t corners[3])
{
    const struct zr_window_point *p = &points[corners[0]];
    struct box box = {p->x, p->x, p->y, p->y};
    for (int k = 1; k < 3; k++) {
        p = &points[corners[k]];
        if (p->x < box.low_x) box.low_x = p->x;
        if (p->x > box.high_x) box.high_x = p->x;
        if (p->y < box.low_y) box.low_y = p->y;
        if (p->y > box.high_y) box.high_y = p->y;
    }
    return box;
}

static bool is_in_window(const struct making *m, const struct box *box)
{
    const double margin = ZR_WINDOW_MARGIN;
    return box->high_x >= -margin && box->low_x <= m->mesh->view.width + margin && box->high_y >= -margin &&
           box->low_y <= m->mesh->view.height + margin;
}

/* Turns the corners counter-clockwise in the window, and sets the traits that follow from their places. */
static uint8_t turn(const struct making *m, uint32_t corners[3])
{
    const double area = area_of(&m->points[corners[0]], &m->points[corners[1]], &m->points[corners[2]]);
    const struct box box = box_of(m->points, corners);
    uint8_t traits = 0;
    if (area < 0.0) {
        const uint32_t swapped = corners[1];
        corners[1] = corners[2];
        corners[2] = swapped;
    }
    if (fabs(area) > area_least && is_in_window(m, &box)) traits |= ZR_TRIANGLE_HIDES;
    if (box.high_x - box.low_x < ZR_SMALL_PIXELS && box.high_y - box.low_y < ZR_SMALL_PIXELS)
        traits |= ZR_TRIANGLE_SMALL;
    return traits;
}

/* Sets the normal. Returns true if the plane faces the eye. */
static bool set_normal(const struct making *m, uint32_t triangle, const uint32_t vertices[3])
{
    const double *a = m->eyes[vertices[0]], *b = m->eyes[vertices[1]], *c = m->eyes[vertices[2]];
    const double *eye = m->mesh->view.eye;
    double u[3], v[3], to_eye[3];
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
        to_eye[k] = eye[3] != 0.0 ? eye[k] - a[k] : eye[k];
    }
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        m->normals[triangle][k] = length > 0.0 ? (float)(n[k] / length) : 0.0f;
    m->areas[triangle] = (float)length;
    return (n[0] * to_eye[0] + n[1] * to_eye[1]) + n[2] * to_eye[2] > 0.0;
}

static void place_triangle(const struct making *m, const struct zr_drawn_instance *of, uint32_t triangle)
{
    const uint32_t own = triangle - of->first_triangle, *vertices = of->table->corners + 3 * (size_t)own;
    const struct zr_material *material = zr_material_of_face(m->scene, of->mesh, of->table->faces[own]);
    uint32_t *corners = m->corners[triangle];
    unsigned any = 0, all = ~0u;
    for (int k = 0; k < 3; k++) {
        corners[k] = of->first_vertex + vertices[k];
        any |= m->outside[corners[k]];
        all &= m->outside[corners[k]];
    }
    const bool is_front = set_normal(m, triangle, corners);
    uint8_t traits = is_front ? ZR_TRIANGLE_FRONT : 0;
    if (material->unfilled || all || (!material->double_sided && is_front == of->is_mirror))
        traits |= ZR_TRIANGLE_ABSENT;
    if (!any) traits |= turn(m, corners);
    if (traits & ZR_TRIANGLE_ABSENT || material->alpha_mode == ZR_ALPHA_BLEND) traits &= (uint8_t)~ZR_TRIANGLE_HIDES;
    m->traits[triangle] = traits;
}

static void place_triangles(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    if (zr_is_cancelled(m->cancel)) return;
    uint32_t i = zr_drawn_instance_of(m->mesh, offsetof(struct zr_drawn_instance, first_triangle), (uint32_t)begin);
    for (uint32_t t = (uint32_t)begin; t < end; t++) {
        while (t - m->instances[i].first_triangle >= m->instances[i].table->triangle_count)
            i++;
        place_triangle(m, &m->instances[i], t);
    }
}

/* ---- triangles that cross the near or far plane ---- */

/* Five corners, and room for two more that rounding may make. */
enum { CUT_CORNERS_MOST = 7, CUT_PIECES_MOST = CUT_CORNERS_MOST - 2 };

/* True if the triangle is in part inside. */
static bool is_cut(const struct making *m, uint32_t triangle)
{
    const uint32_t *corners = m->corners[triangle];
    return !(m->traits[triangle] & ZR_TRIANGLE_ABSENT) &&
           (m->outside[corners[0]] | m->outside[corners[1]] | m->outside[corners[2]]);
}

/* Cuts a polygon in clip space by w + sign z >= 0. Returns the number of its corners. Source: Sutherland & Hodgman,
 * "Reentrant Polygon Clipping", 1974. */
static int cut_by_plane(double in[CUT_CORNERS_MOST][4], int count, double sign, double out[CUT_CORNERS_MOST][4])
{
    int made = 0;
    for (int i = 0; i < count && made + 2 <= CUT_CORNERS_MOST; i++) {
        const double *a = in[i], *b = in[(i + 1) % count];
        const double from = a[3] + sign * a[2], to = b[3] + sign * b[2];
        if (from >= 0.0) memcpy(out[made++], a, sizeof out[0]);
        if ((from >= 0.0) == (to >= 0.0)) continue;
        const double t = from / (from - to);
        for (int k = 0; k < 4; k++)
            out[made][k] = a[k] + t * (b[k] - a[k]);
        made++;
    }
    return made;
}

/* Cuts a triangle and writes the window positions of the result. Returns their number; 0 if nothing is inside. */
static int cut(const struct making *m, uint32_t triangle, struct zr_window_point out[CUT_CORNERS_MOST])
{
    const struct zr_drawn_instance *of =
        &m->instances[zr_drawn_instance_of(m->mesh, offsetof(struct zr_drawn_instance, first_triangle), triangle)];
    double polygon[CUT_CORNERS_MOST][4], half[CUT_CORNERS_MOST][4];
    for (int k = 0; k < 3; k++) {
        const uint32_t vertex = m->corners[triangle][k] - of->first_vertex;
        const zr_vec4 *p = &of->mesh->positions[of->table->positions[vertex]];
        zr_matrix_apply(&of->to_clip, (const double[4]){(double)p->x, (double)p->y, (double)p->z, (double)p->w},
                        polygon[k]);
    }
    const int half_count = cut_by_plane(polygon, 3, 1.0, half);
    const int count = half_count < 3 ? 0 : cut_by_plane(half, half_count, -1.0, polygon);
    for (int i = 0; i < count; i++) {
        if (!(polygon[i][3] > 0.0)) return 0;
        out[i] = zr_window_point_of(&m->mesh->view, polygon[i]);
    }
    return count;
}

static void add_cut(const struct making *m, uint32_t triangle, uint32_t *point_count)
{
    struct zr_window_point polygon[CUT_CORNERS_MOST];
    const int count = cut(m, triangle, polygon);
    for (int i = 2; i < count; i++) {
        const uint32_t number = m->mesh->triangle_count + m->mesh->cut_count++;
        const int from[3] = {0, i - 1, i};
        for (int k = 0; k < 3; k++) {
            m->points[*point_count] = polygon[from[k]];
            m->corners[number][k] = (*point_count)++;
        }
        m->sources[number - m->mesh->triangle_count] = triangle;
        m->traits[number] = turn(m, m->corners[number]);
    }
}

static uint32_t count_cut(const struct making *m)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < m->mesh->triangle_count; t++)
        count += is_cut(m, t);
    return count;
}

/* Grows the arrays by the pieces of cut triangles. */
static bool add_cuts(const struct making *m, struct making *grown, struct zr_arena *arena, uint32_t cut_triangles)
{
    const size_t triangles = m->mesh->triangle_count, vertices = m->mesh->vertex_count;
    const size_t more = (size_t)cut_triangles * CUT_PIECES_MOST;
    *grown = *m;
    grown->points = zr_arena_alloc(arena, vertices + 3 * more, sizeof *grown->points);
    grown->corners = zr_arena_alloc(arena, triangles + more, sizeof *grown->corners);
    grown->traits = zr_arena_alloc(arena, triangles + more, sizeof *grown->traits);
    grown->sources = zr_arena_alloc(arena, more, sizeof *grown->sources);
    if (!zr_arena_ok(arena)) return false;
    memcpy(grown->points, m->points, vertices * sizeof *m->points);
    memcpy(grown->corners, m->corners, triangles * sizeof *m->corners);
    memcpy(grown->traits, m->traits, triangles * sizeof *m->traits);
    uint32_t point_count = m->mesh->vertex_count;
    for (uint32_t t = 0; t < triangles && !zr_is_cancelled(m->cancel); t++)
        if (is_cut(m, t)) add_cut(grown, t, &point_count);
    return true;
}

/* ---- all steps ---- */

static bool make_arrays(struct zr_arena *arena, struct making *m)
{
    const size_t vertices = m->mesh->vertex_count, triangles = m->mesh->triangle_count;
    m->points = zr_arena_alloc(arena, vertices, sizeof *m->points);
    m->eyes = zr_arena_alloc(arena, vertices, sizeof *m->eyes);
    m->outside = zr_arena_alloc(arena, vertices, sizeof *m->outside);
    m->normals = zr_arena_alloc(arena, triangles, sizeof *m->normals);
    m->areas = zr_arena_alloc(arena, triangles, sizeof *m->areas);
    m->corners = zr_arena_alloc(arena, triangles, sizeof *m->corners);
    m->traits = zr_arena_alloc(arena, triangles, sizeof *m->traits);
    return zr_arena_ok(arena);
}

enum zr_status zr_window_mesh_make(const struct zr_run *run, const struct zr_scene *scene,
                                   const struct zr_edge_mesh *tables, const struct zr_window_view *view,
                                   struct zr_window_mesh *out)
{
    struct making m = {.scene = scene, .cancel = run->cancel, .mesh = out}, grown;
    *out = (struct zr_window_mesh){.view = *view};
    m.instances = zr_arena_alloc(run->arena, scene->instance_count, sizeof *m.instances);
    if (!m.instances || !place_instances(&m, tables) || !make_arrays(run->arena, &m)) return ZR_NO_MEMORY;
    out->instances = m.instances;
    zr_team_ranges(run->team, out->vertex_count, ITEMS_PER_RANGE, place_vertices, &m);
    if (!zr_is_cancelled(run->cancel))
        zr_team_ranges(run->team, out->triangle_count, ITEMS_PER_RANGE, place_triangles, &m);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    const uint32_t cut_triangles = count_cut(&m);
    if (cut_triangles > 0) {
        if (!add_cuts(&m, &grown, run->arena, cut_triangles)) return ZR_NO_MEMORY;
        m = grown;
    }
    out->points = m.points;
    out->eyes = (const double(*)[3])m.eyes;
    out->outside = m.outside;
    out->normals = (const float(*)[3])m.normals;
    out->areas = m.areas;
    out->corners = (const uint32_t(*)[3])m.corners;
    out->traits = m.traits;
    out->sources = m.sources;
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
