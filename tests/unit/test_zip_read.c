/* input/zip_read.h: reads valid archives, refuses others. input/zip_body.h: archives as bodies. input/file_parts.h:
 * files that a file refers to. */
#include "base/cancel.h"
#include "change.h"
#include "guarded.h"
#include "input/file_parts.h"
#include "input/json_scene.h"
#include "input/zip_read.h"
#include "input_check.h"
#include "support/npy.h"
#include "support/tests.h"
#include "support/zip_file.h"

enum { TEXT_SIZE = 100000, CEILING = 1 << 24 };

static char text[TEXT_SIZE];

struct opened {
    struct zr_arena arena;
    struct guarded file;
    struct zr_zip zip;
    struct zr_reason reason;
    enum zr_status status;
};

static void open_zip(struct opened *opened, const void *bytes, size_t size)
{
    memset(opened, 0, sizeof *opened);
    zr_arena_init(&opened->arena, CEILING);
    opened->file = guarded_copy(bytes, size);
    opened->status = zr_zip_open(&opened->arena, opened->file.bytes, size, &opened->zip, &opened->reason);
}

static void close_zip(struct opened *opened)
{
    guarded_free(&opened->file);
    zr_arena_free(&opened->arena);
}

static unsigned char *two_members(size_t *size, size_t *directory)
{
    for (size_t i = 0; i < TEXT_SIZE; i++)
        text[i] = (char)('a' + i * i % 23 % 26);
    const struct zip_entry entries[] = {{"dir/b.txt", text, TEXT_SIZE, true}, {"A.txt", "hello", 5, false}};
    return zip_file(entries, 2, size, directory);
}

TEST(members_are_found_by_name_and_read)
{
    size_t size, directory;
    unsigned char *file = two_members(&size, &directory);
    struct opened opened;
    const char *bytes;
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_OK);
    assert_int_equal(opened.zip.count, 2);
    const struct zr_zip_member *b = zr_zip_find(&opened.zip, "dir/b.txt", 9);
    const struct zr_zip_member *a = zr_zip_find(&opened.zip, "a.TXT", 5);
    assert_non_null(b);
    assert_non_null(a);
    assert_null(zr_zip_find(&opened.zip, "b.txt", 5));
    assert_int_equal(zr_zip_read(b, &opened.arena, &bytes, &opened.reason), ZR_OK);
    assert_int_equal(b->size, TEXT_SIZE);
    assert_memory_equal(bytes, text, TEXT_SIZE);
    assert_int_equal(zr_zip_read(a, &opened.arena, &bytes, &opened.reason), ZR_OK);
    assert_memory_equal(bytes, "hello", 5);
    close_zip(&opened);
    free(file);
}

/* Replaces bytes of an archive of two members. Offsets are from the directory if the first field is true. */
TEST(wrong_bytes_are_refused_with_their_reason)
{
    static const struct {
        bool in_directory;
        size_t offset;
        uint32_t value;
        int bytes;
        const char *reason;
    } cases[] = {
        {true, 8, 1, 2, "encrypted"},
        {true, 24, 99999, 4, "another size or method"},
        {true, 42, 4, 4, "local header is missing"},
        {true, 46, 0x2F2E2E, 3, "'..'"},
        {true, 46, '/', 1, "absolute"},
        {true, 46, '\\', 1, "backslash"},
        {true, 46, 1, 1, "control character"},
        {true, 46, 'e', 1, "another name"},
        {true, 42 + 55, 0, 4, "another name"},
        {true, 0, 0, 4, "cut off"},
        {false, 0, 0, 4, "local header is missing"},
        {false, 8, 0, 2, "another size or method"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size, directory;
        unsigned char *file = two_members(&size, &directory);
        zip_put(file + (cases[i].in_directory ? directory : 0) + cases[i].offset, cases[i].value, cases[i].bytes);
        struct opened opened;
        open_zip(&opened, file, size);
        if (opened.status != ZR_BAD_SYNTAX || !strstr(opened.reason.text, cases[i].reason))
            fail_msg("case %zu: status %d, %s", i, (int)opened.status, opened.reason.text);
        close_zip(&opened);
        free(file);
    }
}

TEST(duplicates_and_overlaps_are_refused)
{
    size_t size, directory;
    const struct zip_entry twice[] = {{"a", "1", 1, false}, {"a", "2", 1, false}};
    unsigned char *file = zip_file(twice, 2, &size, &directory);
    struct opened opened;
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_BAD_SYNTAX);
    assert_non_null(strstr(opened.reason.text, "'a': it occurs twice"));
    close_zip(&opened);
    zip_put(file + directory + 47 + 42, 0, 4); /* the second entry names the first member's header */
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_BAD_SYNTAX);
    assert_non_null(strstr(opened.reason.text, "overlaps"));
    close_zip(&opened);
    free(file);
}

