/* input/query/zip_body.h: ZIP archives as bodies. */
#include "base/cancel.h"
#include "support/input/npy.h"
#include "support/input/zip_file.h"
#include "support/tests.h"
#include "unit/common/input_check.h"
#include "unit/common/kept_check.h"

#define GLTF_OF(uri)                                                                                                   \
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"          \
    "{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"    \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"" uri "\"}]}"
#define OBJ   "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
#define SCENE "{\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}"

static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

#define TEXT(name, text)                                                                                               \
    {                                                                                                                  \
        name, text, sizeof text - 1, true                                                                              \
    }
#define NUMBERS(name)                                                                                                  \
    {                                                                                                                  \
        name, (const char *)corners, sizeof corners, true                                                              \
    }
#define STORED(name)                                                                                                   \
    {                                                                                                                  \
        name, (const char *)corners, sizeof corners, false                                                             \
    }

static const struct body {
    struct zip_entry entries[4];
    const char *member;
    enum zr_status status;
    const char *says; /* the first fault, or the only warning; NULL: none */
} bodies[] = {
    {{TEXT("a.obj", OBJ)}, NULL, ZR_OK, NULL},
    {{TEXT("a/b.GLTF", GLTF_OF("b.bin")), NUMBERS("a/b.bin")}, NULL, ZR_OK, NULL},
    {{TEXT("a/b.gltf", GLTF_OF("../c/b.bin")), STORED("c/b.bin")}, NULL, ZR_OK, NULL},
    {{TEXT("a/b.gltf", GLTF_OF("c/b.bin")), STORED("c/b.bin")}, NULL, ZR_OK, NULL},
    {{TEXT("a/b.gltf", GLTF_OF("b.bin")), NUMBERS("x/b.bin"), NUMBERS("y/b.bin")},
     NULL,
     ZR_BAD_SCENE,
     "in 'a/b.gltf': no part of the request has the name 'b.bin'"},
    {{TEXT("a.obj", OBJ), TEXT("__MACOSX/b.obj", OBJ), TEXT(".c/d.obj", OBJ), TEXT("readme.txt", "x")},
     NULL,
     ZR_OK,
     NULL},
    {{TEXT("a.obj", OBJ), TEXT("w.png", "x"), TEXT("v/x.PNG", "x"), TEXT("t.blend", "x")},
     NULL,
     ZR_OK,
     "2 members of the ZIP archive are not used, the first is 'v/x.PNG'"},
    {{TEXT("a.obj", OBJ), TEXT("w.bin", "x")}, NULL, ZR_OK, "a member of the ZIP archive is not used: 'w.bin'"},
    {{TEXT("a.obj", OBJ), TEXT("x/b.stl", "solid"), TEXT("c.json", SCENE)},
     NULL,
     ZR_BAD_SCENE,
     "the ZIP archive has 3 models; choose one by the parameter member: 'a.obj', 'c.json', 'x/b.stl'"},
    {{TEXT("a.obj", OBJ), TEXT("x/b.stl", "solid"), TEXT("c.json", SCENE)}, "c.json", ZR_OK, NULL},
    {{TEXT("a.obj", OBJ), TEXT("list.json", "[{\"meshes\":1}]"), TEXT("more.json", "{\"a\":{\"meshes\":1}}")},
     NULL,
     ZR_OK,
     NULL},
    {{TEXT("a.json", "[1]"), TEXT("b.json", "{}")}, NULL, ZR_BAD_SCENE, "the ZIP archive has 2 models"},
    {{TEXT("x/a.obj", OBJ), TEXT("b.obj", OBJ)}, "a.obj", ZR_OK, NULL},
    {{TEXT("x/a.obj", OBJ), TEXT("y/a.obj", OBJ)},
     "a.obj",
     ZR_BAD_REQUEST,
     "parameter member: 2 members have the name 'a.obj'; choose one by its path: 'x/a.obj', 'y/a.obj'"},
    {{TEXT("x/a.obj", OBJ), TEXT("y/a.obj", OBJ), TEXT("z/a.obj", OBJ)},
     "a.obj",
     ZR_BAD_REQUEST,
     "3 members have the name 'a.obj'; choose one by its path: 'x/a.obj', 'y/a.obj', ..."},
    {{TEXT("x/a.obj", OBJ), TEXT("y/a.obj", OBJ)}, "y/a.obj", ZR_OK, NULL},
    {{TEXT("x/a.obj", OBJ), TEXT("y/b.obj", OBJ)}, "A.OBJ", ZR_OK, NULL},
    {{TEXT("x/a.obj", OBJ), TEXT("y/A.OBJ", "x")}, "a.obj", ZR_OK, NULL},
    {{TEXT("x/a.obj", OBJ), TEXT("y/a.obj", OBJ)},
     "A.obj",
     ZR_BAD_REQUEST,
     "2 members have the name 'A.obj'; choose one by its path: 'x/a.obj', 'y/a.obj'"},
    {{TEXT("x/a.obj", OBJ), TEXT("y/a.obj", OBJ)},
     "b.obj",
     ZR_BAD_REQUEST,
     "the ZIP archive has no 'b.obj'; its models: 'x/a.obj', 'y/a.obj'"},
    {{TEXT("a.txt", "x")}, "b.obj", ZR_BAD_REQUEST, "the ZIP archive has no 'b.obj'; its models: none"},
    {{TEXT("a/", "")}, NULL, ZR_BAD_SCENE, "the ZIP archive is empty"},
    {{TEXT(NULL, "")}, NULL, ZR_BAD_SCENE, "the ZIP archive is empty"},
    {{TEXT(NULL, "")}, "a.obj", ZR_BAD_SCENE, "the ZIP archive is empty"},
    {{TEXT("a.dat", OBJ)}, "a.dat", ZR_OK, NULL},
    {{TEXT("a.dat", "?")}, "a.dat", ZR_BAD_SCENE, "in a.dat: the member has none of the formats"},
    {{TEXT("a.zip", "PK\3\4")}, "a.zip", ZR_BAD_SCENE, "a ZIP archive within a ZIP archive"},
    {{TEXT("a.fbx", "x")}, NULL, ZR_BAD_SCENE, "the ZIP archive has no model: no member ends with one of json, obj,"},
    {{TEXT("a.obj", "")}, NULL, ZR_BAD_SYNTAX, "in a.obj: the member is empty"},
    {{TEXT("a.obj", "v x\n")}, NULL, ZR_BAD_SYNTAX, "in 'a.obj': "},
    {{TEXT("a.obj", SCENE)}, NULL, ZR_BAD_SYNTAX, "the type is OBJ, but the body looks like JSON"},
    {{TEXT("b.bin", "short"), TEXT("a/b.gltf", GLTF_OF("b.bin")), NUMBERS("a/b.bin")},
     NULL,
     ZR_OK,
     "a member of the ZIP archive is not used: 'b.bin'"},
    {{TEXT("../a.obj", OBJ)}, NULL, ZR_BAD_SYNTAX, "a broken ZIP archive: member '../a.obj'"}};

static size_t count_of(const struct body *body)
{
    size_t count = 0;
    while (count < 4 && body->entries[count].name)
        count++;
    return count;
}

TEST(an_archive_is_read_as_the_model_in_it)
{
    for (size_t i = 0; i < 2 * sizeof bodies / sizeof *bodies; i++) {
        const struct body *body = &bodies[i / 2];
        size_t size, directory;
        unsigned char *file = zip_file(body->entries, count_of(body), &size, &directory);
        const struct zr_request request = {.format = i % 2 ? ZR_FORMAT_ZIP : ZR_FORMAT_UNKNOWN, .member = body->member};
        struct reading *reading = read_request(request, file, size, zr_limits_default(), (size_t)1 << 28);
        const char *says = "";
        if (reading->status != ZR_OK) says = reading->error.items[0].detail;
        if (reading->status == ZR_OK && reading->scene->warning_count > 0) says = reading->scene->warnings[0];
        if (reading->status != body->status || (body->says ? !strstr(says, body->says) : *says != '\0'))
            fail_msg("case %zu: status %d, %s", i / 2, (int)reading->status, says);
        if (reading->status == ZR_OK) assert_int_equal(reading->scene->meshes[0].face_count, 1);
        reading_free(reading);
        free(file);
    }
}

TEST(a_broken_member_is_named)
{
    size_t size, directory;
    unsigned char *file = zip_file(bodies[2].entries, 2, &size, &directory);
    unsigned char *data = memmem(file, size, "c/b.bin", 7);
    data[7 + 4] ^= 1;
    struct reading *reading = read_bytes(ZR_FORMAT_ZIP, file, size);
    assert_complaint(reading, ZR_BAD_SYNTAX, "", "a broken ZIP archive: member 'c/b.bin': its checksum is wrong");
    assert_int_equal(reading->error.count, 1);
    reading_free(reading);
    free(file);
    file = zip_file(bodies[2].entries, 2, &size, &directory);
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_ZIP}, file, size, 1 << 18) > 0);
    free(file);
}

