#include "lines/features.h"

#include "base/cancel.h"
#include "base/run.h"
#include "base/trig.h"
#include "lines/smooth_normal.h"
#include "mesh/face_normals.h"
#include "mesh/noise_edges.h"

enum { EDGES_PER_RANGE = 2048, FEW_SIDES = 16 };

/* Cosine of 10 degrees: given normals agree. */
static const float agreed_cosine = 0.98480775f;

/* Faces at exactly the crease angle, as of regular cylinders, are smooth, however their normals are rounded. */
static const float rounding = 1e-6f;

struct finding {
    const struct zr_window_mesh *mesh;
    const struct zr_cancel *cancel;
    float weak_cosine, strong_cosine;
    bool ignores_normals, keeps_noise;
    const struct zr_edge_mesh *first_table; /* of all instances */
    const uint8_t *const *noise;            /* by number of the table: a byte per edge, or NULL */
    uint8_t *features;
};

/* An edge with the sides of its present triangles. */
struct edge {
    const struct zr_drawn_instance *of;
    uint32_t number, low, high; /* in the edge table */
    uint32_t count;
    uint32_t sides[FEW_SIDES]; /* the first ones */
    bool is_diagonal;
};

static uint32_t triangle_of(const struct edge *edge, uint32_t i)
{
    return edge->of->first_triangle + edge->sides[i] / 3;
}

static bool is_upward(const struct edge *edge, uint32_t i)
{
    return zr_side_is_upward(edge->of->table, edge->sides[i]);
}

static bool is_front(const struct finding *f, const struct edge *edge, uint32_t i)
{
    return f->mesh->traits[triangle_of(edge, i)] & ZR_TRIANGLE_FRONT;
}

/* Returns the corner of a triangle that is not on the edge, as a vertex of all instances. */
static uint32_t opposite(const struct edge *edge, uint32_t i)
{
    const uint32_t side = edge->sides[i], *corners = edge->of->table->corners + side / 3 * 3;
    return edge->of->first_vertex + corners[(side % 3 + 2) % 3];
}

