#include "support/random_scenes.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/text/names.h"
#include "scene/shadings.h"
#include "support/random.h"

enum { TEXT_SIZE = 1 << 17, MESHES = 4, SAMPLES_MOST = 150000 };

static char text[TEXT_SIZE];
static int length;
static struct random dice;
static bool is_textbook; /* nothing in the scene needs linear light */
static bool is_painted;  /* by an algorithm that keeps no fragments */
static bool has_xrays;   /* which need some */

#define PICK(list) ((list)[random_below(&dice, sizeof(list) / sizeof *(list))])

__attribute__((format(printf, 1, 2))) static void add(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    length += vsnprintf(text + length, (size_t)(TEXT_SIZE - length), format, arguments);
    va_end(arguments);
    if (length >= TEXT_SIZE) abort();
}

/* One time out of `n`. */
static bool once_in(uint32_t n)
{
    return random_below(&dice, n) == 0;
}

static double between(double low, double high)
{
    return random_range(&dice, low, high);
}

static const char *truth(void)
{
    return once_in(2) ? "true" : "false";
}

/* Calls that draw numbers never stand beside one another in arguments: compilers differ in their order. */
static uint32_t color(void)
{
    return random_below(&dice, 1 << 24);
}

static void add_vector(double size)
{
    const double x = between(-size, size), y = between(-size, size), z = between(-size, size);
    add("[%.6g,%.6g,%.6g]", x, y, z);
}

/* ---- the picture ---- */

static void add_window(uint32_t side)
{
    const uint32_t most = SAMPLES_MOST / (side * side);
    uint32_t width = 1 + random_below(&dice, once_in(3) ? 9 : 150);
    uint32_t height = 1 + random_below(&dice, once_in(3) ? 9 : 130);
    if (once_in(12)) width = most / 8 < 2000 ? most / 8 : 2000, height = 1 + random_below(&dice, 4);
    if (width > most) width = most;
    if (height > most / width) height = most / width;
    add("\"window\":{\"width\":%u,\"height\":%u}", width, height);
}

/* Any number of samples has its turn. */
static void add_size(void)
{
    static const uint32_t sides[] = {1, 2, 2, 4, 4, 8};
    const uint32_t side = PICK(sides);
    add_window(side);
    if (side != 4 || once_in(2)) add(",\"samples\":%u", side * side);
}

static void add_background(void)
{
    const uint32_t kind = random_below(&dice, is_textbook ? 2 : 3);
    const uint32_t second = kind == 1 ? random_below(&dice, 256) : kind == 2 ? color() : 0, first = color();
    if (kind == 0) add(",\"background\":\"#%06x\"", first);
    if (kind == 1) add(",\"background\":\"#%06x%02x\"", first, second);
    if (kind == 2) add(",\"background\":{\"top\":\"#%06x\",\"bottom\":\"#%06x\"}", first, second);
}

static void add_environment(void)
{
    static const char *const names[] = {"studio", "outdoor"}, *const frames[] = {"camera", "world"};
    if (once_in(4)) {
        add(",\"environment\":false");
        return;
    }
    const char *name = PICK(names), *frame = PICK(frames);
    const double intensity = once_in(5) ? 0.0 : between(0.2, 3.0), degrees = between(-400.0, 400.0);
    add(",\"environment\":{\"name\":\"%s\",\"frame\":\"%s\",\"intensity\":%.6g,\"rotationDegrees\":%.6g}", name, frame,
        intensity, degrees);
}

static void add_occlusion(void)
{
    if (once_in(3))
        add(",\"occlusion\":%s", truth());
    else {
        const double radius = once_in(5) ? between(1.0, 10.0) : between(0.001, 0.5), strength = between(0.0, 10.0);
        add(",\"occlusion\":{\"radius\":%.6g,\"strength\":%.6g}", radius, strength);
    }
}

static void add_edges(void)
{
    if (once_in(3))
        add(",\"edges\":%s", truth());
    else {
        const double width = once_in(6) ? between(5.0, 64.0) : between(0.1, 4.0), degrees = between(0.0, 180.0);
        add(",\"edges\":{\"color\":\"#%06x\",\"width\":%.6g,\"creaseDegrees\":%.6g}", color(), width, degrees);
    }
}

static void add_tone(void)
{
    static const char *const tones[] = {"none", "khronos-neutral", "neutral"};
    add(",\"toneMapping\":\"%s\"", PICK(tones));
    if (once_in(2)) add(",\"exposure\":%.6g", once_in(8) ? 1e6 : between(0.0, 4.0));
}

