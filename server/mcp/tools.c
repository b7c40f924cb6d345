#include "tools.h"

const char mcp_instructions[] =
    "zraster measures and draws 3D models. Measure before you look: facts gives box, volume, closedness, shells and "
    "parts without a picture. render draws pictures with numbers beside them; its default is one sheet of four views "
    "from all sides at one scale. pick lists the surfaces at a pixel of such a picture. compare tells where two models "
    "differ: common volume, distances, regions. drawing makes a technical drawing with sizes and notes of holes. "
    "Coordinates are those of the "
    "file. The same call gives the same pixels on every machine.";

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
#define EDGES        "{\"type\":\"object\",\"properties\":{\"count\":{\"type\":\"integer\"},\"at\":" VECTOR "}}"
#define FACTS                                                                                                          \
    "\"units\":{\"type\":[\"string\",\"null\"],\"description\":\"Unit of lengths; null: the format names none.\"},"    \
    "\"box\":" BOX                                                                                                     \
    ",\"volume\":{\"type\":[\"number\",\"null\"],\"description\":\"Sum over the parts; null unless all "               \
    "are closed; negative if faces are turned inside out. With csg, that of the combined solid; parts are its "        \
    "operands, and area and shells are null.\"},\"volumeError\":{\"type\":\"number\",\"description\":"                 \
    "\"If shells overlap: what is inside counts once, and volume is measured to within about "                         \
    "this.\"},\"centerOfMass\":" VECTOR ",\"area\":" MAYBE_NUMBER                                                      \
    ",\"closed\":{\"type\":[\"boolean\",\"null\"],\"description\":\"Every edge is used equally often in both "         \
    "directions. null: over 1000 parts; so are volume, area, shells.\"},"                                              \
    "\"shells\":" MAYBE_SHELLS                                                                                         \
    ",\"parts\":{\"type\":\"array\",\"items\":{\"type\":\"object\",\"required\":[\"name\",\"id\",\"box\",\"closed\"]," \
    "\"properties\":{\"name\":" TEXT ",\"id\":{\"type\":\"integer\"},\"hidden\":{\"type\":\"boolean\"},\"box\":" BOX   \
    ",\"triangles\":{\"type\":\"integer\"},\"area\":" NUMBER ",\"volume\":" MAYBE_NUMBER ",\"volumeError\":" NUMBER    \
    ",\"closed\":{\"type\":\"boolean\"},\"openEdges\":" EDGES ",\"flippedEdges\":" EDGES ",\"shells\":" SHELLS         \
    ",\"leastWall\":" MAYBE_NUMBER ",\"leastWallAt\":" VECTOR ",\"capArea\":" NUMBER ",\"centerOfMass\":" MAYBE_VECTOR \
    ",\"color\":" TEXT                                                                                                 \
    ",\"pixels\":{\"type\":\"integer\"},\"features\":{\"type\":\"object\"}}}},\"partsOmitted\":{\"type\":"             \
    "\"integer\"}"                                                                                                     \
    ","                                                                                                                \
    "\"partsHidden\":{\"type\":\"integer\",\"description\":\"Parts that hide or isolate hides; box and sums are of "   \
    "the others.\"},"                                                                                                  \
    "\"explode\":{\"type\":\"number\",\"description\":\"Parts are measured where moved.\"},"                           \
    "\"warnings\":{\"type\":\"array\",\"items\":" TEXT "}"
#define FACTS_REQUIRED "\"units\",\"box\",\"volume\",\"area\",\"closed\",\"shells\",\"parts\",\"warnings\""
#define VIEW                                                                                                           \
    "{\"type\":\"object\",\"required\":[\"name\",\"image\",\"looksAlong\",\"projection\",\"unitsPerPixel\"],"          \
    "\"properties\":{\"name\":" TEXT ",\"image\":{\"type\":\"integer\"},\"box\":{\"type\":\"array\",\"items\":"        \
    "{\"type\":\"integer\"},\"minItems\":4,\"maxItems\":4,\"description\":\"Pixels of the image, x0, y0, x1, y1.\"},"  \
    "\"azimuthDegrees\":" NUMBER ",\"elevationDegrees\":" NUMBER ",\"looksAlong\":" VECTOR                             \
    ",\"projection\":{\"enum\":[\"orthographic\",\"perspective\"]},\"unitsPerPixel\":" MAYBE_NUMBER ",\"eye\":" VECTOR \
    ",\"coveredShare\":" NUMBER ",\"touchesBorder\":{\"type\":\"boolean\"},\"blank\":{\"type\":\"boolean\"}}}"

