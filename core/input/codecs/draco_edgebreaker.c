/* Edgebreaker connectivity of Draco meshes: each symbol adds a face at the active edge (Rossignac, 1999; decoded in
 * reverse as by Isenburg and Snoeyink, 2001). */
#include "input/codecs/draco_mesh.h"

/* A face that a later split joins. Both numbers count symbols from the last one. */
struct split {
    uint32_t source, target;
    bool is_right;
};

struct work {
    struct zr_draco *draco;
    struct zr_draco_traversal traversal;
    struct zr_draco_corners *of; /* draco->base; `vertices` may name vertices that are merged */
    bool *is_inner;
    uint32_t *parents;                  /* per vertex: the vertex that replaces it, or itself */
    uint32_t vertices_most, faces;      /* vertices that fit; faces so far */
    uint32_t symbol_count, split_count; /* splits that are left */
    uint32_t *active, active_count;     /* corners opposite to the active edges; the last one is used */
    struct split *splits;               /* by their sources */
    uint32_t *split_corners;            /* per symbol: the corner of an edge that it joins, or NONE; NULL: no splits */
    uint32_t *merged, merged_count, merged_most; /* vertices without corners */
};

/* Returns the vertex of a corner. Shortens the chain of merged vertices. */
static inline uint32_t vertex_of(struct work *work, uint32_t corner)
{
    uint32_t *parents = work->parents, vertex = work->of->vertices[corner];
    while (parents[vertex] != vertex) {
        parents[vertex] = parents[parents[vertex]];
        vertex = parents[vertex];
    }
    return vertex;
}

static inline bool is_free(const struct work *work, uint32_t corner)
{
    return work->of->opposites[corner] == ZR_DRACO_NONE;
}

static inline void join(struct work *work, uint32_t a, uint32_t b)
{
    work->of->opposites[a] = b;
    work->of->opposites[b] = a;
}

static inline uint32_t add_vertex(struct work *work, uint32_t corner)
{
    const uint32_t vertex = work->of->vertex_count++;
    work->of->first[vertex] = corner;
    work->parents[vertex] = vertex;
    work->of->vertices[corner] = vertex;
    return vertex;
}

/* Returns the corner opposite to the next edge around a vertex, or NONE. */
static inline uint32_t around(const struct work *work, uint32_t vertex)
{
    return zr_draco_next(work->of->first[vertex]);
}

/* ---- symbols ---- */

/* A face between two edges of a vertex, which it encloses. */
static bool add_between(struct work *work, uint32_t tip)
{
    const uint32_t a = work->active[work->active_count - 1], x = vertex_of(work, zr_draco_next(a)), b = around(work, x);
    if (b == ZR_DRACO_NONE || a == b || !is_free(work, a) || !is_free(work, b)) return false;
    const uint32_t left = vertex_of(work, zr_draco_next(b)), right = vertex_of(work, zr_draco_previous(a));
    if (x == left || x == right) return false;
    join(work, a, tip + 1);
    join(work, b, tip + 2);
    work->of->vertices[tip] = x;
    work->of->vertices[tip + 1] = left;
    work->of->vertices[tip + 2] = right;
    work->of->first[right] = tip + 2;
    work->is_inner[x] = true;
    work->active[work->active_count - 1] = tip;
    return true;
}

/* A face at the active edge with a new vertex. */
static bool add_at_edge(struct work *work, uint32_t tip, bool is_right)
{
    const uint32_t a = work->active[work->active_count - 1];
    if (!is_free(work, a) || work->of->vertex_count + 1 > work->vertices_most) return false;
    const uint32_t opposite = is_right ? tip + 2 : tip + 1, left = is_right ? tip + 1 : tip,
                   right = is_right ? tip : tip + 2, vertex = vertex_of(work, zr_draco_previous(a));
    join(work, opposite, a);
    add_vertex(work, opposite);
    work->of->vertices[right] = vertex;
    work->of->first[vertex] = right;
    work->of->vertices[left] = vertex_of(work, zr_draco_next(a));
    work->active[work->active_count - 1] = tip;
    return true;
}

