#include "lines/drawing.h"

#include "base/cancel.h"
#include "base/run.h"
#include "lines/chains.h"
#include "lines/coincident.h"
#include "lines/contour_steps.h"
#include "lines/intersections.h"
#include "mesh/mesh_tables.h"

/* Runs the stage unless an earlier one failed. */
#define STAGE(call)                                                                                                    \
    if (status == ZR_OK) status = (call)

struct making {
    const struct zr_run *run;
    const struct zr_drawing_desc *desc;
};

static enum zr_status make_tables(const struct making *m, struct zr_edge_mesh **tables)
{
    const struct zr_scene *scene = m->desc->scene;
    enum zr_status status = ZR_OK;
    *tables = zr_arena_alloc(m->run->arena, scene->mesh_count, sizeof **tables);
    if (!*tables) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const struct zr_edge_mesh *shared = zr_mesh_table_edges(scene->tables, scene, i);
        if (shared)
            (*tables)[i] = *shared;
        else
            STAGE(zr_edge_mesh_make(m->run, &scene->meshes[i], &(*tables)[i]));
    }
    return status;
}

static enum zr_status find_features(const struct making *m, const struct zr_window_mesh *mesh, uint8_t **features)
{
    *features = zr_features_find(m->run, mesh, &m->desc->rule);
    return zr_is_cancelled(m->run->cancel) ? ZR_CANCELLED : *features ? ZR_OK : ZR_NO_MEMORY;
}

static struct zr_window_view fine_view_of(const struct zr_drawing_desc *desc)
{
    const struct zr_window_view view = zr_window_view_make(desc->camera, desc->bounds, desc->width, desc->height);
    return zr_window_view_refine(desc->camera, desc->bounds, &view);
}

/* Moves the points from the window in which they were found to that of the description. */
static void scale_points(const struct zr_drawing_desc *desc, const struct zr_window_view *view,
                         struct zr_polylines *lines)
{
    const double x = (double)desc->width / view->width, y = (double)desc->height / view->height;
    for (uint32_t i = 0; i < lines->point_count; i++) {
        lines->points[i][0] *= x;
        lines->points[i][1] *= y;
    }
}

enum zr_status zr_drawing_make(const struct zr_run *run, const struct zr_drawing_desc *desc, struct zr_drawing *out)
{
    const struct making m = {run, desc};
    const struct zr_window_view view = fine_view_of(desc);
    const double straight = desc->straight > 0.0 ? desc->straight : ZR_POLYLINE_STRAIGHT;
    struct zr_edge_mesh *tables = NULL;
    uint8_t *features = NULL;
    struct zr_cells cells;
    struct zr_hidden_parts hidden;
    struct zr_line_pieces pieces;
    enum zr_status status = ZR_OK;

    STAGE(make_tables(&m, &tables));
    STAGE(zr_window_mesh_make(run, desc->scene, tables, &view, &out->mesh));
    STAGE(find_features(&m, &out->mesh, &features));
    STAGE(zr_chains_keep(run->arena, run->cancel, &out->mesh, features));
    STAGE(zr_cells_make(run, &out->mesh, &cells));
    STAGE(zr_lines_make(run->arena, run->cancel, &out->mesh, features, &out->lines));
    STAGE(zr_intersections_add(run, &out->mesh, &cells, &out->lines));
    STAGE(zr_hidden_parts_find(run, &out->mesh, &cells, &out->lines, &hidden));
    STAGE(zr_line_pieces_make(run, &out->mesh, &cells, &out->lines, &hidden, desc->has_hidden, &pieces));
    STAGE(zr_contour_steps_apply(run->arena, run->cancel, &cells, &pieces));
    STAGE(zr_coincident_join(run->arena, run->cancel, &pieces));
    STAGE(zr_polylines_make(run->arena, run->cancel, &pieces, straight, &out->polylines));
    if (status == ZR_OK) scale_points(desc, &view, &out->polylines);
    return status;
}
