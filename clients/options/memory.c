#include "memory.h"

#include <ctype.h>
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The smallest picture takes more. */
#define LEAST 1048576.0

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
        const char *unit = strchr(units, toupper((unsigned char)*end));
        if (!unit || (end[1] && strcasecmp(end + 1, "B") != 0 && strcasecmp(end + 1, "iB") != 0)) return false;
        for (const char *at = units; at <= unit; at++)
            value *= 1024.0;
    }
    if (!(value >= LEAST)) return false;
    *bytes = value < (double)(SIZE_MAX / 2) ? (size_t)value : SIZE_MAX / 2;
    return true;
}