/* Both headers have the same wrong size or checksum. */
TEST(members_that_are_not_as_the_directory_says_are_refused)
{
    static const struct {
        size_t local, central;
        uint32_t value;
        const char *reason;
    } cases[] = {{22, 24, TEXT_SIZE - 1, "more than the size"},
                 {22, 24, TEXT_SIZE + 1, "less than the size"},
                 {14, 16, 7, "checksum"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size, directory;
        const char *bytes;
        unsigned char *file = two_members(&size, &directory);
        zip_put(file + cases[i].local, cases[i].value, 4);
        zip_put(file + directory + cases[i].central, cases[i].value, 4);
        struct opened opened;
        open_zip(&opened, file, size);
        assert_int_equal(opened.status, ZR_OK);
        const struct zr_zip_member *member = zr_zip_find(&opened.zip, "dir/b.txt", 9);
        assert_int_equal(zr_zip_read(member, &opened.arena, &bytes, &opened.reason), ZR_BAD_SYNTAX);
        if (!strstr(opened.reason.text, cases[i].reason)) fail_msg("case %zu: %s", i, opened.reason.text);
        close_zip(&opened);
        free(file);
    }
}

TEST(bombs_are_foretold_by_the_directory)
{
    size_t size, directory;
    const char *bytes;
    char *zeros = calloc(CEILING, 2);
    const struct zip_entry entries[] = {{"zeros", zeros, 2 * (size_t)CEILING, true}};
    unsigned char *file = zip_file(entries, 1, &size, &directory);
    struct opened opened;
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_OK);
    assert_int_equal(zr_zip_read(opened.zip.members, &opened.arena, &bytes, &opened.reason), ZR_NO_MEMORY);
    close_zip(&opened);
    zip_put(file + 22, 0xFFFFFFF0, 4); /* more than the packed bytes can inflate to */
    zip_put(file + directory + 24, 0xFFFFFFF0, 4);
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_BAD_SYNTAX);
    assert_non_null(strstr(opened.reason.text, "do not add up"));
    close_zip(&opened);
    free(file);
    free(zeros);
}

TEST(archives_that_are_cut_off_are_refused)
{
    size_t size, directory;
    unsigned char *file = two_members(&size, &directory);
    for (size_t cut = 0; cut < size; cut += cut < 200 || size - cut < 200 ? 1 : 97) {
        struct opened opened;
        open_zip(&opened, file, cut);
        assert_int_equal(opened.status, ZR_BAD_SYNTAX);
        close_zip(&opened);
    }
    free(file);
}

TEST(a_raised_cancel_stops_inflating)
{
    size_t size, directory;
    const char *bytes;
    unsigned char *file = two_members(&size, &directory);
    struct opened opened;
    struct zr_cancel cancel = {.raised = true};
    open_zip(&opened, file, size);
    opened.arena.cancel = &cancel;
    assert_int_equal(zr_zip_read(&opened.zip.members[1], &opened.arena, &bytes, &opened.reason), ZR_CANCELLED);
    close_zip(&opened);
    free(file);
}

/* ---- files that a file refers to ---- */

