/* Arrays that stand for lists: a scene gives the same bytes with its numbers as text, as NPY parts and as arrays of
 * this process, lent and not, of every type; at once and as a kept scene. */
#include <cjson/cJSON.h>
#include <dirent.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "library/zraster.h"
#include "support/cmocka_all.h"
#include "support/files.h"
#include "support/npy.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "unit/guarded.h"

static zraster *renderer;

/* ---- parts ---- */

/* How numbers are handed over. is_whole: floats that are all integers have the type of indices. */
struct way {
    const char *name;
    bool is_npy, is_whole;
    uint32_t flags, floats, indices;
};
static const struct way ways[] = {
    {"NPY, f4 and u4", true, false, 0, ZRASTER_F4, ZRASTER_U4},
    {"NPY, f8 and i8", true, true, ZRASTER_LEND, ZRASTER_F8, ZRASTER_I8},
    {"arrays, f4 and i4", false, true, 0, ZRASTER_F4, ZRASTER_I4},
    {"arrays, f8 and u8", false, false, 0, ZRASTER_F8, ZRASTER_U8},
    {"lent arrays, f4 and u4", false, false, ZRASTER_LEND, ZRASTER_F4, ZRASTER_U4},
    {"lent arrays, f8 and i4", false, true, ZRASTER_LEND, ZRASTER_F8, ZRASTER_I4},
};
enum { WAYS = sizeof ways / sizeof *ways, PARTS_MAX = 200 };

static const char *const descriptions[] = {"", "<f4", "<f8", "|u1", "<i4", "<u4", "<i8", "<u8"};

struct parts {
    size_t count;
    char names[PARTS_MAX][8];
    struct zraster_part items[PARTS_MAX];
    struct guarded memory[PARTS_MAX]; /* ends at a guard page */
};

static size_t put(void *out, uint32_t type, double value)
{
    const float f4 = (float)value;
    const long long whole = type == ZRASTER_F4 || type == ZRASTER_F8 ? 0 : (long long)value;
    const size_t size = (size_t)(descriptions[type][2] - '0');
    memcpy(out, type == ZRASTER_F4 ? (const void *)&f4 : type == ZRASTER_F8 ? (const void *)&value : &whole, size);
    return size;
}

static void add_part(struct parts *parts, const struct way *way, uint32_t type, const void *numbers, size_t bytes,
                     size_t rows, size_t columns)
{
    struct zraster_part *part = &parts->items[parts->count];
    struct guarded *memory = &parts->memory[parts->count];
    char shape[64], *file = NULL;
    snprintf(parts->names[parts->count], sizeof parts->names[0], "p%zu", parts->count);
    *part = (struct zraster_part){.name = parts->names[parts->count], .flags = way->flags};
    snprintf(shape, sizeof shape, columns > 0 ? "(%zu, %zu)" : "(%zu,)", rows, columns);
    if (way->is_npy) {
        size_t size = 0;
        file = npy_file(descriptions[type], "False", shape, numbers, bytes, &size);
        assert_non_null(file);
        part->array = (struct zraster_array){.ndim = 1, .shape = {size}};
    } else {
        part->array = (struct zraster_array){.type = type, .ndim = columns > 0 ? 2 : 1, .shape = {rows, columns}};
    }
    *memory = guarded_copy(file ? file : numbers, file ? part->array.shape[0] : bytes);
    part->array.data = memory->bytes;
    parts->count++;
    free(file);
}

/* Overwrites what was not lent: the library must not read it again. */
static void spoil(struct parts *parts)
{
    for (size_t i = 0; i < parts->count; i++)
        if (!(parts->items[i].flags & ZRASTER_LEND))
            memset((void *)(uintptr_t)parts->memory[i].bytes, 0xFF, parts->memory[i].size);
}

static void free_parts(struct parts *parts)
{
    for (size_t i = 0; i < parts->count; i++)
        guarded_free(&parts->memory[i]);
    parts->count = 0;
}

/* ---- scenes whose lists become arrays ---- */

