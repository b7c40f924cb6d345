/* Reads the distortion of a lens: an object that names its model, or OpenCV's list of coefficients. */
#include "input/scene/json_objects.h"
#include "input/view/view_keys.h"

/* Far beyond any lens; squares and products of them with the powers of a radius stay finite. */
#define COEFFICIENT_MAX 1e6

enum { RADIAL_MAX = 6, FISHEYE_MAX = 4, LIST_MAX = 14 };

/* In the order of enum zr_lens_model, without ZR_LENS_NONE. */
static const char *const models[] = {"opencv", "fisheye"};
static const struct zr_names model_names = ZR_NAMES(2, models);

struct given_lens {
    int model;
    double k[RADIAL_MAX], p[2];
    size_t k_count;
};

/* struct given_lens: k, of which the last ones may be left out. */
static bool read_radial(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct given_lens *given = out;
    const struct zr_json_row row = {0, RADIAL_MAX, path->field->low, path->field->high};
    return zr_json_numbers(json, path, row, given->k, &given->k_count);
}

/* double[2] */
static bool read_tangential(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const struct zr_json_row row = {2, 2, path->field->low, path->field->high};
    return zr_json_numbers(json, path, row, out, NULL);
}

enum { MODEL, K, P };
#define COEFFICIENTS -COEFFICIENT_MAX, COEFFICIENT_MAX
static const struct zr_json_field distortion_fields[] = {
    [MODEL] = {"model", zr_json_choice, offsetof(struct given_lens, model), .words = &model_names,
               .otherwise = "opencv", .text = "opencv: the rational model of Brown and Conrady; or OpenCV's fisheye"},
    [K] = {"k", read_radial, 0, COEFFICIENTS, .otherwise = "[0]", .text = "k1 to k6, of a fisheye k1 to k4",
           .schema = ZR_SCHEMA({"$ref" : "#/$defs/coefficients", "maxItems" : 6})},
    [P] = {"p", read_tangential, offsetof(struct given_lens, p), COEFFICIENTS, .otherwise = "[0,0]",
           .text = "p1 and p2 of the model opencv",
           .schema = ZR_SCHEMA({"$ref" : "#/$defs/coefficients", "minItems" : 2, "maxItems" : 2})}};
/* clang-format off */
const struct zr_json_object zr_json_object_distortion = {
    ZR_JSON_FIELDS("distortion", distortion_fields), .schema = ZR_SCHEMA({
    "dependentSchemas": {
        "model": {
            "if": {"properties": {"model": {"const": "fisheye"}}},
            "then": {"properties": {"k": {"maxItems": 4}, "p": false}}
        }
    }
})};
/* clang-format on */

static bool read_object(struct zr_json *json, const struct zr_json_path *path, struct zr_lens *lens)
{
    struct given_lens given = {.model = 0};
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_distortion, &given, &keys)) return false;
    const bool is_fisheye = given.model + 1 == ZR_LENS_FISHEYE;
    if (is_fisheye && given.k_count > FISHEYE_MAX)
        return zr_json_fault(json, ZR_JSON_KEY(path, distortion_fields[K].key), "%zu numbers; a fisheye has k1 to k4",
                             given.k_count);
    if (is_fisheye && zr_json_gives(keys, P))
        return zr_json_fault(json, ZR_JSON_KEY(path, distortion_fields[P].key), "belongs to the model opencv");
    lens->model = (enum zr_lens_model)(given.model + 1);
    for (int i = 0; i < RADIAL_MAX; i++)
        lens->k[i] = given.k[i];
    lens->p[0] = given.p[0];
    lens->p[1] = given.p[1];
    return true;
}

/* Coefficients after k6 are of a thin prism and a tilted sensor, which are not drawn; calibrations without them have
 * zeros. */
static bool read_list(struct zr_json *json, const struct zr_json_path *path, struct zr_lens *lens)
{
    double c[LIST_MAX] = {0};
    size_t count;
    if (!zr_json_numbers(json, path, (struct zr_json_row){0, LIST_MAX, COEFFICIENTS}, c, &count)) return false;
    if (count != 0 && count != 4 && count != 5 && count != 8 && count != 12 && count != 14)
        return zr_json_fault(json, path, "%zu numbers; OpenCV's lists have 4, 5, 8, 12 or 14", count);
    for (size_t i = 8; i < count; i++)
        if (c[i] != 0.0)
            return zr_json_fault(json, ZR_JSON_ITEM(path, i),
                                 "%.9g is of a thin prism or a tilted sensor: of these, only 0 is supported", c[i]);
    *lens = (struct zr_lens){ZR_LENS_OPENCV, {c[0], c[1], c[4], c[5], c[6], c[7]}, {c[2], c[3]}};
    return true;
}

bool zr_read_distortion(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_lens lens = {.model = ZR_LENS_NONE};
    const bool is_list = zr_json_type(json) == ZR_JSON_LIST;
    if (!is_list && zr_json_type(json) != ZR_JSON_OBJECT)
        return zr_json_expect(json, path, "an object or OpenCV's list of coefficients");
    if (!(is_list ? read_list(json, path, &lens) : read_object(json, path, &lens))) return false;
    *(struct zr_lens *)out = lens;
    return true;
}
