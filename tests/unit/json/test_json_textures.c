/* Textures of materials, and what meshes need for them. */
#include "support/tests.h"
#include "unit/common/json_check.h"

/* Red, green; blue, white. */
#define IMAGE                                                                                                          \
    "\"uri\": \"data:image/png;base64,"                                                                                \
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC\""
#define TEXCOORDS "\"texcoords\": [[0,0],[1,0.5],[0,-2],[1,1]]"
#define FACES     POSITIONS ", \"faces\": [[0,1,2]]"

static const char *scene_with(const char *texture, const char *mesh)
{
    static char text[8192];
    snprintf(
        text, sizeof text,
        "{\"materials\": [{\"name\": \"a\", \"baseColorTexture\": {%s}}], \"meshes\": [{\"material\": \"a\", %s}]}",
        texture, mesh);
    return text;
}

TEST(texture_is_read_with_glTFs_defaults)
{
    struct reading *reading = read_scene(scene_with(IMAGE, FACES ", " TEXCOORDS));
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->image_count, 1);
    assert_int_equal(scene->texture_count, 1);
    const struct zr_texture *texture = &scene->textures[0];
    assert_int_equal(texture->wrap_s, ZR_WRAP_REPEAT);
    assert_int_equal(texture->magnify, ZR_FILTER_LINEAR);
    assert_int_equal(texture->minify, ZR_FILTER_LINEAR_MIPMAP_LINEAR);
    static const float identity[2][3] = {{1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < 6; i++)
        assert_true(texture->rows[i / 3][i % 3] == identity[i / 3][i % 3]);
    assert_int_equal(scene->materials[scene->meshes[0].material].textures[ZR_TEXTURE_BASE_COLOR], 1);
    const zr_vec4 second = scene->meshes[0].texcoords[2];
    assert_true(second.x == 0 && second.y == -2 && second.z == 0 && second.w == 0);
    reading_free(reading);
}

TEST(words_and_numbers_of_samplers_mean_the_same)
{
    static const char *const samplers[] = {
        "\"sampler\": {\"magFilter\": \"nearest\", \"minFilter\": \"nearestMipmapLinear\", \"wrapS\": \"mirror\", "
        "\"wrapT\": \"clamp\"}",
        "\"sampler\": {\"magFilter\": 9728, \"minFilter\": 9986, \"wrapS\": 33648, \"wrapT\": 33071}"};
    for (int i = 0; i < 2; i++) {
        char texture[1024];
        snprintf(texture, sizeof texture, "%s, %s", IMAGE, samplers[i]);
        struct reading *reading = read_scene(scene_with(texture, FACES ", " TEXCOORDS));
        const struct zr_texture *read = &reading->scene->textures[0];
        assert_int_equal(read->magnify, ZR_FILTER_NEAREST);
        assert_int_equal(read->minify, ZR_FILTER_NEAREST_MIPMAP_LINEAR);
        assert_int_equal(read->wrap_s, ZR_WRAP_MIRROR);
        assert_int_equal(read->wrap_t, ZR_WRAP_CLAMP);
        reading_free(reading);
    }
}

/* The example of KHR_texture_transform: the lower left quarter, turned clockwise by 90 degrees. */
TEST(transform_scales_then_turns_then_moves)
{
    struct reading *reading = read_scene(scene_with(
        IMAGE ", \"offset\": [0, 1], \"rotation\": 1.57079632679, \"scale\": [0.5, 0.5]", FACES ", " TEXCOORDS));
    float corner[2], other[2];
    zr_texture_transform(&reading->scene->textures[0], 0, 0, corner);
    zr_texture_transform(&reading->scene->textures[0], 1, 1, other);
    assert_float_equal(corner[0], 0, 1e-6);
    assert_float_equal(corner[1], 1, 1e-6);
    assert_float_equal(other[0], 0.5, 1e-6);
    assert_float_equal(other[1], 0.5, 1e-6);
    reading_free(reading);
}

TEST(equal_textures_are_one)
{
    struct reading *reading = read_scene(
        "{\"materials\": [{\"name\": \"a\", \"baseColorTexture\": {" IMAGE "}}, {\"name\": \"b\", \"shininess\": 2, "
        "\"baseColorTexture\": {" IMAGE "}}, {\"name\": \"c\", \"baseColorTexture\": {" IMAGE ", \"texcoord\": 1}}], "
        "\"meshes\": [{\"material\": \"a\", " FACES ", " TEXCOORDS "}, {\"material\": \"b\", " FACES ", " TEXCOORDS
        "}, {\"material\": \"c\", " FACES ", \"texcoords1\": [[1,2],[3,4],[5,6],[7,8]]}]}");
    assert_int_equal(reading->scene->image_count, 1);
    assert_int_equal(reading->scene->texture_count, 2);
    const zr_vec4 last = reading->scene->meshes[2].texcoords[3];
    assert_true(last.x == 0 && last.y == 0 && last.z == 7 && last.w == 8);
    reading_free(reading);
}

TEST(heights_have_the_image_over_all_of_them)
{
    struct reading *reading = read_scene(scene_with(IMAGE, "\"heights\": [[0,0,0],[0,0,0],[0,0,null]]"));
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->position_count, 8);
    assert_true(mesh->texcoords[0].x == 0 && mesh->texcoords[0].y == 1);
    assert_true(mesh->texcoords[5].x == 1 && mesh->texcoords[5].y == 0.5f);
    assert_true(mesh->texcoords[7].x == 0.5f && mesh->texcoords[7].y == 0);
    reading_free(reading);
}

/* One by one, and among many that are read at once. */
TEST(tangents_have_a_sign)
{
    static const struct {
        const char *sign, *detail; /* NULL: it is good */
    } cases[] = {{"1", NULL},
                 {"-1", NULL},
                 {"1.0", NULL},
                 {"0", "0; 1 and -1 are allowed"},
                 {"0.5", "0.5; 1 and -1 are allowed"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "{\"meshes\": [{" FACES ", \"tangents\": [[1,0,0,1],[1,0,0,-1],[1,0,0,%s],[1,0,0,1]]}]}",
                 cases[i].sign);
        if (cases[i].detail)
            refuses_scene(text, "/meshes/0/tangents/2/3", cases[i].detail);
        else
            reading_free(read_scene(text));
    }
}

TEST(meshes_lack_nothing_that_their_textures_need)
{
    struct reading *lines = read_scene(scene_with(IMAGE, POSITIONS ", \"lines\": [[0,1]]"));
    reading_free(lines);
}

RUN_TESTS(NULL, NULL)
