/* json_matrix.h - input: reads matrices: lists of rows, flat lists, or arrays (json_array.h). Readers are as in
 * json_value.h. */
#ifndef ZR_JSON_MATRIX_H
#define ZR_JSON_MATRIX_H

#include "base/matrix.h"
#include "input/json/json_value.h"

zr_json_read_fn zr_json_mat4;   /* zr_mat4: four rows of four numbers, or sixteen numbers column by column */
zr_json_read_fn zr_json_affine; /* zr_mat4, affine: its bottom row is 0 0 0 1 */

/* Reads an affine matrix. *exact: its doubles, if json->far is set; else those of the rounded matrix. */
bool zr_json_affine_exact(struct zr_json *json, const struct zr_json_path *path, zr_mat4 *rounded,
                          struct zr_matrix *exact);

/* Reads a matrix of side x side numbers, magnitudes up to `limit`, in the order of the text. *nested: a list of rows,
 * or an array; else one flat list. */
bool zr_json_square(struct zr_json *json, const struct zr_json_path *path, size_t side, double limit, double *out,
                    bool *nested);

#endif
