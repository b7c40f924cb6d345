/* What scenes say without effect, or not as it is meant: each is warned of by its name, and where it is about colours,
 * only requests for colours hear of it. */
#include "unit/common/json_check.h"
#include "support/scenes.h"
#include "support/tests.h"

#define FACE           "{" POSITIONS ", \"faces\": [[0,1,2]]"
#define MESHES(meshes) "\"meshes\": [" meshes "]"
#define PIXEL                                                                                                          \
    "{\"uri\": \"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6"                                       \
    "fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==\"}"
/* 2 x 2 and 2 x 1 texels of RGBA: with one alpha below the most, and without. */
#define HALF                                                                                                           \
    "{\"uri\": "                                                                                                       \
    "\"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAEklEQVR42mP4z8DwH4QZoMQ/AEbKB/jg"         \
    "GF9HAAAAAElFTkSuQmCC"                                                                                             \
    "\"}"
#define HALF_OF_16_BITS                                                                                                \
    "{\"uri\": "                                                                                                       \
    "\"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABEAYAAACksqPJAAAAEklEQVR42mP4/58BCCAkkP4HADTbBfoj"         \
    "AYn1AAAAAElFTkSuQmCC"                                                                                             \
    "\"}"
#define FULL                                                                                                           \
    "{\"uri\": "                                                                                                       \
    "\"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4z8DwH4QZGCDEfwA71gX7"         \
    "vC6MgAAAAABJRU5ErkJggg=="                                                                                         \
    "\"}"
#define TWICE(faces, more)                                                                                             \
    MESHES("{\"name\": \"box\", " POSITIONS ", \"faces\": [[0,1,2],[0,1,3,2],[1,3,2],[2,1,0]" faces "]" more "}")
#define DOUBLED(more) TWICE(",[1,0,2,3],[3,1,2]", more)
#define PARTLY_DOUBLED(faces)                                                                                          \
    "\"shading\": \"gouraud\", " MESHES("{" POSITIONS ", \"faces\": [[0,1,2],[2,1,0],[1,2,3]" faces "]}")
#define DOUBLED_SOUP(more)                                                                                             \
    MESHES("{\"positions\": [[0,0,0],[1,0,0],[0,1,0],[0,1,0],[1,0,0],[-0.0,0,0]], \"faces\": [[0,1,2],[3,4,5]]}") more
#define TEXCOORDS  "\"texcoords\": [[0,0],[1,0],[0,1],[1,1]]"
#define WITH(more) MESHES(FACE ", " TEXCOORDS ", \"material\": \"m\"}") ", \"materials\": [{\"name\": \"m\", " more "}]"
#define CLEAR      "[1,0,0,0]"
#define FAINT      "[1,0,0,0.25]"

