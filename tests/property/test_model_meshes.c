/* Meshes of JSON scenes that are model files.
 * Pictures equal those of the bare files; poses, materials and cameras apply. */
#include <stdio.h>

#include "support/renderer.h"
#include "support/tests.h"

#define CORNERS "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
static const char obj[] = CORNERS "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
static const char ply[] =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
    "red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 2\nproperty list uchar int "
    "vertex_indices\nend_header\n0 0 0 255 0 0 255\n1 0 0 0 255 0 90\n0 1 0.5 0 0 255 255\n1 1 1 9 99 200 255\n"
    "3 0 1 2\n3 1 3 2\n";

/* Colours of faces alone. */
static const char flat_ply[] =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
    "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar "
    "blue\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0.5\n1 1 1\n3 0 1 2 255 0 0\n3 1 3 2 0 99 200\n";

/* Two meshes, one with two primitives; three nodes; a material with a texture. */
#define TRIANGLE "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}"
static const char gltf[] =
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":\"corners.bin\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[" TRIANGLE "," TRIANGLE
    ",{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
    "\"images\":[{\"uri\":\"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM"
    "/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC\"}],\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":{"
    "\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0.25}},{\"emissiveFactor\":[0.5,0,0.25]}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":2},\"material\":0},{\"attributes\":{"
    "\"POSITION\":1},\"material\":1}]},{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"nodes\":[{\"name\":\"body\",\"mesh\":0,\"children\":[1]},{\"name\":\"wheel\",\"mesh\":1,\"translation\":[1,1,0]}"
    ","
    "{\"mesh\":1,\"rotation\":[0,0.6,0,0.8]},{\"name\":\"eye\",\"camera\":0,\"translation\":[0.5,0.5,4]}],"
    "\"scenes\":[{\"nodes\":[0,2,3]}],\"cameras\":[{\"perspective\":{\"yfov\":0.7,\"znear\":0.5}}]}";
enum { GLTF_FACES = 4 };
static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5f}};

static const struct file {
    const char *name, *text;
} files[] = {{"m.obj", obj}, {"m.ply", ply}, {"flat.ply", flat_ply}, {"m.gltf", gltf}};
enum { FILES = sizeof files / sizeof *files };

static struct zraster_part bytes_part(const char *name, const void *bytes, size_t size)
{
    return (struct zraster_part){name, {bytes, ZRASTER_BYTES, 1, {size}}, 0};
}

/* Draws a scene in JSON, or a file with a query, with all files and the glTF's buffer as parts. */
static zraster_picture *draw(struct zraster_request request)
{
    struct zraster_part parts[FILES + 1];
    for (int i = 0; i < FILES; i++)
        parts[i] = bytes_part(files[i].name, files[i].text, strlen(files[i].text));
    parts[FILES] = bytes_part("corners.bin", corners, sizeof corners);
    request.parts = parts;
    request.part_count = FILES + 1;
    return picture_of_request(renderer, &request, request.query ? request.query : request.body);
}

/* Counts the pixels that differ from the corner, which is background. Translucent faces have no faceId. */
static size_t count_drawn(zraster_picture *picture)
{
    struct zraster_array array;
    size_t drawn = 0;
    assert_int_equal(zraster_picture_channel(picture, "color", &array), 1);
    const uint8_t *rgba = array.data;
    for (size_t i = 0; i < array.shape[0] * array.shape[1]; i++)
        drawn += memcmp(rgba + 4 * i, rgba, 4) != 0;
    return drawn;
}

/* Frees both. */
static void assert_same_picture(zraster_picture *a, zraster_picture *b, const char *of)
{
    const char *channel = channel_that_differs(a, b);
    if (channel) fail_msg("%s: %s", of, channel);
    assert_true(count_drawn(a) > 100);
    zraster_picture_free(a);
    zraster_picture_free(b);
}

#define OUTPUTS           "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"depth\"},{\"channel\":\"faceId\"}]"
#define SCENE(look, rest) "{\"window\":{\"width\":120,\"height\":90},\"look\":\"" look "\"," OUTPUTS "," rest "}"
#define QUERY(look, rest) "width=120&height=90&channel=color,depth,faceId&look=" look rest