/* A face that joins two active edges, and merges one vertex of each. */
static bool add_joining(struct work *work, uint32_t tip, uint32_t symbol)
{
    const uint32_t b = work->active[--work->active_count];
    if (work->split_corners && work->split_corners[symbol] != ZR_DRACO_NONE)
        work->active[work->active_count++] = work->split_corners[symbol];
    if (work->active_count == 0) return false;
    const uint32_t a = work->active[work->active_count - 1];
    if (a == b || !is_free(work, a) || !is_free(work, b)) return false;
    join(work, a, tip + 2);
    join(work, b, tip + 1);
    const uint32_t kept = vertex_of(work, zr_draco_previous(a)), merged = vertex_of(work, zr_draco_next(b)),
                   last = vertex_of(work, zr_draco_previous(b));
    if (kept == merged || work->merged_count == work->merged_most) return false;
    work->of->vertices[tip] = kept;
    work->of->vertices[tip + 1] = vertex_of(work, zr_draco_next(a));
    work->of->vertices[tip + 2] = last;
    work->of->first[last] = tip + 2;
    zr_draco_traversal_merge(&work->traversal, kept, merged);
    work->of->first[kept] = work->of->first[merged];
    work->of->first[merged] = ZR_DRACO_NONE;
    work->parents[merged] = kept;
    work->merged[work->merged_count++] = merged;
    work->active[work->active_count - 1] = tip;
    return true;
}

/* A face with three new vertices. */
static bool add_alone(struct work *work, uint32_t tip)
{
    if (work->of->vertex_count + 3 > work->vertices_most) return false;
    for (uint32_t k = 0; k < 3; k++)
        add_vertex(work, tip + k);
    work->active[work->active_count++] = tip;
    return true;
}

/* Notes the edges of the newest face that later splits join. */
static bool note_splits(struct work *work, uint32_t symbol)
{
    const uint32_t from_end = work->symbol_count - symbol - 1, top = work->active[work->active_count - 1];
    while (work->split_count > 0 && work->splits[work->split_count - 1].source >= from_end) {
        const struct split *split = &work->splits[--work->split_count];
        if (split->source > from_end || split->target >= work->symbol_count) return false;
        work->split_corners[work->symbol_count - split->target - 1] =
            split->is_right ? zr_draco_next(top) : zr_draco_previous(top);
    }
    return true;
}

static bool add_face(struct work *work, uint32_t number)
{
    const enum zr_draco_symbol symbol = zr_draco_traversal_next(&work->traversal);
    const uint32_t tip = 3 * work->faces++;
    if (symbol == ZR_DRACO_NO_SYMBOL || (symbol != ZR_DRACO_E && work->active_count == 0)) return false;
    const bool good = symbol == ZR_DRACO_C   ? add_between(work, tip)
                      : symbol == ZR_DRACO_S ? add_joining(work, tip, number)
                      : symbol == ZR_DRACO_E ? add_alone(work, tip)
                                             : add_at_edge(work, tip, symbol == ZR_DRACO_R);
    if (!good) return false;
    if (work->traversal.by_valence)
        zr_draco_traversal_add(&work->traversal, symbol, vertex_of(work, tip), vertex_of(work, tip + 1),
                               vertex_of(work, tip + 2));
    return symbol == ZR_DRACO_C || symbol == ZR_DRACO_S || note_splits(work, number);
}

/* A face inside, at which a component was begun. */
static bool add_start(struct work *work, uint32_t a)
{
    const uint32_t n = vertex_of(work, zr_draco_next(a)), b = around(work, n);
    if (work->faces == work->draco->mesh->face_count || b == ZR_DRACO_NONE) return false;
    const uint32_t x = vertex_of(work, zr_draco_next(b)), c = around(work, x), tip = 3 * work->faces++;
    if (c == ZR_DRACO_NONE || a == b || a == c || b == c || !is_free(work, a) || !is_free(work, b) || !is_free(work, c))
        return false;
    const uint32_t vertices[3] = {x, vertex_of(work, zr_draco_next(c)), n}, opposites[3] = {a, b, c};
    for (uint32_t k = 0; k < 3; k++) {
        join(work, tip + k, opposites[k]);
        work->of->vertices[tip + k] = vertices[k];
        work->is_inner[vertices[k]] = true;
    }
    return true;
}

