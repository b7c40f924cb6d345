/* Combined solids: random trees of turned boxes beside rays through them in doubles, the same for all algorithms; and
 * solids that a single mesh shows, too. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/random.h"
#include "support/renderer.h"
#include "support/tests.h"

enum { WIDTH = 80, HEIGHT = 60, PIXELS = WIDTH * HEIGHT, BOXES_MAX = 6, STEPS_MAX = 32, TEXT = 1 << 14 };
#define VIEW_HALF 2.0 /* half of the height of the window, and the distance of the eye times 1/4 */
#define EYE_Z     8.0

struct box {
    double size[3], at[3], turn[3][3]; /* columns: its axes in the world */
    double quaternion[4];
};

/* A step of a tree in postfix order: the number of a box, or an operation below 0. */
enum { UNION = -1, DIFFERENCE = -2, INTERSECTION = -3 };

struct tree {
    struct box boxes[BOXES_MAX];
    int box_count, step_count, steps[STEPS_MAX];
    size_t used;
    char text[TEXT];
};

static void put(struct tree *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(struct tree *t, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    t->used += (size_t)vsnprintf(t->text + t->used, sizeof t->text - t->used, format, list);
    va_end(list);
    assert_true(t->used < sizeof t->text);
}

/* ---- random trees ---- */

static struct box random_box(struct random *r)
{
    struct box box;
    double length = 0.0, *q = box.quaternion;
    for (int k = 0; k < 4; k++) {
        q[k] = random_range(r, -1.0, 1.0);
        length += q[k] * q[k];
    }
    for (int k = 0; k < 4; k++)
        q[k] /= sqrt(length);
    for (int k = 0; k < 3; k++) {
        box.size[k] = random_range(r, 0.4, 2.0);
        box.at[k] = random_range(r, -0.6, 0.6);
    }
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                               {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                               {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
    memcpy(box.turn, turn, sizeof turn);
    return box;
}

/* Writes an operand: a box, or an operation with 2 or 3 operands. */
static void put_operand(struct random *r, struct tree *t, int depth)
{
    static const char *const names[] = {"union", "difference", "intersection"};
    if (depth == 3 || t->box_count >= BOXES_MAX - 2 || (depth > 0 && random_below(r, 3) == 0)) {
        const int box = t->box_count < BOXES_MAX ? t->box_count++ : (int)random_below(r, BOXES_MAX);
        put(t, "\"b%d\"", box);
        t->steps[t->step_count++] = box;
        return;
    }
    const int op = (int)random_below(r, 3), count = 2 + (int)random_below(r, 2);
    put(t, "{\"%s\": [", names[op]);
    for (int i = 0; i < count; i++) {
        put(t, "%s", i > 0 ? ", " : "");
        put_operand(r, t, depth + 1);
        if (i > 0) t->steps[t->step_count++] = -1 - op;
    }
    put(t, "]}");
}

static void make_tree(uint64_t seed, const char *algorithm, struct tree *t)
{
    struct random r = random_seeded(seed);
    memset(t, 0, sizeof *t);
    put(t,
        "{\"window\": {\"width\": %d, \"height\": %d}, \"algorithm\": \"%s\", \"view\": {\"eye\": [0, 0, %g], "
        "\"target\": [0, 0, 0], \"up\": [0, 1, 0], \"orthographic\": {\"xmag\": %.17g, \"ymag\": %g}, \"znear\": 1, "
        "\"zfar\": 20}, "
        "\"outputs\": [{\"channel\": \"depth\"}, {\"channel\": \"instanceId\"}], \"csg\": ",
        WIDTH, HEIGHT, algorithm, EYE_Z, VIEW_HALF * WIDTH / HEIGHT, VIEW_HALF);
    put_operand(&r, t, 0);
    put(t, ", \"meshes\": [");
    for (int i = 0; i < t->box_count; i++) {
        struct box *box = &t->boxes[i];
        *box = random_box(&r);
        put(t, "%s{\"shape\": {\"type\": \"box\", \"size\": [%.17g, %.17g, %.17g]}}", i > 0 ? ", " : "", box->size[0],
            box->size[1], box->size[2]);
    }
    put(t, "], \"nodes\": [");
    for (int i = 0; i < t->box_count; i++) {
        const struct box *box = &t->boxes[i];
        const double *q = box->quaternion;
        put(t,
            "%s{\"name\": \"b%d\", \"mesh\": %d, \"translation\": [%.17g, %.17g, %.17g], \"rotation\": [%.17g, %.17g, "
            "%.17g, %.17g]}",
            i > 0 ? ", " : "", i, i, box->at[0], box->at[1], box->at[2], q[0], q[1], q[2], q[3]);
    }
    put(t, "]}");
}

/* ---- the judge ---- */

/* A place where a ray enters or leaves a box. */
struct event {
    double depth;
    int box, side;
};

static int by_depth(const void *a, const void *b)
{
    const double x = ((const struct event *)a)->depth, y = ((const struct event *)b)->depth;
    return (x > y) - (x < y);
}

static bool value_of(const struct tree *t, unsigned inside)
{
    bool stack[STEPS_MAX];
    int top = 0;
    for (int i = 0; i < t->step_count; i++) {
        const int step = t->steps[i];
        if (step >= 0) {
            stack[top++] = inside >> step & 1;
            continue;
        }
        const bool b = stack[--top], a = stack[--top];
        stack[top++] = step == UNION ? a || b : step == DIFFERENCE ? a && !b : a && b;
    }
    return stack[0];
}

/* Adds the ray's way through a box by slabs; the ray goes along -z. */
static int meet(const struct box *box, int number, double x, double y, struct event *events)
{
    struct event first = {-HUGE_VAL, number, 0}, last = {HUGE_VAL, number, 0};
    const double from[3] = {x - box->at[0], y - box->at[1], EYE_Z - box->at[2]};
    for (int k = 0; k < 3; k++) {
        const double *axis = box->turn[k], along = -axis[2];
        const double o = axis[0] * from[0] + axis[1] * from[1] + axis[2] * from[2];
        const double a = (-0.5 * box->size[k] - o) / along, b = (0.5 * box->size[k] - o) / along;
        const double near = a < b ? a : b, far = a < b ? b : a;
        if (near > first.depth) first = (struct event){near, number, 2 * k + (a < b)};
        if (far < last.depth) last = (struct event){far, number, 2 * k + (a >= b)};
    }
    if (!(first.depth < last.depth)) return 0;
    events[0] = first;
    events[1] = last;
    return 2;
}

/* Returns the visible event of the ray at x, y of the window, in pixels from its upper left; box -1: none. */
static struct event judge(const struct tree *t, double x, double y)
{
    struct event events[2 * BOXES_MAX];
    int count = 0;
    unsigned inside = 0;
    const double scale = 2.0 * VIEW_HALF / HEIGHT;
    for (int i = 0; i < t->box_count; i++)
        count += meet(&t->boxes[i], i, (x - 0.5 * WIDTH) * scale, (0.5 * HEIGHT - y) * scale, events + count);
    qsort(events, (size_t)count, sizeof *events, by_depth);
    for (int i = 0; i < count; i++) {
        inside ^= 1u << events[i].box;
        if (value_of(t, inside)) return events[i];
    }
    return (struct event){HUGE_VAL, -1, 0};
}

static bool is_same(struct event a, struct event b)
{
    return a.box == b.box && a.side == b.side;
}

/* True if all samples within a pixel see the same face. */
static bool is_inside_a_face(const struct tree *t, int x, int y)
{
    const struct event middle = judge(t, x + 0.5, y + 0.5);
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++)
            if (!is_same(middle, judge(t, x + 0.5 + 0.5 * dx, y + 0.5 + 0.5 * dy))) return false;
    return true;
}

/* Compares a picture with the rays; returns the number of covered pixels whose face was seen by all around. */
static int compare(const struct tree *t, uint64_t seed, const float *depth, const uint32_t *ids)
{
    int covered = 0, edges = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const struct event event = judge(t, x + 0.5, y + 0.5);
            const size_t i = (size_t)(y * WIDTH + x);
            const bool is_right =
                ids[i] == (uint32_t)(event.box + 1) && (event.box < 0 || fabs((double)depth[i] - event.depth) < 1e-5);
            if (is_right) {
                covered += event.box >= 0;
            } else if (is_inside_a_face(t, x, y)) {
                fail_msg("tree %d: pixel %d, %d has box %d at %.9g, not %d at %.9g", (int)seed, x, y, (int)ids[i] - 1,
                         (double)depth[i], event.box, event.depth);
            } else {
                edges++;
            }
        }
    if (edges > 20 + covered / 20) fail_msg("tree %d: %d of %d pixels differ", (int)seed, edges, covered);
    return covered;
}

static const void *array_of(zraster_picture *picture, const char *channel)
{
    struct zraster_array array;
    assert_true(zraster_picture_channel(picture, channel, &array));
    return array.data;
}

TEST(random_trees_equal_rays_through_their_boxes)
{
    static struct tree t;
    int covered = 0;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        make_tree(seed, "halfspace", &t);
        zraster_picture *picture = picture_of(renderer, t.text);
        covered += compare(&t, seed, array_of(picture, "depth"), array_of(picture, "instanceId"));
        zraster_picture_free(picture);
    }
    assert_true(covered > 50000); /* trees that are empty prove little */
}