TEST(a_file_as_a_mesh_gives_the_picture_of_the_bare_file)
{
    static const char *const looks[] = {"studio", "technical", "textbook", "metal"};
    for (int i = 0; i < FILES; i++)
        for (int k = 0; k < 4; k++) {
            char scene[512], query[128];
            snprintf(scene, sizeof scene, SCENE("%s", "\"meshes\":[{\"asset\":\"%s\"}]"), looks[k], files[i].name);
            snprintf(query, sizeof query, QUERY("%s", ""), looks[k]);
            struct zraster_request bare = request_of(files[i].text);
            bare.query = query;
            assert_same_picture(draw(bare), draw(request_of(scene)), files[i].name);
        }
}

TEST(a_camera_of_a_file_is_the_view)
{
    struct zraster_request bare = request_of(gltf);
    bare.query = QUERY("studio", "&camera=eye");
    assert_same_picture(draw(bare),
                        draw(request_of(SCENE("studio", "\"meshes\":[{\"asset\":\"m.obj\"},{\"asset\":\"m.gltf\"}],"
                                                        "\"nodes\":[{\"mesh\":1}],\"view\":{\"camera\":0}"))),
                        "number");
    /* The node places the camera, too. */
    bare.query = QUERY("studio", "&camera=0");
    assert_same_picture(
        draw(bare),
        draw(request_of(SCENE("studio", "\"view\":{\"camera\":\"eye\"},\"meshes\":[{\"asset\":\"m.gltf\"}],"
                                        "\"nodes\":[{\"mesh\":0,\"rotation\":[0,0,0,1]}]"))),
        "node");
}

TEST(points_of_files_have_the_size_and_shape_of_the_mesh)
{
    static const char cloud[] = "\"uri\":\"data:;base64,diAwIDAgMAp2IDEgMCAwCnYgMCAxIDAKcCAxIDIgMwo=\"";
    static const char list[] = "\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"points\":[0,1,2]";
    static const char *const shapes[] = {"square", "round"};
    for (int i = 0; i < 2; i++) {
        char file[512], plain[512];
        snprintf(file, sizeof file, SCENE("textbook", "\"meshes\":[{%s,\"pointSize\":20,\"pointShape\":\"%s\"}]"),
                 cloud, shapes[i]);
        snprintf(plain, sizeof plain, SCENE("textbook", "\"meshes\":[{%s,\"pointSize\":20,\"pointShape\":\"%s\"}]"),
                 list, shapes[i]);
        assert_same_picture(draw(request_of(file)), draw(request_of(plain)), shapes[i]);
    }
    zraster_picture *faces = draw(request_of("{\"meshes\":[{\"asset\":\"m.obj\",\"pointSize\":20}]}"));
    const char *warning = "";
    for (size_t i = 0; warning && !strstr(warning, "mesh 0: pointSize has no effect without points"); i++)
        warning = zraster_picture_warning(faces, i);
    assert_non_null(warning);
    zraster_picture_free(faces);
}

/* Three instances, placed by the scene's nodes and by the file's nodes. */
TEST(nodes_poses_and_materials_apply_to_files)
{
    static const char placed[] =
        SCENE("clay",
              "\"view\":{\"preset\":\"front\"},\"meshes\":[{\"name\":\"a\",\"asset\":\"m.obj\",\"material\":\"red\"}],"
              "\"materials\":[{\"name\":\"red\",\"baseColorFactor\":[1,0,0]}],"
              "\"nodes\":[{\"name\":\"one\",\"mesh\":\"a\",\"translation\":[2,0,0]},{\"mesh\":\"a\"}]");
    static const char written[] = SCENE(
        "clay",
        "\"view\":{\"preset\":\"front\"},\"meshes\":[{\"material\":\"red\",\"doubleSided\":true,\"positions\":[[0,0,0],"
        "[1,0,0],[0,1,0],[0,0,1]],\"faces\":[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}],"
        "\"materials\":[{\"name\":\"red\",\"baseColorFactor\":[1,0,0]}],"
        "\"nodes\":[{\"mesh\":0,\"translation\":[2,0,0]},{\"mesh\":0}]");
    assert_same_picture(draw(request_of(placed)), draw(request_of(written)), "nodes");
    const struct zraster_part part = bytes_part("m.obj", obj, strlen(obj));
    struct zraster_request request = request_of(placed);
    request.parts = &part;
    request.part_count = 1;
    zraster_scene *scene;
    zraster_picture *moved;
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    const struct zraster_request change = request_of("{\"poses\":{\"one\":[[1,0,0,0],[0,1,0,3],[0,0,1,0],[0,0,0,1]]}}");
    assert_int_equal(zraster_scene_draw(scene, &change, &moved, NULL), ZRASTER_OK);
    zraster_scene_free(scene);
    char text[1024];
    memcpy(text, placed, sizeof placed);
    memcpy(strstr(text, "[2,0,0]"), "[0,3,0]", 7);
    assert_same_picture(moved, draw(request_of(text)), "poses");
}

