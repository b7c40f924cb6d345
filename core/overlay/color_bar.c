#include "overlay/color_bar.h"

#include <math.h>

#include "base/rgba.h"
#include "overlay/type.h"
#include "scene/output.h"

/* ---- scale ---- */

const struct zr_color_scale *zr_color_bar_scale(const struct zr_scene *scene)
{
    if (scene->color_bar.has_mesh) return scene->meshes[scene->color_bar.mesh].scale;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_color_scale *scale = scene->meshes[scene->instances[i].mesh].scale;
        if (scale) return scale;
    }
    return NULL;
}

static bool is_same(const struct zr_color_scale *a, const struct zr_color_scale *b)
{
    return a->map == b->map && a->low == b->low && a->high == b->high;
}

/* Counts instances with a scale other than the bar's. */
static uint32_t count_others(const struct zr_scene *scene, const struct zr_color_scale *shown)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_color_scale *scale = scene->meshes[scene->instances[i].mesh].scale;
        count += scale && !is_same(scale, shown);
    }
    return count;
}

/* ---- layout ---- */

/* Sizes in sevenths of the height of letters. */
enum {
    LETTERS = 7,
    TICK = 2,
    GAP = 4, /* between a tick and its label */
    BAR_WIDTH = 6,
    MARGIN = 4,     /* least distance from the window's edge */
    HALF_LABEL = 4, /* half of the height of a label's ink, at most */
    TITLE_GAP = 7,
    LABELS_APART = 12 /* least distance of labels, from middle to middle */
};

/* Sizes that grow with the window: margins and bar widths per side of the window. */
enum { MARGINS_PER_SIDE = 32, BAR_WIDTHS_PER_SIDE = 20 };

/* Least distance of ticks, and its largest value that fits, as shares of the range. */
#define TICKS_APART     0.125
#define TICKS_APART_MAX 0.2

/* Returns sevenths of the height of letters as pixels, rounded up. */
static int32_t sevenths(int32_t count, int32_t letters)
{
    return (count * letters + LETTERS - 1) / LETTERS;
}

/* Returns the width of a text's ink, rounded up. `width`: that of the text with letters of height 1. */
static int32_t ink_width(double width, int32_t letters)
{
    return width > 0 ? (int32_t)ceil(width * letters + zr_type_pen(letters)) : 0;
}

/* Returns the width of the widest label. */
static int32_t label_width(const struct zr_ticks *ticks, int32_t letters)
{
    int32_t most = 0;
    char text[ZR_DECIMAL_SIZE];
    for (int i = 0; i < ticks->count; i++) {
        zr_decimal_write(ticks->at[i], ticks->is_scientific, text);
        most = zr_greater(most, ink_width(zr_type_width(text, 1), letters));
    }
    return most;
}

/* Places the title above the bar, with the largest letters that fit, at most l->letters. `begin` and `end`: columns of
 * the block below. */
static void place_title(struct zr_color_bar_layout *l, const char *title, bool is_left, int32_t begin, int32_t end,
                        int32_t width)
{
    const int32_t margin = sevenths(MARGIN, l->letters);
    const double unit = zr_type_width(title, 1);
    int32_t letters = l->letters;
    while (letters >= (int32_t)ZR_TYPE_LEAST && ink_width(unit, letters) > width - 2 * margin)
        letters--;
    if (letters < (int32_t)ZR_TYPE_LEAST) return;
    const int32_t taken = ink_width(unit, letters);
    const int32_t half_pen = (int32_t)ceil(zr_type_pen(letters) / 2);
    const int32_t above = (int32_t)ceil(ZR_LETTER_TOP / ZR_LETTER_CAPITAL * letters) + half_pen;
    const int32_t below = (int32_t)ceil(-ZR_LETTER_BOTTOM / ZR_LETTER_CAPITAL * letters) + half_pen;
    l->title = title;
    l->title_letters = letters;
    l->title_x = is_left || taken <= end - begin ? begin : end - taken;
    l->title_x = zr_greater(margin, zr_lesser(l->title_x, width - margin - taken));
    l->title_y = l->bar.y - l->line - sevenths(TITLE_GAP, l->letters);
    l->all = zr_box_join(l->all, (struct zr_box){l->title_x, l->title_y - above, taken, above + below + 1});
}

