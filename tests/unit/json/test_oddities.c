/* Warnings of drawing name a reason and the mesh or part. Warnings of readers are cases of tests/refusals. */
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

#define FACE           "{" POSITIONS ", \"faces\": [[0,1,2]]"
#define MESHES(meshes) "\"meshes\": [" meshes "]"
#define FAINT          "[1,0,0,0.25]"

/* By info's own warnings. */
static void assert_says(const char *text, const char *channel, const char *wanted)
{
    struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_JSON, .channel = channel}, text,
                                           strlen(text), zr_limits_default(), (size_t)1 << 28);
    assert_read(reading);
    const struct zr_answer answer = scene_encode(&reading->arena, NULL, reading->scene);
    if (wanted ? !strstr(answer.warnings, wanted) : *answer.warnings != '\0') fail_msg("%s: %s", text, answer.warnings);
    reading_free(reading);
}

#define CUBE                                                                                                           \
    "{\"positions\": [[0,0,0],[0,0,1],[0,1,0],[0,1,1],[1,0,0],[1,0,1],[1,1,0],[1,1,1]], \"faces\": [[0,1,3,2],"        \
    "[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]"
#define SMALL "\"window\": {\"width\": 16, \"height\": 16}, "

TEST(outputs_that_show_nothing_of_what_is_blended_say_so)
{
    static const char glass[] = "{" SMALL "\"alphaMode\": \"BLEND\", " MESHES(CUBE "}") "%s}",
                      both[] = "{" SMALL MESHES(CUBE ", \"alphaMode\": \"BLEND\"}, " CUBE "}") "%s}";
    static const char why[] = "all that is in view has the alphaMode BLEND, which only the channel color shows";
    static const char *const channels[] = {"depth",       "windowDepth", "faceId",       "distance", "instanceId",
                                           "frontFacing", "position",    "barycentrics", "normals",  "info"};
    char text[2048];
    snprintf(text, sizeof text, glass, "");
    for (size_t i = 0; i < sizeof channels / sizeof *channels; i++)
        assert_says(text, channels[i], why);
    assert_says(text, "color", NULL);
    assert_says(text, "layers", NULL);
    assert_says(text, "thickness", NULL);
    snprintf(text, sizeof text, both, "");
    assert_says(text, "depth", NULL);
    snprintf(text, sizeof text, glass, ", \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}]");
    assert_says(text, NULL, "nothing is visible in the output depth: all that is in view has the alphaMode BLEND");
    snprintf(text, sizeof text, both, ", \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}]");
    assert_says(text, NULL, NULL);
    assert_says("{" SMALL "\"alphaMode\": \"BLEND\", " MESHES("{" POSITIONS ", \"lines\": [[0,1]]}") "}", "depth", why);
    /* Outside of the view, that is the reason. */
    snprintf(text, sizeof text, glass, ", \"view\": {\"eye\": [0,0,3], \"target\": [0,0,9]}");
    assert_says(text, "depth", "all geometry is outside the view");
}

TEST(camera_that_reflects_or_stretches_is_warned_of)
{
#define SEEN_BY(rows) "{" SMALL MESHES(CUBE "}") ", \"view\": {\"worldToCamera\": [" rows ",[0,0,0,1]]}}"
    static const char mirror[] = SEEN_BY("[-1,0,0,0],[0,1,0,0],[0,0,1,-4]"),
                      scale[] = SEEN_BY("[3,0,0,0],[0,3,0,0],[0,0,3,-9]"),
                      stretch[] = SEEN_BY("[3,0,0,0],[0,1,0,0],[0,0,0.5,-4]");
    assert_says(mirror, "color", "the camera's pose is a reflection (its determinant is negative)");
    assert_says(mirror, "faceId", "the camera's pose is a reflection (its determinant is negative)");
    assert_says(scale, "depth", NULL);
    assert_says(stretch, "color", NULL);
    assert_says(stretch, "depth", "a length of 1 along its axes x, y and z becomes 3, 1 and 0.5");
    assert_says(stretch, "distance", "positions in camera space are not in scene units");
    assert_says(stretch, "position", "positions in camera space are not in scene units");
#undef SEEN_BY
}

