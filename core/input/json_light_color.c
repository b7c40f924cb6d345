/* Colours of light. Numbers are linear light. A text, such as "#808080", is sRGB-encoded and is decoded if light is
 * linear. That depends on all materials, so a text's components are stored negated until then. */
#include <math.h>

#include "base/srgb.h"
#include "base/team.h"
#include "input/json_scene.h"

/* Components of a text are bytes. */
enum { LAST = 255, RAMP_ROOM = 16 };

bool zr_read_light_color(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                         void *out)
{
    const bool is_text = zr_json_type(json) == ZR_JSON_STRING;
    zr_vec4 *color = out;
    if (!zr_json_color(json, path, field, out)) return false;
    if (is_text) *color = (zr_vec4){-color->x, -color->y, -color->z, color->w};
    return true;
}

static float linear_part(const float *ramp, float part)
{
    return part < 0.0f ? ramp[lrintf(-part * (float)LAST)] : part;
}

zr_vec3 zr_light_color(zr_vec3 given, bool is_linear)
{
    float ramp[LAST + RAMP_ROOM];
    if (!is_linear || !(given.x < 0.0f || given.y < 0.0f || given.z < 0.0f))
        return (zr_vec3){fabsf(given.x), fabsf(given.y), fabsf(given.z)};
    zr_srgb_ramp_of(zr_team_isa(NULL))(LAST, ramp);
    return (zr_vec3){linear_part(ramp, given.x), linear_part(ramp, given.y), linear_part(ramp, given.z)};
}

void zr_parsed_decode_light(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const bool is_linear = scene->picture.is_linear;
    for (uint32_t i = 0; is_linear && zr_scene_gives(root, ZR_SCENE_LIGHTS) && i < root->light_count; i++) {
        const struct zr_parsed_light_colors *given = &root->light_colors[i];
        root->lights[i].color = zr_vec3_scale(zr_light_color(given->color, true), given->intensity);
        root->lights[i].ground = zr_vec3_scale(zr_light_color(given->ground, true), given->intensity);
    }
    scene->ambient = zr_light_color(scene->ambient, is_linear);
    for (uint32_t i = 0; i < scene->material_count; i++)
        root->builder->materials[i].specular = zr_light_color(root->builder->materials[i].specular, is_linear);
}
