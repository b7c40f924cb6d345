#include "overlay/annotate/corner_marks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/rgba.h"
#include "overlay/annotate/box_dimensions.h"
#include "overlay/annotate/length_text.h"

/* Distance of marks from the border, in heights of capitals. */
static const double border = 1.2;

/* ---- title ---- */

/* Returns the name: that of the scene, of its only mesh, or the number of meshes. */
static const char *name_of(const struct zr_layout *l)
{
    const struct zr_scene *scene = l->scene;
    const char *given = l->frame->view->annotate.title;
    if (given) return given;
    for (uint32_t i = 1; i < scene->instance_count; i++) {
        if (scene->instances[i].mesh == scene->instances[0].mesh) continue;
        char *text = zr_arena_alloc(l->arena, 32, 1);
        if (text) snprintf(text, 32, "%u meshes", scene->instance_count);
        return text ? text : "";
    }
    if (scene->instance_count == 0) return "";
    const char *name = scene->meshes[scene->instances[0].mesh].name;
    return name ? name : "";
}

/* Returns the text, or its beginning with dots if it is wider than `most`. */
static const char *shorten(const struct zr_layout *l, const char *text, double height, double most)
{
    if (zr_type_width(text, height) <= most) return text;
    const size_t length = strlen(text);
    char *cut = zr_arena_alloc(l->arena, length + 4, 1);
    for (size_t end = length; cut && end > 0;) {
        do
            end--;
        while (end > 0 && ((unsigned char)text[end] & 0xc0) == 0x80);
        memcpy(cut, text, end);
        memcpy(cut + end, "...", 4);
        if (zr_type_width(cut, height) <= most) return cut;
    }
    return "...";
}

static void write_size(const struct zr_layout *l, char *text, size_t room)
{
    char numbers[3][ZR_LENGTH_SIZE];
    double largest;
    const zr_dvec3 size = zr_box_size(l, &largest);
    const char *unit = zr_unit_sign(l->scene->file.unit);
    zr_length_write(size.x, largest, "", numbers[0]);
    zr_length_write(size.y, largest, "", numbers[1]);
    zr_length_write(size.z, largest, "", numbers[2]);
    snprintf(text, room, "%.60s \xc3\x97 %.60s \xc3\x97 %.60s%s%s", numbers[0], numbers[1], numbers[2],
             *unit               ? " "
             : l->scene->file.up ? "  (file has no unit)"
                                 : "",
             unit);
}

void zr_title_place(struct zr_layout *l)
{
    enum { ROOM = 256, NAME_MAX = 300 };
    const double h = l->letters, large = floor(1.25 * h + 0.5), x = border * h, most = l->width - 2.0 * x;
    const double y = border * h + large, below = y + 2.0 * h;
    char *given = zr_arena_copy(l->arena, name_of(l), strnlen(name_of(l), NAME_MAX) + 1);
    char *size = zr_arena_alloc(l->arena, ROOM, 1);
    if (!given || !size) return;
    given[strnlen(name_of(l), NAME_MAX)] = '\0';
    const char *name = shorten(l, given, large, most);
    *size = '\0';
    if (l->frame->bounds.valid) write_size(l, size, ROOM);
    const char *line = shorten(l, size, h, most);
    const double first = *name ? y : border * h + h, second = *name ? below : first;
    const struct zr_rect rect = zr_layout_text_rect(x, first, zr_type_width(name, large), large, 0.2 * h);
    const struct zr_rect rest = zr_layout_text_rect(x, second, zr_type_width(line, h), h, 0.2 * h);
    if (!zr_layout_is_apart(l, rect) || !zr_layout_is_apart(l, rest)) {
        zr_layout_leave_out(l, "title", "no room", ZR_LEFT_OUT_NO_ROOM);
        return;
    }
    if (*name) zr_layout_write(l, name, x, first, large, l->ink, true);
    if (*line) zr_layout_write(l, line, x, second, h, l->ink, true);
    if (*name) zr_layout_take_rect(l, rect);
    if (*line) zr_layout_take_rect(l, rest);
}

/* ---- triad ---- */

struct tip {
    int axis;
    double x, y, z; /* in eye space, y downwards; z grows to the eye */
};

