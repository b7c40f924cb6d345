#include "openapi.h"

#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "input/formats/formats.h"
#include "output/json/json_print.h"
#include "request/encode.h"
#include "schema/parameters.h"
#include "schema/schema.h"

static const char refs[] = "#/components/schemas/";

/* clang-format off */

/* ---- bodies and answers ---- */

/* Prints each media type of the formats, as binary data but for scenes. */
static void print_body(struct zr_print *print)
{
    zr_print_begin(print, "requestBody", '{');
    zr_print_string(print, "description", "A scene, a model, or parts: the part scene and the files that it names.");
    zr_print_bool(print, "required", true);
    zr_print_begin(print, "content", '{');
    for (int i = 0; i < ZR_FORMAT_COUNT; i++) {
        const char *type = zr_format_rows[i].media_types;
        while (*type) {
            char name[96];
            const size_t length = strcspn(type, " ");
            snprintf(name, sizeof name, "%.*s", (int)length, type);
            zr_print_json(print, name,
                          zr_format_rows[i].has_view ? ZR_SCHEMA({
                              "schema": {"$ref": "#/components/schemas/scene"}
                          })
                                                     : ZR_SCHEMA({
                                                         "schema": {
                                                             "type": "string",
                                                             "contentMediaType": "application/octet-stream"
                                                         }
                                                     }));
            type += length + strspn(type + length, " ");
        }
    }
    zr_print_members(print, ZR_SCHEMA({
        "application/octet-stream": {
            "schema": {
                "description": "A body of any format, detected from its bytes.", "type": "string",
                "contentMediaType": "application/octet-stream"
            }
        },
        "multipart/form-data": {
            "schema": {
                "type": "object", "required": ["scene"],
                "properties": {
                    "scene": {
                        "description": "The body, of any type.",
                        "anyOf": [
                            {"$ref": "#/components/schemas/scene"},
                            {"type": "string", "contentMediaType": "application/octet-stream"}
                        ]
                    }
                },
                "additionalProperties": {
                    "description": "The file that the scene refers to by this name.",
                    "type": "string", "contentMediaType": "application/octet-stream"
                }
            }
        }
    }));
    zr_print_end(print, '}');
    zr_print_end(print, '}');
}

/* Prints the media types of the encodings, each once. */
static void print_pictures(struct zr_print *print, bool has_parts)
{
    zr_print_begin(print, "content", '{');
    for (int i = 0; i < ZR_ENCODING_COUNT; i++) {
        bool is_new = i != ZR_ENCODING_ZIP; /* below, with that of several outputs */
        for (int k = 0; k < i; k++)
            is_new &= strcmp(zr_encoding_rows[i].type, zr_encoding_rows[k].type) != 0;
        if (!is_new) continue;
        zr_print_json(print, zr_encoding_rows[i].type,
                      i == ZR_ENCODING_JSON ? ZR_SCHEMA({"schema": {"type": "object"}})
                                            : ZR_SCHEMA({
                                                "schema": {
                                                    "type": "string", "contentMediaType": "application/octet-stream"
                                                }
                                            }));
    }
    zr_print_members(print, ZR_SCHEMA({
        "application/zip": {
            "schema": {
                "description": "Files of several outputs: CHANNEL.EXTENSION.",
                "type": "string", "contentMediaType": "application/zip"
            }
        }
    }));
    if (has_parts) zr_print_members(print, ZR_SCHEMA({
        "multipart/mixed": {
            "schema": {
                "description": "Files of several outputs, and those of several views as soon as each is drawn.",
                "type": "string", "contentMediaType": "multipart/mixed"
            }
        },
        "multipart/form-data": {
            "schema": {
                "description": "The same for browsers: the field CHANNEL has the file CHANNEL.EXTENSION.",
                "type": "object", "additionalProperties": {
                    "type": "string", "contentMediaType": "application/octet-stream"
                }
            }
        }
    }));
    zr_print_end(print, '}');
}

static const char picture_headers[] = ZR_SCHEMA({
    "X-Request-Id": {"$ref": "#/components/headers/X-Request-Id"},
    "Zraster-Version": {"$ref": "#/components/headers/Zraster-Version"},
    "Zraster-Look": {"$ref": "#/components/headers/Zraster-Look"},
    "Zraster-Encoder": {"$ref": "#/components/headers/Zraster-Encoder"},
    "Zraster-Warnings": {"$ref": "#/components/headers/Zraster-Warnings"},
    "Server-Timing": {"$ref": "#/components/headers/Server-Timing"},
    "traceresponse": {"$ref": "#/components/headers/traceresponse"}
});

