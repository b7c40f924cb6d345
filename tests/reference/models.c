#include "reference/models.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/formats/input.h"
#include "reference/page/page.h"
#include "reference/subject.h"
#include "render_request.h"
#include "scene/looks.h"
#include "support/files.h"

static const char *const names[] = {"stanford-bunny", "teapot"};

/* Where the camera is, seen from the model's middle, and how far off in radii of
 * the model. From the last one the near plane and the window's edges cut it. */
static const struct {
    double towards[3], distance;
} views[] = {{{0, 0, 1}, 3.0}, {{1, 1, 1}, 3.5}, {{0.5, 0.3, 0.8}, 0.75}};

static const uint32_t windows[][2] = {{1920, 1080}, {509, 383}};

static bool mesh_read(struct zr_arena *arena, const char *bytes, size_t size, struct zr_mesh *mesh)
{
    struct zr_limits limits = zr_limits_default();
    struct zr_scene scene = {.picture = zr_look_textbook()->picture};
    struct zr_scene_builder builder = zr_scene_builder_open(arena, NULL, &scene);
    struct zr_error error = {.status = ZR_OK};
    const struct zr_request request = {.format = ZR_FORMAT_OBJ, .bytes = bytes, .size = size};
    enum zr_status status = zr_read_OBJ(&builder, &request, &limits, &error);
    zr_scene_builder_close(&builder);
    if (status == ZR_OK) *mesh = builder.meshes[0];
    if (status == ZR_OK) return true;
    fprintf(stderr, "OBJ: status %d, %s\n", (int)status, error.count ? error.items[0].detail : "");
    return false;
}

/* ---- colours ---- */

static zr_vec3 xyz(zr_vec4 v)
{
    return (zr_vec3){v.x, v.y, v.z};
}

/* Sums of face normals, weighted by area, turned into colours. */
static bool normal_colors(const struct zr_mesh *mesh, zr_vec4 *colors)
{
    zr_vec3 *sums = calloc(mesh->position_count ? mesh->position_count : 1, sizeof *sums);
    if (!sums) return false;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t *corner = mesh->indices + mesh->face_offsets[face];
        uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
        zr_vec3 a = xyz(mesh->positions[corner[0]]), b = xyz(mesh->positions[corner[1]]);
        zr_vec3 c = xyz(mesh->positions[corner[2]]);
        zr_vec3 normal = zr_vec3_cross(zr_vec3_sub(b, a), zr_vec3_sub(c, a));
        for (uint32_t i = 0; i < count; i++)
            sums[corner[i]] = zr_vec3_add(sums[corner[i]], normal);
    }
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        zr_vec3 n = zr_vec3_normalize(sums[i]);
        colors[i] = (zr_vec4){n.x * 0.5f + 0.5f, n.y * 0.5f + 0.5f, n.z * 0.5f + 0.5f, 1.0f};
    }
    free(sums);
    return true;
}

static bool fill_drawing(const struct zr_mesh *mesh, struct drawing *drawing)
{
    zr_vec4 *colors = malloc((mesh->position_count + (size_t)1) * sizeof *colors);
    if (!colors || !normal_colors(mesh, colors)) {
        free(colors);
        return false;
    }
    drawing_start(drawing, 1, 1);
    for (uint32_t i = 0; i < mesh->position_count; i++)
        drawing_position(drawing, mesh->positions[i], colors[i]);
    for (uint32_t face = 0; face < mesh->face_count; face++)
        drawing_face(drawing, mesh->indices + mesh->face_offsets[face],
                     mesh->face_offsets[face + 1] - mesh->face_offsets[face]);
    free(colors);
    return !drawing->failed;
}

/* ---- the camera ---- */

struct sphere {
    double center[3], radius;
};

static struct sphere sphere_around(const struct drawing *drawing)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        zr_vec4 p = drawing->positions[i];
        double at[3] = {(double)p.x, (double)p.y, (double)p.z};
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    struct sphere sphere = {.radius = 0};
    for (int k = 0; k < 3; k++) {
        sphere.center[k] = (low[k] + high[k]) / 2;
        sphere.radius += (high[k] - low[k]) * (high[k] - low[k]) / 4;
    }
    sphere.radius = sqrt(sphere.radius);
    return sphere;
}

/* As gluLookAt, with y up. */
static zr_mat4 look_at(const struct sphere *sphere, const double towards[3], double distance)
{
    double back[3], right[3], up[3], eye[3];
    double length = sqrt(towards[0] * towards[0] + towards[1] * towards[1] + towards[2] * towards[2]);
    for (int k = 0; k < 3; k++)
        back[k] = towards[k] / length;
    for (int k = 0; k < 3; k++)
        eye[k] = sphere->center[k] + back[k] * distance;
    double flat = sqrt(back[0] * back[0] + back[2] * back[2]);
    right[0] = back[2] / flat;
    right[1] = 0;
    right[2] = -back[0] / flat;
    up[0] = back[1] * right[2] - back[2] * right[1];
    up[1] = back[2] * right[0] - back[0] * right[2];
    up[2] = back[0] * right[1] - back[1] * right[0];
    const double *rows[3] = {right, up, back};
    zr_mat4 m = zr_mat4_identity();
    for (int row = 0; row < 3; row++) {
        double move = 0;
        for (int k = 0; k < 3; k++) {
            m.m[k * 4 + row] = (float)rows[row][k];
            move -= rows[row][k] * eye[k];
        }
        m.m[12 + row] = (float)move;
    }
    return m;
}