static float dot(const float a[3], const float b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* Returns the height of the opposite corner of triangle j above the plane of triangle i, over its distance from the
 * lower end of the edge. */
static double height(const struct finding *f, const struct edge *edge, uint32_t i, uint32_t j)
{
    const double *corner = f->mesh->eyes[opposite(edge, j)], *low = f->mesh->eyes[edge->of->first_vertex + edge->low];
    const float *n = f->mesh->normals[triangle_of(edge, i)];
    const double to[3] = {corner[0] - low[0], corner[1] - low[1], corner[2] - low[2]};
    const double length = sqrt((to[0] * to[0] + to[1] * to[1]) + to[2] * to[2]);
    const double above = (to[0] * (double)n[0] + to[1] * (double)n[1]) + to[2] * (double)n[2];
    return length > 0.0 ? above / length : 0.0;
}

/* ---- two triangles ---- */

/* Returns the slot of the corner of a triangle at `vertex`. */
static uint32_t slot_at(const struct edge *edge, uint32_t i, uint32_t vertex)
{
    const struct zr_edge_mesh *table = edge->of->table;
    const size_t first = edge->sides[i] / 3 * 3;
    size_t k = 0;
    while (k < 2 && table->corners[first + k] != vertex)
        k++;
    return table->slots[first + k];
}

/* True if both triangles have given normals at a vertex, and these agree. */
static bool agree_at(const struct edge *edge, uint32_t vertex)
{
    const struct zr_mesh *mesh = edge->of->mesh;
    zr_vec3 normals[2];
    for (uint32_t i = 0; i < 2; i++) {
        const uint32_t slot = slot_at(edge, i, vertex);
        normals[i] = mesh->normals[mesh->normal_indices ? mesh->normal_indices[slot] : mesh->indices[slot]];
        if (zr_normal_is_zero(normals[i])) return false;
        normals[i] = zr_vec3_normalize(normals[i]);
    }
    return zr_vec3_dot(normals[0], normals[1]) >= agreed_cosine;
}

static bool is_smooth_by_file(const struct finding *f, const struct edge *edge)
{
    if (f->ignores_normals || edge->of->mesh->normal_count == 0) return false;
    return agree_at(edge, edge->low) && agree_at(edge, edge->high);
}

/* True if the edge bounds a cap. */
static bool is_of_cap(const struct edge *edge)
{
    const struct zr_mesh *mesh = edge->of->mesh;
    if (mesh->cap_count == 0 || edge->is_diagonal) return false;
    for (uint32_t i = 0; i < edge->count && i < FEW_SIDES; i++)
        if (zr_mesh_face_is_cap(mesh, edge->of->table->faces[edge->sides[i] / 3])) return true;
    return false;
}

static bool has_normal(const float n[3])
{
    return n[0] != 0.0f || n[1] != 0.0f || n[2] != 0.0f;
}

/* Returns the cosine between the smoothed normals. */
static float smooth_cosine(const struct finding *f, const struct edge *edge, float sign)
{
    float a[3], b[3];
    zr_smooth_normal_of(f->mesh, edge->of, triangle_of(edge, 0), a);
    zr_smooth_normal_of(f->mesh, edge->of, triangle_of(edge, 1), b);
    return sign * dot(a, b);
}

static bool is_noise(const struct finding *f, const struct edge *edge)
{
    const uint8_t *noise = f->noise[edge->of->table - f->first_table];
    return !f->keeps_noise && noise && noise[edge->number];
}

static unsigned features_of_two(const struct finding *f, const struct edge *edge)
{
    const float *a = f->mesh->normals[triangle_of(edge, 0)], *b = f->mesh->normals[triangle_of(edge, 1)];
    const bool is_against = is_upward(edge, 0) == is_upward(edge, 1);
    const float sign = is_against ? -1.0f : 1.0f, least = f->weak_cosine - rounding;
    unsigned features = 0;
    if ((is_front(f, edge, 0) != is_front(f, edge, 1)) != is_against) features |= ZR_FEATURE_CONTOUR;
    if (is_of_cap(edge)) return features | ZR_FEATURE_WEAK | ZR_FEATURE_STRONG;
    float cosine = sign * dot(a, b);
    if (!(cosine < least) || edge->is_diagonal || !has_normal(a) || !has_normal(b)) return features;
    if (is_noise(f, edge)) return features;
    if (!f->keeps_noise) cosine = smooth_cosine(f, edge, sign);
    if (!(cosine < least) || is_smooth_by_file(f, edge)) return features;
    features |= ZR_FEATURE_WEAK;
    if (cosine < f->strong_cosine - rounding) features |= ZR_FEATURE_STRONG;
    if (height(f, edge, 0, 1) < 0.0) features |= ZR_FEATURE_CONVEX;
    return features;
}

/* ---- one triangle ---- */

static unsigned features_of_one(const struct finding *f, const struct edge *edge)
{
    return f->ignores_normals || edge->of->mesh->normal_count == 0 ? ZR_FEATURE_BORDER
                                                                   : ZR_FEATURE_BORDER | ZR_FEATURE_SMOOTH;
}

/* ---- three and more ---- */

/* True if triangle c lies in front of the planes of a and b, seen from the eye. */
static bool is_before(const struct finding *f, const struct edge *edge, uint32_t a, uint32_t b, uint32_t c)
{
    const double in_plane = 0.01;
    const double over_a = is_front(f, edge, a) ? height(f, edge, a, c) : -height(f, edge, a, c);
    const double over_b = is_front(f, edge, b) ? height(f, edge, b, c) : -height(f, edge, b, c);
    return over_a > in_plane && over_b > in_plane;
}

/* True if triangles a and b go on across the edge, and no other lies in front of both. */
static bool go_on(const struct finding *f, const struct edge *edge, uint32_t a, uint32_t b)
{
    const bool is_against = is_upward(edge, a) == is_upward(edge, b);
    const float cosine = dot(f->mesh->normals[triangle_of(edge, a)], f->mesh->normals[triangle_of(edge, b)]);
    if (!((is_against ? -cosine : cosine) >= f->weak_cosine)) return false;
    for (uint32_t c = 0; c < edge->count; c++)
        if (c != a && c != b && is_before(f, edge, a, b, c)) return false;
    return true;
}

/* Returns on which side of the edge a triangle lies in the window, by the sign; 0 if the eye is in its plane. */
static double window_side(const struct finding *f, const struct edge *edge, uint32_t i)
{
    const double *low = f->mesh->eyes[edge->of->first_vertex + edge->low],
                 *high = f->mesh->eyes[edge->of->first_vertex + edge->high], *corner = f->mesh->eyes[opposite(edge, i)],
                 *eye = f->mesh->view.eye;
    double along[3], to_eye[3], to[3];
    for (int k = 0; k < 3; k++) {
        along[k] = high[k] - low[k];
        to_eye[k] = eye[3] != 0.0 ? eye[k] - low[k] : eye[k];
        to[k] = corner[k] - low[k];
    }
    return (to[0] * (along[1] * to_eye[2] - along[2] * to_eye[1]) +
            to[1] * (along[2] * to_eye[0] - along[0] * to_eye[2])) +
           to[2] * (along[0] * to_eye[1] - along[1] * to_eye[0]);
}

/* True if the window shows no triangle beyond the edge. */
static bool is_on_one_side(const struct finding *f, const struct edge *edge)
{
    bool has_left = false, has_right = false;
    for (uint32_t i = 0; i < edge->count; i++) {
        const double side = window_side(f, edge, i);
        has_left |= side > 0.0;
        has_right |= side < 0.0;
    }
    return has_left != has_right;
}

static unsigned features_of_more(const struct finding *f, const struct edge *edge)
{
    const unsigned strong = ZR_FEATURE_WEAK | ZR_FEATURE_STRONG | ZR_FEATURE_MORE;
    if (edge->count > FEW_SIDES) return strong;
    const unsigned contour = is_on_one_side(f, edge) ? ZR_FEATURE_CONTOUR : 0;
    if (is_of_cap(edge)) return strong | contour;
    for (uint32_t a = 0; a < edge->count; a++)
        for (uint32_t b = a + 1; b < edge->count; b++)
            if (go_on(f, edge, a, b)) return contour;
    return strong | contour;
}

/* ---- all edges ---- */

static struct edge edge_of(const struct finding *f, const struct zr_drawn_instance *of, uint32_t number)
{
    const struct zr_edge_mesh *table = of->table;
    const struct zr_mesh_edge *own = &table->edges[number];
    struct edge edge = {.of = of, .number = number, .low = own->low, .high = own->high};
    for (uint32_t i = own->first_side; i < own[1].first_side; i++) {
        if (f->mesh->traits[of->first_triangle + table->sides[i] / 3] & ZR_TRIANGLE_ABSENT) continue;
        if (edge.count < FEW_SIDES) edge.sides[edge.count] = table->sides[i];
        edge.count++;
    }
    edge.is_diagonal = edge.count == 2 && table->faces[edge.sides[0] / 3] == table->faces[edge.sides[1] / 3];
    return edge;
}

static void find_range(void *context, size_t begin, size_t end)
{
    const struct finding *f = context;
    if (zr_is_cancelled(f->cancel)) return;
    uint32_t i = zr_drawn_instance_of(f->mesh, offsetof(struct zr_drawn_instance, first_edge), (uint32_t)begin);
    for (uint32_t e = (uint32_t)begin; e < end; e++) {
        while (e - f->mesh->instances[i].first_edge >= f->mesh->instances[i].table->edge_count)
            i++;
        const struct edge edge = edge_of(f, &f->mesh->instances[i], e - f->mesh->instances[i].first_edge);
        unsigned features = edge.count == 1 ? features_of_one(f, &edge) : 0;
        if (edge.count == 2) features = features_of_two(f, &edge);
        if (edge.count > 2) features = features_of_more(f, &edge);
        if (is_of_cap(&edge)) features |= ZR_FEATURE_CUT;
        f->features[e] = (uint8_t)features;
    }
}

/* Finds the noise of each table that an instance has. False if the arena failed. */
static bool find_noise(const struct zr_run *run, struct finding *f, float degrees)
{
    const struct zr_window_mesh *mesh = f->mesh;
    const struct zr_edge_mesh *last = mesh->instances[0].table;
    f->first_table = last;
    for (uint32_t i = 1; i < mesh->instance_count; i++) {
        const struct zr_edge_mesh *table = mesh->instances[i].table;
        if (table < f->first_table) f->first_table = table;
        if (table > last) last = table;
    }
    const uint8_t **noise = zr_arena_zero(run->arena, (size_t)(last - f->first_table) + 1, sizeof *noise);
    for (uint32_t i = 0; noise && i < mesh->instance_count && !zr_is_cancelled(run->cancel); i++) {
        const struct zr_drawn_instance *of = &mesh->instances[i];
        const uint8_t **own = &noise[of->table - f->first_table];
        if (!*own) *own = zr_noise_edges_find(run, of->mesh, of->table, degrees);
    }
    f->noise = noise;
    return zr_arena_ok(run->arena);
}

uint8_t *zr_features_find(const struct zr_run *run, const struct zr_window_mesh *mesh,
                          const struct zr_feature_rule *rule)
{
    const double weak = (double)rule->crease_degrees, strong = 1.5 * weak < 180.0 ? 1.5 * weak : 180.0;
    double sine, weak_cosine, strong_cosine;
    zr_sine_cosine(weak, &sine, &weak_cosine);
    zr_sine_cosine(strong, &sine, &strong_cosine);
    struct finding f = {.mesh = mesh,
                        .cancel = run->cancel,
                        .weak_cosine = (float)weak_cosine,
                        .strong_cosine = (float)strong_cosine,
                        .ignores_normals = rule->ignores_normals,
                        .keeps_noise = rule->keeps_noise,
                        .features = zr_arena_alloc(run->arena, mesh->edge_count, sizeof *f.features)};
    if (!f.features) return NULL;
    if (mesh->instance_count > 0 && !find_noise(run, &f, rule->crease_degrees)) return NULL;
    zr_team_ranges(run->team, mesh->edge_count, EDGES_PER_RANGE, find_range, &f);
    return f.features;
}
