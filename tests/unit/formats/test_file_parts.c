/* input/files/file_parts.h and zr_references_list: files that a file refers to. */
#include "core.h"
#include "input/files/file_parts.h"
#include "input/scene/json_scene.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

enum { CEILING = 1 << 24 };

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
        memset(uses, 0, sizeof uses);
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
        const char *type, *text, *names; /* each followed by a comma */
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

RUN_TESTS(NULL, NULL)
