/* zraster-cross: draws the gallery with every instruction set that the machine has, and says what came of it, for
 * compare.sh to hold one machine against another. Only the renderer is linked, and no library, so that a compiler
 * for the other machine is all that it takes.
 *
 * A line for each channel: "ISA, N threads <tab> SCENE, W x H, CHANNEL <tab> HASH". */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/run.h"
#include "support/pictures/gallery.h"
#include "support/pictures/look_scenes.h"
#include "support/simd_check.h"

static const size_t ceiling = (size_t)1 << 29;

/* FNV-1a, word by word. */
static uint64_t hash_of(const uint32_t *words, size_t count)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ words[i]) * 0x100000001b3u;
    return hash;
}

static bool draw(struct zr_arena *arena, struct zr_team *team, int number, const uint32_t window[2])
{
    const struct zr_scene *scene = gallery_scene(arena, number, window[0], window[1]);
    const struct zr_frame *frame = NULL;
    struct zr_error error = {.count = 0};
    if (!scene ||
        zr_render(&(struct zr_run){.arena = arena, .team = team, .error = &error}, scene, NULL, &frame) != ZR_OK) {
        fprintf(stderr, "zraster-cross: %s: %s\n", gallery_names[number],
                error.count ? error.items[0].detail : "no memory");
        return false;
    }
    for (int c = 0; c < GALLERY_CHANNELS; c++)
        printf("%s, %d threads\t%s, %" PRIu32 " x %" PRIu32 ", %s\t%016" PRIx64 "\n", zr_isa_name(zr_team_isa(team)),
               zr_team_size(team), gallery_names[number], window[0], window[1], gallery_channels[c],
               hash_of(gallery_channel(frame, c), (size_t)window[0] * window[1]));
    zr_arena_reset(arena, ceiling);
    return true;
}

static bool draw_look(struct zr_arena *arena, struct zr_team *team, int number, const struct zr_look *look)
{
    const struct zr_scene *scene = look_scene(arena, number, look, LOOK_WIDTH, LOOK_HEIGHT);
    const struct zr_frame *frame = NULL;
    struct zr_error error = {.count = 0};
    if (!scene ||
        zr_render(&(struct zr_run){.arena = arena, .team = team, .error = &error}, scene, NULL, &frame) != ZR_OK) {
        fprintf(stderr, "zraster-cross: %s: %s\n", look->name, error.count ? error.items[0].detail : "no memory");
        return false;
    }
    printf("%s, %d threads\t%s, %s@%" PRIu32 ", %d x %d, color\t%016" PRIx64 "\n", zr_isa_name(zr_team_isa(team)),
           zr_team_size(team), look_scene_names[number], look->name, look->version, LOOK_WIDTH, LOOK_HEIGHT,
           look_digest(frame));
    zr_arena_reset(arena, ceiling);
    return true;
}

static bool draw_all(struct zr_arena *arena, struct zr_team *team)
{
    if (!team) {
        fputs("zraster-cross: no threads\n", stderr);
        return false;
    }
    for (int number = 0; number < GALLERY_SCENES; number++)
        for (int w = 0; w < GALLERY_WINDOWS; w++)
            if (!draw(arena, team, number, gallery_windows[w])) return false;
    for (int i = 0; i < zr_look_count; i++)
        for (int number = 0; number < LOOK_SCENES; number++)
            if (!draw_look(arena, team, number, &zr_looks[i])) return false;
    return true;
}

int main(int argc, char **argv)
{
    const int only = argc > 1 ? atoi(argv[1]) : 0;
#ifdef __wasm__
    static const int threads[] = {1}; /* a module has no more */
#else
    static const int threads[] = {1, 2, 7};
#endif
    struct zr_arena arena;
    zr_arena_init(&arena, ceiling);
    bool ok = true;
    for (int i = 0; ok && i < ZR_ISA_COUNT; i++) {
        enum zr_isa isa = (enum zr_isa)i;
        char message[400];
        if (!zr_isa_is_available(isa)) continue;
        ok = simd_check(isa, 1, message, sizeof message);
        if (!ok) fprintf(stderr, "zraster-cross: %s\n", message);
        for (size_t t = 0; ok && t < sizeof threads / sizeof *threads; t++) {
            if (only && threads[t] != only) continue;
            struct zr_team *team = zr_team_create_for(threads[t], isa);
            ok = draw_all(&arena, team);
            zr_team_destroy(team);
        }
    }
    zr_arena_free(&arena);
    return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
