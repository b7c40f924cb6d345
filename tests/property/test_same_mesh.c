/* One mesh in all formats: the same bytes of colour, depth and faces. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/input/zip_file.h"
#include "support/renderer.h"
#include "support/tests.h"

/* ---- a ball with a dent, of triangles ---- */

enum { RINGS = 9, SIDES = 14, CORNERS = RINGS * SIDES + 2, FACES = 2 * RINGS * SIDES };
static float corners[CORNERS][3];
static uint32_t faces[FACES][3];

static void make_mesh(void)
{
    const double pi = acos(-1.0);
    uint32_t n = 0;
    for (int ring = 0; ring < RINGS; ring++)
        for (int side = 0; side < SIDES; side++) {
            const double latitude = pi * (ring + 1) / (RINGS + 1), longitude = 2 * pi * side / SIDES;
            const double radius = 1.0 - 0.3 * (ring == 3 && side < 3);
            corners[ring * SIDES + side][0] = (float)(radius * sin(latitude) * cos(longitude));
            corners[ring * SIDES + side][1] = (float)(1.25 * radius * cos(latitude));
            corners[ring * SIDES + side][2] = (float)(-radius * sin(latitude) * sin(longitude));
        }
    corners[CORNERS - 2][1] = 1.25f;
    corners[CORNERS - 1][1] = -1.25f;
    for (uint32_t side = 0; side < SIDES; side++) {
        const uint32_t next = (side + 1) % SIDES, last = (RINGS - 1) * SIDES;
        const uint32_t caps[2][3] = {{CORNERS - 2, side, next}, {CORNERS - 1, last + next, last + side}};
        memcpy(faces[n++], caps[0], sizeof caps[0]);
        memcpy(faces[n++], caps[1], sizeof caps[1]);
        for (uint32_t ring = 0; ring + 1 < RINGS; ring++) {
            const uint32_t a = ring * SIDES + side, b = ring * SIDES + next, c = a + SIDES, d = b + SIDES;
            const uint32_t quad[2][3] = {{a, c, b}, {b, c, d}};
            memcpy(faces[n++], quad[0], sizeof quad[0]);
            memcpy(faces[n++], quad[1], sizeof quad[1]);
        }
    }
    assert_int_equal(n, FACES);
}

/* ---- files ---- */

enum { ROOM = 1 << 18 };
struct file {
    const char *name;
    char *bytes;
    size_t size;
};

