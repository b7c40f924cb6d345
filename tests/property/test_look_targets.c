/* Looks beside target pictures, which are not in this repository: LOOK-MODEL.png of 320x240 in
 * DATA/../design/look/targets, of models in DATA/models and DATA/models/parts (DATA is what ZRASTER_DATA says, else
 * ../shared/data). A picture may be off by 4 of 255, root of the mean square over all pixels and channels. Of one that
 * is farther off build/test-pictures has what was got, what was wanted, and their difference. */
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "shade/frame.h"
#include "support/cmocka_all.h"
#include "support/files.h"
#include "support/png.h"
#include "zraster.h"

enum { WIDTH = 320, HEIGHT = 240, CHANNELS = WIDTH * HEIGHT * 3, PATH_SIZE = 1000 };

static const double bound = 4.0;

static const char *data(void)
{
    const char *folder = getenv("ZRASTER_DATA");
    return folder && *folder ? folder : "../shared/data";
}

/* Without normals of its own: the targets have none. In place. */
static void drop_normals(char *obj)
{
    char *end;
    for (char *line = obj; *line; line = *end ? end + 1 : end) {
        end = line + strcspn(line, "\n");
        if (strncmp(line, "vn ", 3) == 0) line[0] = '#';
        if (strncmp(line, "f ", 2) != 0) continue;
        for (char *at = line; at < end; at++) {
            if (*at != '/') continue;
            for (; at < end && *at != ' ' && *at != '\r'; at++)
                *at = ' ';
        }
    }
}

static char *read_model(const char *model)
{
    char path[PATH_SIZE];
    char *bytes = NULL;
    size_t size;
    static const char *const forms[] = {"%s/models/%s.obj", "%s/models/parts/%s.obj", "%s/models/stanford-%s.obj"};
    for (size_t i = 0; !bytes && i < sizeof forms / sizeof *forms; i++) {
        snprintf(path, sizeof path, forms[i], data(), model);
        bytes = file_read(path, &size);
    }
    if (bytes) drop_normals(bytes);
    return bytes;
}

static void leave_pictures(const char *name, const uint8_t *got, const uint8_t *want)
{
    static uint8_t rgba[3][WIDTH * HEIGHT * 4];
    static const char *const kinds[] = {"got", "want", "difference"};
    char path[PATH_SIZE];
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        for (size_t c = 0; c < 4; c++) {
            const int a = c < 3 ? got[4 * i + c] : 255, b = c < 3 ? want[3 * i + c] : 255;
            rgba[0][4 * i + c] = (uint8_t)a;
            rgba[1][4 * i + c] = (uint8_t)b;
            rgba[2][4 * i + c] = c < 3 ? (uint8_t)abs(a - b) : 255;
        }
    mkdir("build/test-pictures", 0777);
    for (int k = 0; k < 3; k++) {
        snprintf(path, sizeof path, "build/test-pictures/%s-%s", kinds[k], name);
        png_file_write(path, rgba[k], WIDTH, HEIGHT);
    }
    print_error("%s: pictures are in build/test-pictures\n", name);
}

static double distance_of(const uint8_t *got, const uint8_t *want)
{
    double sum = 0.0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        for (size_t c = 0; c < 3; c++) {
            const double d = (double)got[4 * i + c] - (double)want[3 * i + c];
            sum += d * d;
        }
    return sqrt(sum / CHANNELS);
}

/* False where it is too far off. */
static bool is_near(const char *folder, const char *name)
{
    char path[PATH_SIZE], look[64], model[64], width[8], height[8];
    uint32_t w, h;
    size_t size;
    struct zr_arena arena;
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    const struct zr_limits limits = zr_limits_default();
    assert_int_equal(sscanf(name, "%63[a-z]-%63[a-z].png", look, model), 2);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *file = file_read(path, &size), *obj = read_model(model);
    if (!file || !obj) fail_msg("%s or its model cannot be read", name);
    uint8_t *want = png_memory_read(file, size, PNG_AS_RGB, &w, &h);
    assert_true(want && w == WIDTH && h == HEIGHT);
    snprintf(width, sizeof width, "%d", WIDTH);
    snprintf(height, sizeof height, "%d", HEIGHT);
    const struct zr_request request = {
        .format = ZR_FORMAT_OBJ, .bytes = obj, .size = strlen(obj), .look = look, .width = width, .height = height};
    zr_arena_init(&arena, (size_t)1 << 30);
    assert_int_equal(zr_scene_read(&arena, NULL, &request, &limits, &scene, &error), ZR_OK);
    assert_int_equal(zr_render(&arena, NULL, scene, NULL, NULL, &frame, &error), ZR_OK);
    const double distance = distance_of(frame->color, want);
    const bool near = distance <= bound;
    print_message("%s: %.2f of 255\n", name, distance);
    if (!near) leave_pictures(name, frame->color, want);
    zr_arena_free(&arena);
    free(want);
    free(file);
    free(obj);
    return near;
}

static void looks_are_near_their_targets(void **state)
{
    char folder[PATH_SIZE];
    struct dirent **entries;
    int seen = 0, far = 0;
    (void)state;
    snprintf(folder, sizeof folder, "%s/../design/look/targets", data());
    const int count = scandir(folder, &entries, NULL, alphasort);
    if (count < 0) {
        fprintf(stderr, "LEFT OUT: there is no %s: looks are not held against target pictures\n", folder);
        skip();
    }
    for (int i = 0; i < count; i++) {
        if (entries[i]->d_name[0] != '.') {
            seen++;
            far += !is_near(folder, entries[i]->d_name);
        }
        free(entries[i]);
    }
    free(entries);
    assert_true(seen > 0);
    assert_int_equal(far, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(looks_are_near_their_targets)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
