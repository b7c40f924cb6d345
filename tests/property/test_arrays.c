/* Arrays that stand for lists: a scene gives the same bytes with its numbers as text, as NPY parts and as arrays of
 * this process, lent and not, of every type; at once and as a kept scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/files.h"
#include "support/input/array_parts.h"
#include "support/random.h"
#include "support/renderer.h"
#include "support/tests.h"

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

static struct zraster_request request_with(const char *text, const struct array_parts *parts)
{
    struct zraster_request request = request_of(text);
    if (!parts) return request;
    request.parts = parts->items;
    request.part_count = parts->count;
    return request;
}

static struct answer draw(const char *text, struct array_parts *parts, const char *by)
{
    const struct zraster_request request = request_with(text, parts);
    zraster_picture *picture;
    zraster_error *error;
    const zraster_status status = zraster_draw(renderer, &request, &picture, &error);
    if (parts) array_parts_spoil(parts);
    return encode(status, picture, error, by);
}

static struct answer draw_kept(const char *text, struct array_parts *parts, const char *by)
{
    const struct zraster_request request = request_with(text, parts), changed = request_of("{}");
    zraster_scene *scene;
    zraster_picture *picture;
    zraster_error *error;
    if (zraster_scene_read(renderer, &request, &scene, &error) != ZRASTER_OK)
        fail_msg("%s: %s", by, zraster_error_text(error));
    array_parts_spoil(parts);
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

/* Draws by way number `first`, first + step, ... Returns the number of arrays. */
static size_t check(const char *text, const char *name, size_t first, size_t step)
{
    static struct array_parts parts;
    size_t count = 0;
    const struct answer wanted = draw(text, NULL, name);
    for (size_t i = first; i < ARRAY_WAYS; i += step) {
        char *scene = array_parts_of_scene(text, &array_ways[i], &parts);
        count += parts.count;
        assert_same(wanted, draw(scene, &parts, name), name, array_ways[i].name);
        array_parts_free(&parts);
        free(scene);
        scene = array_parts_of_scene(text, &array_ways[i], &parts);
        assert_same(wanted, draw_kept(scene, &parts, name), name, "a kept scene");
        array_parts_free(&parts);
        free(scene);
    }
    free(wanted.bytes);
    return count;
}

/* ---- scenes ---- */

struct counts {
    size_t files, arrays;
};

/* Two ways for each scene, all of them in turns. */
static void check_file(const char *path, void *context)
{
    struct counts *counts = context;
    char *text = file_read(path, &(size_t){0});
    assert_non_null(text);
    counts->arrays += check(text, path, counts->files++ % 3, 3);
    free(text);
}

TEST(all_scenes_are_drawn_alike)
{
    struct counts counts = {0, 0};
    assert_true(files_each("tests/scenes", ".json", check_file, &counts) > 30);
    assert_true(counts.arrays > 500);
}

/* Writes a number of a list of rows, with its brackets and commas. */
static void write_number(FILE *out, double number, unsigned i, unsigned rows, unsigned columns)
{
    const bool begins = columns > 1 && i % columns == 0, ends = columns > 1 && (i + 1) % columns == 0;
    fprintf(out, "%s%.9g%s%s", begins ? "[" : "", number, ends ? "]" : "", i + 1 == rows * columns ? "]" : ",");
}

static void write_rows(FILE *out, struct random *random, const char *key, unsigned rows, unsigned columns, double low,
                       double high)
{
    fprintf(out, ", \"%s\": [", key);
    for (unsigned i = 0; i < rows * columns; i++)
        write_number(out, low + (high - low) * random_range(random, 0, 1), i, rows, columns);
}

static void write_indices(FILE *out, struct random *random, const char *key, unsigned rows, unsigned columns,
                          unsigned positions)
{
    fprintf(out, ", \"%s\": [", key);
    for (unsigned i = 0; i < rows * columns; i++)
        write_number(out, random_below(random, positions), i, rows, columns);
}

/* Returns a scene of a random mesh; free it. */
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