TEST(references_find_parts)
{
    static const char *const names[] = {"scene.bin", "maps/Wood 1.png", "maps/leaf.png", "old/leaf.png",
                                        "a%20b",     "Rock.JPG",        "../up.png",     "deep/rock.jpg"};
    static const struct {
        const char *reference, *found; /* NULL: nothing */
    } cases[] = {{"scene.bin", "scene.bin"},
                 {"./scene.bin", "scene.bin"},
                 {"x/../scene.bin", "scene.bin"},
                 {"a%20b", "a%20b"},
                 {"maps/Wood%201.png", "maps/Wood 1.png"},
                 {"maps\\Wood 1.png", "maps/Wood 1.png"},
                 {"C:\\art\\maps\\wood 1.PNG", "maps/Wood 1.png"},
                 {"/home/me/Wood 1.png", "maps/Wood 1.png"},
                 {"MAPS/LEAF.png", "maps/leaf.png"},
                 {"leaf.png", NULL}, /* two have this name */
                 {"new/leaf.png", NULL},
                 {"old//leaf.png", "old/leaf.png"},
                 {"Rock.JPG", "Rock.JPG"},
                 {"tex/rock.jpg", "deep/rock.jpg"},
                 {"tex/ROCK.jpg", NULL},
                 {"../up.png", "../up.png"},
                 {"./../x/../up.png", "../up.png"},
                 {"bin", NULL},
                 {"", NULL},
                 {".", NULL},
                 {"%zz%0", NULL},
                 {"%00scene.bin", NULL}};
    struct zr_asset assets[8] = {{.name = NULL}};
    struct zr_arena arena;
    uint8_t uses[8] = {0};
    for (size_t i = 0; i < 8; i++)
        assets[i].name = names[i];
    struct zr_parsed_assets parsed = {.count = 8, .items = assets, .uses = uses};
    zr_arena_init(&arena, CEILING);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_asset *found = zr_file_part_find(&parsed, &arena, cases[i].reference);
        const char *name = found ? found->name : "", *wanted = cases[i].found ? cases[i].found : "";
        if (strcmp(name, wanted) != 0) fail_msg("'%s' finds '%s'", cases[i].reference, name);
        if (found) assert_true(uses[found - assets]);
    }
    zr_arena_free(&arena);
}

TEST(files_list_their_references)
{
    static const struct {
        const char *type, *text, *names; /* with a comma behind each */
    } cases[] = {
        {"gltf",
         "{\"buffers\":[{\"uri\":\"a b.bin\",\"name\":\"n\"}],\"images\":[{\"uri\":\"data:x\"},{\"uri\" : "
         "\"t\\u00e4\\/x.png\"}],\"nodes\":[{\"uri\":\"no\"}],\"extras\":{\"images\":[{\"uri\":\"no\"}]}}",
         "a b.bin,t\xC3\xA4/x.png,"},
        {"model/gltf+json", "{\"images\":[{\"uri\":\"https://x/y.png\"},{\"extras\":{\"uri\":\"no\"},\"uri\":\"y\"}]}",
         "y,"},
        {"gltf", "{\"images\":[{\"uri\":\"cut", ""},
        {"gltf", "{\"images\":[{\"uri\":\"\\ud800\"},{\"uri\":\"\\", ""},
        {NULL, "{\"asset\":{},\"buffers\":[{\"uri\":\"x\"}]}", "x,"},
        {"json", "{\"meshes\":[{\"asset\":\"m.glb\"}],\"base\":{\"asset\":\"sha256:0\"}}", "m.glb,"},
        {"obj", "mtllib a.mtl\nv 0 0 0\n  mtllib b.mtl\tc d.mtl \r\n# mtllib no\nmtllibx no\nmtllib",
         "a.mtl,b.mtl\tc d.mtl,b.mtl,c,d.mtl,"},
        {"model/obj", "v 0 0 0\rmtllib a.mtl\rv 1 1 1", "a.mtl,"},
        {"mtl",
         "newmtl x\nKd 1 1 1\nmap_Kd wood 1.png\n map_Ks -s 2 2 -o 0.5 s.png\nbump -bm 0.2 -clamp on b.png\n"
         "norm n.png\r\ndisp\nmap_d -mm 0 1 -imfchan r d.png\n#map_Kd no\nrefl -type sphere r.png\nmap_Kd C:\\x\\y.png",
         "wood 1.png,s.png,b.png,n.png,d.png,r.png,C:\\x\\y.png,"},
        {"stl", "solid mtllib x", ""}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char names[256], small[4];
        struct guarded bytes = guarded_copy(cases[i].text, strlen(cases[i].text));
        const size_t used = zr_references_list(bytes.bytes, strlen(cases[i].text), cases[i].type, names, sizeof names);
        assert_true(used < sizeof names);
        assert_int_equal(zr_references_list(bytes.bytes, strlen(cases[i].text), cases[i].type, small, sizeof small),
                         used);
        assert_int_equal(zr_references_list(bytes.bytes, strlen(cases[i].text), cases[i].type, NULL, 0), used);
        for (size_t k = 0; k < used; k++)
            if (names[k] == '\0') names[k] = ',';
        names[used] = '\0';
        if (strcmp(names, cases[i].names) != 0) fail_msg("case %zu: %s", i, names);
        guarded_free(&bytes);
    }
}

