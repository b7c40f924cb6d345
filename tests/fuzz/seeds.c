/* seeds FOLDER - writes what each target begins with into FOLDER/TARGET: small inputs of every kind, all of which are
 * accepted. Run it in the project's top folder: most scenes are those of tests/scenes, in small windows. */
#include <dirent.h>
#include <errno.h>
#include <png.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <webp/encode.h>
#include <zlib.h>

#include "fuzz/base.h"
#include "fuzz/seeds.h"
#include "support/files.h"
#include "support/input/base64.h"
#include "support/input/npy.h"
#include "support/pictures/jpeg.h"

enum { PATH_SIZE = 4096, FILE_MAX = 1 << 18 };

static const char *top;

void fail(const char *what)
{
    perror(what);
    exit(1);
}

static void make_folder(const char *name)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", top, name);
    if (mkdir(path, 0777) != 0 && errno != EEXIST) fail(path);
}

void write_seed(const char *target, const char *name, const void *bytes, size_t size)
{
    char path[PATH_SIZE];
    make_folder(target);
    snprintf(path, sizeof path, "%s/%s/%s", top, target, name);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) fail(path);
}

void write_texts(const char *target, const struct text *texts, size_t count)
{
    for (size_t i = 0; i < count; i++)
        write_seed(target, texts[i].name, texts[i].text, strlen(texts[i].text));
}

/* ---- JSON ---- */

static void write_scene_file(const char *name)
{
    char path[PATH_SIZE], in_window[FILE_MAX * 2];
    size_t size;
    snprintf(path, sizeof path, "tests/scenes/%s", name);
    char *scene = file_read(path, &size), *window = scene ? strstr(scene, "\"window\":") : NULL;
    char *behind = window ? strchr(window, '}') : NULL;
    if (!behind) fail(path);
    *window = '\0';
    snprintf(in_window, sizeof in_window, "%s\"window\": {\"width\": 48, \"height\": 36%s", scene, behind);
    write_seed("json", name, in_window, strlen(in_window));
    free(scene);
}

