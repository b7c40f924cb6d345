#include "request/compare.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory_error.h"
#include "output/json/comparison_json.h"
#include "request/compare_scene.h"
#include "scene/picture.h"

enum { VALUE_SIZE = 64 };

struct wanted {
    struct zr_comparison_options options;
    struct zr_compare_picture picture;
};

static bool is_word(const char *text, size_t size, const char *word)
{
    return strlen(word) == size && memcmp(text, word, size) == 0;
}

/* Returns the number of a word, or -1. */
static int find_word(const char *text, size_t size, const char *const *words, int count)
{
    for (int i = 0; i < count; i++)
        if (is_word(text, size, words[i])) return i;
    return -1;
}

/* Reads a number of at least 0. */
static bool read_length(const char *text, size_t size, double *out)
{
    char copy[VALUE_SIZE], *end;
    if (size == 0 || size >= sizeof copy || memchr("0123456789.", *text, 11) == NULL) return false;
    memcpy(copy, text, size);
    copy[size] = '\0';
    *out = strtod(copy, &end);
    return *end == '\0' && *out >= 0.0 && *out < HUGE_VAL;
}

static enum zr_status copy_word(const char *value, size_t size, const char *name, char out[ZR_COMPARE_WORD_SIZE],
                                struct zr_error *error)
{
    if (size >= ZR_COMPARE_WORD_SIZE) return zr_error_add(error, ZR_BAD_REQUEST, name, "a name is needed");
    memcpy(out, value, size);
    out[size] = '\0';
    return ZR_OK;
}

static enum zr_status read_switch(const char *value, size_t size, const char *name, bool *is_off,
                                  struct zr_error *error)
{
    *is_off = is_word(value, size, "off");
    if (*is_off || is_word(value, size, "on")) return ZR_OK;
    return zr_error_add(error, ZR_BAD_REQUEST, name, "one of: on, off");
}

static const char *const parameters[] = {"align",   "deviation", "features",  "look", "precision",
                                         "rescale", "show",      "tolerance", "view"};

bool zr_compare_has_parameter(const char *text)
{
    return find_word(text, strcspn(text, "=&"), parameters, sizeof parameters / sizeof *parameters) >= 0;
}

static enum zr_status read_parameter(const char *text, size_t size, struct wanted *out, struct zr_error *error)
{
    const char *equals = memchr(text, '=', size);
    const size_t name = equals ? (size_t)(equals - text) : size, length = equals ? size - name - 1 : 0;
    const char *value = equals ? equals + 1 : text + size;
    if (is_word(text, name, "tolerance")) {
        if (read_length(value, length, &out->options.tolerance)) return ZR_OK;
        return zr_error_add(error, ZR_BAD_REQUEST, "tolerance", "a length of at least 0 is needed");
    }
    if (is_word(text, name, "precision")) {
        out->options.is_quick = is_word(value, length, "quick");
        if (out->options.is_quick || is_word(value, length, "full")) return ZR_OK;
        return zr_error_add(error, ZR_BAD_REQUEST, "precision", "one of: quick, full");
    }
    if (is_word(text, name, "deviation"))
        return read_switch(value, length, "deviation", &out->options.has_no_deviation, error);
    if (is_word(text, name, "features"))
        return read_switch(value, length, "features", &out->options.has_no_features, error);
    if (is_word(text, name, "rescale")) {
        bool is_off;
        const enum zr_status status = read_switch(value, length, "rescale", &is_off, error);
        out->options.can_scale = !is_off;
        return status;
    }
    if (is_word(text, name, "align")) {
        const int found = find_word(value, length, zr_align_words, 4);
        out->options.align = (enum zr_align)found;
        if (found >= 0) return ZR_OK;
        return zr_error_add(error, ZR_BAD_REQUEST, "align", "one of: none, bounds, principal, icp");
    }
    if (is_word(text, name, "show")) {
        const int found = find_word(value, length, zr_compare_show_words, ZR_SHOW_COUNT);
        out->picture.show = found;
        out->options.is_drawn = found > ZR_SHOW_NONE;
        if (found >= 0) return ZR_OK;
        return zr_error_add(error, ZR_BAD_REQUEST, "show", "one of: none, difference, deviation, side");
    }
    if (is_word(text, name, "look")) return copy_word(value, length, "look", out->picture.look, error);
    if (is_word(text, name, "view")) return copy_word(value, length, "view", out->picture.view, error);
    return zr_error_add(
        error, ZR_BAD_REQUEST, NULL,
        "unknown parameter; those of comparisons are align, deviation, features, look, precision, rescale, "
        "show, tolerance, view");
}

