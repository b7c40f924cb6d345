#include "schema/kinds.h"

#include <stdio.h>
#include <string.h>

#include "input/json/json_matrix.h"
#include "input/mesh/parsed_mesh.h"
#include "input/scene/json_scene.h"
#include "input/text/color_text.h"
#include "input/text/recenter.h"
#include "scene/looks.h"

/* The limit that replaces LIMIT in a text. */
enum limit { NONE, COORDINATE, PLACE, LENGTH, MATRIX, SIDE, VERTICES, VIEWS };

/* clang-format off */
static const struct {
    const char *name, *text;
    enum limit limit;
} kinds[] = {
    {"coordinate", ZR_SCHEMA({"type": "number", "minimum": -LIMIT, "maximum": LIMIT}), COORDINATE},
    {"length", ZR_SCHEMA({"type": "number", "minimum": -LIMIT, "maximum": LIMIT}), LENGTH},
    {"positive", ZR_SCHEMA({"type": "number", "exclusiveMinimum": 0, "maximum": LIMIT}), LENGTH},
    {"focal", ZR_SCHEMA({"type": "number", "minimum": 1e-6, "maximum": 1e9}), NONE},
    {"whole", ZR_SCHEMA({"type": "integer", "minimum": 0, "maximum": 4294967295}), NONE},
    {"index", ZR_SCHEMA({
        "description": "Number of an item, from 0.", "type": "integer", "minimum": 0, "maximum": 4294967294
    }), NONE},
    {"side", ZR_SCHEMA({"type": "integer", "minimum": 1, "maximum": LIMIT}), SIDE},
    {"share", ZR_SCHEMA({"type": "number", "minimum": 0, "maximum": 1}), NONE},
    {"coordinate2", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [{"$ref": "#/$defs/coordinate"}, {"$ref": "#/$defs/coordinate"}],
        "items": false, "minItems": 2
    }), NONE},
    {"vec3", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [
            {"$ref": "#/$defs/coordinate"}, {"$ref": "#/$defs/coordinate"}, {"$ref": "#/$defs/coordinate"}
        ],
        "items": false, "minItems": 3
    }), NONE},
    {"place", ZR_SCHEMA({
        "description": "[x, y, z] of a place, which may be far from the origin.", "type": "array",
        "items": {"type": "number", "minimum": -LIMIT, "maximum": LIMIT}, "minItems": 3, "maxItems": 3
    }), PLACE},
    {"vec4", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [
            {"$ref": "#/$defs/coordinate"}, {"$ref": "#/$defs/coordinate"}, {"$ref": "#/$defs/coordinate"},
            {"$ref": "#/$defs/coordinate"}
        ],
        "items": false, "minItems": 4
    }), NONE},
    {"position", ZR_SCHEMA({
        "description": "[x, y, z], or [x, y, z, w]: a homogeneous position.",
        "anyOf": [{"$ref": "#/$defs/vec3"}, {"$ref": "#/$defs/vec4"}]
    }), NONE},
    {"direction", ZR_SCHEMA({
        "description": "[x, y, z], not all 0, of any length.", "$ref": "#/$defs/vec3", "type": "array",
        "contains": {"not": {"const": 0}}
    }), NONE},
    {"quaternion", ZR_SCHEMA({
        "description": "[x, y, z, w], not all 0.", "$ref": "#/$defs/vec4", "type": "array",
        "contains": {"not": {"const": 0}}
    }), NONE},
    {"tangent", ZR_SCHEMA({
        "description": "[x, y, z, w]; w is 1 or -1, the side of the bitangent, as in glTF.", "type": "array",
        "prefixItems": [
            {"$ref": "#/$defs/coordinate"}, {"$ref": "#/$defs/coordinate"}, {"$ref": "#/$defs/coordinate"},
            {"enum": [1, -1]}
        ],
        "items": false, "minItems": 4
    }), NONE},
    {"rgb", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [{"$ref": "#/$defs/share"}, {"$ref": "#/$defs/share"}, {"$ref": "#/$defs/share"}],
        "items": false, "minItems": 3
    }), NONE},
    {"rgba", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [
            {"$ref": "#/$defs/share"}, {"$ref": "#/$defs/share"}, {"$ref": "#/$defs/share"},
            {"$ref": "#/$defs/share"}
        ],
        "items": false, "minItems": 4
    }), NONE},
    {"linearColor", ZR_SCHEMA({
        "description": "[r, g, b] of linear light.", "type": "array",
        "prefixItems": [
            {"type": "number", "minimum": 0, "maximum": 1e6}, {"type": "number", "minimum": 0, "maximum": 1e6},
            {"type": "number", "minimum": 0, "maximum": 1e6}
        ],
        "items": false, "minItems": 3
    }), NONE},
    {"color", ZR_SCHEMA({
        "description": "[r, g, b] or [r, g, b, a] of 0 to 1; #rgb, #rgba, #rrggbb or #rrggbbaa; transparent; or a name of CSS.",
        "anyOf": [
            {"$ref": "#/$defs/rgb"}, {"$ref": "#/$defs/rgba"},
            {"type": "string", "pattern": "^#([0-9A-Fa-f]{3,4}|[0-9A-Fa-f]{6}|[0-9A-Fa-f]{8})$"},
            {"const": "transparent"},
            {"$ref": "#/$defs/colorName"}
        ]
    }), NONE},
    {"opaque", ZR_SCHEMA({
        "description": "A colour; an alpha has to be 1.",
        "anyOf": [
            {"$ref": "#/$defs/rgb"},
            {
                "type": "array",
                "prefixItems": [
                    {"$ref": "#/$defs/share"}, {"$ref": "#/$defs/share"}, {"$ref": "#/$defs/share"}, {"const": 1}
                ],
                "items": false, "minItems": 4
            },
            {"type": "string", "pattern": "^#([0-9A-Fa-f]{3}[Ff]?|[0-9A-Fa-f]{6}([Ff]{2})?)$"},
            {"$ref": "#/$defs/colorName"}
        ]
    }), NONE},
    {"colorName", NULL, NONE},
    {"lookName", NULL, NONE},
    {"dataUri", ZR_SCHEMA({
        "description": "Bytes in base64: data:;base64,...", "type": "string", "pattern": "^data:[^,]*;base64,"
    }), NONE},
    {"file", ZR_SCHEMA({
        "description": "The bytes of a file.",
        "anyOf": [{"$ref": "#/$defs/dataUri"}, {"$ref": "#/$defs/bytes"}]
    }), NONE},
    {"part", ZR_SCHEMA({
        "description": "Name of a part, a pattern with * and ?, or an id.",
        "anyOf": [{"type": "string", "minLength": 1, "maxLength": 1024}, {"$ref": "#/$defs/whole"}]
    }), NONE},
    {"parts", ZR_SCHEMA({
        "anyOf": [{"$ref": "#/$defs/part"}, {"type": "array", "items": {"$ref": "#/$defs/part"}, "maxItems": 1000}]
    }), NONE},
    {"csgOperand", ZR_SCHEMA({
        "description": "Parts, which are united, or an operation.",
        "anyOf": [{"$ref": "#/$defs/parts"}, {"$ref": "#/$defs/csg"}]
    }), NONE},
    {"viewList", ZR_SCHEMA({
        "type": "array",
        "items": {"anyOf": [{"$ref": "#/$defs/view/properties/preset"}, {"$ref": "#/$defs/views"}]},
        "minItems": 1, "maxItems": LIMIT
    }), VIEWS},
    {"entry", ZR_SCHEMA({"type": "number", "minimum": -LIMIT, "maximum": LIMIT}), MATRIX},
    {"row4", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [
            {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"},
            {"$ref": "#/$defs/entry"}
        ],
        "items": false, "minItems": 4
    }), NONE},
    {"mat4", ZR_SCHEMA({
        "description": "4x4 matrix: four rows, 16 numbers column by column, or an array.",
        "anyOf": [
            {
                "type": "array",
                "prefixItems": [
                    {"$ref": "#/$defs/row4"}, {"$ref": "#/$defs/row4"}, {"$ref": "#/$defs/row4"},
                    {"$ref": "#/$defs/row4"}
                ],
                "items": false, "minItems": 4
            },
            {"type": "array", "items": {"$ref": "#/$defs/entry"}, "minItems": 16, "maxItems": 16},
            {"$ref": "#/$defs/bytes"}
        ]
    }), NONE},
    {"affine", ZR_SCHEMA({
        "description": "4x4 matrix with the bottom row 0 0 0 1: four rows, 16 numbers column by column, or an array.",
        "anyOf": [
            {
                "type": "array",
                "prefixItems": [
                    {"$ref": "#/$defs/row4"}, {"$ref": "#/$defs/row4"}, {"$ref": "#/$defs/row4"},
                    {
                        "type": "array",
                        "prefixItems": [{"const": 0}, {"const": 0}, {"const": 0}, {"const": 1}],
                        "items": false, "minItems": 4
                    }
                ],
                "items": false, "minItems": 4
            },
            {
                "type": "array",
                "prefixItems": [
                    {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"const": 0},
                    {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"const": 0},
                    {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"const": 0},
                    {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"$ref": "#/$defs/entry"}, {"const": 1}
                ],
                "items": false, "minItems": 16
            },
            {"$ref": "#/$defs/bytes"}
        ]
    }), NONE},
    {"row3", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [
            {"type": "number", "minimum": -1000, "maximum": 1000},
            {"type": "number", "minimum": -1000, "maximum": 1000},
            {"type": "number", "minimum": -1000, "maximum": 1000}
        ],
        "items": false, "minItems": 3
    }), NONE},
    {"rotation", ZR_SCHEMA({
        "description": "3x3 rotation: three rows, nine numbers row by row, or an array.",
        "anyOf": [
            {
                "type": "array",
                "prefixItems": [{"$ref": "#/$defs/row3"}, {"$ref": "#/$defs/row3"}, {"$ref": "#/$defs/row3"}],
                "items": false, "minItems": 3
            },
            {
                "type": "array",
                "items": {"type": "number", "minimum": -1000, "maximum": 1000},
                "minItems": 9, "maxItems": 9
            },
            {"$ref": "#/$defs/bytes"}
        ]
    }), NONE},
    {"pixels", ZR_SCHEMA({"type": "number", "minimum": -1e9, "maximum": 1e9}), NONE},
    {"pinhole", ZR_SCHEMA({
        "description": "[[fx, skew, cx], [0, fy, cy], [0, 0, 1]], the nine numbers row by row, or an array.",
        "anyOf": [
            {
                "type": "array",
                "prefixItems": [
                    {
                        "type": "array",
                        "prefixItems": [
                            {"$ref": "#/$defs/focal"}, {"$ref": "#/$defs/pixels"}, {"$ref": "#/$defs/pixels"}
                        ],
                        "items": false, "minItems": 3
                    },
                    {
                        "type": "array",
                        "prefixItems": [{"const": 0}, {"$ref": "#/$defs/focal"}, {"$ref": "#/$defs/pixels"}],
                        "items": false, "minItems": 3
                    },
                    {
                        "type": "array", "prefixItems": [{"const": 0}, {"const": 0}, {"const": 1}], "items": false,
                        "minItems": 3
                    }
                ],
                "items": false, "minItems": 3
            },
            {
                "type": "array",
                "prefixItems": [
                    {"$ref": "#/$defs/focal"}, {"$ref": "#/$defs/pixels"}, {"$ref": "#/$defs/pixels"}, {"const": 0},
                    {"$ref": "#/$defs/focal"}, {"$ref": "#/$defs/pixels"}, {"const": 0}, {"const": 0}, {"const": 1}
                ],
                "items": false, "minItems": 9
            },
            {"$ref": "#/$defs/bytes"}
        ]
    }), NONE},
    {"coefficients", ZR_SCHEMA({
        "description": "Coefficients of a lens.", "type": "array",
        "items": {"type": "number", "minimum": -1e6, "maximum": 1e6}
    }), NONE},
    {"coefficientList", ZR_SCHEMA({
        "description": "k1, k2, p1, p2, k3, k4, k5, k6 of OpenCV; further ones are 0.",
        "$ref": "#/$defs/coefficients", "type": "array",
        "anyOf": [
            {"maxItems": 0}, {"minItems": 4, "maxItems": 5}, {"minItems": 8, "maxItems": 8},
            {"minItems": 12, "maxItems": 12}, {"minItems": 14, "maxItems": 14}
        ]
    }), NONE},
    {"positions", ZR_SCHEMA({
        "anyOf": [{"type": "array", "items": {"$ref": "#/$defs/position"}}, {"$ref": "#/$defs/bytes"}]
    }), NONE},
    {"vectors", ZR_SCHEMA({
        "anyOf": [{"type": "array", "items": {"$ref": "#/$defs/vec3"}}, {"$ref": "#/$defs/bytes"}]
    }), NONE},
    {"colors", ZR_SCHEMA({
        "anyOf": [{"type": "array", "items": {"$ref": "#/$defs/color"}}, {"$ref": "#/$defs/bytes"}]
    }), NONE},
    {"texcoord", ZR_SCHEMA({"type": "number", "minimum": -10000, "maximum": 10000}), NONE},
    {"texcoords", ZR_SCHEMA({
        "anyOf": [
            {
                "type": "array",
                "items": {
                    "type": "array",
                    "prefixItems": [{"$ref": "#/$defs/texcoord"}, {"$ref": "#/$defs/texcoord"}],
                    "items": false, "minItems": 2
                }
            },
            {"$ref": "#/$defs/bytes"}
        ]
    }), NONE},
    {"tangents", ZR_SCHEMA({
        "anyOf": [{"type": "array", "items": {"$ref": "#/$defs/tangent"}}, {"$ref": "#/$defs/bytes"}]
    }), NONE},
    {"ring", ZR_SCHEMA({
        "anyOf": [
            {"type": "array", "items": {"$ref": "#/$defs/position"}, "minItems": 3, "maxItems": LIMIT},
            {"$ref": "#/$defs/bytes"}
        ]
    }), VERTICES},
    {"faces", ZR_SCHEMA({
        "anyOf": [
            {
                "type": "array",
                "items": {"type": "array", "items": {"$ref": "#/$defs/index"}, "minItems": 3, "maxItems": LIMIT}
            },
            {"$ref": "#/$defs/bytes"}
        ]
    }), VERTICES},
    {"lines", ZR_SCHEMA({
        "anyOf": [
            {
                "type": "array",
                "items": {
                    "type": "array",
                    "prefixItems": [{"$ref": "#/$defs/index"}, {"$ref": "#/$defs/index"}],
                    "items": false, "minItems": 2
                }
            },
            {"$ref": "#/$defs/bytes"}
        ]
    }), NONE},
    {"points", ZR_SCHEMA({
        "anyOf": [{"type": "array", "items": {"$ref": "#/$defs/index"}}, {"$ref": "#/$defs/bytes"}]
    }), NONE},
    {"heightRows", ZR_SCHEMA({
        "anyOf": [
            {
                "type": "array",
                "items": {
                    "type": "array",
                    "items": {"anyOf": [{"$ref": "#/$defs/coordinate"}, {"type": "null"}]},
                    "minItems": 2
                },
                "minItems": 2
            },
            {"$ref": "#/$defs/bytes"}
        ]
    }), NONE},
    {"heightGrid", ZR_SCHEMA({"anyOf": [{"$ref": "#/$defs/heightRows"}, {"$ref": "#/$defs/heights"}]}), NONE},
    {"scalar", ZR_SCHEMA({
        "type": "number", "minimum": -3.4028234663852886e38, "maximum": 3.4028234663852886e38
    }), NONE},
    {"scalars", ZR_SCHEMA({
        "anyOf": [{"type": "array", "items": {"$ref": "#/$defs/scalar"}}, {"$ref": "#/$defs/bytes"}]
    }), NONE},
    {"scalarRange", ZR_SCHEMA({
        "type": "array",
        "prefixItems": [{"$ref": "#/$defs/scalar"}, {"$ref": "#/$defs/scalar"}],
        "items": false, "minItems": 2
    }), NONE},
    {"outlines", ZR_SCHEMA({"anyOf": [{"type": "boolean"}, {"$ref": "#/$defs/color"}]}), NONE},
};
/* clang-format on */
const size_t zr_kind_count = sizeof kinds / sizeof *kinds;

