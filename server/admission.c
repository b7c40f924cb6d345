#include "admission.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clock.h"

/* ---- time ---- */

enum { TRIALS = 5, CALIBRATION_ARENA = 64 << 20 };

/* `count` triangles of `size` window widths, in one picture of 256 x 256. */
static char *calibration_scene(int count, double size, const char *channel)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out) return NULL;
    fprintf(out,
            "{\"window\":{\"width\":256,\"height\":256},\"outputs\":[{\"channel\":\"%s\"}],"
            "\"view\":{\"worldToCamera\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"
            "\"projectionMatrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},\"polygons\":[",
            channel);
    for (int i = 0; i < count; i++) {
        double x = -1 + 1.9 * (i % 64) / 64.0, y = -1 + 1.9 * (i / 64 % 64) / 64.0, z = 0.9 - 1.8 * i / count;
        if (size > 1) x = y = -1;
        fprintf(out, "%s{\"vertices\":[[%.4f,%.4f,%.4f],[%.4f,%.4f,%.4f],[%.4f,%.4f,%.4f]]}", i ? "," : "", x, y, z,
                x + 2 * size, y, z, x, y + 2 * size, z);
    }
    fputs("]}", out);
    return fclose(out) == 0 ? text : NULL;
}

struct sample {
    struct zr_cost cost;
    double render_ns, encode_ns;
};

static bool time_once(struct zr_arena *arena, const char *text, struct sample *sample)
{
    struct zr_limits limits = zr_limits_default();
    struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text)};
    struct zr_error error = {0};
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    struct zr_answer answer;
    zr_arena_reset(arena, 0); /* pages of memory are touched for the first time, as by a request that grows */
    if (zr_scene_read(arena, &request, &limits, &scene, &error) != ZR_OK) return false;
    sample->cost = zr_scene_cost(scene, UINT32_MAX, NULL);
    int64_t begin = clock_thread_us();
    bool ok = zr_render(arena, NULL, scene, NULL, &frame, &error) == ZR_OK;
    int64_t middle = clock_thread_us();
    ok = ok && zr_encode(arena, NULL, scene, frame, NULL, &answer, &error) == ZR_OK;
    int64_t end = clock_thread_us();
    double render = (double)(middle - begin) * 1e3, encode = (double)(end - middle) * 1e3;
    if (render < sample->render_ns) sample->render_ns = render;
    if (encode < sample->encode_ns) sample->encode_ns = encode;
    return ok;
}

/* The best of some trials, in processor time: the machine may be busy with something else,
 * and what is measured here holds for as long as the daemon runs. */
static struct sample measure(struct zr_arena *arena, int count, double size, const char *channel)
{
    struct sample sample = {.render_ns = 1e12, .encode_ns = 1e12};
    char *text = calibration_scene(count, size, channel);
    for (int i = 0; text && i < TRIALS; i++)
        time_once(arena, text, &sample);
    free(text);
    return sample;
}

static double at_least(double value, double least)
{
    return value > least ? value : least;
}

void admission_calibrate(struct admission *admission)
{
    struct zr_arena arena;
    zr_arena_init(&arena, CALIBRATION_ARENA);
    struct sample raw = measure(&arena, 1, 0.01, "windowDepth"), many = measure(&arena, 2000, 0.02, "windowDepth"),
                  large = measure(&arena, 60, 2.0, "windowDepth"), picture = measure(&arena, 2000, 0.02, "color");
    zr_arena_free(&arena);
    /* Where a clock is too coarse to tell, or a trial failed, the cost is low but never nothing. */
    admission->pixel_ns = at_least((raw.render_ns + raw.encode_ns) / at_least(raw.cost.pixels, 1), 0.1);
    admission->png_pixel_ns = at_least(picture.encode_ns / at_least(picture.cost.png_pixels, 1), 1);
    admission->fragment_ns = at_least((large.render_ns - raw.render_ns) / at_least(large.cost.fragments, 1), 0.05);
    double rest = many.render_ns - raw.render_ns - admission->fragment_ns * many.cost.fragments;
    admission->triangle_ns = at_least(rest / at_least(many.cost.triangles, 1), 10);
}

double admission_predict_ms(const struct admission *admission, const struct zr_cost *cost)
{
    return 1e-6 * (admission->triangle_ns * cost->triangles + admission->fragment_ns * cost->fragments +
                   admission->pixel_ns * cost->pixels + admission->png_pixel_ns * cost->png_pixels);
}

/* ---- memory ---- */

/* A number that the kernel tells in a file of its own, or behind `key` in a list of them;
 * false where there is none ("max": no limit). */
static bool read_number(const char *folder, const char *file, const char *key, uint64_t *out)
{
    char path[512], line[256];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    FILE *in = fopen(path, "re");
    bool found = false;
    size_t length = strlen(key);
    while (in && !found && fgets(line, sizeof line, in)) {
        char *end;
        if (strncmp(line, key, length) != 0) continue;
        *out = strtoull(line + length, &end, 10);
        found = end != line + length;
    }
    if (in) fclose(in);
    return found;
}

bool admission_memory_is_short(const char *folder)
{
    static const struct {
        const char *used, *limit, *list, *droppable;
    } versions[] = {
        {"memory.current", "memory.max", "memory.stat", "inactive_file "},
        {"memory/memory.usage_in_bytes", "memory/memory.limit_in_bytes", "memory/memory.stat", "total_inactive_file "}};
    for (size_t i = 0; i < sizeof versions / sizeof versions[0]; i++) {
        uint64_t used, limit, droppable = 0;
        if (!read_number(folder, versions[i].used, "", &used) || !read_number(folder, versions[i].limit, "", &limit))
            continue;
        read_number(folder, versions[i].list, versions[i].droppable, &droppable);
        used -= droppable < used ? droppable : used;
        return (double)used > (double)limit * (ADMISSION_MEMORY_PERCENT / 100.0);
    }
    return false;
}