TEST(all_algorithms_draw_the_same_solids)
{
    static const char *const others[] = {"edgelist", "trapezoid", "scanline"};
    static struct tree t;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        make_tree(seed, "halfspace", &t);
        zraster_picture *picture = picture_of(renderer, t.text);
        for (int i = 0; i < 3; i++) {
            make_tree(seed, others[i], &t);
            zraster_picture *other = picture_of(renderer, t.text);
            if (!is_same_bytes(bytes_of(picture, "depth"), bytes_of(other, "depth")) ||
                !is_same_bytes(bytes_of(picture, "instanceId"), bytes_of(other, "instanceId")))
                fail_msg("tree %d: %s differs", (int)seed, others[i]);
            zraster_picture_free(other);
        }
        zraster_picture_free(picture);
    }
}

/* ---- solids that one mesh shows ---- */

#define LOOKED                                                                                                         \
    "\"window\": {\"width\": 120, \"height\": 90}, \"look\": \"studio\", \"view\": {\"eye\": [3, 2, 4], \"target\": "  \
    "[0, 0, 0], \"znear\": 1, \"zfar\": 30}, "
#define CUBE "{\"name\": \"cube\", \"shape\": {\"type\": \"box\", \"size\": 2}}"

static void assert_same_picture(const char *text, const char *wanted)
{
    zraster_picture *a = picture_of(renderer, text), *b = picture_of(renderer, wanted);
    const struct zraster_bytes got = bytes_of(a, "color"), want = bytes_of(b, "color");
    if (!is_same_bytes(got, want)) fail_msg("%s: another picture than that of %s", text, wanted);
    zraster_picture_free(a);
    zraster_picture_free(b);
}

