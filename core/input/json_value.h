/* json_value.h - input: one cJSON node -> one checked value, or a complaint with
 * a JSON Pointer to it.
 *
 * Every function returns false after reporting ZR_BAD_SCENE, so that a reader
 * may go on with what else is there and report up to ZR_ERROR_ITEMS faults at
 * once; loops over input stop at zr_json_full. Lists are walked along ->next.
 */
#ifndef ZR_JSON_VALUE_H
#define ZR_JSON_VALUE_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/status.h"
#include "base/vec.h"
#include "input/names.h"
#include "zraster.h"

struct zr_json_text; /* json_text.h */
struct zr_team;      /* base/team.h */

struct zr_json {
    struct zr_arena *arena;
    struct zr_team *team;           /* may be NULL */
    const struct zr_cancel *cancel; /* may be NULL */
    const struct zr_limits *limits;
    struct zr_error *error;
    struct zr_json_text *text;
};

/* Where a reader is: a chain of links on the stack, written out (RFC 6901) only
 * when something is wrong. `key` is NULL for an item of a list. */
struct zr_json_path {
    const struct zr_json_path *parent; /* NULL: the root */
    const char *key;
    size_t index;
};

#define ZR_JSON_KEY(parent, key)    (&(const struct zr_json_path){(parent), (key), 0})
#define ZR_JSON_ITEM(parent, index) (&(const struct zr_json_path){(parent), NULL, (index)})

/* Reports ZR_BAD_SCENE at `path` (NULL: the root); returns false. Once the arena has failed nothing is reported: what
 * could not be kept looks as if the scene lacked it. */
bool zr_json_fault(struct zr_json *json, const struct zr_json_path *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Reports that `what` was expected and `node` found; returns false. */
bool zr_json_expect(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, const char *what);

/* As many faults as are kept, or the text is malformed after all: time to stop. */
bool zr_json_full(const struct zr_json *json);

/* The request is cancelled. All readers end then as where memory is used up: the arena has failed. Loops over what may
 * be long ask, in the request's own thread. */
bool zr_json_stopped(struct zr_json *json);

/* found[i] becomes the member named keys->words[i], or NULL; keys->count of them.
 * Unknown, unsupported and repeated keys are reported, and what is known is still
 * filled in: false only where the node is no object. */
bool zr_json_object(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                    const struct zr_names *keys, const cJSON **found);

/* A list of any length. */
bool zr_json_array(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, size_t *count);

/* A finite number, low <= *out <= high. */
bool zr_json_number(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, double low, double high,
                    double *out);

/* A length, which is no place: magnitude <= 1000 * coordinate_max, so that scenes of the full size can be seen whole.
 */
bool zr_json_length(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, float *out);

/* A length > 0, still > 0 as a float. */
bool zr_json_positive(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, float *out);

/* A place along an axis: magnitude <= coordinate_max. */
bool zr_json_coordinate(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, float *out);

/* A whole number, 0..UINT32_MAX. */
bool zr_json_whole(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, uint32_t *out);

/* A whole number below `count`; `of` names what is counted ("positions"). */
bool zr_json_index(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, uint32_t count,
                   const char *of, uint32_t *out);

bool zr_json_bool(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, bool *out);
bool zr_json_string(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, const char **out);

/* A copy in the arena, which stays when the text's tree is deleted; "" once the arena has failed. */
const char *zr_json_keep(struct zr_json *json, const char *text);

/* One of the words: *out is its index, below names->count. */
bool zr_json_choice(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                    const struct zr_names *names, int *out);

bool zr_json_vec3(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec3 *out);

bool zr_json_vec4(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec4 *out);

/* Three coordinates, and w = 1; or four. */
bool zr_json_position(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec4 *out);

/* [r,g,b] or [r,g,b,a] of 0..1, or what zr_color_of_text reads; alpha 1 where not given. */
bool zr_json_color(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec4 *out);

/* Four rows of four numbers, or sixteen numbers column by column. */
bool zr_json_mat4(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_mat4 *out);

/* A matrix that keeps points points: its bottom row is 0 0 0 1. */
bool zr_json_affine(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_mat4 *out);

/* Reads each item of a list to out[0], out[1], ... ; `node` must be a list and
 * `out` must have room for it. */
typedef bool (*zr_json_vec4_reader)(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                                    zr_vec4 *out);
bool zr_json_vec4_list(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                       zr_json_vec4_reader read, zr_vec4 *out);
bool zr_json_vec3_list(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec3 *out);

#endif