static const struct {
    const char *text;    /* without braces */
    bool is_of_colors;   /* and not said where only depth is asked for */
    const char *warning; /* NULL: none */
} CASES[] = {
    {MESHES(FACE ", \"colors\": [" FAINT "," FAINT "," FAINT "," FAINT "]}"), true,
     "mesh 0: colours have an alpha below 1"},
    {MESHES(FACE "}, " FACE ", \"name\": \"glass\", \"faceColors\": [" FAINT "]}, " FACE ", \"faceColors\": [" FAINT
                 "]}"),
     true, "mesh 1 'glass' and 1 more: colours have an alpha below 1"},
    {"\"polygons\": [{" TRIANGLE "}, {" TRIANGLE ", \"color\": " FAINT "}]", true,
     "polygon 1: colours have an alpha below 1"},
    {"\"alphaMode\": \"BLEND\", " MESHES(FACE ", \"faceColors\": [" CLEAR "]}"), true, "mesh 0: alpha is 0 everywhere"},
    {"\"alphaMode\": \"BLEND\", " MESHES(FACE ", \"faceColors\": [" FAINT "]}"), true, NULL},
    {"\"alphaMode\": \"BLEND\", \"polygons\": [{" TRIANGLE ", \"colors\": [" CLEAR "," CLEAR "," CLEAR "]}]", true,
     "polygon 0: alpha is 0 everywhere"},
    {"\"alphaMode\": \"BLEND\", \"polygons\": [{" TRIANGLE ", \"colors\": [" CLEAR "," CLEAR "," FAINT "]}]", true,
     NULL},
    {"\"alphaMode\": \"MASK\", " MESHES(FACE ", \"faceColors\": [" FAINT "]}"), false,
     "mesh 0: alpha is below alphaCutoff everywhere"},
    {"\"alphaMode\": \"MASK\", \"alphaCutoff\": 0.25, " MESHES(FACE ", \"faceColors\": [" FAINT "]}"), false, NULL},
    {"\"alphaCutoff\": 0.25, " POLYGONS, false, "the scene's alphaCutoff has no effect"},
    {"\"alphaMode\": \"BLEND\", " MESHES(FACE ", \"alphaCutoff\": 0.3}"), false, "mesh 0: alphaCutoff has no effect"},
    {MESHES(FACE ", \"alphaMode\": \"MASK\", \"alphaCutoff\": 0.3}"), false, NULL},
    {MESHES(FACE ", \"pointSize\": 3}"), false, "mesh 0: pointSize has no effect without points"},
    {MESHES(FACE ", \"points\": [0], \"pointSize\": 3}"), false, NULL},
    {POLYGONS ", \"materials\": [{\"name\": \"b\"}, {\"name\": \"a\"}]", true,
     "material 'b' (and 1 more) is used by nothing"},
    {WITH("\"alphaCutoff\": 0.5"), true, "material 'm': alphaCutoff has no effect"},
    {WITH("\"alphaCutoff\": 0.5, \"alphaMode\": \"MASK\""), true, NULL},
    {WITH("\"baseColorTexture\": " HALF), true, "mesh 0: its baseColorTexture has an alpha below 1"},
    {WITH("\"baseColorTexture\": " HALF ", \"alphaMode\": \"OPAQUE\""), true, NULL},
    {WITH("\"baseColorTexture\": " HALF ", \"alphaMode\": \"MASK\""), true, NULL},
    {WITH("\"baseColorTexture\": " HALF ", \"baseColorFactor\": " FAINT), true,
     "mesh 0: colours have an alpha below 1"},
    {WITH("\"baseColorTexture\": " HALF_OF_16_BITS), true, "mesh 0: its baseColorTexture has an alpha below 1"},
    {WITH("\"baseColorTexture\": " FULL), true, NULL},
    {WITH("\"specular\": \"white\""), true, "material 'm': no effect of specular with the shading flat"},
    {WITH("\"shading\": \"unlit\", \"specular\": \"white\", \"shininess\": 3, \"metallicFactor\": 1, "
          "\"roughnessFactor\": 1, "
          "\"emissiveFactor\": [1, 1, 1], \"cool\": \"red\", \"metallicRoughnessTexture\": " PIXEL
          ", \"normalTexture\": " PIXEL ", \"occlusionTexture\": " PIXEL ", \"emissiveTexture\": " PIXEL),
     true,
     "material 'm': no effect of specular, shininess, metallicFactor, roughnessFactor, emissiveFactor, cool, "
     "metallicRoughnessTexture, normalTexture, occlusionTexture, emissiveTexture with the shading unlit"},
    {WITH("\"specular\": \"white\", \"shininess\": 9") ", \"shading\": \"phong\"", true, NULL},
    {WITH("\"metallicFactor\": 1, \"emissiveTexture\": " PIXEL ", \"shading\": \"phong\""), true,
     "material 'm': no effect of metallicFactor, emissiveTexture with the shading phong"},
    {WITH("\"metallicFactor\": 1, \"emissiveTexture\": " PIXEL ", \"shading\": \"pbr\""), true, NULL},
    {WITH("\"metallicRoughnessTexture\": " PIXEL), true, "no effect of metallicRoughnessTexture with the shading flat"},
    {WITH("\"normalTexture\": " PIXEL ", \"shading\": \"unlit\""), true,
     "no effect of normalTexture with the shading unlit"},
    {WITH("\"normalTexture\": " PIXEL ", \"shading\": \"normals\""), true, NULL},
    {WITH("\"occlusionTexture\": " PIXEL ", \"shading\": \"normals\""), true,
     "no effect of occlusionTexture with the shading normals"},
    {WITH("\"baseColorTexture\": " PIXEL ", \"shading\": \"normals\""), true,
     "no effect of baseColorTexture with the shading normals"},
    {WITH("\"baseColorTexture\": " HALF ", \"shading\": \"normals\""), true,
     "material 'm': no effect of baseColorTexture with the shading normals"},
    {WITH("\"baseColorTexture\": " HALF ", \"shading\": \"normals\", \"alphaMode\": \"MASK\""), true,
     "material 'm': no effect of baseColorTexture with the shading normals"},
    {"\"look\": \"studio\", " WITH("\"baseColorTexture\": " HALF
                                   ", \"shading\": \"normals\", \"alphaMode\": \"BLEND\""),
     true, NULL}, /* in linear light, BLEND uses its alpha */
    {WITH("\"baseColorTexture\": " HALF ", \"fill\": false, \"outline\": true"), true,
     "material 'm': no effect of baseColorTexture without filled faces"},
    {WITH("\"specular\": \"white\", \"shading\": \"phong\", \"fill\": false, \"outline\": \"red\""), true,
     "material 'm': no effect of specular without filled faces"},
    {WITH("\"cool\": \"blue\""), true, "no effect of cool with the shading flat"},
    {MESHES("{" POSITIONS ", \"lines\": [[0,1]], " TEXCOORDS
            ", \"material\": \"m\"}") ", \"materials\": [{\"name\": \"m\", "
                                      "\"baseColorTexture\": " PIXEL "}]",
     true, "no effect of baseColorTexture without filled faces"},
    /* One of its meshes has a use for it. */
    {MESHES(FACE ", \"material\": \"m\", \"shading\": \"phong\"}, " FACE
                 ", \"material\": \"m\"}") ", \"materials\": [{\"name\": \"m\", \"specular\": \"white\"}]",
     true, NULL},
    {DOUBLED(", \"shading\": \"gouraud\""), true, "mesh 0 'box': at some vertices each face appears twice"},
    {DOUBLED(", \"shading\": \"normals\""), true, "each face appears twice"},
    {DOUBLED(", \"shading\": \"flat\""), true, NULL},
    {DOUBLED(", \"shading\": \"gouraud\", \"fill\": false, \"outline\": true"), true, NULL},
    {TWICE(",[1,0,2,3],[1,2,3]", ", \"shading\": \"gouraud\""), true, "each face appears twice"},
    {PARTLY_DOUBLED(",[0,3,1],[2,3,0]"), true, NULL}, /* each vertex has a face with one winding */
    {PARTLY_DOUBLED(""), true, "each face appears twice"},
    {DOUBLED_SOUP(", \"shading\": \"gouraud\""), true, NULL},
    /* In linear light, faces of one place are averaged, up to the crease angle. */
    {"\"look\": \"studio\", \"shading\": \"gouraud\", " DOUBLED(""), true, NULL},
    {"\"look\": \"studio\", \"creaseDegrees\": 179, " DOUBLED(""), true, NULL},
    {"\"look\": \"studio\", \"creaseDegrees\": 180, " DOUBLED(""), true, "each face appears twice"},
    {"\"look\": \"technical\", \"creaseDegrees\": 180, " DOUBLED(""), true, "each face appears twice"},
    {"\"look\": \"xray\", \"creaseDegrees\": 180, " DOUBLED(""), true, "each face appears twice"},
    {"\"look\": \"studio\", \"shading\": \"normals\", \"creaseDegrees\": 180, " DOUBLED_SOUP(""), true,
     "each face appears twice"},
    {"\"look\": \"studio\", \"shading\": \"unlit\", \"creaseDegrees\": 180, " DOUBLED(""), true, NULL},
    {DOUBLED(", \"shading\": \"phong\", \"normals\": [[0,0,1],[0,0,1],[0,0,1],[0,0,1]]"), true, NULL},
    {"\"shading\": \"gouraud\", " MESHES("{" POSITIONS ", \"faces\": [[0,1,2],[1,2,0]]}"), true, NULL},
    {"\"shading\": \"gouraud\", " MESHES("{" POSITIONS ", \"faces\": [[0,1,2],[0,2,3]]}"), true, NULL},
    {"\"shading\": \"gooch\", \"exposure\": 2, " POLYGONS, true,
     "no effect of exposure: no face has the shading flat, gouraud, phong, pbr"},
    {"\"look\": \"technical\", \"toneMapping\": \"neutral\", " MESHES(FACE "}"), true,
     "no effect of toneMapping: no face has the shading flat, gouraud, phong, pbr"},
    {"\"look\": \"technical\", \"toneMapping\": \"none\", \"exposure\": 1, " MESHES(FACE "}"), true, NULL},
    {"\"view\": {\"worldToCamera\": [[-1,0,0,0],[0,1,0,0],[0,0,1,-4],[0,0,0,1]]}, " POLYGONS, false,
     "the camera's pose is a reflection (its determinant is negative)"},
    {"\"look\": \"studio\", \"exposure\": 2, " MESHES(FACE "}"), true, NULL},
    {"\"look\": \"xray\", \"exposure\": 2, \"toneMapping\": \"neutral\", " MESHES(FACE "}"), true,
     "no effect of toneMapping, exposure: no face has the shading flat, gouraud, phong, pbr"},
    {"\"shading\": \"unlit\", \"ambient\": \"#404040\", \"lights\": [{\"type\": \"directional\", \"direction\": "
     "[0,0,-1]}], " MESHES(FACE "}, " FACE ", \"shading\": \"normals\"}"),
     true, "no effect of ambient, lights: no face has the shading flat, gouraud, phong, pbr"},
    {"\"shading\": \"unlit\", \"ambient\": \"#404040\", \"lights\": [{\"type\": \"directional\", \"direction\": "
     "[0,0,-1]}], " MESHES(FACE "}, " FACE ", \"shading\": \"flat\"}"),
     true, NULL},
    {"\"look\": \"studio\", \"shading\": \"phong\", \"environment\": \"outdoor\", " MESHES(FACE "}"), true,
     "no effect of environment: no face has the shading pbr"},
    {MESHES(FACE ", \"name\": \"terrain\", \"scalars\": [0,1,2,9], \"range\": [0,3]}"), true,
     "mesh 0 'terrain': 1 of 4 scalars are outside of the range"},
};