TEST(another_format_is_named)
{
    static const char *const bodies_of_others[][2] = {{OBJ, "the type is ZIP, but the body looks like OBJ"},
                                                      {"PK\3\4", "a broken ZIP archive: its end is missing"}};
    for (size_t i = 0; i < 2; i++) {
        struct reading *reading = read_bytes(ZR_FORMAT_ZIP, bodies_of_others[i][0], strlen(bodies_of_others[i][0]));
        assert_complaint(reading, ZR_BAD_SYNTAX, "", bodies_of_others[i][1]);
        assert_int_equal(reading->error.count, i == 0 ? 2 : 1);
        reading_free(reading);
    }
}

TEST(parts_of_the_request_replace_members)
{
    static const float other[9] = {0, 0, 7, 1, 0, 7, 0, 1, 7};
    static const struct zr_asset part = {.name = "b.bin", .bytes = other, .size = sizeof other};
    size_t size, directory;
    unsigned char *file = zip_file(bodies[1].entries, 2, &size, &directory);
    const struct zr_request request = {.format = ZR_FORMAT_ZIP, .assets = &part, .asset_count = 1};
    struct reading *reading = read_request(request, file, size, zr_limits_default(), (size_t)1 << 28);
    assert_read(reading);
    assert_true(reading->scene->meshes[0].positions[0].z == 7.0f);
    reading_free(reading);
    free(file);
}

