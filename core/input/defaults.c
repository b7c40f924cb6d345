#include "input/defaults.h"

void zr_look_dress(const struct zr_look *look, struct zr_scene *scene)
{
    scene->look = look;
    scene->picture = look->picture;
    scene->background = look->background;
    scene->ambient = look->ambient;
    scene->light_count = look->light_count;
    scene->lights = look->lights;
}

void zr_view_set_fov(struct zr_view *view, float radians)
{
    const bool is_upright = view->width < view->height;
    view->xfov_radians = is_upright ? radians : 0.0f;
    view->yfov_radians = is_upright ? 0.0f : radians;
}

void zr_look_aim(const struct zr_look *look, struct zr_view *view)
{
    const struct zr_look_view *from = &look->view;
    view->pose = from->pose;
    view->preset = from->preset;
    view->azimuth_degrees = from->azimuth_degrees;
    view->elevation_degrees = from->elevation_degrees;
    view->up = (zr_vec3){0, 1, 0};
    view->projection = from->projection;
    view->fit_padding = from->padding;
    zr_view_set_fov(view, from->fov_radians);
}

void zr_scene_defaults(struct zr_scene *scene)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    *scene = (struct zr_scene){
        .views[0] = {.width = 640,
                     .height = 480,
                     .output_count = 1,
                     .outputs = &color,
                     .world_to_camera = zr_mat4_identity(),
                     .projection_matrix = zr_mat4_identity()},
    };
    zr_look_dress(zr_look_textbook, scene);
    zr_look_aim(zr_look_textbook, &scene->views[0]);
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
