/* Images that several threads decode before their materials are read: in scenes of JSON, glTF, OBJ and 3MF. */
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "render_request.h"
#include "scene/image.h"
#include "scene/scene.h"
#include "support/input/base64.h"
#include "support/input/zip_file.h"
#include "support/pictures/striped_images.h"
#include "support/test_arena.h"
#include "support/tests.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

TEST_ARENA((size_t)1 << 28)

enum { FILES = 4, THREADS = 3, CUT = 20, ALL = (1 << FILES) - 1 };

static uint8_t *files[FILES];
static size_t sizes[FILES];

static int make_files(void **state)
{
    if (!striped_files_make(FILES, files, sizes)) return -1;
    return open_arena(state);
}

static int free_files(void **state)
{
    for (int i = 0; i < FILES; i++)
        free(files[i]);
    return close_arena(state);
}

/* ---- bodies with one material per image ---- */

/* A request. `broken`: one bit per image, 1 if the image is cut off. */
struct body {
    unsigned broken;
    char *bytes;
    size_t size, asset_count;
    struct zr_asset assets[FILES + 1];
};

static size_t size_of(const struct body *body, int number)
{
    return sizes[number] - (body->broken >> number & 1) * CUT;
}

static void put_uri(const struct body *body, FILE *out, int number)
{
    char *uri = base64_of("data:image/png;base64,", files[number], size_of(body, number));
    fprintf(out, "{\"uri\":\"%s\"}", uri);
    free(uri);
}

static void put_assets(struct body *body)
{
    static const char *const names[FILES] = {"0.png", "1.png", "2.png", "3.png"};
    for (int i = 0; i < FILES; i++)
        body->assets[body->asset_count++] =
            (struct zr_asset){.name = names[i], .bytes = files[i], .size = size_of(body, i)};
}

static void put_json(struct body *body, FILE *out)
{
    fputs("{\"materials\":[", out);
    for (int i = 0; i < FILES; i++) {
        fprintf(out, "%s{\"name\":\"%d\",\"baseColorTexture\":", i ? "," : "", i);
        put_uri(body, out, i);
        fputs("}", out);
    }
    fputs("],\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}", out);
}

/* Material 0 uses images 3 and 0, material 1 uses images 1 and 2, one of them twice. No face has material 2. */
static void put_gltf_with(struct body *body, FILE *out, bool in_parts)
{
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    char *buffer = base64_of("data:application/octet-stream;base64,", corners, sizeof corners);
    fprintf(out,
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
            "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0,\"odd\":1},{\"attributes\":{\"POSITION\":"
            "0},\"material\":1}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":"
            "\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":"
            "\"%s\"}],\"materials\":[{\"normalTexture\":{\"index\":0,\"odd\":1},\"pbrMetallicRoughness\":{"
            "\"baseColorTexture\":{\"index\":3},\"metallicFactor\":2}},{\"normalTexture\":{\"index\":2},"
            "\"occlusionTexture\":{\"index\":2},\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}},{"
            "\"occlusionTexture\":{\"index\":4}}],\"textures\":[{\"source\":0},{\"source\":1},{\"source\":2},{"
            "\"source\":3},{\"source\":4}],\"images\":[",
            buffer);
    for (int i = 0; i < FILES; i++) {
        if (in_parts)
            fprintf(out, "{\"uri\":\"%d.png\"}", i);
        else
            put_uri(body, out, i);
        fputs(",", out);
    }
    fputs("{\"uri\":\"missing.png\"}]}", out);
    if (in_parts) put_assets(body);
    free(buffer);
}

static void put_gltf(struct body *body, FILE *out)
{
    put_gltf_with(body, out, false);
}

static void put_gltf_of_parts(struct body *body, FILE *out)
{
    put_gltf_with(body, out, true);
}