/* ---- archives as bodies ---- */

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
     "the ZIP archive has no 'a.obj'; its models: 'x/a.obj', 'y/a.obj'"},
    {{TEXT("a.dat", OBJ)}, "a.dat", ZR_OK, NULL},
    {{TEXT("a.dat", "?")}, "a.dat", ZR_BAD_SCENE, "in a.dat: the member has none of the formats"},
    {{TEXT("a.zip", "PK\3\4")}, "a.zip", ZR_BAD_SCENE, "a ZIP archive within a ZIP archive"},
    {{TEXT("a.fbx", "x")}, NULL, ZR_BAD_SCENE, "the ZIP archive has no model: no member ends with one of json, obj,"},
    {{TEXT("a.obj", "")}, NULL, ZR_BAD_SYNTAX, "in a.obj: the member is empty"},
    {{TEXT("a.obj", "v x\n")}, NULL, ZR_BAD_SYNTAX, "in 'a.obj': "},
    {{TEXT("a.obj", SCENE)}, NULL, ZR_BAD_SYNTAX, "the body is said to be OBJ, and looks like JSON"},
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
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_OBJ}, OBJ, sizeof OBJ - 1, 1 << 17) > 0);
    free(file);
    file = zip_file(bodies[2].entries, 2, &size, &directory);
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_ZIP}, file, size, 1 << 18) > 0);
    free(file);
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

/* The archive's bytes are gone when a kept scene is changed. */
TEST(a_kept_archive_does_without_its_bytes)
{
    static const char scene[] =
        "{\"meshes\":[{\"positions\":{\"asset\":\"p.npy\"},\"faces\":[[0,1,2]]}],\"view\":{\"preset\":\"front\"}}";
    static const char change[] = "{\"window\":{\"width\":64,\"height\":48}}";
    size_t npy_size;
    char *npy = (char *)npy_file("<f4", "False", "(3, 3)", corners, sizeof corners, &npy_size);
    const struct zip_entry entries[] = {TEXT("s.json", scene), {"p.npy", npy, npy_size, false}};
    const struct zr_limits limits = zr_limits_default();
    struct zr_request request = {.format = ZR_FORMAT_UNKNOWN};
    const struct zr_request changed = {.bytes = change, .size = sizeof change - 1};
    struct zr_arena arena, other;
    struct zr_error error = {0};
    struct zr_kept *kept;
    const struct zr_scene *made;
    size_t directory;
    unsigned char *file = zip_file(entries, 2, &request.size, &directory);
    request.bytes = (const char *)file;
    zr_arena_init(&arena, (size_t)1 << 26);
    zr_arena_init(&other, (size_t)1 << 26);
    const enum zr_status status = zr_scene_keep(&arena, NULL, &request, &limits, &kept, &error);
    if (status != ZR_OK) fail_msg("%s: %s", error.items[0].pointer, error.items[0].detail);
    free(file);
    free(npy);
    assert_int_equal(zr_scene_change(&other, NULL, kept, &changed, &made, &error), ZR_OK);
    assert_int_equal(made->views[0].width, 64);
    assert_int_equal(made->meshes[0].face_count, 1);
    assert_int_equal(made->warning_count, 0);
    zr_arena_free(&other);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
