#include "openapi_texts.h"

#include <stddef.h>

#include "input/json_value.h"

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
    },
    "/v1/assets/{sha256}": {
        "parameters": [
            {
                "name": "sha256", "in": "path", "required": true, "description": "SHA-256 of the bytes.",
                "schema": {"type": "string", "pattern": "^[0-9a-f]{64}$"}
            }
        ],
        "put": {
            "operationId": "putAsset", "tags": ["assets"], "summary": "Store a file under its hash",
            "requestBody": {"$ref": "#/components/requestBodies/file"},
            "responses": {
                "200": {"$ref": "#/components/responses/stored"}, "201": {"$ref": "#/components/responses/stored"},
                "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        },
        "get": {
            "operationId": "getAsset", "tags": ["assets"], "summary": "Return a stored file",
            "responses": {
                "200": {
                    "description": "The bytes.",
                    "headers": {
                        "ETag": {"$ref": "#/components/headers/ETag"},
                        "X-Request-Id": {"$ref": "#/components/headers/X-Request-Id"}
                    },
                    "content": {
                        "application/octet-stream": {
                            "schema": {"type": "string", "contentMediaType": "application/octet-stream"}
                        }
                    }
                },
                "304": {"description": "The client has the file."}, "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        },
        "head": {
            "operationId": "hasAsset", "tags": ["assets"], "summary": "Tell whether a file is stored",
            "responses": {
                "200": {
                    "description": "It is stored.",
                    "headers": {
                        "ETag": {"$ref": "#/components/headers/ETag"},
                        "X-Request-Id": {"$ref": "#/components/headers/X-Request-Id"}
                    }
                },
                "304": {"description": "The client has the file."}, "4XX": {"description": "It is not stored."}
            }
        }
    },
    "/v1/scenes/{sha256}": {
        "parameters": [
            {
                "name": "sha256", "in": "path", "required": true, "description": "SHA-256 of the bytes.",
                "schema": {"type": "string", "pattern": "^[0-9a-f]{64}$"}
            }
        ],
        "put": {
            "operationId": "putScene", "tags": ["assets"], "summary": "Store a scene or model under its hash",
            "requestBody": {"$ref": "#/components/requestBodies/file"},
            "responses": {
                "200": {"$ref": "#/components/responses/stored"}, "201": {"$ref": "#/components/responses/stored"},
                "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        },
        "get": {
            "operationId": "getScene", "tags": ["assets"], "summary": "Return a stored scene or model",
            "responses": {
                "200": {
                    "description": "The bytes.",
                    "headers": {
                        "ETag": {"$ref": "#/components/headers/ETag"},
                        "X-Request-Id": {"$ref": "#/components/headers/X-Request-Id"}
                    },
                    "content": {
                        "application/octet-stream": {
                            "schema": {"type": "string", "contentMediaType": "application/octet-stream"}
                        }
                    }
                },
                "304": {"description": "The client has the file."}, "4XX": {"$ref": "#/components/responses/problem"},
                "default": {"$ref": "#/components/responses/problem"}
            }
        },
        "head": {
            "operationId": "hasScene", "tags": ["assets"], "summary": "Tell whether a scene is stored",
            "responses": {
                "200": {
                    "description": "It is stored.",
                    "headers": {
                        "ETag": {"$ref": "#/components/headers/ETag"},
                        "X-Request-Id": {"$ref": "#/components/headers/X-Request-Id"}
                    }
                },
                "304": {"description": "The client has the file."}, "4XX": {"description": "It is not stored."}
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

const char openapi_page_schemas[] = ZR_SCHEMA({
    "looks": {
        "type": "object", "required": ["looks"],
        "properties": {"looks": {"type": "array", "items": {
            "type": "object", "required": ["name", "text", "versions"],
            "properties": {
                "name": {"type": "string"}, "text": {"type": "string"},
                "versions": {"type": "array", "items": {"type": "integer"}}
            }
        }}}
    },
    "examples": {
        "type": "object", "required": ["examples"],
        "properties": {"examples": {"type": "array", "items": {
            "type": "object", "required": ["name", "title", "files"],
            "properties": {
                "name": {"type": "string"}, "title": {"type": "string"},
                "files": {"type": "array", "items": {"type": "string"}}
            }
        }}}
    },
    "jsonRpc": {
        "description": "A message of JSON-RPC 2.0.", "type": "object", "required": ["jsonrpc"],
        "properties": {"jsonrpc": {"const": "2.0"}, "method": {"type": "string"}, "params": {"type": "object"}}
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
                                "type": "object", "required": ["version", "limits"],
                                "properties": {
                                    "version": {"type": "string"},
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
                "304": {"description": "The client has it."}, "4XX": {"$ref": "#/components/responses/problem"}
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
                "304": {"description": "The client has it."}, "4XX": {"$ref": "#/components/responses/problem"}
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
                "304": {"description": "The client has it."}, "4XX": {"$ref": "#/components/responses/problem"}
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

const char openapi_components[] = ZR_SCHEMA({
    "parameters": {
        "exp": {
            "name": "exp", "in": "query",
            "description": "End of the signature, in seconds since 1970; without it, there is none.",
            "schema": {"type": "integer", "minimum": 0}
        },
        "signature": {
            "name": "signature", "in": "query",
            "description": "HMAC-SHA256 of path and query before this parameter, which is the last one.",
            "schema": {"type": "string", "pattern": "^[0-9a-f]{64}$"}
        }
    },
    "securitySchemes": {
        "token": {"type": "http", "scheme": "bearer", "description": "The token of a daemon that has one."}
    },
    "headers": {
        "X-Request-Id": {
            "description": "Id of the request: the client's, or a new one.",
            "schema": {"type": "string"}
        },
        "Zraster-Version": {"description": "Version of the daemon.", "schema": {"type": "string"}},
        "Zraster-Look": {
            "description": "Look of the picture with its version.", "schema": {"type": "string"},
            "example": "studio@2"
        },
        "Zraster-Encoder": {
            "description": "Libraries that decide the bytes of a JPEG or WebP, with their versions.",
            "schema": {"type": "string"}
        },
        "Zraster-Warnings": {"description": "Warnings, joined by semicolons.", "schema": {"type": "string"}},
        "Server-Timing": {"description": "Times of the steps in ms.", "schema": {"type": "string"}},
        "traceresponse": {
            "description": "Answer to a traceparent: the trace and the span of this request.",
            "schema": {"type": "string"},
            "example": "00-0af7651916cd43dd8448eb211c80319c-00f067aa0ba902b7-01"
        },
        "Vary": {"description": "Headers that decide about the answer.", "schema": {"type": "string"}},
        "ETag": {"description": "Name of these bytes.", "schema": {"type": "string"}},
        "Cache-Control": {"description": "Time for which caches keep the answer.", "schema": {"type": "string"}},
        "Accept-Ranges": {"description": "none: the answer is always whole.", "schema": {"type": "string"}},
        "Location": {"description": "Path of the asset.", "schema": {"type": "string"}},
        "Retry-After": {"description": "Seconds to wait.", "schema": {"type": "integer"}}
    },
    "requestBodies": {
        "file": {
            "required": true,
            "content": {
                "application/octet-stream": {
                    "schema": {"type": "string", "contentMediaType": "application/octet-stream"}
                }
            }
        }
    },
    "responses": {
        "problem": {
            "description": "The reasons, with JSON Pointers.",
            "headers": {"X-Request-Id": {"$ref": "#/components/headers/X-Request-Id"}},
            "content": {"application/problem+json": {"schema": {"$ref": "#/components/schemas/problem"}}}
        },
        "busy": {
            "description": "No work is accepted now.",
            "headers": {"Retry-After": {"$ref": "#/components/headers/Retry-After"}},
            "content": {"application/problem+json": {"schema": {"$ref": "#/components/schemas/problem"}}}
        },
        "stored": {
            "description": "Hash and size of the file.",
            "headers": {"Location": {"$ref": "#/components/headers/Location"}},
            "content": {
                "application/json": {
                    "schema": {
                        "type": "object", "required": ["sha256", "size"],
                        "properties": {
                            "sha256": {"type": "string", "pattern": "^[0-9a-f]{64}$"},
                            "size": {"type": "integer", "minimum": 0}
                        }
                    }
                }
            }
        }
    }
});

const char openapi_problem[] = ZR_SCHEMA({
    "description": "An error (RFC 9457).", "type": "object", "required": ["type", "title", "status", "detail"],
    "properties": {
        "type": {"const": "about:blank"}, "title": {"type": "string"}, "status": {"type": "integer"},
        "detail": {"type": "string"},
        "errors": {
            "type": "array", "maxItems": 20,
            "items": {
                "type": "object", "required": ["pointer", "detail"],
                "properties": {
                    "pointer": {"description": "JSON Pointer (RFC 6901) to the key.", "type": "string"},
                    "detail": {"type": "string"},
                    "offset": {
                        "description": "Of broken JSON: the byte at which it breaks, from 0.",
                        "type": "integer", "minimum": 0
                    }
                }
            }
        },
        "truncated": {"description": "There may be more errors.", "type": "boolean"}
    }
});

const char *const openapi_paths[] = {assets, contract, drake, health, page, NULL};
