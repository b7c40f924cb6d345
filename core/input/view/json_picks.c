/* Reads picks, a list of pixels, and distances, a list of pairs of parts. */
#include <string.h>

#include "input/scene/json_scene.h"

/* Reads [x, y]. */
static bool read_pixel(struct zr_json *json, const struct zr_json_path *path, uint32_t out[2])
{
    size_t number = 0;
    bool is_good = true;
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_any_item(json); number++)
        if (number < 2)
            is_good = zr_json_whole(json, ZR_JSON_ITEM(path, number), &out[number]) && is_good;
        else
            zr_json_skip(json);
    return (number == 2 || zr_json_fault(json, path, "%zu numbers; a pixel has 2, x and y", number)) && is_good;
}

bool zr_read_picks(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_pick_pixels *picks = &root->scene->views[0].picks;
    size_t count = 0, number = 0;
    bool is_good = true;
    picks->count = 0;
    uint32_t(*at)[2] = zr_json_enter_list(json, path, "picks", ZR_PICKS_MAX, sizeof *at, &count);
    if (!at) return false;
    for (; zr_json_item(json); number++)
        is_good = read_pixel(json, ZR_JSON_ITEM(path, number), at[number]) && is_good;
    picks->at = (const uint32_t(*)[2])at;
    picks->count = (uint32_t)count;
    return is_good;
}

/* Reads ["part", "other part"]. */
static bool read_pair(struct zr_json *json, const struct zr_json_path *path, struct zr_part_pair *out)
{
    size_t number = 0;
    bool is_good = true;
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_any_item(json); number++)
        if (number < 2)
            is_good = zr_json_string(json, ZR_JSON_ITEM(path, number), &out->parts[number]) && is_good;
        else
            zr_json_skip(json);
    if (number != 2) return zr_json_fault(json, path, "%zu names; a pair has 2", number);
    if (is_good && strcmp(out->parts[0], out->parts[1]) == 0)
        return zr_json_fault(json, path, "twice the same part, whose distance from itself is 0");
    return is_good;
}

bool zr_read_distances(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_scene *scene = root->scene;
    size_t count = 0, number = 0;
    bool is_good = true;
    scene->distance_count = 0;
    struct zr_part_pair *at = zr_json_enter_list(json, path, "pairs", ZR_DISTANCES_MAX, sizeof *at, &count);
    if (!at) return false;
    for (; zr_json_item(json); number++)
        is_good = read_pair(json, ZR_JSON_ITEM(path, number), &at[number]) && is_good;
    scene->distances = at;
    scene->distance_count = (uint32_t)count;
    return is_good;
}
