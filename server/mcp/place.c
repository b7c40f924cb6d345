#include "place.h"

#include <math.h>
#include <string.h>

#include "tree.h"

enum { NAME_MAX_BYTES = 80, DIGITS_MOST = 15 };

void mcp_place_set_digits(struct mcp_text *text, const cJSON *box)
{
    double far = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        const double low = mcp_number_at(mcp_get(box, "min"), i), high = mcp_number_at(mcp_get(box, "max"), i);
        far = fmax(far, fmax(fabs(low), fabs(high)));
        size = fmax(size, high - low);
    }
    text->more_digits = far > size && size > 0 ? (int)fmin(ceil(log10(far / size)), DIGITS_MOST - MCP_PLACE_DIGITS) : 0;
}

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
    if (digits != MCP_DIRECTION_DIGITS) digits += text->more_digits;
    mcp_text_print(text, "%s(%.*g, %.*g, %.*g)", before, digits, at[0], digits, at[1], digits, at[2]);
}

void mcp_name_put(struct mcp_text *text, const cJSON *name)
{
    const char *words = cJSON_IsString(name) ? name->valuestring : "";
    mcp_text_put(text, "'");
    mcp_text_line(text, words, NAME_MAX_BYTES);
    mcp_text_put(text, strlen(words) > NAME_MAX_BYTES ? "...'" : "'");
}
