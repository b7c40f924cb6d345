#include "input/defaults.h"

void zr_scene_defaults(struct zr_scene *scene)
{
    static const struct zr_light headlight = {{0, 0, -1}, {0.8f, 0.8f, 0.8f}, true};
    static const struct zr_output color = {ZR_CHANNEL_COLOR, ZR_ENCODING_PNG, 0};
    *scene = (struct zr_scene){
        .width = 640,
        .height = 480,
        .background = {1, 1, 1, 1},
        .ambient = {0.2f, 0.2f, 0.2f},
        .light_count = 1,
        .lights = &headlight,
        .output_count = 1,
        .outputs = &color,
        .view = {.pose = ZR_POSE_PRESET,
                 .preset = ZR_PRESET_ISOMETRIC,
                 .up = {0, 1, 0},
                 .world_to_camera = zr_mat4_identity(),
                 .projection = ZR_PROJECTION_ORTHOGRAPHIC,
                 .projection_matrix = zr_mat4_identity(),
                 .fit_padding = ZR_FIT_PADDING},
    };
}

zr_vec4 zr_default_base_color(bool coloured)
{
    return coloured ? (zr_vec4){1, 1, 1, 1} : (zr_vec4){0.7f, 0.7f, 0.7f, 1};
}

enum zr_shading zr_default_shading(bool smooth)
{
    return smooth ? ZR_SHADING_GOURAUD : ZR_SHADING_FLAT;
}
