/* Integers of attributes of Draco meshes: coded corrections to values that are predicted from those before them. */
#include "input/codecs/draco_mesh.h"

/* Predictions and transforms, as the bitstream counts them. */
enum {
    PREDICT_NOTHING = 254,
    PREDICT_UNDEFINED = 255,
    PREDICT_DIFFERENCE = 0,
    PREDICT_PARALLELOGRAM,
    PREDICT_MULTI_PARALLELOGRAM,
    PREDICT_OLD_TEXCOORDS,
    PREDICT_SOME_PARALLELOGRAMS,
    PREDICT_TEXCOORDS,
    PREDICT_NORMALS
};
enum { TRANSFORM_WRAP = 1, TRANSFORM_OCTAHEDRON, TRANSFORM_CANONICAL };
enum { PARALLELOGRAMS = 4 };

/* ---- parallelograms ---- */

/* Predicts value i at a corner: the parallelogram with the opposite triangle. False if a value of that is not known. */
static bool predict_corner(const struct zr_draco_values *of, uint32_t i, uint32_t corner, int32_t *out)
{
    const struct zr_draco_order *order = of->order;
    const uint32_t opposite = order->of->opposites[corner], *vertices = order->of->vertices;
    if (opposite == ZR_DRACO_NONE) return false;
    const uint32_t far = order->values[vertices[opposite]], next = order->values[vertices[zr_draco_next(opposite)]],
                   previous = order->values[vertices[zr_draco_previous(opposite)]];
    if (far >= i || next >= i || previous >= i) return false;
    const int32_t *a = of->integers + (size_t)next * of->width, *b = of->integers + (size_t)previous * of->width,
                  *c = of->integers + (size_t)far * of->width;
    for (uint32_t k = 0; k < of->width; k++)
        out[k] = (int32_t)((uint32_t)a[k] + (uint32_t)b[k] - (uint32_t)c[k]);
    return true;
}

static bool predict_parallelograms(struct zr_draco *draco, struct zr_draco_values *of, const struct zr_draco_wrap *wrap)
{
    const int32_t zeros[ZR_DRACO_WIDTH] = {0};
    int32_t predicted[ZR_DRACO_WIDTH];
    for (uint32_t i = 0; i < of->order->count; i++) {
        int32_t *values = of->integers + (size_t)i * of->width;
        if (zr_draco_stops(draco)) return false;
        const bool is_predicted = predict_corner(of, i, of->order->corners[i], predicted);
        zr_draco_wrap_add(wrap, is_predicted ? predicted : i > 0 ? values - of->width : zeros, values);
    }
    return true;
}

/* Per number of parallelograms, less 1: whether each is used. */
struct creases {
    uint32_t counts[PARALLELOGRAMS];
    struct zr_draco_flags flags[PARALLELOGRAMS];
};

static bool read_creases(struct zr_draco *draco, uint32_t most, struct creases *out)
{
    for (int i = 0; i < PARALLELOGRAMS; i++) {
        out->counts[i] = zr_draco_count(&draco->stream);
        if (out->counts[i] > most) return false;
        if (out->counts[i] > 0 && !zr_draco_flags_open(&draco->stream, &out->flags[i])) return false;
    }
    return true;
}

/* Predicts value i by up to four parallelograms: around its vertex to the left, and from a boundary to the right.
 * Returns their number. */
static uint32_t predict_around(struct zr_draco *draco, const struct zr_draco_values *of, uint32_t i,
                               int32_t (*out)[ZR_DRACO_WIDTH])
{
    const struct zr_draco_corners *corners = of->order->of;
    const uint32_t start = of->order->corners[i];
    uint32_t count = 0, at = start;
    for (bool to_left = true; at != ZR_DRACO_NONE && count < PARALLELOGRAMS && !zr_draco_stops(draco);) {
        count += predict_corner(of, i, at, out[count]);
        at = to_left ? zr_draco_left(corners, at) : zr_draco_right(corners, at);
        if (at == start) break;
        if (at == ZR_DRACO_NONE && to_left) {
            to_left = false;
            at = zr_draco_right(corners, start);
        }
    }
    return count;
}

