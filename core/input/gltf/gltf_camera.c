/* Reads cameras of glTF. Source: glTF 2.0, section 3.10. */
#include "input/gltf/gltf_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "input/text/names.h"

/* ---- projections ---- */

struct given_projection {
    float yfov, xmag, ymag, znear, zfar;
};
#define AT(member) offsetof(struct given_projection, member)

enum { YFOV, P_ZNEAR, P_ZFAR };
#define HALF_TURN 3.14159265358979323846
static const struct zr_json_field perspective_fields[] = {
    [YFOV] = {.key = "yfov",
              .read = zr_json_float,
              .offset = AT(yfov),
              .low = 1e-3,
              .high = HALF_TURN - 1e-3,
              .required = true,
              .text = "full angle of view, radians"},
    [P_ZNEAR] = {.key = "znear", .read = zr_json_positive, .offset = AT(znear), .required = true, .text = "near plane"},
    [P_ZFAR] = {.key = "zfar", .read = zr_json_positive, .offset = AT(zfar)},
    {.key = "aspectRatio", .read = zr_gltf_ignore},
    ZR_GLTF_COMMON};
static const struct zr_json_object perspective_object = ZR_JSON_OBJECT_OF("perspective", perspective_fields);

enum { XMAG, YMAG, O_ZNEAR, O_ZFAR };
static const struct zr_json_field orthographic_fields[] = {
    [XMAG] = {.key = "xmag", .read = zr_json_length, .offset = AT(xmag), .required = true, .text = "half width"},
    [YMAG] = {.key = "ymag", .read = zr_json_length, .offset = AT(ymag), .required = true, .text = "half height"},
    [O_ZNEAR] = {.key = "znear", .read = zr_json_length, .offset = AT(znear), .required = true, .text = "near plane"},
    [O_ZFAR] = {.key = "zfar", .read = zr_json_length, .offset = AT(zfar), .required = true, .text = "far plane"},
    ZR_GLTF_COMMON};
static const struct zr_json_object orthographic_object = ZR_JSON_OBJECT_OF("orthographic", orthographic_fields);
#undef AT

/* ---- cameras ---- */

struct given_camera {
    const char *name, *perspective, *orthographic; /* the last two are places */
};
enum { NAME, PERSPECTIVE, ORTHOGRAPHIC };
#define AT(member) offsetof(struct given_camera, member)
static const struct zr_json_field fields[] = {
    [NAME] = {.key = "name", .read = zr_json_string, .offset = AT(name)},
    [PERSPECTIVE] = {.key = "perspective", .read = zr_json_value_start, .offset = AT(perspective)},
    [ORTHOGRAPHIC] = {.key = "orthographic", .read = zr_json_value_start, .offset = AT(orthographic)},
    {.key = "type", .read = zr_gltf_ignore},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("camera", fields);

static void check_planes(struct zr_json *json, const struct zr_json_path *path, const struct zr_model_camera *camera)
{
    if (camera->has_zfar && camera->zfar <= camera->znear)
        zr_json_fault(json, path, "zfar is %.9g and znear %.9g", (double)camera->zfar, (double)camera->znear);
}

static void read_projection(struct zr_gltf *file, const struct zr_json_path *path, const struct given_camera *given,
                            struct zr_model_camera *camera)
{
    struct zr_json *json = &file->json;
    struct given_projection projection = {1, 1, 1, 1, 2};
    const size_t faults = json->error->count;
    const int key = given->perspective ? PERSPECTIVE : ORTHOGRAPHIC;
    if (!given->perspective && !given->orthographic) {
        zr_json_fault(json, path, "perspective or orthographic is needed");
        return;
    }
    zr_gltf_fields_at(file, given->perspective ? given->perspective : given->orthographic,
                      ZR_JSON_KEY(path, fields[key].key),
                      given->perspective ? &perspective_object : &orthographic_object, &projection);
    *camera = (struct zr_model_camera){.name = camera->name,
                                       .number = camera->number,
                                       .is_perspective = given->perspective != NULL,
                                       .yfov_radians = given->perspective ? projection.yfov : 0.0f,
                                       .xmag = given->perspective ? 0.0f : fabsf(projection.xmag),
                                       .ymag = given->perspective ? 0.0f : fabsf(projection.ymag),
                                       .has_zfar = zr_json_gives(file->given, given->perspective ? P_ZFAR : O_ZFAR),
                                       .znear = projection.znear,
                                       .zfar = projection.zfar};
    if (!given->perspective && !(camera->xmag > 0.0f && camera->ymag > 0.0f))
        zr_json_fault(json, ZR_JSON_KEY(path, fields[key].key), "xmag and ymag must not be 0");
    if (json->error->count == faults) check_planes(json, ZR_JSON_KEY(path, fields[key].key), camera);
}

/* A camera with a fault is refused only where it is asked for. */
static void read_camera(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct zr_model_camera *camera = &file->cameras[number];
    struct given_camera given = {"", NULL, NULL};
    struct zr_error *const error = json->error, faults = {.count = 0};
    zr_gltf_fields(file, json, path, &object, &given);
    *camera = (struct zr_model_camera){.name = given.name, .number = number};
    file->json.error = &faults;
    read_projection(file, path, &given, camera);
    file->json.error = error;
    if (faults.count == 0) return;
    zr_gltf_note(&file->bad_cameras, path);
    const struct zr_error_item *first = &faults.items[0];
    const size_t room = strlen(first->pointer) + strlen(first->detail) + 3;
    char *fault = zr_arena_alloc(file->json.arena, room, 1);
    if (fault) snprintf(fault, room, "%s: %s", first->pointer, first->detail);
    camera->fault = fault;
}

bool zr_gltf_read_cameras(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    const uint32_t count = file->counts[ZR_GLTF_CAMERAS];
    file->cameras = zr_arena_zero(arena, count, sizeof *file->cameras);
    file->placed_cameras = zr_arena_zero(arena, count, sizeof *file->placed_cameras);
    return zr_arena_ok(arena) && zr_gltf_read_list(file, ZR_GLTF_CAMERAS, read_camera);
}

void zr_gltf_place_camera(struct zr_gltf *file, uint32_t camera, const char *name, const zr_mat4 *camera_to_world)
{
    struct zr_model_camera *placed = &file->cameras[camera];
    if (file->placed_cameras[camera]) return;
    file->placed_cameras[camera] = true;
    placed->camera_to_world = *camera_to_world;
    if (!*placed->name && name) placed->name = name;
}

void zr_gltf_keep_cameras(struct zr_gltf *file)
{
    struct zr_model_scene *made = file->made;
    made->cameras = file->cameras;
    for (uint32_t i = 0; i < file->counts[ZR_GLTF_CAMERAS]; i++)
        if (file->placed_cameras[i]) made->cameras[made->camera_count++] = file->cameras[i];
}
