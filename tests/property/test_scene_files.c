/* Every scene of tests/scenes and clients/examples, by every algorithm, by several threads, and by every instruction
 * set that the machine has: the same bytes, and those of tests/scenes/digests.txt. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "support/files.h"
#include "support/geometries.h"
#include "support/pictures/digests.h"
#include "support/scenes.h"
#include "support/tests.h"

static const size_t ceiling = (size_t)1 << 31;
static struct zr_arena arena;
static char *bytes; /* the scene points into them */
static FILE *digests;
static struct zr_output outputs[ZR_CHANNEL_COUNT];

/* All that have pixels, color first; over a base, those that it may have. Returns how many. */
static uint32_t list_outputs(const struct zr_base *base)
{
    uint32_t count = 0;
    for (int c = 0; c < (base ? ZR_CHANNEL_INFO : ZR_CHANNEL_COUNT); c++)
        if (zr_channel_rows[c].words > 0 && c != ZR_CHANNEL_FLOW && /* which needs a target */
            c != ZR_CHANNEL_WALL)                                   /* which takes a tree per scene */
            outputs[count++] = (struct zr_output){
                .channel = (enum zr_channel)c, .encoding = zr_channel_rows[c].encodings[0], .space = ZR_SPACE_OBJECT};
    return count;
}

static struct zr_scene read_file(const char *path)
{
    struct zr_request request = {.format = ZR_FORMAT_JSON};
    bytes = file_read(path, &request.size);
    if (!bytes) fail_msg("%s: not there; tests run from the project's top folder", path);
    request.bytes = bytes;
    struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    if (zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene) != ZR_OK)
        fail_msg("%s: %s %s", path, error.items[0].pointer, error.items[0].detail);
    struct zr_scene all = *scene;
    all.views[0].outputs = outputs;
    all.views[0].output_count = list_outputs(all.base);
    return all;
}

static void assert_same(const struct zr_frame *want, const struct zr_frame *got, bool uncolored, const char *path,
                        const char *by)
{
    size_t pixels = (size_t)want->width * want->height;
    bool same = memcmp(&got->counts, &want->counts, sizeof got->counts) == 0;
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        if (!want->channels[c] || (c == ZR_CHANNEL_COLOR && uncolored)) continue;
        if (!got->channels[c] && (c == ZR_CHANNEL_LAYERS || c == ZR_CHANNEL_THICKNESS)) continue;
        same = same && memcmp(got->channels[c], want->channels[c], pixels * 4 * zr_channel_rows[c].words) == 0;
        if (!same)
            fail_msg("%s: other bytes of %s by %s%s", path, zr_channel_rows[c].name, by,
                     uncolored ? ", without colours" : "");
    }
    assert_true(same);
}

/* Which keeps no fragments. */
static struct zr_scene for_the_painter(const struct zr_scene *scene)
{
    static struct zr_output some[ZR_CHANNEL_COUNT];
    struct zr_scene out = *scene;
    out.views[0].outputs = some;
    out.views[0].output_count = 0;
    for (uint32_t i = 0; i < scene->views[0].output_count; i++) {
        const enum zr_channel channel = scene->views[0].outputs[i].channel;
        if (channel == ZR_CHANNEL_LAYERS || channel == ZR_CHANNEL_THICKNESS) continue;
        some[out.views[0].output_count++] = scene->views[0].outputs[i];
    }
    return out;
}

static struct zr_scene without_color(const struct zr_scene *scene)
{
    struct zr_scene out = *scene;
    assert_int_equal(scene->views[0].outputs[0].channel, ZR_CHANNEL_COLOR);
    out.views[0].outputs++;
    out.views[0].output_count--;
    return out;
}

struct teams {
    struct zr_team *of[ZR_ISA_COUNT]; /* NULL where the machine lacks it, which test_isas.c tells of */
    int file;                         /* drawn without colours by one of the sets, the next file by another */
};

static void check_file(const char *path, void *context)
{
    struct teams *teams = context;
    const int uncolored_by = teams->file++ % ZR_ISA_COUNT;
    struct zr_scene scene = read_file(path);
    scene.algorithm = ZR_ALGORITHM_HALFSPACE;
    const struct zr_frame *want = scene_render(&arena, NULL, &scene);
    assert_true(want->covered_pixels > 0);
    digests_add(digests, path, want);
    struct zr_scene uncolored = without_color(&scene);
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++)
        if (teams->of[isa]) {
            assert_same(want, scene_render(&arena, teams->of[isa], &scene), false, path, zr_isa_name((enum zr_isa)isa));
            if (isa == uncolored_by)
                assert_same(want, scene_render(&arena, teams->of[isa], &uncolored), true, path,
                            zr_isa_name((enum zr_isa)isa));
        }
    const bool is_see_through = scene.csg || zr_any_is_see_through(scene.materials, scene.material_count);
    const bool has_xrays = zr_any_is_xray(scene.materials, scene.material_count); /* which the painter has none of */
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
        if (a == ZR_ALGORITHM_PAINTER && is_see_through) continue; /* it is refused */
        if (a == ZR_ALGORITHM_PAINTER) {
            scene = for_the_painter(&scene);
            uncolored = without_color(&scene);
        }
        scene.algorithm = uncolored.algorithm = (enum zr_algorithm)a;
        if (a != ZR_ALGORITHM_PAINTER || !has_xrays)
            assert_same(want, scene_render(&arena, teams->of[zr_isa_best()], &scene), false, path, algorithm_words[a]);
        assert_same(want, scene_render(&arena, teams->of[zr_isa_best()], &uncolored), true, path, algorithm_words[a]);
    }
    zr_arena_reset(&arena, ceiling);
    free(bytes);
}

static int check_folder(const char *folder)
{
    struct teams teams = {.file = 0};
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++)
        if (zr_isa_is_available((enum zr_isa)isa)) {
            teams.of[isa] = zr_team_create_for(3, (enum zr_isa)isa);
            assert_non_null(teams.of[isa]);
        }
    const int count = files_each(folder, ".json", check_file, &teams);
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++)
        zr_team_destroy(teams.of[isa]);
    return count;
}

TEST(every_algorithm_and_instruction_set_gives_the_bytes_that_were_committed)
{
    digests = digests_open();
    zr_arena_init(&arena, ceiling);
    assert_true(check_folder("tests/scenes") > 30);
    assert_true(check_folder("clients/examples") > 0);
    zr_arena_free(&arena);
    digests_check(digests, "tests/scenes/digests.txt");
}

RUN_TESTS(NULL, NULL)
