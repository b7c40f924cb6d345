/* With any limit of memory, a request is rendered or fails for lack of memory, never for a fault of its scene. */
#include <string.h>

#include "base/run.h"
#include "core.h"
#include "render_request.h"
#include "support/input/mtl_pictures.h"
#include "support/input/skinned_gltf.h"
#include "support/tests.h"

struct sample {
    const char *name;
    enum zr_format format;
    const char *text;
};

#define OUTPUTS                                                                                                        \
    "\"window\": {\"width\": 24, \"height\": 16}, \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, "  \
    "{\"channel\": \"faceId\"}, {\"channel\": \"info\"}]"

static const struct sample samples[] = {
    {"a mesh with all there is", ZR_FORMAT_JSON,
     "{" OUTPUTS ", \"meshes\": [{\"name\": \"quads\", \"material\": \"clay\", \"doubleSided\": true,"
     " \"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1,1],[1,0,1,1]],"
     " \"normals\": [[0,0,1],[0,0,1],[0,0,1],[0,0,1],[0,0,1],[0,0,1]],"
     " \"colors\": [[1,0,0],[0,1,0],[0,0,1],\"#ffffff\",[1,1,0],[0,1,1]],"
     " \"faces\": [[0,1,2,3],[0,1,5,4],[0,3,1,2]], \"faceColors\": [[1,0,0],[0,1,0],[0,0,1]],"
     " \"lines\": [[0,2],[1,3]]}], \"materials\": [{\"name\": \"clay\", \"outline\": \"#000000\"}],"
     " \"nodes\": [{\"mesh\": \"quads\", \"children\": [1]}, {\"mesh\": 0, \"translation\": [0,0,1]}]}"},
    {"masks of instances", ZR_FORMAT_JSON,
     "{\"window\": {\"width\": 90, \"height\": 70}, \"visibility\": true, \"features\": true,"
     " \"outputs\": [{\"channel\": \"info\"},"
     " {\"channel\": \"masks\"}, {\"channel\": \"masks\", \"encoding\": \"json\"}], \"meshes\": [{\"name\": \"a\","
     " \"positions\": [[0,0,0],[1,0,0],[0,1,0]], \"faces\": [[0,1,2]], \"material\": \"m\"}], \"materials\":"
     " [{\"name\": \"m\", \"alphaMode\": \"MASK\"}], \"nodes\": [{\"mesh\": \"a\"}, {\"mesh\": 0,"
     " \"translation\": [0.2,0,1]}]}"},
    {"heights", ZR_FORMAT_JSON,
     "{" OUTPUTS ", \"meshes\": [{\"heights\": [[0,1,0],[1,null,1],[0,1,0],[1,2,1]],"
     " \"colors\": [[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0]],"
     " \"faceColors\": [[1,0,0],[0,1,0],[0,0,1],[1,0,0],[0,1,0],[0,0,1]]}]}"},
    {"polygons of any shape", ZR_FORMAT_JSON,
     "{" OUTPUTS ", \"polygons\": [{\"vertices\": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]],"
     " \"holes\": [[[1,1,0],[2,1,0],[1,2,0]]], \"color\": \"#cc3333\", \"doubleSided\": true},"
     " {\"vertices\": [[0,0,1],[4,0,1],[1,1,1],[0,4,1]], \"normals\": [[0,0,1],[0,0,1],[0,0,1],[0,0,1]],"
     " \"colors\": [[1,0,0],[0,1,0],[0,0,1],[1,1,1]], \"outline\": true}], \"lights\": [{\"type\": \"directional\","
     " \"direction\": [0,0,-1]}], \"algorithm\": \"edgelist\"}"},
    {"a base", ZR_FORMAT_JSON,
     "{\"window\": {\"width\": 2, \"height\": 1}, \"outputs\": [{\"channel\": \"faceId\"}],"
     " \"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}], \"view\": {\"preset\": \"front\", \"znear\": 0.1,"
     " \"zfar\": 9}, \"base\": {\"windowDepth\": {\"uri\": \"data:;base64,"
     "k05VTVBZAQBGAHsnZGVzY3InOiAnPGY0JywgJ2ZvcnRyYW5fb3JkZXInOiBGYWxzZSwgJ3NoYXBlJzogKDEsIDIpLCB9ICAgICAgICAgIAoA"
     "AIA/AACAPw==\"}, \"faceId\": \"data:;base64,"
     "k05VTVBZAQBGAHsnZGVzY3InOiAnPHU0JywgJ2ZvcnRyYW5fb3JkZXInOiBGYWxzZSwgJ3NoYXBlJzogKDEsIDIpLCB9ICAgICAgICAgIAoA"
     "AAAAAAAAAA==\"}}"},
    {"a look with all effects", ZR_FORMAT_JSON,
     "{" OUTPUTS
     ", \"look\": \"studio\", \"edges\": true, \"samples\": 4, \"meshes\": [{\"positions\": [[0,0,0],[1,0,0],"
     "[0,1,0],[0,0,1]], \"faces\": [[0,1,2],[0,1,3],[1,2,3]], \"lines\": [[0,1]], \"outline\": true}]}"},
    {"shadows", ZR_FORMAT_JSON,
     "{" OUTPUTS ", \"look\": \"outdoor\", \"samples\": 1, \"algorithm\": \"scanline\", \"polygons\": [{\"vertices\":"
     " [[0,0,0],[1,0,0],[0,1,0]]}]}"},
    {"samples by the textbook", ZR_FORMAT_JSON,
     "{" OUTPUTS ", \"samples\": 16, \"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}"},
    {"OBJ", ZR_FORMAT_OBJ, "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 2\n"},
    {"OBJ with materials", ZR_FORMAT_OBJ,
     "mtllib m.mtl\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\ng b\nusemtl b\n"
     "f 1/2 2/3 3/1\n"},
    {"STL", ZR_FORMAT_STL,
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
     "0\nendloop\nendfacet\nendsolid\n"},
    {"STL with quads", ZR_FORMAT_STL,
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
     "0\nendloop\nendfacet\n"},
    {"PLY", ZR_FORMAT_PLY,
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
     "red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int "
     "vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n"},
    {"glTF with a skin and targets", ZR_FORMAT_GLTF, SKINNED_GLTF},
};