static void write_scene_files(void)
{
    struct dirent **entries;
    const int count = scandir("tests/scenes", &entries, NULL, alphasort);
    if (count < 0) fail("tests/scenes");
    for (int i = 0; i < count; i++) {
        if (strstr(entries[i]->d_name, ".json")) write_scene_file(entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
}

#define WINDOW   "\"window\":{\"width\":16,\"height\":9}"
#define TRIANGLE "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]"

#define TETRAHEDRON(name, x)                                                                                           \
    "{\"name\":\"" name "\",\"positions\":[[" x                                                                        \
    ",0,0],[1,0,0],[0,1,0],[0,0,1]],\"faces\":[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}"
#define TETRAHEDRA "\"meshes\":[" TETRAHEDRON("a", "0") "," TETRAHEDRON("b", "0.1") "],"

static void write_scenes(void)
{
    static const struct text texts[] = {
        {"outputs", "{" WINDOW "," TRIANGLE ",\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"depth\",\"encoding\":"
                    "\"png16\",\"scale\":0.5},{\"channel\":\"windowDepth\"},{\"channel\":\"faceId\"},{\"channel\":"
                    "\"info\"}]}"},
        {"flow",
         "{" WINDOW "," TETRAHEDRA
         "\"nodes\":[{\"name\":\"n\",\"mesh\":\"a\"},{\"mesh\":\"b\"}],\"outputs\":[{\"channel\":\"flow\",\"to\":{"
         "\"view\":{\"azimuthDegrees\":30,\"elevationDegrees\":20},\"poses\":{\"n\":[1,0,0,0,0,1,0,0,0,0,1,0,0.5,0,0,1]"
         "}}}]}"},
        {"nocs",
         "{" WINDOW "," TRIANGLE ",\"outputs\":[{\"channel\":\"position\",\"space\":\"nocs\",\"encoding\":\"png\"},"
         "{\"channel\":\"position\",\"space\":\"nocs\",\"encoding\":\"pfm\"}]}"},
        {"small-png", "{" WINDOW "," TRIANGLE ",\"background\":[0,0.5,1,0.25],\"ambient\":\"#20304050\",\"outline\":"
                      "\"#ff0000\",\"fill\":false}"},
        {"escapes", "{" WINDOW ",\"meshes\":[{\"name\":\"\\u00e9\\ud83d\\ude00\\n\",\"positions\":[[0,0,0],[1e0,0,-0.0]"
                    ",[0,1.5E+0,0]],\"faces\":[[0,1,2]]}],\"nodes\":[{\"name\":\"n\",\"mesh\":\"\\u00e9\\ud83d\\ude00"
                    "\\n\",\"scale\":[1,2,-1]}]}"},
        {"painter", "{" WINDOW ",\"algorithm\":\"painter\",\"polygons\":[{\"vertices\":[[0,0,0],[1,0,1],[0,1,0]]},"
                    "{\"vertices\":[[0,0,1],[1,0,0],[0,1,1]],\"color\":\"#cc3333\",\"doubleSided\":true}]}"},
        {"orbit", "{" WINDOW "," TRIANGLE ",\"view\":{\"azimuthDegrees\":30,\"elevationDegrees\":20,\"up\":[0,0,1],"
                  "\"fit\":{\"padding\":0.1},\"perspective\":{\"xfov\":0.5}}}"},
        {"corner",
         "{" WINDOW ",\"look\":\"technical\",\"edges\":{\"from\":\"mesh\",\"hiddenLines\":true}," TETRAHEDRA
         "\"sections\":{\"planes\":[{\"axis\":\"x\",\"fraction\":0.4,\"keep\":\"negative\"},{\"axis\":\"y\","
         "\"offset\":0.2,\"keep\":\"positive\"},{\"normal\":[1,2,-1],\"point\":[0.2,0.2,0.2]}],\"corner\":true,"
         "\"uncut\":[\"b\"]},\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"info\"}]}"},
        {"overlapping-caps",
         "{" WINDOW "," TETRAHEDRA "\"sections\":{\"planes\":[{\"axis\":\"z\",\"offset\":0.1},{\"normal\":"
         "[0,0,1],\"keep\":\"positive\"}],\"hatch\":false}}"},
        {"parts", "{" WINDOW "," TETRAHEDRA "\"look\":\"clay\",\"hide\":[\"b*\",2],\"ghost\":\"a\",\"highlight\":[{"
                  "\"parts\":[\"a\"],\"color\":\"#ff0000\"}],\"explode\":{\"factor\":0.5,\"axis\":\"z\"},\"colors\":"
                  "\"parts\",\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"info\"}]}"},
        {"blueprint-svg",
         "{" WINDOW ",\"look\":\"blueprint@1\"," TETRAHEDRA "\"isolate\":[\"a\",\"b\"],\"explode\":1,\"sections\":"
         "{\"planes\":[{\"axis\":\"x\"}]},\"edges\":{\"from\":\"mesh\",\"hiddenLines\":true},\"outputs\":[{"
         "\"channel\":\"color\",\"encoding\":\"svg\"}]}"},
        {"intrinsics", "{" WINDOW "," TRIANGLE ",\"view\":{\"R\":[1,0,0,0,1,0,0,0,1],\"t\":[0,0,4],\"intrinsics\":"
                       "{\"fx\":20,\"cx\":8,\"skew\":0.1},\"pixelCenter\":0,\"znear\":1,\"zfar\":10}}"},
        {"lens", "{" WINDOW "," TRIANGLE ",\"view\":{\"eye\":[0,0,4],\"target\":[0,0,0],\"intrinsics\":{\"fx\":20},"
                 "\"distortion\":{\"model\":\"opencv\",\"k\":[-0.3,0.1,0,0.2,0,0.1],\"p\":[0.01,-0.02]}},\"outputs\":["
                 "{\"channel\":\"color\"},{\"channel\":\"position\"},{\"channel\":\"fragments\",\"x\":3,\"y\":2}]}"},
        {"fisheye", "{" WINDOW "," TRIANGLE ",\"view\":{\"eye\":[0,0,4],\"target\":[0,0,0],\"perspective\":"
                    "{\"yfovDegrees\":60},\"distortion\":{\"model\":\"fisheye\",\"k\":[0.1,-0.2]}},\"look\":\"clay\"}"},
        {"lens-list", "{" WINDOW "," TRIANGLE ",\"view\":{\"eye\":[0,0,4],\"target\":[0,0,0],\"distortion\":"
                      "[-0.3,0.1,0,0.01,0.02]}}"},
        {"svg", "{" WINDOW "," TRIANGLE ",\"edges\":{\"from\":\"mesh\",\"hiddenLines\":true,\"creaseDegrees\":20,"
                "\"width\":2},\"outputs\":[{\"channel\":\"color\",\"encoding\":\"svg\"},{\"channel\":\"color\"}]}"},
        {"views",
         "{" WINDOW "," TETRAHEDRA "\"nodes\":[{\"name\":\"n\",\"mesh\":\"a\"}],\"views\":[\"front\",{\"name\":"
         "\"moved\",\"view\":{\"azimuthDegrees\":30,\"elevationDegrees\":20},\"poses\":{\"n\":[1,0,0,0,0,1,0,0,"
         "0,0,1,0,0,0,1,1]}},{\"window\":{\"width\":9,\"height\":8},\"look\":\"clay\",\"background\":\"#203040\"}]}"},
        {"turntable",
         "{" WINDOW "," TRIANGLE ",\"turntable\":{\"frames\":3,\"elevation\":25,\"seconds\":2},\"outputs\":["
         "{\"channel\":\"color\",\"encoding\":\"apng\"},{\"channel\":\"depth\"}]}"},
        {"turntable-webp",
         "{" WINDOW "," TRIANGLE ",\"background\":\"#1020\",\"turntable\":{\"frames\":2,\"seconds\":0.02},\"outputs\":["
         "{\"channel\":\"color\",\"encoding\":\"webp\",\"lossless\":true}]}"},
        {"sheet", "{\"window\":{\"width\":48,\"height\":48}," TRIANGLE ",\"sheet\":{\"layout\":\"threeView\",\"angle\":"
                  "\"first\",\"captions\":false},\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"info\"}]}"},
        {"animate",
         "{" WINDOW "," TETRAHEDRA "\"nodes\":[{\"name\":\"n\",\"mesh\":\"a\",\"scale\":[1,2,1],\"children\":[\"m\"]},"
         "{\"name\":\"m\",\"mesh\":\"b\"}],\"animate\":{\"frames\":3,\"seconds\":2,\"nodes\":{\"n\":{\"rotate\":{"
         "\"axis\":"
         "[0,1,1],\"degrees\":90}},\"m\":{\"times\":[0.5,1],\"translation\":[[0,0,0],[1,0,0]],\"rotation\":[[0,0,0,1],"
         "[0,0,1,1]],\"scale\":[[1,1,1],[2,1,1]],\"interpolation\":\"step\",\"rotate\":{\"axis\":\"x\"}}}}}"},
        {"masks", "{" WINDOW ",\"visibility\":true,\"features\":true," TETRAHEDRA
                  "\"materials\":[{\"name\":\"m\",\"alphaMode\":\"MASK\"}],"
                  "\"outputs\":[{\"channel\":\"info\"},{\"channel\":\"masks\"},{\"channel\":\"masks\",\"encoding\":"
                  "\"json\"}]}"},
        {"trace", "{" WINDOW "," TRIANGLE ",\"algorithm\":\"trapezoid\",\"outputs\":[{\"channel\":\"trace\"}]}"},
        {"trace-painter", "{" WINDOW "," TETRAHEDRA
                          "\"algorithm\":\"painter\",\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"trace\"}]}"},
        {"orbit-of-views",
         "{" WINDOW "," TRIANGLE ",\"orbit\":{\"count\":4,\"distance\":3},\"view\":{\"perspective\":{\"yfov\":0.6}}}"},
    };
    write_scene_files();
    WRITE_TEXTS("json", texts);
    float depths[BASE_PIXELS] = {0.5f, 1, 0.25f};
    char z[NPY_BYTES];
    base_npy(z, "<f4", depths);
    char *uri = base64_of("data:;base64,", z, sizeof z), scene[2 * FILE_MAX];
    if (!uri) fail("base64");
    snprintf(scene, sizeof scene, BASE_SCENE("\"windowDepth\":{\"uri\":\"%s\"},\"ties\":\"scene\"", "%s"), uri,
             "{\"channel\":\"windowDepth\"}");
    write_seed("json", "base", scene, strlen(scene));
    free(uri);
}

/* ---- pictures ---- */

struct file {
    unsigned char bytes[FILE_MAX];
    size_t size;
};

static void append(png_structp png, png_bytep bytes, size_t size)
{
    struct file *file = png_get_io_ptr(png);
    if (file->size + size > FILE_MAX) png_error(png, "no room");
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

static void write_png(int color, int bits, int interlace, bool key)
{
    static struct file file;
    static png_byte samples[BASE_WIDTH * 4 * 2];
    const png_color palette[4] = {{1, 2, 3}, {200, 100, 50}, {255, 0, 128}, {7, 7, 7}};
    const png_byte alphas[2] = {255, 77};
    const png_color_16 color_key = {.red = 0, .green = 1, .blue = 2, .gray = 1};
    png_bytep rows[BASE_HEIGHT] = {samples, samples, samples};
    for (size_t i = 0; i < sizeof samples; i++)
        samples[i] = (png_byte)(color == PNG_COLOR_TYPE_PALETTE ? i & 1 : i);
    file.size = 0;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, append, NULL);
    png_set_IHDR(png, info, BASE_WIDTH, BASE_HEIGHT, bits, color, interlace, 0, 0);
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, bits == 1 ? 2 : 4);
    if (key) png_set_tRNS(png, info, alphas, 2, &color_key);
    png_set_gAMA(png, info, 1.0);
    png_write_info(png, info);
    png_write_image(png, rows);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    char name[64];
    snprintf(name, sizeof name, "color%d-bits%d-interlace%d-key%d", color, bits, interlace, key);
    if (bits <= 8) write_seed("png", name, file.bytes, file.size);
    write_seed("image_png", name, file.bytes, file.size);
}

static void write_jpegs(void)
{
    uint8_t pixels[BASE_PIXELS * 3];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(i * 13);
    for (int i = 0; i < 16; i++) {
        const struct jpeg_kind kind = {.colors = i % 4 ? JPEG_YCBCR : JPEG_GREY,
                                       .across = i % 4 < 2 ? 1 : 2,
                                       .down = i % 4 < 3 ? 1 : 2,
                                       .is_progressive = i & 4,
                                       .restart_rows = i > 11,
                                       .is_arithmetic = i & 8,
                                       .quality = 40 + i};
        char name[32];
        size_t size;
        uint8_t *bytes = jpeg_memory_write(&kind, pixels, BASE_WIDTH, BASE_HEIGHT, &size);
        if (!bytes) fail("a JPEG");
        snprintf(name, sizeof name, "kind%d", i);
        write_seed("jpeg", name, bytes, size);
        free(bytes);
    }
}

static void write_pictures(void)
{
    for (int interlace = 0; interlace < 2; interlace++)
        for (int key = 0; key < 2; key++) {
            write_png(PNG_COLOR_TYPE_RGB, 8, interlace, key);
            write_png(PNG_COLOR_TYPE_RGB, 16, interlace, key);
            write_png(PNG_COLOR_TYPE_GRAY, 16, interlace, key);
            for (int bits = 1; bits <= 8; bits *= 2) {
                write_png(PNG_COLOR_TYPE_GRAY, bits, interlace, key);
                write_png(PNG_COLOR_TYPE_PALETTE, bits, interlace, key);
            }
            if (key) continue;
            write_png(PNG_COLOR_TYPE_RGB_ALPHA, 8, interlace, key);
            write_png(PNG_COLOR_TYPE_GRAY_ALPHA, 8, interlace, key);
            write_png(PNG_COLOR_TYPE_RGB_ALPHA, 16, interlace, key);
            write_png(PNG_COLOR_TYPE_GRAY_ALPHA, 16, interlace, key);
        }
    char npy[NPY_BYTES];
    static const float depths[BASE_PIXELS] = {0.5f, 1, 0.25f};
    static const uint32_t big_ones[BASE_PIXELS] = {0x0000803f}, ids[BASE_PIXELS] = {7, 7, 3};
    base_npy(npy, "<f4", depths);
    write_seed("npy", "float32", npy, sizeof npy);
    base_npy(npy, ">f4", big_ones);
    write_seed("npy", "float32-big-endian", npy, sizeof npy);
    base_npy(npy, "<u4", ids);
    write_seed("npy", "uint32", npy, sizeof npy);
    /* Versions 2 and 3 have four bytes of length: two spaces fewer. */
    for (char version = 2; version <= 3; version++) {
        char longer[NPY_BYTES + 2] = "\x93NUMPY", name[] = "version-0";
        memcpy(longer + 6, (char[]){version, 0, 0x76, 0, 0, 0}, 6);
        memcpy(longer + 12, npy + 10, NPY_BYTES - 10);
        name[8] = (char)('0' + version);
        write_seed("npy", name, longer, sizeof longer);
    }
}

static void write_array(const char *type, const char *shape, const void *numbers, size_t bytes)
{
    size_t size;
    char name[64], *file = npy_file(type, "False", shape, numbers, bytes, &size);
    if (!file) fail("an array");
    snprintf(name, sizeof name, "%s-%s", type + 1, shape);
    write_seed("array", name, file, size);
    free(file);
}

static void write_arrays(void)
{
    static const float points[16] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0.5f, 1};
    static const double heights[6] = {0, 1, 2, 3, 1e-3, 5};
    static const uint32_t faces[6] = {0, 1, 2, 1, 3, 2};
    static const long long lines[4] = {0, 1, 2, 3};
    static const unsigned char colors[16] = {255, 0, 128, 255, 1, 2, 3, 4};
    write_array("<f4", "(4, 3)", points, 48);
    write_array("<f4", "(4, 4)", points, 64);
    write_array("<f8", "(2, 3)", heights, sizeof heights);
    write_array("<u4", "(2, 3)", faces, sizeof faces);
    write_array("<i4", "(3,)", faces, 12);
    write_array("<i8", "(2, 2)", lines, sizeof lines);
    write_array("<u8", "(4,)", lines, sizeof lines);
    write_array("|u1", "(4, 4)", colors, sizeof colors);
}

