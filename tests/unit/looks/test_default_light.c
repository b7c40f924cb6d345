/* A scene and a bare mesh without lights get the same ones. */
#include "base/run.h"
#include "scene/output.h"
#include "shade/frame.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

#define CUBE                                                                                                           \
    "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "                               \
    "\"faces\": [[4,5,6,7],[1,0,3,2],[5,1,2,6],[0,4,7,3],[7,6,2,3],[0,1,5,4]]"

enum { FACES = 6, IDS = FACES + 1 };

/* Colours of the cube's faces by their ids; alpha is 0 where one is not seen. */
struct look {
    uint8_t colors[IDS][4];
    int visible;
};

static void look_at(struct reading *reading, struct look *look)
{
    const struct zr_frame *frame;
    struct zr_error error = {0};
    *look = (struct look){.visible = 0};
    assert_read(reading);
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &reading->arena, .error = &error}, reading->scene, NULL, &frame), ZR_OK);
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++) {
        uint32_t id = frame->face_id[i];
        if (id == 0) continue;
        assert_true(id < IDS);
        look->visible += look->colors[id][3] == 0;
        memcpy(look->colors[id], frame->color + 4 * i, 4);
    }
}

static void look_at_cube(const char *color, const char *view, struct look *look)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"window\": {\"width\": 80, \"height\": 60}, \"outputs\": [{\"channel\": \"color\"}, {\"channel\": "
             "\"faceId\"}], \"meshes\": [{" CUBE ", \"material\": \"m\"}], "
             "\"materials\": [{\"name\": \"m\", \"baseColorFactor\": %s}], \"view\": {%s}}",
             color, view);
    struct reading *reading = read_text(ZR_FORMAT_JSON, text);
    look_at(reading, look);
    reading_free(reading);
}

TEST(a_bare_mesh_gets_the_same_light_by_the_textbook)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                              "f 5 6 7 8\nf 2 1 4 3\nf 6 2 3 7\nf 1 5 8 4\nf 8 7 3 4\nf 1 2 6 5\n";
    struct look json, bare;
    look_at_cube("[0.7, 0.7, 0.7]", "\"preset\": \"isometric\"", &json);
    struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_OBJ, .look = "textbook"}, obj,
                                           sizeof obj - 1, zr_limits_default(), (size_t)1 << 28);
    struct zr_scene scene = *reading->scene;
    const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                        {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};
    scene.views[0].outputs = outputs;
    scene.views[0].output_count = 2;
    reading->scene = &scene;
    look_at(reading, &bare);
    assert_memory_equal(bare.colors, json.colors, sizeof json.colors);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
