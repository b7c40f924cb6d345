/* Tests the scenes of glTF files: numbers of accessors, nodes, materials and warnings. */
#include "scene/picture.h"
#include "support/tests.h"
#include "unit/common/input_check.h"
#include "unit/common/kept_check.h"

/* Bytes of the part "b": four corners of a square, indices, colours, and pairs of coordinates. */
static struct {
    float corners[4][3];  /* at 0 */
    uint16_t square[6];   /* at 48 */
    uint8_t colors[4][4]; /* at 60 */
    struct {
        float position[3];
        int16_t uv[2];
    } mixed[4];        /* at 76, 16 bytes each */
    uint32_t strip[5]; /* at 140 */
    uint8_t bytes[4];  /* at 160 */
    float moved[2][3]; /* at 164 */
} numbers = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
             {0, 1, 2, 0, 2, 3},
             {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {128, 128, 128, 51}},
             {{{0, 0, 5}, {0, 32767}}, {{1, 0, 5}, {32767, 0}}, {{1, 1, 5}, {0, 0}}, {{0, 1, 5}, {-32768, 0}}},
             {0, 1, 3, 3, 2},
             {1, 3, 0, 0},
             {{7, 8, 9}, {4, 5, 6}}};

#define ASSET   "\"asset\":{\"version\":\"2.0\"}"
#define BUFFERS "\"buffers\":[{\"byteLength\":188,\"uri\":\"b\"}]"
#define VIEWS                                                                                                          \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12},"            \
    "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":16},{\"buffer\":0,\"byteOffset\":76,\"byteLength\":64,"            \
    "\"byteStride\":16},{\"buffer\":0,\"byteOffset\":140,\"byteLength\":20},{\"buffer\":0,\"byteOffset\":160,"         \
    "\"byteLength\":4},{\"buffer\":0,\"byteOffset\":164,\"byteLength\":24}]"
#define SQUARE "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}"
#define INDEX  "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}"
#define COLOR  "{\"bufferView\":2,\"componentType\":5121,\"count\":4,\"type\":\"VEC4\",\"normalized\":true}"
#define MIXED  "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}"
#define UV                                                                                                             \
    "{\"bufferView\":3,\"byteOffset\":12,\"componentType\":5122,\"count\":4,\"type\":\"VEC2\",\"normalized\":true}"
#define STRIP "{\"bufferView\":4,\"componentType\":5125,\"count\":5,\"type\":\"SCALAR\"}"
#define BYTES "{\"bufferView\":5,\"componentType\":5121,\"count\":3,\"type\":\"SCALAR\"}"
#define SPARSE                                                                                                         \
    "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":2,\"indices\":"      \
    "{\"bufferView\":5,\"componentType\":5121},\"values\":{\"bufferView\":6}}}"
#define ZEROS                                                                                                          \
    "{\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":5,"     \
    "\"componentType\":5121},\"values\":{\"bufferView\":6}}}"
#define ACCESSORS                                                                                                      \
    "\"accessors\":[" SQUARE "," INDEX "," COLOR "," MIXED "," UV "," STRIP "," BYTES "," SPARSE "," ZEROS "]"
#define FILE_OF(rest) "{" ASSET "," BUFFERS "," VIEWS "," ACCESSORS "," rest "}"
#define NODE          "\"nodes\":[{\"mesh\":0}]"
#define MESH(rest)    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}" rest "}]}]"

static struct zr_asset parts[] = {{.name = "b", .bytes = &numbers, .size = sizeof numbers}};

static struct reading *read_over(struct zr_request request, const char *text)
{
    return read_with_part(ZR_FORMAT_GLTF, request, parts, text);
}

static struct reading *read_file(const char *text)
{
    struct reading *reading = read_over((struct zr_request){.channel = "color"}, text);
    assert_read(reading);
    return reading;
}

static void assert_position(const struct zr_mesh *mesh, uint32_t i, float x, float y, float z)
{
    const zr_vec4 p = mesh->positions[i];
    if (p.x != x || p.y != y || p.z != z || p.w != 1.0f)
        fail_msg("position %u is %g %g %g %g", i, (double)p.x, (double)p.y, (double)p.z, (double)p.w);
}

TEST(the_square_is_two_triangles)
{
    struct reading *reading = read_file(FILE_OF(
        NODE ",\"meshes\":[{\"name\":\"square\",\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]"));
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(reading->scene->mesh_count, 1);
    assert_int_equal(reading->scene->instance_count, 1);
    assert_int_equal(reading->scene->warning_count, 0);
    assert_string_equal(mesh->name, "square");
    assert_int_equal(mesh->face_count, 2);
    assert_int_equal(mesh->position_count, 4);
    for (uint32_t i = 0; i < 6; i++)
        assert_int_equal(mesh->indices[i], numbers.square[i]);
    assert_position(mesh, 2, 1, 1, 0);
    reading_free(reading);
}

TEST(a_binary_file_gives_the_same)
{
    static const char text[] =
        "{" ASSET ",\"buffers\":[{\"byteLength\":188}]," VIEWS "," ACCESSORS "," NODE "," MESH(",\"indices\":1") "}";
    enum { JSON_BYTES = (sizeof text - 1 + 3) / 4 * 4, SIZE = 12 + 8 + JSON_BYTES + 8 + 4 + 8 + sizeof numbers };
    unsigned char bytes[SIZE], *at = bytes;
    const uint32_t head[] = {0x46546C67, 2, SIZE, JSON_BYTES, 0x4E4F534A}, unknown[] = {4, 0x12345678, 0},
                   chunk[] = {sizeof numbers, 0x004E4942};
    at = mempcpy(at, head, sizeof head);
    memset(at, ' ', JSON_BYTES);
    memcpy(at, text, sizeof text - 1);
    at = mempcpy(at + JSON_BYTES, unknown, sizeof unknown);
    at = mempcpy(at, chunk, sizeof chunk);
    memcpy(at, &numbers, sizeof numbers);
    for (int known = 0; known < 2; known++) {
        struct reading *reading = read_bytes(known ? ZR_FORMAT_GLB : ZR_FORMAT_UNKNOWN, bytes, sizeof bytes);
        assert_read(reading);
        assert_int_equal(reading->scene->meshes[0].face_count, 2);
        assert_position(&reading->scene->meshes[0], 1, 1, 0, 0);
        reading_free(reading);
    }
}

TEST(every_mode_has_its_primitives)
{
    static const struct {
        const char *mesh;
        uint32_t points, lines, faces, last; /* the last corner */
    } cases[] = {{MESH(",\"mode\":0"), 4, 0, 0, 3},
                 {MESH(",\"mode\":1"), 0, 2, 0, 3},
                 {MESH(",\"mode\":2"), 0, 4, 0, 0},
                 {MESH(",\"mode\":3"), 0, 3, 0, 3},
                 {MESH(",\"mode\":4,\"indices\":1"), 0, 0, 2, 3},
                 {MESH(",\"mode\":5"), 0, 0, 2, 2},
                 {MESH(",\"mode\":6"), 0, 0, 2, 0},
                 {MESH(",\"mode\":5,\"indices\":5"), 0, 0, 1, 3}, /* two triangles with equal corners are left out */
                 {MESH(",\"mode\":6,\"indices\":5"), 0, 0, 2, 0},
                 {MESH(",\"mode\":3,\"indices\":5"), 0, 4, 0, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[4096];
        snprintf(text, sizeof text, "{" ASSET "," BUFFERS "," VIEWS "," ACCESSORS "," NODE ",%s}", cases[i].mesh);
        struct reading *reading = read_file(text);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_int_equal(mesh->point_count, cases[i].points);
        if (mesh->point_count) assert_true(mesh->point_size > 2.0f); /* by the density of the points */
        assert_int_equal(mesh->line_count, cases[i].lines);
        assert_int_equal(mesh->face_count, cases[i].faces);
        const uint32_t last = mesh->point_count  ? mesh->points[mesh->point_count - 1]
                              : mesh->line_count ? mesh->lines[2 * mesh->line_count - 1]
                                                 : mesh->indices[3 * mesh->face_count - 1];
        assert_int_equal(last, cases[i].last);
        reading_free(reading);
    }
}

TEST(accessors_are_strided_normalized_and_sparse)
{
    struct reading *reading = read_file(
        FILE_OF(NODE ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":3,\"TEXCOORD_1\":4,\"COLOR_0\":2},"
                     "\"indices\":1},{\"attributes\":{\"POSITION\":7},\"indices\":1},{\"attributes\":{\"POSITION\":8},"
                     "\"indices\":1},{\"attributes\":{\"POSITION\":0},\"indices\":6}]}]"));
    const struct zr_mesh *mixed = &reading->scene->meshes[0], *sparse = mixed + 1, *zeros = mixed + 2;
    assert_int_equal(reading->scene->mesh_count, 4);
    assert_int_equal(reading->scene->instance_count, 4);
    assert_position(mixed, 2, 1, 1, 5);
    assert_true(mixed->texcoords[1].z == 1.0f && mixed->texcoords[0].w == 1.0f && mixed->texcoords[3].z == -1.0f);
    assert_true(mixed->texcoords[1].x == 0.0f);
    assert_true(mixed->colors[0].x == 1.0f && mixed->colors[0].y == 0.0f);
    assert_true(mixed->colors[3].w == 51.0f / 255.0f);
    assert_true(mixed->colors[3].x > 0.735f && mixed->colors[3].x < 0.737f); /* 128 / 255 in linear light */
    assert_position(sparse, 0, 0, 0, 0);
    assert_position(sparse, 1, 7, 8, 9);
    assert_position(sparse, 2, 1, 1, 0);
    assert_position(sparse, 3, 4, 5, 6);
    assert_position(zeros, 2, 0, 0, 0);
    assert_position(zeros, 3, 4, 5, 6);
    assert_int_equal(reading->scene->meshes[3].indices[1], 3);
    reading_free(reading);
}

/* A mesh has two sets of texture coordinates: those that textures of its material name. */
TEST(materials_name_two_of_eight_sets_of_texture_coordinates)
{
    static const char *const textures[] = {
        "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"texCoord\":3}}",
        "\"normalTexture\":{\"index\":0,\"texCoord\":3},\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0}",
        "\"normalTexture\":{\"index\":0},\"occlusionTexture\":{\"index\":0,\"texCoord\":3}"};
    for (size_t i = 0; i < 3; i++) {
        char text[4096];
        snprintf(
            text, sizeof text,
            "%.*s,\"textures\":[{}],\"materials\":[{%s}],\"meshes\":[{\"primitives\":[{\"indices\":1,\"material\":0,"
            "\"attributes\":{\"POSITION\":3,\"TEXCOORD_3\":4}}]}]}",
            (int)sizeof FILE_OF(NODE) - 2, FILE_OF(NODE), textures[i]);
        struct reading *reading = read_file(text);
        const zr_vec4 *texcoords = reading->scene->meshes[0].texcoords;
        const bool is_second = i == 2;
        assert_true((is_second ? texcoords[1].z : texcoords[1].x) == 1.0f);
        assert_true((is_second ? texcoords[3].z : texcoords[3].x) == -1.0f);
        assert_true((is_second ? texcoords[1].x : texcoords[1].z) == 0.0f);
        reading_free(reading);
    }
}

TEST(only_the_vertices_of_a_primitive_are_kept)
{
    static const char text[] = "{" ASSET "," BUFFERS "," VIEWS ",\"accessors\":[" SQUARE ",{\"bufferView\":1,"
                               "\"byteOffset\":6,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"},"
                               "{\"bufferView\":5,\"componentType\":5121,\"count\":2,\"type\":\"SCALAR\"}]," NODE
                               ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2,"
                               "\"mode\":1}]}]}";
    struct reading *reading = read_file(text);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->position_count, 3);
    assert_int_equal(mesh->lines[0], 0);
    assert_int_equal(mesh->lines[1], 2);
    assert_position(mesh, 2, 0, 1, 0);
    reading_free(reading);
}

