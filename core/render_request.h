/* render_request.h - core: a request: its body, its query and its assets.
 *
 * Apart from core.h, so that a new format or parameter compiles only the files that read requests.
 */
#ifndef ZR_RENDER_REQUEST_H
#define ZR_RENDER_REQUEST_H

#include "core.h"
#include "format_rows.h"
#include "parameter_rows.h"

struct zr_request {
    enum zr_format format;
    const char *bytes;
    size_t size;
    const struct zr_asset *assets; /* names are unique; bare meshes other than glTF and OBJ use none */
    size_t asset_count;
    struct zr_stored stored; /* read may be NULL: no store */
    struct zr_kept_images images;
    struct zr_kept_texts texts;
    struct zr_kept_meshes meshes;
    /* Parameters of the query (parameter_rows.h), as text; NULL: not given. */
#define ZR_PARAMETER_FIELD(name, ...) const char *name;
    ZR_PARAMETER_ROWS(ZR_PARAMETER_FIELD)
#undef ZR_PARAMETER_FIELD
    const struct zr_cancel *cancel; /* cancels reading; NULL: never */
    struct zr_quick *quick;         /* NULL: no limit of time */
};

#endif
