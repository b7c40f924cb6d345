#include "tools.h"

const char *const mcp_tool_names[MCP_TOOLS + 1] = {"render", "facts", "pick", NULL};

const char mcp_instructions[] =
    "zraster measures and draws 3D models. Measure before you look: facts gives box, volume, closedness, shells and "
    "parts without a picture. render draws pictures with numbers beside them; its default is one sheet of four views "
    "from all sides at one scale. pick lists the surfaces at a pixel of such a picture. Coordinates are those of the "
    "file. The same call gives the same pixels on every machine.";

/* ---- arguments ---- */

#define MODEL_TYPES "STL, OBJ, PLY, 3MF, GLB or glTF"
#define MODEL_HEAD  "\"model\":{\"type\":\"object\",\"description\":\"The model, a file of " MODEL_TYPES
#define MODEL_TEXTS                                                                                                    \
    "\"base64\":{\"type\":\"string\",\"description\":\"The file's bytes in base64.\"},"                                \
    "\"text\":{\"type\":\"string\",\"description\":\"The file's text, of OBJ, STL, PLY or glTF.\"},"
static const char model_of_files[] =
    MODEL_HEAD " below the server's folder: give a path, or the bytes or text of a file.\",\"properties\":{"
               "\"path\":{\"type\":\"string\",\"description\":\"Path of the file from the server's folder. The path "
               "'.' lists its models.\"}," MODEL_TEXTS;
static const char model_of_assets[] =
    MODEL_HEAD ": give its bytes, its text or an uploaded asset.\",\"properties\":{" MODEL_TEXTS
               "\"asset\":{\"type\":\"string\",\"description\":\"'sha256:' and the hash of an asset that "
               "was uploaded by POST /v1/assets.\"},";
static const char scene[] =
    "\"scene\":{\"type\":\"object\",\"description\":\"A scene instead of a model, as POST /v1/render takes it, such as "
    "{'polygons': [{'vertices': [[0,0,0],[1,0,0],[0,1,0]]}]}. With a model, the scene names it by "
    "{'meshes': [{'asset': 'model'}]}, or by the name of its file if it is given by path. "
    "Arguments override the scene's keys.\"}"
    ","
    "\"up\":{\"type\":\"string\",\"enum\":[\"y\",\"z\"],\"description\":\"Axis of the file that points up. Default: z "
    "for STL and 3MF, else y. It changes the names of sides, no coordinates. For CAD models with z up, say z.\"}";

#define SIDE "\"type\":\"integer\",\"minimum\":16,\"maximum\":1568"
static const char pictures[] =
    ",\"views\":{\"type\":\"array\",\"minItems\":1,\"items\":{\"anyOf\":[{\"type\":\"string\",\"enum\":[\"front\","
    "\"back\",\"left\",\"right\",\"top\",\"bottom\",\"isometric\"]},{\"type\":\"object\",\"description\":\"A view of a "
    "scene: {'name': 'low', 'view': {'azimuthDegrees': 30, 'elevationDegrees': -20}}; view may also have target and "
    "distance, or eye, target and up. Azimuth 0 is the front, 90 the right.\"}]},\"description\":\"Views to draw, each "
    "as a picture of its own (up to 8), or with sheet 'views' all in one picture (up to 4096).\"},"
    "\"sheet\":{\"type\":\"string\",\"enum\":[\"balanced\",\"threeView\",\"views\"],\"description\":\"One picture of "
    "several views at one scale. balanced, the default without views: two corners from above and two from below, which "
    "show all sides. threeView: front, top, right and isometric. views: those of the argument.\"},"
    "\"look\":{\"type\":\"string\",\"description\":\"studio (default), technical (lines on white), clay, dark, metal, "
    "outdoor, blueprint, xray (see-through) or textbook; NAME@VERSION pins its pixels.\"},"
    "\"parts\":{\"type\":\"object\",\"properties\":{\"hide\":{},\"isolate\":{},\"ghost\":{},\"highlight\":{},"
    "\"explode\":{},\"colors\":{\"type\":\"string\",\"enum\":[\"own\",\"parts\",\"materials\"]}},\"description\":"
    "\"hide, isolate, ghost and highlight take names, patterns such as 'bolt*' or ids of parts, one or a list. "
    "explode is a factor. colors 'parts' gives each part a colour.\"},"
    "\"sections\":{\"type\":\"object\",\"description\":\"Planes that cut the model open, with hatched caps: {'planes': "
    "[{'axis': 'x', 'fraction': 0.5}]}; a plane may have offset (a coordinate) instead of fraction, and keep "
    "'positive' or 'negative'.\"},"
    "\"annotate\":{\"type\":\"boolean\",\"description\":\"Captions of a sheet: name, direction and scale of each view. "
    "Default: true.\"},"
    "\"width\":{" SIDE ",\"description\":\"Pixels of each picture; 1024 for a sheet, 800, 640 or 512 by the number of "
    "views.\"},\"height\":{" SIDE "}";
