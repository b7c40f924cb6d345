#include "features.h"

#include <math.h>

#include "place.h"
#include "tree.h"

enum { GROUPS_DESCRIBED = 12, PLANES_DESCRIBED = 6, PLACES_DESCRIBED = 12, MIRRORS_DESCRIBED = 4, TURNS_DESCRIBED = 4 };

/* A round hole of a mesh is a polygon. A width across its flats below this share of the diameter has its words. */
#define FLATS_SHARE 0.99

/* Writes how the holes of a group are arranged. */
static void describe_pattern(struct mcp_text *text, const cJSON *pattern)
{
    const cJSON *counts = mcp_get(pattern, "counts"), *pitch = mcp_get(pattern, "pitch");
    if (!pattern) return;
    if (counts && mcp_number_at(counts, 1) == 1)
        mcp_text_print(text, ", in a row of %.0f, pitch %.5g", mcp_number_at(counts, 0), mcp_number_at(pitch, 0));
    else if (counts)
        mcp_text_print(text, ", in a grid of %.0f x %.0f, pitch %.5g x %.5g", mcp_number_at(counts, 0),
                       mcp_number_at(counts, 1), mcp_number_at(pitch, 0), mcp_number_at(pitch, 1));
    else
        mcp_text_print(text, ", in a circle of diameter %.5g", mcp_number_of(pattern, "diameter"));
    mcp_place_put(text, " around ", mcp_get(pattern, "center"), MCP_PLACE_DIGITS, 0);
}

void mcp_features_describe_steps(struct mcp_text *text, const cJSON *steps)
{
    const cJSON *step;
    cJSON_ArrayForEach(step, steps)
    {
        const double angle = mcp_number_of(step, "angleDegrees");
        mcp_text_print(text, ", %s of diameter %.5g, %.5g deep", angle > 0 ? "countersink" : "step",
                       mcp_number_of(step, "diameter"), mcp_number_of(step, "depth"));
        if (angle > 0) mcp_text_print(text, ", %.4g degrees", angle);
    }
}

/* Writes a group of holes or bosses: "4 x diameter 3.2, through, 6 deep, along (0, 0, -1), at (1, 2, 6), ...". */
static void describe_group(struct mcp_text *text, const cJSON *group)
{
    const double diameter = mcp_number_of(group, "diameter"), flats = mcp_number_of(group, "acrossFlats");
    const cJSON *through = mcp_get(group, "through"), *place;
    int places = 0;
    mcp_text_print(text, "%.0f x diameter %.5g", mcp_number_of(group, "count"), diameter);
    if (flats < FLATS_SHARE * diameter)
        mcp_text_print(text, " (%.5g across its %.0f flats)", flats, mcp_number_of(group, "segments"));
    if (through)
        mcp_text_put(text, cJSON_IsNull(through)   ? ", not known if through"
                           : cJSON_IsTrue(through) ? ", through"
                                                   : ", blind");
    if (mcp_get(group, "depth"))
        mcp_text_print(text, ", %.5g deep", mcp_number_of(group, "depth"));
    else
        mcp_text_print(text, ", %.5g high", mcp_number_of(group, "height"));
    mcp_features_describe_steps(text, mcp_get(group, "steps"));
    mcp_place_put(text, ", along ", mcp_get(group, "axis"), MCP_DIRECTION_DIGITS, 0);
    describe_pattern(text, mcp_get(group, "pattern"));
    cJSON_ArrayForEach(place, mcp_get(group, "at"))
    {
        if (places < PLACES_DESCRIBED) mcp_place_put(text, places == 0 ? ", at " : ", ", place, MCP_PLACE_DIGITS, 0);
        places++;
    }
    if (places > PLACES_DESCRIBED) mcp_text_print(text, " and %d more places", places - PLACES_DESCRIBED);
}

/* Writes a plane: "x = 0.5", or its normal and offset. */
static void describe_plane(struct mcp_text *text, const cJSON *plane)
{
    const cJSON *normal = mcp_get(plane, "normal");
    for (int axis = 0; axis < 3; axis++) {
        if (fabs(mcp_number_at(normal, axis)) != 1) continue;
        mcp_text_print(text, "%c = %.*g", "xyz"[axis], MCP_PLACE_DIGITS + text->more_digits,
                       mcp_number_at(normal, axis) * mcp_number_of(plane, "offset") + 0.0);
        return;
    }
    mcp_place_put(text, "normal ", normal, MCP_DIRECTION_DIGITS, 0);
    mcp_text_print(text, " offset %.*g", MCP_PLACE_DIGITS + text->more_digits, mcp_number_of(plane, "offset"));
}

static void describe_radius(struct mcp_text *text, const cJSON *group)
{
    mcp_text_print(text, "%.0f x radius %.5g", mcp_number_of(group, "count"), mcp_number_of(group, "radius"));
}

static void describe_face(struct mcp_text *text, const cJSON *plane)
{
    mcp_text_print(text, "%.5g at ", mcp_number_of(plane, "area"));
    describe_plane(text, plane);
}

/* A list of features has a line of up to `most` items, or the words for none. */
static const struct list {
    const char *key, *title;
    void (*describe)(struct mcp_text *text, const cJSON *item);
    int most;
    const char *none;
} lists[] = {{"holes", "holes", describe_group, GROUPS_DESCRIBED, "no round one was found"},
             {"bosses", "bosses", describe_group, GROUPS_DESCRIBED, NULL},
             {"fillets", "fillets", describe_radius, GROUPS_DESCRIBED, NULL},
             {"rounds", "rounds", describe_radius, GROUPS_DESCRIBED, NULL},
             {"planes", "flat faces by area", describe_face, PLANES_DESCRIBED, NULL}};

