#include "input/json/json_matrix.h"

#include <math.h>

#include "input/json/json_array.h"
#include "scene/scene.h"

/* True if the next value is a list of lists. */
static bool has_rows(const struct zr_json *json)
{
    struct zr_json there = *json;
    return zr_json_enter(&there, '[') && zr_json_any_item(&there) && *there.at == '[';
}

bool zr_json_square(struct zr_json *json, const struct zr_json_path *path, size_t side, double limit, double *out,
                    bool *nested)
{
    const struct zr_json_row flat = {side * side, side * side, -limit, limit}, of_row = {side, side, -limit, limit};
    size_t row = 0;
    *nested = true;
    if (zr_json_type(json) == ZR_JSON_OBJECT) return zr_json_array_square(json, path, side, limit, out);
    if (zr_json_type(json) != ZR_JSON_LIST) return zr_json_expect(json, path, "a matrix");
    bool good = true;
    *nested = has_rows(json);
    if (!*nested) return zr_json_numbers(json, path, flat, out, NULL);
    for (zr_json_enter(json, '['); zr_json_any_item(json); row++)
        good = (row < side ? zr_json_numbers(json, ZR_JSON_ITEM(path, row), of_row, &out[side * row], NULL)
                           : zr_json_skip(json)) &&
               good;
    return row == side ? good : zr_json_fault(json, path, "expected %zu rows, found %zu", side, row);
}

bool zr_json_mat4(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double m[16] = {0};
    bool rows;
    zr_mat4 matrix;
    if (!zr_json_square(json, path, 4, (double)ZR_MATRIX_MAX, m, &rows)) return false;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            matrix.m[4 * i + k] = (float)m[rows ? 4 * k + i : 4 * i + k];
    *(zr_mat4 *)out = matrix;
    return true;
}

/* Largest distance from 1 of the last element of an affine matrix that went through other programs. */
#define ROUNDING 1e-5f

/* The message explains the order: a flat list written row by row has the translation in the bottom row. */
bool zr_json_affine(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    zr_mat4 matrix;
    float *m = matrix.m;
    if (!zr_json_mat4(json, path, &matrix)) return false;
    const float last = m[15];
    if (last != 1.0f && fabsf(last - 1.0f) <= ROUNDING) /* divides all by the last element, which is the same matrix */
        for (int i = 0; i < 16; i++)
            m[i] /= last;
    if (m[3] != 0.0f || m[7] != 0.0f || m[11] != 0.0f || m[15] != 1.0f)
        return zr_json_fault(json, path,
                             "the bottom row is %.9g %.9g %.9g %.9g, not 0 0 0 1 (a flat list goes column by column)",
                             (double)m[3], (double)m[7], (double)m[11], (double)m[15]);
    *(zr_mat4 *)out = matrix;
    return true;
}

bool zr_json_affine_exact(struct zr_json *json, const struct zr_json_path *path, zr_mat4 *rounded,
                          struct zr_matrix *exact)
{
    struct zr_json there = *json;
    double m[16] = {0};
    bool rows;
    if (!zr_json_affine(json, path, rounded)) return false;
    *exact = zr_matrix_of(rounded);
    if (!json->far || !zr_json_square(&there, path, 4, (double)ZR_MATRIX_MAX, m, &rows)) return true;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            exact->m[4 * i + k] = m[rows ? 4 * k + i : 4 * i + k] / m[15];
    return true;
}
