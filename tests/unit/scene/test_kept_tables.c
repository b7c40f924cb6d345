/* Scenes that are drawn several times: crease normals and mipmaps are made once. */
#include <stdatomic.h>

#include "mesh/mesh_tables.h"
#include "render_request.h"
#include "scene/image.h"
#include "support/files.h"
#include "support/tests.h"
#include "unit/common/kept_check.h"
#include "views/views.h"

static const char change[] = "{\"view\":{\"preset\":\"front\"},\"window\":{\"width\":20,\"height\":20}}";

static void draw(const struct zr_scene *scene)
{
    struct zr_arena arena;
    struct zr_error error = {0};
    const struct zr_frame *frame;
    zr_arena_init(&arena, (size_t)1 << 28);
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, scene, NULL, &frame), ZR_OK);
    zr_arena_free(&arena);
}

static struct keeping *keep_textures(void)
{
    size_t size;
    char *text = file_read("tests/scenes/look-textures.json", &size);
    struct keeping *keeping = keep((struct zr_request){.format = ZR_FORMAT_JSON}, text, size);
    free(text);
    return keeping;
}

TEST(changes_share_the_creases_of_the_kept_scene)
{
    struct keeping *keeping = keep_textures();
    const struct zr_scene *kept = zr_kept_scene(keeping->kept);
    const struct zr_request request = {.bytes = change, .size = sizeof change - 1};
    uint32_t shared = 0;
    assert_int_equal(keeping_change(keeping, request), ZR_OK);
    for (uint32_t i = 0; i < kept->mesh_count; i++) {
        const struct zr_crease_normals *creases = zr_mesh_table_creases(kept->tables, kept, i);
        assert_ptr_equal(zr_mesh_table_creases(keeping->scene->tables, keeping->scene, i), creases);
        shared += creases != NULL;
    }
    assert_true(shared > 0);
    keeping_free(keeping);
}

/* Returns the number of images whose mipmaps are made. */
static uint32_t count_made(const struct zr_scene *scene)
{
    uint32_t made = 0;
    for (uint32_t i = 0; i < scene->image_count; i++)
        made += scene->images[i].levels && atomic_load(&scene->images[i].levels->state) >= ZR_LEVELS_PLAIN;
    return made;
}

TEST(changes_share_the_mipmaps_of_the_kept_scene)
{
    struct keeping *keeping = keep_textures();
    const struct zr_request request = {.bytes = change, .size = sizeof change - 1};
    assert_int_equal(count_made(zr_kept_scene(keeping->kept)), 0);
    assert_int_equal(keeping_change(keeping, request), ZR_OK);
    draw(keeping->scene);
    assert_true(count_made(zr_kept_scene(keeping->kept)) > 0);
    keeping_free(keeping);
}

TEST(views_share_their_mipmaps)
{
    const struct zr_limits limits = zr_limits_default();
    struct zr_arena arena;
    struct zr_error error = {0};
    struct zr_views views;
    struct zr_files files;
    size_t size;
    char *text = file_read("tests/scenes/look-textures.json", &size);
    zr_arena_init(&arena, (size_t)1 << 28);
    const struct zr_run run = {.arena = &arena, .error = &error};
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = text, .size = size, .turntable = "2"};
    assert_int_equal(zr_views_read(&run, &request, &limits, &views), ZR_OK);
    assert_int_equal(zr_views_plan(&run, &views), ZR_OK);
    assert_int_equal(zr_views_draw(&run, &views, &files), ZR_OK);
    assert_true(count_made(views.scene) > 0);
    zr_arena_free(&arena);
    free(text);
}

RUN_TESTS(NULL, NULL)