/* Returns the middle of a letter beside the tip of an axis, the first place that lines and letters leave free. */
static struct zr_point letter_place(const struct tip *tips, const struct zr_point *letters, int count,
                                    struct zr_point center, struct tip tip, double h, double radius)
{
    static const double ways[][2] = {{0, 0},      {0, -1},      {1, 0},     {-1, 0},    {0, 1},
                                     {0.7, -0.7}, {-0.7, -0.7}, {0.7, 0.7}, {-0.7, 0.7}};
    const double length = sqrt(tip.x * tip.x + tip.y * tip.y);
    struct zr_point first = center;
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct zr_point at = {center.x + radius * tip.x, center.y + radius * tip.y};
        if (i == 0 && length > 0.15) {
            at.x += 1.1 * h * tip.x / length;
            at.y += 1.1 * h * tip.y / length;
        } else {
            at.x += 1.2 * h * ways[i][0];
            at.y += 1.2 * h * ways[i][1];
        }
        if (i == 0) first = at;
        const struct zr_rect rect = {at.x - 0.5 * h, at.y - 0.65 * h, at.x + 0.5 * h, at.y + 0.65 * h};
        bool is_free = i > 0 || length > 0.15;
        for (int k = 0; k < 3; k++) {
            const struct zr_point end = {center.x + radius * tips[k].x, center.y + radius * tips[k].y};
            if (zr_layout_line_meets((struct zr_segment){center, end}, rect)) is_free = false;
        }
        for (int k = 0; k < count; k++)
            if (fabs(letters[k].x - at.x) < h && fabs(letters[k].y - at.y) < 1.3 * h) is_free = false;
        if (is_free) return at;
    }
    return first;
}

/* Sorts axes, those that point away from the eye first. */
static void sort_tips(struct tip tips[3])
{
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2 - i; k++)
            if (tips[k].z > tips[k + 1].z + 1e-9) {
                const struct tip swapped = tips[k];
                tips[k] = tips[k + 1];
                tips[k + 1] = swapped;
            }
}

static void draw_axis(struct zr_layout *l, struct zr_point center, struct tip tip, double radius, uint32_t color)
{
    const double length = sqrt(tip.x * tip.x + tip.y * tip.y), arrow = 0.9 * l->letters;
    const struct zr_point end = {center.x + radius * tip.x, center.y + radius * tip.y};
    const struct zr_ink ink = zr_layout_ink(l, color, 1.0, false);
    if (length <= 0.15) {
        zr_marks_add_disc(l->marks, center, 1.8 * l->line, ink);
        return;
    }
    zr_layout_draw(l, (struct zr_segment){center, end}, color, 1.0, false);
    zr_marks_add_arrow(l->marks, end, tip.x / length, tip.y / length, fmin(arrow, radius * length), 0.28 * arrow, ink);
}

/* Finds the directions of the axes, in the order of drawing. */
static void find_tips(const struct zr_layout *l, struct tip tips[3])
{
    const float *m = l->frame->camera.world_to_eye.m;
    for (int a = 0; a < 3; a++) {
        const zr_dvec3 axis = l->axes[a];
        const double x = (double)m[0] * axis.x + (double)m[4] * axis.y + (double)m[8] * axis.z;
        const double y = (double)m[1] * axis.x + (double)m[5] * axis.y + (double)m[9] * axis.z;
        const double z = (double)m[2] * axis.x + (double)m[6] * axis.y + (double)m[10] * axis.z;
        const double size = fmax(sqrt(x * x + y * y + z * z), 1e-30);
        tips[a] = (struct tip){a, x / size, -y / size, z / size};
    }
    sort_tips(tips);
}

