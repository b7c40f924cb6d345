#include "commands/expect.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "files/say.h"

enum { TEXT_SIZE = 256, NAME_COLUMNS = 12 };

/* Share of a value within which it is as expected, if no tolerance is given. */
static const double usual = 1e-3;

/* Why facts are no JSON object. */
static const char several[] = "several views have several facts";

static const char *const keys[] = {"box", "volume", "area", "triangles", "closed", "holes", "tolerance"};
static const char *const hole_keys[] = {"diameter", "count"};
enum { KEYS = sizeof keys / sizeof *keys, HOLE_KEYS = sizeof hole_keys / sizeof *hole_keys };

/* ---- reading ---- */

enum range { ANY, NOT_NEGATIVE, POSITIVE, WHOLE };

/* Adds a fault at a JSON pointer; "": the whole. Returns false. */
static bool refuse(struct bytes *faults, const char *pointer, const char *wanted)
{
    bytes_print(faults, "--expect%s%s: %s is wanted", *pointer ? " " : "", pointer, wanted);
    return false;
}

static bool check_number(const cJSON *item, enum range range, const char *pointer, struct bytes *faults)
{
    static const char *const words[] = {"a finite number", "a finite number of at least 0", "a finite number above 0",
                                        "a whole number of at least 0"};
    const double value = cJSON_IsNumber(item) ? item->valuedouble : (double)NAN;
    const bool is_good = isfinite(value) && (range == ANY || value >= 0.0) && (range != POSITIVE || value > 0.0) &&
                         (range != WHOLE || value == floor(value));
    return is_good || refuse(faults, pointer, words[range]);
}

/* Checks that an object has known keys alone, each once. */
static bool check_keys(const cJSON *object, const char *const *names, int count, const char *pointer,
                       struct bytes *faults)
{
    const cJSON *item, *later;
    cJSON_ArrayForEach(item, object)
    {
        bool is_known = false;
        for (int i = 0; i < count; i++)
            is_known = is_known || strcmp(item->string, names[i]) == 0;
        for (later = item->next; later; later = later->next)
            if (strcmp(item->string, later->string) == 0)
                return bytes_print(faults, "--expect %s/%.80s: the key is given twice", pointer, item->string), false;
        if (is_known) continue;
        bytes_print(faults, "--expect %s/%.80s: unknown key; known are", pointer, item->string);
        for (int i = 0; i < count; i++)
            bytes_print(faults, "%s %s", i > 0 ? "," : "", names[i]);
        return false;
    }
    return true;
}

static bool check_box(const cJSON *box, struct bytes *faults)
{
    char pointer[TEXT_SIZE];
    if (!cJSON_IsArray(box) || cJSON_GetArraySize(box) != 3)
        return refuse(faults, "/box", "a list of three finite numbers of at least 0");
    for (int k = 0; k < 3; k++) {
        snprintf(pointer, sizeof pointer, "/box/%d", k);
        if (!check_number(cJSON_GetArrayItem(box, k), NOT_NEGATIVE, pointer, faults)) return false;
    }
    return true;
}

static bool check_holes(const cJSON *holes, struct bytes *faults)
{
    const cJSON *hole;
    char pointer[TEXT_SIZE], inner[TEXT_SIZE + 16];
    int number = 0;
    if (!cJSON_IsArray(holes)) return refuse(faults, "/holes", "a list of objects with diameter and count");
    cJSON_ArrayForEach(hole, holes)
    {
        snprintf(pointer, sizeof pointer, "/holes/%d", number++);
        if (!cJSON_IsObject(hole)) return refuse(faults, pointer, "an object with diameter and count");
        if (!check_keys(hole, hole_keys, HOLE_KEYS, pointer, faults)) return false;
        for (int i = 0; i < HOLE_KEYS; i++) {
            snprintf(inner, sizeof inner, "%s/%s", pointer, hole_keys[i]);
            if (!check_number(cJSON_GetObjectItem(hole, hole_keys[i]), i == 0 ? POSITIVE : WHOLE, inner, faults))
                return false;
        }
    }
    return true;
}

static bool check_value(const cJSON *item, struct bytes *faults)
{
    const char *key = item->string;
    char pointer[TEXT_SIZE];
    snprintf(pointer, sizeof pointer, "/%s", key);
    if (strcmp(key, "box") == 0) return check_box(item, faults);
    if (strcmp(key, "holes") == 0) return check_holes(item, faults);
    if (strcmp(key, "closed") == 0) return cJSON_IsBool(item) || refuse(faults, pointer, "true or false");
    return check_number(item,
                        strcmp(key, "volume") == 0      ? ANY
                        : strcmp(key, "triangles") == 0 ? WHOLE
                                                        : NOT_NEGATIVE,
                        pointer, faults);
}

