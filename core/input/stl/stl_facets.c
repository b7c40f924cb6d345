#include <math.h>

#include "input/stl/stl_file.h"
#include "input/text/number.h"
#include "input/text/text.h"

bool zr_stl_fault(struct zr_stl_reader *reader, struct zr_stl_word found, const char *quotes, const char *expected)
{
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected %s%s%s, found %s", reader->line, quotes,
                 expected, quotes, found.size ? zr_quote(found.at, found.size).text : "the end of the file");
    return false;
}

static inline bool expect(struct zr_stl_reader *reader, const char *wanted)
{
    struct zr_stl_word word = zr_stl_next(reader);
    return zr_stl_is_word(word, wanted) || zr_stl_fault(reader, word, "'", wanted);
}

/* Reads a word that is not finite, if it is noted. */
static bool read_hole(struct zr_stl_reader *reader, double *value)
{
    struct zr_stl_reader ahead = *reader;
    const struct zr_stl_word word = zr_stl_next(&ahead);
    if (!reader->notes || !zr_is_not_finite(word.at, word.size)) return false;
    *value = (double)NAN;
    reader->at = ahead.at;
    return true;
}

static inline bool read_vertex(struct zr_stl_reader *reader, zr_vec4 *out)
{
    const double near = (double)reader->limits->coordinate_max, limit = zr_recenter_limit(reader->limits);
    double v[3];
    for (int axis = 0; axis < 3; axis++) {
        zr_stl_skip_spaces(reader);
        const char *at = reader->at, *behind = zr_number_next(at, reader->end, &v[axis]);
        if ((!behind || (behind < reader->end && !zr_stl_is_space(*behind))) && read_hole(reader, &v[axis])) continue;
        if (!behind || (behind < reader->end && !zr_stl_is_space(*behind)))
            return zr_stl_fault(reader, zr_stl_next(reader), "", "a number");
        reader->at = behind;
        if (v[axis] >= -near && v[axis] <= near) continue;
        reader->is_far = true;
        if (!(v[axis] >= -limit && v[axis] <= limit))
            zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: %s in triangle %zu is beyond the limit of %.9g",
                         reader->line, zr_quote(at, (size_t)(behind - at)).text, reader->before + reader->facets + 1,
                         limit);
    }
    if (isnan(v[0] + v[1] + v[2])) v[0] = (double)NAN;
    if (reader->finds_box && !isnan(v[0])) zr_box_include(&reader->box, v);
    *out = zr_recenter_position(v, reader->origin);
    return true;
}

bool zr_stl_read_vertex(struct zr_stl_reader *reader, zr_vec4 *out)
{
    return read_vertex(reader, out);
}

/* Accepts any words as a normal: some exporters write "nan". */
static inline bool read_facet(struct zr_stl_reader *reader)
{
    if (!expect(reader, "normal")) return false;
    for (int axis = 0; axis < 3; axis++) {
        struct zr_stl_word word = zr_stl_next(reader);
        if (word.size == 0) return zr_stl_fault(reader, word, "", "a normal");
    }
    if (!expect(reader, "outer") || !expect(reader, "loop")) return false;
    zr_vec4 corners[3]; /* the array has room for whole facets only */
    for (size_t i = 0; i < 3; i++)
        if (!expect(reader, "vertex") || !read_vertex(reader, &corners[i])) return false;
    if (!expect(reader, "endloop") || !expect(reader, "endfacet")) return false;
    memcpy(reader->positions + reader->vertices, corners, sizeof corners);
    reader->vertices += 3;
    reader->facets++;
    return true;
}

bool zr_stl_read_facet(struct zr_stl_reader *reader)
{
    return read_facet(reader);
}

/* Reads facets up to the end of the solid. False if a fault, a cancellation or the end of the part comes first. */
static bool read_facets(struct zr_stl_reader *reader)
{
    while (reader->error->count < reader->faults && !zr_is_cancelled(reader->cancel)) {
        struct zr_stl_word word = zr_stl_next(reader);
        if (zr_stl_is_word(word, "endsolid")) return true;
        if (word.size == 0 && reader->goes_on) return false;
        if (!zr_stl_is_word(word, "facet")) return zr_stl_fault(reader, word, "", "'facet' or 'endsolid'");
        if (!read_facet(reader)) return false;
    }
    return false;
}

/* A name is free text up to the end of its line. */
void zr_stl_read_solids(struct zr_stl_reader *reader)
{
    for (;;) {
        if (!reader->inside) {
            struct zr_stl_word word = zr_stl_next(reader);
            if (word.size == 0) return;
            if (!zr_stl_is_word(word, "solid")) {
                zr_stl_fault(reader, word, "'", "solid");
                return;
            }
            zr_stl_skip_line(reader);
            reader->inside = true;
        }
        if (!read_facets(reader)) return;
        zr_stl_skip_line(reader);
        reader->inside = false;
    }
}
