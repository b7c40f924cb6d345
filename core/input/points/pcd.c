/* Reads PCD, the point clouds of the Point Cloud Library: ascii, binary and binary_compressed.
 * Source: "The PCD (Point Cloud Data) file format", Point Cloud Library, version 0.7. */
#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "input/formats/input.h"
#include "input/points/lzf.h"
#include "input/points/points_file.h"
#include "input/text/text.h"
#include "render_request.h"

enum { FIELDS_MAX = 64, FIELD_COUNT_MAX = 4096, POINTS_PER_CANCEL_CHECK = 1 << 12 };

enum slot { X, Y, Z, PACKED, RED, GREEN, BLUE, SLOTS };

/* A field of the records: `count` numbers of `size` bytes. */
struct field {
    int slot; /* enum slot, or SLOTS: not read */
    uint32_t size, count;
    char type; /* I, U or F */
    bool has_alpha;
    size_t offset; /* in a record; in compressed files, of its numbers before those of the next field */
    size_t column; /* in a line of text */
};

struct pcd {
    struct zr_points points;
    struct zr_points_text text;
    struct field fields[FIELDS_MAX];
    int field_count;
    size_t width, height, count; /* count: of points */
    bool has_count;
    const struct field *slots[SLOTS];
    size_t record, columns; /* bytes and numbers of a record */
};

/* ---- header ---- */

static int slot_of(const struct zr_points_line *name)
{
    static const char *const names[SLOTS] = {"x", "y", "z", "rgb", "r", "g", "b"};
    if (zr_points_is(name, "rgba")) return PACKED;
    for (int slot = 0; slot < SLOTS; slot++)
        if (zr_points_is(name, names[slot])) return slot;
    return SLOTS;
}

static bool read_whole(struct zr_points_line *line, double most, size_t *out)
{
    double value;
    if (zr_points_numbers(line, &value, 1) != 1 || !(value >= 0 && value <= most) || value != floor(value))
        return false;
    *out = (size_t)value;
    return true;
}

static bool read_field_names(struct pcd *pcd, struct zr_points_line line)
{
    for (;;) {
        const struct zr_points_line name = zr_points_word(&line);
        if (name.at == name.end) return pcd->field_count > 0;
        if (pcd->field_count == FIELDS_MAX) return false;
        pcd->fields[pcd->field_count++] = (struct field){
            .slot = slot_of(&name), .size = 4, .count = 1, .type = 'F', .has_alpha = zr_points_is(&name, "rgba")};
    }
}

/* Reads the values of a line, one per field. */
static bool read_per_field(struct pcd *pcd, const char *key, struct zr_points_line line)
{
    for (int i = 0; i < pcd->field_count; i++) {
        struct field *field = &pcd->fields[i];
        size_t number = 0;
        const struct zr_points_line type = *key == 'T' ? zr_points_word(&line) : line;
        if (*key == 'T') {
            field->type = type.at < type.end ? *type.at : '?';
            if (!strchr("IUF", field->type)) return false;
        } else if (!read_whole(&line, FIELD_COUNT_MAX, &number)) {
            return false;
        } else if (*key == 'S') {
            field->size = (uint32_t)number;
        } else {
            field->count = (uint32_t)number;
        }
    }
    return true;
}

/* Reads a line of the header other than DATA. Other keys, such as VERSION and VIEWPOINT, are skipped. */
static bool read_line(struct pcd *pcd, const struct zr_points_line *key, struct zr_points_line line)
{
    if (zr_points_is(key, "FIELDS") || zr_points_is(key, "COLUMNS")) return read_field_names(pcd, line);
    if (zr_points_is(key, "SIZE")) return read_per_field(pcd, "SIZE", line);
    if (zr_points_is(key, "TYPE")) return read_per_field(pcd, "TYPE", line);
    if (zr_points_is(key, "COUNT")) return read_per_field(pcd, "COUNT", line);
    if (zr_points_is(key, "WIDTH")) return read_whole(&line, ZR_POINTS_MAX, &pcd->width);
    if (zr_points_is(key, "HEIGHT")) return read_whole(&line, ZR_POINTS_MAX, &pcd->height);
    if (!zr_points_is(key, "POINTS")) return true;
    pcd->has_count = true;
    return read_whole(&line, ZR_POINTS_MAX, &pcd->count);
}

