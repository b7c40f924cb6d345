#include "reference/subject.h"

#include <stdio.h>

#include "base/run.h"
#include "scene/looks.h"

static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                           {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY},
                                           {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};

void subject_make(struct subject *subject, const struct drawing *drawing)
{
    static const uint32_t no_faces[1] = {0};
    /* Unlit but for those that are to be lit, so that colours reach the pixels as they are, and double sided: with
     * culling on, Mesa's answer depends on its batches (RULES.md, rule 11). */
    const enum zr_shading lit = drawing->smooth ? ZR_SHADING_GOURAUD : ZR_SHADING_FLAT;
    subject->materials[0] = (struct zr_material){.base_color = {1, 1, 1, 1},
                                                 .shading = drawing->lit ? lit : ZR_SHADING_UNLIT,
                                                 .double_sided = true,
                                                 .uniform_color = drawing->first_corner,
                                                 .unfilled = drawing->unfilled,
                                                 .outline = drawing->outline,
                                                 .outline_color = {0.25f, 0.5f, 0.125f, 1}};
    for (int mode = 0; mode < ZR_ALPHA_NAMES; mode++) {
        subject->materials[mode] = subject->materials[0];
        subject->materials[mode].alpha_mode = (enum zr_alpha_mode)mode;
        subject->materials[mode].alpha_cutoff = drawing->alpha_cutoff;
    }
    bool per_vertex = drawing->smooth || drawing->first_corner;
    bool holes = drawing->ring_count > drawing->face_count;
    subject->mesh = (struct zr_mesh){.name = "",
                                     .position_count = drawing->position_count,
                                     .positions = drawing->positions,
                                     .face_count = drawing->face_count,
                                     .face_offsets = drawing->face_count > 0 ? drawing->face_offsets : no_faces,
                                     .indices = drawing->indices,
                                     .face_rings = holes ? drawing->face_rings : NULL,
                                     .ring_offsets = holes ? drawing->ring_offsets : NULL,
                                     .line_count = drawing->line_count,
                                     .lines = drawing->lines,
                                     .point_count = drawing->point_count,
                                     .points = drawing->points,
                                     .point_size = drawing->point_size,
                                     .normal_count = drawing->given_normals ? drawing->position_count : 0,
                                     .normals = drawing->given_normals ? drawing->normals : NULL,
                                     .colors = per_vertex ? drawing->colors : NULL,
                                     .face_colors = per_vertex ? NULL : drawing->face_colors,
                                     .face_materials = drawing->see_through ? drawing->face_materials : NULL};
    subject->instance = (struct zr_instance){.mesh = 0, .object_to_world = zr_mat4_identity()};
    subject->picture = (struct zr_picture){.side = drawing->side, .line_width = drawing->line_width};
    subject->scene = (struct zr_scene){.look = zr_look_textbook(),
                                       .background = {0, 0, 0, 1},
                                       .picture = &subject->picture,
                                       .ambient = drawing->ambient,
                                       .light_count = drawing->light_count,
                                       .lights = drawing->lights,
                                       .material_count = drawing->see_through ? ZR_ALPHA_NAMES : 1,
                                       .materials = subject->materials,
                                       .mesh_count = 1,
                                       .meshes = &subject->mesh,
                                       .instance_count = 1,
                                       .instances = &subject->instance,
                                       .views[0] = {.width = drawing->width,
                                                    .height = drawing->height,
                                                    .pose = ZR_POSE_MATRIX,
                                                    .world_to_camera = drawing->modelview,
                                                    .projection = ZR_PROJECTION_MATRIX,
                                                    .projection_matrix = drawing->projection}};
}

/* Positions of far scenes are compared as they are drawn, before outputs add what readers subtracted: test_far.c. */
static bool keep_near(struct zr_arena *arena, struct zr_scene *scene)
{
    struct zr_mesh *meshes = zr_arena_alloc(arena, scene->mesh_count, sizeof *meshes);
    if (!meshes) return false;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        meshes[i] = scene->meshes[i];
        meshes[i].move = NULL;
    }
    scene->meshes = meshes;
    scene->adds_origin = false;
    return true;
}

static const struct zr_frame *render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                     const struct zr_output *wanted, uint32_t count)
{
    struct zr_scene asked = *scene;
    if (scene->adds_origin && !keep_near(arena, &asked)) return NULL;
    asked.views[0].output_count = count;
    asked.views[0].outputs = wanted;
    struct zr_error error = {.status = ZR_OK};
    const struct zr_frame *frame = NULL;
    enum zr_status status =
        zr_render(&(struct zr_run){.arena = arena, .team = team, .error = &error}, &asked, NULL, &frame);
    bool whole = status == ZR_OK && frame;
    for (uint32_t i = 0; whole && i < count; i++)
        whole = frame->channels[wanted[i].channel] != NULL;
    if (whole) return frame;
    fprintf(stderr, "zr_render: status %d, %s\n", (int)status, error.count ? error.items[0].detail : "no frame");
    return NULL;
}

const struct zr_frame *subject_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene)
{
    return render(arena, team, scene, outputs, sizeof outputs / sizeof *outputs);
}

const void *subject_channel(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                            enum zr_channel channel, enum zr_space space)
{
    const struct zr_output wanted = {.channel = channel, .encoding = ZR_ENCODING_NPY, .space = space};
    const struct zr_frame *frame = render(arena, team, scene, &wanted, 1);
    return frame ? frame->channels[channel] : NULL;
}