/* ---- WebP ---- */

static void write_webps(void)
{
    uint8_t pixels[4 * 24 * 16];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(i * i / 50);
    for (int kind = 0; kind < 4; kind++) { /* bit 0: lossless; bit 1: opaque */
        static const char *const names[] = {"lossy", "lossless", "lossy_opaque", "lossless_opaque"};
        uint8_t *file = NULL;
        for (size_t i = 3; kind & 2 && i < sizeof pixels; i += 4)
            pixels[i] = 255;
        const size_t size = kind & 1 ? WebPEncodeLosslessRGBA(pixels, 24, 16, 4 * 24, &file)
                                     : WebPEncodeRGBA(pixels, 24, 16, 4 * 24, 70, &file);
        if (size == 0) fail("a WebP");
        write_seed("webp", names[kind], file, size);
        WebPFree(file);
    }
}

/* ---- bodies ---- */

static void write_zip_body(void)
{
    static const char obj[] = "x/a.obj\0mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\xFFx/a b.mtl\0newmtl m\n"
                              "map_Kd -s 1 1 t.png\n\xFF__MACOSX/a.obj\0\xFFreadme.txt\0text";
    static const char scene[] = "s.json\0{" WINDOW "," TRIANGLE "}";
    write_seed("zip_body", "obj", obj, sizeof obj - 1);
    write_seed("zip_body", "scene", scene, sizeof scene - 1);
    static const char head[] = "a/b.gltf";
    static const char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
        "{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"../c%20/"
        "b.bin\"}]}"
        "\xFF"
        "c /b.bin";
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    char all[sizeof head + sizeof gltf + sizeof corners], *end = mempcpy(all, head, sizeof head);
    end = mempcpy(end, gltf, sizeof gltf);
    memcpy(end, corners, sizeof corners);
    write_seed("zip_body", "gltf", all, sizeof all);
}