static void add_lines(void)
{
    if (once_in(2))
        add(",\"outline\":%s", truth());
    else
        add(",\"outline\":\"#%06x\"", color());
    add(",\"lineWidth\":%.6g", once_in(6) ? between(4.0, 64.0) : between(0.1, 4.0));
}

static void add_fog(void)
{
    const double near = between(0.1, 2.0), far = between(3.0, 9.0);
    add(",\"fog\":{\"color\":\"#%06x\",\"near\":%.6g,\"far\":%.6g}", color(), near, far);
}

static const char *shading(void)
{
    int allowed[ZR_SHADING_COUNT], count = 0;
    for (int i = 0; i < ZR_SHADING_COUNT; i++) {
        const enum zr_shading shading = (enum zr_shading)i;
        if (is_textbook && zr_shading_is_linear(shading)) continue;
        if (is_painted && zr_shading_is_layered(shading)) continue;
        allowed[count++] = i;
    }
    const int picked = allowed[random_below(&dice, (uint32_t)count)];
    has_xrays |= zr_shading_is_layered((enum zr_shading)picked);
    return zr_shading_names.words[picked];
}

/* Keys of looks, which some scenes override. */
static void add_keys(void)
{
    static const char *const ups[] = {"y", "z"};
    static const char *const algorithms[] = {"edgelist", "trapezoid", "scanline", "painter"};
    is_painted = false; /* so far */
    if (once_in(3)) add_background();
    if (once_in(3)) add(",\"up\":\"%s\"", PICK(ups));
    if (once_in(3)) add(",\"shading\":\"%s\"", shading());
    if (once_in(4)) add_lines();
    if (is_textbook && once_in(3)) add_fog();
    if (!is_textbook) {
        if (once_in(3)) add_environment();
        if (once_in(3)) add_tone();
        if (once_in(2)) add_occlusion();
        if (once_in(2)) add_edges();
        if (once_in(2)) add(",\"groundShadow\":%s", truth());
        if (once_in(2)) add(",\"creaseDegrees\":%.6g", once_in(4) ? 180.0 : between(0.0, 90.0));
    }
    if (once_in(8)) {
        const char *algorithm = has_xrays ? algorithms[random_below(&dice, 3)] : PICK(algorithms);
        is_painted = strcmp(algorithm, "painter") == 0;
        add(",\"algorithm\":\"%s\"", algorithm);
    }
}

/* Up to its frame. */
static void add_placed_lamp(void)
{
    const bool is_spot = once_in(2);
    add("{\"type\":\"%s\",\"color\":\"#%06x\",\"position\":", is_spot ? "spot" : "point", color());
    add_vector(3.0);
    if (once_in(2)) add(",\"range\":%.6g", between(0.1, 8.0));
    if (!is_spot) return;
    const double outer = between(1.0, 80.0), inner = between(0.0, 0.9) * outer;
    const bool casts = !is_textbook && !once_in(4);
    add(",\"shadows\":%s,\"outerConeAngleDegrees\":%.6g,\"innerConeAngleDegrees\":%.6g,\"direction\":",
        casts ? "true" : "false", outer, inner);
    add_vector(1.0);
}

static void add_lamp(void)
{
    static const char *const frames[] = {"camera", "world"};
    const char *frame = PICK(frames);
    const double intensity = between(0.0, 2.0);
    if (!is_textbook && once_in(3)) {
        const uint32_t ground = color(), sky = color();
        add("{\"type\":\"hemisphere\",\"sky\":\"#%06x\",\"ground\":\"#%06x\",\"up\":", sky, ground);
        add_vector(1.0);
    } else if (once_in(3)) {
        add_placed_lamp();
    } else {
        const bool casts = !is_textbook && !once_in(4);
        add("{\"type\":\"directional\",\"color\":\"#%06x\",\"shadows\":%s,\"direction\":", color(),
            casts ? "true" : "false");
        add_vector(1.0);
    }
    add(",\"frame\":\"%s\",\"intensity\":%.6g}", frame, intensity);
}

static void add_lamps(void)
{
    if (once_in(4)) add(",\"ambient\":\"#%06x\"", color());
    if (once_in(3)) return;
    const uint32_t count = random_below(&dice, 4);
    add(",\"lights\":[");
    for (uint32_t i = 0; i < count; i++) {
        if (i > 0) add(",");
        add_lamp();
    }
    add("]");
}

