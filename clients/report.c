#include "report.h"

#include <cjson/cJSON.h>
#include <string.h>

static const char *text_of(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, key));
    return text ? text : "";
}

/* The detail of a problem repeats its first error: it is shown only where there are none. */
void report_problem(FILE *out, const char *file, long status, const struct bytes *answer)
{
    cJSON *problem = cJSON_ParseWithLength(answer->data ? answer->data : "", answer->size);
    const char *title = text_of(problem, "title"), *detail = text_of(problem, "detail");
    const cJSON *errors = cJSON_GetObjectItemCaseSensitive(problem, "errors"), *error;
    bool lists = cJSON_GetArraySize(errors) > 0;
    fprintf(out, "zraster: %s: the server refused it: %ld %s%s%s\n", file, status, title, lists || !*detail ? "" : ": ",
            lists ? "" : detail);
    cJSON_ArrayForEach(error, errors)
    {
        const char *pointer = text_of(error, "pointer");
        fprintf(out, "  %s%s%s\n", pointer, *pointer ? ": " : "", text_of(error, "detail"));
    }
    cJSON_Delete(problem);
}
