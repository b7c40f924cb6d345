/* costs - bench: compares predictions with measurements. Prints the predicted time (core/cost/cost.h) and the processor
 * time of one thread, and the predicted memory and the memory held. Draws each scene, and each bare mesh in some
 * looks, channels and sizes, makes its technical drawing, and compares it with itself. The last lines have the shares of
 * times and of memory within factors of 2 and 3. `make bench-costs` runs it.
 *
 *     build/tests/bench/alone/costs [--counts] FILE...
 *
 * --counts: also prints all counts of each, to which weights are fitted.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/run.h"
#include "core.h"
#include "cost/cost.h"
#include "render_request.h"
#include "request/compare.h"
#include "request/drawing_file.h"
#include "scene/camera/resolved_view.h"
#include "scene/scene.h"
#include "support/files.h"

enum { ROUNDS = 5 };
static const double enough_ms = 60.0, least_ms = 1.0, least_bytes = 1e6;

struct share {
    const char *name, *words;
    int count, within_2, within_3;
    double under, over; /* the worst of taken / predicted, and of predicted / taken */
};

static double now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static double fail(const struct zr_error *error)
{
    fprintf(stderr, "%s: %s\n", error->items[0].pointer, error->items[0].detail);
    return -1.0;
}

/* Rendering and encoding; below 0: they failed. */
static double measure(struct zr_arena *arena, const struct zr_request *request, struct zr_cost *cost, double *bytes)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene = NULL;
    const struct zr_resolved_view *resolved = NULL;
    const struct zr_frame *frame = NULL;
    struct zr_answer answer;
    struct zr_error error = {.count = 0};
    zr_arena_reset(arena, SIZE_MAX);
    if (zr_scene_read(&(struct zr_run){.arena = arena, .error = &error}, request, &limits, &scene) != ZR_OK ||
        zr_resolved_view_find(&(struct zr_run){.arena = arena, .error = &error}, scene, &resolved) != ZR_OK)
        return fail(&error);
    *cost = zr_scene_cost(scene, resolved);
    *bytes = (double)arena->used + cost->window_bytes + cost->mesh_bytes;
    const double begin_ms = now_ms();
    if (zr_render(&(struct zr_run){.arena = arena, .error = &error}, scene, resolved, &frame) != ZR_OK ||
        zr_encode(&(struct zr_run){.arena = arena, .error = &error}, scene, frame, &answer) != ZR_OK)
        return fail(&error);
    return now_ms() - begin_ms;
}

static void add(struct share *share, double predicted, double took)
{
    const double wrong = fmax(predicted / took, took / predicted);
    share->count++;
    share->within_2 += wrong <= 2.0;
    share->within_3 += wrong <= 3.0;
    share->under = fmax(share->under, took / predicted);
    share->over = fmax(share->over, predicted / took);
}

static void print_share(const struct share *share)
{
    const double all = fmax(share->count, 1.0);
    printf("%s: %d, within 2 x %.0f %%, within 3 x %.0f %%; took up to %.1f x as %s, and as little as 1/%.1f\n",
           share->name, share->count, 100.0 * share->within_2 / all, 100.0 * share->within_3 / all, share->under,
           share->words, share->over);
}

static void run(struct zr_arena *arena, const struct zr_request *request, const char *name, bool counts,
                struct share shares[3])
{
    struct zr_cost cost;
    double took_ms = HUGE_VAL, sum_ms = 0.0, bytes = 0.0;
    for (int i = 0; i < ROUNDS && sum_ms < enough_ms; i++) {
        const double ms = measure(arena, request, &cost, &bytes);
        if (ms < 0.0) return;
        took_ms = fmin(took_ms, ms);
        sum_ms += ms;
    }
    add(&shares[took_ms >= least_ms], cost.ms, took_ms);
    if ((double)arena->peak >= least_bytes) add(&shares[2], bytes, (double)arena->peak);
    const struct zr_cost_most most = zr_cost_most(&cost);
    printf("%-60s predicted %9.3f ms, took %9.3f: %5.2f; predicted %7.2f MB, held %7.2f: %5.2f; most of it %.3f ms for "
           "%.3g %s\n",
           name, cost.ms, took_ms, cost.ms / took_ms, 1e-6 * bytes, 1e-6 * (double)arena->peak,
           bytes / (double)arena->peak, most.ms, most.count, most.words);
    for (int kind = 0; counts && kind < ZR_COST_KINDS; kind++)
        printf("%s%.6g", kind ? " " : "# ", cost.counts[kind]);
    if (counts) putchar('\n');
}