/* `c` is used before `a`; no face uses `b`. */
static void put_obj(struct body *body, FILE *out)
{
    static const char mtl[] = "newmtl a\nKd 2 1 1\nmap_Kd 0.png\nmap_Ke missing.png\nnewmtl b\nmap_Kd unused.png\n"
                              "newmtl c\nodd\nmap_Kd 1.png\nnorm 2.png\nmap_Bump unused.png\nmap_Ke 3.png\n";
    fputs("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl c\nf 1/1 2/1 3/1\nusemtl a\nf 3/1 2/1 1/1\n", out);
    put_assets(body);
    body->assets[body->asset_count++] = (struct zr_asset){.name = "m.mtl", .bytes = mtl, .size = sizeof mtl - 1};
}

static void put_3mf(struct body *body, FILE *out)
{
    static const char *const names[FILES] = {"3D/0.png", "3D/1.png", "3D/2.png", "3D/3.png"};
    struct zip_entry parts[FILES + 1];
    char *model = NULL;
    size_t size, packed;
    FILE *text = open_memstream(&model, &size);
    fputs("<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
          "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\"><resources>",
          text);
    for (int i = 0; i < FILES; i++)
        fprintf(text,
                "<m:texture2d id=\"%d\" path=\"/3D/%d.png\"/><m:texture2dgroup id=\"%d\" texid=\"%d\"><m:tex2coord "
                "u=\"0\" v=\"0\"/></m:texture2dgroup>",
                1 + i, i, 11 + i, 1 + i);
    fputs("<object id=\"30\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex "
          "x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>",
          text);
    for (int i = FILES; i-- > 0;)
        fprintf(text, "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"%d\" p1=\"0\"/>", 11 + i);
    fputs("</triangles></mesh></object></resources><build><item objectid=\"30\"/></build></model>", text);
    fclose(text);
    parts[0] = (struct zip_entry){"3D/3dmodel.model", model, size, true};
    for (int i = 0; i < FILES; i++)
        parts[1 + i] = (struct zip_entry){names[i], (const char *)files[i], size_of(body, i), false};
    unsigned char *file = zip_3mf(parts, FILES + 1, &packed);
    fwrite(file, 1, packed, out);
    free(file);
    free(model);
}

static const struct kind {
    const char *name;
    enum zr_format format;
    void (*put)(struct body *body, FILE *out);
    bool is_lenient; /* a broken image causes a warning */
} kinds[] = {{"JSON", ZR_FORMAT_JSON, put_json, false},
             {"glTF", ZR_FORMAT_GLTF, put_gltf, false},
             {"glTF and its images", ZR_FORMAT_GLTF, put_gltf_of_parts, false},
             {"OBJ", ZR_FORMAT_OBJ, put_obj, true},
             {"3MF", ZR_FORMAT_3MF, put_3mf, false}};
enum { KINDS = sizeof kinds / sizeof *kinds };

static struct body body_of(const struct kind *kind, unsigned broken)
{
    struct body body = {.broken = broken};
    FILE *out = open_memstream(&body.bytes, &body.size);
    kind->put(&body, out);
    fclose(out);
    return body;
}

/* ---- tests ---- */

struct outcome {
    enum zr_status status;
    size_t used, peak;
    char text[8192]; /* faults, or warnings and the values of texels */
};

/* Returns a hash of the texels in their order. */
static uint32_t sum_of(const struct zr_image *image)
{
    uint32_t sum = 0;
    for (size_t k = 0; k < zr_image_bytes(image); k++)
        sum = sum * 31 + ((const uint8_t *)image->texels)[k];
    return sum;
}

static void describe(const struct zr_scene *scene, const struct zr_error *error, FILE *out)
{
    for (size_t i = 0; i < zr_error_held(error); i++)
        fprintf(out, "%s: %s\n", error->items[i].pointer, error->items[i].detail);
    for (uint32_t i = 0; scene && i < scene->warning_count; i++)
        fprintf(out, "%s\n", scene->warnings[i]);
    for (uint32_t i = 0; scene && i < scene->image_count; i++)
        fprintf(out, "image %u: %x\n", i, sum_of(&scene->images[i]));
    for (uint32_t i = 0; scene && i < scene->texture_count; i++)
        fprintf(out, "texture %u: image %u\n", i, scene->textures[i].image);
}