void zr_triad_place(struct zr_layout *l)
{
    static const float colors[2][3][3] = {{{0.8f, 0.12f, 0.12f}, {0.1f, 0.52f, 0.16f}, {0.1f, 0.3f, 0.8f}},
                                          {{1.0f, 0.5f, 0.47f}, {0.5f, 0.87f, 0.52f}, {0.56f, 0.71f, 1.0f}}};
    static const char *const names[] = {"X", "Y", "Z"};
    const double h = l->letters, radius = 2.6 * h;
    const int theme = l->is_dark ? 1 : 0;
    struct tip tips[3];
    struct zr_point letters[3], center = {0.0, 0.0};
    struct zr_rect rect = {-0.3 * h, -0.3 * h, 0.3 * h, 0.3 * h};
    find_tips(l, tips);
    for (int i = 0; i < 3; i++) {
        letters[i] = letter_place(tips, letters, i, center, tips[i], h, radius);
        rect.x0 = fmin(rect.x0, fmin(letters[i].x - 0.5 * h, radius * tips[i].x));
        rect.x1 = fmax(rect.x1, fmax(letters[i].x + 0.5 * h, radius * tips[i].x));
        rect.y0 = fmin(rect.y0, fmin(letters[i].y - 0.7 * h, radius * tips[i].y));
        rect.y1 = fmax(rect.y1, fmax(letters[i].y + 0.7 * h, radius * tips[i].y));
    }
    center = (struct zr_point){border * h - rect.x0, l->height - border * h + 0.2 * h - rect.y1};
    rect = (struct zr_rect){center.x + rect.x0 - 0.3 * h, center.y + rect.y0 - 0.3 * h, center.x + rect.x1 + 0.3 * h,
                            center.y + rect.y1 + 0.3 * h};
    if (!zr_layout_is_apart(l, rect)) {
        zr_layout_leave_out(l, "triad", "no room", ZR_LEFT_OUT_NO_ROOM);
        return;
    }
    for (int i = 0; i < 3; i++) {
        const float *color = colors[theme][tips[i].axis];
        const uint32_t ink = zr_rgba_make((zr_vec4){color[0], color[1], color[2], 1.0f});
        const char *name = names[tips[i].axis];
        draw_axis(l, center, tips[i], radius, ink);
        zr_layout_write(l, name, center.x + letters[i].x - 0.5 * zr_type_width(name, h),
                        center.y + letters[i].y + 0.5 * h, h, ink, true);
    }
    zr_layout_take_rect(l, rect);
}

/* ---- scale bar ---- */

/* Adds a filled box. */
static void fill(struct zr_layout *l, double x0, double y0, double x1, double y1, uint32_t color)
{
    const struct zr_point corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    zr_marks_add_area(l->marks, corners, 4, zr_layout_ink(l, color, 0.0, false));
}

void zr_scale_place(struct zr_layout *l)
{
    const struct zr_camera *camera = &l->frame->camera;
    const float *p = camera->projection.m;
    if (p[3] != 0.0f || p[7] != 0.0f || p[11] != 0.0f) {
        zr_layout_leave_out(l, "scale", "lengths depend on the depth in a perspective view", ZR_LEFT_OUT_BY_VIEW);
        return;
    }
    const double h = l->letters;
    const double per_unit = fabs((double)p[0]) * 0.5 * l->width * (double)zr_eye_scale_of(camera);
    if (!(per_unit > 1e-30 && per_unit < 1e30)) return;
    int digit;
    const double length = zr_length_round(0.22 * l->width / per_unit, &digit), taken = length * per_unit;
    const int fields = digit == 2 ? 4 : 5;
    char *text = zr_arena_alloc(l->arena, ZR_LENGTH_SIZE, 1);
    if (!text) return;
    zr_length_write(length, length, zr_unit_sign(l->scene->file.unit), text);
    const double text_width = zr_type_width(text, h), high = fmax(floor(0.4 * h + 0.5), 3.0), line = fmax(l->line, 1.0);
    double right = floor(l->width - border * h - fmax(0.5 * text_width, 0.5 * h));
    for (uint32_t i = 0; i < l->rect_count; i++) /* a colour bar */
        if (l->rects[i].y1 > l->height - 4.0 * h && l->rects[i].x1 > 0.75 * l->width)
            right = fmin(right, l->rects[i].x0 - h - 0.5 * text_width);
    const double left = right - taken, bottom = floor(l->height - border * h), top = bottom - high;
    const double base = top - 0.6 * h, zero = zr_type_width("0", h);
    const struct zr_rect rect = {left - 0.5 * zero - 0.4 * h, base - 1.3 * h, right + 0.5 * text_width + 0.4 * h,
                                 bottom + 0.4 * h};
    if (!zr_layout_is_inside(l, rect) || !zr_layout_is_apart(l, rect)) {
        zr_layout_leave_out(l, "scale", "no room", ZR_LEFT_OUT_NO_ROOM);
        return;
    }
    fill(l, left - line, top - line, right + line, bottom + line, l->ink);
    for (int i = 1; i < fields; i += 2)
        fill(l, left + taken * i / fields, top, left + taken * (i + 1) / fields, bottom, l->paper);
    zr_layout_write(l, "0", left - 0.5 * zero, base, h, l->ink, true);
    zr_layout_write(l, text, right - 0.5 * text_width, base, h, l->ink, true);
    zr_layout_take_rect(l, rect);
}
