#include "scene/defaults.h"

#include "core.h"
#include "scene/output.h"

static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                              info = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};

void zr_scene_defaults(struct zr_scene *scene)
{
    *scene = (struct zr_scene){
        .views[0] = {.width = ZR_DEFAULT_WIDTH,
                     .height = ZR_DEFAULT_HEIGHT,
                     .output_count = 1,
                     .outputs = &color,
                     .world_to_camera = zr_mat4_identity(),
                     .projection_matrix = zr_mat4_identity()},
    };
    zr_look_apply(zr_look_textbook(), scene);
    zr_look_set_view(zr_look_textbook(), &scene->views[0]);
}

void zr_default_output_use(struct zr_scene *scene)
{
    if (scene->is_undrawn && scene->views[0].outputs == &color) scene->views[0].outputs = &info;
}

zr_vec3 zr_default_ambient_of_own_lights(void)
{
    return (zr_vec3){0.2f, 0.2f, 0.2f};
}

zr_vec4 zr_default_base_color(const struct zr_look *look, bool coloured)
{
    return coloured ? (zr_vec4){1, 1, 1, 1} : look->material.base_color;
}

enum zr_shading zr_default_shading(const struct zr_look *look, bool smooth)
{
    if (!look->shades_by_mesh) return look->material.shading;
    return smooth ? ZR_SHADING_GOURAUD : ZR_SHADING_FLAT;
}

struct zr_limits zr_limits_default(void)
{
    return (struct zr_limits){
        .json_depth_max = 64,
        .window_side_max = 8192,
        .window_pixels_max = (uint64_t)32 * 1024 * 1024,
        .polygon_vertices_max = 1024,
        .instances_max = 100000,
        .image_pixels_max = (uint64_t)64 * 1024 * 1024,
        .coordinate_max = 1e6f,
        .views_max = 4096,
        .view_pixels_max = (uint64_t)512 * 1024 * 1024,
        .unpacked_bytes_max = (uint64_t)8 * 1024 * 1024 * 1024,
    };
}

bool zr_outputs_are_pictures(const struct zr_scene *scene)
{
    const struct zr_view *view = &scene->views[0];
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel != ZR_CHANNEL_COLOR) return false;
    return true;
}