static const char format[] =
    ",\"format\":{\"type\":\"string\",\"enum\":[\"png\",\"jpeg\",\"webp\"],\"description\":\"Default: png, or jpeg if "
    "the pictures would have more than 700 kB.\"}";
static const char pixel[] =
    ",\"image\":{\"type\":\"integer\",\"minimum\":0,\"maximum\":7,\"description\":\"Number of the picture in the "
    "answer of render. Default: 0.\"},\"x\":{\"type\":\"integer\",\"minimum\":0,\"description\":\"Column, "
    "from 0 at the left.\"},\"y\":{\"type\":\"integer\",\"minimum\":0,\"description\":\"Row, from 0 at the top.\"}";

/* ---- structured content ---- */

#define NUMBER       "{\"type\":\"number\"}"
#define MAYBE_NUMBER "{\"type\":[\"number\",\"null\"]}"
#define TEXT         "{\"type\":\"string\"}"
#define VECTOR       "{\"type\":\"array\",\"items\":{\"type\":\"number\"},\"minItems\":3,\"maxItems\":3}"
#define MAYBE_VECTOR "{\"type\":[\"array\",\"null\"],\"items\":{\"type\":\"number\"},\"minItems\":3,\"maxItems\":3}"
#define BOX                                                                                                            \
    "{\"type\":[\"object\",\"null\"],\"required\":[\"min\",\"max\",\"size\"],\"properties\":{\"min\":" VECTOR          \
    ",\"max\":" VECTOR ",\"size\":" VECTOR "}}"
#define SHELL_COUNTS                                                                                                   \
    ",\"required\":[\"outward\",\"inward\",\"open\"],\"properties\":{\"outward\":{\"type\":\"integer\"},"              \
    "\"inward\":{\"type\":\"integer\"},\"open\":{\"type\":\"integer\"}},\"description\":"                              \
    "\"Connected surfaces. outward: closed. inward: closed, with faces that look inwards (a void, or inside out). "    \
    "open: the rest.\"}"
#define SHELLS       "{\"type\":\"object\"" SHELL_COUNTS
#define MAYBE_SHELLS "{\"type\":[\"object\",\"null\"]" SHELL_COUNTS
#define FACTS                                                                                                          \
    "\"units\":{\"type\":[\"string\",\"null\"],\"description\":\"Unit of lengths; null: the format names none.\"},"    \
    "\"box\":" BOX                                                                                                     \
    ",\"volume\":{\"type\":[\"number\",\"null\"],\"description\":\"Sum over the parts; null unless all "               \
    "are closed; negative if faces are turned inside out.\"},\"area\":" MAYBE_NUMBER                                   \
    ",\"closed\":{\"type\":[\"boolean\",\"null\"],\"description\":\"Every edge is used equally often in both "         \
    "directions. null: not known, of more than 1000 parts; volume, area and shells are null, too.\"},"                 \
    "\"shells\":" MAYBE_SHELLS                                                                                         \
    ",\"parts\":{\"type\":\"array\",\"items\":{\"type\":\"object\",\"required\":[\"name\",\"id\",\"box\",\"closed\"]," \
    "\"properties\":{\"name\":" TEXT ",\"id\":{\"type\":\"integer\"},\"box\":" BOX                                     \
    ",\"triangles\":{\"type\":\"integer\"},\"area\":" NUMBER ",\"volume\":" MAYBE_NUMBER                               \
    ",\"closed\":{\"type\":\"boolean\"},\"shells\":" SHELLS ",\"leastWall\":" MAYBE_NUMBER                             \
    ",\"centerOfMass\":" MAYBE_VECTOR ",\"color\":" TEXT                                                               \
    ",\"pixels\":{\"type\":\"integer\"}}}},\"partsOmitted\":{\"type\":\"integer\"},"                                   \
    "\"warnings\":{\"type\":\"array\",\"items\":" TEXT "}"
#define FACTS_REQUIRED "\"units\",\"box\",\"volume\",\"area\",\"closed\",\"shells\",\"parts\",\"warnings\""
#define VIEW                                                                                                           \
    "{\"type\":\"object\",\"required\":[\"name\",\"image\",\"looksAlong\",\"projection\",\"unitsPerPixel\"],"          \
    "\"properties\":{\"name\":" TEXT ",\"image\":{\"type\":\"integer\"},\"box\":{\"type\":\"array\",\"items\":"        \
    "{\"type\":\"integer\"},\"minItems\":4,\"maxItems\":4,\"description\":\"Pixels of the image, x0, y0, x1, y1.\"},"  \
    "\"azimuthDegrees\":" NUMBER ",\"elevationDegrees\":" NUMBER ",\"looksAlong\":" VECTOR                             \
    ",\"projection\":{\"enum\":[\"orthographic\",\"perspective\"]},\"unitsPerPixel\":" MAYBE_NUMBER ",\"eye\":" VECTOR \
    ",\"coveredShare\":" NUMBER ",\"touchesBorder\":{\"type\":\"boolean\"},\"blank\":{\"type\":\"boolean\"}}}"

