#include "scene/camera/mesh_up.h"

#include <math.h>

#include "scene/camera/camera.h"
#include "scene/camera/face_area.h"

/* Largest distance of a face from the end of the box in which it lies, as a share of the diagonal. */
static const double tolerance = 1e-3;
static const double least_support = 0.25, least_gain = 2.0;

enum { FACES_PER_CANCEL_CHECK = 1 << 12 };

zr_mat4 zr_mesh_up_turn(enum zr_mesh_up up)
{
    static const zr_mat4 turns[ZR_MESH_UP_COUNT] = {
        [ZR_MESH_UP_X] = {{0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
        [ZR_MESH_UP_MINUS_X] = {{0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
        [ZR_MESH_UP_Y] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
        [ZR_MESH_UP_MINUS_Y] = {{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
        [ZR_MESH_UP_Z] = {{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}},
        [ZR_MESH_UP_MINUS_Z] = {{-1, 0, 0, 0, 0, 0, -1, 0, 0, -1, 0, 0, 0, 0, 0, 1}}};
    return turns[up];
}

/* ---- auto ---- */

struct box {
    double min[3], max[3], near_end;
};

/* Adds the area of a face to each end in which it lies. */
static void add_face(const struct zr_mesh *mesh, uint32_t face, const struct box *box, double areas[3][2])
{
    const uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    bool lies[3][2] = {{true, true}, {true, true}, {true, true}}, lies_somewhere = false;
    for (uint32_t i = begin; i < end; i++) {
        const zr_vec4 *p = &mesh->positions[mesh->indices[i]];
        const double at[3] = {(double)p->x, (double)p->y, (double)p->z};
        for (int a = 0; a < 3; a++) {
            lies[a][0] = lies[a][0] && at[a] <= box->min[a] + box->near_end;
            lies[a][1] = lies[a][1] && at[a] >= box->max[a] - box->near_end;
        }
    }
    for (int a = 0; a < 3; a++)
        lies_somewhere = lies_somewhere || lies[a][0] || lies[a][1];
    if (!lies_somewhere) return;
    const struct zr_face_area area = zr_face_area_of(mesh, face);
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < 2; k++)
            if (lies[a][k]) areas[a][k] += fabs(area.along[a]);
}

static void add_faces(const struct zr_mesh *mesh, const struct box *box, const struct zr_cancel *cancel,
                      double areas[3][2])
{
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        add_face(mesh, face, box, areas);
    }
}

enum zr_mesh_up zr_mesh_up_find(const struct zr_scene *scene, enum zr_mesh_up usual, struct zr_team *team,
                                const struct zr_cancel *cancel)
{
    static const enum zr_mesh_up ups[3] = {ZR_MESH_UP_X, ZR_MESH_UP_Y, ZR_MESH_UP_Z};
    static const int order[3] = {1, 2, 0}; /* if supports are equal, y is selected before z, and z before x */
    const struct zr_bounds bounds = zr_bounds_of(scene, team, cancel);
    const struct box box = {{(double)bounds.min.x, (double)bounds.min.y, (double)bounds.min.z},
                            {(double)bounds.max.x, (double)bounds.max.y, (double)bounds.max.z},
                            (double)zr_diagonal_of(&bounds) * tolerance};
    double areas[3][2] = {{0}}, usual_support = 0.0, most = 0.0;
    enum zr_mesh_up found = usual;
    if (!bounds.valid) return usual;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        add_faces(&scene->meshes[i], &box, cancel, areas);
    for (int k = 0; k < 3; k++) {
        const int a = order[k], b = (a + 1) % 3, c = (a + 2) % 3;
        const double whole = (box.max[b] - box.min[b]) * (box.max[c] - box.min[c]);
        const double support = whole > 0.0 ? fmin(fmax(areas[a][0], areas[a][1]) / whole, 1.0) : 0.0;
        if (ups[a] == usual) usual_support = support;
        if (support <= most) continue;
        most = support;
        found = ups[a];
    }
    return most >= least_support && most >= least_gain * usual_support ? found : usual;
}