/* Places all parts for a height of letters. False: no room. */
static bool lay_out(const struct zr_color_bar *bar, const struct zr_color_scale *scale, int32_t width, int32_t height,
                    int32_t letters, struct zr_color_bar_layout *l)
{
    const int32_t margin = zr_greater(sevenths(MARGIN, letters), zr_lesser(width, height) / MARGINS_PER_SIDE);
    const int32_t line = zr_greater(1, (letters + LETTERS) / (2 * LETTERS)), half = sevenths(HALF_LABEL, letters);
    const int32_t title = bar->title && *bar->title ? sevenths(TITLE_GAP + LETTERS, letters) : 0;
    const int32_t rows = zr_lesser(height * 7 / 10, height - 2 * (margin + half) - title);
    const double apart = (double)(LABELS_APART * letters) / (LETTERS * (double)rows);
    if (rows <= 0 || apart > TICKS_APART_MAX) return false;
    *l = (struct zr_color_bar_layout){
        .scale = scale,
        .letters = letters,
        .line = line,
        .halo = (letters + LETTERS / 2) / LETTERS,
        .tick_width = sevenths(TICK, letters),
        .ticks = zr_ticks_make(scale->low, scale->high, apart > TICKS_APART ? apart : TICKS_APART, scale->is_given)};
    const int32_t bar_width = zr_greater(sevenths(BAR_WIDTH, letters), zr_lesser(rows, width) / BAR_WIDTHS_PER_SIDE);
    const int32_t beside = l->tick_width + sevenths(GAP, letters);
    const int32_t taken = 2 * line + bar_width + beside + label_width(&l->ticks, letters);
    if (taken + 2 * margin > width / 2) return false;
    const int32_t x = bar->is_left ? margin : width - margin - taken;
    l->bar = (struct zr_box){x + line, (height - rows + title) / 2, bar_width, rows};
    l->tick_x = l->bar.x + bar_width + line;
    l->label_x = l->tick_x + beside;
    l->block = l->all = (struct zr_box){x, l->bar.y - half, taken, rows + 2 * half};
    if (title > 0) place_title(l, bar->title, bar->is_left, x, x + taken, width);
    l->all = zr_box_grow(l->all, l->halo + 1);
    return true;
}

bool zr_color_bar_lay_out(const struct zr_color_bar *bar, const struct zr_color_scale *scale, uint32_t width,
                          uint32_t height, struct zr_color_bar_layout *out)
{
    enum { SIDE_MAX = 1 << 16 }; /* larger windows are refused, but after this call */
    const int32_t columns = (int32_t)(width < SIDE_MAX ? width : SIDE_MAX);
    const int32_t rows = (int32_t)(height < SIDE_MAX ? height : SIDE_MAX);
    int32_t letters = (int32_t)zr_type_height(columns, rows);
    for (; letters >= (int32_t)ZR_TYPE_LEAST; letters--)
        if (lay_out(bar, scale, columns, rows, letters, out)) return true;
    return false;
}

/* ---- warnings ---- */

static void warn_of_title(struct zr_arena *arena, const struct zr_color_bar_layout *layout, const char *title,
                          struct zr_warning_list *warnings)
{
    if (!title || !*title) return;
    if (!layout->title)
        zr_warning_list_add(arena, warnings, "colorBar: the title is too long for this window, and left out");
    else if (!zr_type_has_all(title))
        zr_warning_list_add(arena, warnings, "colorBar: the title has characters that have no glyph: drawn as boxes");
}

void zr_color_bar_warn(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_view *view,
                       struct zr_warning_list *warnings)
{
    const struct zr_color_bar *bar = &scene->color_bar;
    struct zr_color_bar_layout layout;
    if (!bar->is_on || !zr_view_has_pixels(view, ZR_CHANNEL_COLOR)) return;
    const struct zr_color_scale *scale = zr_color_bar_scale(scene);
    if (!scale) {
        zr_warning_list_add(arena, warnings,
                            bar->has_mesh ? "colorBar: the mesh has neither scalars nor heights with a colormap: no bar"
                                          : "colorBar: no mesh that is drawn has scalars, or heights with a colormap: "
                                            "no bar");
        return;
    }
    if (!zr_color_bar_lay_out(bar, scale, view->width, view->height, &layout)) {
        zr_warning_list_add(arena, warnings, "colorBar: a window of %u x %u has no room for it: no bar", view->width,
                            view->height);
        return;
    }
    warn_of_title(arena, &layout, bar->title, warnings);
    const uint32_t others = bar->has_mesh ? 0 : count_others(scene, scale);
    if (others > 0)
        zr_warning_list_add(arena, warnings,
                            "colorBar: meshes have another colormap or range than the bar shows, at %u places; its "
                            "\"mesh\" chooses one",
                            others);
}

