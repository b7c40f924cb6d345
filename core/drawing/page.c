#include "drawing/page.h"

#include <stdio.h>
#include <string.h>

const char *const zr_page_names[ZR_PAGE_SIZES] = {"A4", "A3"};
const char *const zr_page_view_names[ZR_PAGE_VIEWS] = {"front", "top", "right", "isometric"};

/* Room around the views: beside those with dimensions, at the other edges, between columns and rows, and between a view
 * and its notes. */
#define DIMENSION_ROOM 20.0
#define EDGE_ROOM      6.0
#define COLUMN_GAP     22.0
#define ROW_GAP        22.0
#define NOTE_ROOM      6.0

struct zr_page zr_page_make(enum zr_page_size size, bool is_first_angle)
{
    struct zr_page page = {.size = size, .width = 210.0, .height = 297.0, .is_first_angle = is_first_angle};
    if (size == ZR_PAGE_A3) page.width = 420.0;
    page.frame = (struct zr_page_box){20.0, 10.0, page.width - 10.0, page.height - 10.0};
    page.title = (struct zr_page_box){page.frame.x1 - ZR_PAGE_TITLE_WIDTH, page.frame.y1 - ZR_PAGE_TITLE_HEIGHT,
                                      page.frame.x1, page.frame.y1};
    return page;
}

/* ---- scales ---- */

void zr_page_scale_write(struct zr_page_scale scale, char out[ZR_PAGE_SCALE_SIZE])
{
    snprintf(out, ZR_PAGE_SCALE_SIZE, "%.0f:%.0f", scale.paper, scale.model);
}

static bool read_whole(const char **text, double *out)
{
    enum { DIGITS = 9 };
    const size_t digits = strspn(*text, "0123456789");
    *out = 0.0;
    if (digits < 1 || digits > DIGITS) return false;
    for (size_t i = 0; i < digits; i++)
        *out = 10.0 * *out + (double)((*text)[i] - '0');
    *text += digits;
    return *out > 0.0;
}

bool zr_page_scale_read(const char *text, struct zr_page_scale *out)
{
    return read_whole(&text, &out->paper) && *text++ == ':' && read_whole(&text, &out->model) && *text == '\0';
}

/* Returns scale `number` of ISO 5455, from large to small. */
enum { DECADES = 9, SCALES = 2 * 3 * DECADES + 1 };
static struct zr_page_scale scale_of(int number)
{
    static const double digits[] = {1.0, 2.0, 5.0};
    const int n = number < SCALES / 2 ? SCALES / 2 - number : number - SCALES / 2;
    double value = digits[n % 3];
    for (int i = 0; i < n / 3; i++)
        value *= 10.0;
    return number < SCALES / 2 ? (struct zr_page_scale){value, 1.0} : (struct zr_page_scale){1.0, value};
}

/* ---- layout ---- */

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Returns the room above a view. */
static double room_above(const struct zr_page_request *request, enum zr_page_view view)
{
    const double notes = request->notes[view] > 0 ? NOTE_ROOM + ZR_PAGE_NOTE_ROW * request->notes[view] : 0.0;
    return notes + (request->has_label[view] ? ZR_PAGE_LABEL : 0.0);
}

/* The views by row and column. */
struct grid {
    enum zr_page_view at[2][2];
};

static struct grid grid_of(const struct zr_page *page)
{
    if (page->is_first_angle) return (struct grid){{{ZR_PAGE_RIGHT, ZR_PAGE_FRONT}, {ZR_PAGE_ISOMETRIC, ZR_PAGE_TOP}}};
    return (struct grid){{{ZR_PAGE_TOP, ZR_PAGE_ISOMETRIC}, {ZR_PAGE_FRONT, ZR_PAGE_RIGHT}}};
}

/* Returns where a view begins between two ends: at the one, at the other, or in the middle. */
static double begin_in(double low, double high, double size, bool is_at_low, bool is_at_high)
{
    return is_at_low ? low : is_at_high ? high - size : low + 0.5 * (high - low - size);
}

static bool lay_out_at(const struct zr_page *page, const struct zr_page_request *request, struct zr_page_scale scale,
                       struct zr_page_layout *out)
{
    const struct grid grid = grid_of(page);
    const double factor = zr_page_factor(scale);
    double columns[2], rows[2], above[2];
    for (int i = 0; i < 2; i++) {
        columns[i] = factor * larger(request->sizes[grid.at[0][i]][0], request->sizes[grid.at[1][i]][0]);
        rows[i] = factor * larger(request->sizes[grid.at[i][0]][1], request->sizes[grid.at[i][1]][1]);
        above[i] = larger(room_above(request, grid.at[i][0]), room_above(request, grid.at[i][1]));
    }
    const double cut = ZR_PAGE_CUT_ROOM, beside = DIMENSION_ROOM + (request->has_cut_beside ? cut : 0.0),
                 below = DIMENSION_ROOM + (request->has_cut_below ? cut : 0.0);
    const double left = page->is_first_angle ? EDGE_ROOM : beside, right = page->is_first_angle ? beside : EDGE_ROOM;
    const double first = larger(EDGE_ROOM, above[0]), gap = larger(ROW_GAP, EDGE_ROOM + above[1]);
    const double wide = left + columns[0] + COLUMN_GAP + columns[1] + right,
                 high = first + rows[0] + gap + rows[1] + below;
    const double free_x = page->frame.x1 - page->frame.x0 - wide, free_y = page->title.y0 - page->frame.y0 - high;
    if (!(free_x >= 0.0) || !(free_y >= 0.0)) return false;
    const double x[2] = {page->frame.x0 + left + free_x / 3.0,
                         page->frame.x0 + left + columns[0] + COLUMN_GAP + 2.0 * free_x / 3.0};
    const double y[2] = {page->frame.y0 + first + free_y / 3.0,
                         page->frame.y0 + first + rows[0] + gap + 2.0 * free_y / 3.0};
    out->scale = scale;
    for (int row = 0; row < 2; row++)
        for (int column = 0; column < 2; column++) {
            const enum zr_page_view view = grid.at[row][column];
            const double w = factor * request->sizes[view][0], h = factor * request->sizes[view][1];
            const bool is_free = view == ZR_PAGE_ISOMETRIC;
            const double x0 = begin_in(x[column], x[column] + columns[column], w, !is_free && column == 1,
                                       !is_free && column == 0),
                         y0 = begin_in(y[row], y[row] + rows[row], h, !is_free && row == 1, !is_free && row == 0);
            out->views[view] = (struct zr_page_box){x0, y0, x0 + w, y0 + h};
        }
    return true;
}

bool zr_page_lay_out(const struct zr_page *page, const struct zr_page_request *request, struct zr_page_layout *out,
                     struct zr_page_scale *largest)
{
    *largest = (struct zr_page_scale){0.0, 1.0};
    if (request->asked.paper > 0.0 && lay_out_at(page, request, request->asked, out)) return true;
    for (int i = 0; i < SCALES; i++)
        if (lay_out_at(page, request, scale_of(i), out)) {
            *largest = out->scale;
            return !(request->asked.paper > 0.0);
        }
    return false;
}