/* Finds the columns of a list of numbers (0) or of rows with as many each. False for other lists. */
static bool measure(const cJSON *list, size_t *columns)
{
    const cJSON *row, *number;
    *columns = cJSON_IsArray(list->child) ? (size_t)cJSON_GetArraySize(list->child) : 0;
    cJSON_ArrayForEach(row, list)
    {
        if (cJSON_IsArray(row) != (*columns > 0) || !(cJSON_IsArray(row) || cJSON_IsNumber(row))) return false;
        if (cJSON_IsArray(row) && (size_t)cJSON_GetArraySize(row) != *columns) return false;
        cJSON_ArrayForEach(number, row) if (!cJSON_IsNumber(number) && !cJSON_IsNull(number)) return false;
    }
    return cJSON_GetArraySize(list) > 0;
}

static bool is_whole(const cJSON *list)
{
    const cJSON *row, *number;
    cJSON_ArrayForEach(row, list)
    {
        if (cJSON_IsNumber(row) && row->valuedouble != (double)(int)row->valuedouble) return false;
        cJSON_ArrayForEach(number, row) if (cJSON_IsNull(number) ||
                                            number->valuedouble != (double)(int)number->valuedouble) return false;
    }
    return true;
}

/* Matrices, of which only lists of rows can be arrays. */
static bool is_matrix(const char *key)
{
    return strstr(key, "atrix") || strstr(key, "To") || strcmp(key, "R") == 0;
}

/* Replaces object[key] by an array, if it is a list that can be one. */
static void replace(cJSON *object, const char *key, bool is_index, const struct way *way, struct parts *parts)
{
    cJSON *list = cJSON_GetObjectItemCaseSensitive(object, key), *row, *number, *name;
    size_t columns, bytes = 0;
    if (!cJSON_IsArray(list) || parts->count == PARTS_MAX || !measure(list, &columns)) return;
    if (columns == 0 && is_matrix(key)) return;
    const uint32_t type = is_index || (way->is_whole && is_whole(list)) ? way->indices : way->floats;
    const size_t rows = (size_t)cJSON_GetArraySize(list);
    char *numbers = malloc(8 * rows * (columns + 1));
    assert_non_null(numbers);
    cJSON_ArrayForEach(row, list)
    {
        if (columns == 0) bytes += put(numbers + bytes, type, row->valuedouble);
        cJSON_ArrayForEach(number, row) bytes +=
            put(numbers + bytes, type, cJSON_IsNull(number) ? (double)NAN : number->valuedouble);
    }
    add_part(parts, way, type, numbers, bytes, rows, columns);
    free(numbers);
    assert_non_null(name = cJSON_CreateObject());
    cJSON_AddStringToObject(name, "asset", parts->names[parts->count - 1]);
    cJSON_ReplaceItemInObjectCaseSensitive(object, key, name);
}

/* Returns the text of the scene with arrays, to be freed. */
static char *with_arrays(const char *scene, const struct way *way, struct parts *parts)
{
    static const char *const floats[] = {"positions", "normals",       "colors",        "faceColors",
                                         "texcoords", "texcoords1",    "tangents",      "scalars",
                                         "heights",   "vertices",      "values",        "matrix",
                                         "R",         "cameraToWorld", "worldToCamera", "projectionMatrix"};
    static const char *const indices[] = {"faces", "lines", "points"};
    cJSON *root = cJSON_Parse(scene), *list, *object;
    assert_non_null(root);
    parts->count = 0;
    for (size_t k = 0; k < sizeof floats / sizeof *floats; k++)
        replace(cJSON_GetObjectItem(root, "view"), floats[k], false, way, parts);
    cJSON_ArrayForEach(list, root) cJSON_ArrayForEach(object, list)
    {
        for (size_t k = 0; k < sizeof floats / sizeof *floats; k++) {
            replace(object, floats[k], false, way, parts);
            replace(cJSON_GetObjectItemCaseSensitive(object, "heights"), floats[k], false, way, parts);
        }
        for (size_t k = 0; k < sizeof indices / sizeof *indices; k++)
            replace(object, indices[k], true, way, parts);
    }
    char *text = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    assert_non_null(text);
    return text;
}

/* ---- drawing ---- */

struct answer {
    char *bytes;
    size_t size;
};