/* ---- materials and meshes ---- */

static double share(void)
{
    return once_in(4) ? (double)random_below(&dice, 2) : between(0.0, 1.0);
}

static void add_materials(void)
{
    add(",\"materials\":[");
    for (int i = 0; i < MESHES; i++) {
        const double metallic = share(), rough = share();
        add("%s{\"name\":\"m%d\"", i > 0 ? "," : "", i);
        if (once_in(4) && !is_painted) {
            const uint32_t opacity = random_below(&dice, 256), rgb = color();
            const char *mode = once_in(3) ? "MASK" : "BLEND";
            add(",\"alphaMode\":\"%s\",\"baseColorFactor\":\"#%06x%02x\"", mode, rgb, opacity);
        } else if (once_in(2)) {
            add(",\"baseColorFactor\":\"#%06x\"", color());
        }
        if (!is_textbook) {
            if (once_in(2)) add(",\"metallicFactor\":%.6g,\"roughnessFactor\":%.6g", metallic, rough);
            if (once_in(6)) add(",\"emissiveFactor\":[%.6g,0,0.5]", between(0.0, 3.0));
            if (once_in(3)) add(",\"cool\":\"#%06x\"", color());
        }
        if (once_in(3)) {
            const double shininess = between(0.0, 200.0);
            add(",\"specular\":\"#%06x\",\"shininess\":%.6g", color(), shininess);
        }
        if (once_in(2)) add(",\"shading\":\"%s\"", shading());
        add(",\"doubleSided\":%s}", truth());
    }
    add("]");
}

static void add_colors(const char *key, int count)
{
    add(",\"%s\":[", key);
    for (int i = 0; i < count; i++)
        add("%s\"#%06x\"", i > 0 ? "," : "", color());
    add("]");
}

static void add_normals(int count)
{
    add(",\"normals\":[");
    for (int i = 0; i < count; i++) {
        if (i > 0) add(",");
        add_vector(1.0);
    }
    add("]");
}

/* A box whose corners are not quite where they should be, so that its faces bend. */
static int add_box(void)
{
    const double size = between(0.3, 1.2), bend = once_in(2) ? 0.0 : 0.2;
    add("\"positions\":[");
    for (int i = 0; i < 8; i++) {
        const double x = i & 4 ? size : -size, y = i & 2 ? size : -size, z = i & 1 ? size : -size;
        const double dx = between(-bend, bend), dy = between(-bend, bend), dz = between(-bend, bend);
        add("%s[%.6g,%.6g,%.6g]", i > 0 ? "," : "", x + dx, y + dy, z + dz);
    }
    add("],\"faces\":[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]],\"lines\":[[0,7],[1,6]]");
    if (once_in(3)) add(",\"points\":[7,0,3,2,5,5],\"pointSize\":%.6g", once_in(4) ? 64.0 : between(1.0, 9.0));
    return 8;
}

/* A pipe with lids, of a few sides or many: some are round, some have corners. */
static int add_pipe(void)
{
    const int sides = 3 + (int)random_below(&dice, 22);
    const double radius = between(0.2, 0.9), height = between(0.1, 1.5), cone = once_in(3) ? between(0.0, 1.0) : 1.0;
    add("\"positions\":[");
    for (int i = 0; i < 2 * sides; i++) {
        const double angle = 6.283185307179586 * (i / 2) / sides, r = i % 2 ? radius * cone : radius;
        add("%s[%.6g,%.6g,%.6g]", i > 0 ? "," : "", r * cos(angle), i % 2 ? height : -height, r * sin(angle));
    }
    add("],\"faces\":[");
    for (int i = 0; i < sides; i++)
        add("[%d,%d,%d,%d],", 2 * i, 2 * i + 1, (2 * i + 3) % (2 * sides), (2 * i + 2) % (2 * sides));
    for (int i = 0; i < sides; i++)
        add("%s%d", i > 0 ? "," : "[", 2 * i);
    for (int i = sides; i-- > 0;)
        add("%s%d", i < sides - 1 ? "," : "],[", 2 * i + 1);
    add("]]");
    return 2 * sides;
}

