/* obj_file.h - input: state of reading an OBJ file, shared by all threads and per part. */
#ifndef ZR_OBJ_FILE_H
#define ZR_OBJ_FILE_H

#include "core.h"
#include "input/obj/obj_text.h"
#include "input/text/number.h"
#include "input/text/parts.h"
#include "input/text/recenter.h"
#include "scene/scene_builder.h"

enum { ZR_OBJ_COUNT_MAX = 1 << 30 };

/* Replaces the index of a missing normal until the zero normal has its index. Likewise for texture coordinates. */
#define ZR_OBJ_NO_NORMAL   UINT32_MAX
#define ZR_OBJ_NO_TEXCOORD UINT32_MAX

/* Kinds of faults that do not stop reading. Each causes one warning (obj_notes.c). */
enum zr_obj_note {
    /* found by the first pass */
    ZR_OBJ_NOTE_MAPS,
    ZR_OBJ_NOTE_CALLS,
    ZR_OBJ_NOTE_CURVES,
    ZR_OBJ_NOTE_UNKNOWN,
    ZR_OBJ_NOTE_NAMES,
    ZR_OBJ_NOTE_RETURNS,
    ZR_OBJ_NOTE_SHORT_FACES,
    /* found by the second pass */
    ZR_OBJ_NOTE_EMPTY_INDICES,
    ZR_OBJ_NOTE_WRONG_NORMALS,
    ZR_OBJ_NOTE_WRONG_TEXCOORDS,
    ZR_OBJ_NOTE_BAD_NORMALS,
    ZR_OBJ_NOTE_BAD_TEXCOORDS,
    ZR_OBJ_NOTE_CLAMPED,
    ZR_OBJ_NOTE_BAD_COLORS,
    ZR_OBJ_NOTE_BAD_LINES,
    ZR_OBJ_NOTE_BAD_POINTS,
    ZR_OBJ_NOTE_HOLES,
    ZR_OBJ_NOTES,
    ZR_OBJ_NOTE_SECOND = ZR_OBJ_NOTE_EMPTY_INDICES
};

/* Number of occurrences, and the first statement. */
struct zr_obj_noted {
    size_t count;
    struct zr_obj_statement first;
};

struct zr_obj_counts {
    size_t lines, positions, normals, faces, corners, segments, points; /* segments of l, points of p */
    size_t texcoords, libraries, names;                                 /* vt; mtllib; o, g and usemtl */
};

/* A statement o, g or usemtl, and the number of faces before it. */
struct zr_obj_name {
    const char *at;
    uint32_t length, face;
};

/* One part of the text: complete statements. */
struct zr_obj_part {
    struct zr_obj_counts holds, before;
    struct zr_obj_noted notes[ZR_OBJ_NOTES]; /* first pass: lines count from the part until zr_obj_add_up */
    size_t returns;
    bool has_colors, has_groups;
    uint32_t group_before, group; /* smoothing group at the begin, and at the end if has_groups */
    /* Set by the second pass. */
    bool normal_given, normal_missing; /* a corner has a normal; a corner has none */
    bool is_far;                       /* a coordinate is beyond the limit */
    float color_most;                  /* largest component */
    size_t segments, points;           /* read so far, at most those of `holds` */
    struct zr_box box;
};

/* Data of a file, shared by all threads. */
struct zr_obj_file {
    const char *at, *end;
    const struct zr_limits *limits;
    const struct zr_cancel *cancel;
    size_t part_count;
    const struct zr_part *texts;
    struct zr_obj_part *parts;
    struct zr_obj_counts total;
    bool has_colors, has_groups;
    bool is_cloud;               /* the file has only vertices, which are drawn as points */
    zr_vec4 *positions, *colors; /* x of a hole, a position that is not finite, is NaN; NULL: no vertex has a colour */
    zr_vec3 *normals;
    uint32_t *face_offsets, *indices, *normal_indices; /* NULL: the file has no normals */
    uint32_t *groups;                                  /* per face; NULL: the file has no smoothing groups */
    uint32_t *lines, *points;
    struct zr_obj_name *names;
    struct zr_mtl *mtl;       /* NULL: no material library is read */
    const char *only_library; /* name of the library that replaces missing ones, or NULL */
    struct zr_obj_noted missing_libraries, missing_materials, untextured; /* untextured: faces without vt */
    zr_vec4 *texcoords;         /* u, 1 - v: v counts from the bottom in OBJ, from the top in a scene */
    uint32_t *texcoord_indices; /* NULL: texture coordinates are not read */
    float color_scale;          /* colours are divided by it */
    const double *origin;       /* subtracted from positions; NULL: 0 */
    const uint8_t *used;        /* per position: 1 if it is drawn; NULL: all are */
};

/* Adds a statement to a note. */
static inline void zr_obj_note(struct zr_obj_noted notes[ZR_OBJ_NOTES], enum zr_obj_note note,
                               const struct zr_obj_statement *statement)
{
    if (notes[note].count++ == 0) notes[note].first = *statement;
}

