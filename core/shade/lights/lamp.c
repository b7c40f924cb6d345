#include "shade/lights/lamp.h"

#include <math.h>

#include "base/trig.h"

/* Sets factor and term of the cosine from the cone of KHR_lights_punctual. Its bound 0.001 makes narrow cones
 * darker. */
static void set_cone(struct zr_lamp_place *place, const struct zr_light *light)
{
    double sine, inner, outer;
    zr_sine_cosine(light->inner_degrees, &sine, &inner);
    zr_sine_cosine(light->outer_degrees, &sine, &outer);
    const double difference = inner - outer, scale = 1.0 / (difference > 0.001 ? difference : 0.001);
    place->angle_scale = (float)scale;
    place->angle_offset = (float)(-outer * scale);
}

static zr_vec3 to_eye(const struct zr_light *light, const zr_mat4 *world_to_eye, zr_vec3 v, float w)
{
    if (light->camera_frame) return v;
    const zr_vec4 p = zr_mat4_apply(world_to_eye, (zr_vec4){v.x, v.y, v.z, w});
    return (zr_vec3){p.x, p.y, p.z};
}

static float largest_of(zr_vec3 color)
{
    const float two = color.x > color.y ? color.x : color.y;
    return two > color.z ? two : color.z;
}

struct zr_lamp_place zr_lamp_place_of(const struct zr_light *light, const struct zr_camera *camera)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    const float scale = zr_eye_scale_of(camera);
    struct zr_lamp_place place = {.angle_offset = 1.0f, .gain = scale * scale};
    place.position = to_eye(light, &camera->world_to_eye, light->position, 1.0f);
    if (eye.w != 0.0f) place.position = zr_vec3_sub(place.position, (zr_vec3){eye.x, eye.y, eye.z});
    if (light->range > 0.0f) {
        const double range = (double)light->range * (double)scale, end = 1.0 / (range * range);
        place.end = (float)fmin(end, 1e30);
    }
    const double least = (double)largest_of(light->color) * (double)place.gain / (double)ZR_LAMP_SHARE_MAX;
    place.least = (float)fmin(fmax(least, 1e-30), 1e30);
    if (light->type != ZR_LIGHT_SPOT) return place;
    set_cone(&place, light);
    place.axis = to_eye(light, &camera->world_to_eye, light->direction, 0.0f);
    place.axis = zr_vec3_normalize(zr_vec3_scale(place.axis, -1.0f));
    return place;
}
