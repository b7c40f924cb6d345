#include "report.h"

#include <cjson/cJSON.h>
#include <string.h>

#include "files/say.h"
#include "options/wording.h"

static const char *text_of(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, key));
    return text ? text : "";
}

void report_problem(struct bytes *faults, long status, const struct bytes *answer)
{
    cJSON *problem = cJSON_ParseWithLength(bytes_text(answer), answer->size);
    const char *title = text_of(problem, "title"), *detail = text_of(problem, "detail");
    const cJSON *errors = cJSON_GetObjectItemCaseSensitive(problem, "errors"), *error;
    const bool has_errors = cJSON_GetArraySize(errors) > 0;
    if (!has_errors) { /* else the detail repeats the first one */
        bytes_print(faults, "the server refused it: %ld%s%s", status, *title ? " " : "", title);
        if (!problem) bytes_print(faults, "; the answer is not from zrasterd, but perhaps from a proxy");
        if (*detail) bytes_print(faults, ": %s", detail);
    }
    cJSON_ArrayForEach(error, errors)
    {
        const char *pointer = text_of(error, "pointer");
        bytes_print(faults, "%s%s%s%s", error == errors->child ? "" : "\n", pointer, *pointer ? ": " : "",
                    text_of(error, "detail"));
    }
    if (cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(problem, "truncated")))
        bytes_print(faults, "\nand possibly more");
    cJSON_Delete(problem);
}

static bool is_single(const char *lines)
{
    const size_t first = strcspn(lines, "\n");
    return !lines[first] || !lines[first + 1];
}

static void print_faults(FILE *out, const char *head, const char *lines)
{
    const bool is_list = !is_single(lines);
    fputs("zraster: ", out);
    say_text(out, head, strlen(head));
    fputs(is_list ? ":\n" : *head ? ": " : "", out);
    for (size_t length; *lines; lines += length + (lines[length] == '\n')) {
        length = strcspn(lines, "\n");
        if (is_list) fputs("  ", out);
        say_text(out, lines, length);
        fputc('\n', out);
    }
}

void report_faults(FILE *out, const char *file, const struct bytes *faults)
{
    print_faults(out, strcmp(file, "-") == 0 ? "standard input" : file,
                 faults->size ? bytes_text(faults) : "out of memory");
}

void report_of_file(FILE *out, const char *file, const struct bytes *faults)
{
    const char *lines = bytes_text(faults);
    if (is_single(lines) && wording_is_option(lines))
        print_faults(out, "", lines);
    else
        report_faults(out, file, faults);
}

void report_warnings(FILE *out, const char *file, const struct bytes *warnings)
{
    const char *line = bytes_text(warnings);
    for (size_t length; *line; line += length + (line[length] == '\n')) {
        length = strcspn(line, "\n");
        if (file) say_text(out, file, strlen(file));
        fprintf(out, "%swarning: ", file ? ": " : "");
        say_text(out, line, length);
        fputc('\n', out);
    }
}