static const char measured_keys[] =
    ",\"csg\":{\"type\":\"object\",\"properties\":{\"volume\":" NUMBER ",\"volumeError\":" NUMBER
    ",\"centerOfMass\":" VECTOR "}},\"holesNotSearched\":{\"type\":\"object\",\"properties\":{\"parts\":{\"type\":"
    "\"integer\"},\"reason\":" TEXT "}},\"distances\":{\"type\":\"array\",\"description\":\"Of the scene's pairs of "
    "parts.\",\"items\":{\"type\":\"object\",\"properties\":{\"parts\":{\"type\":\"array\",\"items\":" TEXT
    "},\"distance\":" MAYBE_NUMBER ",\"from\":" VECTOR ",\"to\":" VECTOR
    ",\"crosses\":{\"type\":\"boolean\"}}}},\"picks\":{\"type\":\"array\",\"description\":\"Of the scene's pixels.\","
    "\"items\":{\"type\":\"object\",\"properties\":{\"pixel\":{\"type\":\"array\",\"items\":{\"type\":\"integer\"}},"
    "\"part\":{\"type\":[\"string\",\"null\"]},\"faceId\":{\"type\":\"integer\"},\"point\":" VECTOR
    ",\"normal\":" MAYBE_VECTOR ",\"depth\":" NUMBER ",\"feature\":{\"type\":\"object\"},\"behind\":{\"type\":"
    "\"array\",\"items\":{\"type\":\"object\"}}}}},\"between\":{\"type\":\"array\",\"description\":\"From each pick "
    "to "
    "the next.\",\"items\":{\"type\":\"object\",\"properties\":{\"from\":{\"type\":\"integer\"},\"to\":{\"type\":"
    "\"integer\"},\"distance\":" NUMBER ",\"offset\":" VECTOR ",\"alongNormal\":" NUMBER ",\"angleDegrees\":" NUMBER
    "}}}";
static const char facts_keys[] = "{\"type\":\"object\",\"required\":[" FACTS_REQUIRED "],\"properties\":{" FACTS;
static const char render_keys[] =
    "{\"type\":\"object\",\"required\":[" FACTS_REQUIRED ",\"views\",\"picture\"],\"properties\":{" FACTS;
static const char picture_keys[] =
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
    ",\"front\":{\"type\":\"boolean\"},\"shown\":{\"type\":\"boolean\"}}}},\"normal\":" MAYBE_VECTOR
    ",\"feature\":{\"type\":\"object\"},"
    "\"between\":{\"type\":\"object\",\"description\":\"The way to the surface at toX, toY.\"},"
    "\"betweenOmitted\":{\"type\":\"string\",\"description\":\"Why there is none.\"},\"views\":{\"type\":\"array\","
    "\"items\":" VIEW "},\"warnings\":{\"type\":\"array\",\"items\":" TEXT "}}}";

#define OBJECT "{\"type\":\"object\"}"
static const char compare_schema[] =
    "{\"type\":\"object\",\"required\":[\"summary\",\"same\",\"tolerance\",\"a\",\"b\",\"warnings\"],\"properties\":{"
    "\"summary\":" TEXT ",\"same\":{\"type\":\"boolean\"},\"tolerance\":" NUMBER ",\"a\":" OBJECT ",\"b\":" OBJECT
    ",\"silhouettes\":{\"type\":\"array\",\"items\":" OBJECT "},\"alignment\":" OBJECT ",\"volume\":" OBJECT
    ",\"deviation\":" OBJECT
    ",\"regions\":{\"type\":\"array\",\"description\":\"Connected regions that only one model has, the largest "
    "first.\",\"items\":" OBJECT "},\"regionsOmitted\":{\"type\":\"integer\"},\"parts\":" OBJECT
    ",\"features\":{\"type\":\"object\",\"description\":\"holes: removed, added, moved, changed.\"}"
    ",\"warnings\":{\"type\":\"array\",\"items\":" TEXT "}}}";
