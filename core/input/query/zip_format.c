/* Detects ZIP archives. core/request/read.c replaces an archive by the model in it (zip_body.h). The reader here therefore gets
 * only an archive within an archive. */
#include <string.h>

#include "input/formats/input.h"

/* An archive begins with a member, or with its end if it is empty. */
bool zr_looks_so_ZIP(const char *bytes, size_t size)
{
    return size >= 4 && (memcmp(bytes, "PK\3\4", 4) == 0 || memcmp(bytes, "PK\5\6", 4) == 0);
}

enum zr_status zr_read_ZIP(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    (void)builder, (void)request, (void)limits;
    return zr_error_add(error, ZR_BAD_SCENE, NULL, "a ZIP archive within a ZIP archive is not read");
}