static zr_mat4 perspective(double focal, double aspect, double n, double f)
{
    zr_mat4 m = {{0}};
    m.m[0] = (float)(focal / aspect);
    m.m[5] = (float)focal;
    m.m[10] = (float)(-(f + n) / (f - n));
    m.m[11] = -1.0f;
    m.m[14] = (float)(-2 * f * n / (f - n));
    return m;
}

/* Where a drawing's camera stands. */
static void place_camera(struct drawing *drawing, const struct sphere *sphere, size_t view, uint32_t width,
                         uint32_t height)
{
    double distance = views[view].distance * sphere->radius;
    drawing->width = width;
    drawing->height = height;
    drawing->modelview = look_at(sphere, views[view].towards, distance);
    drawing->projection = perspective(2.5, (double)width / height,
                                      fmax(distance - sphere->radius, 0.4 * sphere->radius), distance + sphere->radius);
}

static enum verdict check_views(struct harness *harness, struct report *report, struct drawing *drawing,
                                const char *label, struct tally *tally)
{
    struct sphere sphere = sphere_around(drawing);
    enum verdict worst = VERDICT_EQUAL;
    uint64_t number = 0;
    for (size_t v = 0; v < MODELS_VIEWS; v++)
        for (size_t w = 0; w < sizeof windows / sizeof *windows; w++) {
            place_camera(drawing, &sphere, v, windows[w][0], windows[w][1]);
            struct subject subject;
            struct harness_pictures pictures;
            subject_make(&subject, drawing);
            enum verdict verdict = harness_check(harness, &subject.scene, label, number++, tally, &pictures);
            if (report->page) page_picture(report->page, label, verdict, &pictures);
            if (verdict > worst) worst = verdict;
        }
    return worst;
}

static enum verdict check_model(struct harness *harness, struct report *report, const char *name,
                                struct drawing *drawing, struct tally *sum)
{
    enum verdict worst = VERDICT_EQUAL;
    for (int smooth = 0; smooth < 2 && worst != VERDICT_UNPROVED; smooth++) {
        char label[80];
        struct tally tally = {0};
        snprintf(label, sizeof label, "%s-%s", name, smooth ? "smooth" : "flat");
        drawing->smooth = smooth;
        enum verdict verdict = check_views(harness, report, drawing, label, &tally);
        if (verdict == VERDICT_EQUAL && (tally.comparison.visible == 0 || tally.clipped == 0))
            verdict = VERDICT_UNPROVED;
        report_line(report, label, verdict, &tally);
        tally_add(sum, &tally);
        if (verdict > worst) worst = verdict;
    }
    return worst;
}

/* *there tells a file that is missing from one that is no model. */
static bool load(struct drawing *drawing, const char *directory, const char *name, bool *there)
{
    char path[600];
    size_t size = 0;
    snprintf(path, sizeof path, "%s/%s.obj", directory, name);
    char *bytes = file_read(path, &size);
    *there = bytes != NULL;
    if (!bytes) {
        fprintf(stderr, "LEFT OUT: model %s: %s: %s\n", name, path, strerror(errno));
        return false;
    }
    struct zr_arena arena;
    struct zr_mesh mesh = {0};
    zr_arena_init(&arena, (size_t)1 << 30);
    bool ok = mesh_read(&arena, bytes, size, &mesh) && fill_drawing(&mesh, drawing);
    zr_arena_free(&arena);
    free(bytes);
    return ok;
}

bool models_drawing(struct drawing *drawing, const char *directory, const char *name, size_t view, uint32_t width,
                    uint32_t height)
{
    bool there;
    if (!load(drawing, directory, name, &there)) return false;
    models_look(drawing, view, width, height);
    return true;
}

void models_look(struct drawing *drawing, size_t view, uint32_t width, uint32_t height)
{
    struct sphere sphere = sphere_around(drawing);
    place_camera(drawing, &sphere, view, width, height);
}

enum verdict models_check(struct harness *harness, struct report *report, const char *directory, struct tally *sum)
{
    enum verdict worst = VERDICT_EQUAL;
    int drawn = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct drawing drawing = {0};
        bool there;
        enum verdict verdict = VERDICT_DIFFERENT;
        if (load(&drawing, directory, names[i], &there))
            verdict = check_model(harness, report, names[i], &drawing, sum);
        if (there && verdict > worst) worst = verdict;
        drawn += there;
        drawing_free(&drawing);
    }
    return drawn ? worst : VERDICT_UNPROVED;
}