static const struct {
    zr_json_read_fn *read;
    const char *kind;
} readers[] = {{zr_json_coordinate, "coordinate"},
               {zr_json_length, "length"},
               {zr_json_positive, "positive"},
               {zr_json_vec3, "vec3"},
               {zr_json_place, "place"},
               {zr_json_place3, "place"},
               {zr_json_doubles3, "vec3"},
               {zr_json_vec4, "vec4"},
               {zr_json_position, "position"},
               {zr_json_color, "color"},
               {zr_json_opaque, "opaque"},
               {zr_json_mat4, "mat4"},
               {zr_json_affine, "affine"},
               {zr_read_light_color, "color"},
               {zr_read_look, "lookName"},
               {zr_read_outline, "outlines"},
               {zr_read_texture, "texture"},
               {zr_read_normal_texture, "normalTexture"},
               {zr_read_occlusion_texture, "occlusionTexture"},
               {zr_read_mesh_positions, "positions"},
               {zr_read_mesh_normals, "vectors"},
               {zr_read_mesh_colors, "colors"},
               {zr_read_mesh_texcoords, "texcoords"},
               {zr_read_mesh_tangents, "tangents"},
               {zr_read_mesh_faces, "faces"},
               {zr_read_mesh_lines, "lines"},
               {zr_read_mesh_points, "points"},
               {zr_read_heights, "heightGrid"},
               {zr_read_scalars, "scalars"},
               {zr_read_scalar_range, "scalarRange"}};

