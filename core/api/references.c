#include "api/zraster.h"
#include "core.h"

size_t zraster_references(const void *body, size_t body_size, const char *type, char *names, size_t room)
{
    return zr_references_list(body, body_size, type, names, room);
}
