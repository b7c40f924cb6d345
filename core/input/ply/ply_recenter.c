/* Moves PLY that is far from the origin (recenter.h).
 * Vertices are read twice more: for the bounds of the drawn ones, and with the middle subtracted. */
#include "input/ply/ply_file.h"
#include "scene/unused_positions.h"

/* Reads the vertices again. Restores the position and the counts for warnings. */
static enum zr_status read_again(struct zr_ply_file *file)
{
    const struct zr_ply_place place = {file->at, file->line, file->last_line};
    const struct zr_ply_oddities odd = file->odd;
    const struct zr_ply_plan plan = zr_ply_plan_of(file->vertices);
    const bool is_fixed = file->header.form != ZR_PLY_ASCII && file->vertices->list_count == 0;
    file->at = file->vertices_at.at;
    file->line = file->vertices_at.line;
    file->last_line = file->vertices_at.last_line;
    const enum zr_status status = is_fixed ? zr_ply_read_vertices(file, &plan) : zr_ply_read_records(file, &plan, 0);
    file->at = place.at;
    file->line = place.line;
    file->last_line = place.last_line;
    file->odd = odd;
    return status;
}

/* Finds the vertices that faces or edges use. Without both, all are points: *used is NULL. */
static bool find_used(struct zr_ply_file *file, const uint8_t **used)
{
    const struct zr_ply_faces *faces = &file->faces;
    *used = NULL;
    if (faces->count == 0 && file->line_count == 0) return true;
    if (!zr_ply_faces_reserve(file, 0, 0)) return false;
    const struct zr_mesh mesh = {.position_count = (uint32_t)file->vertex_count,
                                 .face_count = (uint32_t)faces->count,
                                 .face_offsets = faces->offsets,
                                 .indices = faces->indices,
                                 .line_count = (uint32_t)file->line_count,
                                 .lines = file->lines};
    *used = zr_used_positions(file->arena, file->team, &mesh);
    return *used != NULL;
}

enum zr_status zr_ply_adjust(struct zr_ply_file *file, struct zr_scene_builder *builder)
{
    if (!file->is_far && !zr_recenter_is_remote(file->positions, file->vertex_count)) return ZR_OK;
    if (!find_used(file, &file->used)) return ZR_NO_MEMORY;
    file->box = zr_box_empty();
    file->finds_box = true;
    enum zr_status status = read_again(file);
    file->finds_box = false;
    if (status == ZR_OK) status = zr_recenter_origin(file->arena, &file->box, file->limits, &file->origin, file->error);
    if (status == ZR_OK) status = read_again(file);
    builder->scene->origin = file->origin;
    return status;
}