static bool add_faces(struct work *work)
{
    for (uint32_t i = 0; i < work->symbol_count; i++) {
        if (zr_draco_stops(work->draco)) return false;
        if (!add_face(work, i)) return false;
    }
    while (work->active_count > 0) {
        const uint32_t a = work->active[--work->active_count];
        if (zr_draco_stops(work->draco)) return false;
        if (zr_draco_flags_next(&work->traversal.starts) && !add_start(work, a)) return false;
    }
    return work->faces == work->draco->mesh->face_count && !work->traversal.starts.is_broken;
}

/* ---- vertices ---- */

/* Moves the last vertices to the numbers of merged ones, as the reference decoder does without seams. ids: number of
 * each vertex; at: its inverse. False if cancelled. */
static bool fill_gaps(struct work *work, uint32_t *ids, uint32_t *at)
{
    uint32_t count = work->of->vertex_count, *first = work->of->first;
    for (uint32_t i = 0; i < work->merged_count; i++) {
        const uint32_t gap = work->merged[i];
        if (zr_draco_stops(work->draco)) return false;
        while (count > 0 && first[count - 1] == ZR_DRACO_NONE)
            count--;
        if (count == 0 || count - 1 < gap) continue;
        const uint32_t last = --count;
        ids[at[last]] = gap;
        at[gap] = at[last];
        first[gap] = first[last];
        first[last] = ZR_DRACO_NONE;
        work->is_inner[gap] = work->is_inner[last];
    }
    return true;
}

/* Replaces merged vertices in all corners. */
static bool settle_vertices(struct work *work)
{
    const uint32_t count = work->of->vertex_count;
    uint32_t *ids = NULL;
    if (work->merged_count == 0) return true;
    if (work->draco->seam_count == 0) {
        uint32_t *at = zr_draco_numbers(work->draco, count);
        ids = zr_draco_numbers(work->draco, count);
        if (!ids || !at) return false;
        for (uint32_t v = 0; v < count && !zr_draco_stops(work->draco); v++)
            ids[v] = at[v] = v;
        if (zr_is_cancelled(work->draco->cancel) || !fill_gaps(work, ids, at)) return false;
    }
    for (uint32_t c = 0; c < work->of->corner_count; c++) {
        const uint32_t vertex = vertex_of(work, c);
        if (zr_draco_stops(work->draco)) return false;
        work->of->vertices[c] = ids ? ids[vertex] : vertex;
    }
    return true;
}

/* ---- seams ---- */

/* Reads whether each edge is a seam, for all attributes. The flag is at the corner of the face that comes first. */
static bool read_seams(struct work *work, bool *const *is_seam)
{
    const struct zr_draco_corners *of = work->of;
    const uint32_t seams = work->draco->seam_count;
    for (uint32_t c = 0; c < of->corner_count; c++) {
        if (zr_draco_stops(work->draco)) return false;
        if (of->opposites[c] == ZR_DRACO_NONE || of->opposites[c] / 3 < c / 3) continue;
        for (uint32_t i = 0; i < seams; i++)
            is_seam[i][c] = zr_draco_flags_next(&work->traversal.seams[i]);
    }
    for (uint32_t i = 0; i < seams; i++)
        if (work->traversal.seams[i].is_broken) return false;
    return true;
}

static bool make_seams(struct work *work)
{
    struct zr_draco *draco = work->draco;
    bool *is_seam[ZR_DRACO_ATTRIBUTES];
    for (uint32_t i = 0; i < draco->seam_count; i++) {
        is_seam[i] = zr_arena_zero(&draco->scratch, work->of->corner_count, sizeof *is_seam[i]);
        if (!is_seam[i]) return false;
    }
    if (!read_seams(work, is_seam)) return false;
    for (uint32_t i = 0; i < draco->seam_count; i++)
        if (!zr_draco_make_seams(draco, is_seam[i], &draco->seams[i])) return false;
    return true;
}

