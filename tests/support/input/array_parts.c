#include "support/input/array_parts.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/cmocka_all.h"
#include "support/input/npy.h"

const struct array_way array_ways[ARRAY_WAYS] = {
    {"NPY, f4 and u4", true, false, 0, ZRASTER_F4, ZRASTER_U4},
    {"NPY, f8 and i8", true, true, ZRASTER_LEND, ZRASTER_F8, ZRASTER_I8},
    {"arrays, f4 and i4", false, true, 0, ZRASTER_F4, ZRASTER_I4},
    {"arrays, f8 and u8", false, false, 0, ZRASTER_F8, ZRASTER_U8},
    {"lent arrays, f4 and u4", false, false, ZRASTER_LEND, ZRASTER_F4, ZRASTER_U4},
    {"lent arrays, f8 and i4", false, true, ZRASTER_LEND, ZRASTER_F8, ZRASTER_I4},
};

/* ---- parts ---- */

static const char *const descriptions[] = {"", "<f4", "<f8", "|u1", "<i4", "<u4", "<i8", "<u8"};

static size_t put(void *out, uint32_t type, double value)
{
    const float f4 = (float)value;
    const long long whole = type == ZRASTER_F4 || type == ZRASTER_F8 ? 0 : (long long)value;
    const size_t size = (size_t)(descriptions[type][2] - '0');
    memcpy(out, type == ZRASTER_F4 ? (const void *)&f4 : type == ZRASTER_F8 ? (const void *)&value : &whole, size);
    return size;
}

void array_parts_add(struct array_parts *parts, const struct array_way *way, uint32_t type, const void *numbers,
                     size_t bytes, size_t rows, size_t columns)
{
    struct zraster_part *part = &parts->items[parts->count];
    struct guarded *memory = &parts->memory[parts->count];
    char shape[64], *file = NULL;
    snprintf(parts->names[parts->count], sizeof parts->names[0], "p%zu", parts->count);
    *part = (struct zraster_part){.name = parts->names[parts->count], .flags = way->flags};
    snprintf(shape, sizeof shape, columns > 0 ? "(%zu, %zu)" : "(%zu,)", rows, columns);
    if (way->is_npy) {
        size_t size = 0;
        file = npy_file(descriptions[type], "False", shape, numbers, bytes, &size);
        assert_non_null(file);
        part->array = (struct zraster_array){.ndim = 1, .shape = {size}};
    } else {
        part->array = (struct zraster_array){.type = type, .ndim = columns > 0 ? 2 : 1, .shape = {rows, columns}};
    }
    *memory = guarded_copy(file ? file : numbers, file ? part->array.shape[0] : bytes);
    part->array.data = memory->bytes;
    parts->count++;
    free(file);
}

void array_parts_spoil(struct array_parts *parts)
{
    for (size_t i = 0; i < parts->count; i++)
        if (!(parts->items[i].flags & ZRASTER_LEND))
            memset((void *)(uintptr_t)parts->memory[i].bytes, 0xFF, parts->memory[i].size);
}

void array_parts_free(struct array_parts *parts)
{
    for (size_t i = 0; i < parts->count; i++)
        guarded_free(&parts->memory[i]);
    parts->count = 0;
}

/* ---- scenes whose lists become arrays ---- */

/* Finds the columns of a list of numbers (0) or of rows with as many each. False for other lists. */
static bool measure(const cJSON *list, size_t *columns)
{
    const cJSON *row, *number;
    *columns = cJSON_IsArray(list->child) ? (size_t)cJSON_GetArraySize(list->child) : 0;
    cJSON_ArrayForEach(row, list)
    {
        if (cJSON_IsArray(row) != (*columns > 0) || !(cJSON_IsArray(row) || cJSON_IsNumber(row))) return false;
        if (cJSON_IsArray(row) && (size_t)cJSON_GetArraySize(row) != *columns) return false;
        cJSON_ArrayForEach(number, row) if (!cJSON_IsNumber(number) && !cJSON_IsNull(number)) return false;
    }
    return cJSON_GetArraySize(list) > 0;
}

static bool is_whole(const cJSON *list)
{
    const cJSON *row, *number;
    cJSON_ArrayForEach(row, list)
    {
        if (cJSON_IsNumber(row) && row->valuedouble != (double)(int)row->valuedouble) return false;
        cJSON_ArrayForEach(number, row) if (cJSON_IsNull(number) ||
                                            number->valuedouble != (double)(int)number->valuedouble) return false;
    }
    return true;
}

/* Matrices, of which only lists of rows can be arrays. */
static bool is_matrix(const char *key)
{
    return strstr(key, "atrix") || strstr(key, "To") || strcmp(key, "R") == 0;
}

/* Replaces object[key] by an array, if it is a list that can be one. */
static void replace(cJSON *object, const char *key, bool is_index, const struct array_way *way,
                    struct array_parts *parts)
{
    cJSON *list = cJSON_GetObjectItemCaseSensitive(object, key), *row, *number, *name;
    size_t columns, bytes = 0;
    if (!cJSON_IsArray(list) || parts->count == ARRAY_PARTS_MAX || !measure(list, &columns)) return;
    if (columns == 0 && is_matrix(key)) return;
    const uint32_t type = is_index || (way->is_whole && is_whole(list)) ? way->indices : way->floats;
    const size_t rows = (size_t)cJSON_GetArraySize(list);
    char *numbers = malloc(8 * rows * (columns + 1));
    assert_non_null(numbers);
    cJSON_ArrayForEach(row, list)
    {
        if (columns == 0) bytes += put(numbers + bytes, type, row->valuedouble);
        cJSON_ArrayForEach(number, row) bytes +=
            put(numbers + bytes, type, cJSON_IsNull(number) ? (double)NAN : number->valuedouble);
    }
    array_parts_add(parts, way, type, numbers, bytes, rows, columns);
    free(numbers);
    assert_non_null(name = cJSON_CreateObject());
    cJSON_AddStringToObject(name, "asset", parts->names[parts->count - 1]);
    cJSON_ReplaceItemInObjectCaseSensitive(object, key, name);
}

char *array_parts_of_scene(const char *scene, const struct array_way *way, struct array_parts *parts)
{
    static const char *const floats[] = {"positions", "normals",       "colors",        "faceColors",
                                         "texcoords", "texcoords1",    "tangents",      "scalars",
                                         "heights",   "vertices",      "values",        "matrix",
                                         "R",         "cameraToWorld", "worldToCamera", "projectionMatrix"};
    static const char *const indices[] = {"faces", "lines", "points"};
    cJSON *root = cJSON_Parse(scene), *list, *object;
    assert_non_null(root);
    parts->count = 0;
    for (size_t k = 0; k < sizeof floats / sizeof *floats; k++)
        replace(cJSON_GetObjectItem(root, "view"), floats[k], false, way, parts);
    cJSON_ArrayForEach(list, root) cJSON_ArrayForEach(object, list)
    {
        for (size_t k = 0; k < sizeof floats / sizeof *floats; k++) {
            replace(object, floats[k], false, way, parts);
            replace(cJSON_GetObjectItemCaseSensitive(object, "heights"), floats[k], false, way, parts);
        }
        for (size_t k = 0; k < sizeof indices / sizeof *indices; k++)
            replace(object, indices[k], true, way, parts);
    }
    char *text = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    assert_non_null(text);
    return text;
}
