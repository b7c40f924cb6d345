/* Pictures of looks that nobody would ask for: odd windows, cameras, bodies. Each is drawn, and all instruction sets
 * and numbers of threads give the same bytes: a number that is none would not, since they compare it in different ways.
 */
#include <stdio.h>

#include "support/pictures/pictures.h"
#include "support/tests.h"

#define CUBE_FACES "\"faces\":[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]"
#define CUBE(a, b)                                                                                                     \
    "\"positions\":[[" a "," a "," a "],[" a "," a "," b "],[" a "," b "," a "],[" a "," b "," b "],[" b "," a "," a   \
    "],[" b "," a "," b "],[" b "," b "," a "],[" b "," b "," b "]]," CUBE_FACES

static const char *const bodies[] = {
    CUBE("-1", "1"),
    CUBE("0", "1e6"),
    CUBE("999998", "1e6"), /* small, and far from the origin */
    CUBE("-1e-6", "1e-6"),
    CUBE("0.999999", "1"),
    CUBE("0", "0"),
    "\"positions\":[[3,3,3],[3,3,3],[3,3,3]],\"faces\":[[0,1,2]]",
    ("\"positions\":[[0,0,0],[0,0,0],[1,0,0],[2,0,0],[0,1,0],[1e-30,0,0],[1,1e-20,0]],"
     "\"faces\":[[0,1,2],[0,2,3],[0,0,0],[0,2,4],[0,5,6],[1,5,2]]"),
    "\"positions\":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],\"lines\":[[0,1],[0,2],[0,3],[0,0]]",
    "\"positions\":[[0,0,0,1],[1,0,0,0],[0,1,0,0],[0,0,1,-1]],\"faces\":[[0,1,2],[0,1,3]]",
    "\"heights\":[[0,1,0,3],[1,null,1,2],[0,1,0,1]]"};

static const char *const views[] = {
    "",
    ",\"view\":{\"azimuthDegrees\":20,\"elevationDegrees\":-50}", /* below the ground */
    ",\"view\":{\"preset\":\"top\"}",
    ",\"view\":{\"preset\":\"bottom\"}",
    ",\"view\":{\"eye\":[0,1,50],\"target\":[0,9,100]}", /* away from it */
    ",\"view\":{\"eye\":[0.1,0.2,0.3],\"target\":[1,1,1]}",
    ",\"view\":{\"projectionMatrix\":[[1,0,0,0],[0,1,0,0],[0,0,-0.1,0],[0,0,0,1]]}",
    ",\"view\":{\"projectionMatrix\":[[1,0.2,0.1,0],[0,1,0.3,0],[0.1,0.1,0,0.5],[0.1,0.2,0.3,4]]}",
    ",\"view\":{\"projectionMatrix\":[[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,1]]}",
    ",\"view\":{\"projectionMatrix\":[[1,0,0,0],[0,1,0,0],[0,0,0.1,0],[0,0,0,-1]]}",
    ",\"view\":{\"worldToCamera\":[[2,0.5,0,0],[0,0.1,0,0],[0.3,0,-3,-9],[0,0,0,1]],\"perspective\":{\"yfovDegrees\":"
    "40}}",
    ",\"view\":{\"worldToCamera\":[[-1,0,0,0],[0,1,0,0],[0,0,1,-9],[0,0,0,1]],\"orthographic\":{\"xmag\":2,\"ymag\":2}"
    "}",
    ",\"view\":{\"preset\":\"front\",\"orthographic\":{\"xmag\":1e8,\"ymag\":1e-6}}"};

static const struct {
    uint32_t width, height;
} windows[] = {{1, 1}, {3, 17}, {65, 63}, {130, 40}, {8192, 1}, {1, 300}};

#define LAMPS                                                                                                          \
    "\"lights\":[{\"type\":\"directional\",\"direction\":[0,-1,0],\"shadows\":true},{\"type\":\"hemisphere\"}]"
#define PLACED                                                                                                         \
    "\"lights\":[{\"type\":\"spot\",\"position\":[0,0,1],\"direction\":[0,-1,-1],\"outerConeAngleDegrees\":80,"        \
    "\"shadows\":"                                                                                                     \
    "true},{\"type\":\"point\",\"position\":[0,0,0],\"intensity\":1e15},{\"type\":\"spot\",\"position\":[0,0,0],"      \
    "\"direction\":[0,0,-1],\"frame\":\"camera\",\"range\":1e-6,\"shadows\":true}]"
static const char *const looks[] = {
    "\"look\":\"studio\",\"samples\":4",
    "\"look\":\"technical\",\"samples\":1",
    "\"look\":\"studio\",\"samples\":1,\"environment\":false," PLACED,
    "\"look\":\"outdoor\"",
    "\"look\":\"blueprint\",\"samples\":4,\"lineWidth\":64,\"outline\":\"#ff0000\"",
    "\"look\":\"technical\",\"samples\":4,\"edges\":{\"width\":64,\"creaseDegrees\":0},\"creaseDegrees\":0",
    "\"look\":\"dark\",\"samples\":4,\"shading\":\"phong\",\"occlusion\":true," LAMPS,
    "\"look\":\"studio\",\"samples\":1,\"background\":[0,0,0,0],\"up\":\"z\"",
    "\"look\":\"metal\",\"samples\":4,\"algorithm\":\"scanline\",\"shading\":\"gouraud\"",
    "\"look\":\"studio\",\"occlusion\":{\"radius\":10,\"strength\":10},\"exposure\":1e6,\"toneMapping\":\"khronos-"
    "neutral\"",
    "\"look\":\"textbook\",\"samples\":4"};

enum { BODIES = sizeof bodies / sizeof *bodies, VIEWS = sizeof views / sizeof *views };
enum { WINDOWS = sizeof windows / sizeof *windows, LOOKS = sizeof looks / sizeof *looks };

/* Lamps that have a place refuse positions of four numbers. */
static bool is_refused(const char *look, const char *body)
{
    const char *corner = strstr(body, "\"positions\":[[");
    int commas = 0;
    if (!strstr(look, "\"position\":") || !corner) return false;
    for (corner += 14; *corner != ']'; corner++)
        commas += *corner == ',';
    return commas > 2;
}

TEST(odd_pictures_are_the_same_everywhere)
{
    struct zr_team *teams[ZR_ISA_COUNT + 1];
    struct zr_arena arena;
    int count = 0, pictures = 0;
    zr_arena_init(&arena, (size_t)1 << 28);
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++)
        if (zr_isa_is_available((enum zr_isa)isa)) teams[count++] = zr_team_create_for(1, (enum zr_isa)isa);
    teams[count++] = zr_team_create(7);
    for (int i = 0; i < count; i++)
        assert_non_null(teams[i]);
    for (int body = 0; body < BODIES; body++)
        for (int view = 0; view < VIEWS; view++)
            for (int round = 0; round < 3; round++, pictures++) {
                char text[4096];
                const int window = pictures % WINDOWS, look = (pictures / WINDOWS + pictures * 7) % LOOKS;
                if (is_refused(looks[look], bodies[body])) continue;
                snprintf(text, sizeof text, "{\"window\":{\"width\":%u,\"height\":%u},%s,\"meshes\":[{%s}]%s}",
                         windows[window].width, windows[window].height, looks[look], bodies[body], views[view]);
                picture_assert_same(&arena, teams, count, text);
                zr_arena_reset(&arena, SIZE_MAX);
            }
    for (int i = 0; i < count; i++)
        zr_team_destroy(teams[i]);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