TEST(projection_that_mirrors_or_reverses_z_is_warned_of)
{
    static const struct {
        const char *pose, *rows, *says;
    } rows[] = {
        {"", "[2,0,0,0],[0,2,0,0],[0,0,-1.5,-3],[0,0,-1,0]", NULL},
        {"", "[2,0,0,0],[0,-2,0,0],[0,0,-1.2,-1.2],[0,0,-1,0]", "projectionMatrix is a reflection"},
        {"", "[-2,0,0,0],[0,2,0,0],[0,0,-1.5,-3],[0,0,-1,0]", "projectionMatrix is a reflection"},
        {"", "[2,0,0,0],[0,2,0,0],[0,0,0.1,1],[0,0,-1,0]", "projectionMatrix gives farther points smaller depths"},
        {"", "[0.5,0,0,0],[0,0.5,0,0],[0,0,-0.1,-0.5],[0,0,0,1]", NULL},
        {"", "[0.5,0,0,0],[0,-0.5,0,0],[0,0,-0.1,-0.5],[0,0,0,1]", "projectionMatrix is a reflection"},
        {"\"worldToCamera\": [[-1,0,0,0],[0,1,0,0],[0,0,1,-4],[0,0,0,1]], ",
         "[-2,0,0,0],[0,2,0,0],[0,0,-1.5,-3],[0,0,-1,0]", NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[1024];
        snprintf(text, sizeof text, "{" SMALL MESHES(FACE "}") ", \"view\": {%s\"projectionMatrix\": [%s]}}",
                 *rows[i].pose ? rows[i].pose : "\"eye\": [0.5,0.5,4], \"target\": [0.5,0.5,0], ", rows[i].rows);
        assert_says(text, "color", rows[i].says);
    }
    /* As in GL with identity matrices: a scene in clip space, where z grows away from the eye. */
    assert_says("{" SMALL MESHES(FACE "}") ", \"view\": {\"projectionMatrix\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],"
                                           "[0,0,0,1]]}}",
                "color", NULL);
}

TEST(what_hides_everything_is_the_reason_given)
{
    static const char masked[] = "{" SMALL "\"alphaMode\": \"MASK\", \"meshes\": [" CUBE ", \"faceColors\": [" FAINT
                                 "," FAINT "," FAINT "," FAINT "," FAINT "," FAINT "]}]%s}";
    static const char *const ways[] = {"", ", \"algorithm\": \"scanline\"", ", \"samples\": 4",
                                       ", \"look\": \"studio\", \"shading\": \"flat\""};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        char text[1024];
        snprintf(text, sizeof text, masked, ways[i]);
        assert_says(text, "color", "nothing is visible: alpha is below alphaCutoff wherever something is drawn");
        assert_says(text, "info", "nothing is visible: alpha is below alphaCutoff wherever something is drawn");
    }
    static const char cut[] =
        "{" SMALL "\"view\": {\"eye\": [0.5,0.5,3], \"target\": [0.5,0.5,0], \"znear\": %s, \"zfar\": 10}, "
        "\"meshes\": [" CUBE "}]}";
    char text[1024];
    snprintf(text, sizeof text, cut, "2.5");
    assert_says(text, "thickness",
                "nothing is visible: the near plane (znear) cuts off the faces that face the camera");
    snprintf(text, sizeof text, cut, "1");
    assert_says(text, "thickness", NULL);
    assert_says("{" SMALL "\"view\": {\"eye\": [0,0,-5]}, " POLYGONS "}", "depth", "every face in view faces away");
}

/* Of all faces, seen or not. */
TEST(thickness_is_something_that_is_seen)
{
    struct reading *reading =
        read_scene("{" SMALL "\"alphaMode\": \"MASK\", \"outputs\": [{\"channel\": \"thickness\"}], \"meshes\": [" CUBE
                   ", \"faceColors\": [" FAINT "," FAINT "," FAINT "," FAINT "," FAINT "," FAINT "]}]}");
    const struct zr_answer answer = scene_encode(&reading->arena, NULL, reading->scene);
    assert_non_null(strstr(answer.warnings, "alpha is below"));
    assert_null(strstr(answer.warnings, "nothing is visible"));
    reading_free(reading);
}

TEST(names_of_meshes_are_cut_and_clean)
{
    assert_says("{" SMALL "\"meshes\": [{\"name\": \"a\\nb\", " POSITIONS ", \"faces\": [[0,1,2],[0,0,1]]}]}", "color",
                "the first: face 1 of mesh 0 'a?b'");
    assert_says("{" SMALL "\"meshes\": [{\"name\": \"1234567890123456789012345678901\\u00e4\", " POSITIONS
                ", \"faces\": [[0,1,2]], \"lines\": [[0,0]]}]}",
                "color", "the first: line 0 of mesh 0 '1234567890123456789012345678901'");
}

RUN_TESTS(NULL, NULL)
