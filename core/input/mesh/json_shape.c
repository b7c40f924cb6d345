/* Reads shapes: bodies that a few numbers describe. */
#include <string.h>

#include "input/mesh/parsed_mesh.h"
#include "input/scene/json_objects.h"

static const char *const types[] = {
    [ZR_SHAPE_BOX] = "box",   [ZR_SHAPE_SPHERE] = "sphere", [ZR_SHAPE_CYLINDER] = "cylinder",
    [ZR_SHAPE_CONE] = "cone", [ZR_SHAPE_TORUS] = "torus",   [ZR_SHAPE_EXTRUSION] = "extrusion"};
static const struct zr_names type_names = ZR_NAMES(ZR_SHAPE_TYPES, types);

/* double: a length, more than 0. */
static bool read_length(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    float length;
    if (!zr_json_positive(json, path, &length)) return false;
    *(double *)out = (double)length;
    return true;
}

/* double[3]: a length along each axis, more than 0; or one for all axes. */
static bool read_size(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double *size = out, read[3];
    if (zr_json_type(json) == ZR_JSON_NUMBER) {
        if (!read_length(json, path, read)) return false;
        size[0] = size[1] = size[2] = read[0];
        return true;
    }
    if (!zr_json_numbers(json, path, (struct zr_json_row){3, 3, 0, (double)json->limits->coordinate_max}, read, NULL))
        return false;
    for (size_t axis = 0; axis < 3; axis++)
        if (!((float)read[axis] > 0.0f))
            return zr_json_fault(json, ZR_JSON_ITEM(path, axis), "%.9g; a length is more than 0", read[axis]);
    memcpy(size, read, sizeof read);
    return true;
}

/* double: a length or 0. */
static bool read_top(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_number_in(json, path, 0.0, (double)json->limits->coordinate_max, out);
}

/* uint32_t */
static bool read_segments(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint32_t segments;
    if (!zr_json_whole(json, path, &segments)) return false;
    if (segments < ZR_SHAPE_SEGMENTS_LEAST || segments > ZR_SHAPE_SEGMENTS_MAX)
        return zr_json_fault(json, path, "%u segments; %d to %d are allowed", segments, ZR_SHAPE_SEGMENTS_LEAST,
                             ZR_SHAPE_SEGMENTS_MAX);
    *(uint32_t *)out = segments;
    return true;
}

/* struct zr_shape_desc: its points. */
static bool read_points(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_shape_desc *shape = out;
    const double limit = (double)json->limits->coordinate_max;
    size_t count, number = 0;
    if (!zr_json_list(json, path) || !zr_json_count(json, path, &count)) return false;
    if (count < 3 || count > ZR_SHAPE_POINTS_MAX)
        return zr_json_skip(json) &&
               zr_json_fault(json, path, "%zu points; 3 to %d are allowed", count, ZR_SHAPE_POINTS_MAX);
    double(*points)[2] = zr_arena_zero(json->arena, count, sizeof *points);
    bool is_good = points != NULL;
    if (!points) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); number++)
        is_good = zr_json_numbers(json, ZR_JSON_ITEM(path, number), (struct zr_json_row){2, 2, -limit, limit},
                                  points[number], NULL) &&
                  is_good;
    if (!is_good) return false;
    shape->points = points;
    shape->count = (uint32_t)count;
    return true;
}

enum { TYPE, SIZE, RADIUS, TOP, TUBE, HEIGHT, POINTS, SEGMENTS };
#define OF(type)   (1u << ZR_SHAPE_##type)
#define AT(member) offsetof(struct zr_shape_desc, member)
#define ROUND      (OF(SPHERE) | OF(CYLINDER) | OF(CONE) | OF(TORUS))
#define TALL       (OF(CYLINDER) | OF(CONE) | OF(EXTRUSION))
static const struct zr_json_field fields[] = {
    [TYPE] = {"type", zr_json_choice, AT(type), .words = &type_names, .required = true, .text = "kind of body"},
    [SIZE] = {"size", read_size, AT(size), .unit = "scene units", .of = OF(BOX), .required_of = OF(BOX),
              .text = "box: length along each axis, or one for all",
              .schema = ZR_SCHEMA({
                  "anyOf" : [
                      {"type" : "number", "exclusiveMinimum" : 0}, {
                          "type" : "array",
                          "items" : {"type" : "number", "exclusiveMinimum" : 0},
                          "minItems" : 3,
                          "maxItems" : 3
                      }
                  ]
              })},
    [RADIUS] = {"radius", read_length, AT(radius), .unit = "scene units", .of = ROUND, .required_of = ROUND,
                .text = "radius; cone: at the bottom; torus: of the circle in the middle of its tube",
                .schema = ZR_SCHEMA({"type" : "number", "exclusiveMinimum" : 0})},
    [TOP] = {"top", read_top, AT(top), .unit = "scene units", .otherwise = "0", .of = OF(CONE),
             .text = "cone: radius at the top", .schema = ZR_SCHEMA({"type" : "number", "minimum" : 0})},
    [TUBE] = {"tube", read_length, AT(tube), .unit = "scene units", .of = OF(TORUS), .required_of = OF(TORUS),
              .text = "torus: radius of its tube, less than radius",
              .schema = ZR_SCHEMA({"type" : "number", "exclusiveMinimum" : 0})},
    [HEIGHT] = {"height", read_length, AT(height), .unit = "scene units", .of = TALL, .required_of = TALL,
                .text = "cylinder, cone, extrusion: length along z, half of it above z = 0",
                .schema = ZR_SCHEMA({"type" : "number", "exclusiveMinimum" : 0})},
    [POINTS] = {"points", read_points, 0, .unit = "scene units", .of = OF(EXTRUSION), .required_of = OF(EXTRUSION),
                .text = "extrusion: corners [x,y] of its polygon, in either direction",
                .schema = ZR_SCHEMA({
                    "type" : "array",
                    "items" : {"type" : "array", "items" : {"type" : "number"}, "minItems" : 2, "maxItems" : 2},
                    "minItems" : 3
                })},
    [SEGMENTS] = {"segments", read_segments, AT(segments), .otherwise = "64", .of = ROUND,
                  .text = "sphere, cylinder, cone, torus: sides around the axis, and around the tube",
                  .schema = ZR_SCHEMA({"type" : "integer", "minimum" : 3, "maximum" : 512})}};
#undef OF
#undef AT
#undef ROUND
#undef TALL
const struct zr_json_object zr_json_object_shape = {ZR_JSON_FIELDS("shape", fields), .has_types = true};

bool zr_read_shape(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_shape_desc shape = {.type = -1, .segments = 64};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_shape, &shape, &keys) || zr_json_failed_since(json, faults))
        return false;
    if (shape.type == ZR_SHAPE_TORUS && !(shape.tube < shape.radius))
        return zr_json_fault(json, ZR_JSON_KEY(path, fields[TUBE].key), "%.9g; less than the radius, %.9g, is needed",
                             shape.tube, shape.radius);
    if (shape.type == ZR_SHAPE_EXTRUSION && !(zr_shape_area(&shape) != 0.0))
        return zr_json_fault(json, ZR_JSON_KEY(path, fields[POINTS].key), "the polygon has no area");
    *(struct zr_shape_desc *)out = shape;
    return true;
}