/* Averages the parallelograms that are used, into the first one. Returns their number. */
static uint32_t average(const struct zr_draco_values *of, uint32_t count, struct creases *creases,
                        int32_t (*predicted)[ZR_DRACO_WIDTH], bool *is_broken)
{
    uint32_t used = 0, sums[ZR_DRACO_WIDTH] = {0};
    for (uint32_t i = 0; i < count; i++) {
        if (creases->counts[count - 1]-- == 0) *is_broken = true;
        if (*is_broken) return 0;
        if (zr_draco_flags_next(&creases->flags[count - 1])) continue;
        used++;
        for (uint32_t k = 0; k < of->width; k++)
            sums[k] += (uint32_t)predicted[i][k];
    }
    for (uint32_t k = 0; used > 0 && k < of->width; k++)
        predicted[0][k] = (int32_t)sums[k] / (int32_t)used;
    return used;
}

static bool predict_some_parallelograms(struct zr_draco *draco, struct zr_draco_values *of,
                                        const struct zr_draco_wrap *wrap, struct creases *creases)
{
    const int32_t zeros[ZR_DRACO_WIDTH] = {0};
    int32_t predicted[PARALLELOGRAMS][ZR_DRACO_WIDTH];
    bool is_broken = false;
    for (uint32_t i = 0; i < of->order->count && !is_broken; i++) {
        int32_t *values = of->integers + (size_t)i * of->width;
        if (zr_draco_stops(draco)) return false;
        const uint32_t count = i > 0 ? predict_around(draco, of, i, predicted) : 0;
        const bool is_predicted = average(of, count, creases, predicted, &is_broken) > 0;
        zr_draco_wrap_add(wrap, is_predicted ? predicted[0] : i > 0 ? values - of->width : zeros, values);
    }
    for (int i = 0; i < PARALLELOGRAMS; i++)
        is_broken |= creases->flags[i].is_broken;
    return !is_broken;
}

/* ---- differences ---- */

static bool add_differences(struct zr_draco *draco, struct zr_draco_values *of, const struct zr_draco_wrap *wrap,
                            const struct zr_draco_octahedron *octahedron)
{
    const int32_t zeros[ZR_DRACO_WIDTH] = {0};
    for (uint32_t i = 0; i < of->order->count; i++) {
        int32_t *values = of->integers + (size_t)i * of->width;
        const int32_t *before = i > 0 ? values - of->width : zeros;
        if (zr_draco_stops(draco)) return false;
        if (wrap)
            zr_draco_wrap_add(wrap, before, values);
        else
            zr_draco_octahedron_add(octahedron, before, values);
    }
    return true;
}

/* ---- all ---- */

/* Finds the integers of the first attribute that is a position, and its value for each value of the order. */
static bool find_positions(struct zr_draco *draco, const struct zr_draco_order *order, struct zr_draco_positions *out)
{
    const struct zr_draco_values *of = NULL;
    for (uint32_t i = 0; !of && i < draco->mesh->attribute_count; i++)
        if (draco->values[i].kind == ZR_DRACO_POSITION) of = &draco->values[i];
    if (!of || !of->integers || of->width != 3) return false;
    uint32_t *of_value = zr_draco_numbers(draco, order->count);
    for (uint32_t i = 0; of_value && i < order->count; i++)
        of_value[i] = of->order->of_point[draco->points[order->corners[i]]];
    *out = (struct zr_draco_positions){of->integers, of_value};
    return of_value;
}

static bool predict_normals(struct zr_draco *draco, struct zr_draco_values *of, uint32_t method, uint32_t transform)
{
    const bool is_canonical = transform == TRANSFORM_CANONICAL;
    struct zr_draco_positions positions;
    struct zr_draco_octahedron octahedron;
    if (method == PREDICT_NORMALS && of->order->of)
        return find_positions(draco, of->order, &positions) &&
               zr_draco_predict_normals(draco, of, is_canonical, &positions);
    return zr_draco_octahedron_read(&draco->stream, is_canonical, &octahedron) &&
           add_differences(draco, of, NULL, &octahedron);
}