static const char render_headers[] = ZR_SCHEMA({"Vary": {"$ref": "#/components/headers/Vary"}});

static const char address_headers[] = ZR_SCHEMA({
    "ETag": {"$ref": "#/components/headers/ETag"},
    "Cache-Control": {"$ref": "#/components/headers/Cache-Control"},
    "Accept-Ranges": {"$ref": "#/components/headers/Accept-Ranges"}
});

/* Prints the headers of all pictures, and `others`. */
static void print_headers(struct zr_print *print, const char *others)
{
    zr_print_begin(print, "headers", '{');
    zr_print_members(print, picture_headers);
    zr_print_members(print, others);
    zr_print_end(print, '}');
}

static const char address_faults[] = ZR_SCHEMA({
    "304": {"description": "Not modified: the client has this picture."},
    "400": {"$ref": "#/components/responses/problem"}, "401": {"$ref": "#/components/responses/problem"},
    "403": {"$ref": "#/components/responses/problem"}, "404": {"$ref": "#/components/responses/problem"},
    "413": {"$ref": "#/components/responses/problem"}, "422": {"$ref": "#/components/responses/problem"},
    "429": {"$ref": "#/components/responses/busy"},
    "503": {"$ref": "#/components/responses/busy"}, "504": {"$ref": "#/components/responses/problem"},
    "default": {"$ref": "#/components/responses/problem"}
});

static const char head_faults[] = ZR_SCHEMA({
    "304": {"description": "Not modified: the client has this picture."}, "4XX": {"description": "There is no such picture."},
    "default": {"description": "The daemon is too busy to tell."}
});

/* Prints one path of pictures with addresses. `parameters`: those of the path. */
static void print_address(struct zr_print *print, const char *path, const char *const ids[2], const char *parameters,
                          const struct zr_limits *limits)
{
    zr_print_begin(print, path, '{');
    zr_print_json(print, "parameters", parameters);
    for (int is_head = 0; is_head < 2; is_head++) {
        zr_print_begin(print, is_head ? "head" : "get", '{');
        zr_print_string(print, "operationId", ids[is_head]);
        zr_print_json(print, "tags", ZR_SCHEMA(["render"]));
        zr_print_string(print, "summary",
                        is_head ? "Return the headers of a picture without drawing it" : "Draw a stored scene or model");
        zr_parameters_print(print, limits);
        zr_print_begin(print, "responses", '{');
        zr_print_begin(print, "200", '{');
        zr_print_string(print, "description", is_head ? "The picture can be drawn." : "The outputs.");
        print_headers(print, address_headers);
        if (!is_head) print_pictures(print, false);
        zr_print_end(print, '}');
        zr_print_members(print, is_head ? head_faults : address_faults);
        zr_print_end(print, '}');
        zr_print_end(print, '}');
    }
    zr_print_end(print, '}');
}

