#include "output/json_tree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

cJSON *zr_tree_check(struct zr_tree *w, cJSON *item)
{
    if (!item) w->ok = false;
    return item;
}

/* Tries 6 to 9 digits until the text reads back as the same float. */
cJSON *zr_tree_number(struct zr_tree *w, float value)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) break;
    }
    return zr_tree_check(w, cJSON_CreateRaw(text));
}

void zr_tree_put(struct zr_tree *w, cJSON *object, const char *key, cJSON *item)
{
    if (item && cJSON_AddItemToObject(object, key, item)) return;
    w->ok = false;
    cJSON_Delete(item);
}

void zr_tree_append(struct zr_tree *w, cJSON *array, cJSON *item)
{
    if (item && cJSON_AddItemToArray(array, item)) return;
    w->ok = false;
    cJSON_Delete(item);
}

void zr_tree_put_count(struct zr_tree *w, cJSON *object, const char *key, uint64_t count)
{
    zr_tree_put(w, object, key, zr_tree_check(w, cJSON_CreateNumber((double)count)));
}

cJSON *zr_tree_numbers(struct zr_tree *w, const float *values, int count)
{
    cJSON *array = zr_tree_check(w, cJSON_CreateArray());
    for (int i = 0; i < count; i++)
        zr_tree_append(w, array, zr_tree_number(w, values[i]));
    return array;
}

cJSON *zr_tree_vec3(struct zr_tree *w, zr_vec3 v)
{
    return zr_tree_numbers(w, (float[3]){v.x, v.y, v.z}, 3);
}

bool zr_tree_print(struct zr_tree *w, cJSON *root, struct zr_buffer *out)
{
    char *text = w->ok ? cJSON_PrintUnformatted(root) : NULL;
    cJSON_Delete(root);
    const bool ok = text && zr_buffer_add(out, text, strlen(text)) && zr_buffer_add(out, "\n", 1);
    cJSON_free(text);
    return ok;
}
