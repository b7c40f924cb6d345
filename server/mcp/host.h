/* host.h - mcp: the functions that the handler of messages calls: they draw, and allocate memory. The daemon draws as
 * POST /v1/render does, the command by libzraster. */
#ifndef MCP_HOST_H
#define MCP_HOST_H

#include <stdbool.h>
#include <stddef.h>

#include "base/cancel.h"
#include "span.h"

enum { MCP_FAULTS_MAX = 20, MCP_POINTER_SIZE = 192, MCP_DETAIL_SIZE = 1300 };

/* A fault of the arguments, which the caller can mend. */
struct mcp_fault {
    char pointer[MCP_POINTER_SIZE]; /* JSON Pointer, or "" */
    char detail[MCP_DETAIL_SIZE];
};
struct mcp_faults {
    size_t count;
    struct mcp_fault at[MCP_FAULTS_MAX];
};

/* A scene to draw, which names the file of the model, if there is one, by {"asset": file_name}. */
struct mcp_draw {
    const char *scene; /* JSON */
    size_t scene_size;
    const char *file_name;
    const void *file; /* bytes of the model; NULL: none, or one that the host reads */
    size_t file_size;
    const char *path; /* of the model, below the host's root; the scene names its last part; NULL: none */
};

enum mcp_draw_status {
    MCP_DRAWN,
    MCP_REFUSED,  /* `faults` has the reasons */
    MCP_LATER,    /* the daemon's worker must hand the request on; the whole message comes again */
    MCP_CANCELLED /* by the client, or after a timeout */
};

struct mcp_drawn {
    const void *bytes; /* a file, or a ZIP of several, until `release` */
    size_t size;
    bool is_zip;
    struct mcp_faults faults;
    void *owner; /* the host's */
};

/* Two models to compare, each as a scene to draw. */
struct mcp_compare {
    struct mcp_draw sides[2];
    const char *query; /* of comparing (request/compare.h) */
};

/* Numbers in JSON, whose "summary" is one line of words, and a picture. */
struct mcp_told {
    const char *json;    /* until `release_told`, like the picture */
    const void *picture; /* a PNG, or a drawing as SVG; NULL: none */
    size_t picture_size;
    struct mcp_faults faults; /* pointers into a model have the name of its argument: "/a/path" */
    void *owner;              /* the host's */
};

struct mcp_host {
    void *context;
    const char *version;
    bool reads_files;                                 /* models may be paths; else they may be stored assets */
    void (*begin)(void *context, struct mcp_span id); /* called before a request runs; may be NULL */
    const struct zr_cancel *cancel;                   /* of the request; NULL: none */
    void *(*allocate)(void *context, size_t size);    /* until the end of the message; NULL: out of memory */
    enum mcp_draw_status (*draw)(void *context, const struct mcp_draw *draw, struct mcp_drawn *drawn);
    void (*release)(void *context, struct mcp_drawn *drawn); /* after MCP_DRAWN */
    /* Compares; NULL: the host does not. */
    enum mcp_draw_status (*compare)(void *context, const struct mcp_compare *compare, struct mcp_told *told);
    /* Makes a technical drawing; `query` is that of core/drawing_rows.h. NULL: the host does not. */
    enum mcp_draw_status (*drawing)(void *context, const struct mcp_draw *draw, const char *query,
                                    struct mcp_told *told);
    void (*release_told)(void *context, struct mcp_told *told); /* after MCP_DRAWN */
};

static inline bool mcp_host_is_cancelled(const struct mcp_host *host)
{
    return zr_is_cancelled(host->cancel);
}

#endif