static const char facts_schema[] = "{\"type\":\"object\",\"required\":[" FACTS_REQUIRED "],\"properties\":{" FACTS "}}";
static const char render_schema[] =
    "{\"type\":\"object\",\"required\":[" FACTS_REQUIRED ",\"views\",\"picture\"],\"properties\":{" FACTS
    ",\"views\":{\"type\":\"array\",\"items\":" VIEW "},\"picture\":{\"type\":\"object\",\"required\":[\"images\","
    "\"width\",\"height\",\"mimeType\",\"bytes\",\"blank\"],\"properties\":{\"images\":{\"type\":\"integer\"},"
    "\"width\":{\"type\":\"integer\"},\"height\":{\"type\":\"integer\"},\"mimeType\":" TEXT ",\"bytes\":{\"type\":"
    "\"integer\"},\"blank\":{\"type\":\"boolean\"},\"look\":" TEXT "}}}}";
static const char pick_schema[] =
    "{\"type\":\"object\",\"required\":[\"units\",\"x\",\"y\",\"hit\",\"count\",\"fragments\",\"views\",\"warnings\"],"
    "\"properties\":{\"units\":{\"type\":[\"string\",\"null\"]},\"x\":{\"type\":\"integer\"},\"y\":{\"type\":"
    "\"integer\"},\"hit\":{\"type\":\"boolean\"},\"count\":{\"type\":\"integer\",\"description\":\"Surfaces at the "
    "pixel, hidden ones included.\"},\"fragments\":{\"type\":\"array\",\"description\":\"The nearest "
    "first.\",\"items\":"
    "{\"type\":\"object\",\"required\":[\"part\",\"face\",\"depth\",\"point\",\"front\",\"shown\"],\"properties\":{"
    "\"part\":" TEXT ",\"face\":{\"type\":\"integer\"},\"depth\":" NUMBER ",\"point\":" VECTOR
    ",\"front\":{\"type\":\"boolean\"},\"shown\":{\"type\":\"boolean\"}}}},\"views\":{\"type\":\"array\","
    "\"items\":" VIEW "},\"warnings\":{\"type\":\"array\",\"items\":" TEXT "}}}";

/* ---- the list ---- */

struct tool {
    const char *title, *description, *more, *required, *output;
};
static const struct tool TOOLS[MCP_TOOLS] = {
    {"Draw a 3D model",
     "Draws a model or a scene. Before each picture, a text says what it shows: directions, scale, box. Without views "
     "and sheet, it is one sheet of four corners, two from above and two from below.",
     format, "", render_schema},
    {"Measure a 3D model",
     "Measures a model or a scene without drawing: box, volume, area, whether it is closed, its shells, and the same "
     "of each part.",
     NULL, "", facts_schema},
    {"Look up a pixel",
     "Lists the surfaces at a pixel of a picture, the nearest first: part, face, depth and point of each. "
     "Repeat the arguments of render, and add image, x and y.",
     pixel, ",\"required\":[\"x\",\"y\"]", pick_schema}};

void mcp_tools_list(struct mcp_text *text, const struct mcp_host *host)
{
    mcp_text_put(text, "[");
    for (int i = 0; i < MCP_TOOLS; i++) {
        const struct tool *tool = &TOOLS[i];
        mcp_text_print(text,
                       "%s{\"name\":\"%s\",\"title\":\"%s\",\"description\":\"%s\",\"inputSchema\":{\"type\":"
                       "\"object\",\"properties\":{",
                       i ? "," : "", mcp_tool_names[i], tool->title, tool->description);
        mcp_text_put(text, host->reads_files ? model_of_files : model_of_assets);
        if (text->size > 0) text->size -= 1; /* the comma after the last property */
        mcp_text_print(text, "},\"additionalProperties\":false},%s", scene);
        if (tool->more) mcp_text_print(text, "%s%s", pictures, tool->more);
        mcp_text_print(text,
                       "},\"additionalProperties\":false%s},\"outputSchema\":%s,\"annotations\":{\"title\":\"%s\","
                       "\"readOnlyHint\":true,\"openWorldHint\":false}}",
                       tool->required, tool->output, tool->title);
    }
    mcp_text_put(text, "]");
}
