#include "place.h"

#include <math.h>

#include "tree.h"

enum { NAME_MAX_BYTES = 80 };

void mcp_place_put(struct mcp_text *text, const char *before, const cJSON *place, int digits, double zero)
{
    double at[3];
    if (!place) return;
    for (int i = 0; i < 3; i++) {
        at[i] = mcp_number_at(place, i);
        zero = fmax(zero, 1e-9 * fabs(at[i]));
    }
    for (int i = 0; i < 3; i++)
        at[i] = fabs(at[i]) > zero ? at[i] : 0;
    mcp_text_print(text, "%s(%.*g, %.*g, %.*g)", before, digits, at[0], digits, at[1], digits, at[2]);
}

void mcp_name_put(struct mcp_text *text, const cJSON *name)
{
    mcp_text_put(text, "'");
    mcp_text_line(text, cJSON_IsString(name) ? name->valuestring : "", NAME_MAX_BYTES);
    mcp_text_put(text, "'");
}