TEST(one_operand_is_drawn_as_without_a_tree)
{
    assert_same_picture("{" LOOKED "\"csg\": {\"union\": [\"cube\"]}, \"meshes\": [" CUBE "]}",
                        "{" LOOKED "\"meshes\": [" CUBE "]}");
    assert_same_picture(
        "{" LOOKED "\"csg\": {\"difference\": [\"cube\", \"far\"]}, \"meshes\": [" CUBE
        ", {\"name\": \"far\", \"shape\": {\"type\": \"box\", \"size\": 1}}], \"nodes\": [{\"mesh\": 0}, {\"mesh\": 1, "
        "\"translation\": [9, 9, 9]}]}",
        "{" LOOKED "\"meshes\": [" CUBE "]}");
}

/* Half of the cube goes: faces of both lie in common planes, where nothing may be left. */
TEST(faces_in_common_planes_leave_nothing)
{
    static const char *const tools[] = {"[1, 2, 2]", "[1, 2, 2.5]", "[2, 2, 2]", "[2, 2, 3]"};
    static const double shifts[] = {0.5, 0.5, 0.0, 0.5};
    static char text[1024];
    for (int i = 0; i < 4; i++)
        for (int angle = 0; angle < 360; angle += 30) {
            snprintf(
                text, sizeof text,
                "{\"window\": {\"width\": 64, \"height\": 64}, \"view\": {\"azimuthDegrees\": %d, "
                "\"elevationDegrees\": "
                "%d}, \"outputs\": [{\"channel\": \"instanceId\"}, {\"channel\": \"position\", \"space\": \"world\"}], "
                "\"csg\": "
                "{\"difference\": "
                "[\"cube\", \"tool\"]}, \"meshes\": [" CUBE
                ", {\"name\": \"tool\", \"shape\": {\"type\": \"box\", \"size\": %s}}], \"nodes\": [{\"mesh\": 0}, "
                "{\"mesh\": 1, \"translation\": [%g, 0, 0]}]}",
                angle, angle / 3 - 40, tools[i], i < 3 ? shifts[i] : 0.0);
            zraster_picture *picture = picture_of(renderer, text);
            const uint32_t *ids = array_of(picture, "instanceId");
            const float *places = array_of(picture, "position");
            int covered = 0;
            for (int p = 0; p < 64 * 64; p++) {
                if (ids[p] == 0) continue;
                covered++;
                if ((double)places[3 * p] > 1e-4)
                    fail_msg("%s: something is left at x = %g", text, (double)places[3 * p]);
            }
            if ((covered > 200) != (i < 2)) fail_msg("%s: %d pixels", text, covered);
            zraster_picture_free(picture);
        }
}

