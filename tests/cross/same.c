/* zraster-same: hashes the answers of one daemon, for same.sh to compare two of them.
 *
 * A line for each answer: "ISA <tab> SCENE, WHAT, ALGORITHM <tab> STATUS HASH"; a refusal has no hash, since its words
 * may change. Scenes: each file of tests/scenes and clients/examples, once a channel and its encoding, a few channels
 * by the other algorithms, the picture in each look; each model of a folder in each look; random scenes. */
#include <dirent.h>
#include <fnmatch.h>
#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "scene/channels.h"
#include "scene/looks.h"
#include "server/support/client.h"
#include "support/cmocka_all.h"
#include "support/files.h"
#include "support/geometries.h"
#include "support/random_scenes.h"

enum { NAME_SIZE = 200, LOOK_SIDE = 100, TRACE_SIDE = 48 };

static struct options {
    const char *models, *isas, *only;
    long random_scenes;
    bool algorithms, warnings;
} options = {.models = "", .isas = "", .only = "*", .random_scenes = 3000, .algorithms = true};

static struct daemon daemon;
static enum zr_isa isa;
static size_t failures;

static uint64_t hash_more(uint64_t hash, const char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ (uint8_t)bytes[i]) * 0x100000001b3u;
    return hash;
}

static bool is_wanted(const char *scene)
{
    return fnmatch(options.only, scene, 0) == 0;
}

/* Sends a body and prints the line of its answer. */
static void ask(const char *name, const char *target, const char *type, const char *body, size_t size)
{
    struct reply reply = client_send(&daemon, "POST", target, (const char *const[]){type, "Expect:", NULL}, body, size);
    printf("%s\t%s\t%ld", zr_isa_name(isa), name, reply.status);
    if (reply.status == 200) {
        uint64_t hash = hash_more(0xcbf29ce484222325u, reply.body, reply.size);
        static const char *const headers[] = {"Zraster-Look", "Content-Type", "Content-Disposition"};
        for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
            const char *value = reply_header(&reply, headers[i]);
            hash = hash_more(hash, value, strlen(value) + 1);
        }
        printf(" %016" PRIx64, hash);
    }
    if (options.warnings) printf(" %s", reply_header(&reply, "Zraster-Warnings"));
    putchar('\n');
    if (reply.status < 200 || reply.status >= 500) {
        fprintf(stderr, "zraster-same: %s: status %ld\n", name, reply.status);
        failures++;
    }
    reply_free(&reply);
}

/* ---- scenes of files: the keys that change are written in front of all others ---- */

struct scene_file {
    char name[NAME_SIZE];
    char *look, *rest; /* the value of `look`, NULL if there is none; all but look, window, algorithm and outputs */
    int window[2];
};

static void ask_variant(const struct scene_file *file, const char *what, const char *output, const char *look,
                        const int window[2], const char *algorithm)
{
    char name[2 * NAME_SIZE];
    const size_t room = strlen(file->rest) + 4 * NAME_SIZE;
    char *body = malloc(room);
    assert_non_null(body);
    snprintf(name, sizeof name, "%s, %s, %s", file->name, what, algorithm);
    snprintf(body, room, "{\"outputs\":[{%s}],\"window\":{\"width\":%d,\"height\":%d},\"algorithm\":\"%s\"%s%s,%s",
             output, window[0], window[1], algorithm, look ? ",\"look\":" : "", look ? look : "", file->rest + 1);
    ask(name, "/v1/render", JSON_TYPE, body, strlen(body));
    free(body);
}

