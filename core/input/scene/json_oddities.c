#include "input/scene/json_scene.h"

#include <stdio.h>

#include "input/text/names.h"
#include "input/text/parameter_names.h"
#include "scene/mesh_label.h"
#include "scene/picture.h"

void zr_parsed_note_oddity(struct zr_parsed_scene *root, enum zr_oddity oddity, uint32_t number, bool is_polygon)
{
    struct zr_oddity_note *note = &root->oddities[oddity];
    if (note->count++ == 0) *note = (struct zr_oddity_note){1, number, is_polygon};
}

/* The text of each oddity, and whether it concerns only colours. */
static const struct {
    bool is_of_colors;
    const char *text;
} ROWS[ZR_ODDITIES] = {
    [ZR_ODD_ALPHA] =
        {true, "colours have an alpha below 1 and no alphaMode: drawn opaque; \"alphaMode\": \"BLEND\" makes them "
               "transparent, and \"OPAQUE\" ends this warning"},
    [ZR_ODD_TEXTURE_ALPHA] = {true, "its baseColorTexture has an alpha below 1 and no alphaMode: drawn opaque; "
                                    "\"alphaMode\": \"BLEND\" or \"MASK\" uses it, and \"OPAQUE\" ends this warning"},
    [ZR_ODD_UNSEEN] = {true, "alpha is 0 everywhere, so \"alphaMode\": \"BLEND\" draws nothing"},
    [ZR_ODD_MASKED] = {false, "alpha is below alphaCutoff everywhere, so \"alphaMode\": \"MASK\" draws nothing"},
    [ZR_ODD_CUTOFF] = {false, "alphaCutoff has no effect without \"alphaMode\": \"MASK\""},
    [ZR_ODD_POINT_SIZE] = {false, "pointSize has no effect without points"},
};

struct label {
    char text[96];
};

/* Formats "mesh 3 'bunny' and 2 more". */
static struct label label_of(const struct zr_parsed_scene *root, const struct zr_oddity_note *note)
{
    struct label label;
    int used = note->is_polygon ? snprintf(label.text, sizeof label.text, "polygon %u", note->number)
                                : snprintf(label.text, sizeof label.text, "%s",
                                           zr_mesh_label_of(note->number, root->scene->meshes[note->number].name).text);
    if (note->count > 1) snprintf(label.text + used, sizeof label.text - (size_t)used, " and %u more", note->count - 1);
    return label;
}

/* Warns of given keys of light and tone if no face has a shading that uses them. */
static void warn_of_light(struct zr_parsed_scene *root)
{
    const struct zr_picture *picture = root->scene->picture;
    const unsigned physical = zr_shadings_lit(ZR_SHADED_PHYSICALLY);
    const unsigned lit = physical | zr_shadings_lit(ZR_SHADED_BY_LAMPS);
    const struct {
        enum zr_scene_key key;
        const char *word;
        unsigned users;
        bool has_effect; /* on faces with these shadings */
    } rows[] = {
        {ZR_SCENE_AMBIENT, "ambient", lit, true},
        {ZR_SCENE_LIGHTS, "lights", lit, root->light_count > 0},
        {ZR_SCENE_TONE_MAPPING, "toneMapping", lit, picture->tone != ZR_TONE_NONE},
        {ZR_SCENE_EXPOSURE, "exposure", lit, picture->exposure != 1.0f},
        {ZR_SCENE_ENVIRONMENT, "environment", physical, picture->environment.name != ZR_ENVIRONMENT_NONE},
    };
    struct zr_names_text words = {""};
    unsigned users = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!zr_scene_gives(root, rows[i].key) || !rows[i].has_effect || root->shadings & rows[i].users) continue;
        zr_names_text_add(&words, rows[i].word);
        users |= rows[i].users;
    }
    if (users)
        zr_warning_list_add(root->json.arena, &root->builder->color_warnings,
                            "no effect of %s: no face has the shading %s",
                            root->is_bare ? zr_parameter_names("", words.text).text : words.text,
                            zr_names_join_set(&zr_shading_names, users).text);
}

void zr_parsed_warn_of_oddities(struct zr_parsed_scene *root)
{
    struct zr_scene_builder *builder = root->builder;
    warn_of_light(root);
    for (int i = 0; i < ZR_ODDITIES; i++)
        if (root->oddities[i].count > 0)
            zr_warning_list_add(root->json.arena, ROWS[i].is_of_colors ? &builder->color_warnings : &builder->warnings,
                                "%s: %s", label_of(root, &root->oddities[i]).text, ROWS[i].text);
    if (root->face_style.alpha_cutoff >= 0.0f && !zr_any_is_masked(builder->materials, builder->scene->material_count))
        zr_warning_list_add(root->json.arena, &builder->warnings, "the scene's %s", ROWS[ZR_ODD_CUTOFF].text);
}
