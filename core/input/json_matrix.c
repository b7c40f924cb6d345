#include "input/json_matrix.h"

#include "input/json_array.h"
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
    size_t count, row = 0;
    if (zr_json_type(json) == ZR_JSON_OBJECT) {
        *nested = true;
        return zr_json_array_square(json, path, side, limit, out);
    }
    if (zr_json_type(json) != ZR_JSON_LIST) return zr_json_expect(json, path, "a matrix");
    bool good = true;
    *nested = has_rows(json);
    if (!*nested) return zr_json_numbers(json, path, side * side, side * side, -limit, limit, out, &count);
    for (zr_json_enter(json, '['); zr_json_any_item(json); row++)
        good = (row < side ? zr_json_numbers(json, ZR_JSON_ITEM(path, row), side, side, -limit, limit, &out[side * row],
                                             &count)
                           : zr_json_skip(json)) &&
               good;
    return row == side ? good : zr_json_fault(json, path, "expected %zu rows, found %zu", side, row);
}

bool zr_json_mat4(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field, void *out)
{
    double m[16] = {0};
    bool rows;
    zr_mat4 matrix;
    (void)field;
    if (!zr_json_square(json, path, 4, (double)ZR_MATRIX_MAX, m, &rows)) return false;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            matrix.m[4 * i + k] = (float)m[rows ? 4 * k + i : 4 * i + k];
    *(zr_mat4 *)out = matrix;
    return true;
}

/* The message explains the order: a flat list written row by row has the translation in the bottom row. */
bool zr_json_affine(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field, void *out)
{
    zr_mat4 matrix;
    const float *m = matrix.m;
    if (!zr_json_mat4(json, path, field, &matrix)) return false;
    if (m[3] != 0.0f || m[7] != 0.0f || m[11] != 0.0f || m[15] != 1.0f)
        return zr_json_fault(json, path,
                             "the bottom row is %.9g %.9g %.9g %.9g, not 0 0 0 1 (a flat list goes column by column)",
                             (double)m[3], (double)m[7], (double)m[11], (double)m[15]);
    *(zr_mat4 *)out = matrix;
    return true;
}

/* The quaternion is normalised by dividing products by its squared length, so that right angles stay exact.
 * Source: glTF 2.0, section 3.5.3 "Transformations"; Shoemake, "Quaternions", 1991. */
zr_mat4 zr_mat4_of_pose(zr_vec3 t, zr_vec4 q, zr_vec3 s)
{
    const double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
    const double n = x * x + y * y + z * z + w * w;
    const double rotation[9] = {
        (w * w + x * x - y * y - z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n, 2 * (x * y - w * z) / n,
        (w * w - x * x + y * y - z * z) / n, 2 * (y * z + w * x) / n, 2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n,
        (w * w - x * x - y * y + z * z) / n};
    const double scale[3] = {(double)s.x, (double)s.y, (double)s.z};
    zr_mat4 out = zr_mat4_identity();
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            out.m[column * 4 + row] = (float)(rotation[column * 3 + row] * scale[column]);
    out.m[12] = t.x;
    out.m[13] = t.y;
    out.m[14] = t.z;
    return out;
}
