/* Reads PLY, ASCII and binary: vertices with colours, normals and texture coordinates; coloured polygons; triangle
 * strips; edges. Without faces and edges, the vertices are drawn as points. The format names no up axis: y is up, as
 * in the Stanford scans, the format's origin. */
#include "input/formats/input.h"

#include <inttypes.h>

#include "input/ply/ply_file.h"
#include "render_request.h"

/* ---- checks of the header ---- */

static bool is_text(const struct zr_ply_file *file)
{
    return file->header.form == ZR_PLY_ASCII;
}

/* Checks that an element has the properties that drawing requires. */
static bool check_properties(struct zr_ply_file *file, const struct zr_ply_plan *plan)
{
    static const char *const missing[] = {[ZR_PLY_VERTEX] = "x, y and z",
                                          [ZR_PLY_FACE] = "vertex_indices",
                                          [ZR_PLY_STRIPS] = "vertex_indices",
                                          [ZR_PLY_EDGE] = "vertex1 and vertex2"};
    const bool has[] = {[ZR_PLY_VERTEX] = plan->slots[ZR_PLY_X] != NULL,
                        [ZR_PLY_FACE] = plan->indices != NULL,
                        [ZR_PLY_STRIPS] = plan->indices != NULL,
                        [ZR_PLY_EDGE] = plan->slots[ZR_PLY_VERTEX1] != NULL,
                        [ZR_PLY_OTHER] = true};
    if (has[plan->kind] || (plan->element->count == 0 && plan->kind != ZR_PLY_VERTEX)) return true;
    if (zr_ply_find(plan->element, "packed_position")) {
        zr_error_add(
            file->error, ZR_BAD_SCENE, NULL,
            "compressed splats (packed_position) are not read in this version; splats exported without compression "
            "have x, y and z, which are");
        return false;
    }
    zr_error_add(file->error, ZR_BAD_SCENE, NULL, "element %s has no %s %s", zr_ply_printable(plan->element->name).text,
                 plan->kind == ZR_PLY_FACE || plan->kind == ZR_PLY_STRIPS ? "list" : "properties", missing[plan->kind]);
    return false;
}

/* Checks that the remaining bytes can hold all records of an element.
 * A text value takes at least two bytes: a character and a separator. */
static bool check_bytes(struct zr_ply_file *file, const struct zr_ply_element *element)
{
    const size_t left = (size_t)(file->end - file->at), values = element->property_count;
    const size_t least = is_text(file) ? 2 * values : element->least_bytes;
    const struct zr_quote name = zr_ply_printable(element->name);
    if (least == 0 || element->count <= (left + is_text(file)) / least) return true;
    if (is_text(file) || element->list_count > 0)
        zr_error_add(file->error, ZR_BAD_SYNTAX, NULL,
                     "the file is cut: %zu records of element %s take at least %zu bytes each, and %zu bytes are left",
                     element->count, name.text, least, left);
    else
        zr_error_add(file->error, ZR_BAD_SYNTAX, NULL,
                     "the file is cut in %s %zu of %zu: a record takes %zu bytes, and %zu bytes are left", name.text,
                     left / least, element->count, least, left);
    return false;
}

static bool check_counts(struct zr_ply_file *file)
{
    const struct zr_ply_header *header = &file->header;
    const struct zr_ply_element *vertices = NULL;
    for (size_t i = 0; i < header->element_count; i++) {
        const struct zr_ply_element *element = &header->elements[i];
        const struct zr_ply_plan plan = zr_ply_plan_of(element);
        if (!check_properties(file, &plan)) return false;
        if (plan.kind == ZR_PLY_VERTEX) vertices = element;
        if (plan.kind == ZR_PLY_FACE && element->count > 0 && plan.slots[ZR_PLY_RED]) file->faces_have_colors = true;
        if (plan.kind != ZR_PLY_OTHER && element->count > ZR_PLY_COUNT_MAX) {
            zr_error_add(file->error, ZR_BAD_SCENE, NULL, "element %s has more than %d records",
                         zr_ply_printable(element->name).text, ZR_PLY_COUNT_MAX);
            return false;
        }
    }
    if (!vertices) zr_error_add(file->error, ZR_BAD_SCENE, NULL, "no geometry: the PLY file has no element vertex");
    file->vertex_count = vertices ? vertices->count : 0;
    return vertices != NULL;
}

