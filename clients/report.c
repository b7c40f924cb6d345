#include "report.h"

#include <cjson/cJSON.h>
#include <string.h>

#include "options.h"

static const char *text_of(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, key));
    return text ? text : "";
}

/* Prints "parameter preset: ..." as "--preset: ...". Another program's text may come here, too. */
static void report_detail(FILE *out, const char *detail)
{
    static const char words[] = "parameter ";
    if (strncmp(detail, words, sizeof words - 1) != 0) {
        fputs(detail, out);
        return;
    }
    const char *name = detail + sizeof words - 1;
    const size_t length = strcspn(name, ": ");
    char flag[OPTIONS_FLAG_SIZE];
    options_flag_of(name, length, flag);
    fprintf(out, "%s%s", flag, name + length);
}

/* The detail of a problem repeats its first error, so it is printed only without errors. */
void report_problem(FILE *out, const char *file, long status, const struct bytes *answer)
{
    cJSON *problem = cJSON_ParseWithLength(answer->data ? answer->data : "", answer->size);
    const char *title = text_of(problem, "title"), *detail = text_of(problem, "detail");
    const cJSON *errors = cJSON_GetObjectItemCaseSensitive(problem, "errors"), *error;
    bool lists = cJSON_GetArraySize(errors) > 0;
    fprintf(out, "zraster: %s: the server refused it: %ld%s%s", file, status, *title ? " " : "", title);
    if (!problem) fprintf(out, ", without a word of zrasterd; something between may have answered");
    if (!lists && *detail) {
        fputs(": ", out);
        report_detail(out, detail);
    }
    fputc('\n', out);
    cJSON_ArrayForEach(error, errors)
    {
        const char *pointer = text_of(error, "pointer");
        fprintf(out, "  %s%s", pointer, *pointer ? ": " : "");
        report_detail(out, text_of(error, "detail"));
        fputc('\n', out);
    }
    if (cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(problem, "truncated"))) fprintf(out, "  and perhaps more\n");
    cJSON_Delete(problem);
}