/* Prints a path below which files are stored. */
static void print_stored(struct zr_print *print, const char *path, const char *name, const char *what)
{
    static const struct {
        const char *method, *id, *summary, *members;
    } rows[] = {
        {"put", "put", "Store %s under its hash", ZR_SCHEMA({
            "requestBody": {"$ref": "#/components/requestBodies/file"},
            "responses": {
                "200": {"$ref": "#/components/responses/stored"}, "201": {"$ref": "#/components/responses/stored"},
                "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        })},
        {"get", "get", "Return %s", ZR_SCHEMA({
            "responses": {
                "200": {"$ref": "#/components/responses/file"}, "304": {"description": "Not modified: the client has this file."},
                "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        })},
        {"head", "has", "Tell whether %s is stored", ZR_SCHEMA({
            "responses": {
                "200": {"$ref": "#/components/responses/there"}, "304": {"description": "Not modified: the client has this file."},
                "4XX": {"description": "It is not stored."}
            }
        })},
    };
    char text[96];
    zr_print_begin(print, path, '{');
    zr_print_json(print, "parameters", ZR_SCHEMA([{"$ref": "#/components/parameters/sha256"}]));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        zr_print_begin(print, rows[i].method, '{');
        snprintf(text, sizeof text, "%s%s", rows[i].id, name);
        zr_print_string(print, "operationId", text);
        zr_print_json(print, "tags", ZR_SCHEMA(["assets"]));
        snprintf(text, sizeof text, rows[i].summary, what);
        zr_print_string(print, "summary", text);
        zr_print_members(print, rows[i].members);
        zr_print_end(print, '}');
    }
    zr_print_end(print, '}');
}

static void print_addresses(struct zr_print *print, const struct zr_limits *limits)
{
    static const char *const plain[] = {"getRender", "headRender"}, *const preset[] = {"getPreset", "headPreset"};
    print_address(print, "/v1/renders/{sha256}", plain, ZR_SCHEMA([
        {"$ref": "#/components/parameters/sha256"},
        {"$ref": "#/components/parameters/exp"},
        {"$ref": "#/components/parameters/signature"}
    ]), limits);
    print_address(print, "/v1/renders/{sha256}/{preset}", preset, ZR_SCHEMA([
        {"$ref": "#/components/parameters/sha256"},
        {
            "name": "preset", "in": "path", "required": true, "description": "Name of a preset of the daemon.",
            "schema": {"type": "string"}
        },
        {"$ref": "#/components/parameters/exp"},
        {"$ref": "#/components/parameters/signature"}
    ]), limits);
}

static void print_render(struct zr_print *print, const struct zr_limits *limits)
{
    zr_print_begin(print, "/v1/render", '{');
    zr_print_begin(print, "post", '{');
    zr_print_members(print, ZR_SCHEMA({
        "operationId": "render", "tags": ["render"], "summary": "Draw a scene or a model",
        "description": "One output is answered as its file, several as a ZIP archive or in parts. Parameters set keys of the scene."
    }));
    zr_parameters_print(print, limits);
    print_body(print);
    zr_print_begin(print, "responses", '{');
    zr_print_begin(print, "200", '{');
    zr_print_string(print, "description", "The outputs.");
    print_headers(print, render_headers);
    print_pictures(print, true);
    zr_print_end(print, '}');
    zr_print_members(print, ZR_SCHEMA({
        "400": {"$ref": "#/components/responses/problem"}, "401": {"$ref": "#/components/responses/problem"},
        "408": {"$ref": "#/components/responses/problem"}, "413": {"$ref": "#/components/responses/problem"},
        "415": {"$ref": "#/components/responses/problem"}, "422": {"$ref": "#/components/responses/problem"},
        "429": {"$ref": "#/components/responses/busy"}, "503": {"$ref": "#/components/responses/busy"},
        "504": {"$ref": "#/components/responses/problem"}, "default": {"$ref": "#/components/responses/problem"}
    }));
    zr_print_end(print, '}');
    zr_print_end(print, '}');
    zr_print_end(print, '}');
}

void openapi_print(struct zr_buffer *out, const struct zr_limits *limits)
{
    struct zr_print print = {.out = out};
    zr_print_begin(&print, NULL, '{');
    zr_print_string(&print, "openapi", "3.1.0");
    zr_print_begin(&print, "info", '{');
    zr_print_string(&print, "title", "zraster");
    zr_print_string(&print, "version", ZR_VERSION);
    zr_print_members(&print, ZR_SCHEMA({
        "summary": "Draws scenes and models to pictures, depth maps and ids.",
        "license": {"name": "MIT", "identifier": "MIT"}
    }));
    zr_print_end(&print, '}');
    zr_print_json(&print, "servers", ZR_SCHEMA([{"url": "/"}]));
    zr_print_json(&print, "security", ZR_SCHEMA([{}, {"token": []}]));
    zr_print_json(&print, "tags", ZR_SCHEMA([
        {"name": "render", "description": "Pictures."},
        {"name": "assets", "description": "Files that scenes name by their hash."},
        {"name": "contract", "description": "This description and the schema of scenes."},
        {"name": "page", "description": "The page and its examples."}, {"name": "agents", "description": "Tools of agents."},
        {"name": "daemon", "description": "State and limits."}
    ]));
    zr_print_begin(&print, "paths", '{');
    print_render(&print, limits);
    print_addresses(&print, limits);
    print_stored(&print, "/v1/assets/{sha256}", "Asset", "a file");
    print_stored(&print, "/v1/scenes/{sha256}", "Scene", "a scene or model");
    for (const char *const *path = openapi_paths; *path; path++)
        zr_print_members(&print, *path);
    zr_print_end(&print, '}');
    zr_print_begin(&print, "components", '{');
    zr_print_members(&print, openapi_components);
    zr_print_begin(&print, "schemas", '{');
    zr_schema_print_all(&print, limits, refs);
    zr_print_json(&print, "problem", openapi_problem);
    zr_print_members(&print, openapi_page_schemas);
    zr_print_end(&print, '}');
    zr_print_end(&print, '}');
    zr_print_end(&print, '}');
}