TEST(the_parameter_member_needs_an_archive)
{
    struct reading *reading =
        read_request((struct zr_request){.member = "a"}, OBJ, sizeof OBJ - 1, zr_limits_default(), (size_t)1 << 28);
    assert_complaint(reading, ZR_BAD_REQUEST, "", "parameter member belongs to bodies that are a ZIP archive");
    reading_free(reading);
}

TEST(members_inflate_to_the_limit_and_no_further)
{
    static const size_t model = sizeof GLTF_OF("b.bin") - 1, all = model + sizeof corners;
    size_t size, directory;
    unsigned char *file = zip_file(bodies[1].entries, 2, &size, &directory);
    const struct {
        size_t most;
        const char *member;
    } cases[] = {{all, NULL}, {all - 1, "'a/b.bin'"}, {model, "'a/b.bin'"}, {model - 1, "'a/b.GLTF'"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct zr_limits limits = zr_limits_default();
        char says[200];
        limits.unpacked_bytes_max = cases[i].most;
        snprintf(says, sizeof says, "a ZIP archive: with member %s, those that are read inflate to more than %zu bytes",
                 cases[i].member ? cases[i].member : "", cases[i].most);
        struct reading *reading =
            read_request((struct zr_request){.format = ZR_FORMAT_ZIP}, file, size, limits, (size_t)1 << 28);
        assert_int_equal(reading->status, cases[i].member ? ZR_BAD_SCENE : ZR_OK);
        if (cases[i].member) assert_complaint(reading, ZR_BAD_SCENE, "", says);
        reading_free(reading);
    }
    free(file);
}

TEST(a_quick_reading_unpacks_little)
{
    static const size_t most[] = {1, sizeof GLTF_OF("b.bin"), 1000};
    size_t size, directory;
    unsigned char *file = zip_file(bodies[1].entries, 2, &size, &directory);
    for (size_t i = 0; i < 3; i++) {
        struct zr_quick quick = {.image_pixels_max = 1, .node_visits_max = 10, .array_bytes_max = most[i]};
        const struct zr_request request = {.format = ZR_FORMAT_ZIP, .quick = &quick};
        struct reading *reading = read_request(request, file, size, zr_limits_default(), (size_t)1 << 28);
        assert_int_equal(reading->status, i == 2 ? ZR_OK : ZR_CANCELLED);
        assert_int_equal(quick.is_exceeded, i < 2);
        reading_free(reading);
    }
    const struct zr_cancel cancel = {.raised = true};
    const struct zr_request request = {.format = ZR_FORMAT_ZIP, .cancel = &cancel};
    struct reading *reading = read_request(request, file, size, zr_limits_default(), (size_t)1 << 28);
    assert_int_equal(reading->status, ZR_CANCELLED);
    reading_free(reading);
    free(file);
}

/* A change of a kept scene does not read the archive's bytes, which are gone. */
TEST(a_kept_archive_does_without_its_bytes)
{
    static const char scene[] =
        "{\"meshes\":[{\"positions\":{\"asset\":\"p.npy\"},\"faces\":[[0,1,2]]}],\"view\":{\"preset\":\"front\"}}";
    static const char change[] = "{\"window\":{\"width\":64,\"height\":48}}";
    size_t npy_size;
    char *npy = (char *)npy_file("<f4", "False", "(3, 3)", corners, sizeof corners, &npy_size);
    const struct zip_entry entries[] = {TEXT("s.json", scene), {"p.npy", npy, npy_size, false}};
    size_t size, directory;
    unsigned char *file = zip_file(entries, 2, &size, &directory);
    struct keeping *keeping = keep((struct zr_request){.format = ZR_FORMAT_UNKNOWN}, file, size);
    free(file);
    free(npy);
    assert_int_equal(keeping_change(keeping, (struct zr_request){.bytes = change, .size = sizeof change - 1}), ZR_OK);
    const struct zr_scene *made = keeping->scene;
    assert_int_equal(made->views[0].width, 64);
    assert_int_equal(made->meshes[0].face_count, 1);
    assert_int_equal(made->warning_count, 0);
    keeping_free(keeping);
}

RUN_TESTS(NULL, NULL)