TEST(a_projection_and_planes_override_those_of_a_camera)
{
    static const char *const keys[] = {
        "\"intrinsics\":{\"fx\":90,\"fy\":70,\"cx\":20,\"cy\":41},\"znear\":3.6,\"zfar\":4.2",
        "\"orthographic\":{\"xmag\":1,\"ymag\":0.5},\"znear\":0.5", "\"znear\":3.7,\"perspective\":{\"yfov\":0.7}"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        char of_file[512], written[512];
        snprintf(of_file, sizeof of_file,
                 SCENE("clay", "\"view\":{\"camera\":0,%s},\"meshes\":[{\"asset\":\"m.gltf\"}]"), keys[i]);
        snprintf(written, sizeof written,
                 SCENE("clay", "\"view\":{\"cameraToWorld\":[1,0,0,0,0,1,0,0,0,0,1,0,0.5,0.5,4,1],%s},"
                               "\"meshes\":[{\"asset\":\"m.gltf\"}]"),
                 keys[i]);
        assert_same_picture(draw(request_of(of_file)), draw(request_of(written)), keys[i]);
    }
    assert_same_picture(
        draw(request_of(SCENE("clay", "\"view\":{\"camera\":0,\"znear\":3.7},\"meshes\":[{\"asset\":\"m.gltf\"}]"))),
        draw(request_of(SCENE("clay", "\"view\":{\"camera\":0,\"znear\":3.7,\"perspective\":{\"yfov\":0.7}},"
                                      "\"meshes\":[{\"asset\":\"m.gltf\"}]"))),
        "the camera's angle");
}

TEST(a_view_fits_all_meshes_of_a_file)
{
    static const char fitted[] = SCENE("clay", "\"view\":{\"preset\":\"front\",\"fit\":{\"mesh\":\"g\"}},\"meshes\":[{"
                                               "\"name\":\"g\",\"asset\":\"m.gltf\"}%s]");
    char alone[512], beside[512];
    snprintf(alone, sizeof alone, fitted, "");
    snprintf(beside, sizeof beside, fitted, ",{\"asset\":\"m.obj\"}");
    zraster_picture *a = draw(request_of(alone)), *b = draw(request_of(beside));
    struct zraster_array one, two;
    assert_int_equal(zraster_picture_channel(a, "faceId", &one), 1);
    assert_int_equal(zraster_picture_channel(b, "faceId", &two), 1);
    uint32_t seen = 0;
    for (size_t i = 0; i < one.shape[0] * one.shape[1]; i++) {
        const uint32_t face = ((const uint32_t *)one.data)[i], both = ((const uint32_t *)two.data)[i];
        seen += face > 0;
        if (face > GLTF_FACES || (both != face && both <= GLTF_FACES)) fail_msg("pixel %zu: %u and %u", i, face, both);
    }
    assert_true(seen > 100);
    zraster_picture_free(a);
    zraster_picture_free(b);
}

/* Each of two files finds its own material library, in the folder of its name. */
TEST(a_file_refers_to_files_of_its_folder)
{
    static const char red[] = "newmtl m\nKd 1 0 0\n", blue[] = "newmtl m\nKd 0 0 1\n",
                      face[] = "mtllib a.mtl\nusemtl m\n" CORNERS "f 1 2 3\nf 1 3 2\n";
    const struct zraster_part parts[] = {
        bytes_part("a.mtl", red, sizeof red - 1), bytes_part("one/a.mtl", blue, sizeof blue - 1),
        bytes_part("m.obj", face, sizeof face - 1), bytes_part("one/m.obj", face, sizeof face - 1)};
    static const char *const names[] = {"m.obj", "one/m.obj"};
    for (int i = 0; i < 2; i++) {
        char text[256];
        struct zraster_array array;
        snprintf(text, sizeof text,
                 "{\"shading\":\"unlit\",\"view\":{\"preset\":\"front\"},\"meshes\":[{\"asset\":\"%s\"}]}", names[i]);
        struct zraster_request request = request_of(text);
        request.parts = parts;
        request.part_count = 4;
        zraster_picture *picture = picture_of_request(renderer, &request, names[i]);
        assert_int_equal(zraster_picture_channel(picture, "color", &array), 1);
        size_t reds = 0, blues = 0;
        const uint8_t *rgba = array.data;
        for (size_t k = 0; k < array.shape[0] * array.shape[1]; k++) {
            reds += rgba[4 * k] == 255 && rgba[4 * k + 2] == 0;
            blues += rgba[4 * k] == 0 && rgba[4 * k + 2] == 255;
        }
        assert_true(i == 0 ? reds > 100 && blues == 0 : blues > 100 && reds == 0);
        zraster_picture_free(picture);
    }
}

