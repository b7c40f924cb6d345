/* Lines and points of OBJ. */
#include "input/obj/obj_file.h"

/* Reads the next index of l or p. Returns false at the end of the statement, and sets *is_bad at a wrong index. */
static bool next_index(const struct zr_obj_file *file, struct zr_obj_statement *statement, size_t so_far, uint32_t *out,
                       bool *is_bad)
{
    struct zr_obj_corner corner;
    zr_obj_skip_blanks(statement);
    if (zr_obj_at_end(statement)) return false;
    *is_bad = !zr_obj_read_indices(statement, false, &corner) ||
              !zr_obj_resolve_index(corner.position, so_far, file->total.positions, out);
    return !*is_bad;
}

bool zr_obj_read_line(const struct zr_obj_file *file, struct zr_obj_statement *statement, struct zr_obj_counts *count)
{
    const size_t first = count->segments, so_far = count->positions;
    size_t segment = first;
    bool is_bad = false;
    uint32_t from, to;
    if (next_index(file, statement, so_far, &from, &is_bad))
        for (; next_index(file, statement, so_far, &to, &is_bad); segment++, from = to) {
            file->lines[2 * segment] = from;
            file->lines[2 * segment + 1] = to;
        }
    if (is_bad || segment == first) return false;
    count->segments = segment;
    return true;
}

bool zr_obj_read_points(const struct zr_obj_file *file, struct zr_obj_statement *statement, struct zr_obj_counts *count)
{
    const size_t first = count->points, so_far = count->positions;
    size_t point = first;
    bool is_bad = false;
    while (next_index(file, statement, so_far, &file->points[point], &is_bad))
        point++;
    if (is_bad || point == first) return false;
    count->points = point;
    return true;
}
