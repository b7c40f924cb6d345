/* Lines and outlines of every scene file that has some are those of tests/scenes/lines.digests, on every system,
 * whatever Mesa it has. Where the rules were changed (ZR_RULES in version.h), or a scene file was: LINE_DIGESTS=write
 * writes the file anew.
 *
 * A digest is taken of window depth, face ids and colours, all materials being made unlit: so it depends on where lines
 * are, on what they hide, and on nothing that lights do. */
#include <dirent.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/cmocka_all.h"
#include "support/files.h"
#include "support/scenes.h"

enum { PATH_SIZE = 600, SCENES_MIN = 12, TEXT_SIZE = 1 << 14 };

static const char digests_path[] = "tests/scenes/lines.digests";
static struct zr_arena arena;

static bool has_lines(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].outline != ZR_OUTLINE_NONE) return true;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        if (scene->meshes[i].line_count > 0) return true;
    return false;
}

static void make_unlit(struct zr_scene *scene)
{
    struct zr_material *materials = zr_arena_alloc(&arena, scene->material_count, sizeof *materials);
    assert_non_null(materials);
    for (uint32_t i = 0; i < scene->material_count; i++) {
        materials[i] = scene->materials[i];
        materials[i].shading = ZR_SHADING_UNLIT;
    }
    scene->materials = materials;
}

/* FNV-1a over words of 32 bits. */
static uint64_t digest_words(uint64_t digest, const void *words, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, (const char *)words + 4 * i, sizeof word);
        digest = (digest ^ word) * 0x100000001b3u;
    }
    return digest;
}

static uint64_t digest_of(const struct zr_scene *scene)
{
    const struct zr_frame *frame = scene_render(&arena, NULL, scene);
    size_t pixels = (size_t)frame->width * frame->height;
    uint64_t digest = 0xcbf29ce484222325u;
    digest = digest_words(digest, frame->window_depth, pixels);
    digest = digest_words(digest, frame->face_id, pixels);
    return digest_words(digest, frame->color, pixels);
}

/* Appends a row to `text` where the scene has lines. */
static void add_row(const char *folder, const char *name, char text[TEXT_SIZE], int *rows)
{
    static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                               {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY},
                                               {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    struct zr_request request = {.format = ZR_FORMAT_JSON};
    char *bytes = file_read(path, &request.size);
    assert_non_null(bytes);
    request.bytes = bytes;
    struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.count = 0};
    const struct zr_scene *read;
    zr_arena_init(&arena, (size_t)1 << 29);
    if (zr_scene_read(&arena, NULL, &request, &limits, &read, &error) != ZR_OK)
        fail_msg("%s: %s %s", path, error.items[0].pointer, error.items[0].detail);
    if (has_lines(read)) {
        struct zr_scene scene = *read;
        scene.views[0].outputs = outputs;
        scene.views[0].output_count = sizeof outputs / sizeof *outputs;
        make_unlit(&scene);
        size_t used = strlen(text);
        int length = snprintf(text + used, TEXT_SIZE - used, "%016" PRIx64 " %s\n", digest_of(&scene), path);
        assert_true(length > 0 && (size_t)length < TEXT_SIZE - used);
        ++*rows;
    }
    zr_arena_free(&arena);
    free(bytes);
}

static int is_scene(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".json") == 0;
}

static int compare_names(const struct dirent **a, const struct dirent **b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

static void add_rows(const char *folder, char text[TEXT_SIZE], int *rows)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_scene, compare_names);
    if (count < 0) fail_msg("%s: not there; tests run from the project's top folder", folder);
    for (int i = 0; i < count; i++) {
        add_row(folder, entries[i]->d_name, text, rows);
        free(entries[i]);
    }
    free(entries);
}

static void lines_of_all_scene_files_have_the_digests_that_were_committed(void **state)
{
    (void)state;
    static char text[TEXT_SIZE];
    size_t size;
    int rows = 0;
    add_rows("clients/examples", text, &rows);
    add_rows("tests/scenes", text, &rows);
    assert_true(rows >= SCENES_MIN);
    const char *wish = getenv("LINE_DIGESTS");
    if (wish && strcmp(wish, "write") == 0) {
        FILE *file = fopen(digests_path, "w");
        assert_non_null(file);
        assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    }
    char *want = file_read(digests_path, &size);
    assert_non_null(want);
    bool same = size == strlen(text) && memcmp(want, text, size) == 0;
    if (!same) print_message("these are drawn now:\n%s", text);
    assert_true(same);
    free(want);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_of_all_scene_files_have_the_digests_that_were_committed),
    };
    return cmocka_run_group_tests_name("line_digests", tests, NULL, NULL);
}
