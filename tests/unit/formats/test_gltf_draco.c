/* Tests primitives of glTF that are compressed by KHR_draco_mesh_compression. */
#include "support/tests.h"
#include "unit/common/input_check.h"

/* Part "d": two triangles of a square as a Draco mesh whose numbers are not coded. Attribute 7: positions; 1: colours;
 * 4: 16-bit integers. */
static const struct __attribute__((packed)) {
    unsigned char head[21], descriptions[19];
    float positions[4][3];
    uint8_t colors[4][4];
    uint16_t pairs[4][2];
} square = {{'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 2, 4, 1, 0, 1, 2, 0, 2, 3, 1},
            {3, 0, 9, 3, 0, 7, 2, 2, 4, 1, 1, 3, 4, 2, 0, 4, 0, 0, 0},
            {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
            {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {0, 0, 0, 255}},
            {{0, 1}, {2, 3}, {4, 5}, {6, 300}}};

/* Part "b": other positions of the square, and indices. */
static const struct {
    float corners[4][3];
    uint16_t corner[6];
} numbers = {{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}}, {3, 2, 1, 3, 1, 0}};

static struct zr_asset parts[] = {{.name = "d", .bytes = &square, .size = sizeof square},
                                  {.name = "b", .bytes = &numbers, .size = sizeof numbers}};

enum { D = 1, B = 2 };

#define HEAD                                                                                                           \
    "\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":60,\"uri\":\"b\"},{\"byteLength\":120,\"uri\":"      \
    "\"d\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12},"    \
    "{\"buffer\":1,\"byteLength\":120}],\"nodes\":[{\"mesh\":0}],\"extensionsUsed\":[\"KHR_draco_mesh_compression\"]"
#define REQUIRED "\"extensionsRequired\":[" NAME "]"
#define POSITION "{\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}"
#define INDEX    "{\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}"
#define COLOR    "{\"componentType\":5121,\"count\":4,\"type\":\"VEC4\",\"normalized\":true}"
#define PAIRS    "{\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"}"
#define MOVED    "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}"
#define INDEXED  "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}"
#define FILE_OF(rest)                                                                                                  \
    "{" HEAD ",\"accessors\":[" POSITION "," INDEX "," COLOR "," PAIRS "," MOVED "," INDEXED "]," rest "}"
#define NAME                                "\"KHR_draco_mesh_compression\""
#define DRACO(ids)                          "\"extensions\":{" NAME ":{\"bufferView\":2,\"attributes\":{" ids "}}}"
#define PRIMITIVE(attributes, indices, ids) "{\"attributes\":{" attributes "},\"indices\":" indices "," DRACO(ids)
#define MESH(primitives)                    "\"meshes\":[{\"primitives\":[" primitives "]}]"
#define SQUARE                              PRIMITIVE("\"POSITION\":0", "1", "\"POSITION\":7")

/* given: the parts of the request, a sum of D and B. */
static struct reading *read_parts(struct zr_request request, int given, const char *text)
{
    request.format = ZR_FORMAT_GLTF;
    request.assets = given & D ? parts : parts + 1;
    request.asset_count = given == D + B ? 2 : 1;
    return read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 28);
}

/* Reads a file that must cause no warning. */
static struct reading *read_file(int given, const char *text)
{
    struct reading *reading = read_parts((struct zr_request){.strict = "1"}, given, text);
    assert_read(reading);
    assert_int_equal(reading->scene->warning_count, 0);
    return reading;
}

static void assert_corners(const struct zr_mesh *mesh, const uint32_t wanted[6])
{
    assert_int_equal(mesh->face_count, 2);
    assert_int_equal(mesh->position_count, 4);
    assert_memory_equal(mesh->indices, wanted, 6 * sizeof *wanted);
}

static void assert_position(const struct zr_mesh *mesh, uint32_t i, float x, float y, float z)
{
    const zr_vec4 p = mesh->positions[i];
    if (p.x != x || p.y != y || p.z != z) fail_msg("position %u: %g %g %g", i, (double)p.x, (double)p.y, (double)p.z);
}

static const uint32_t decoded[6] = {0, 1, 2, 0, 2, 3}, uncompressed[6] = {3, 2, 1, 3, 1, 0};

TEST(a_compressed_primitive_has_faces_and_attributes)
{
    struct reading *reading =
        read_file(D, FILE_OF(REQUIRED "," MESH(PRIMITIVE("\"POSITION\":0,\"COLOR_0\":2,\"TEXCOORD_0\":3", "1",
                                                         "\"POSITION\":7,\"COLOR_0\":1,\"TEXCOORD_0\":4") "}")));
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_corners(mesh, decoded);
    assert_position(mesh, 2, 1, 1, 0);
    assert_true(mesh->colors[1].y == 1.0f && mesh->colors[3].x == 0.0f);
    assert_true(mesh->texcoords[2].x == 4.0f && mesh->texcoords[3].y == 300.0f);
    reading_free(reading);
}

