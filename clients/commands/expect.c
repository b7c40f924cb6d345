#include "commands/expect.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "files/say.h"

enum { TEXT_SIZE = 256, NAME_COLUMNS = 12 };

/* Share of a value within which it is as expected, if no tolerance is given. */
static const double usual = 1e-3;

static const char *const keys[] = {"box", "volume", "area", "triangles", "closed", "holes", "tolerance"};
enum { KEYS = sizeof keys / sizeof *keys };

/* ---- reading ---- */

static bool is_box(const cJSON *value)
{
    const cJSON *side;
    cJSON_ArrayForEach(side, value) if (!cJSON_IsNumber(side)) return false;
    return cJSON_IsArray(value) && cJSON_GetArraySize(value) == 3;
}

static bool are_holes(const cJSON *value)
{
    const cJSON *hole;
    cJSON_ArrayForEach(hole, value) if (!cJSON_IsNumber(cJSON_GetObjectItem(hole, "diameter")) ||
                                        !cJSON_IsNumber(cJSON_GetObjectItem(hole, "count"))) return false;
    return cJSON_IsArray(value);
}

static bool is_good(const cJSON *item)
{
    if (strcmp(item->string, "box") == 0) return is_box(item);
    if (strcmp(item->string, "holes") == 0) return are_holes(item);
    return strcmp(item->string, "closed") == 0 ? cJSON_IsBool(item) : cJSON_IsNumber(item);
}

static bool check(const cJSON *expected, struct bytes *faults)
{
    const cJSON *item;
    if (!cJSON_IsObject(expected)) return bytes_print(faults, "--expect: a JSON object is expected"), false;
    cJSON_ArrayForEach(item, expected)
    {
        bool is_known = false;
        for (int i = 0; i < KEYS; i++)
            is_known = is_known || strcmp(item->string, keys[i]) == 0;
        if (!is_known)
            return bytes_print(
                       faults,
                       "--expect: unknown key %.80s; known are box, volume, area, triangles, closed, holes, tolerance",
                       item->string),
                   false;
        if (!is_good(item))
            return bytes_print(faults, "--expect: the value of %s has another type", item->string), false;
    }
    return true;
}

cJSON *expect_read(const char *text, struct bytes *faults)
{
    struct bytes file = {.data = NULL};
    const bool is_file = text[strspn(text, " \t\r\n")] != '{';
    if (is_file && !bytes_read(&file, text)) {
        bytes_print(faults, "--expect %s: ", text);
        bytes_explain(faults);
        return NULL;
    }
    cJSON *expected = is_file ? cJSON_ParseWithLength(bytes_text(&file), file.size) : cJSON_Parse(text);
    bytes_free(&file);
    if (check(expected, faults)) return expected;
    cJSON_Delete(expected);
    return NULL;
}

/* ---- facts ---- */

static const cJSON *member(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItem(object, key);
}

/* Returns the sum of a number over all parts; NAN if a part has none. */
static double sum_of(const cJSON *facts, const char *key)
{
    const cJSON *part;
    double sum = 0.0;
    cJSON_ArrayForEach(part, member(facts, "parts"))
    {
        const cJSON *value = member(part, key);
        sum += cJSON_IsNumber(value) ? value->valuedouble : (double)NAN;
    }
    return sum;
}

static bool are_closed(const cJSON *facts)
{
    const cJSON *part;
    cJSON_ArrayForEach(part, member(facts, "parts")) if (!cJSON_IsTrue(member(part, "closed"))) return false;
    return cJSON_GetArraySize(member(facts, "parts")) > 0;
}

/* Finds the sides along the axes of the file; bounds are those of the world, in which y points up. */
static bool find_box(const cJSON *facts, double sides[3])
{
    const cJSON *bounds = member(facts, "bounds"), *min = member(bounds, "min"), *max = member(bounds, "max"),
                *up = member(member(facts, "up"), "axis");
    const char axis = cJSON_IsString(up) ? up->valuestring[strlen(up->valuestring) - 1] : 'y';
    double world[3];
    for (int k = 0; k < 3; k++) {
        const cJSON *low = cJSON_GetArrayItem(min, k), *high = cJSON_GetArrayItem(max, k);
        if (!low || !high) return false;
        world[k] = high->valuedouble - low->valuedouble;
    }
    const int order[3] = {axis == 'x' ? 1 : 0, axis == 'y' ? 1 : axis == 'x' ? 0 : 2, axis == 'z' ? 1 : 2};
    for (int k = 0; k < 3; k++)
        sides[k] = world[order[k]];
    return true;
}