static struct answer encode(zraster_status status, zraster_picture *picture, zraster_error *error, const char *by)
{
    struct zraster_bytes bytes;
    struct answer answer;
    if (status == ZRASTER_OK) status = zraster_picture_encode(picture, NULL, &bytes, &error);
    if (status != ZRASTER_OK) fail_msg("%s: %s", by, zraster_error_text(error));
    for (size_t i = 0; zraster_picture_warning(picture, i); i++)
        assert_null(strstr(zraster_picture_warning(picture, i), "the asset"));
    answer = (struct answer){malloc(bytes.size), bytes.size};
    assert_non_null(answer.bytes);
    memcpy(answer.bytes, bytes.data, bytes.size);
    zraster_error_free(error);
    zraster_picture_free(picture);
    return answer;
}

static struct zraster_request request_of(const char *text, const struct parts *parts)
{
    return (struct zraster_request){.struct_size = sizeof(struct zraster_request),
                                    .body = text,
                                    .body_size = strlen(text),
                                    .parts = parts ? parts->items : NULL,
                                    .part_count = parts ? parts->count : 0};
}

static struct answer draw(const char *text, struct parts *parts, const char *by)
{
    const struct zraster_request request = request_of(text, parts);
    zraster_picture *picture;
    zraster_error *error;
    const zraster_status status = zraster_draw(renderer, &request, &picture, &error);
    if (parts) spoil(parts);
    return encode(status, picture, error, by);
}

static struct answer draw_kept(const char *text, struct parts *parts, const char *change, const char *by)
{
    const struct zraster_request request = request_of(text, parts), changed = request_of(change, NULL);
    zraster_scene *scene;
    zraster_picture *picture;
    zraster_error *error;
    if (zraster_scene_read(renderer, &request, &scene, &error) != ZRASTER_OK)
        fail_msg("%s: %s", by, zraster_error_text(error));
    spoil(parts);
    const zraster_status status = zraster_scene_draw(scene, &changed, &picture, &error);
    const struct answer answer = encode(status, picture, error, by);
    zraster_scene_free(scene);
    return answer;
}

static void assert_same(struct answer wanted, struct answer got, const char *name, const char *by)
{
    if (wanted.size != got.size || memcmp(wanted.bytes, got.bytes, got.size) != 0)
        fail_msg("%s: other bytes by %s", name, by);
    free(got.bytes);
}

/* By way number `first`, first + step, ... Returns the number of arrays. */
static size_t check(const char *text, const char *name, size_t first, size_t step)
{
    static struct parts parts;
    size_t count = 0;
    const struct answer wanted = draw(text, NULL, name);
    for (size_t i = first; i < WAYS; i += step) {
        char *scene = with_arrays(text, &ways[i], &parts);
        count += parts.count;
        assert_same(wanted, draw(scene, &parts, name), name, ways[i].name);
        free_parts(&parts);
        free(scene);
        scene = with_arrays(text, &ways[i], &parts);
        assert_same(wanted, draw_kept(scene, &parts, "{}", name), name, "a kept scene");
        free_parts(&parts);
        free(scene);
    }
    free(wanted.bytes);
    return count;
}

/* ---- scenes ---- */

static int is_scene(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".json") == 0;
}

/* Two ways for each scene, all of them in turns. */
static void all_scenes_are_drawn_alike(void **state)
{
    struct dirent **entries;
    const int files = scandir("tests/scenes", &entries, is_scene, alphasort);
    size_t arrays = 0;
    (void)state;
    assert_true(files > 30);
    for (int i = 0; i < files; i++) {
        char path[600], *text;
        snprintf(path, sizeof path, "tests/scenes/%s", entries[i]->d_name);
        assert_non_null(text = file_read(path, &(size_t){0}));
        arrays += check(text, path, (size_t)i % 3, 3);
        free(text);
        free(entries[i]);
    }
    free(entries);
    assert_true(arrays > 500);
}