TEST(nodes_of_the_scene_place_meshes)
{
    struct reading *reading = read_file(
        FILE_OF("\"scene\":1,\"scenes\":[{\"nodes\":[3]},{\"nodes\":[0]}],\"nodes\":[{\"children\":[1,2],"
                "\"translation\":[1,2,3]},{\"mesh\":0,\"name\":\"left\",\"scale\":[2,2,2]},{\"mesh\":0,\"matrix\":"
                "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,9,1]},{\"mesh\":1}],\"meshes\":[{\"primitives\":[{\"attributes\":"
                "{\"POSITION\":0}}]},{\"primitives\":[{\"attributes\":{\"POSITION\":99}}]}]"));
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->instance_count, 2);
    assert_string_equal(scene->instances[0].node, "left");
    assert_true(scene->instances[0].object_to_world.m[0] == 2.0f && scene->instances[0].object_to_world.m[13] == 2.0f);
    assert_null(scene->instances[1].node);
    assert_true(scene->instances[1].object_to_world.m[14] == 12.0f);
    assert_int_equal(scene->warning_count, 2); /* an unplaced mesh, corners left over */
    reading_free(reading);
    struct reading *turned = read_over((struct zr_request){.up = "z"},
                                       FILE_OF("\"nodes\":[{\"mesh\":0,\"translation\":[0,0,5]}]," MESH("")));
    assert_read(turned);
    assert_true(turned->scene->instances[0].object_to_world.m[13] == 5.0f);
    reading_free(turned);
}