/* Counts the holes of a diameter; -1: there are no features. */
static double count_holes(const cJSON *facts, double diameter, double tolerance)
{
    const cJSON *part, *group;
    double count = 0.0;
    cJSON_ArrayForEach(part, member(facts, "parts"))
    {
        const cJSON *features = member(part, "features");
        if (!features || member(features, "omitted")) return -1.0;
        cJSON_ArrayForEach(group, member(features, "holes"))
        {
            const cJSON *own = member(group, "diameter"), *number = member(group, "count");
            if (own && number && fabs(own->valuedouble - diameter) <= tolerance) count += number->valuedouble;
        }
    }
    return count;
}

/* ---- rows ---- */

struct rows {
    const cJSON *facts;
    double tolerance; /* negative: none is given */
    bool as_json, has_failed;
    int count;
};

static void put_row(struct rows *rows, const char *key, bool passes, const char *expected, const char *found)
{
    rows->has_failed = rows->has_failed || !passes;
    if (rows->as_json)
        printf("%s{\"key\":\"%s\",\"pass\":%s,\"expected\":%s,\"found\":%s}", rows->count > 0 ? "," : "", key,
               passes ? "true" : "false", expected, found);
    else
        printf("%s  %-*s expected %s, found %s\n", passes ? "pass" : "FAIL", NAME_COLUMNS, key, expected, found);
    rows->count++;
}

static void put_number(struct rows *rows, const char *key, double expected, double found, double tolerance)
{
    char texts[2][TEXT_SIZE] = {"", "null"};
    snprintf(texts[0], TEXT_SIZE, "%.9g", expected);
    if (isfinite(found)) snprintf(texts[1], TEXT_SIZE, "%.9g", found);
    put_row(rows, key, fabs(found - expected) <= tolerance, texts[0], texts[1]);
}

static double length_tolerance(const struct rows *rows, double value)
{
    return rows->tolerance >= 0.0 ? rows->tolerance : usual * fabs(value);
}

static void put_box(struct rows *rows, const cJSON *expected)
{
    char texts[2][TEXT_SIZE] = {"", "null"};
    double sides[3], wanted[3];
    bool passes = find_box(rows->facts, sides);
    for (int k = 0; k < 3; k++)
        wanted[k] = cJSON_GetArrayItem(expected, k)->valuedouble;
    snprintf(texts[0], TEXT_SIZE, "[%.9g,%.9g,%.9g]", wanted[0], wanted[1], wanted[2]);
    if (passes) snprintf(texts[1], TEXT_SIZE, "[%.9g,%.9g,%.9g]", sides[0], sides[1], sides[2]);
    for (int k = 0; k < 3 && passes; k++)
        passes = fabs(sides[k] - wanted[k]) <= length_tolerance(rows, wanted[k]);
    put_row(rows, "box", passes, texts[0], texts[1]);
}

static void put_holes(struct rows *rows, const cJSON *expected)
{
    const cJSON *hole;
    cJSON_ArrayForEach(hole, expected)
    {
        const double diameter = member(hole, "diameter")->valuedouble, count = member(hole, "count")->valuedouble,
                     found = count_holes(rows->facts, diameter, length_tolerance(rows, diameter));
        char key[TEXT_SIZE];
        snprintf(key, sizeof key, "holes %.6g", diameter);
        put_number(rows, key, count, found >= 0.0 ? found : (double)NAN, 0.0);
    }
}

bool expect_print(const cJSON *facts, const cJSON *expected, bool as_json)
{
    const cJSON *tolerance = member(expected, "tolerance"), *item;
    struct rows rows = {.facts = facts, .tolerance = tolerance ? tolerance->valuedouble : -1.0, .as_json = as_json};
    if (as_json) fputs("{\"rows\":[", stdout);
    cJSON_ArrayForEach(item, expected)
    {
        const char *key = item->string;
        const double value = cJSON_IsNumber(item) ? item->valuedouble : 0.0;
        if (strcmp(key, "box") == 0) put_box(&rows, item);
        if (strcmp(key, "holes") == 0) put_holes(&rows, item);
        if (strcmp(key, "closed") == 0)
            put_row(&rows, key, cJSON_IsTrue(item) == are_closed(facts), cJSON_IsTrue(item) ? "true" : "false",
                    are_closed(facts) ? "true" : "false");
        if (strcmp(key, "volume") == 0)
            put_number(&rows, key, value, sum_of(facts, key),
                       rows.tolerance >= 0.0 ? rows.tolerance * sum_of(facts, "area") : usual * fabs(value));
        if (strcmp(key, "area") == 0) put_number(&rows, key, value, sum_of(facts, key), usual * fabs(value));
        if (strcmp(key, "triangles") == 0) put_number(&rows, key, value, sum_of(facts, key), 0.0);
    }
    if (as_json) printf("],\"pass\":%s}\n", rows.has_failed ? "false" : "true");
    return !rows.has_failed;
}
