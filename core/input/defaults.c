#include "input/defaults.h"

/* A key in front, from the left, and a weaker light from above. Both stand beside the camera's axis: a light on it
 * makes one grey hexagon of a cube that is seen isometrically. Of the lights whose directions are of unit length as
 * they stand, by which no face has less than a third of its colour and no normal more than all of it, the faces of a
 * cube seen from ten sides differ most by these (tests/unit/test_default_light.c prints the table):
 *
 *     azimuth, elevation    left    right   top        azimuth, elevation    left    right   top
 *     isometric             0.663   0.341   0.965      30, 35                0.627   0.376   0.965
 *     isometric, below      0.894   0.631   0.392 *    30, 50                0.557   0.341   0.953
 *     45, 20                0.714   0.396   0.933      60, 20                0.714   0.416   0.933
 *     45, 50                0.608   0.341   0.953      60, 35                0.678   0.341   0.965
 *     30, 20                0.690   0.420   0.933      60, 50                0.639   0.341   0.953
 *                                                      * the underside
 */
static const struct zr_light LIGHTS[] = {
    {{2.0f / 3, -1.0f / 3, -2.0f / 3}, {0.45f, 0.45f, 0.45f}, true},
    {{-4.0f / 13, -12.0f / 13, -3.0f / 13}, {0.37f, 0.37f, 0.37f}, true},
};

void zr_scene_defaults(struct zr_scene *scene)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    *scene = (struct zr_scene){
        .background = {1, 1, 1, 1},
        .ambient = {0.34f, 0.34f, 0.34f},
        .picture = {.side = 1, .line_width = 1.0f, .exposure = 1.0f, .crease_degrees = 180.0f},
        .light_count = sizeof LIGHTS / sizeof LIGHTS[0],
        .lights = LIGHTS,
        .views[0] = {.width = 640,
                     .height = 480,
                     .output_count = 1,
                     .outputs = &color,
                     .pose = ZR_POSE_PRESET,
                     .preset = ZR_PRESET_ISOMETRIC,
                     .up = {0, 1, 0},
                     .world_to_camera = zr_mat4_identity(),
                     .projection = ZR_PROJECTION_ORTHOGRAPHIC,
                     .projection_matrix = zr_mat4_identity(),
                     .fit_padding = ZR_FIT_PADDING},
    };
}

zr_vec3 zr_default_ambient_of_own_lights(void)
{
    return (zr_vec3){0.2f, 0.2f, 0.2f};
}

zr_vec4 zr_default_base_color(bool coloured)
{
    return coloured ? (zr_vec4){1, 1, 1, 1} : (zr_vec4){0.7f, 0.7f, 0.7f, 1};
}

enum zr_shading zr_default_shading(bool smooth)
{
    return smooth ? ZR_SHADING_GOURAUD : ZR_SHADING_FLAT;
}