#define JOINTS "{\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"}"
#define WITH_JOINTS(rest)                                                                                              \
    "{" ASSET "," BUFFERS "," VIEWS ",\"accessors\":[" SQUARE "," INDEX "," COLOR "," SPARSE "," JOINTS "]," rest "}"

/* Far translations, matrices and coordinates are subtracted in double. */
TEST(middle_of_far_scenes_is_their_origin)
{
    struct reading *reading =
        read_file(FILE_OF("\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"
                          "\"nodes\":[{\"translation\":[408200.25,4080920.5,0],\"children\":[1,2,3]},{\"mesh\":0},"
                          "{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,9.0625,9,4,1]},"
                          "{\"camera\":0,\"translation\":[1,0.125,0]}]," MESH("")));
    assert_origin(reading, 408205.28125, 4080925.5, 2);
    assert_true(reading->scene->instances[0].object_to_world.m[12] == -5.03125f);
    assert_true(reading->scene->instances[1].object_to_world.m[12] == 4.03125f);
    assert_true(reading->scene->instances[1].object_to_world.m[13] == 4.0f);
    reading_free(reading);
    reading = read_over((struct zr_request){.channel = "color", .camera = "0"},
                        FILE_OF("\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"
                                "\"nodes\":[{\"translation\":[4080920.5,0,0],\"children\":[1,2]},{\"mesh\":0},"
                                "{\"camera\":0,\"translation\":[1,0.125,0]}]," MESH("")));
    assert_read(reading);
    assert_true(reading->scene->views[0].world_to_camera.m[12] == -0.5f);
    assert_true(reading->scene->views[0].world_to_camera.m[13] == 0.375f);
    reading_free(reading);
    float before[4][3];
    memcpy(before, numbers.corners, sizeof before);
    for (int i = 0; i < 4; i++)
        numbers.corners[i][1] += 4080920.0f;
    reading = read_file(FILE_OF("\"nodes\":[{\"mesh\":0}]," MESH("")));
    memcpy(numbers.corners, before, sizeof before);
    assert_origin(reading, 0.5, 4080920.5, 0);
    assert_position(&reading->scene->meshes[0], 0, -0.5f, -0.5f, 0);
    reading_free(reading);
}