/* obj_count.c: the first pass over a part. A zr_part_fn of a struct zr_obj_file. */
bool zr_obj_count_part(void *file, size_t index);

/* Sets *group to the number of s, or to 0 for "off". False for other words. */
bool zr_obj_read_group(struct zr_obj_statement *statement, uint32_t *group);

/* Adds up the parts. */
void zr_obj_add_up(struct zr_obj_file *file);

/* obj_read.c: reads a part. Stops and returns false at `faults` faults or a syntax error. */
bool zr_obj_read_part(const struct zr_obj_file *file, size_t index, size_t faults, struct zr_error *error);

/* obj_lines.c: reads the segments of l or the points of p, and adds to `count`. A wrong index discards all: false. */
bool zr_obj_read_line(const struct zr_obj_file *file, struct zr_obj_statement *statement, struct zr_obj_counts *count);
bool zr_obj_read_points(const struct zr_obj_file *file, struct zr_obj_statement *statement,
                        struct zr_obj_counts *count);

/* obj_holes.c: leaves out the faces, lines and points at holes. Moves the names, and places holes at another vertex. */
void zr_obj_drop_holes(struct zr_obj_file *file, struct zr_mesh *mesh);

/* obj_notes.c: adds the warnings. */
void zr_obj_warn(const struct zr_obj_file *file, struct zr_scene_builder *builder);

/* obj_names.c: zr_obj_open_materials opens the files that mtllib names. file->mtl stays NULL if there is none.
 * zr_obj_name_faces is called once the text is read. It sets the parts and the materials of the mesh's faces. */
enum zr_status zr_obj_open_materials(struct zr_obj_file *file, struct zr_scene_builder *builder,
                                     const struct zr_request *request, struct zr_error *error);
enum zr_status zr_obj_name_faces(struct zr_obj_file *file, struct zr_scene_builder *builder, struct zr_mesh *mesh);

/* obj_texcoords.c: makes one position per pair of a position and a texture coordinate, if the material of a face has a
 * texture. `materials`: one per face; NULL: `material` for all. */
enum zr_status zr_obj_put_texcoords(struct zr_obj_file *file, struct zr_arena *arena, struct zr_mesh *mesh,
                                    const uint32_t *materials, uint32_t material);

/* Returns the first unknown statement, or NULL. */
const struct zr_obj_statement *zr_obj_first_unknown(const struct zr_obj_file *file);

/* ---- indices ---- */

/* Reads an integer with an optional sign; saturates far above any count. */
ZR_INLINED const char *zr_obj_read_integer(const char *at, const char *end, int64_t *value)
{
    bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) at++;
    const uint64_t word = zr_eight_bytes(at, end);
    const unsigned count = zr_count_digits(word);
    if (count == 0) return NULL;
    int64_t magnitude = zr_digits_value(word, count);
    at += count;
    for (; count == 8 && at < end && (unsigned char)(*at - '0') < 10; at++)
        if (magnitude < INT64_C(1) << 40) magnitude = magnitude * 10 + (*at - '0');
    *value = negative ? -magnitude : magnitude;
    return at;
}

/* Converts an index from 1, or a negative one relative to the last element so far, to an index from 0. False if there
 * is no such element. */
ZR_INLINED bool zr_obj_resolve_index(int64_t index, size_t so_far, size_t total, uint32_t *out)
{
    const int64_t resolved = index > 0 ? index - 1 : (int64_t)so_far + index;
    *out = (uint32_t)resolved;
    return index != 0 && resolved >= 0 && resolved < (int64_t)total;
}

/* The indices of a corner. */
struct zr_obj_corner {
    int64_t position, texcoord, normal;
    bool has_texcoord, has_normal;
    bool has_gap; /* a slash without an index, other than in v//vn */
};

/* Reads v, v/vt, v//vn or v/vt/vn, also if an index after a slash is missing. False for any other word. Sets texcoord
 * only if `is_textured`, a constant: without it the compiler omits the digits. */
ZR_INLINED bool zr_obj_read_indices(struct zr_obj_statement *statement, bool is_textured, struct zr_obj_corner *corner)
{
    int64_t unused;
    const char *end = statement->end, *at = zr_obj_read_integer(statement->at, end, &corner->position), *behind;
    corner->has_texcoord = corner->has_normal = corner->has_gap = false;
    if (at && at < end && *at == '/') {
        corner->has_texcoord =
            (behind = zr_obj_read_integer(++at, end, is_textured ? &corner->texcoord : &unused)) != NULL;
        if (corner->has_texcoord) at = behind;
        if (at < end && *at == '/') {
            corner->has_normal = (behind = zr_obj_read_integer(++at, end, &corner->normal)) != NULL;
            corner->has_gap = !corner->has_normal;
            if (corner->has_normal) at = behind;
        } else {
            corner->has_gap = !corner->has_texcoord;
        }
    }
    if (!at || !zr_obj_ends_word(statement, at)) return false;
    statement->at = at;
    return true;
}

#endif