static void write_gzip(const char *name, const char *text, size_t size, int level)
{
    char path[PATH_SIZE], mode[] = "wb0";
    make_folder("gzip");
    snprintf(path, sizeof path, "%s/gzip/%s", top, name);
    mode[2] = (char)('0' + level);
    gzFile file = gzopen(path, mode);
    if (!file || gzwrite(file, text, (unsigned)size) != (int)size || gzclose(file) != Z_OK) fail(path);
}

static void write_bodies(void)
{
    static char zeros[100000];
    write_gzip("empty", "", 0, 6);
    write_gzip("text", "{" WINDOW "," TRIANGLE "}", sizeof "{" WINDOW "," TRIANGLE "}" - 1, 9);
    write_gzip("stored", "abcabcabc", 9, 0);
    write_gzip("zeros", zeros, sizeof zeros, 9);
    static const struct text multiparts[] = {
        {"scene", "multipart/form-data; boundary=b\n--b\r\nContent-Disposition: form-data; name=\"scene\"\r\n"
                  "Content-Type: application/json\r\n\r\n{}\r\n--b\r\nContent-Disposition: form-data; name=z; "
                  "filename=\"C:\\a \\\"b\\\"\"\r\nContent-Transfer-Encoding: binary\r\n\r\n\r\n--b--\r\n"},
        {"quoted",
         "multipart/form-data; charset=utf-8; boundary=\"a b'()+_,-./:=?c\"\npreamble\r\n--a b'()+_,-./:=?c \t"
         "\r\ncontent-disposition:form-data;name=\"x\"\r\n\r\n--a b\r\n--a b'()+_,-./:=?c--epilogue"},
    };
    WRITE_TEXTS("multipart", multiparts);
    static const struct text proxies[] = {
        {"v1-four", "pPROXY TCP4 192.0.2.1 10.0.0.1 56324 443\r\n"},
        {"v1-six", "pPROXY TCP6 2001:db8::1 ::1 56324 443\r\n"},
        {"v1-unknown", "pPROXY UNKNOWN\r\n"},
        {"forwarded", "ffor=\"[2001:db8::1]:4711\";proto=https, For=192.0.2.1;by=\"a,b\", for=10.0.0.2"},
        {"x-forwarded-for", "x1.1.1.1, 192.0.2.1:80, [2001:db8::1]:80, 10.0.0.2"},
        {"traceparent", "t00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01"},
        {"later-traceparent", "tcc-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01-more"},
    };
    WRITE_TEXTS("proxy", proxies);
    static const char binary[] =
        "p\r\n\r\n\0\r\nQUIT\n\x21\x11\x00\x0f\xc0\x00\x02\x01\x0a\x00\x00\x01\xdc\x04\x01\xbb\x04\x00";
    write_seed("proxy", "v2-four", binary, sizeof binary);
}