static bool check(const cJSON *expected, struct bytes *faults)
{
    const cJSON *item;
    if (!cJSON_IsObject(expected)) return refuse(faults, "", "a JSON object");
    if (!check_keys(expected, keys, KEYS, "", faults)) return false;
    cJSON_ArrayForEach(item, expected) if (!check_value(item, faults)) return false;
    const int facts = cJSON_GetArraySize(expected) - (cJSON_GetObjectItem(expected, "tolerance") != NULL);
    return facts > 0 || refuse(faults, "", "at least one of box, volume, area, triangles, closed, holes");
}

cJSON *expect_read(const char *text, struct bytes *faults)
{
    struct bytes file = {.data = NULL};
    const char first = text[strspn(text, " \t\r\n")];
    const bool is_file = first != '{' && !(first == '[' && strchr(text, ']'));
    if (is_file && !bytes_read(&file, text)) {
        bytes_print(faults, "--expect %s: ", text);
        bytes_explain(faults);
        return NULL;
    }
    const char *json = is_file ? bytes_text(&file) : text;
    const size_t size = is_file ? file.size : strlen(text);
    cJSON *expected = cJSON_ParseWithLengthOpts(json, size + 1, NULL, true); /* with the zero at its end */
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

/* Returns true if a part counts: all operands of combined solids do, and other parts unless they are hidden, as in
 * bounds. */
static bool has_part(const cJSON *facts, const cJSON *part)
{
    return member(facts, "csg") || !cJSON_IsTrue(member(part, "hidden"));
}

/* A number that was found, or NAN and why there is none. */
struct found {
    double value;
    char why[TEXT_SIZE];
};

__attribute__((format(printf, 1, 2))) static struct found no_number(const char *format, ...)
{
    struct found found = {.value = (double)NAN};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(found.why, sizeof found.why, format, arguments);
    va_end(arguments);
    return found;
}

/* Returns why parts are missing in the facts, or a number. */
static struct found check_parts(const cJSON *facts)
{
    const cJSON *omitted = member(facts, "partsOmitted");
    if (!facts) return no_number("%s", several);
    if (!cJSON_IsArray(member(facts, "parts"))) return no_number("the facts have no parts");
    if (cJSON_IsNumber(omitted)) return no_number("%.0f parts are not listed", omitted->valuedouble);
    return (struct found){.value = 0.0};
}

/* Returns the sum of a number over the parts. */
static struct found sum_of(const cJSON *facts, const char *key)
{
    struct found sum = check_parts(facts);
    const cJSON *part;
    int missing = 0;
    cJSON_ArrayForEach(part, member(facts, "parts"))
    {
        const cJSON *value = member(part, key);
        if (!has_part(facts, part)) continue;
        missing += !cJSON_IsNumber(value);
        if (cJSON_IsNumber(value)) sum.value += value->valuedouble;
    }
    return missing > 0 && !*sum.why ? no_number("%d open part%s no %s", missing, missing == 1 ? " has" : "s have", key)
                                    : sum;
}

static struct found volume_of(const cJSON *facts)
{
    const cJSON *csg = member(facts, "csg"), *volume = member(csg, "volume");
    if (csg && !cJSON_IsNumber(volume)) return no_number("the combined solid has none");
    return csg ? (struct found){.value = volume->valuedouble} : sum_of(facts, "volume");
}

static struct found area_of(const cJSON *facts)
{
    return member(facts, "csg") ? no_number("combined solids have none") : sum_of(facts, "area");
}

static bool are_closed(const cJSON *facts)
{
    const cJSON *part;
    int count = 0;
    cJSON_ArrayForEach(part, member(facts, "parts"))
    {
        if (!has_part(facts, part)) continue;
        if (!cJSON_IsTrue(member(part, "closed"))) return false;
        count++;
    }
    return count > 0 && !*check_parts(facts).why;
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

/* Counts the holes of a diameter; negative: all. */
static struct found count_holes(const cJSON *facts, double diameter, double tolerance)
{
    const cJSON *part, *group;
    struct found count = check_parts(facts);
    int unsearched = 0;
    if (member(facts, "csg")) return no_number("combined solids have none");
    cJSON_ArrayForEach(part, member(facts, "parts"))
    {
        const cJSON *features = member(part, "features");
        if (!has_part(facts, part)) continue;
        if (features && member(features, "holesOmitted")) return no_number("not all kinds of holes are listed");
        unsearched += !features || member(features, "omitted");
        cJSON_ArrayForEach(group, member(features, "holes"))
        {
            const cJSON *own = member(group, "diameter"), *number = member(group, "count");
            if (own && number && (diameter < 0.0 || fabs(own->valuedouble - diameter) <= tolerance))
                count.value += number->valuedouble;
        }
    }
    if (unsearched > 0 && !*count.why)
        return no_number("holes were not searched in %d part%s", unsearched, unsearched == 1 ? "" : "s");
    return count;
}

/* ---- rows ---- */

struct rows {
    const cJSON *facts;
    double tolerance; /* negative: none is given */
    bool as_json, has_failed;
    int count;
};

/* `why`: why nothing was found, or "". */
static void put_row(struct rows *rows, const char *key, bool passes, const char *expected, const char *found,
                    const char *why)
{
    rows->has_failed = rows->has_failed || !passes;
    if (rows->as_json) {
        printf("%s{\"key\":\"%s\",\"pass\":%s,\"expected\":%s,\"found\":%s", rows->count > 0 ? "," : "", key,
               passes ? "true" : "false", expected, *why ? "null" : found);
        printf(*why ? ",\"reason\":\"%s\"}" : "%s}", why);
    } else
        printf("%s  %-*s expected %s, found %s%s\n", passes ? "pass" : "FAIL", NAME_COLUMNS, key, expected,
               *why ? "none: " : found, why);
    rows->count++;
}

static void put_number(struct rows *rows, const char *key, double expected, struct found found, double tolerance)
{
    char texts[2][TEXT_SIZE] = {"", "null"};
    snprintf(texts[0], TEXT_SIZE, "%.9g", expected);
    if (isfinite(found.value)) snprintf(texts[1], TEXT_SIZE, "%.9g", found.value);
    put_row(rows, key, !*found.why && fabs(found.value - expected) <= tolerance, texts[0], texts[1], found.why);
}

static double length_tolerance(const struct rows *rows, double value)
{
    return rows->tolerance >= 0.0 ? rows->tolerance : usual * fabs(value);
}

static const char *why_no_box(const cJSON *facts)
{
    if (!facts) return several;
    return member(facts, "csg") ? "bounds of combined solids may be larger than the solids"
                                : "the facts have no bounds";
}

static void put_box(struct rows *rows, const cJSON *expected)
{
    char texts[2][TEXT_SIZE] = {"", "null"};
    double sides[3], wanted[3];
    bool passes = !member(rows->facts, "csg") && find_box(rows->facts, sides);
    const char *why = passes ? "" : why_no_box(rows->facts);
    for (int k = 0; k < 3; k++)
        wanted[k] = cJSON_GetArrayItem(expected, k)->valuedouble;
    snprintf(texts[0], TEXT_SIZE, "[%.9g,%.9g,%.9g]", wanted[0], wanted[1], wanted[2]);
    if (passes) snprintf(texts[1], TEXT_SIZE, "[%.9g,%.9g,%.9g]", sides[0], sides[1], sides[2]);
    for (int k = 0; k < 3 && passes; k++)
        passes = fabs(sides[k] - wanted[k]) <= length_tolerance(rows, wanted[k]);
    put_row(rows, "box", passes, texts[0], texts[1], why);
}

static void put_holes(struct rows *rows, const cJSON *expected)
{
    const cJSON *hole;
    if (cJSON_GetArraySize(expected) == 0) put_number(rows, "holes", 0.0, count_holes(rows->facts, -1.0, 0.0), 0.0);
    cJSON_ArrayForEach(hole, expected)
    {
        const double diameter = member(hole, "diameter")->valuedouble, count = member(hole, "count")->valuedouble;
        char key[TEXT_SIZE];
        snprintf(key, sizeof key, "holes %.6g", diameter);
        put_number(rows, key, count, count_holes(rows->facts, diameter, length_tolerance(rows, diameter)), 0.0);
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
                    are_closed(facts) ? "true" : "false", check_parts(facts).why);
        if (strcmp(key, "volume") == 0)
            put_number(&rows, key, value, volume_of(facts),
                       rows.tolerance >= 0.0 ? rows.tolerance * sum_of(facts, "area").value : usual * fabs(value));
        if (strcmp(key, "area") == 0) put_number(&rows, key, value, area_of(facts), usual * fabs(value));
        if (strcmp(key, "triangles") == 0) put_number(&rows, key, value, sum_of(facts, key), 0.0);
    }
    if (as_json) printf("],\"pass\":%s}\n", rows.has_failed ? "false" : "true");
    return !rows.has_failed;
}
