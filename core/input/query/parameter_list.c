#include "input/query/parameter_list.h"

#include "parameter_rows.h"
#include "render_request.h"

const struct zr_parameter_row zr_parameter_list[] = {
#define PARAMETER(name, pointer, scope, kind, help)                                                                    \
    {#name, pointer, ZR_PARAMETER_OF_##scope, ZR_PARAMETER_##kind, offsetof(struct zr_request, name)},
    ZR_PARAMETER_ROWS(PARAMETER)
#undef PARAMETER
};
const int zr_parameter_count = sizeof zr_parameter_list / sizeof zr_parameter_list[0];

const char *zr_parameter_text(const struct zr_request *request, const struct zr_parameter_row *row)
{
    return *(const char *const *)(const void *)((const char *)request + row->offset);
}