TEST(joints_place_a_skinned_mesh)
{
    static const char text[] =
        WITH_JOINTS("\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[9,9,9]},{\"mesh\":0},{\"translation\":[0,0,2],"
                    "\"children\":[3]},"
                    "{\"translation\":[0,0,3],\"scale\":[4,1,2]}],\"skins\":[{\"joints\":[3]}],\"meshes\":[{"
                    "\"primitives\":[{\"attributes\":"
                    "{\"POSITION\":0,\"NORMAL\":0,\"JOINTS_0\":4,\"WEIGHTS_0\":2},\"indices\":1}]}]");
    struct reading *reading = read_file(text);
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->mesh_count, 2);
    const uint32_t bent = scene->instances[0].mesh, straight = scene->instances[1].mesh;
    assert_true(scene->instances[0].object_to_world.m[12] == 0.0f);
    assert_position(&scene->meshes[bent], 2, 4, 1, 5);
    assert_position(&scene->meshes[straight], 2, 1, 1, 0);
    const zr_vec3 normal = scene->meshes[bent].normals[2]; /* by the inverse transpose, as long as before */
    assert_true(normal.y == 4.0f * normal.x && normal.z == 0.0f &&
                fabsf(normal.x * normal.x + normal.y * normal.y - 2.0f) < 1e-6f);
    reading_free(reading);
    reading = read_over((struct zr_request){.color = NULL},
                        WITH_JOINTS("\"nodes\":[{\"mesh\":0,\"skin\":0},{}],\"skins\":[{\"joints\":[1]}],\"meshes\":"
                                    "[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":2,"
                                    "\"WEIGHTS_0\":2}}]}]"));
    assert_complaint(reading, ZR_BAD_SCENE, "/meshes/0/primitives/0/attributes/JOINTS_0",
                     "vertex 0 has a joint beyond the 1 joints of skin 0");
    reading_free(reading);
}