const char *zr_kind_name(size_t i)
{
    return kinds[i].name;
}

const char *zr_kind_of(zr_json_read_fn *read)
{
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (readers[i].read == read) return readers[i].kind;
    return NULL;
}

static double value_of(enum limit limit, const struct zr_limits *limits)
{
    const double coordinate = (double)limits->coordinate_max;
    switch (limit) {
    case COORDINATE:
        return coordinate;
    case PLACE:
        return zr_recenter_limit(limits);
    case LENGTH:
        return coordinate * ZR_JSON_LENGTHS_PER_COORDINATE;
    case MATRIX:
        return (double)ZR_MATRIX_MAX;
    case SIDE:
        return limits->window_side_max;
    case VERTICES:
        return limits->polygon_vertices_max;
    case VIEWS:
        return limits->views_max;
    default:
        return 0.0;
    }
}

/* Copies a text with a number in place of each LIMIT. */
static void put_limit(const char *text, double value, char *out, size_t size)
{
    static const char word[] = "LIMIT";
    size_t used = 0;
    while (*text && used + 32 < size) {
        if (strncmp(text, word, sizeof word - 1) == 0) {
            used += (size_t)snprintf(out + used, size - used, "%.17g", value);
            text += sizeof word - 1;
        } else {
            out[used++] = *text++;
        }
    }
    out[used] = '\0';
}

