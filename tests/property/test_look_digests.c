/* A look that was released keeps its pixels: pictures of each row have the digests that it was released with, by every
 * instruction set and any number of threads. `make cross` holds the same pictures of another machine against these.
 * PICTURES=FOLDER writes them there. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "support/isas.h"
#include "support/pictures/look_scenes.h"
#include "support/pictures/png.h"

static const struct {
    const char *name;
    uint64_t digests[LOOK_SCENES];
} released[] = {
    {"studio@1", {UINT64_C(0xfd7b2aa3d81d4051), UINT64_C(0xe5a3d5a75aa3c855)}},
    {"technical@1", {UINT64_C(0xe0a6254094739b45), UINT64_C(0xee553ee6436c0b8b)}},
    {"clay@1", {UINT64_C(0xd9083280c3c24d58), UINT64_C(0xb3535f2bfc8d7c7e)}},
    {"dark@1", {UINT64_C(0x0a91f2b9f7dd9ec7), UINT64_C(0x5e356edf3ed232f0)}},
    {"metal@1", {UINT64_C(0xce76a9168b516bd6), UINT64_C(0x9ac330a05985dbb2)}},
    {"outdoor@1", {UINT64_C(0xb66ee18e002c9f09), UINT64_C(0x77140030fb7791a3)}},
    {"blueprint@1", {UINT64_C(0x0843244f81d7528e), UINT64_C(0xecd373ec849cc829)}},
    {"xray@1", {UINT64_C(0xcff6f3de79071261), UINT64_C(0x23647a366f375543)}},
    {"textbook@1", {UINT64_C(0xeec2ebd6a7c10fe5), UINT64_C(0xef093eb2f6c56f29)}},
};
enum { RELEASED = sizeof released / sizeof *released };

static void write_picture(const char *look, const char *scene, const struct zr_frame *frame)
{
    char path[512];
    const char *folder = getenv("PICTURES");
    if (!folder) return;
    snprintf(path, sizeof path, "%s/%s-%s.png", folder, look, scene);
    assert_true(png_file_write(path, frame->color, frame->width, frame->height));
}

static uint64_t draw(struct zr_team *team, const char *name, int number)
{
    struct zr_arena arena;
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    const struct zr_look *look = zr_look_find(name);
    assert_non_null(look);
    zr_arena_init(&arena, (size_t)1 << 28);
    const struct zr_scene *scene = look_scene(&arena, number, look, LOOK_WIDTH, LOOK_HEIGHT);
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .team = team, .error = &error}, scene, NULL, &frame),
                     ZR_OK);
    write_picture(name, look_scene_names[number], frame);
    const uint64_t digest = look_digest(frame);
    zr_arena_free(&arena);
    return digest;
}

/* Whether the picture is as it was released. */
static bool is_kept(struct zr_team *team, int row, int number)
{
    const uint64_t got = draw(team, released[row].name, number), want = released[row].digests[number];
    if (got != want)
        print_error("%s, %s, %s, %d threads: 0x%016" PRIx64 " and not 0x%016" PRIx64 "\n", released[row].name,
                    look_scene_names[number], zr_isa_name(zr_team_isa(team)), zr_team_size(team), got, want);
    return got == want;
}

TEST_EACH_ISA(each_row_keeps_its_pixels)
{
    static const int threads[] = {1, 2, 7};
    const enum zr_isa isa = isa_under_test(state);
    bool is_same = true;
    for (size_t t = 0; t < sizeof threads / sizeof *threads; t++) {
        struct zr_team *team = zr_team_create_for(threads[t], isa);
        assert_non_null(team);
        for (int row = 0; row < RELEASED; row++)
            for (int number = 0; number < LOOK_SCENES; number++)
                is_same &= is_kept(team, row, number);
        zr_team_destroy(team);
    }
    if (!is_same)
        fail_msg("a look that was released is never edited: add a row of the next version instead, behind it");
}

/* None is forgotten here. A new look prints the row to add. */
TEST(each_row_is_held)
{
    struct zr_team *team = zr_team_create(1);
    int missing = 0;
    assert_non_null(team);
    for (int i = 0; i < zr_look_count; i++) {
        char name[64];
        bool found = false;
        snprintf(name, sizeof name, "%s@%u", zr_looks[i].name, zr_looks[i].version);
        for (int k = 0; k < RELEASED; k++)
            found |= strcmp(name, released[k].name) == 0;
        if (found) continue;
        missing++;
        print_error("    {\"%s\", {UINT64_C(0x%016" PRIx64 "), UINT64_C(0x%016" PRIx64 ")}},\n", name,
                    draw(team, name, 0), draw(team, name, 1));
    }
    zr_team_destroy(team);
    assert_int_equal(missing, 0);
    assert_int_equal(RELEASED, zr_look_count);
}
_Static_assert(LOOK_SCENES == 2, "a row that is printed has two digests");

RUN_TESTS(NULL, NULL)