#define MCP_CALL(tool, arguments)                                                                                      \
    "{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"tools/call\",\"params\":{\"name\":\"" tool                             \
    "\",\"arguments\":" arguments "}}"

static void write_messages(void)
{
    static const struct text messages[] = {
        {"initialize", "{\"jsonrpc\":\"2.0\",\"id\":\"a\",\"method\":\"initialize\",\"params\":{\"protocolVersion\":"
                       "\"2025-06-18\"}}"},
        {"list", "{\"jsonrpc\":\"2.0\",\"id\":2,\"method\":\"tools/list\",\"params\":{\"_meta\":{"
                 "\"io.modelcontextprotocol/protocolVersion\":\"2026-07-28\","
                 "\"io.modelcontextprotocol/clientCapabilities\":{}}}}"},
        {"cancelled", "{\"jsonrpc\":\"2.0\",\"method\":\"notifications/cancelled\",\"params\":{\"requestId\":1}}"},
        {"render", MCP_CALL("render", "{\"model\":{\"base64\":\"AAECAwQ=\"},\"views\":[\"front\",{\"view\":{}}],"
                                      "\"parts\":{\"hide\":[\"a\"]},\"annotate\":false}")},
        {"scene",
         MCP_CALL("render", "{\"scene\":{\"polygons\":[],\"views\":[\"top\",{}],\"window\":{\"width\":3000}}}")},
        {"facts", MCP_CALL("facts", "{\"model\":{\"text\":\"v 0 0\\n\\ud83d\\ude00\"}}")},
        {"pick", MCP_CALL("pick", "{\"model\":{\"text\":\"v\"},\"sheet\":\"threeView\",\"x\":1,\"y\":2}")},
    };
    WRITE_TEXTS("mcp", messages);
}