TEST(files_that_are_no_models_are_refused)
{
    static const struct {
        const char *mesh, *pointer, *detail;
    } cases[] = {
        {"{\"asset\":\"m.obj\",\"positions\":[[0,0,0]]}", "/meshes/0", "two shapes: asset and positions"},
        {"{\"asset\":\"m.obj\",\"scalars\":[1,2,3,4]}", "/meshes/0/scalars", "two kinds of colours: asset and scalars"},
        {"{\"asset\":\"m.obj\",\"colormap\":\"turbo\"}", "/meshes/0/colormap", "a colormap needs scalars"},
        {"{\"asset\":\"m.obj\",\"range\":[0,1]}", "/meshes/0/range", "a range without scalars"},
        {"{\"uri\":\"data:;base64,e30=\"}", "/meshes/0/uri",
         "the file looks like JSON; a mesh needs a model, such as OBJ"},
        {"{\"uri\":\"data:;base64,AAAA\"}", "/meshes/0/uri", "looks like an unknown format"},
        {"{\"uri\":\"data:;base64,diAwIDAgMApmIDEgMSA5Cg==\"}", "/meshes/0/uri", "line 2"},
        {"{\"uri\":\"data:;base64,diAwIDAgMApmIDEgMSA5Cg==\",\"asset\":\"x\"}", "/meshes/0",
         "only one of uri and asset"},
        {"{\"uri\":\"data:;base64,eyJhc3NldCI6eyJ2ZXJzaW9uIjoiMi4wIn0sIm1lc2hlcyI6NX0=\"}", "/meshes/0/uri",
         "/meshes: "},
        {"{\"uri\":\"data:;base64,eyJhc3NldCI6eyJ2ZXJzaW9uIjoiMi4wIn0sIm5vZGVzIjpbXX0=\"}", "/meshes/0/uri",
         "the file has no meshes"},
        {"{\"asset\":\"m.obj\"}],\"view\":{\"camera\":\"x\"},\"lights\":[", "/view/camera",
         "no mesh of the scene is a file with cameras"},
        {"{\"asset\":\"m.gltf\"}],\"view\":{\"camera\":\"x\"},\"lights\":[", "/view/camera",
         "the file has no camera 'x'; its cameras: 'eye'"},
        {"{\"asset\":\"m.obj\"}],\"view\":{\"camera\":\"x\",\"t\":[0,0,3]},\"lights\":[", "/view",
         "two views: camera and t"},
        {"{\"asset\":\"m.gltf\"}],\"view\":{\"camera\":0,\"zfar\":1e-6},\"lights\":[", "/view/camera",
         "the camera '0' then has zfar"},
        {"{\"asset\":\"m.gltf\"}],\"view\":{\"camera\":0,\"znear\":1,\"projectionMatrix\":[1,0,0,0,0,1,0,0,0,0,-1,-1,"
         "0,0,-0.2,0]},\"lights\":[",
         "/view/znear", "projectionMatrix sets the planes itself"},
        {"{\"asset\":\"m.gltf\"}],\"view\":{\"camera\":0,\"K\":[9,0,9,0,9,9,0,0,1],\"intrinsics\":{\"fx\":9}},"
         "\"lights\":[",
         "/view", "two projections: intrinsics and K"}};
    const struct zraster_part parts[] = {bytes_part("m.obj", obj, strlen(obj)),
                                         bytes_part("m.gltf", gltf, strlen(gltf)),
                                         bytes_part("corners.bin", corners, sizeof corners)};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        zraster_picture *picture;
        zraster_error *error;
        snprintf(text, sizeof text, "{\"meshes\":[%s]}", cases[i].mesh);
        struct zraster_request request = request_of(text);
        request.parts = parts;
        request.part_count = 3;
        assert_int_equal(zraster_draw(renderer, &request, &picture, &error), ZRASTER_BAD_SCENE);
        assert_string_equal(zraster_error_pointer(error, 0), cases[i].pointer);
        if (!strstr(zraster_error_detail(error, 0), cases[i].detail)) fail_msg("%s", zraster_error_text(error));
        zraster_error_free(error);
    }
}

RUN_TESTS(open_renderer, close_renderer)