/* ---- the start ---- */

static bool read_splits(struct work *work)
{
    struct zr_draco_stream *stream = &work->draco->stream;
    uint64_t source = 0;
    work->split_count = zr_draco_count(stream);
    if (work->split_count > (size_t)(stream->end - stream->at) / 2) return false; /* two bytes each, at least */
    if (work->split_count == 0) return !stream->is_broken;
    work->splits = zr_arena_alloc(&work->draco->scratch, work->split_count, sizeof *work->splits);
    work->split_corners = zr_draco_nones(work->draco, work->symbol_count);
    if (!work->splits || !work->split_corners) return false;
    for (uint32_t i = 0; i < work->split_count; i++) {
        source += zr_draco_count(stream);
        const uint32_t back = zr_draco_count(stream);
        if (stream->is_broken || back > source || source >= work->symbol_count) return false;
        work->splits[i] = (struct split){(uint32_t)source, (uint32_t)source - back, false};
    }
    struct zr_draco_bits bits = {stream->at, 0, 8 * (uint64_t)(stream->end - stream->at), false};
    for (uint32_t i = 0; i < work->split_count; i++)
        work->splits[i].is_right = zr_draco_bits_read(&bits, 1);
    zr_draco_take(stream, (bits.at + 7) / 8);
    return !bits.is_broken && !stream->is_broken;
}

static bool allocate(struct work *work)
{
    struct zr_draco *draco = work->draco;
    struct zr_draco_corners *of = work->of;
    of->corner_count = 3 * draco->mesh->face_count;
    of->vertices = zr_draco_numbers(draco, of->corner_count);
    of->opposites = zr_draco_nones(draco, of->corner_count);
    of->first = zr_draco_numbers(draco, work->vertices_most);
    work->parents = zr_draco_numbers(draco, work->vertices_most);
    work->active = zr_draco_numbers(draco, draco->mesh->face_count);
    work->merged = zr_draco_numbers(draco, work->merged_most);
    work->is_inner = draco->is_inner = zr_arena_zero(&draco->scratch, work->vertices_most, sizeof *work->is_inner);
    return of->opposites && zr_arena_ok(&draco->scratch);
}

/* Reads the counts at the start, and checks that they go together. */
static bool read_counts(struct work *work)
{
    struct zr_draco *draco = work->draco;
    struct zr_draco_stream *stream = &draco->stream;
    const uint64_t vertices = zr_draco_varint(stream), faces = zr_draco_varint(stream);
    draco->seam_count = zr_draco_u8(stream);
    const uint64_t symbols = zr_draco_varint(stream), splits = zr_draco_varint(stream);
    if (stream->is_broken || !zr_draco_set_faces(draco, faces)) return false;
    if (draco->seam_count > ZR_DRACO_ATTRIBUTES)
        return zr_draco_refuse(draco, "%u groups of attributes; %d are read", draco->seam_count, ZR_DRACO_ATTRIBUTES);
    if (vertices > 3 * faces || symbols > faces || faces > symbols + symbols / 3 || splits > symbols) return false;
    work->symbol_count = (uint32_t)symbols;
    work->vertices_most = (uint32_t)(vertices + splits);
    work->merged_most = (uint32_t)splits;
    return true;
}

bool zr_draco_read_edgebreaker(struct zr_draco *draco)
{
    enum { STANDARD, PREDICTIVE, VALENCE };
    struct work work = {.draco = draco, .of = &draco->base};
    const uint32_t method = zr_draco_u8(&draco->stream);
    if (method == PREDICTIVE) return zr_draco_refuse(draco, "predictive edgebreaker connectivity is not read");
    if (method > VALENCE) return zr_draco_refuse(draco, "edgebreaker connectivity of the unknown method %u", method);
    draco->has_table = true;
    return read_counts(&work) && allocate(&work) && read_splits(&work) &&
           zr_draco_traversal_open(draco, method == VALENCE, work.vertices_most, &work.traversal) && add_faces(&work) &&
           settle_vertices(&work) && make_seams(&work) && zr_draco_make_points(draco);
}
