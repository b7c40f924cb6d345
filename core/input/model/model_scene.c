#include "input/model/model_scene.h"

#include <stdio.h>
#include <string.h>

#include "input/text/text.h"

/* Adds the name of an item of the file to a list for a message, or its number if it has no name. */
static void list(struct zr_names_text *names, const char *name, uint32_t number)
{
    char digits[16];
    snprintf(digits, sizeof digits, "%u", number);
    zr_names_text_add(names, *name ? zr_quote(name, strlen(name)).text : digits);
}

struct zr_names_text zr_model_scene_cameras(const struct zr_model_scene *file)
{
    struct zr_names_text names = {""};
    for (uint32_t i = 0; i < file->camera_count; i++)
        list(&names, file->cameras[i].name, file->cameras[i].number);
    return names;
}

static bool is_number(const char *text, uint32_t number)
{
    char digits[16];
    snprintf(digits, sizeof digits, "%u", number);
    return strcmp(text, digits) == 0;
}

const struct zr_model_camera *zr_model_scene_find_camera(const struct zr_model_scene *file, const char *wanted)
{
    for (uint32_t i = 0; i < file->camera_count; i++)
        if (strcmp(file->cameras[i].name, wanted) == 0) return &file->cameras[i];
    for (uint32_t i = 0; i < file->camera_count; i++)
        if (is_number(wanted, file->cameras[i].number)) return &file->cameras[i];
    return NULL;
}

bool zr_model_scene_find_animation(const struct zr_model_scene *file, const char *wanted, uint32_t *number)
{
    for (*number = 0; *number < file->animation_count; ++*number)
        if (!wanted || strcmp(file->animation_names[*number], wanted) == 0) return true;
    for (*number = 0; *number < file->animation_count; ++*number)
        if (is_number(wanted, *number)) return true;
    return false;
}

struct zr_names_text zr_model_scene_animations(const struct zr_model_scene *file)
{
    struct zr_names_text names = {""};
    for (uint32_t i = 0; i < file->animation_count; i++)
        list(&names, file->animation_names[i], i);
    return names;
}
