#include "api/encode_input.h"

#include <string.h>

#include "measure/part_distance.h"
#include "scene/output.h"
#include "scene/picture.h"

static const char *copy_text(struct zr_arena *arena, const char *text)
{
    return text ? zr_arena_copy(arena, text, strlen(text) + 1) : NULL;
}

/* Copies names and counts of geometry, and what was subtracted from it. */
static void keep_meshes(struct zr_arena *arena, const struct zr_scene *from, struct zr_scene *scene)
{
    struct zr_mesh *meshes = zr_arena_zero(arena, from->mesh_count, sizeof *meshes);
    struct zr_instance *instances = zr_arena_alloc(arena, from->instance_count, sizeof *instances);
    for (uint32_t i = 0; meshes && i < from->mesh_count; i++) {
        const struct zr_mesh *mesh = &from->meshes[i];
        meshes[i].name = copy_text(arena, mesh->name);
        if (mesh->move) meshes[i].move = zr_arena_copy(arena, mesh->move, 3 * sizeof *mesh->move);
        meshes[i].face_count = mesh->face_count;
        meshes[i].line_count = mesh->line_count;
        meshes[i].point_count = mesh->point_count;
    }
    const char *node = NULL, *copied = NULL; /* instances of one node follow one another */
    for (uint32_t i = 0; instances && i < from->instance_count; i++) {
        instances[i] = from->instances[i];
        if (instances[i].node != node) copied = copy_text(arena, node = instances[i].node);
        instances[i].node = copied;
    }
    scene->meshes = meshes;
    scene->instances = instances;
}

/* Copies the parts with their names. */
static void keep_parts(struct zr_arena *arena, struct zr_part_list *list)
{
    struct zr_part *parts = zr_arena_copy(arena, list->at, list->count * sizeof *parts);
    for (uint32_t i = 0; parts && i < list->count; i++)
        parts[i].name = copy_text(arena, parts[i].name);
    list->at = parts;
}

/* Copies the distances with the names of their parts. */
static void keep_distances(struct zr_arena *arena, struct zr_frame *frame)
{
    struct zr_part_distance *kept =
        zr_arena_copy(arena, frame->distances, frame->distance_count * sizeof *kept);
    for (uint32_t i = 0; kept && i < frame->distance_count; i++)
        for (int k = 0; k < 2; k++)
            kept[i].parts[k] = copy_text(arena, kept[i].parts[k]);
    frame->distances = kept;
}

/* Copies the names of the fragments' parts; the fragments stay in place. */
static void keep_fragments(struct zr_arena *arena, struct zr_pixel_fragments *fragments)
{
    for (uint32_t i = 0; i < fragments->count; i++)
        fragments->at[i].part = copy_text(arena, fragments->at[i].part);
}

static void keep_outputs(struct zr_arena *arena, const struct zr_view *from, struct zr_view *view)
{
    *view = *from;
    view->outputs = zr_arena_copy(arena, from->outputs, from->output_count * sizeof *from->outputs);
}

struct zr_encode_input *zr_encode_input_make(struct zr_arena *arena, const struct zr_scene *scene,
                                             const struct zr_frame *frame)
{
    struct zr_encode_input *made = zr_arena_zero(arena, 1, sizeof *made);
    if (!made) return NULL;
    made->scene = (struct zr_scene){.look = scene->look,
                                    .background = scene->background,
                                    .parts = {.explode = scene->parts.explode},
                                    .picture = zr_arena_copy(arena, scene->picture, sizeof *scene->picture),
                                    .mesh_count = scene->mesh_count,
                                    .instance_count = scene->instance_count,
                                    .compress = scene->compress,
                                    .is_strict = scene->is_strict,
                                    .has_features = scene->has_features,
                                    .file = scene->file,
                                    .counts = scene->counts};
    if (scene->origin) made->scene.origin = zr_arena_copy(arena, scene->origin, 3 * sizeof *scene->origin);
    made->scene.adds_origin = scene->adds_origin;
    keep_meshes(arena, scene, &made->scene);
    keep_outputs(arena, frame->view, &made->scene.views[0]);
    made->warnings = zr_drawing_warnings_make(arena, scene, frame);
    made->frame = *frame;
    made->frame.origin = scene->adds_origin ? made->scene.origin : NULL;
    made->frame.view = &made->scene.views[0];
    keep_parts(arena, &made->frame.parts.list);
    keep_fragments(arena, &made->frame.fragments);
    if (frame->distances) keep_distances(arena, &made->frame);
    if (frame->base) {
        made->base.first_face_id = frame->base->first_face_id;
        made->base.clamped_depths = frame->base->clamped_depths;
        made->frame.base = &made->base;
    }
    return zr_arena_ok(arena) ? made : NULL;
}