static void write_rows(FILE *out, struct random *random, const char *key, unsigned rows, unsigned columns, double low,
                       double high)
{
    fprintf(out, ", \"%s\": [", key);
    for (unsigned i = 0; i < rows * columns; i++)
        fprintf(out, "%s%.9g%s", columns > 1 && i % columns == 0 ? "[" : "",
                low + (high - low) * random_range(random, 0, 1),
                i + 1 == rows * columns                 ? columns > 1 ? "]]" : "]"
                : columns > 1 && (i + 1) % columns == 0 ? "],"
                                                        : ",");
}

static void write_indices(FILE *out, struct random *random, const char *key, unsigned rows, unsigned columns,
                          unsigned positions)
{
    fprintf(out, ", \"%s\": [", key);
    for (unsigned i = 0; i < rows * columns; i++)
        fprintf(out, "%s%u%s", columns > 1 && i % columns == 0 ? "[" : "", random_below(random, positions),
                i + 1 == rows * columns                 ? columns > 1 ? "]]" : "]"
                : columns > 1 && (i + 1) % columns == 0 ? "],"
                                                        : ",");
}

/* Returns a scene of a random mesh, and of one that uses the same part. To be freed. */
static char *random_scene(struct random *random, unsigned positions)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out, "{\"window\": {\"width\": 70, \"height\": 50}, \"outputs\": [{\"channel\": \"color\"}, {\"channel\": "
                 "\"faceId\"}, {\"channel\": \"normals\"}, {\"channel\": \"depth\"}], \"meshes\": [{\"name\": \"a\"");
    write_rows(out, random, "positions", positions, 3, -2, 2);
    write_indices(out, random, "faces", 1 + random_below(random, positions), 3 + random_below(random, 3), positions);
    if (random_below(random, 2)) write_rows(out, random, "normals", positions, 3, -1, 1);
    if (random_below(random, 2))
        write_rows(out, random, "colors", positions, 3 + random_below(random, 2), 0, 1);
    else
        write_rows(out, random, "scalars", positions, 1, -5, 5);
    if (random_below(random, 2)) write_indices(out, random, "lines", 9, 2, positions);
    if (random_below(random, 2)) write_indices(out, random, "points", 9, 1, positions);
    fprintf(out, "}]}");
    fclose(out);
    return text;
}

static void random_meshes_are_drawn_alike(void **state)
{
    struct random random = random_seeded(38);
    (void)state;
    for (unsigned i = 0; i < 12; i++) {
        char name[24], *text = random_scene(&random, i == 11 ? 30000 : 3 + random_below(&random, 300));
        snprintf(name, sizeof name, "random mesh %u", i);
        assert_true(check(text, name, 0, 1) > 2 * WAYS);
        free(text);
    }
}

/* So long a list that threads read it ahead, which arrays in between end. */
static void polygons_may_mix_lists_and_arrays(void **state)
{
    enum { POLYGONS = 6000, EVERY = 100 };
    static struct parts parts;
    struct random random = random_seeded(3);
    char *lists = NULL, *arrays = NULL;
    size_t size;
    FILE *out[2] = {open_memstream(&lists, &size), open_memstream(&arrays, &size)};
    (void)state;
    assert_true(out[0] && out[1]);
    for (int k = 0; k < 2; k++)
        fprintf(out[k], "{\"window\": {\"width\": 64, \"height\": 48}, \"polygons\": [");
    parts.count = 0;
    for (int i = 0; i < POLYGONS; i++) {
        float v[9];
        for (int k = 0; k < 9; k++)
            v[k] = (float)random_range(&random, -3, 3);
        for (int k = 0; k < 2; k++) {
            fprintf(out[k], "%s{\"vertices\": ", i > 0 ? ", " : "");
            if (k == 1 && i % EVERY == EVERY / 2)
                fprintf(out[k], "{\"asset\": \"p%zu\"}}", parts.count);
            else
                fprintf(out[k], "[[%.9g,%.9g,%.9g],[%.9g,%.9g,%.9g],[%.9g,%.9g,%.9g]]}", (double)v[0], (double)v[1],
                        (double)v[2], (double)v[3], (double)v[4], (double)v[5], (double)v[6], (double)v[7],
                        (double)v[8]);
        }
        if (i % EVERY == EVERY / 2) add_part(&parts, &ways[i / EVERY % WAYS], ZRASTER_F4, v, sizeof v, 3, 3);
    }
    for (int k = 0; k < 2; k++) {
        fprintf(out[k], "]}");
        fclose(out[k]);
    }
    const struct answer wanted = draw(lists, NULL, "polygons");
    assert_same(wanted, draw_kept(arrays, &parts, "{}", "polygons"), "polygons", "arrays among them");
    free(wanted.bytes);
    free_parts(&parts);
    free(lists);
    free(arrays);
}