/* Places the fields in records, and checks that what is drawn can be read. */
static enum zr_status place_fields(struct pcd *pcd)
{
    for (int i = 0; i < pcd->field_count; i++) {
        struct field *field = &pcd->fields[i];
        const bool is_float = field->type == 'F',
                   fits = is_float ? field->size == 4 || field->size == 8
                                   : field->size == 1 || field->size == 2 || field->size == 4 || field->size == 8;
        field->offset = pcd->record;
        field->column = pcd->columns;
        pcd->record += (size_t)field->size * field->count;
        pcd->columns += field->count;
        if (field->slot == SLOTS || field->count == 0) continue;
        if (!fits || (field->slot == PACKED && field->size != 4))
            return zr_error_add(pcd->points.error, ZR_BAD_SCENE, NULL, "field %d has the type %c of %u bytes", i + 1,
                                field->type, field->size);
        if (!pcd->slots[field->slot]) pcd->slots[field->slot] = field;
    }
    if (!pcd->slots[X] || !pcd->slots[Y] || !pcd->slots[Z])
        return zr_error_add(pcd->points.error, ZR_BAD_SCENE, NULL, "FIELDS has no x, y and z");
    if (!pcd->has_count) pcd->count = pcd->width * pcd->height;
    if (pcd->count > ZR_POINTS_MAX || pcd->record == 0)
        return zr_error_add(pcd->points.error, ZR_BAD_SCENE, NULL, "%zu points of %zu bytes", pcd->count, pcd->record);
    pcd->points.has_colors = pcd->slots[PACKED] || (pcd->slots[RED] && pcd->slots[GREEN] && pcd->slots[BLUE]);
    return ZR_OK;
}

/* Reads the header with its last line, DATA, whose word is the result. */
static enum zr_status read_header(struct pcd *pcd, struct zr_points_line *data)
{
    struct zr_points_line line;
    while (zr_points_next(&pcd->text, &line)) {
        const struct zr_points_line key = zr_points_word(&line);
        if (zr_points_is(&key, "DATA")) {
            *data = zr_points_word(&line);
            return place_fields(pcd);
        }
        if (!read_line(pcd, &key, line))
            return zr_points_fault(&pcd->points, pcd->text.line, "the values of %s cannot be read",
                                   zr_quote(key.at, (size_t)(key.end - key.at)).text);
    }
    return zr_error_add(pcd->points.error, ZR_BAD_SYNTAX, NULL, "the header has no line DATA");
}

/* ---- numbers ---- */

static uint64_t read_bytes(const unsigned char *at, uint32_t size)
{
    uint64_t bits = 0;
    for (uint32_t k = 0; k < size; k++)
        bits |= (uint64_t)at[k] << 8 * k;
    return bits;
}

static double read_number(const unsigned char *at, const struct field *field)
{
    const uint64_t bits = read_bytes(at, field->size), half = UINT64_C(1) << (8 * field->size - 1);
    const uint32_t low = (uint32_t)bits;
    double wide;
    float narrow;
    memcpy(&wide, &bits, sizeof wide);
    memcpy(&narrow, &low, sizeof narrow);
    if (field->type == 'F') return field->size == 8 ? wide : (double)narrow;
    if (field->type == 'I') return (double)(int64_t)((bits ^ half) - half);
    return (double)bits;
}

static zr_vec4 unpack(uint32_t bits, bool has_alpha)
{
    return (zr_vec4){(float)(bits >> 16 & 255), (float)(bits >> 8 & 255), (float)(bits & 255),
                     has_alpha ? (float)(bits >> 24) : 255.0f};
}

