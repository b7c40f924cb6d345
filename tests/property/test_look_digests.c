/* A look that was released keeps its pixels: a picture of each row has the digest that it was released with, by every
 * instruction set and any number of threads. `make cross` holds the same pictures of another machine against these.
 * PICTURES=FOLDER writes them there. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "support/isas.h"
#include "support/look_scenes.h"
#include "support/png.h"

static const struct {
    const char *name;
    uint64_t digest;
} released[] = {
    {"studio@1", UINT64_C(0x1ee504c64bb847f3)},
    {"technical@1", UINT64_C(0x484b8c65d4a97e7e)},
    {"clay@1", UINT64_C(0xa08c08d543b57c27)},
    {"dark@1", UINT64_C(0xead62af450689e9f)},
    {"metal@1", UINT64_C(0x8c446ccaaab75555)},
    {"outdoor@1", UINT64_C(0x45b8f13eaec3d5cd)},
    {"blueprint@1", UINT64_C(0xd1f028a733764f00)},
    {"textbook@1", UINT64_C(0xeec2ebd6a7c10fe5)},
};
enum { RELEASED = sizeof released / sizeof *released };

static void write_picture(const char *name, const struct zr_frame *frame)
{
    char path[512];
    const char *folder = getenv("PICTURES");
    if (!folder) return;
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    assert_true(png_file_write(path, frame->color, frame->width, frame->height));
}

static void each_row_keeps_its_pixels(void **state)
{
    static const int threads[] = {1, 2, 7};
    const enum zr_isa isa = isa_under_test(state);
    bool changed = false;
    for (size_t t = 0; t < sizeof threads / sizeof *threads; t++) {
        struct zr_team *team = zr_team_create_for(threads[t], isa);
        for (int i = 0; i < RELEASED; i++) {
            struct zr_arena arena;
            struct zr_error error = {.count = 0};
            const struct zr_frame *frame;
            zr_arena_init(&arena, (size_t)1 << 28);
            const struct zr_look *look = zr_look_find(released[i].name);
            assert_non_null(look);
            const struct zr_scene *scene = look_scene(&arena, look, LOOK_WIDTH, LOOK_HEIGHT);
            assert_int_equal(zr_render(&arena, team, scene, NULL, NULL, &frame, &error), ZR_OK);
            if (t == 0) write_picture(released[i].name, frame);
            const uint64_t got = look_digest(frame);
            if (got != released[i].digest) {
                print_error("%s, %s, %d threads: 0x%016" PRIx64 " and not 0x%016" PRIx64 "\n", released[i].name,
                            zr_isa_name(isa), threads[t], got, released[i].digest);
                changed = true;
            }
            zr_arena_free(&arena);
        }
        zr_team_destroy(team);
    }
    if (changed)
        fail_msg("a look that was released is never changed: what is to look better is a row of the next version, "
                 "behind it");
}

/* None is forgotten here. */
static void each_row_is_held(void **state)
{
    (void)state;
    assert_int_equal(RELEASED, ZR_LOOKS);
    for (int i = 0; i < ZR_LOOKS; i++) {
        char name[64];
        bool found = false;
        snprintf(name, sizeof name, "%s@%u", zr_looks[i].name, zr_looks[i].version);
        for (int k = 0; k < RELEASED; k++)
            found |= strcmp(name, released[k].name) == 0;
        if (!found) fail_msg("%s has no digest here", name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(each_row_keeps_its_pixels),
        cmocka_unit_test(each_row_is_held),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