/* A technical drawing of a model, or the model compared with itself. */
static void run_task(struct zr_arena *arena, const struct zr_request *request, const char *file, bool is_drawing,
                     struct share *share)
{
    const char *const query = is_drawing ? NULL : "precision=full";
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene = NULL;
    struct zr_error error = {.count = 0};
    const struct zr_run run = {.arena = arena, .scratch = arena, .error = &error};
    double took_ms = HUGE_VAL, predicted_ms = 0.0;
    for (int i = 0; i < ROUNDS && took_ms > enough_ms; i++) {
        struct zr_drawing_file drawing;
        struct zr_compare_answer answer;
        zr_arena_reset(arena, SIZE_MAX);
        if (zr_scene_read(&run, request, &limits, &scene) != ZR_OK) {
            fail(&error);
            return;
        }
        predicted_ms = is_drawing ? zr_drawing_cost_ms(scene, query) : zr_compare_cost_ms(scene, scene, query);
        const double begin_ms = now_ms();
        if ((is_drawing ? zr_drawing_file_make(&run, scene, query, &drawing)
                        : zr_compare(&run, scene, scene, query, &answer)) != ZR_OK) {
            fail(&error);
            return;
        }
        took_ms = fmin(took_ms, now_ms() - begin_ms);
    }
    add(share, predicted_ms, took_ms);
    printf("%s %-*s predicted %9.3f ms, took %9.3f: %5.2f\n", file, (int)fmax(59.0 - (double)strlen(file), 1.0),
           is_drawing ? "drawing" : "compare", predicted_ms, took_ms, predicted_ms / took_ms);
}

int main(int argc, char **argv)
{
    static const char *const looks[] = {"textbook", "studio", "technical", "metal", "xray"};
    static const char *const channels[] = {"depth", "wall", "thickness", "layers", "fragments", "masks", "info"};
    enum { LOOKS = sizeof looks / sizeof *looks, CHANNELS = sizeof channels / sizeof *channels };
    static const struct {
        const char *width, *height;
    } sizes[] = {{"64", "48"}, {"640", "480"}, {"1920", "1080"}};
    struct share shares[3] = {{.name = "below 1 ms", .words = "long"},
                              {.name = "1 ms and more", .words = "long"},
                              {.name = "memory from 1 MB on", .words = "much"}};
    struct zr_arena arena;
    bool counts = false;
    zr_arena_init(&arena, (size_t)1 << 34);
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--counts") == 0) {
            counts = true;
            continue;
        }
        size_t size = 0;
        char *bytes = file_read(argv[i], &size);
        const size_t length = strlen(argv[i]);
        if (!bytes) {
            perror(argv[i]);
            return 1;
        }
        struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = bytes, .size = size};
        if (length < 5 || strcmp(argv[i] + length - 5, ".json") == 0) {
            run(&arena, &request, argv[i], counts, shares);
        } else {
            request.format = ZR_FORMAT_UNKNOWN;
            for (size_t k = 0; k < 3 * (LOOKS + CHANNELS); k++) {
                char name[512];
                request.look = looks[k / 3 < LOOKS ? k / 3 : 0];
                request.channel = k / 3 < LOOKS ? NULL : channels[k / 3 - LOOKS];
                request.width = sizes[k % 3].width;
                request.height = sizes[k % 3].height;
                snprintf(name, sizeof name, "%s %s %s", argv[i], request.channel ? request.channel : request.look,
                         request.width);
                run(&arena, &request, name, counts, shares);
            }
            request.channel = request.look = NULL;
            for (int k = 0; k < 2; k++)
                run_task(&arena, &request, argv[i], k == 0, &shares[1]);
        }
        free(bytes);
    }
    zr_arena_free(&arena);
    for (int k = 0; k < 3; k++)
        print_share(&shares[k]);
    return 0;
}