static void ask_channel(const struct scene_file *file, enum zr_channel channel, const char *algorithm)
{
    const struct zr_channel_row *row = &zr_channel_rows[channel];
    for (int e = 0; e < row->encoding_count; e++) {
        char what[NAME_SIZE], output[NAME_SIZE];
        snprintf(what, sizeof what, "%s %s", row->name, zr_encoding_rows[row->encodings[e]].word);
        snprintf(output, sizeof output, "\"channel\":\"%s\",\"encoding\":\"%s\"", row->name,
                 zr_encoding_rows[row->encodings[e]].word);
        if (channel == ZR_CHANNEL_POSITION && row->encodings[e] == ZR_ENCODING_PNG)
            snprintf(output, sizeof output, "\"channel\":\"position\",\"encoding\":\"png\",\"space\":\"nocs\"");
        if (channel == ZR_CHANNEL_FLOW)
            snprintf(output, sizeof output,
                     "\"channel\":\"flow\",\"encoding\":\"%s\",\"to\":{\"view\":{\"preset\":\"front\"}}",
                     zr_encoding_rows[row->encodings[e]].word);
        if (channel == ZR_CHANNEL_FRAGMENTS)
            snprintf(output, sizeof output, "\"channel\":\"%s\",\"x\":%d,\"y\":%d", row->name, file->window[0] / 2,
                     file->window[1] / 2);
        const int small[2] = {TRACE_SIDE, TRACE_SIDE};
        ask_variant(file, what, output, file->look, channel == ZR_CHANNEL_TRACE ? small : file->window, algorithm);
    }
}

/* In small windows: each pixel takes many samples. */
static void ask_looks(const struct scene_file *file)
{
    const int window[2] = {file->window[0] < LOOK_SIDE ? file->window[0] : LOOK_SIDE,
                           file->window[1] < LOOK_SIDE ? file->window[1] : LOOK_SIDE};
    for (int i = 0; i < zr_look_count; i++) {
        const struct zr_look_pin pin = zr_look_pin_of(&zr_looks[i]);
        char look[NAME_SIZE];
        snprintf(look, sizeof look, "\"%s\"", pin.text);
        ask_variant(file, pin.text, "\"channel\":\"color\"", look, window, algorithm_words[ZR_ALGORITHM_HALFSPACE]);
    }
}

static void ask_algorithms(const struct scene_file *file)
{
    static const enum zr_channel some[] = {ZR_CHANNEL_COLOR, ZR_CHANNEL_DEPTH, ZR_CHANNEL_NORMALS, ZR_CHANNEL_INFO,
                                           ZR_CHANNEL_TRACE};
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++)
        for (size_t c = 0; a != ZR_ALGORITHM_HALFSPACE && c < sizeof some / sizeof *some; c++)
            ask_channel(file, some[c], algorithm_words[a]);
}

static void ask_scene_file(const char *path, const char *name)
{
    struct scene_file file = {.look = NULL};
    snprintf(file.name, sizeof file.name, "%.*s", (int)strlen(name) - 5, name);
    if (!is_wanted(file.name)) return;
    char *text = file_read(path, &(size_t){0});
    cJSON *scene = cJSON_Parse(text);
    if (!scene) fail_msg("%s: not JSON", path);
    cJSON *look = cJSON_DetachItemFromObject(scene, "look");
    if (look) file.look = cJSON_PrintUnformatted(look);
    static const char *const replaced[] = {"outputs", "window", "algorithm"};
    const cJSON *window = cJSON_GetObjectItem(scene, "window");
    file.window[0] = (int)cJSON_GetNumberValue(cJSON_GetObjectItem(window, "width"));
    file.window[1] = (int)cJSON_GetNumberValue(cJSON_GetObjectItem(window, "height"));
    for (size_t i = 0; i < sizeof replaced / sizeof *replaced; i++)
        cJSON_DeleteItemFromObject(scene, replaced[i]);
    file.rest = cJSON_PrintUnformatted(scene);
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        ask_channel(&file, (enum zr_channel)c, algorithm_words[ZR_ALGORITHM_HALFSPACE]);
    ask_looks(&file);
    if (options.algorithms && isa == zr_isa_best()) ask_algorithms(&file);
    cJSON_free(file.look);
    cJSON_free(file.rest);
    cJSON_Delete(look);
    cJSON_Delete(scene);
    free(text);
}

/* ---- models, by query ---- */

