#include "openapi.h"

#include <stddef.h>

#include "input/json/json_value.h"

/* clang-format off */

static const char assets[] = ZR_SCHEMA({
    "/v1/assets": {
        "post": {
            "operationId": "addAsset", "tags": ["assets"], "summary": "Store a file",
            "description": "The daemon computes the hash, by which scenes name the file: {\"asset\": \"sha256:...\"}.",
            "requestBody": {"$ref": "#/components/requestBodies/file"},
            "responses": {
                "200": {"$ref": "#/components/responses/stored"}, "201": {"$ref": "#/components/responses/stored"},
                "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        }
    }
});

static const char page[] = ZR_SCHEMA({
    "/": {
        "get": {
            "operationId": "getPage", "tags": ["page"], "summary": "Return the page for browsers", "security": [],
            "responses": {
                "200": {"description": "The page.", "content": {"text/html": {"schema": {"type": "string"}}}},
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/docs/{address}": {
        "parameters": [
            {"name": "address", "in": "path", "required": true, "description": "Address of a page or a picture.",
             "schema": {"type": "string"}}
        ],
        "get": {
            "operationId": "getManual", "tags": ["page"], "summary": "Return a page or a picture of the manual",
            "security": [],
            "responses": {
                "200": {
                    "description": "The page or picture.",
                    "content": {
                        "text/html": {"schema": {"type": "string"}}, "text/css": {"schema": {"type": "string"}},
                        "image/png": {}
                    }
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/engine/{name}": {
        "parameters": [
            {"name": "name", "in": "path", "required": true, "description": "Name of a file of --engine-dir.",
             "schema": {"type": "string"}}
        ],
        "get": {
            "operationId": "getEngine", "tags": ["page"], "summary": "Return a file with which the page draws by itself",
            "security": [],
            "responses": {
                "200": {
                    "description": "The file.",
                    "content": {"text/javascript": {"schema": {"type": "string"}}, "application/wasm": {}}
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/v1/looks": {
        "get": {
            "operationId": "getLooks", "tags": ["page"], "summary": "Return all looks with their versions",
            "responses": {
                "200": {
                    "description": "The looks.",
                    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/looks"}}}
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/v1/examples": {
        "get": {
            "operationId": "getExamples", "tags": ["page"], "summary": "Return the names of the examples",
            "responses": {
                "200": {
                    "description": "The examples.",
                    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/examples"}}}
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/v1/examples/{name}": {
        "parameters": [
            {"name": "name", "in": "path", "required": true, "description": "Name of a scene or of one of its files.",
             "schema": {"type": "string"}}
        ],
        "get": {
            "operationId": "getExample", "tags": ["page"], "summary": "Return a scene or a file of the examples",
            "responses": {
                "200": {
                    "description": "The file.",
                    "content": {
                        "application/json": {"schema": {"$ref": "#/components/schemas/scene"}},
                        "application/octet-stream": {
                            "schema": {"type": "string", "contentMediaType": "application/octet-stream"}
                        }
                    }
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/mcp": {
        "post": {
            "operationId": "callAgentTool", "tags": ["agents"], "summary": "Serve the Model Context Protocol",
            "requestBody": {
                "required": true,
                "content": {"application/json": {"schema": {"$ref": "#/components/schemas/jsonRpc"}}}
            },
            "responses": {
                "200": {
                    "description": "The reply.",
                    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/jsonRpc"}}}
                },
                "202": {"description": "A notification was taken."},
                "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        }
    }
});

static const char contract[] = ZR_SCHEMA({
    "/v1/limits": {
        "get": {
            "operationId": "getLimits", "tags": ["daemon"], "summary": "Return the limits in force",
            "responses": {
                "200": {
                    "description": "Version and limits.",
                    "content": {
                        "application/json": {
                            "schema": {
                                "type": "object", "required": ["version", "keepsAssets", "limits"],
                                "properties": {
                                    "version": {"type": "string"},
                                    "keepsAssets": {"type": "boolean"},
                                    "limits": {"type": "object", "additionalProperties": {"type": "number"}}
                                }
                            }
                        }
                    }
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/v1/openapi.json": {
        "get": {
            "operationId": "getOpenapi", "tags": ["contract"], "summary": "Return this description",
            "responses": {
                "200": {
                    "description": "OpenAPI 3.1.", "headers": {"ETag": {"$ref": "#/components/headers/ETag"}},
                    "content": {"application/json": {"schema": {"type": "object"}}}
                },
                "304": {"description": "Not modified: the client has this version."}, "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/v1/scene.schema.json": {
        "get": {
            "operationId": "getSceneSchema", "tags": ["contract"], "summary": "Return the JSON Schema of a scene",
            "responses": {
                "200": {
                    "description": "JSON Schema 2020-12.", "headers": {"ETag": {"$ref": "#/components/headers/ETag"}},
                    "content": {"application/schema+json": {"schema": {"type": "object"}}}
                },
                "304": {"description": "Not modified: the client has this version."}, "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/v1/schema/{object}.json": {
        "parameters": [
            {
                "name": "object", "in": "path", "required": true, "description": "Name of an object of a scene.",
                "schema": {"type": "string"}, "example": "light"
            }
        ],
        "get": {
            "operationId": "getSchema", "tags": ["contract"],
            "summary": "Return the JSON Schema of one object of a scene",
            "responses": {
                "200": {
                    "description": "JSON Schema 2020-12.", "headers": {"ETag": {"$ref": "#/components/headers/ETag"}},
                    "content": {"application/schema+json": {"schema": {"type": "object"}}}
                },
                "304": {"description": "Not modified: the client has this version."}, "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    }
});

static const char drake[] = ZR_SCHEMA({
    "/render": {
        "post": {
            "operationId": "renderDrake", "tags": ["render"], "summary": "Draw a form of Drake",
            "requestBody": {
                "required": true,
                "content": {
                    "multipart/form-data": {
                        "schema": {
                            "type": "object",
                            "required": [
                                "scene", "image_type", "width", "height", "near", "far", "focal_x", "focal_y",
                                "center_x", "center_y"
                            ],
                            "properties": {
                                "scene": {
                                    "description": "glTF file with a camera.", "type": "string",
                                    "contentMediaType": "model/gltf+json"
                                },
                                "image_type": {"enum": ["color", "depth", "label"]},
                                "width": {"type": "integer", "minimum": 1},
                                "height": {"type": "integer", "minimum": 1},
                                "near": {"type": "number", "exclusiveMinimum": 0},
                                "far": {"type": "number", "exclusiveMinimum": 0},
                                "focal_x": {"type": "number", "exclusiveMinimum": 0},
                                "focal_y": {"type": "number", "exclusiveMinimum": 0}, "center_x": {"type": "number"},
                                "center_y": {"type": "number"}, "min_depth": {"type": "number"},
                                "max_depth": {"type": "number"}, "fov_x": {"type": "number", "exclusiveMinimum": 0},
                                "fov_y": {"type": "number", "exclusiveMinimum": 0},
                                "scene_sha256": {"type": "string"}, "submit": {"type": "string"}
                            }
                        }
                    }
                }
            },
            "responses": {
                "200": {
                    "description": "The image.",
                    "content": {
                        "image/png": {"schema": {"type": "string", "contentMediaType": "image/png"}},
                        "image/tiff": {"schema": {"type": "string", "contentMediaType": "image/tiff"}}
                    }
                },
                "4XX": {
                    "description": "A line for each fault.",
                    "content": {"text/plain": {"schema": {"type": "string"}}}
                },
                "5XX": {"description": "The reason.", "content": {"text/plain": {"schema": {"type": "string"}}}}
            }
        }
    }
});

static const char compare[] = ZR_SCHEMA({
    "/v1/compare": {
        "post": {
            "operationId": "compare", "tags": ["render"], "summary": "Compare two models",
            "parameters": [
                {
                    "name": "align", "in": "query", "description": "Motion of b before.",
                    "schema": {"enum": ["none", "bounds", "principal", "icp"]}
                },
                {
                    "name": "tolerance", "in": "query", "description": "Largest distance of surfaces that are the same.",
                    "schema": {"type": "number", "minimum": 0}
                },
                {
                    "name": "precision", "in": "query", "description": "quick: fewer rays and points.",
                    "schema": {"enum": ["full", "quick"]}
                },
                {
                    "name": "deviation", "in": "query", "description": "off: without distances between the surfaces.",
                    "schema": {"enum": ["on", "off"]}
                },
                {
                    "name": "features", "in": "query", "description": "off: without holes that differ.",
                    "schema": {"enum": ["on", "off"]}
                },
                {
                    "name": "rescale", "in": "query", "description": "on: the alignment may scale b.",
                    "schema": {"enum": ["on", "off"]}
                },
                {
                    "name": "show", "in": "query",
                    "description": "Kind of a picture; parameters of /v1/render set its look and size.",
                    "schema": {"enum": ["none", "difference", "deviation", "side"]}
                }
            ],
            "requestBody": {
                "required": true,
                "content": {
                    "multipart/form-data": {
                        "schema": {
                            "type": "object", "required": ["a", "b"],
                            "properties": {
                                "a": {"description": "First model.", "type": "string"},
                                "b": {"description": "Second model.", "type": "string"}
                            }
                        }
                    }
                }
            },
            "responses": {
                "200": {
                    "description": "The numbers, a picture, or both.",
                    "content": {
                        "application/json": {"schema": {"type": "object"}},
                        "image/png": {"schema": {"type": "string", "contentMediaType": "image/png"}},
                        "multipart/mixed": {"schema": {"type": "string"}}
                    }
                },
                "503": {"$ref": "#/components/responses/busy"}, "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    }
});

static const char drawing[] = ZR_SCHEMA({
    "/v1/drawing": {
        "post": {
            "operationId": "draw", "tags": ["render"], "summary": "Make a technical drawing of a model",
            "parameters": [
                {"name": "page", "in": "query", "description": "Paper.", "schema": {"enum": ["a4", "a3"]}},
                {
                    "name": "scale", "in": "query", "description": "Scale; otherwise the largest standard one that fits.",
                    "schema": {"type": "string", "pattern": "^[0-9]+:[0-9]+$"}
                },
                {
                    "name": "projection", "in": "query", "description": "Places of the views.",
                    "schema": {"enum": ["third", "first"]}
                },
                {
                    "name": "section", "in": "query", "description": "Section A-A: an axis, and a share of the bounds.",
                    "schema": {"type": "string", "pattern": "^[xyz](:[0-9.]+)?$"}
                },
                {
                    "name": "hidden", "in": "query", "description": "Hidden lines in dashes.",
                    "schema": {"type": "boolean"}
                },
                {"name": "title", "in": "query", "description": "Title.", "schema": {"type": "string"}},
                {"name": "date", "in": "query", "description": "Date.", "schema": {"type": "string"}},
                {"name": "format", "in": "query", "description": "Format.", "schema": {"enum": ["svg", "png"]}},
                {
                    "name": "dpi", "in": "query", "description": "Pixels per inch of a PNG.",
                    "schema": {"type": "number", "minimum": 30, "maximum": 600}
                }
            ],
            "requestBody": {
                "required": true, "description": "A scene or model, as for /v1/render.",
                "content": {
                    "application/octet-stream": {"schema": {"type": "string"}},
                    "multipart/form-data": {"schema": {"type": "object"}}
                }
            },
            "responses": {
                "200": {
                    "description": "The drawing.",
                    "content": {
                        "image/svg+xml": {"schema": {"type": "string", "contentMediaType": "image/svg+xml"}},
                        "image/png": {"schema": {"type": "string", "contentMediaType": "image/png"}}
                    }
                },
                "503": {"$ref": "#/components/responses/busy"}, "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    }
});

static const char health[] = ZR_SCHEMA({
    "/healthz": {
        "get": {
            "operationId": "getHealth", "tags": ["daemon"], "summary": "Tell whether the process works",
            "security": [],
            "responses": {
                "200": {
                    "description": "It works.",
                    "content": {
                        "application/json": {
                            "schema": {
                                "type": "object", "required": ["status"], "properties": {"status": {"const": "ok"}}
                            }
                        }
                    }
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/metrics": {
        "get": {
            "operationId": "getMetrics", "tags": ["daemon"], "summary": "Return metrics for Prometheus",
            "description": "The text format 0.0.4, or OpenMetrics 1.0 if Accept names it.", "security": [],
            "responses": {
                "200": {
                    "description": "The metrics.",
                    "content": {
                        "text/plain": {"schema": {"type": "string"}},
                        "application/openmetrics-text": {"schema": {"type": "string"}}
                    }
                },
                "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    },
    "/readyz": {
        "get": {
            "operationId": "getReadiness", "tags": ["daemon"], "summary": "Tell whether the daemon accepts work",
            "security": [],
            "responses": {
                "200": {
                    "description": "It accepts work.",
                    "content": {
                        "application/json": {
                            "schema": {
                                "type": "object", "required": ["status"],
                                "properties": {"status": {"const": "ready"}}
                            }
                        }
                    }
                },
                "503": {"$ref": "#/components/responses/busy"}, "4XX": {"$ref": "#/components/responses/problem"}
            }
        }
    }
});

const char *const openapi_paths[] = {assets, compare, contract, drake, drawing, health, page, NULL};