static struct outcome read_body(const struct kind *kind, const struct body *body, struct zr_team *team,
                                struct zr_kept_images images, const struct zr_cancel *cancel)
{
    const struct zr_request request = {.format = kind->format,
                                       .bytes = body->bytes,
                                       .size = body->size,
                                       .assets = body->assets,
                                       .asset_count = body->asset_count,
                                       .images = images,
                                       .cancel = cancel};
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene = NULL;
    struct zr_error error = {.count = 0};
    struct outcome outcome;
    zr_arena_reset(&arena, SIZE_MAX);
    outcome.status =
        zr_scene_read(&(struct zr_run){.arena = &arena, .team = team, .error = &error}, &request, &limits, &scene);
    outcome.used = arena.used;
    outcome.peak = arena.peak;
    FILE *out = fmemopen(outcome.text, sizeof outcome.text, "w");
    describe(outcome.status == ZR_OK ? scene : NULL, &error, out);
    fclose(out);
    return outcome;
}

static const struct zr_kept_images none = {NULL, NULL, NULL};

TEST(faults_and_warnings_equal_those_of_one_thread)
{
    struct zr_team *team = zr_team_create(THREADS);
    for (int k = 0; k < KINDS; k++)
        for (unsigned broken = 0; broken <= ALL; broken++) {
            struct body body = body_of(&kinds[k], broken);
            const struct outcome one = read_body(&kinds[k], &body, NULL, none, NULL),
                                 all = read_body(&kinds[k], &body, team, none, NULL);
            if ((one.status == ZR_OK) != (broken == 0 || kinds[k].is_lenient))
                fail_msg("%s, broken %x: status %d, %s", kinds[k].name, broken, one.status, one.text);
            assert_int_equal(all.status, one.status);
            assert_string_equal(all.text, one.text);
            assert_int_equal(all.used, one.used);
            assert_int_equal(all.peak, one.peak);
            free(body.bytes);
        }
    zr_team_destroy(team);
}

/* Counts the calls of a store that keeps nothing. */
struct store {
    int sought, sought_first, kept; /* sought_first: before the first image was offered */
};

static bool seek(void *context, const void *bytes, size_t size, struct zr_file_hash *hash, struct zr_kept_image *image)
{
    struct store *store = context;
    (void)bytes, (void)size, (void)hash, (void)image;
    store->sought++;
    store->sought_first += store->kept == 0;
    return false;
}

static void offer(void *context, const struct zr_file_hash *hash, const struct zr_kept_image *image)
{
    (void)hash, (void)image;
    ((struct store *)context)->kept++;
}

/* A reader that decodes images one by one offers each image before it asks for the next one. */
TEST(all_images_are_decoded_at_once)
{
    struct zr_team *team = zr_team_create(THREADS);
    for (int k = 0; k < KINDS; k++) {
        struct body body = body_of(&kinds[k], 0);
        struct store store = {0, 0, 0};
        const struct outcome outcome =
            read_body(&kinds[k], &body, team, (struct zr_kept_images){seek, offer, &store}, NULL);
        assert_int_equal(outcome.status, ZR_OK);
        if (store.sought != FILES || store.sought_first != FILES || store.kept != FILES)
            fail_msg("%s: sought %d, %d of them at first, kept %d", kinds[k].name, store.sought, store.sought_first,
                     store.kept);
        free(body.bytes);
    }
    zr_team_destroy(team);
}

TEST(decoding_of_several_images_is_cancelled)
{
    struct zr_team *team = zr_team_create(THREADS);
    const struct zr_cancel cancel = {.raised = true};
    for (int k = 0; k < KINDS; k++) {
        struct body body = body_of(&kinds[k], 0);
        assert_int_equal(read_body(&kinds[k], &body, team, none, &cancel).status, ZR_CANCELLED);
        free(body.bytes);
    }
    zr_team_destroy(team);
}

RUN_TESTS(make_files, free_files)