/* Draws a text whose ink begins at x, with the base line in row y. */
static void draw_text(const struct zr_canvas *canvas, const char *text, int32_t x, int32_t y, int32_t letters,
                      int32_t grow, uint32_t color)
{
    const double pen = zr_type_pen(letters);
    zr_type_draw(canvas, text, (struct zr_type_place){x + pen / 2, y + 0.5, letters, 1, 0}, pen + 2 * grow, color);
}

static void draw_tick(const struct zr_color_bar_layout *l, const struct zr_canvas *canvas, int i, int32_t grow,
                      uint32_t color)
{
    const double share = zr_tick_share(&l->ticks, i, l->scale->low, l->scale->high);
    const int32_t row = l->bar.height - 1 - (int32_t)floor(share * (double)(l->bar.height - 1) + 0.5);
    const int32_t y = l->bar.y + row - (l->line - 1) / 2;
    char text[ZR_DECIMAL_SIZE];
    zr_canvas_fill(canvas, zr_box_grow((struct zr_box){l->tick_x, y, l->tick_width, l->line}, grow), color);
    zr_decimal_write(l->ticks.at[i], l->ticks.is_scientific, text);
    draw_text(canvas, text, l->label_x, y + (l->line - 1) / 2 + l->letters / 2, l->letters, grow, color);
}

/* Draws everything but the colours of the map. */
static void draw_ink(const struct zr_color_bar_layout *l, const struct zr_canvas *canvas, int32_t grow, uint32_t color)
{
    zr_canvas_fill(canvas, zr_box_grow(l->bar, l->line + grow), color);
    for (int i = 0; i < l->ticks.count; i++)
        draw_tick(l, canvas, i, grow, color);
    if (l->title) draw_text(canvas, l->title, l->title_x, l->title_y, l->title_letters, grow, color);
}

static void draw_colors(const struct zr_color_bar_layout *l, const struct zr_canvas *canvas)
{
    const bool has_length = l->scale->low < l->scale->high;
    for (int32_t r = 0; r < l->bar.height; r++) {
        const float share = has_length ? (float)r / (float)(l->bar.height - 1) : 0.5f;
        const struct zr_box row = {l->bar.x, l->bar.y + l->bar.height - 1 - r, l->bar.width, 1};
        zr_canvas_fill(canvas, row, zr_rgba_opaque(zr_colormap_color(l->scale->map, share)));
    }
}

void zr_color_bar_paint(const struct zr_color_bar_layout *layout, const struct zr_canvas *canvas)
{
    const uint32_t paper = zr_canvas_median(canvas, layout->block);
    draw_ink(layout, canvas, layout->halo, paper);
    draw_ink(layout, canvas, 0, zr_canvas_ink(paper));
    draw_colors(layout, canvas);
}

void zr_color_bar_draw(const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_color_scale *scale = scene->color_bar.is_on ? zr_color_bar_scale(scene) : NULL;
    struct zr_color_bar_layout layout;
    if (!frame->color || !scale ||
        !zr_color_bar_lay_out(&scene->color_bar, scale, frame->width, frame->height, &layout))
        return;
    const struct zr_canvas canvas = {(uint32_t *)(void *)frame->color, (int32_t)frame->width, (int32_t)frame->height};
    zr_color_bar_paint(&layout, &canvas);
    const struct zr_box all = zr_canvas_clip(&canvas, layout.all);
    for (int32_t y = all.y; frame->spans && y < all.y + all.height; y++)
        frame->spans[y] = zr_column_span_join(frame->spans[y],
                                              (struct zr_column_span){(uint32_t)all.x, (uint32_t)(all.x + all.width)});
}
