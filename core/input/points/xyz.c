/* Reads XYZ: a text of points, one per line, with colours, normals or both. The format has no specification: columns are
 * named by a first line, or found by their number and values. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "input/formats/input.h"
#include "input/points/points_file.h"
#include "input/text/text.h"
#include "render_request.h"

enum { COLUMNS_MAX = 16, POINTS_PER_CANCEL_CHECK = 1 << 12, LINES_LOOKED_AT = 100 };

/* Columns of the values of a point, or NONE. */
enum value { X, Y, Z, RED, GREEN, BLUE, ALPHA, NORMAL_X, NORMAL_Y, NORMAL_Z, VALUES };
enum { NONE = -1 };

struct columns {
    int of[VALUES];
    int count; /* numbers that a line has at least */
};

struct reader {
    struct zr_points points;
    struct columns columns;
    struct zr_points_text text; /* at the first point */
    bool counts;                /* the first line is the number of points */
    size_t counted;
};

/* ---- names ---- */

static int value_of(const struct zr_points_line *word)
{
    static const struct {
        const char *name;
        enum value value;
    } names[] = {{"x", X},
                 {"y", Y},
                 {"z", Z},
                 {"r", RED},
                 {"g", GREEN},
                 {"b", BLUE},
                 {"red", RED},
                 {"green", GREEN},
                 {"blue", BLUE},
                 {"a", ALPHA},
                 {"alpha", ALPHA},
                 {"nx", NORMAL_X},
                 {"ny", NORMAL_Y},
                 {"nz", NORMAL_Z},
                 {"normal_x", NORMAL_X},
                 {"normal_y", NORMAL_Y},
                 {"normal_z", NORMAL_Z},
                 {"normalx", NORMAL_X},
                 {"normaly", NORMAL_Y},
                 {"normalz", NORMAL_Z},
                 {"rf", RED},
                 {"gf", GREEN},
                 {"bf", BLUE},
                 {"east", X},
                 {"easting", X},
                 {"north", Y},
                 {"northing", Y},
                 {"height", Z},
                 {"elevation", Z}};
    struct zr_points_line plain = *word;
    while (plain.at < plain.end && (*plain.at == '"' || *plain.at == '\'' || *plain.at == '/' || *plain.at == '#'))
        plain.at++;
    while (plain.end > plain.at && (plain.end[-1] == '"' || plain.end[-1] == '\''))
        plain.end--;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (zr_points_is(&plain, names[i].name)) return (int)names[i].value;
    return NONE;
}

static bool has_all(const struct columns *columns, enum value first)
{
    return columns->of[first] != NONE && columns->of[first + 1] != NONE && columns->of[first + 2] != NONE;
}

/* Reads the columns from a line of names. False if it does not name x, y and z. */
static bool read_names(struct zr_points_line line, struct columns *out)
{
    int column = 0;
    memset(out->of, 0xFF, sizeof out->of);
    out->count = 0;
    for (; column < COLUMNS_MAX; column++) {
        struct zr_points_line word = zr_points_word(&line);
        if (word.at < word.end && word.end - word.at <= 2 && (*word.at == '/' || *word.at == '#'))
            word = zr_points_word(&line); /* "// X Y Z" */
        if (word.at == word.end) break;
        const int value = value_of(&word);
        if (value == NONE || out->of[value] != NONE) continue;
        out->of[value] = column;
        out->count = column + 1;
    }
    return has_all(out, X);
}

/* ---- columns by their number ---- */

static void put_three(struct columns *columns, enum value first, int column)
{
    for (int k = 0; k < 3; k++)
        columns->of[(int)first + k] = column + k;
}

/* True if the three numbers from `column` on are unit vectors, or zeros, in the lines at the beginning. */
static bool are_normals(struct zr_points_text text, int column)
{
    double v[COLUMNS_MAX];
    bool has_vector = false;
    struct zr_points_line line;
    for (int i = 0; i < LINES_LOOKED_AT && zr_points_next(&text, &line); i++) {
        if (zr_points_numbers(&line, v, COLUMNS_MAX) < column + 3) continue;
        const double *n = v + column, length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        if (!(fabs(length - 1.0) < 0.05 || length == 0.0)) return false;
        has_vector = has_vector || length > 0.0;
    }
    return has_vector;
}

/* x y z, then an intensity if 4 or 7 or 10 numbers follow each other, then colours and normals. */
static void find_columns(struct reader *reader, int count)
{
    struct columns *columns = &reader->columns;
    memset(columns->of, 0xFF, sizeof columns->of);
    put_three(columns, X, 0);
    columns->count = 3;
    for (int column = count % 3 == 1 ? 4 : 3; column + 3 <= count && column < 10; column += 3) {
        const bool normals = are_normals(reader->text, column);
        const enum value first = normals ? NORMAL_X : RED;
        if (columns->of[first] != NONE) break;
        put_three(columns, first, column);
        columns->count = column + 3;
    }
}

