#include "memory.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

bool memory_read(const char *text, size_t spare, size_t *bytes)
{
    static const char units[] = "KMGT";
    char *end;
    errno = 0;
    const double number = strtod(text, &end);
    if (strspn(text, "0123456789.") != (size_t)(end - text) || end == text || errno != 0 || !(number > 0.0))
        return false;
    double value = number;
    if (strcmp(end, "%") == 0) {
        if (number > 100.0) return false;
        value = number / 100.0 * (double)spare;
    } else if (*end) {
        const char *unit = strchr(units, *end);
        if (!unit || (end[1] && strcmp(end + 1, "B") != 0 && strcmp(end + 1, "iB") != 0)) return false;
        for (const char *at = units; at <= unit; at++)
            value *= 1024.0;
    }
    if (!(value >= 1.0)) return false;
    *bytes = value < (double)(SIZE_MAX / 2) ? (size_t)value : SIZE_MAX / 2;
    return true;
}
