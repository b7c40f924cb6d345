#include "report.h"

#include <cjson/cJSON.h>
#include <string.h>

#include "options.h"

static const char *text_of(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, key));
    return text ? text : "";
}

/* The detail of a problem repeats its first error, so it is used only without errors. */
void report_problem(struct bytes *faults, long status, const struct bytes *answer)
{
    cJSON *problem = cJSON_ParseWithLength(bytes_text(answer), answer->size);
    const char *title = text_of(problem, "title"), *detail = text_of(problem, "detail");
    const cJSON *errors = cJSON_GetObjectItemCaseSensitive(problem, "errors"), *error;
    const bool has_errors = cJSON_GetArraySize(errors) > 0;
    if (!has_errors) {
        bytes_print(faults, "the server refused it: %ld%s%s", status, *title ? " " : "", title);
        if (!problem) bytes_print(faults, ", without a word of zrasterd; something between may have answered");
        if (*detail) bytes_print(faults, ": %s", detail);
    }
    cJSON_ArrayForEach(error, errors)
    {
        const char *pointer = text_of(error, "pointer");
        bytes_print(faults, "%s%s%s%s", error == errors->child ? "" : "\n", pointer, *pointer ? ": " : "",
                    text_of(error, "detail"));
    }
    if (cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(problem, "truncated"))) bytes_print(faults, "\nand perhaps more");
    cJSON_Delete(problem);
}

static const char parameter_word[] = "parameter ";

static bool is_of_parameter(const char *line)
{
    return strncmp(line, parameter_word, sizeof parameter_word - 1) == 0;
}

static bool is_parameter(const char *word, size_t length)
{
    for (size_t i = 0; i < PARAMETER_COUNT; i++)
        if (strlen(parameter_rows[i].name) == length && memcmp(parameter_rows[i].name, word, length) == 0) return true;
    return false;
}

/* Prints "parameter light: lightPosition is missing" as "--light: --light-position is missing": names in two cases are
 * no words of the language, so that they are parameters wherever they stand. */
static void print_line(FILE *out, const char *line, size_t length)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const bool is_option = is_of_parameter(line);
    const char *at = is_option ? line + sizeof parameter_word - 1 : line, *end = line + length, *first = at;
    while (at < end) {
        const size_t word = strspn(at, letters), some = word ? word : strcspn(at, letters);
        char flag[FLAG_SIZE];
        options_flag_of(at, word, flag);
        const bool is_name = is_option && word && is_parameter(at, word) && (at == first || strlen(flag) > word + 2);
        fprintf(out, "%.*s", is_name ? FLAG_SIZE : (int)(some < (size_t)(end - at) ? some : (size_t)(end - at)),
                is_name ? flag : at);
        at += some;
    }
    fputc('\n', out);
}

void report_faults(FILE *out, const char *file, const struct bytes *faults)
{
    const char *line = faults->size ? bytes_text(faults) : "out of memory";
    const char *name = strcmp(file, "-") == 0 ? "standard input" : file;
    const size_t first = strcspn(line, "\n");
    const bool is_single = !line[first] || !line[first + 1];
    if (!is_single || !is_of_parameter(line)) fprintf(out, "zraster: %s:%s", name, is_single ? " " : "\n");
    if (is_single && is_of_parameter(line)) fputs("zraster: ", out);
    for (size_t length; *line; line += length + (line[length] == '\n')) {
        length = strcspn(line, "\n");
        if (!is_single) fputs("  ", out);
        print_line(out, line, length);
    }
}

void report_warnings(FILE *out, const char *file, const struct bytes *warnings)
{
    const char *line = bytes_text(warnings);
    for (size_t length; *line; line += length + (line[length] == '\n')) {
        length = strcspn(line, "\n");
        fprintf(out, "%s%swarning: %.*s\n", file ? file : "", file ? ": " : "", (int)length, line);
    }
}