/* Finds where points begin and what columns they have. */
static enum zr_status begin(struct reader *reader)
{
    struct zr_points_text text = reader->text;
    struct zr_points_line line;
    double v[COLUMNS_MAX];
    bool is_named = false;
    while (zr_points_next(&text, &line)) {
        struct zr_points_line rest = line;
        const int count = zr_points_numbers(&rest, v, COLUMNS_MAX);
        if (count == 1 && !is_named && !reader->counts && v[0] >= 0 && v[0] == floor(v[0]) && v[0] <= ZR_POINTS_MAX) {
            reader->counts = true;
            reader->counted = (size_t)v[0];
        } else if (count < 0 && !is_named && read_names(line, &reader->columns)) {
            is_named = true;
        } else if (count >= 3) {
            if (!is_named) find_columns(reader, count);
            return ZR_OK;
        } else {
            return zr_points_fault(&reader->points, text.line, "%s; a point is a line x y z with numbers",
                                   zr_quote(line.at, (size_t)(line.end - line.at)).text);
        }
        reader->text = text;
    }
    return zr_error_add(reader->points.error, ZR_BAD_SCENE, NULL, "no geometry: the XYZ file has no point");
}

/* Reads the names of a comment, such as those that CloudCompare writes: //X Y Z R G B. */
static bool read_comment(struct reader *reader)
{
    const struct zr_points_text *text = &reader->text;
    const char *at = text->at + zr_count_blanks(text->at, (size_t)(text->end - text->at));
    if (at == text->end || (*at != '/' && *at != '#')) return false;
    const char *newline = memchr(at, '\n', (size_t)(text->end - at));
    return read_names((struct zr_points_line){at, newline ? newline : text->end}, &reader->columns);
}

/* ---- points ---- */

static zr_vec4 color_of(const double v[], const struct columns *columns)
{
    const int *of = columns->of;
    return (zr_vec4){(float)v[of[RED]], (float)v[of[GREEN]], (float)v[of[BLUE]],
                     of[ALPHA] == NONE ? 1.0f : (float)v[of[ALPHA]]};
}

static enum zr_status read_points(struct reader *reader)
{
    struct zr_points *points = &reader->points;
    const struct columns *columns = &reader->columns;
    struct zr_points_line line;
    double v[COLUMNS_MAX];
    while (zr_points_next(&reader->text, &line)) {
        const char *const begin = line.at;
        const int count = zr_points_numbers(&line, v, columns->count);
        if (points->count % POINTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(points->cancel)) return ZR_CANCELLED;
        if (count < 0) {
            const struct zr_points_line word = zr_points_word(&line);
            return zr_points_fault(points, reader->text.line, "%s is no number",
                                   zr_quote(word.at, (size_t)(word.end - word.at)).text);
        }
        if (count < columns->count)
            return zr_points_fault(points, reader->text.line, "%d numbers; points of this file have at least %d: %s",
                                   count, columns->count, zr_quote(begin, (size_t)(line.end - begin)).text);
        if (points->count == points->room && !zr_points_reserve(points, points->room < 1024 ? 1024 : 2 * points->room))
            return points->error->count > 0 ? points->error->status : ZR_NO_MEMORY;
        const double position[3] = {v[columns->of[X]], v[columns->of[Y]], v[columns->of[Z]]};
        const size_t number = zr_points_add(points, position);
        if (points->has_colors) points->colors[number] = color_of(v, columns);
    }
    return ZR_OK;
}

bool zr_looks_so_XYZ(const char *bytes, size_t size)
{
    struct reader reader = {.text = {.at = bytes, .end = bytes + (size < ZR_BLANKS_MAX ? size : ZR_BLANKS_MAX)}};
    struct zr_error error = {.count = 0};
    struct zr_points_line line;
    double v[COLUMNS_MAX];
    reader.points.error = &error;
    if (memchr(bytes, '\0', (size_t)(reader.text.end - bytes)) || begin(&reader) != ZR_OK) return false;
    return zr_points_next(&reader.text, &line) && zr_points_numbers(&line, v, COLUMNS_MAX) >= 3;
}

enum zr_status zr_read_XYZ(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct reader reader = {
        .points = zr_points_open(builder, request->cancel, limits, error, "XYZ"),
        .text = {.at = request->bytes, .end = request->bytes + request->size, .cancel = request->cancel}};
    struct zr_points *points = &reader.points;
    const bool is_named = read_comment(&reader);
    const struct columns named = reader.columns;
    enum zr_status status = begin(&reader);
    if (status != ZR_OK) return zr_points_status(points, status);
    if (is_named) reader.columns = named;
    points->has_colors = has_all(&reader.columns, RED);
    status = read_points(&reader);
    if (status != ZR_OK) return zr_points_status(points, status);
    if (reader.counts && reader.counted != points->count)
        zr_warning_list_add(builder->arena, &builder->warnings,
                            "XYZ: the first line counts %zu points, but there are %zu", reader.counted, points->count);
    if (points->colors) zr_points_scale_colors(points->colors, points->count, 0.0f);
    return zr_points_draw(points, zr_points_make(points));
}