#define QUAD "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], \"faces\": [[0,1,2,3]]"

static void bytes_are_colors_from_0_to_255(void **state)
{
    static const unsigned char rgba[16] = {255, 0, 17, 255, 1, 2, 3, 254, 127, 128, 129, 128, 0, 255, 200, 255};
    static struct parts parts;
    (void)state;
    for (size_t columns = 3; columns <= 4; columns++) {
        unsigned char bytes[16];
        char text[500], hex[4][12];
        for (size_t i = 0; i < 4; i++) {
            memcpy(bytes + columns * i, rgba + 4 * i, columns);
            for (size_t k = 0; k < columns; k++)
                snprintf(hex[i] + 2 * k, 3, "%02x", rgba[4 * i + k]);
        }
        snprintf(text, sizeof text, "{\"meshes\": [{" QUAD ", \"colors\": [\"#%s\",\"#%s\",\"#%s\",\"#%s\"]}]}", hex[0],
                 hex[1], hex[2], hex[3]);
        const struct answer wanted = draw(text, NULL, "colors");
        for (size_t i = 0; i < WAYS; i++) {
            parts.count = 0;
            add_part(&parts, &ways[i], ZRASTER_U1, bytes, 4 * columns, 4, columns);
            assert_same(wanted, draw("{\"meshes\": [{" QUAD ", \"colors\": {\"asset\": \"p0\"}}]}", &parts, "u1"), "u1",
                        ways[i].name);
            free_parts(&parts);
        }
        free(wanted.bytes);
    }
}

/* One part serves two meshes that leave out different positions: the scene moves them in copies. */
static void meshes_share_a_part(void **state)
{
    static const float p[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9, 8, 9, 9, 9, 8, 9};
    static struct parts parts;
    (void)state;
    const struct answer wanted =
        draw("{\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,1,0],[9,9,9],[8,9,9],[9,8,9]], \"faces\": [[0,1,2]]}, "
             "{\"positions\": [[0,0,0],[1,0,0],[0,1,0],[9,9,9],[8,9,9],[9,8,9]], \"faces\": [[3,4,5]]}]}",
             NULL, "lists");
    for (size_t i = 0; i < WAYS; i++) {
        parts.count = 0;
        add_part(&parts, &ways[i], ZRASTER_F4, p, sizeof p, 6, 3);
        assert_same(wanted,
                    draw_kept("{\"meshes\": [{\"positions\": {\"asset\": \"p0\"}, \"faces\": [[0,1,2]]}, "
                              "{\"positions\": {\"asset\": \"p0\"}, \"faces\": [[3,4,5]]}]}",
                              &parts, "{}", "shared"),
                    "a shared part", ways[i].name);
        if (ways[i].flags & ZRASTER_LEND && !ways[i].is_npy) assert_memory_equal(parts.memory[0].bytes, p, sizeof p);
        free_parts(&parts);
    }
    free(wanted.bytes);
}