/* ---- volumes ---- */

/* Returns the number behind a key of the object csg of info. */
static double number_of(const char *info, const char *key)
{
    const char *csg = strstr(info, "\"csg\":{"), *at = csg ? strstr(csg, key) : NULL;
    if (!at) fail_msg("no %s in %s", key, info);
    return atof(at + strlen(key));
}

TEST(volumes_are_those_of_the_boxes)
{
    static const struct {
        const char *tree;
        double volume, center;
    } cases[] = {{"{\"union\": [\"a\", \"b\"]}", 10, (8 * 5.0 + 4 * 5.5 - 2 * 5.5) / 10},
                 {"{\"difference\": [\"a\", \"b\"]}", 6, (8 * 5.0 - 2 * 5.5) / 6},
                 {"{\"intersection\": [\"a\", \"b\"]}", 2, 5.5},
                 {"{\"difference\": [\"a\", \"a\"]}", 0, 0}};
    static char text[1024], info[1 << 14];
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        snprintf(
            text, sizeof text,
            "{\"render\": false, \"outputs\": [{\"channel\": \"info\"}], \"csg\": %s, \"meshes\": [{\"shape\": "
            "{\"type\": \"box\", \"size\": 2}}, {\"shape\": {\"type\": \"box\", \"size\": [1, 1, 4]}}], \"nodes\": "
            "[{\"name\": \"a\", \"mesh\": 0, \"translation\": [5, 0, 0]}, {\"name\": \"b\", \"mesh\": 1, "
            "\"translation\": [5.5, 0, 0]}]}",
            cases[i].tree);
        zraster_picture *picture = picture_of(renderer, text);
        const struct zraster_bytes bytes = bytes_of(picture, "info");
        assert_true(bytes.size < sizeof info);
        memcpy(info, bytes.data, bytes.size);
        info[bytes.size] = '\0';
        const double volume = number_of(info, "\"volume\":"), error = number_of(info, "\"volumeError\":");
        if (fabs(volume - cases[i].volume) > 1e-5 || error > 0.005 || fabs(volume - cases[i].volume) > error + 1e-12)
            fail_msg("%s: volume %.9g +- %g, not %g", cases[i].tree, volume, error, cases[i].volume);
        if (cases[i].volume > 0.0) assert_true(fabs(number_of(info, "\"centerOfMass\":[") - cases[i].center) < 1e-5);
        zraster_picture_free(picture);
    }
}

RUN_TESTS(open_renderer, close_renderer)
