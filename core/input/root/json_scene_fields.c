/* The keys of a scene. */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "scene/parsed_picture.h"

#define EXPOSURE_MAX 1e6

/* uint32_t: the only version is 1. */
static bool read_version(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint32_t number;
    (void)out;
    if (!zr_json_whole(json, path, &number)) return false;
    return number == 1 || zr_json_fault(json, path, "%u; this is version 1 of the contract", number);
}

static bool read_render(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    bool is_drawn = true;
    if (!zr_json_bool(json, path, &is_drawn)) return false;
    root->scene->is_undrawn = !is_drawn;
    return true;
}

static bool read_visibility(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    return zr_json_bool(json, path, &root->scene->views[0].has_visibility);
}

static bool read_features(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    return zr_json_bool(json, path, &root->scene->has_features);
}

#define AT(member)      offsetof(struct zr_parsed_scene, member)
#define PICTURE(member) offsetof(struct zr_parsed_picture, given.member)
#define IN_PICTURE      .through = AT(picture)
const struct zr_json_field zr_scene_fields[] = {
    [ZR_SCENE_VERSION] = {"version", read_version, 0, .otherwise = "1", .text = "version of the contract",
                          .schema = ZR_SCHEMA({"const" : 1})},
    [ZR_SCENE_WINDOW] = {"window", zr_read_window, 0, .object = &zr_json_object_window, .text = "size of the picture"},
    [ZR_SCENE_LOOK] = {"look", zr_read_look, 0, .otherwise = "textbook",
                       .text = "defaults of the scene, by name; NAME@VERSION pins a version"},
    [ZR_SCENE_BACKGROUND] = {"background", zr_read_background, 0, .object = &zr_json_object_gradient,
                             .otherwise = "the look's; white",
                             .text = "colour of uncovered pixels, or the top and bottom colours of a gradient",
                             .schema =
                                 ZR_SCHEMA({"anyOf" : [ {"$ref" : "#/$defs/color"}, {"$ref" : "#/$defs/gradient"} ]})},
    [ZR_SCENE_VIEW] = {"view", zr_read_view, 0, .object = &zr_json_object_view, .otherwise = "the look's",
                       .text = "pose and projection of the camera: the name of a preset, or an object",
                       .schema = ZR_SCHEMA(
                           {"anyOf" : [ {"$ref" : "#/$defs/view/properties/preset"}, {"$ref" : "#/$defs/view"} ]})},
    [ZR_SCENE_UP] = {"up", zr_read_up, PICTURE(z_is_up), IN_PICTURE, .words = &zr_up_names, .otherwise = "y",
                     .text = "axis that points up, for views, environment and ground"},
    [ZR_SCENE_AMBIENT] = {"ambient", zr_read_light_color, AT(ambient),
                          .text = "ambient light: equal from all directions"},
    [ZR_SCENE_LIGHTS] = {"lights", zr_read_lights, 0, .object = &zr_json_object_light, .otherwise = "the look's",
                         .text = "list of lights",
                         .schema =
                             ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/light"}, "maxItems" : 1024})},
    [ZR_SCENE_ENVIRONMENT] = {"environment", zr_read_environment, 0, .object = &zr_json_object_environment,
                              .otherwise = "the look's; false",
                              .text = "light from all around for the shading pbr: a name, a Radiance picture (.hdr), an "
                                      "object or false",
                              .schema = ZR_SCHEMA({
                                  "anyOf" : [
                                      {"const" : false}, {"$ref" : "#/$defs/environment/properties/name"},
                                      {"type" : "string", "pattern" : "[.]hdr$|^data:|^sha256:"},
                                      {"$ref" : "#/$defs/environment"}
                                  ]
                              })},
    [ZR_SCENE_MATERIALS] = {"materials", zr_read_materials, 0, .object = &zr_json_object_material,
                            .words = &zr_file_material_names, .otherwise = "[]",
                            .text = "materials that meshes and polygons refer to by name; or keep: model files keep "
                                    "theirs in looks that are a material",
                            .schema = ZR_SCHEMA({
                                "anyOf" : [
                                    {"enum" : [ "look", "keep" ]},
                                    {"type" : "array", "items" : {"$ref" : "#/$defs/material"}}
                                ]
                            })},
    [ZR_SCENE_MESHES] = {"meshes", zr_read_meshes, 0, .object = &zr_json_object_mesh, .otherwise = "[]",
                         .text = "list of meshes: faces, lines and points, or a grid of heights",
                         .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/mesh"}})},
    [ZR_SCENE_POLYGONS] = {"polygons", zr_read_polygons, 0, .object = &zr_json_object_polygon, .otherwise = "[]",
                           .text = "list of polygons, each with its own vertices",
                           .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/polygon"}})},
    [ZR_SCENE_OUTPUTS] = {"outputs", zr_read_outputs, 0, .object = &zr_json_object_output,
                          .otherwise = "a colour image", .text = "list of images and data to return",
                          .schema =
                              ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/output"}, "minItems" : 1})},
    [ZR_SCENE_COLOR_MANAGEMENT] = {"colorManagement", zr_json_choice, AT(color_management),
                                   .words = &zr_management_names, .otherwise = "srgb if a key needs it, else none",
                                   .text =
                                       "space of computations with colours: none (as given) or srgb (linear light)"},
    [ZR_SCENE_TONE_MAPPING] = {"toneMapping", zr_json_choice, PICTURE(tone), IN_PICTURE, .words = &zr_tone_names,
                               .otherwise = "the look's; none",
                               .text = "tone curve, which compresses values brighter than white"},
    [ZR_SCENE_EXPOSURE] = {"exposure", zr_json_float, PICTURE(exposure), 0, EXPOSURE_MAX, IN_PICTURE,
                           .otherwise = "the look's; 1", .text = "factor of all light, before tone mapping"},
    [ZR_SCENE_SAMPLES] = {"samples", zr_read_samples, 0, 1, 64, .words = &zr_sample_names, .otherwise = "the look's; 1",
                          .text = "samples per pixel: 1, 4, 16 or 64",
                          .schema = ZR_SCHEMA({"enum" : [ 1, 4, 16, 64 ]})},
    [ZR_SCENE_LINE_WIDTH] = {"lineWidth", zr_json_float, PICTURE(line_width), 0.1, 64, IN_PICTURE, .unit = "pixels",
                             .otherwise = "1", .text = "width of lines and outlines"},
    [ZR_SCENE_OCCLUSION] = {"occlusion", zr_read_occlusion, 0, .object = &zr_json_object_occlusion,
                            .otherwise = "the look's; false",
                            .text = "less ambient light in creases and holes: true, false or an object",
                            .schema = ZR_SCHEMA({"anyOf" : [ {"type" : "boolean"}, {"$ref" : "#/$defs/occlusion"} ]})},
    [ZR_SCENE_GROUND_SHADOW] = {"groundShadow", zr_json_bool, PICTURE(has_ground), IN_PICTURE,
                                .otherwise = "the look's; false", .text = "soft shadow on the plane under the scene"},
    [ZR_SCENE_EDGES] = {"edges", zr_read_edges, 0, .object = &zr_json_object_edges, .otherwise = "the look's; false",
                        .text = "lines along silhouettes and creases: true, false or an object",
                        .schema = ZR_SCHEMA({"anyOf" : [ {"type" : "boolean"}, {"$ref" : "#/$defs/edges"} ]})},
    [ZR_SCENE_CREASE_DEGREES] = {"creaseDegrees", zr_json_float, PICTURE(crease_degrees), 0, 180, IN_PICTURE,
                                 .unit = "degrees", .otherwise = "the look's; 180",
                                 .text = "largest angle between faces that share computed normals"},
    [ZR_SCENE_ALGORITHM] = {"algorithm", zr_json_choice, AT(algorithm), .words = &zr_algorithm_names,
                            .otherwise = "halfspace", .text = "visibility algorithm; all give the same picture"},
    [ZR_SCENE_BASE] = {"base", zr_json_value_start, AT(base), .object = &zr_json_object_base,
                       .text = "picture to draw into"},
    [ZR_SCENE_NODES] = {"nodes", zr_json_value_start, AT(nodes), .object = &zr_json_object_node,
                        .otherwise = "each mesh once, untransformed", .text = "list of nodes, which place meshes",
                        .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/node"}})},
    [ZR_SCENE_FOG] = {"fog", zr_read_fog, 0, .object = &zr_json_object_fog, .text = "fading of colours with depth"},
    [ZR_SCENE_COLOR_BAR] = {"colorBar", zr_read_color_bar, 0, .object = &zr_json_object_colorBar, .otherwise = "false",
                            .text = "colour bar with numbers over the picture: true, false or an object",
                            .schema = ZR_SCHEMA({"anyOf" : [ {"type" : "boolean"}, {"$ref" : "#/$defs/colorBar"} ]})},
    [ZR_SCENE_ANNOTATE] = {"annotate", zr_read_annotate, 0, .otherwise = "[]",
                           .text = "marks over the picture: dimensions of the box, title, triad of axes, scale bar, "
                                   "labels of parts, notes of holes",
                           .schema = ZR_SCHEMA({
                               "type" : "array",
                               "items" : {"enum" : [ "box", "title", "triad", "scale", "labels", "holes" ]}
                           })},
    [ZR_SCENE_TITLE] = {"title", zr_read_title, 0, .otherwise = "the model's name",
                        .text = "text of the title line, which annotate draws",
                        .schema = ZR_SCHEMA({"type" : "string"})},
    [ZR_SCENE_DIMENSIONS] = {"dimensions", zr_read_dimensions, 0, .object = &zr_json_object_dimension,
                             .otherwise = "[]", .text = "dimensions between places, drawn over the picture",
                             .schema = ZR_SCHEMA({
                                 "type" : "array",
                                 "items" : {"$ref" : "#/$defs/dimension"},
                                 "maxItems" : 64
                             })},
    [ZR_SCENE_MARKS] = {"marks", zr_read_marks, 0, .object = &zr_json_object_mark, .otherwise = "[]",
                        .text = "numbers or short texts at places, drawn over the picture",
                        .schema = ZR_SCHEMA({
                            "type" : "array",
                            "items" : {"$ref" : "#/$defs/mark"},
                            "maxItems" : 64
                        })},
    [ZR_SCENE_RENDER] = {"render", read_render, 0, .otherwise = "true",
                         .text = "false: only facts, by the output info; nothing is drawn",
                         .schema = ZR_SCHEMA({"type" : "boolean"})},
    [ZR_SCENE_VISIBILITY] = {"visibility", read_visibility, 0, .otherwise = "false",
                             .text = "pixels of each instance, drawn alone and visible, in the list visibility of info",
                             .schema = ZR_SCHEMA({"type" : "boolean"})},
    [ZR_SCENE_FEATURES] = {"features", read_features, 0, .otherwise = "false",
                           .text = "holes, bosses, fillets and planes of each part, in the object features of info",
                           .schema = ZR_SCHEMA({"type" : "boolean"})},
    [ZR_SCENE_PICKS] = {"picks", zr_read_picks, 0, .otherwise = "[]",
                        .text = "pixels whose surfaces info describes: part, face, feature, point, normal, and the surfaces "
                                "behind; and distances from each pick to the next",
                        .schema = ZR_SCHEMA({
                            "type" : "array",
                            "items" : {
                                "type" : "array",
                                "items" : {"type" : "integer", "minimum" : 0},
                                "minItems" : 2,
                                "maxItems" : 2
                            },
                            "maxItems" : 64
                        })},
    [ZR_SCENE_DISTANCES] = {"distances", zr_read_distances, 0, .otherwise = "[]",
                            .text = "pairs of parts, by name: info lists their least distance and both places",
                            .schema = ZR_SCHEMA({
                                "type" : "array",
                                "items" : {
                                    "type" : "array",
                                    "items" : {"type" : "string"},
                                    "minItems" : 2,
                                    "maxItems" : 2
                                },
                                "maxItems" : 64
                            })},
    [ZR_SCENE_HIDE] = {"hide", zr_read_hide, 0, .otherwise = "[]",
                       .text = "parts that are not drawn: a name, a pattern with * and ?, an id, or a list of these",
                       .schema = ZR_SCHEMA_OF("parts")},
    [ZR_SCENE_ISOLATE] = {"isolate", zr_read_isolate, 0, .otherwise = "all parts",
                          .text = "the only parts that are drawn, given as in hide", .schema = ZR_SCHEMA_OF("parts")},
    [ZR_SCENE_GHOST] = {"ghost", zr_read_ghost, 0, .otherwise = "[]", .text = "translucent parts, given as in hide",
                        .schema = ZR_SCHEMA_OF("parts")},
    [ZR_SCENE_HIGHLIGHT] = {"highlight", zr_read_highlight, 0, .object = &zr_json_object_highlight, .otherwise = "[]",
                            .text = "parts in one colour, given as in hide, or objects with colours",
                            .schema = ZR_SCHEMA({
                                "anyOf" : [
                                    {"$ref" : "#/$defs/parts"}, {"$ref" : "#/$defs/highlight"}, {
                                        "type" : "array",
                                        "items" :
                                            {"anyOf" : [ {"$ref" : "#/$defs/parts"}, {"$ref" : "#/$defs/highlight"} ]},
                                        "contains" : {"type" : "object"},
                                        "maxItems" : 64
                                    }
                                ]
                            })},
    [ZR_SCENE_EXPLODE] =
        {"explode", zr_read_explode, 0, .object = &zr_json_object_explode, .otherwise = "0",
         .text = "exploded view: a factor or an object",
         .schema =
             ZR_SCHEMA({"anyOf" : [ {"$ref" : "#/$defs/explode/properties/factor"}, {"$ref" : "#/$defs/explode"} ]})},
    [ZR_SCENE_COLORS] =
        {"colors", zr_read_colors, 0, .words = &zr_part_color_names, .otherwise = "own",
         .text = "own: colours of the model; parts: one per part, by its name; materials: base colours with the file's "
                 "numbers; x, y, z: by position"},
    [ZR_SCENE_SECTIONS] = {"sections", zr_read_sections, 0, .object = &zr_json_object_sections, .otherwise = "none",
                           .text = "planes that cut the scene open"},
    [ZR_SCENE_CSG] = {"csg", zr_read_csg, 0, .object = &zr_json_object_csg, .otherwise = "none",
                      .text = "closed parts combined: a tree of unions, differences and intersections"},
    [ZR_SCENE_VIEWS] = {"views", zr_read_views, 0, .object = &zr_json_object_views, .otherwise = "the scene's one view",
                        .text = "several views: presets by name, or objects with the keys that a view changes",
                        .schema = ZR_SCHEMA_OF("viewList")},
    [ZR_SCENE_TURNTABLE] = {"turntable", zr_read_turntable, 0, .object = &zr_json_object_turntable,
                            .text = "several views: the camera turns once around the scene"},
    [ZR_SCENE_ORBIT] = {"orbit", zr_read_orbit, 0, .object = &zr_json_object_orbit,
                        .text = "several views: from all directions"},
    [ZR_SCENE_SHEET] = {"sheet", zr_read_sheet, 0, .object = &zr_json_object_sheet, .otherwise = "false",
                        .text = "one picture of all views: a layout, or an object",
                        .schema = ZR_SCHEMA(
                            {"anyOf" : [ {"$ref" : "#/$defs/sheet/properties/layout"}, {"$ref" : "#/$defs/sheet"} ]})},
    [ZR_SCENE_ANIMATE] = {"animate", zr_read_animate, 0, .object = &zr_json_object_animate,
                          .text = "several views: frames of nodes that move"},
    ZR_FACE_STYLE_FIELDS(struct zr_parsed_scene, face_style)};
/* clang-format off */
const struct zr_json_object zr_json_object_scene = {ZR_JSON_FIELDS("scene", zr_scene_fields),
    .schema = ZR_SCHEMA({
        "not": {"properties": {"meshes": {"maxItems": 0}, "polygons": {"maxItems": 0}}},
        "dependentSchemas": {
            "views": {"properties": {"turntable": false, "orbit": false, "animate": false}},
            "render": {
                "if": {"properties": {"render": {"const": false}}},
                "then": {
                    "properties": {
                        "outputs": {"items": {"properties": {"channel": {"const": "info"}}}},
                        "visibility": {"const": false}
                    }
                }
            },
            "visibility": {
                "if": {"properties": {"visibility": {"const": true}}},
                "then": {
                    "not": {"properties": {"outputs": false}},
                    "properties": {
                        "outputs": {"contains": {"properties": {"channel": {"enum": ["info", "masks"]}}}},
                        "base": false, "sections": false, "algorithm": {"not": {"const": "painter"}}
                    }
                }
            },
            "features": {
                "if": {"properties": {"features": {"const": true}, "render": {"const": true}}},
                "then": {
                    "not": {"properties": {"outputs": false}},
                    "properties": {"outputs": {"contains": {"properties": {"channel": {"const": "info"}}}}}
                }
            },
            "algorithm": {
                "if": {"properties": {"algorithm": {"const": "painter"}}},
                "then": {
                    "properties": {
                        "outputs": {
                            "items": {
                                "properties": {
                                    "channel": {"not": {"enum": ["layers", "thickness", "fragments", "masks"]}}
                                }
                            }
                        }
                    }
                }
            },
            "base": {"properties": {"sections": false}},
            "turntable": {
                "properties": {
                    "orbit": false, "animate": false,
                    "view": {
                        "properties": {
                            "cameraToWorld": false, "worldToCamera": false, "R": false, "projectionMatrix": false
                        }
                    }
                }
            },
            "orbit": {
                "properties": {
                    "animate": false,
                    "view": {
                        "properties": {
                            "cameraToWorld": false, "worldToCamera": false, "R": false, "projectionMatrix": false
                        }
                    }
                }
            },
            "sheet": {
                "if": {"properties": {"views": false, "turntable": false, "orbit": false, "animate": false}},
                "then": {
                    "properties": {
                        "sheet": {
                            "anyOf": [
                                {"enum": ["threeView", "balanced"]},
                                {"type": "object", "not": {"properties": {"layout": {"const": "views"}}}}
                            ]
                        }
                    }
                }
            }
        }
    }),
    .examples = ZR_SCHEMA([
        {"polygons": [{"vertices": [[0, 0, 0], [2, 0, 0], [1, 2, 0]], "color": "tomato"}]},
        {
            "look": "studio", "meshes": [{"asset": "part.stl"}], "view": {"preset": "front"},
            "outputs": [{"channel": "color"}, {"channel": "depth", "encoding": "png16", "scale": 0.001}]
        }
    ])};
/* clang-format on */