static struct reading *read_case(size_t i, const char *channel, const char *strict)
{
    static char text[4096];
    snprintf(text, sizeof text, "{%s}", CASES[i].text);
    return read_request((struct zr_request){.format = ZR_FORMAT_JSON, .channel = channel, .strict = strict}, text,
                        strlen(text), zr_limits_default(), (size_t)1 << 28);
}

TEST(oddities_are_warned_of_by_the_name_of_what_has_them)
{
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        struct reading *reading = read_case(i, NULL, NULL);
        assert_read(reading);
        const uint32_t count = reading->scene->warning_count;
        if (count != (CASES[i].warning != NULL))
            fail_msg("case %zu: %u warnings: %s", i, count, count ? reading->scene->warnings[0] : "");
        if (count && !strstr(reading->scene->warnings[0], CASES[i].warning))
            fail_msg("case %zu: %s", i, reading->scene->warnings[0]);
        reading_free(reading);
    }
}

TEST(oddities_of_colours_do_not_refuse_data_channels)
{
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        struct reading *reading = read_case(i, "depth", "1");
        if ((reading->status == ZR_OK) != (CASES[i].is_of_colors || !CASES[i].warning)) fail_msg("case %zu", i);
        reading_free(reading);
        reading = read_case(i, "color", "1");
        if ((reading->status == ZR_OK) != !CASES[i].warning) fail_msg("case %zu in colours", i);
        reading_free(reading);
    }
}

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
    static const char why[] = "all that is in view has the alphaMode BLEND, which color alone shows";
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
    assert_says(text, NULL, "nothing is seen in the output depth: all that is in view has the alphaMode BLEND");
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
        assert_says(text, "color", "nothing is seen: alpha is below alphaCutoff wherever something is drawn");
        assert_says(text, "info", "nothing is seen: alpha is below alphaCutoff wherever something is drawn");
    }
    static const char cut[] =
        "{" SMALL "\"view\": {\"eye\": [0.5,0.5,3], \"target\": [0.5,0.5,0], \"znear\": %s, \"zfar\": 10}, "
        "\"meshes\": [" CUBE "}]}";
    char text[1024];
    snprintf(text, sizeof text, cut, "2.5");
    assert_says(text, "thickness", "nothing is seen: the near plane (znear) cuts off the faces that face the camera");
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
    assert_null(strstr(answer.warnings, "nothing is seen"));
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