static enum zr_status read_query(const char *query, struct wanted *out, struct zr_error *error)
{
    enum zr_status status = ZR_OK;
    *out = (struct wanted){.options = {.tolerance = -1.0}};
    while (query && *query && status == ZR_OK) {
        const size_t size = strcspn(query, "&");
        if (size > 0) status = read_parameter(query, size, out, error);
        query += size + (query[size] == '&');
    }
    if (status == ZR_OK && out->options.can_scale && out->options.align == ZR_ALIGN_NONE)
        return zr_error_add(error, ZR_BAD_REQUEST, "rescale",
                            "an alignment scales: align has to be bounds, principal or icp");
    return status;
}

static double triangles_of(const struct zr_scene *scene)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        sum += (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
    }
    return sum;
}

double zr_compare_cost_ms(const struct zr_scene *a, const struct zr_scene *b, const char *query)
{
    const double triangles = triangles_of(a) + triangles_of(b);
    struct zr_error error = {0};
    struct wanted wanted;
    if (read_query(query, &wanted, &error) != ZR_OK) return 0.0;
    const struct zr_comparison_options *options = &wanted.options;
    const double distances = options->has_no_deviation ? 0.0 : (options->is_quick ? 60.0 : 200.0) + 0.0015 * triangles,
                 holes = options->has_no_features ? 0.0 : 0.0015 * triangles,
                 picture = options->is_drawn ? 150.0 + 0.003 * triangles : 0.0,
                 motion = options->align != ZR_ALIGN_NONE ? 200.0 : 0.0;
    return 20.0 + 0.001 * triangles + distances + holes + picture + motion;
}

/* True if z points up in the file. */
static bool z_is_up(const struct zr_scene *scene)
{
    return scene->picture->z_is_up || (scene->file.up && strcmp(scene->file.up, "z") == 0);
}

static enum zr_status compare(const struct zr_run *run, const struct zr_scene *a, const struct zr_scene *b,
                              const struct wanted *wanted, struct zr_compare_answer *answer)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    struct zr_comparison comparison;
    struct zr_buffer buffer = {.arena = run->scratch};
    enum zr_status status = zr_comparison_make(&inner, a, b, &wanted->options, &comparison);
    if (status == ZR_OK) status = zr_comparison_json_write(&comparison, a, b, &buffer);
    if (status == ZR_OK && !zr_buffer_add(&buffer, "", 1)) status = ZR_NO_MEMORY;
    if (status == ZR_OK && wanted->picture.show != ZR_SHOW_NONE)
        status = zr_compare_scene_make(run, &comparison, &wanted->picture, z_is_up(a), &answer->scene);
    answer->json = (const char *)buffer.bytes;
    answer->size = status == ZR_OK ? buffer.size - 1 : 0;
    answer->is_same = comparison.is_same;
    return status;
}

enum zr_status zr_compare(const struct zr_run *run, const struct zr_scene *a, const struct zr_scene *b,
                          const char *query, struct zr_compare_answer *answer)
{
    struct wanted wanted;
    *answer = (struct zr_compare_answer){.json = NULL};
    enum zr_status status = read_query(query, &wanted, run->error);
    if (status == ZR_OK) status = compare(run, a, b, &wanted, answer);
    if (status == ZR_NO_MEMORY && run->error->count == 0)
        zr_memory_error_add(run->error, zr_arena_ok(run->scratch) ? run->arena : run->scratch, "comparing", "");
    return status;
}