static void describe_list(struct mcp_text *text, const struct list *list, const cJSON *items)
{
    const cJSON *item;
    const int count = cJSON_GetArraySize(items);
    double more = 0;
    int listed = 0;
    if (!items || (count == 0 && !list->none)) return;
    mcp_text_print(text, "\n  %s: %s", list->title, count == 0 ? list->none : "");
    cJSON_ArrayForEach(item, items)
    {
        if (listed++ >= list->most) {
            more += mcp_get(item, "count") ? mcp_number_of(item, "count") : 1;
            continue;
        }
        if (listed > 1) mcp_text_put(text, "; ");
        list->describe(text, item);
    }
    if (more > 0) mcp_text_print(text, "; and %.0f more", more);
}

static void describe_symmetry(struct mcp_text *text, const cJSON *symmetry)
{
    const cJSON *mirrors = mcp_get(symmetry, "mirror"), *turns = mcp_get(symmetry, "turn"), *item;
    int mirror_count = 0, turn_count = 0;
    mcp_text_put(text, "\n  symmetry: ");
    if (!symmetry) {
        mcp_text_put(text, "not searched, too much work or memory");
        return;
    }
    cJSON_ArrayForEach(item, mirrors)
    {
        if (mirror_count++ >= MIRRORS_DESCRIBED) continue;
        mcp_text_put(text, mirror_count == 1 ? "mirror " : ", ");
        describe_plane(text, item);
    }
    if (mirror_count > MIRRORS_DESCRIBED) mcp_text_print(text, " and %d more", mirror_count - MIRRORS_DESCRIBED);
    if (mirror_count == 0) mcp_text_put(text, "no mirror");
    cJSON_ArrayForEach(item, turns)
    {
        const cJSON *order = mcp_get(item, "order");
        if (turn_count++ >= TURNS_DESCRIBED) continue;
        mcp_text_put(text, turn_count == 1 ? "; turn " : ", ");
        if (cJSON_IsNumber(order))
            mcp_text_print(text, "%.0f-fold", order->valuedouble);
        else
            mcp_text_put(text, "round");
        mcp_place_put(text, " about ", mcp_get(item, "axis"), MCP_DIRECTION_DIGITS, 0);
    }
    if (turn_count > TURNS_DESCRIBED) mcp_text_print(text, " and %d more", turn_count - TURNS_DESCRIBED);
    if (turn_count == 0)
        mcp_text_put(text, "; no turn");
    else
        mcp_place_put(text, " at ", mcp_get(cJSON_GetArrayItem(turns, 0), "at"), MCP_PLACE_DIGITS, 0);
}

/* Writes the smallest cylinder that holds the part, such as the diameter of a gear over its teeth. */
static void describe_cylinder(struct mcp_text *text, const cJSON *cylinder)
{
    if (!cylinder) return;
    mcp_text_print(text, "\n  bounding cylinder: diameter %.6g, %.6g high", mcp_number_of(cylinder, "diameter"),
                   mcp_number_of(cylinder, "height"));
    mcp_place_put(text, ", along ", mcp_get(cylinder, "axis"), MCP_DIRECTION_DIGITS, 0);
}

static void describe_least_wall(struct mcp_text *text, const cJSON *part)
{
    const cJSON *wall = mcp_get(part, "leastWall");
    if (cJSON_IsNumber(wall)) {
        mcp_text_print(text, "\n  least wall between parallel faces: %.5g", wall->valuedouble);
        mcp_place_put(text, " at ", mcp_get(part, "leastWallAt"), MCP_PLACE_DIGITS, 0);
    } else if (cJSON_IsTrue(mcp_get(part, "leastWallOmitted")))
        mcp_text_put(text, "\n  least wall between parallel faces: not searched, too much work or memory");
}

/* Writes the number of open loops, and the first, which is the longest. */
static void describe_open_loops(struct mcp_text *text, const cJSON *features)
{
    const cJSON *loops = mcp_get(features, "openLoops"), *first = cJSON_GetArrayItem(loops, 0);
    const double count = cJSON_GetArraySize(loops) + mcp_number_of(features, "openLoopsOmitted");
    if (!first) return;
    mcp_text_print(text, "\n  open loops: %.0f, %s %.0f edges, length %.5g", count, count > 1 ? "the longest of" : "of",
                   mcp_number_of(first, "edges"), mcp_number_of(first, "length"));
    mcp_place_put(text, ", around ", mcp_get(first, "center"), MCP_PLACE_DIGITS, 0);
}

void mcp_features_describe(struct mcp_text *text, const cJSON *part)
{
    const cJSON *features = mcp_get(part, "features");
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        describe_list(text, &lists[i], mcp_get(features, lists[i].key));
    if (mcp_get(features, "handles"))
        mcp_text_print(text, "\n  tunnels, round or not: %.0f", mcp_number_of(features, "handles"));
    describe_cylinder(text, mcp_get(features, "boundingCylinder"));
    if (features && mcp_number_of(part, "area") > 0) describe_symmetry(text, mcp_get(features, "symmetry"));
    describe_least_wall(text, part);
    if (mcp_get(part, "capArea")) mcp_text_print(text, "\n  area of the section: %.6g", mcp_number_of(part, "capArea"));
    describe_open_loops(text, features);
}