/* Scales components of bytes and words; those of floats may be 0..1 or 0..255. */
static void scale_colors(struct pcd *pcd)
{
    const struct field *red = pcd->slots[RED];
    const float scale = pcd->slots[PACKED] ? 1.0f / 255.0f
                        : red->type == 'F' ? 0.0f
                        : red->size == 1   ? 1.0f / 255.0f
                        : red->size == 2   ? 1.0f / 65535.0f
                                           : 0.0f;
    zr_vec4 *colors = pcd->points.colors;
    bool is_clear = true;
    zr_points_scale_colors(colors, pcd->points.count, scale);
    for (size_t i = 0; i < pcd->points.count; i++)
        is_clear = is_clear && colors[i].w <= 0.0f;
    for (size_t i = 0; is_clear && i < pcd->points.count; i++)
        colors[i].w = 1.0f; /* PCL writes rgba without an alpha */
}

/* ---- ascii ---- */

/* Packed colours of the type F are the bits of a float. Below the normal floats, which kernels take as 0, these are the
 * number in units of the smallest one. */
static uint32_t packed_of_text(double value, const struct field *field)
{
    const double least = 0x1p-126, unit = 0x1p-149;
    const float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    if (field->type == 'F') return value >= 0 && value < least ? (uint32_t)(value / unit + 0.5) : bits;
    return value >= 0 && value < 4294967296.0 ? (uint32_t)value : 0;
}

static zr_vec4 color_of_text(const struct pcd *pcd, const double *v)
{
    const struct field *const *slots = pcd->slots;
    if (slots[PACKED]) return unpack(packed_of_text(v[slots[PACKED]->column], slots[PACKED]), slots[PACKED]->has_alpha);
    return (zr_vec4){(float)v[slots[RED]->column], (float)v[slots[GREEN]->column], (float)v[slots[BLUE]->column], 1.0f};
}

static enum zr_status read_text(struct pcd *pcd)
{
    struct zr_points *points = &pcd->points;
    double *v = zr_arena_alloc(points->builder->arena, pcd->columns, sizeof *v);
    struct zr_points_line line;
    if (pcd->count > (size_t)(pcd->text.end - pcd->text.at))
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL, "the file is cut: %zu points, and %zu bytes are left",
                            pcd->count, (size_t)(pcd->text.end - pcd->text.at));
    if (!v || !zr_points_reserve(points, pcd->count)) return ZR_NO_MEMORY;
    while (points->count < pcd->count && zr_points_next(&pcd->text, &line)) {
        if (points->count % POINTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(points->cancel)) return ZR_CANCELLED;
        const int count = zr_points_numbers(&line, v, (int)pcd->columns);
        if (count < (int)pcd->columns)
            return zr_points_fault(points, pcd->text.line, "a point has %zu numbers by the header; this line does not",
                                   pcd->columns);
        const size_t number = zr_points_add(
            points, (const double[]){v[pcd->slots[X]->column], v[pcd->slots[Y]->column], v[pcd->slots[Z]->column]});
        if (points->has_colors) points->colors[number] = color_of_text(pcd, v);
    }
    if (points->count < pcd->count)
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL, "the file is cut: %zu of %zu points are there",
                            points->count, pcd->count);
    return ZR_OK;
}

/* ---- binary ---- */

/* Returns the bytes of a field's number of a point. */
static const unsigned char *number_at(const struct pcd *pcd, const unsigned char *bytes, const struct field *field,
                                      size_t point, bool is_compressed)
{
    return is_compressed ? bytes + field->offset * pcd->count + point * field->size * field->count
                         : bytes + point * pcd->record + field->offset;
}

static enum zr_status read_records(struct pcd *pcd, const unsigned char *bytes, bool is_compressed)
{
    struct zr_points *points = &pcd->points;
    const struct field *const *slots = pcd->slots, *packed = slots[PACKED];
    if (!zr_points_reserve(points, pcd->count)) return ZR_NO_MEMORY;
    for (size_t i = 0; i < pcd->count; i++) {
        double v[SLOTS] = {0};
        if (i % POINTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(points->cancel)) return ZR_CANCELLED;
        for (int slot = 0; slot < SLOTS; slot++)
            if (slots[slot]) v[slot] = read_number(number_at(pcd, bytes, slots[slot], i, is_compressed), slots[slot]);
        zr_points_add(points, v);
        if (packed)
            points->colors[i] =
                unpack((uint32_t)read_bytes(number_at(pcd, bytes, packed, i, is_compressed), 4), packed->has_alpha);
        else if (points->has_colors)
            points->colors[i] = (zr_vec4){(float)v[RED], (float)v[GREEN], (float)v[BLUE], 1.0f};
    }
    return ZR_OK;
}

