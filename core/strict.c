#include "strict.h"

enum zr_status zr_strict_check(const struct zr_scene *scene, const char *const *texts, size_t count,
                               struct zr_error *error)
{
    enum zr_status status = ZR_OK;
    for (size_t i = 0; scene->is_strict && i < count; i++)
        status = zr_error_add(error, ZR_BAD_SCENE, NULL, "%s", texts[i]);
    return status;
}