TEST(weights_move_vertices_to_targets)
{
    static const char text[] =
        FILE_OF("\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"weights\":[0,2]},{\"mesh\":0}],\"meshes\":[{\"weights\":[0.5],"
                "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"targets\":[{\"POSITION\":7},"
                "{\"POSITION\":3}]}]}]");
    struct reading *reading = read_file(text);
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->mesh_count, 2);
    assert_int_equal(scene->instances[0].mesh, scene->instances[2].mesh);
    assert_position(&scene->meshes[scene->instances[0].mesh], 3, 2, 3.5f, 3);
    assert_position(&scene->meshes[scene->instances[1].mesh], 3, 0, 3, 10);
    reading_free(reading);
}

TEST(a_node_places_instances)
{
    static const char text[] = FILE_OF(
        "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"translation\":[0,0,"
        "5],"
        "\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":0,\"SCALE\":3,\"_ID\":9}}}},"
        "{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"SCALE\":3}}}}]," MESH(
            ",\"indices\":1"));
    struct reading *reading = read_file(text);
    const struct zr_instance *instances = reading->scene->instances;
    assert_int_equal(reading->scene->instance_count, 9);
    assert_true(instances[3].object_to_world.m[12] == 1.0f && instances[3].object_to_world.m[13] == 1.0f);
    assert_true(instances[3].object_to_world.m[14] == 5.0f && instances[3].object_to_world.m[10] == 5.0f);
    assert_true(instances[8].object_to_world.m[0] == 0.0f && instances[8].object_to_world.m[5] == 1.0f);
    reading_free(reading);
}

#define CAMERAS                                                                                                        \
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,\"znear\":0.25}},{\"name\":\"flat\","        \
    "\"type\":"                                                                                                        \
    "\"orthographic\",\"orthographic\":{\"xmag\":2,\"ymag\":3,\"znear\":0.5,\"zfar\":10}}],\"nodes\":[{\"mesh\":0},"   \
    "{\"camera\":0,\"name\":\"eye\",\"translation\":[0,0,4],\"scale\":[2,2,2]},{\"camera\":1,\"translation\":[0,0,3]}" \
    "]"

TEST(a_parameter_chooses_a_camera_of_the_file)
{
    static const char text[] = FILE_OF(CAMERAS "," MESH(",\"indices\":1"));
    static const char *const names[] = {"eye", "0"};
    for (int i = 0; i < 2; i++) {
        struct reading *reading = read_over((struct zr_request){.camera = names[i]}, text);
        assert_read(reading);
        const struct zr_view *view = &reading->scene->views[0];
        assert_int_equal(view->pose, ZR_POSE_MATRIX);
        assert_int_equal(view->projection, ZR_PROJECTION_PERSPECTIVE);
        assert_true(view->world_to_camera.m[0] == 1.0f && view->world_to_camera.m[14] == -4.0f);
        assert_true(view->yfov_radians == 0.5f && view->znear == 0.25f && !view->has_zfar);
        reading_free(reading);
    }
    struct reading *reading = read_over((struct zr_request){.camera = "flat", .up = "z"}, text);
    assert_read(reading);
    assert_int_equal(reading->scene->views[0].projection, ZR_PROJECTION_ORTHOGRAPHIC);
    assert_true(reading->scene->views[0].ymag == 3.0f && reading->scene->views[0].world_to_camera.m[14] == -3.0f);
    reading_free(reading);
    reading = read_over((struct zr_request){.camera = "3"}, text);
    assert_complaint(reading, ZR_BAD_SCENE, "",
                     "parameter camera: the file has no camera '3'; its cameras: 'eye', 'flat'");
    reading_free(reading);
    reading = read_over((struct zr_request){.camera = "eye", .preset = "top"}, text);
    assert_complaint(reading, ZR_BAD_SCENE, "", "parameter camera: cannot be combined with preset");
    reading_free(reading);
    reading = read_over((struct zr_request){.camera = "eye"}, FILE_OF(NODE "," MESH(",\"indices\":1")));
    assert_complaint(reading, ZR_BAD_SCENE, "", "parameter camera: the file has no cameras");
    reading_free(reading);
}