static const char drawing_schema[] =
    "{\"type\":\"object\",\"required\":[\"summary\",\"page\",\"scale\",\"projection\",\"units\",\"millimetres\","
    "\"holes\",\"holesNoted\",\"warnings\"],\"properties\":{\"summary\":" TEXT ",\"page\":" TEXT ",\"scale\":" TEXT
    ",\"projection\":" TEXT ",\"units\":{\"type\":[\"string\",\"null\"],\"description\":\"Unit of the file; null: "
    "none, and 1 is drawn as 1 mm.\"},\"millimetres\":{\"type\":\"object\",\"required\":[\"width\",\"height\","
    "\"depth\"],\"properties\":{\"width\":" NUMBER ",\"height\":" NUMBER ",\"depth\":" NUMBER
    "}},\"holes\":{\"type\":\"integer\",\"description\":\"Round holes.\"},\"holesNoted\":{\"type\":\"integer\"},"
    "\"warnings\":{\"type\":\"array\",\"items\":" TEXT "}}}";

/* ---- the list ---- */

/* The schema of the output is in pieces, which C limits to 4095 characters. */
struct tool {
    const char *name, *title, *description, *required, *output[4];
};
static const struct tool TOOLS[MCP_TOOLS] = {
    [MCP_RENDER] = {"render",
                    "Draw a 3D model",
                    "Draws a model or a scene. Before each picture, a text says what it shows: directions, scale, box. "
                    "Without views and sheet, it is one sheet of four corners, two from above and two from below.",
                    "",
                    {render_keys, measured_keys, picture_keys}},
    [MCP_FACTS] = {"facts",
                   "Measure a 3D model",
                   "Measures a model or a scene without drawing: box, volume, centre of mass, area, whether it is "
                   "closed, its shells, and the same of each part, with its holes, bosses, fillets, flat faces, "
                   "symmetry and least wall. Beside a model, the scene {'distances': [['a', 'b']]} adds the distance "
                   "of the parts a and b, and whether they overlap; {'csg': {'intersection': ['a', 'b']}} has the "
                   "volume that they share; {'sections': {'planes': [{'axis': 'z', 'offset': 1}]}} adds the area "
                   "of the section.",
                   "",
                   {facts_keys, measured_keys, "}}"}},
    [MCP_PICK] = {"pick",
                  "Look up a pixel",
                  "Lists the surfaces at a pixel of a picture, the nearest first: part, face, depth and point of each. "
                  "Repeat the arguments of render, and add image, x and y.",
                  ",\"required\":[\"x\",\"y\"]",
                  {pick_schema}},
    [MCP_COMPARE] = {"compare",
                     "Compare two 3D models",
                     "Compares two models: sizes of both, volumes that both share (IoU), distances between the "
                     "surfaces, holes, parts and regions that were added, removed or moved, and a picture of the "
                     "differences. With align 'principal', b may lie elsewhere, and mirror images are noticed.",
                     ",\"required\":[\"a\",\"b\"]",
                     {compare_schema}},
    [MCP_DRAWING] = {"drawing",
                     "Make a technical drawing",
                     "Makes a technical drawing on paper: front, top, right and isometric view at one standard scale, "
                     "with hidden lines, overall sizes, notes of round holes, and a section if asked for.",
                     "",
                     {drawing_schema}}};

struct mcp_words mcp_tool_names(void)
{
    struct mcp_words names = {{NULL}};
    for (int i = 0; i < MCP_TOOLS; i++)
        names.at[i] = TOOLS[i].name;
    return names;
}

void mcp_tools_list(struct mcp_text *text, const struct mcp_host *host)
{
    mcp_text_put(text, "[");
    for (int i = 0; i < MCP_TOOLS; i++) {
        const struct tool *tool = &TOOLS[i];
        mcp_text_print(text,
                       "%s{\"name\":\"%s\",\"title\":\"%s\",\"description\":\"%s\",\"inputSchema\":{\"type\":"
                       "\"object\",\"properties\":{",
                       i ? "," : "", tool->name, tool->title, tool->description);
        mcp_keys_put(text, mcp_arguments, 1u << i, host);
        mcp_text_print(text, "},\"additionalProperties\":false%s},\"outputSchema\":", tool->required);
        for (int k = 0; tool->output[k]; k++)
            mcp_text_put(text, tool->output[k]);
        mcp_text_print(text,
                       ",\"annotations\":{\"title\":\"%s\","
                       "\"readOnlyHint\":true,\"openWorldHint\":false}}",
                       tool->title);
    }
    mcp_text_put(text, "]");
}
