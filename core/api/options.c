#include "api/options.h"

#include <string.h>

static enum zr_status read(const void *given, size_t given_size, void *out, size_t size, const char *name,
                           struct zr_error *error)
{
    const unsigned char *bytes = given;
    memset(out, 0, size);
    if (given && given_size < sizeof given_size)
        return zr_error_add(error, ZR_BAD_REQUEST, NULL, "struct_size of %s is %zu; set it to sizeof", name,
                            given_size);
    for (size_t i = size; given && i < given_size; i++)
        if (bytes[i] != 0)
            return zr_error_add(error, ZR_BAD_REQUEST, NULL, "%s has a member that this version of zraster lacks",
                                name);
    if (given) memcpy(out, given, given_size < size ? given_size : size);
    return ZR_OK;
}

enum zr_status zr_options_read(const struct zraster_options *given, struct zraster_options *out, struct zr_error *error)
{
    return read(given, given ? given->struct_size : 0, out, sizeof *out, "zraster_options", error);
}

enum zr_status zr_request_struct_read(const struct zraster_request *given, struct zraster_request *out,
                                      struct zr_error *error)
{
    if (!given) return zr_error_add(error, ZR_BAD_REQUEST, NULL, "the request is NULL");
    return read(given, given->struct_size, out, sizeof *out, "zraster_request", error);
}