#define MATERIALS                                                                                                      \
    "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0,1,0.25],\"roughnessFactor\":0.5},"           \
    "\"alphaMode\":\"BLEND\",\"emissiveFactor\":[0,0.5,0],\"extensions\":{\"KHR_materials_emissive_strength\":"        \
    "{\"emissiveStrength\":4}}},{\"doubleSided\":true,\"alphaMode\":\"MASK\",\"extensions\":"                          \
    "{\"KHR_materials_unlit\":{}}}],\"extensionsUsed\":[\"KHR_materials_unlit\",\"KHR_materials_emissive_strength\"]"
#define THREE_PRIMITIVES                                                                                               \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0},{\"attributes\":"     \
    "{\"POSITION\":0},\"indices\":1,\"material\":1},{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]"

static const struct zr_material *material_of(const struct reading *reading, uint32_t mesh)
{
    return &reading->scene->materials[reading->scene->meshes[mesh].material];
}

TEST(materials_of_the_file_are_over_the_look)
{
    struct reading *reading = read_file(FILE_OF(NODE "," MATERIALS "," THREE_PRIMITIVES));
    const struct zr_material *first = material_of(reading, 0), *second = material_of(reading, 1),
                             *third = material_of(reading, 2);
    assert_int_equal(reading->scene->warning_count, 0);
    assert_int_equal(first->shading, ZR_SHADING_PBR);
    assert_true(first->base_color.x > 0.735f && first->base_color.x < 0.736f && first->base_color.z == 1.0f);
    assert_true(first->base_color.w == 0.25f && first->metallic == 1.0f && first->roughness == 0.5f);
    assert_true(first->emissive.y == 2.0f);
    assert_int_equal(first->alpha_mode, ZR_ALPHA_BLEND);
    assert_false(first->double_sided);
    assert_int_equal(second->shading, ZR_SHADING_UNLIT);
    assert_true(second->double_sided && second->alpha_cutoff == 0.5f);
    assert_true(third->metallic == 0.0f && third->double_sided); /* the look's */
    reading_free(reading);
}

TEST(the_query_is_over_the_file)
{
    const struct zr_request request = {.color = "#ff0000", .metallic = "0", .doubleSided = "true", .shading = "gooch"};
    struct reading *reading = read_over(request, FILE_OF(NODE "," MATERIALS "," THREE_PRIMITIVES));
    assert_read(reading);
    for (uint32_t i = 0; i < 3; i++) {
        const struct zr_material *material = material_of(reading, i);
        assert_true(material->base_color.x == 1.0f && material->base_color.z == 0.0f);
        assert_true(material->metallic == 0.0f && material->double_sided);
        assert_int_equal(material->shading, ZR_SHADING_GOOCH);
    }
    reading_free(reading);
    reading = read_over((struct zr_request){.look = "textbook"}, FILE_OF(NODE "," MATERIALS "," THREE_PRIMITIVES));
    assert_read(reading);
    assert_false(reading->scene->picture->is_linear);
    assert_int_equal(material_of(reading, 0)->shading, ZR_SHADING_FLAT);
    assert_int_equal(material_of(reading, 1)->shading, ZR_SHADING_UNLIT);
    reading_free(reading);
}