static void ask_model(const char *path, const char *name)
{
    size_t size;
    if (!is_wanted(name)) return;
    char *text = file_read(path, &size);
    if (!text) fail_msg("%s: cannot be read", path);
    for (int i = 0; i < zr_look_count; i++) {
        const struct zr_look_pin pin = zr_look_pin_of(&zr_looks[i]);
        char target[NAME_SIZE], label[2 * NAME_SIZE];
        snprintf(target, sizeof target, "/v1/render?look=%s&preset=isometric&width=200&height=150", pin.text);
        snprintf(label, sizeof label, "%s, %s, by query", name, pin.text);
        ask(label, target, "Content-Type: model/obj", text, size);
    }
    free(text);
}

/* Every file of a folder whose name ends so; returns how many. */
static int ask_folder(const char *folder, const char *ending, void (*ask_file)(const char *path, const char *name))
{
    struct dirent **entries;
    int asked = 0;
    const int count = scandir(folder, &entries, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        char path[2 * NAME_SIZE + 256];
        const char *name = entries[i]->d_name, *dot = strrchr(name, '.');
        snprintf(path, sizeof path, "%s/%s", folder, name);
        if (dot && strcmp(dot, ending) == 0) {
            ask_file(path, name);
            asked++;
        }
        free(entries[i]);
    }
    if (count >= 0) free(entries);
    return asked;
}

static void ask_all(void **state)
{
    (void)state;
    daemon = daemon_start(LIST("--isa", zr_isa_name(isa), "--threads", "2", "--workers", "1"));
    assert_true(ask_folder("tests/scenes", ".json", ask_scene_file) > 100);
    assert_true(ask_folder("clients/examples", ".json", ask_scene_file) > 0);
    if (*options.models && ask_folder(options.models, ".obj", ask_model) == 0)
        fprintf(stderr, "LEFT OUT: models: %s has none\n", options.models);
    for (long i = 0; i < options.random_scenes; i++) {
        char name[NAME_SIZE];
        snprintf(name, sizeof name, "random %ld, its outputs, its own", i);
        const char *scene = random_scene((uint64_t)i);
        if (is_wanted("random")) ask(name, "/v1/render", JSON_TYPE, scene, strlen(scene));
    }
    daemon_stop(&daemon);
    assert_int_equal(failures, 0);
}

static bool read_options(int argc, char **argv)
{
    static const struct option known[] = {{"models", 1, NULL, 'm'}, {"isas", 1, NULL, 'i'},  {"only", 1, NULL, 'o'},
                                          {"random", 1, NULL, 'r'}, {"quick", 0, NULL, 'q'}, {"warnings", 0, NULL, 'w'},
                                          {NULL, 0, NULL, 0}};
    for (int c; (c = getopt_long(argc, argv, "", known, NULL)) != -1;)
        switch (c) {
        case 'm':
            options.models = optarg;
            break;
        case 'i':
            options.isas = optarg;
            break;
        case 'o':
            options.only = optarg;
            break;
        case 'r':
            options.random_scenes = atol(optarg);
            break;
        case 'w':
            options.warnings = true;
            break;
        case 'q':
            options.random_scenes = 300;
            options.isas = zr_isa_name(zr_isa_best());
            options.algorithms = false;
            break;
        default:
            return false;
        }
    return optind == argc;
}

int main(int argc, char **argv)
{
    if (!read_options(argc, argv)) {
        fputs("usage: zraster-same [--quick] [--isas \"sse2 avx2\"] [--random N] [--models DIR] [--only GLOB]"
              " [--warnings]; ZRASTERD names the daemon\n",
              stderr);
        return 2;
    }
    /* Whatever is refused for its cost depends on the machine: nothing is. */
    setenv("ZRASTER_COST_MAX_MS", "86400000", 1);
    setenv("ZRASTER_RENDER_TIMEOUT_MS", "86400000", 1);
    const struct CMUnitTest tests[] = {cmocka_unit_test(ask_all)};
    bool ok = true;
    for (int i = 0; ok && i < ZR_ISA_COUNT; i++) {
        isa = (enum zr_isa)i;
        if (zr_isa_is_available(isa) && (!*options.isas || strstr(options.isas, zr_isa_name(isa))))
            ok = cmocka_run_group_tests_name(zr_isa_name(isa), tests, clients_setup, clients_teardown) == 0;
    }
    return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
