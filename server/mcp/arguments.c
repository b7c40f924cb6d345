#include "arguments.h"

#include <string.h>
#include <strings.h>

#include "drawing_rows.h"
#include "input/formats/formats.h"
#include "input/formats/sniff.h"
#include "input/text/names.h"
#include "scene/encodings.h"
#include "scene/looks.h"

/* ---- words of tables ---- */

/* Puts the endings of models: ".obj, .stl". */
static void put_endings(struct mcp_text *text, bool only_z_up)
{
    const char *before = ".";
    for (int i = 0; i < ZR_FORMAT_COUNT; i++) {
        if (zr_format_rows[i].has_view || (only_z_up && !zr_format_rows[i].z_is_up)) continue;
        mcp_text_print(text, "%s%s", before, zr_format_rows[i].suffix);
        before = ", .";
    }
}

static void put_z_up(struct mcp_text *text, const struct mcp_host *host)
{
    (void)host;
    put_endings(text, true);
}

/* The first version of a look has the text. */
static void put_looks(struct mcp_text *text, const struct mcp_host *host)
{
    (void)host;
    for (int i = 0; i < zr_look_count; i++)
        if (zr_looks[i].text) mcp_text_print(text, "%s (%s), ", zr_looks[i].name, zr_looks[i].text);
}

static void put_quoted(struct mcp_text *text, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count && words[i]; i++)
        mcp_text_print(text, "%s\"%s\"", i ? "," : "", words[i]);
}

static void put_presets(struct mcp_text *text, const struct mcp_host *host)
{
    (void)host;
    put_quoted(text, zr_preset_names.words, (size_t)zr_preset_names.count);
}

static void put_marks(struct mcp_text *text, const struct mcp_host *host)
{
    (void)host;
    put_quoted(text, zr_annotation_names.words, (size_t)zr_annotation_names.count);
}

static void put_formats(struct mcp_text *text, const struct mcp_host *host)
{
    const struct mcp_words formats = mcp_words_of_formats();
    (void)host;
    put_quoted(text, formats.at, MCP_WORDS_MAX);
}

static void put_parts(struct mcp_text *text, const struct mcp_host *host)
{
    mcp_keys_put(text, mcp_part_keys, ~0u, host);
}

static void put_model(struct mcp_text *text, const struct mcp_host *host)
{
    put_endings(text, false);
    mcp_text_put(text, host->reads_files ? ") below the server's folder: give its path, or its bytes or text."
                                         : "): its bytes, its text or an uploaded asset.");
    mcp_text_put(text, "\",\"properties\":{");
    mcp_keys_put(text, mcp_model_sources, host->reads_files ? MCP_OF_FILES : MCP_OF_ASSETS, host);
}

bool mcp_model_is_z_up(const char *path, const void *bytes, size_t size)
{
    const char *dot = path ? strrchr(path, '.') : NULL;
    enum zr_format format = ZR_FORMAT_UNKNOWN;
    if (bytes && !path) format = zr_format_of_bytes(bytes, size);
    for (int i = 0; dot && i < ZR_FORMAT_COUNT; i++)
        if (strcasecmp(dot + 1, zr_format_rows[i].suffix) == 0) format = (enum zr_format)i;
    return format != ZR_FORMAT_UNKNOWN && zr_format_rows[format].z_is_up;
}

/* ---- rows ---- */

#define STRING(text)        "{\"type\":\"string\",\"description\":\"" text "\"}"
#define SIDE(description)   "{\"type\":\"integer\",\"minimum\":16,\"maximum\":1568" description "}"
#define WHOLE(limits, text) "{\"type\":\"integer\",\"minimum\":0" limits ",\"description\":\"" text "\"}"
#define OBJECT(text)        "{\"type\":\"object\",\"description\":\"" text "\"}"

const struct mcp_key mcp_model_sources[] = {
    {"path", MCP_OF_FILES, STRING("Path of the file from the server's folder. The path '.' lists its models."), NULL},
    {"base64", MCP_ALL_TOOLS, STRING("The file's bytes in base64."), NULL},
    {"text", MCP_ALL_TOOLS, STRING("The text of a file that is text, such as OBJ. Others need base64."), NULL},
    {"asset", MCP_OF_ASSETS, STRING("'sha256:' and the hash of an asset that was uploaded by POST /v1/assets."), NULL},
    {NULL, 0, NULL, NULL}};

const struct mcp_key mcp_part_keys[] = {
    {"hide", MCP_ALL_TOOLS, "{}", NULL},
    {"isolate", MCP_ALL_TOOLS, "{}", NULL},
    {"ghost", MCP_ALL_TOOLS, "{}", NULL},
    {"highlight", MCP_ALL_TOOLS, "{}", NULL},
    {"explode", MCP_ALL_TOOLS, "{}", NULL},
    {"colors", MCP_ALL_TOOLS, "{\"type\":\"string\",\"enum\":[\"own\",\"parts\",\"materials\",\"x\",\"y\",\"z\"]}",
     NULL},
    {NULL, 0, NULL, NULL}};