TEST(only_base_colours_are_left_as_the_file_gives_them)
{
    struct reading *reading = read_over(
        (struct zr_request){.colors = "materials"},
        FILE_OF(NODE "," MATERIALS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":2},"
                     "\"indices\":1,\"material\":0},{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]"));
    assert_read(reading);
    const struct zr_material *first = material_of(reading, 0), *none = material_of(reading, 1);
    assert_true(first->base_color.x == 0.5f && first->base_color.y == 0.0f && first->base_color.z == 1.0f);
    assert_true(first->base_color.w == 0.25f && first->emissive.y == 0.0f);
    assert_true(none->base_color.x == 1.0f && none->base_color.y == 1.0f && none->base_color.z == 1.0f);
    assert_null(reading->scene->meshes[0].colors);
    reading_free(reading);
}

TEST(what_is_left_out_is_warned_of)
{
    static const struct {
        const char *text, *warning;
    } cases[] = {
        {FILE_OF(NODE "," MESH(",\"indices\":1") ",\"animations\":[{}]"), "left out: animations of the file"},
        {FILE_OF(NODE "," MESH(",\"indices\":1") ",\"extensionsUsed\":[\"A\",\"KHR_texture_transform\",\"B\"]"),
         "drawn without the extensions 'A', 'B'"},
        {FILE_OF(NODE "," MESH(",\"indices\":1,\"lights\":[{}]") ",\"more\":1"),
         "2 keys are not known, the first is /more"},
        {FILE_OF(NODE "," MESH(",\"indices\":1,\"lights\":[{}]")),
         "/meshes/0/primitives/0/lights: this key is not known"},
        {FILE_OF(NODE "," MESH(",\"indices\":1},{\"attributes\":{}")),
         "/meshes/0/primitives/1: without POSITION, and not drawn"},
        {FILE_OF(NODE "," MESH(",\"indices\":1,\"extras\":{\"x\":1},\"extensions\":{\"Y\":{}}")), NULL},
        {FILE_OF(NODE "," MESH(",\"indices\":1,\"material\":0") ",\"materials\":[{\"pbrMetallicRoughness\":{"
                                                                "\"baseColorFactor\":[2,0,0,1]}}]"),
         "/materials/0/pbrMetallicRoughness/baseColorFactor: beyond its range, and clamped"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_file(cases[i].text);
        assert_int_equal(reading->scene->warning_count, cases[i].warning ? 1 : 0);
        if (cases[i].warning) assert_string_equal(reading->scene->warnings[0], cases[i].warning);
        reading_free(reading);
        reading = read_over((struct zr_request){.strict = "1"}, cases[i].text);
        assert_int_equal(reading->status, cases[i].warning ? ZR_BAD_SCENE : ZR_OK);
        reading_free(reading);
    }
}

TEST(a_kept_file_keeps_nodes_and_materials)
{
    static const char text[] =
        FILE_OF("\"nodes\":[{\"mesh\":0,\"translation\":[0,0,5]}]," MATERIALS "," THREE_PRIMITIVES);
    static const char change[] = "{\"window\":{\"width\":64,\"height\":48}}";
    const struct zr_request request = {.format = ZR_FORMAT_GLTF, .assets = parts, .asset_count = 1};
    struct keeping *keeping = keep(request, text, sizeof text - 1);
    assert_int_equal(keeping_change(keeping, (struct zr_request){.bytes = change, .size = sizeof change - 1}), ZR_OK);
    const struct zr_scene *scene = keeping->scene;
    assert_int_equal(scene->views[0].width, 64);
    assert_int_equal(scene->instance_count, 3);
    assert_true(scene->instances[2].object_to_world.m[14] == 5.0f);
    assert_int_equal(scene->materials[scene->meshes[1].material].shading, ZR_SHADING_UNLIT);
    keeping_free(keeping);
}

TEST(a_file_that_needs_more_memory_says_so)
{
    static const char text[] = FILE_OF(NODE "," MATERIALS "," THREE_PRIMITIVES);
    const struct zr_request request = {.format = ZR_FORMAT_GLTF, .assets = parts, .asset_count = 1};
    assert_true(smallest_ceiling(request, text, sizeof text - 1, 1 << 17) > 512);
}

RUN_TESTS(NULL, NULL)