static enum zr_status read_binary(struct pcd *pcd)
{
    const size_t left = (size_t)(pcd->text.end - pcd->text.at), needed = pcd->count * pcd->record;
    if (needed / pcd->record != pcd->count || needed > left)
        return zr_error_add(pcd->points.error, ZR_BAD_SYNTAX, NULL,
                            "the file is cut: %zu points of %zu bytes, and %zu bytes are left", pcd->count, pcd->record,
                            left);
    return read_records(pcd, (const unsigned char *)pcd->text.at, false);
}

static enum zr_status read_compressed(struct pcd *pcd)
{
    const unsigned char *at = (const unsigned char *)pcd->text.at;
    const size_t left = (size_t)(pcd->text.end - pcd->text.at), needed = pcd->count * pcd->record;
    struct zr_points *points = &pcd->points;
    const size_t packed = left >= 8 ? (size_t)read_bytes(at, 4) : 0,
                 size = left >= 8 ? (size_t)read_bytes(at + 4, 4) : 0;
    if (left < 8 || packed > left - 8)
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL,
                            "the file is cut: %zu compressed bytes, and %zu bytes are left", packed, left);
    if (size != needed || size / ZR_LZF_PER_BYTE > packed)
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL,
                            "%zu bytes from %zu compressed ones; %zu points of %zu bytes are %zu", size, packed,
                            pcd->count, pcd->record, needed);
    unsigned char *bytes = zr_arena_alloc(points->builder->arena, size, 1);
    if (!bytes) return ZR_NO_MEMORY;
    if (!zr_lzf_decode(at + 8, packed, bytes, size, points->cancel))
        return zr_is_cancelled(points->cancel)
                   ? ZR_CANCELLED
                   : zr_error_add(points->error, ZR_BAD_SYNTAX, NULL, "the compressed bytes are broken");
    return read_records(pcd, bytes, true);
}

/* ---- all ---- */

bool zr_looks_so_PCD(const char *bytes, size_t size)
{
    static const char *const keys[] = {"VERSION", "FIELDS", "COLUMNS"};
    struct zr_points_text text = {.at = bytes, .end = bytes + (size < ZR_BLANKS_MAX ? size : ZR_BLANKS_MAX)};
    struct zr_points_line line;
    if (!zr_points_next(&text, &line)) return false;
    const struct zr_points_line key = zr_points_word(&line);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (key.end - key.at == (ptrdiff_t)strlen(keys[i]) && memcmp(key.at, keys[i], strlen(keys[i])) == 0)
            return true;
    return false;
}

static enum zr_status read_data(struct pcd *pcd, const struct zr_points_line *data)
{
    if (zr_points_is(data, "ascii")) return read_text(pcd);
    if (zr_points_is(data, "binary")) return read_binary(pcd);
    if (zr_points_is(data, "binary_compressed")) return read_compressed(pcd);
    return zr_points_fault(&pcd->points, pcd->text.line, "DATA is %s; ascii, binary and binary_compressed are read",
                           zr_quote(data->at, (size_t)(data->end - data->at)).text);
}

enum zr_status zr_read_PCD(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct pcd *pcd = zr_arena_zero(builder->arena, 1, sizeof *pcd);
    struct zr_points_line data = {NULL, NULL};
    if (!pcd) return ZR_NO_MEMORY;
    pcd->points = zr_points_open(builder, request->cancel, limits, error, "PCD");
    pcd->text =
        (struct zr_points_text){.at = request->bytes, .end = request->bytes + request->size, .cancel = request->cancel};
    pcd->height = 1;
    enum zr_status status = read_header(pcd, &data);
    if (status == ZR_OK) status = read_data(pcd, &data);
    if (status != ZR_OK) return zr_points_status(&pcd->points, status);
    if (pcd->points.colors) scale_colors(pcd);
    return zr_points_draw(&pcd->points, zr_points_make(&pcd->points));
}