static void a_pose_may_be_an_array(void **state)
{
    static const double m[16] = {0, -1, 0, 2, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const char scene[] = "{\"meshes\": [{" QUAD "}], \"nodes\": [{\"name\": \"n\", \"mesh\": 0}]}";
    const struct zraster_part pose = {.name = "m", .array = {m, ZRASTER_F8, 2, {4, 4}}};
    struct zraster_request request = request_of(scene, NULL),
                           change = request_of("{\"poses\": {\"n\": {\"asset\": \"m\"}}}", NULL);
    zraster_scene *kept;
    zraster_picture *picture;
    zraster_error *error;
    (void)state;
    change.parts = &pose;
    change.part_count = 1;
    assert_int_equal(zraster_scene_read(renderer, &request, &kept, NULL), ZRASTER_OK);
    const zraster_status status = zraster_scene_draw(kept, &change, &picture, &error);
    const struct answer wanted =
        draw("{\"meshes\": [{" QUAD "}], \"nodes\": [{\"name\": \"n\", \"mesh\": 0, \"matrix\": "
             "[[0,-1,0,2],[1,0,0,0],[0,0,1,0],[0,0,0,1]]}]}",
             NULL, "matrix");
    assert_same(wanted, encode(status, picture, error, "pose"), "a pose", "an array");
    free(wanted.bytes);
    zraster_scene_free(kept);
}

/* ---- a caller that writes meanwhile ---- */

enum { SHARED = 3 << 17 };
static _Atomic uint32_t shared[SHARED];
static atomic_bool is_done;

static void *write_meanwhile(void *context)
{
    struct random random = random_seeded(7);
    (void)context;
    while (!atomic_load(&is_done)) {
        _Atomic uint32_t *place = &shared[random_below(&random, SHARED)];
        atomic_store_explicit(place, UINT32_MAX, memory_order_relaxed);
        atomic_store_explicit(place, 1, memory_order_relaxed);
    }
    return NULL;
}

static void indices_that_change_do_no_harm(void **state)
{
    static const char text[] = "{\"window\": {\"width\": 9, \"height\": 9}, \"meshes\": [{\"positions\": "
                               "[[0,0,0],[1,0,0],[0,1,0]], \"faces\": {\"asset\": \"f\"}}]}";
    const struct zraster_part part = {.name = "f",
                                      .array = {(const void *)(uintptr_t)shared, ZRASTER_U4, 2, {SHARED / 3, 3}}};
    struct zraster_request request = request_of(text, NULL);
    pthread_t writer;
    int drawn = 0;
    (void)state;
    if (IS_THREAD_SANITIZED) {
        print_message("skipped: ThreadSanitizer reports the race that this test makes\n");
        skip();
    }
    request.parts = &part;
    request.part_count = 1;
    for (size_t i = 0; i < SHARED; i++)
        shared[i] = (uint32_t)(i % 3);
    assert_int_equal(pthread_create(&writer, NULL, write_meanwhile, NULL), 0);
    for (int i = 0; i < 40; i++) {
        zraster_picture *picture = NULL;
        zraster_scene *scene = NULL;
        zraster_error *error = NULL;
        zraster_status status = i % 2 ? zraster_draw(renderer, &request, &picture, &error)
                                      : zraster_scene_read(renderer, &request, &scene, &error);
        if (status != ZRASTER_OK) assert_int_equal(status, ZRASTER_BAD_SCENE);
        zraster_error_free(error);
        if (scene) assert_int_equal(zraster_scene_draw(scene, NULL, &picture, NULL), ZRASTER_OK);
        drawn += picture != NULL;
        zraster_picture_free(picture);
        zraster_scene_free(scene);
    }
    atomic_store(&is_done, true);
    pthread_join(writer, NULL);
    print_message("%d of 40 drawn\n", drawn);
    shared[0] = 3;
    assert_int_equal(zraster_draw(renderer, &request, &(zraster_picture *){NULL}, NULL), ZRASTER_BAD_SCENE);
}

static int open_renderer(void **state)
{
    const struct zraster_options options = {.struct_size = sizeof options, .threads = 2};
    (void)state;
    return zraster_open(&options, &renderer) == ZRASTER_OK ? 0 : -1;
}

static int close_renderer(void **state)
{
    (void)state;
    zraster_close(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_scenes_are_drawn_alike),
        cmocka_unit_test(random_meshes_are_drawn_alike),
        cmocka_unit_test(polygons_may_mix_lists_and_arrays),
        cmocka_unit_test(bytes_are_colors_from_0_to_255),
        cmocka_unit_test(meshes_share_a_part),
        cmocka_unit_test(a_pose_may_be_an_array),
        cmocka_unit_test(indices_that_change_do_no_harm),
    };
    return cmocka_run_group_tests_name("arrays", tests, open_renderer, close_renderer);
}
