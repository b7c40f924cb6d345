/* A view is one pose and one projection. Two of a kind are refused by name: to
 * follow one and drop the other would draw a wrong picture without a word. */
#include "input/json_view.h"

#include <string.h>

#include "input/json_scene.h"
#include "input/text.h"

const char *const zr_view_words[] = {"eye",
                                     "target",
                                     "up",
                                     "preset",
                                     "direction",
                                     "azimuthDegrees",
                                     "elevationDegrees",
                                     "distance",
                                     "cameraToWorld",
                                     "worldToCamera",
                                     "R",
                                     "t",
                                     "convention",
                                     "perspective",
                                     "orthographic",
                                     "intrinsics",
                                     "K",
                                     "pixelCenter",
                                     "projectionMatrix",
                                     "znear",
                                     "zfar",
                                     "fit",
                                     "name",
                                     "window"};
static const struct zr_names keys = ZR_NAMES(ZR_VIEW_KEYS, zr_view_words);

enum { PADDING, MESH, FIT_KEYS };
static const char *const fit_words[] = {"padding", "mesh"};
static const struct zr_names fit_keys = ZR_NAMES(FIT_KEYS, fit_words);

static bool read_row(struct zr_json *json, const struct zr_json_path *path, const cJSON *list, double limit,
                     size_t count, double *out)
{
    bool good = true;
    size_t i = 0;
    for (const cJSON *item = list->child; item; item = item->next, i++)
        if (i < count) good = zr_json_number(json, ZR_JSON_ITEM(path, i), item, -limit, limit, &out[i]) && good;
    if (i != count) return zr_json_fault(json, path, "expected %zu numbers, found %zu", count, i);
    return good;
}

bool zr_view_read_rows(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, double limit,
                       double out[9])
{
    size_t count, length;
    if (!zr_json_array(json, path, node, &count)) return false;
    if (!cJSON_IsArray(node->child)) return read_row(json, path, node, limit, 9, out);
    if (count != 3) return zr_json_fault(json, path, "expected 3 rows, found %zu", count);
    bool good = true;
    size_t i = 0;
    for (const cJSON *row = node->child; row; row = row->next, i++) {
        const struct zr_json_path *at = ZR_JSON_ITEM(path, i);
        good = zr_json_array(json, at, row, &length) && read_row(json, at, row, limit, 3, &out[3 * i]) && good;
    }
    return good;
}

static bool read_plane(struct zr_view_reader *reader, enum zr_view_key key, float *out)
{
    const cJSON *node = reader->found[key];
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, key);
    if (!node) return false;
    switch (reader->view->projection) {
    case ZR_PROJECTION_MATRIX:
        return zr_json_fault(reader->json, path, "projectionMatrix has planes of its own");
    case ZR_PROJECTION_ORTHOGRAPHIC:
        return zr_json_length(reader->json, path, node, out);
    case ZR_PROJECTION_PERSPECTIVE:
    case ZR_PROJECTION_INTRINSICS:
        break;
    }
    return zr_json_positive(reader->json, path, node, out);
}

static void read_planes(struct zr_view_reader *reader)
{
    struct zr_view *view = reader->view;
    view->has_znear = read_plane(reader, ZR_VIEW_ZNEAR, &view->znear);
    view->has_zfar = read_plane(reader, ZR_VIEW_ZFAR, &view->zfar);
    if (view->has_znear && view->has_zfar && !(view->znear < view->zfar))
        zr_json_fault(reader->json, ZR_VIEW_PATH(reader, ZR_VIEW_ZFAR), "%.9g is not beyond znear, %.9g",
                      (double)view->zfar, (double)view->znear);
}

/* All but which mesh is meant: no mesh has been read yet. */
static void read_fit(struct zr_view_reader *reader)
{
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_FIT);
    const cJSON *found[FIT_KEYS];
    const char *name;
    double padding;
    if (!zr_json_object(reader->json, path, reader->found[ZR_VIEW_FIT], &fit_keys, found)) return;
    if (found[MESH]) zr_json_string(reader->json, ZR_JSON_KEY(path, fit_words[MESH]), found[MESH], &name);
    if (!found[PADDING]) return;
    if (zr_json_number(reader->json, ZR_JSON_KEY(path, fit_words[PADDING]), found[PADDING], 0, 0.45, &padding))
        reader->view->fit_padding = (float)padding;
}

void zr_draft_read_view(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node)
{
    struct zr_view_reader reader = {.json = &draft->json, .path = path, .view = &draft->scene->views[0]};
    if (!zr_json_object(reader.json, path, node, &keys, reader.found)) return;
    zr_view_read_pose(&reader);
    zr_view_read_projection(&reader);
    read_planes(&reader);
    if (reader.found[ZR_VIEW_FIT]) read_fit(&reader);
}

void zr_draft_find_fit_mesh(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node)
{
    const struct zr_scene *scene = draft->scene;
    struct zr_view *view = &draft->scene->views[0];
    const struct zr_json_path *fit_path = ZR_JSON_KEY(path, zr_view_words[ZR_VIEW_FIT]);
    const cJSON *fit = cJSON_GetObjectItemCaseSensitive(node, zr_view_words[ZR_VIEW_FIT]);
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(fit, fit_words[MESH]));
    if (!name) return;
    const struct zr_json_path *at = ZR_JSON_KEY(fit_path, fit_words[MESH]);
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        if (*name == '\0' || strcmp(scene->meshes[i].name, name) != 0) continue;
        if (view->fit_to_mesh) {
            zr_json_fault(&draft->json, at, "two meshes have the name %s: %u and %u", zr_quote(name, strlen(name)).text,
                          view->fit_mesh, i);
            return;
        }
        view->fit_to_mesh = true;
        view->fit_mesh = i;
    }
    if (!view->fit_to_mesh) zr_json_fault(&draft->json, at, "no mesh is named %s", zr_quote(name, strlen(name)).text);
}
