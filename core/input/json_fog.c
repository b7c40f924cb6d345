#include "input/json_scene.h"

enum { COLOR, NEAR, FAR, KEYS };
static const char *const words[] = {"color", "near", "far", "mode", "density"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static bool read_depth(struct zr_json *json, const struct zr_json_path *path, const cJSON *const *found, int key,
                       float *out)
{
    double depth;
    if (!found[key]) {
        zr_json_fault(json, path, "%s is missing: a depth in front of the camera", words[key]);
        return false;
    }
    if (!zr_json_number(json, ZR_JSON_KEY(path, words[key]), found[key], 0, (double)ZR_MATRIX_MAX, &depth))
        return false;
    *out = (float)depth;
    return true;
}

void zr_draft_read_fog(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node)
{
    struct zr_json *json = &draft->json;
    const cJSON *found[KEYS];
    zr_vec4 color = draft->scene->background;
    struct zr_fog fog = {.is_on = true};
    if (!zr_json_object(json, path, node, &keys, found)) return;
    if (found[COLOR] && !zr_json_color(json, ZR_JSON_KEY(path, words[COLOR]), found[COLOR], &color)) return;
    const bool has_near = read_depth(json, path, found, NEAR, &fog.near),
               has_far = read_depth(json, path, found, FAR, &fog.far);
    if (!has_near || !has_far) return;
    if (!(fog.near < fog.far)) {
        zr_json_fault(json, path, "near is %g and far %g: fog begins at near, and far must be farther",
                      (double)fog.near, (double)fog.far);
        return;
    }
    fog.color = (zr_vec3){color.x, color.y, color.z};
    draft->scene->fog = fog;
}