/* ---- elements ---- */

static enum zr_status read_element(struct zr_ply_file *file, const struct zr_ply_element *element)
{
    const struct zr_ply_plan plan = zr_ply_plan_of(element);
    const bool is_fixed = !is_text(file) && element->list_count == 0;
    size_t first = 0;
    if (!check_bytes(file, element)) return ZR_BAD_SYNTAX;
    if (element->property_count == 0 || element->count == 0) return ZR_OK;
    switch (plan.kind) {
    case ZR_PLY_VERTEX:
        file->vertices = element;
        file->vertices_at = (struct zr_ply_place){file->at, file->line, file->last_line};
        if (!zr_ply_make_vertices(file, &plan)) return ZR_NO_MEMORY;
        if (is_fixed) return zr_ply_read_vertices(file, &plan);
        break;
    case ZR_PLY_FACE:
        if (!is_text(file)) first = zr_ply_read_triangles(file, &plan);
        if (first == element->count) return ZR_OK;
        if (!zr_ply_faces_reserve(file, element->count - first, 3 * (element->count - first))) return ZR_NO_MEMORY;
        break;
    case ZR_PLY_EDGE:
        file->lines = zr_arena_alloc(file->arena, 2 * element->count, sizeof *file->lines);
        if (!file->lines) return ZR_NO_MEMORY;
        file->line_count = element->count;
        break;
    case ZR_PLY_STRIPS:
        break;
    case ZR_PLY_OTHER:
        if (!is_fixed) break;
        file->at += element->count * element->least_bytes;
        return ZR_OK;
    }
    return zr_ply_read_records(file, &plan, first);
}

/* Counts the bytes after the last element, in text without comments, and without white space around them. */
static void note_trailing(struct zr_ply_file *file)
{
    const char *end = file->end;
    if (is_text(file)) zr_ply_skip_comments(file);
    while (is_text(file) && end > file->at && (end[-1] == ' ' || (end[-1] >= '\t' && end[-1] <= '\r')))
        end--;
    file->odd.trailing_bytes = (size_t)(end - file->at);
}

static enum zr_status read_elements(struct zr_ply_file *file)
{
    enum zr_status status = ZR_OK;
    for (size_t i = 0; status == ZR_OK && i < file->header.element_count; i++)
        status = read_element(file, &file->header.elements[i]);
    if (file->error->count > 0) return file->error->status;
    note_trailing(file);
    if (status == ZR_OK && file->odd.broken_lines > 0 && file->odd.trailing_bytes > 0)
        return zr_error_add(file->error, ZR_BAD_SYNTAX, NULL,
                            "line %zu: %s %zu has another number of values than the header says, and %zu bytes are "
                            "left behind the last element",
                            file->odd.first_broken_line, zr_ply_printable(file->odd.broken_name).text,
                            file->odd.broken_record, file->odd.trailing_bytes);
    return status;
}

enum zr_status zr_read_PLY(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_ply_file file = {.arena = builder->arena,
                               .team = builder->team,
                               .cancel = request->cancel,
                               .limits = limits,
                               .error = error,
                               .end = request->bytes + request->size};
    enum zr_status status = zr_ply_read_header(builder->arena, request->bytes, request->size, &file.header, error);
    if (status != ZR_OK) return status;
    file.at = request->bytes + file.header.size;
    file.line = file.header.lines + 1;
    file.last_line = file.header.lines;
    if (!check_counts(&file)) return error->status;
    status = read_elements(&file);
    if (zr_is_cancelled(request->cancel)) return ZR_CANCELLED;
    if (status == ZR_OK) status = zr_ply_adjust(&file, builder);
    return status == ZR_OK ? zr_ply_finish(&file, builder) : status;
}