/* Types of the parameters of drawings, and usual values where agents have their own. */
#define TYPED(type, help, otherwise)   "{\"type\":" type ",\"description\":\"" help ". Default: " otherwise ".\"}"
#define OF_page(help, otherwise)       TYPED("\"string\",\"enum\":[\"a4\",\"a3\"]", help, otherwise)
#define OF_scale(help, otherwise)      TYPED("\"string\"", help, otherwise)
#define OF_projection(help, otherwise) TYPED("\"string\",\"enum\":[\"third\",\"first\"]", help, otherwise)
#define OF_section(help, otherwise)    TYPED("\"string\"", help, otherwise)
#define OF_hidden(help, otherwise)     TYPED("\"boolean\"", help, otherwise)
#define OF_title(help, otherwise)      TYPED("\"string\"", help, otherwise)
#define OF_date(help, otherwise)       TYPED("\"string\"", help, otherwise)
#define OF_format(help, otherwise)     TYPED("\"string\",\"enum\":[\"png\",\"svg\"]", help, "png")
#define OF_dpi(help, otherwise)                                                                                        \
    TYPED("\"number\",\"minimum\":30,\"maximum\":600", help, "94 on a3, 134 on a4: at most 1568 pixels per side")
#define DRAWING_KEY(name, placeholder, values, help, otherwise)                                                        \
    {#name, 1 << MCP_DRAWING, OF_##name(help, otherwise), NULL},

const struct mcp_key mcp_arguments[] = {
    {"model", MCP_MODEL_TOOLS,
     "{\"type\":\"object\",\"description\":\"The model, a file ($},\"additionalProperties\":false}", put_model},
    {"scene", MCP_MODEL_TOOLS,
     OBJECT("A scene instead of a model, as POST /v1/render takes it, such as {'polygons': [{'vertices': "
            "[[0,0,0],[1,0,0],[0,1,0]]}]}. With a model, the scene names it by {'meshes': [{'asset': 'model'}]}, or "
            "by the name of its file if it is given by path. Arguments override the scene's keys."),
     NULL},
    {"up", MCP_MODEL_TOOLS,
     "{\"type\":\"string\",\"enum\":[\"y\",\"z\"],\"description\":\"Axis of the file that points up. Default: z for "
     "$, else y. It changes the names of sides, no coordinates. For CAD models with z up, say z.\"}",
     put_z_up},
    {"views", MCP_DRAWING_TOOLS,
     "{\"type\":\"array\",\"minItems\":1,\"items\":{\"anyOf\":[{\"type\":\"string\",\"enum\":[$]},{\"type\":"
     "\"object\",\"description\":\"A view of a scene: {'name': 'low', 'view': {'azimuthDegrees': 30, "
     "'elevationDegrees': -20}}; view may also have target and distance, or eye, target and up. Azimuth 0 is the "
     "front, 90 the right.\"}]},\"description\":\"Views to draw, each as a picture of its own (up to 8), or with "
     "sheet 'views' all in one picture (up to 4096).\"}",
     put_presets},
    {"sheet", MCP_DRAWING_TOOLS,
     "{\"type\":\"string\",\"enum\":[\"balanced\",\"threeView\",\"views\"],\"description\":\"One picture of several "
     "views at one scale. balanced, the default without views: two corners from above and two from below, which show "
     "all sides. threeView: front, top, right and isometric. views: those of the argument.\"}",
     NULL},
    {"look", MCP_DRAWING_TOOLS | 1 << MCP_COMPARE, STRING("$or NAME@VERSION, which pins its pixels. Default: studio."),
     put_looks},
    {"materials", MCP_DRAWING_TOOLS,
     "{\"type\":\"string\",\"enum\":[\"look\",\"keep\"],\"description\":\"Materials of the file in the looks "
     "technical, "
     "clay, metal, blueprint and xray: look, the default, replaces them, keep keeps them.\"}",
     NULL},
    {"parts", MCP_DRAWING_TOOLS,
     "{\"type\":\"object\",\"properties\":{$},\"description\":\"hide, isolate, ghost and highlight take names, "
     "patterns such as 'bolt*' or ids of parts, one or a list. explode is a factor. colors 'parts' gives each part a "
     "colour.\"}",
     put_parts},
    {"sections", MCP_DRAWING_TOOLS,
     OBJECT("Planes that cut the model open, with hatched caps: {'planes': [{'axis': 'x', 'fraction': 0.5}]}; a plane "
            "may have offset (a coordinate) instead of fraction, and keep 'positive' or 'negative'."),
     NULL},
    {"annotate", MCP_DRAWING_TOOLS,
     "{\"anyOf\":[{\"type\":\"boolean\"},{\"type\":\"array\",\"items\":{\"enum\":[$]}}],\"description\":\"Marks over "
     "each picture: box (dimensions of the bounds in the file's unit), title, triad (axes of the file), scale (a bar), "
     "labels (names of parts), holes (diameters and counts). true or false: captions of a sheet, which are the "
     "default.\"}",
     put_marks},
    {"width", MCP_DRAWING_TOOLS,
     SIDE(",\"description\":\"Pixels of each picture; 1024 for a sheet, 800, 640 or 512 by the number of views.\""),
     NULL},
    {"height", MCP_DRAWING_TOOLS, SIDE(""), NULL},
    {"format", 1 << MCP_RENDER,
     "{\"type\":\"string\",\"enum\":[$],\"description\":\"Default: png, or jpeg if the pictures would have more than "
     "700 kB.\"}",
     put_formats},
    {"image", 1 << MCP_PICK, WHOLE(",\"maximum\":7", "Number of the picture in the answer of render. Default: 0."),
     NULL},
    {"x", 1 << MCP_PICK, WHOLE("", "Column, from 0 at the left."), NULL},
    {"y", 1 << MCP_PICK, WHOLE("", "Row, from 0 at the top."), NULL},
    {"toX", 1 << MCP_PICK,
     WHOLE("",
           "With toY: another pixel of the same view. The answer has the distance, offset and angle to its surface."),
     NULL},
    {"toY", 1 << MCP_PICK, WHOLE("", "Its row."), NULL},
    {"a", 1 << MCP_COMPARE,
     "{\"type\":\"object\",\"description\":\"The first model, a file ($},\"additionalProperties\":false}", put_model},
    {"b", 1 << MCP_COMPARE,
     "{\"type\":\"object\",\"description\":\"The second model, a file ($},\"additionalProperties\":false}", put_model},
    {"align", 1 << MCP_COMPARE,
     "{\"type\":\"string\",\"enum\":[\"none\",\"bounds\",\"principal\",\"icp\"],\"description\":\"Motion of b "
     "before. bounds: the middles of the boxes meet. principal: turned and moved to the best place. icp: refined from "
     "its place. Default: none.\"}",
     NULL},
    {"rescale", 1 << MCP_COMPARE,
     "{\"type\":\"boolean\",\"description\":\"true: the alignment may scale b, too. Default: false.\"}", NULL},
    {"deviation", 1 << MCP_COMPARE,
     "{\"type\":\"boolean\",\"description\":\"false: without distances of the surfaces, which is faster.\"}", NULL},
    {"features", 1 << MCP_COMPARE, "{\"type\":\"boolean\",\"description\":\"false: without holes that differ.\"}",
     NULL},
    {"tolerance", 1 << MCP_COMPARE,
     "{\"type\":\"number\",\"minimum\":0,\"description\":\"Largest distance between surfaces that are the same. "
     "Default: a millionth of the size of a.\"}",
     NULL},
    {"show", 1 << MCP_COMPARE,
     "{\"type\":\"string\",\"enum\":[\"none\",\"difference\",\"deviation\",\"side\"],\"description\":\"Picture. "
     "difference, the default: common grey, only a amber, only b red. deviation: b coloured by its distance from a. "
     "side: both side by side. none: numbers alone.\"}",
     NULL},
    {"view", 1 << MCP_COMPARE,
     "{\"type\":\"string\",\"enum\":[$],\"description\":\"Side from which the picture is drawn.\"}", put_presets},
    ZR_DRAWING_ROWS(DRAWING_KEY){NULL, 0, NULL, NULL}};

void mcp_keys_put(struct mcp_text *text, const struct mcp_key *keys, unsigned of, const struct mcp_host *host)
{
    bool is_first = true;
    for (; keys->name; keys++) {
        if (!(keys->of & of)) continue;
        const char *schema = keys->schema;
        const size_t before = keys->put ? strcspn(schema, "$") : strlen(schema);
        mcp_text_print(text, "%s\"%s\":%.*s", is_first ? "" : ",", keys->name, (int)before, schema);
        if (keys->put) keys->put(text, host);
        if (keys->put) mcp_text_put(text, schema + before + 1);
        is_first = false;
    }
}

/* ---- words ---- */

static void add(struct mcp_words *words, size_t *count, const char *word)
{
    if (*count + 1 < MCP_WORDS_MAX) words->at[(*count)++] = word;
}

struct mcp_words mcp_words_of_keys(const struct mcp_key *keys, unsigned of)
{
    struct mcp_words words = {{NULL}};
    size_t count = 0;
    for (; keys->name; keys++)
        if (keys->of & of) add(&words, &count, keys->name);
    return words;
}

struct mcp_words mcp_words_of_formats(void)
{
    struct mcp_words words = {{NULL}};
    size_t count = 0;
    for (int i = 0; i < ZR_ENCODING_COUNT; i++)
        if (zr_encoding_has((enum zr_encoding)i, ZR_ENCODING_FOR_AGENTS)) add(&words, &count, zr_encoding_rows[i].word);
    return words;
}

const char *mcp_words_find(const struct mcp_words *words, const char *word)
{
    for (size_t i = 0; words->at[i]; i++)
        if (strcmp(words->at[i], word) == 0) return words->at[i];
    return NULL;
}