TEST(primitives_share_a_view)
{
    struct reading *reading = read_file(D, FILE_OF(REQUIRED "," MESH(SQUARE "}," SQUARE ",\"mode\":5}")));
    const struct zr_mesh *meshes = reading->scene->meshes;
    assert_int_equal(reading->scene->mesh_count, 2);
    for (int i = 0; i < 2; i++)
        assert_corners(&meshes[i], decoded);
    assert_ptr_not_equal(meshes[0].indices, meshes[1].indices);
    reading_free(reading);
}

TEST(targets_move_compressed_vertices)
{
    struct reading *reading = read_file(D + B, FILE_OF(REQUIRED ",\"meshes\":[{\"weights\":[2],\"primitives\":[" SQUARE
                                                                ",\"targets\":[{\"POSITION\":4}]}]}]"));
    assert_position(&reading->scene->meshes[0], 2, 3, 3, 10);
    reading_free(reading);
}

TEST(attributes_that_are_not_compressed_are_read)
{
    struct reading *reading = read_file(
        D + B, FILE_OF(REQUIRED "," MESH(PRIMITIVE("\"POSITION\":4,\"COLOR_0\":2", "1", "\"COLOR_0\":1") "}")));
    assert_corners(&reading->scene->meshes[0], decoded);
    assert_position(&reading->scene->meshes[0], 2, 1, 1, 5);
    assert_true(reading->scene->meshes[0].colors[1].y == 1.0f);
    reading_free(reading);
}

TEST(attributes_in_one_list_only_cause_a_warning)
{
    static const struct {
        const char *text, *warning;
    } cases[] = {{FILE_OF(REQUIRED "," MESH(PRIMITIVE("\"POSITION\":0,\"TEXCOORD_0\":3", "1", "\"POSITION\":7") "}")),
                  "/meshes/0/primitives/0/attributes/TEXCOORD_0: neither compressed nor in a bufferView: it is 0"},
                 {FILE_OF(REQUIRED "," MESH(PRIMITIVE("\"POSITION\":0", "1", "\"POSITION\":7,\"COLOR_0\":1") "}")),
                  "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/COLOR_0: compressed, but no "
                  "attribute of its primitive, and not drawn"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_parts((struct zr_request){0}, D, cases[i].text);
        assert_read(reading);
        assert_int_equal(reading->scene->warning_count, 1);
        assert_string_equal(reading->scene->warnings[0], cases[i].warning);
        reading_free(reading);
    }
}

#define WITH_BOTH MESH(PRIMITIVE("\"POSITION\":4", "5", "\"POSITION\":7") "}")

TEST(compressed_data_are_drawn_instead_of_others)
{
    struct reading *reading = read_file(D + B, FILE_OF(WITH_BOTH));
    assert_corners(&reading->scene->meshes[0], decoded);
    assert_position(&reading->scene->meshes[0], 2, 1, 1, 0);
    reading_free(reading);
}

TEST(without_compressed_data_others_are_drawn)
{
    struct reading *reading = read_file(B, FILE_OF(WITH_BOTH));
    assert_corners(&reading->scene->meshes[0], uncompressed);
    assert_position(&reading->scene->meshes[0], 2, 1, 1, 5);
    reading_free(reading);
    reading = read_parts((struct zr_request){0}, B, FILE_OF(REQUIRED "," WITH_BOTH));
    assert_complaint(reading, ZR_BAD_SCENE, "/buffers/1/uri", "no part of the request has the name 'd'");
    reading_free(reading);
}

TEST(an_accessor_is_decoded_for_its_primitive_only)
{
    struct reading *reading = read_file(
        D + B, FILE_OF(MESH(PRIMITIVE("\"POSITION\":4", "5", "\"POSITION\":7") "},{\"attributes\":{\"POSITION\":4},"
                                                                               "\"indices\":5}")));
    assert_position(&reading->scene->meshes[0], 2, 1, 1, 0);
    assert_position(&reading->scene->meshes[1], 2, 1, 1, 5);
    assert_corners(&reading->scene->meshes[1], uncompressed);
    reading_free(reading);
}

TEST(a_file_that_needs_more_memory_says_so)
{
    static const char text[] = FILE_OF(REQUIRED "," MESH(SQUARE "}"));
    const struct zr_request request = {.format = ZR_FORMAT_GLTF, .assets = parts, .asset_count = 2};
    assert_true(smallest_ceiling(request, text, sizeof text - 1, 1 << 17) > 512);
}

RUN_TESTS(NULL, NULL)
