/* limits.c - settings as limits of the renderer, and as /v1/limits shows them. */
#include <ctype.h>

#include <cjson/cJSON.h>

#include "value.h"

enum { NAME_SIZE = 64 };

struct zr_limits config_limits(const struct config *config)
{
    struct zr_limits limits = zr_limits_default();
    limits.json_depth_max = (uint32_t)config->json_depth_max;
    limits.window_side_max = (uint32_t)config->window_side_max;
    limits.window_pixels_max = config->window_pixels_max;
    limits.polygon_vertices_max = (uint32_t)config->polygon_vertices_max;
    limits.instances_max = (uint32_t)config->instances_max;
    limits.image_pixels_max = config->image_pixels_max;
    limits.coordinate_max = (float)config->coordinate_max;
    limits.unpacked_bytes_max = config->body_max_bytes;
    return limits;
}

enum zr_isa config_isa(const struct config *config)
{
    enum zr_isa isa;
    return zr_isa_choose(config->isa, &isa) ? isa : zr_isa_best();
}

bool config_add_limits(const struct config *config, struct cJSON *object)
{
    const struct setting *s;
    for (size_t i = 0; (s = setting_at(i)); i++) {
        if (!s->is_limit) continue;
        char name[NAME_SIZE];
        size_t used = 0;
        for (const char *p = s->flag; *p && used < NAME_SIZE - 1; p++)
            name[used++] = *p == '-' && p[1] ? (char)toupper((unsigned char)*++p) : *p;
        name[used] = '\0';
        if (!cJSON_AddNumberToObject(object, name, (double)value_number(config, s))) return false;
    }
    return true;
}
