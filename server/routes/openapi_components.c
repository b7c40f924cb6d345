#include "openapi.h"

#include "input/json/json_value.h"

/* clang-format off */

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

const char openapi_components[] = ZR_SCHEMA({
    "parameters": {
        "sha256": {
            "name": "sha256", "in": "path", "required": true, "description": "SHA-256 of the stored bytes.",
            "schema": {"type": "string", "pattern": "^[0-9a-f]{64}$"}
        },
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
            "example": "studio@1"
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
        "Vary": {"description": "Request headers that the answer depends on.", "schema": {"type": "string"}},
        "ETag": {"description": "Identifier of these bytes.", "schema": {"type": "string"}},
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
        "file": {
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
        "there": {
            "description": "It is stored.",
            "headers": {
                "ETag": {"$ref": "#/components/headers/ETag"},
                "X-Request-Id": {"$ref": "#/components/headers/X-Request-Id"}
            }
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