static int add_soup(void)
{
    const int faces = 1 + (int)random_below(&dice, 40);
    const double size = once_in(2) ? 0.2 : 1.2;
    add("\"positions\":[");
    for (int i = 0; i < faces; i++) {
        const double x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(-1.0, 1.0);
        for (int k = 0; k < 4; k++) {
            const double dx = between(-size, size), dy = between(-size, size), dz = between(-size, size);
            add("%s[%.6g,%.6g,%.6g]", i + k > 0 ? "," : "", x + dx, y + dy, z + dz);
        }
    }
    add("],\"faces\":[");
    for (int i = 0; i < faces; i++) {
        add("%s[%d,%d,%d", i > 0 ? "," : "", 4 * i, 4 * i + 1, 4 * i + 2);
        add(once_in(3) ? ",%d]" : "]", 4 * i + 3);
    }
    add("]");
    if (once_in(4)) add_colors("faceColors", faces);
    return 4 * faces;
}

/* A hilly ground; few of its cells have holes. */
static int add_heights(void)
{
    const int columns = 2 + (int)random_below(&dice, 10), rows = 2 + (int)random_below(&dice, 10);
    const double top = between(0.0, 0.6);
    add("\"heights\":{\"x\":[-1.5,1.5],\"y\":[-1.5,1.5],\"values\":[");
    for (int y = 0; y < rows; y++) {
        for (int x = 0; x < columns; x++) {
            add("%s", x > 0 ? "," : y > 0 ? ",[" : "[");
            if (y > 1 && once_in(20))
                add("null");
            else
                add("%.6g", between(0.0, top));
        }
        add("]");
    }
    add("]}");
    return columns * rows;
}

static void add_mesh(int number)
{
    static int (*const kinds[])(void) = {add_box, add_pipe, add_pipe, add_soup, add_heights};
    add("%s{\"name\":\"b%d\",", number > 0 ? "," : "", number);
    const int points = PICK(kinds)();
    if (once_in(4)) add_normals(points);
    if (once_in(5)) add_colors("colors", points);
    if (once_in(2)) add(",\"material\":\"m%d\"", number);
    if (once_in(2)) add(",\"doubleSided\":true");
    if (once_in(6)) add(",\"outline\":true,\"fill\":%s", truth());
    add("}");
}

/* Each mesh at some place or other, some of them in a mirror. */
static void add_nodes(int meshes)
{
    const int count = 1 + (int)random_below(&dice, 5);
    add(",\"nodes\":[");
    for (int i = 0; i < count; i++) {
        const double x = between(0.2, 1.2), y = between(0.2, 1.2), z = between(0.2, 1.2);
        add("%s{\"mesh\":%d,\"translation\":", i > 0 ? "," : "", (int)random_below(&dice, (uint32_t)meshes));
        add_vector(1.5);
        const double scale_x = once_in(3) ? -x : x, rotation_x = between(-1.0, 1.0);
        add(",\"rotation\":[%.6g,0.3,0.1,1],\"scale\":[%.6g,%.6g,%.6g]}", rotation_x, scale_x, y, z);
    }
    add("]");
}

static void add_view(void)
{
    static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
    const double azimuth = between(-180.0, 180.0), elevation = between(-90.0, 90.0);
    switch (random_below(&dice, 5)) {
    case 0:
        add(",\"view\":{\"preset\":\"%s\"", PICK(presets));
        break;
    case 1:
        add(",\"view\":{\"azimuthDegrees\":%.6g,\"elevationDegrees\":%.6g", azimuth, elevation);
        break;
    case 2: /* from close by, or from within */
        add(",\"view\":{\"target\":[0.1,0.2,0],\"eye\":");
        add_vector(3.0);
        break;
    default:
        return;
    }
    if (once_in(2)) add(",\"perspective\":{\"yfovDegrees\":%.6g}", between(5.0, 120.0));
    add("}");
}

const char *random_scene(uint64_t number)
{
    static const char *const looks[] = {"studio",    "technical", "clay@1", "dark",     "metal@1",     "outdoor",
                                        "blueprint", "xray",      "xray@1", "studio@1", "technical@1", "textbook"};
    length = 0;
    dice = random_seeded(number);
    is_textbook = once_in(6);
    const int meshes = 1 + (int)random_below(&dice, MESHES);
    add("{");
    add_size();
    const char *look = is_textbook ? "textbook" : PICK(looks);
    const bool has_look = !once_in(8);
    has_xrays = has_look && strncmp(look, "xray", 4) == 0;
    if (has_look) add(",\"look\":\"%s\"", look);
    add_keys();
    add_lamps();
    add_materials();
    add(",\"meshes\":[");
    for (int i = 0; i < meshes; i++)
        add_mesh(i);
    add("]");
    if (once_in(3)) add_nodes(meshes);
    add_view();
    add("}");
    return text;
}