/* Parts of every request. Only one sample uses them. */
#define MTL "newmtl a\nmap_Kd c.png\nmap_d g.png\nmap_Pr g.png\nnewmtl b\nKd 1 0 0\nd 0.5\n"
static const struct zr_asset assets[] = {{.name = "m.mtl", .bytes = MTL, .size = sizeof MTL - 1},
                                         {.name = "c.png", .bytes = PICTURE_COLORS, .size = sizeof PICTURE_COLORS - 1},
                                         {.name = "g.png", .bytes = PICTURE_GREYS, .size = sizeof PICTURE_GREYS - 1}};

/* Allocations are rounded up to STEP, so that no ceiling between two of these is another one. Where one large
 * allocation is FAR beyond the ceiling, all ceilings up to it fail alike: the last of them will do. */
enum { STEP = ZR_ARENA_ALIGN, MOST = 1 << 24, FAR = 1 << 13 };

static struct zr_arena arena;

/* ZR_OK, or the first failure of the steps. */
static enum zr_status serve(const struct zr_request *request, size_t ceiling, struct zr_error *error)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    struct zr_answer answer;
    zr_arena_reset(&arena, MOST);
    arena.ceiling = ceiling;
    enum zr_status status = zr_scene_read(&(struct zr_run){.arena = &arena, .error = error}, request, &limits, &scene);
    if (status == ZR_OK) status = zr_render(&(struct zr_run){.arena = &arena, .error = error}, scene, NULL, &frame);
    if (status == ZR_OK) status = zr_encode(&(struct zr_run){.arena = &arena, .error = error}, scene, frame, &answer);
    return status;
}

TEST(every_ceiling_of_memory_is_enough_or_named)
{
    zr_arena_init(&arena, MOST);
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        struct zr_request request = {
            .format = samples[i].format, .bytes = samples[i].text, .size = strlen(samples[i].text)};
        if (strncmp(samples[i].text, "mtllib", 6) == 0) {
            request.assets = assets;
            request.asset_count = sizeof assets / sizeof *assets;
        }
        if (request.format != ZR_FORMAT_JSON) request.width = request.height = "16";
        size_t ceiling = 0;
        enum zr_status status = ZR_NO_MEMORY;
        for (; status != ZR_OK && ceiling < MOST; ceiling += STEP) {
            struct zr_error error = {.count = 0};
            status = serve(&request, ceiling, &error);
            if (status != ZR_OK && (status != ZR_NO_MEMORY || error.status != ZR_NO_MEMORY))
                fail_msg("%s, %zu bytes: status %d, %s: %s", samples[i].name, ceiling, (int)status,
                         error.items[0].pointer, error.items[0].detail);
            if (status != ZR_OK && arena.wanted < MOST && arena.wanted > ceiling + FAR) ceiling = arena.wanted - FAR;
        }
        assert_int_equal(status, ZR_OK);
    }
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
