#include "input/json_rows.h"

const char *zr_row_number(const char *at, const char *end, double low, double high, float *out)
{
    double value;
    const char *behind = zr_number_quick(at, end, &value);
    if (!behind) behind = zr_number_read_json(at, end, &value);
    if (!behind || !(value >= low && value <= high)) return NULL;
    *out = (float)value;
    return zr_row_skip_space(behind, end);
}