TEST(random_meshes_are_drawn_alike)
{
    struct random random = random_seeded(38);
    for (unsigned i = 0; i < 12; i++) {
        char name[24], *text = random_scene(&random, i == 11 ? 30000 : 3 + random_below(&random, 300));
        snprintf(name, sizeof name, "random mesh %u", i);
        assert_true(check(text, name, 0, 1) > 2 * ARRAY_WAYS);
        free(text);
    }
}

/* The list is so long that threads read it ahead; each array ends that. */
TEST(polygons_may_mix_lists_and_arrays)
{
    enum { POLYGONS = 6000, EVERY = 100 };
    static struct array_parts parts;
    struct random random = random_seeded(3);
    char *lists = NULL, *arrays = NULL;
    size_t size;
    FILE *out[2] = {open_memstream(&lists, &size), open_memstream(&arrays, &size)};
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
        if (i % EVERY == EVERY / 2)
            array_parts_add(&parts, &array_ways[i / EVERY % ARRAY_WAYS], ZRASTER_F4, v, sizeof v, 3, 3);
    }
    for (int k = 0; k < 2; k++) {
        fprintf(out[k], "]}");
        fclose(out[k]);
    }
    const struct answer wanted = draw(lists, NULL, "polygons");
    assert_same(wanted, draw_kept(arrays, &parts, "polygons"), "polygons", "arrays among them");
    free(wanted.bytes);
    array_parts_free(&parts);
    free(lists);
    free(arrays);
}

#define QUAD "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], \"faces\": [[0,1,2,3]]"

TEST(bytes_are_colors_from_0_to_255)
{
    static const unsigned char rgba[16] = {255, 0, 17, 255, 1, 2, 3, 254, 127, 128, 129, 128, 0, 255, 200, 255};
    static struct array_parts parts;
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
        for (size_t i = 0; i < ARRAY_WAYS; i++) {
            parts.count = 0;
            array_parts_add(&parts, &array_ways[i], ZRASTER_U1, bytes, 4 * columns, 4, columns);
            assert_same(wanted, draw("{\"meshes\": [{" QUAD ", \"colors\": {\"asset\": \"p0\"}}]}", &parts, "u1"), "u1",
                        array_ways[i].name);
            array_parts_free(&parts);
        }
        free(wanted.bytes);
    }
}

/* One part serves two meshes that leave out different positions: the scene moves them in copies. */
TEST(meshes_share_a_part)
{
    static const float p[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9, 8, 9, 9, 9, 8, 9};
    static struct array_parts parts;
    const struct answer wanted =
        draw("{\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,1,0],[9,9,9],[8,9,9],[9,8,9]], \"faces\": [[0,1,2]]}, "
             "{\"positions\": [[0,0,0],[1,0,0],[0,1,0],[9,9,9],[8,9,9],[9,8,9]], \"faces\": [[3,4,5]]}]}",
             NULL, "lists");
    for (size_t i = 0; i < ARRAY_WAYS; i++) {
        parts.count = 0;
        array_parts_add(&parts, &array_ways[i], ZRASTER_F4, p, sizeof p, 6, 3);
        assert_same(wanted,
                    draw_kept("{\"meshes\": [{\"positions\": {\"asset\": \"p0\"}, \"faces\": [[0,1,2]]}, "
                              "{\"positions\": {\"asset\": \"p0\"}, \"faces\": [[3,4,5]]}]}",
                              &parts, "shared"),
                    "a shared part", array_ways[i].name);
        if (array_ways[i].flags & ZRASTER_LEND && !array_ways[i].is_npy)
            assert_memory_equal(parts.memory[0].bytes, p, sizeof p);
        array_parts_free(&parts);
    }
    free(wanted.bytes);
}

TEST(a_pose_may_be_an_array)
{
    static const double m[16] = {0, -1, 0, 2, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const char scene[] = "{\"meshes\": [{" QUAD "}], \"nodes\": [{\"name\": \"n\", \"mesh\": 0}]}";
    const struct zraster_part pose = {.name = "m", .array = {m, ZRASTER_F8, 2, {4, 4}}};
    struct zraster_request request = request_of(scene), change = request_of("{\"poses\": {\"n\": {\"asset\": \"m\"}}}");
    zraster_scene *kept;
    zraster_picture *picture;
    zraster_error *error;
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

RUN_TESTS(open_renderer, close_renderer)
