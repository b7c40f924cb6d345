#include "support/pictures/pictures.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/run.h"
#include "cost/cost.h"
#include "render_request.h"
#include "scene/camera/resolved_view.h"
#include "support/cmocka_all.h"

static const size_t ceiling = (size_t)1 << 28;

static void check_cost(const struct zr_cost *cost, size_t taken, const char *text)
{
    if (!isfinite(cost->ms) || cost->ms < 0.0) fail_msg("a cost of %g ms: %s", cost->ms, text);
    if (cost->window_bytes > (double)taken)
        fail_msg("%.0f bytes predicted, %zu used: %s", cost->window_bytes, taken, text);
}

struct drawn_picture picture_draw(struct zr_arena *arena, struct zr_team *team, const char *text)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text)};
    const struct zr_resolved_view *resolved = NULL;
    struct drawn_picture drawn = {NULL, NULL};
    struct zr_error error = {.count = 0};
    enum zr_status status =
        zr_scene_read(&(struct zr_run){.arena = arena, .team = team, .error = &error}, &request, &limits, &drawn.scene);
    if (status == ZR_OK)
        status = zr_resolved_view_find(&(struct zr_run){.arena = arena, .team = team, .error = &error}, drawn.scene,
                                       &resolved);
    if (status == ZR_OK) {
        const struct zr_cost cost = zr_scene_cost(drawn.scene, resolved);
        const size_t used = arena->used;
        status = zr_render(&(struct zr_run){.arena = arena, .team = team, .error = &error}, drawn.scene, resolved,
                           &drawn.frame);
        if (status == ZR_OK) check_cost(&cost, arena->peak - used, text);
    }
    if (status != ZR_OK)
        fail_msg("%s %s: %s", error.count ? error.items[0].pointer : "", error.count ? error.items[0].detail : "",
                 text);
    return drawn;
}

static void leave_scene(const char *text)
{
    const char *path = "build/test-pictures/differs.json";
    mkdir("build", 0777);
    mkdir("build/test-pictures", 0777);
    FILE *file = fopen(path, "w");
    if (!file) {
        print_error("%s: %s\n", path, strerror(errno));
        return;
    }
    fputs(text, file);
    if (fclose(file) == 0) print_error("the scene is in %s\n", path);
}

static void assert_same(const struct zr_frame *want, const struct zr_frame *got, const struct zr_team *team,
                        const char *text)
{
    assert_true(want->width == got->width && want->height == got->height);
    const size_t pixels = (size_t)want->width * want->height;
    if (memcmp(want->color, got->color, 4 * pixels) == 0) return;
    size_t i = 0;
    while (memcmp(want->color + 4 * i, got->color + 4 * i, 4) == 0)
        i++;
    const uint8_t *w = want->color + 4 * i, *g = got->color + 4 * i;
    leave_scene(text);
    fail_msg("%s, %d threads: at %zu, %zu of %u x %u is %02x%02x%02x%02x, not %02x%02x%02x%02x: %.300s",
             zr_isa_name(zr_team_isa(team)), zr_team_size(team), i % want->width, i / want->width, want->width,
             want->height, g[0], g[1], g[2], g[3], w[0], w[1], w[2], w[3], text);
}

struct drawn_picture picture_assert_same(struct zr_arena *arena, struct zr_team *const *teams, int count,
                                         const char *text)
{
    if (!zr_isa_is_available(ZR_ISA_SCALAR)) fail_msg("this build has no plain C, whose bytes are those of all sets");
    struct zr_team *plain = zr_team_create_for(1, ZR_ISA_SCALAR);
    struct zr_arena others;
    assert_non_null(plain);
    const struct drawn_picture want = picture_draw(arena, plain, text);
    zr_team_destroy(plain);
    zr_arena_init(&others, ceiling);
    for (int i = 0; i < count; i++) {
        assert_same(want.frame, picture_draw(&others, teams[i], text).frame, teams[i], text);
        zr_arena_reset(&others, ceiling);
    }
    zr_arena_free(&others);
    return want;
}