/* Names are read in any case, so a schema lists those in small letters and lets others pass. */
static void print_color_names(struct zr_print *print)
{
    zr_print_begin(print, "anyOf", '[');
    zr_print_begin(print, NULL, '{');
    zr_print_begin(print, "enum", '[');
    for (size_t i = 0; zr_color_name(i); i++)
        zr_print_string(print, NULL, zr_color_name(i));
    zr_print_end(print, ']');
    zr_print_end(print, '}');
    zr_print_json(print, NULL, ZR_SCHEMA({"type" : "string", "pattern" : "^[A-Za-z]*[A-Z][A-Za-z]*$"}));
    zr_print_end(print, ']');
}

/* Versions of a look are adjacent and share a name, which is listed once. */
static void print_look_names(struct zr_print *print)
{
    zr_print_begin(print, "enum", '[');
    for (int i = 0; i < zr_look_count; i++)
        if (i == 0 || strcmp(zr_looks[i - 1].name, zr_looks[i].name) != 0)
            zr_print_string(print, NULL, zr_looks[i].name);
    for (int i = 0; i < zr_look_count; i++)
        zr_print_string(print, NULL, zr_look_pin_of(&zr_looks[i]).text);
    zr_print_end(print, ']');
}

void zr_kind_print(struct zr_print *print, size_t i, const struct zr_limits *limits)
{
    if (kinds[i].text) {
        char text[2048];
        put_limit(kinds[i].text, value_of(kinds[i].limit, limits), text, sizeof text);
        zr_print_json(print, kinds[i].name, text);
        return;
    }
    zr_print_begin(print, kinds[i].name, '{');
    if (strcmp(kinds[i].name, "lookName") == 0)
        print_look_names(print);
    else
        print_color_names(print);
    zr_print_end(print, '}');
}