static bool predict(struct zr_draco *draco, struct zr_draco_values *of, uint32_t method)
{
    struct zr_draco_positions positions;
    struct zr_draco_wrap wrap;
    struct creases creases = {.counts = {0}};
    const bool has_faces = of->order->of;
    if (has_faces && method == PREDICT_TEXCOORDS)
        return find_positions(draco, of->order, &positions) && zr_draco_predict_texcoords(draco, of, &positions);
    if (has_faces && method == PREDICT_SOME_PARALLELOGRAMS && !read_creases(draco, draco->base.corner_count, &creases))
        return false;
    if (!zr_draco_wrap_read(&draco->stream, of->width, &wrap)) return false;
    if (has_faces && method == PREDICT_SOME_PARALLELOGRAMS)
        return predict_some_parallelograms(draco, of, &wrap, &creases);
    if (has_faces && method == PREDICT_PARALLELOGRAM) return predict_parallelograms(draco, of, &wrap);
    return add_differences(draco, of, &wrap, NULL);
}

/* Refuses methods and transforms that the version does not write. */
static bool check(struct zr_draco *draco, const struct zr_draco_values *of, uint32_t method, uint32_t transform)
{
    const bool is_normal = of->coder == ZR_DRACO_NORMAL;
    if (method == PREDICT_NOTHING) return true;
    if (method == PREDICT_MULTI_PARALLELOGRAM || method == PREDICT_OLD_TEXCOORDS ||
        (method == PREDICT_NORMALS && !is_normal) || (method > PREDICT_NORMALS && method != PREDICT_UNDEFINED))
        return zr_draco_refuse(draco, "the prediction method %u is not read", method);
    if (is_normal ? transform == TRANSFORM_OCTAHEDRON || transform == TRANSFORM_CANONICAL : transform == TRANSFORM_WRAP)
        return true;
    return zr_draco_refuse(draco, "the prediction transform %u is not read", transform);
}

/* Reads numbers of up to 4 bytes. */
static bool read_plain(struct zr_draco *draco, uint32_t count, uint32_t *out)
{
    const uint32_t bytes = zr_draco_u8(&draco->stream);
    const unsigned char *at = bytes <= 4 ? zr_draco_take(&draco->stream, (uint64_t)bytes * count) : NULL;
    for (uint32_t i = 0; at && i < count; i++) {
        if (zr_draco_stops(draco)) return false;
        out[i] = 0;
        for (uint32_t k = 0; k < bytes; k++)
            out[i] |= (uint32_t)*at++ << 8 * k;
    }
    return at;
}

/* Converts 0, 1, 2, 3 and so on to 0, -1, 1, -2. */
static bool make_signed(struct zr_draco *draco, uint32_t count, uint32_t *numbers)
{
    for (uint32_t i = 0; i < count; i++) {
        if (zr_draco_stops(draco)) return false;
        numbers[i] = numbers[i] & 1 ? ~(numbers[i] >> 1) : numbers[i] >> 1;
    }
    return true;
}

bool zr_draco_read_integers(struct zr_draco *draco, struct zr_draco_values *of)
{
    const uint32_t method = zr_draco_u8(&draco->stream), count = of->order->count * of->width;
    const uint32_t transform = method == PREDICT_NOTHING ? 0 : zr_draco_u8(&draco->stream);
    const bool is_coded = zr_draco_u8(&draco->stream) > 0, is_normal = of->coder == ZR_DRACO_NORMAL;
    uint32_t *numbers = zr_draco_numbers(draco, count);
    if (!numbers || draco->stream.is_broken || !check(draco, of, method, transform)) return false;
    if (is_coded ? !zr_draco_read_symbols(&draco->stream, &draco->scratch, draco->cancel, count, of->width, numbers)
                 : !read_plain(draco, count, numbers))
        return false;
    of->integers = (int32_t *)numbers;
    if ((method == PREDICT_NOTHING || !is_normal) && !make_signed(draco, count, numbers)) return false;
    if (method == PREDICT_NOTHING) return true;
    return is_normal ? predict_normals(draco, of, method, transform) : predict(draco, of, method);
}
