/* mesh_lines.h - render: lines of the mesh (lines/drawing.h), as ink over a finished picture or for a file. */
#ifndef ZR_MESH_LINES_H
#define ZR_MESH_LINES_H

#include "base/run.h"
#include "base/team.h"
#include "shade/frame.h"

/* Draws the lines over frame->color. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_mesh_lines_draw(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame);

/* Makes frame->lines in `arena`. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_mesh_lines_keep(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

#endif
