#include "header.h"

#include <string.h>

#include "text.h"

bool mcp_header_is(const char *value, const char *text)
{
    static const char head[] = "=?base64?", tail[] = "?=";
    size_t length = strlen(value);
    while (length > 0 && (value[length - 1] == ' ' || value[length - 1] == '\t'))
        length--;
    if (length < sizeof head + 1 || memcmp(value, head, sizeof head - 1) != 0 ||
        memcmp(value + length - 2, tail, 2) != 0)
        return length == strlen(text) && memcmp(value, text, length) == 0;
    struct mcp_text wanted = {0};
    mcp_text_base64(&wanted, text, strlen(text));
    length -= sizeof head - 1 + sizeof tail - 1;
    const bool is_equal =
        !wanted.failed && wanted.size == length && memcmp(value + sizeof head - 1, wanted.data, length) == 0;
    mcp_text_free(&wanted);
    return is_equal;
}