static void add(struct file *file, const void *bytes, size_t size)
{
    if (!file->bytes) file->bytes = calloc(1, ROOM);
    assert_true(file->size + size <= ROOM);
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

__attribute__((format(printf, 2, 3))) static void print(struct file *file, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    add(file, text, (size_t)vsnprintf(text, sizeof text, format, arguments));
    va_end(arguments);
}

#define VALUES(v)      (double)(v)[0], (double)(v)[1], (double)(v)[2]
#define EACH(i, items) for (size_t i = 0; i < sizeof(items) / sizeof *(items); i++)

static struct file make_obj(void)
{
    struct file file = {.name = "obj"};
    EACH(i, corners) print(&file, "v %.9g %.9g %.9g\n", VALUES(corners[i]));
    EACH(i, faces) print(&file, "f %u %u %u\n", faces[i][0] + 1, faces[i][1] + 1, faces[i][2] + 1);
    return file;
}

static struct file make_stl_text(void)
{
    struct file file = {.name = "text STL"};
    print(&file, "solid s\n");
    EACH(i, faces)
    {
        print(&file, "facet normal 0 0 0\nouter loop\n");
        for (int k = 0; k < 3; k++)
            print(&file, "vertex %.9g %.9g %.9g\n", VALUES(corners[faces[i][k]]));
        print(&file, "endloop\nendfacet\n");
    }
    print(&file, "endsolid s\n");
    return file;
}

static struct file make_stl(void)
{
    struct file file = {.name = "binary STL"};
    const uint32_t count = FACES;
    char head[80] = "made", zeros[12] = "";
    add(&file, head, sizeof head);
    add(&file, &count, 4);
    EACH(i, faces)
    {
        add(&file, zeros, 12);
        for (int k = 0; k < 3; k++)
            add(&file, corners[faces[i][k]], 12);
        add(&file, zeros, 2);
    }
    return file;
}

static struct file make_ply(const char *name, const char *format)
{
    struct file file = {.name = name};
    print(&file,
          "ply\nformat %s 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nelement face "
          "%d\nproperty list uchar uint vertex_indices\nend_header\n",
          format, CORNERS, FACES);
    const bool is_text = *format == 'a', is_big = strstr(format, "big") != NULL;
    if (is_text) {
        EACH(i, corners) print(&file, "%.9g %.9g %.9g\n", VALUES(corners[i]));
        EACH(i, faces) print(&file, "3 %u %u %u\n", faces[i][0], faces[i][1], faces[i][2]);
        return file;
    }
    EACH(i, corners)
    for (int k = 0; k < 3; k++) {
        uint32_t word;
        memcpy(&word, &corners[i][k], 4);
        if (is_big) word = __builtin_bswap32(word);
        add(&file, &word, 4);
    }
    EACH(i, faces)
    {
        add(&file, "\3", 1);
        for (int k = 0; k < 3; k++) {
            const uint32_t word = is_big ? __builtin_bswap32(faces[i][k]) : faces[i][k];
            add(&file, &word, 4);
        }
    }
    return file;
}

static struct file make_glb(void)
{
    struct file file = {.name = "GLB"}, text = {.name = ""};
    print(&text,
          "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[{\"buffer\":0,"
          "\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],",
          sizeof corners + sizeof faces, sizeof corners, sizeof corners, sizeof faces);
    print(&text,
          "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},{\"bufferView\":1,"
          "\"componentType\":5125,\"count\":%d,\"type\":\"SCALAR\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
          "\"POSITION\":0},\"indices\":1}]}],\"nodes\":[{\"mesh\":0}]}",
          CORNERS, 3 * FACES);
    while (text.size % 4 != 0)
        add(&text, " ", 1);
    const uint32_t binary = sizeof corners + sizeof faces, size = (uint32_t)text.size;
    const uint32_t head[] = {0x46546C67, 2, 12 + 8 + size + 8 + binary, size, 0x4E4F534A},
                   chunk[] = {binary, 0x004E4942};
    add(&file, head, sizeof head);
    add(&file, text.bytes, text.size);
    add(&file, chunk, sizeof chunk);
    add(&file, corners, sizeof corners);
    add(&file, faces, sizeof faces);
    free(text.bytes);
    return file;
}

static struct file make_3mf(void)
{
    struct file file = {.name = "3MF"}, text = {.name = ""};
    print(&text, "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><object "
                 "id=\"1\"><mesh><vertices>");
    EACH(i, corners) print(&text, "<vertex x=\"%.9g\" y=\"%.9g\" z=\"%.9g\"/>", VALUES(corners[i]));
    print(&text, "</vertices><triangles>");
    EACH(i, faces) print(&text, "<triangle v1=\"%u\" v2=\"%u\" v3=\"%u\"/>", faces[i][0], faces[i][1], faces[i][2]);
    print(&text, "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>");
    const struct zip_entry part = {"3D/3dmodel.model", text.bytes, text.size, true};
    file.bytes = (char *)zip_3mf(&part, 1, &file.size);
    free(text.bytes);
    return file;
}

/* ---- pictures ---- */

static zraster_picture *draw(const struct file *file, const char *query)
{
    struct zraster_request request = request_of_bytes(file->bytes, file->size);
    request.query = query;
    return picture_of_request(renderer, &request, file->name);
}

static size_t count_drawn(zraster_picture *picture)
{
    struct zraster_array ids;
    size_t drawn = 0;
    assert_int_equal(zraster_picture_channel(picture, "faceId", &ids), 1);
    for (size_t i = 0; i < ids.shape[0] * ids.shape[1]; i++)
        drawn += ((const uint32_t *)ids.data)[i] > 0;
    return drawn;
}

TEST(one_mesh_gives_the_same_pictures_in_all_formats)
{
    static const char *const queries[] = {
        "width=160&height=120&channel=color,depth,faceId&up=y&look=studio",
        "width=160&height=120&channel=color,depth,faceId&up=y&look=technical", /* lines of the mesh */
        "width=160&height=120&channel=color,depth,faceId&up=y&look=clay&preset=front",
        "width=160&height=120&channel=color,depth,faceId&up=y&look=textbook&shading=flat"};
    make_mesh();
    struct file files[] = {make_obj(),
                           make_stl_text(),
                           make_stl(),
                           make_ply("text PLY", "ascii"),
                           make_ply("PLY, little endian", "binary_little_endian"),
                           make_ply("PLY, big endian", "binary_big_endian"),
                           make_glb(),
                           make_3mf()};
    EACH(q, queries)
    {
        zraster_picture *first = draw(&files[0], queries[q]);
        assert_true(count_drawn(first) > 4000);
        for (size_t i = 1; i < sizeof files / sizeof *files; i++) {
            zraster_picture *other = draw(&files[i], queries[q]);
            const char *channel = channel_that_differs(first, other);
            if (channel) fail_msg("%s: %s differs from OBJ: %s", files[i].name, channel, queries[q]);
            zraster_picture_free(other);
        }
        zraster_picture_free(first);
    }
    EACH(i, files) free(files[i].bytes);
}

RUN_TESTS(open_renderer, close_renderer)
