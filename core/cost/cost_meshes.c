#include "cost/cost_meshes.h"

#include <math.h>

#include "shade/draw_attributes.h"

/* Bytes per vertex, corner, triangle, point or face of each array. */
#define VERTEX_BYTES        17.0 /* of the window, and its outcode */
#define EYE_BYTES           8.0  /* of vertices of meshes with lines */
#define BIN_BYTES           4.0  /* per triangle */
#define POINT_BYTES         14.0 /* per point of a cloud */
#define ATTRIBUTE_BYTES     16.0 /* per vertex and corner of small meshes */
#define COLOR_BYTES         4.0  /* per face */
#define CREASE_CORNER_BYTES 20.0 /* while creases are found */
#define CREASE_VERTEX_BYTES 9.0
#define KEPT_CREASE_BYTES   7.0   /* per corner, afterwards */
#define FIXED_BYTES         4e5   /* of every picture */
#define LINE_BYTES          170.0 /* per triangle whose lines are found */
#define FACT_BYTES          50.0  /* per triangle of parts that info measures */
#define WALL_BYTES          180.0 /* per triangle whose walls are measured: of the solid, and of its tree */

/* Sums over instances. Creases are found per mesh, one after another. */
struct sums {
    double pass, kept, creases, lines, triangles;
};

static void add_instance(const struct zr_mesh *mesh, const struct zr_cost_passes *passes, bool is_lit,
                         struct sums *sums)
{
    const double corners = (double)mesh->face_offsets[mesh->face_count], positions = (double)mesh->position_count;
    const double vertices = mesh->face_count == 0 && mesh->line_count == 0 ? 0.0 : positions;
    const double triangles = corners - 2.0 * (double)mesh->face_count;
    sums->pass += vertices * VERTEX_BYTES + triangles * BIN_BYTES + (double)mesh->point_count * POINT_BYTES;
    if (mesh->line_count > 0) sums->pass += vertices * EYE_BYTES;
    if (!is_lit) sums->pass += (double)mesh->face_count * COLOR_BYTES;
    if (is_lit && positions < (double)ZR_LOADED_VERTICES) sums->pass += (vertices + corners) * ATTRIBUTE_BYTES;
    sums->lines += triangles * LINE_BYTES;
    sums->triangles += triangles;
    if (!passes->makes_normals || mesh->normal_count > 0) return;
    sums->kept += corners * KEPT_CREASE_BYTES;
    sums->creases = fmax(sums->creases, corners * CREASE_CORNER_BYTES + positions * CREASE_VERTEX_BYTES);
}

double zr_cost_mesh_bytes(const struct zr_scene *scene, const struct zr_cost_passes *passes)
{
    const bool is_lit = passes->samples > 0.0 && scene->picture->is_linear;
    struct sums sums = {0.0, 0.0, 0.0, 0.0, 0.0};
    if (scene->is_undrawn) return 0.0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        add_instance(&scene->meshes[scene->instances[i].mesh], passes, is_lit, &sums);
    const double measured = passes->has_walls ? WALL_BYTES : passes->has_info ? FACT_BYTES : 0.0;
    const double drawn = fmax(fmax(sums.kept + sums.pass, sums.creases), measured * sums.triangles);
    return FIXED_BYTES + (is_lit && zr_cost_draws_lines(scene->picture) ? fmax(drawn, sums.lines) : drawn);
}