/* The first byte is the number of the body. */
static void write_queries(void)
{
    static const struct text queries[] = {
        {"plain", "0"},
        {"look", "0look=technical&channel=color&encoding=svg&background=%23ff0000&color=red"},
        {"sheet", "0preset=front&shading=flat&width=40&height=20&padding=0.1&projection=orthographic"},
        {"parts", "0hide=b&highlight=a&explode=0.5&edges=1&samples=4&lightDirection=0,0,-1&shadows=true"},
        {"isolate", "0isolate=a&ghost=*&section=x:0.2&up=z&channel=info,depth"},
        {"turntable", "0turntable=3&encoding=webp&quality=50&width=32&height=32"},
        {"camera", "0eye=3,2,4&target=0,0,0&dpi=300&colors=z&exposure=0.5"},
        {"points", "1look=studio&colors=z&views=top,front&outline=%23123456"},
        {"scene", "2channel=depth&encoding=npy"},
    };
    WRITE_TEXTS("query", queries);
}

int main(int count, char **arguments)
{
    if (count != 2) {
        fprintf(stderr, "usage: seeds FOLDER\n");
        return 2;
    }
    top = arguments[1];
    make_folder("");
    write_scenes();
    write_models();
    write_draco();
    write_pictures();
    write_jpegs();
    write_arrays();
    write_zip_body();
    write_webps();
    write_bodies();
    write_messages();
    write_queries();
    return 0;
}
