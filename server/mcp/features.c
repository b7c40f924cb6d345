#include "features.h"

#include <math.h>

#include "tree.h"

enum { GROUPS_DESCRIBED = 12, PLACES_DESCRIBED = 12, MIRRORS_DESCRIBED = 4, TURNS_DESCRIBED = 4 };

/* Writes a group of holes or bosses: "4 x diameter 3.2, through, 6 deep, along (0, 0, -1), at (1, 2, 6), ...". */
static void describe_group(struct mcp_text *text, const cJSON *group)
{
    const cJSON *through = mcp_get(group, "through"), *axis = mcp_get(group, "axis"), *place, *step;
    int places = 0;
    mcp_text_print(text, "%.0f x diameter %.5g", mcp_number_of(group, "count"), mcp_number_of(group, "diameter"));
    if (through && !cJSON_IsNull(through)) mcp_text_put(text, cJSON_IsTrue(through) ? ", through" : ", blind");
    if (mcp_get(group, "depth"))
        mcp_text_print(text, ", %.5g deep", mcp_number_of(group, "depth"));
    else
        mcp_text_print(text, ", %.5g high", mcp_number_of(group, "height"));
    cJSON_ArrayForEach(step, mcp_get(group, "steps"))
    {
        const double angle = mcp_number_of(step, "angleDegrees");
        mcp_text_print(text, ", %s of diameter %.5g, %.5g deep", angle > 0 ? "countersink" : "step",
                       mcp_number_of(step, "diameter"), mcp_number_of(step, "depth"));
        if (angle > 0) mcp_text_print(text, ", %.4g degrees", angle);
    }
    mcp_text_print(text, ", along (%.4g, %.4g, %.4g)", mcp_number_at(axis, 0), mcp_number_at(axis, 1),
                   mcp_number_at(axis, 2));
    cJSON_ArrayForEach(place, mcp_get(group, "at"))
    {
        if (places < PLACES_DESCRIBED)
            mcp_text_print(text, "%s(%.6g, %.6g, %.6g)", places == 0 ? ", at " : ", ", mcp_number_at(place, 0),
                           mcp_number_at(place, 1), mcp_number_at(place, 2));
        places++;
    }
    if (places > PLACES_DESCRIBED) mcp_text_print(text, " and %d more places", places - PLACES_DESCRIBED);
}

/* Writes the holes and bosses of a part. */
static void describe_round(struct mcp_text *text, const cJSON *features)
{
    static const char *const lists[] = {"holes", "bosses"};
    const cJSON *group;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        int groups = 0;
        cJSON_ArrayForEach(group, mcp_get(features, lists[i]))
        {
            if (groups++ >= GROUPS_DESCRIBED) continue;
            mcp_text_print(text, "%s%s%s", groups == 1 ? "\n  " : "; ", groups == 1 ? lists[i] : "",
                           groups == 1 ? ": " : "");
            describe_group(text, group);
        }
        if (groups > GROUPS_DESCRIBED) mcp_text_print(text, "; %d more groups", groups - GROUPS_DESCRIBED);
    }
}

/* Writes a plane: "x = 0.5", or its normal and offset. */
static void describe_plane(struct mcp_text *text, const cJSON *plane)
{
    const cJSON *normal = mcp_get(plane, "normal");
    for (int axis = 0; axis < 3; axis++) {
        if (fabs(mcp_number_at(normal, axis)) != 1) continue;
        mcp_text_print(text, "%c = %.6g", "xyz"[axis], mcp_number_at(normal, axis) * mcp_number_of(plane, "offset"));
        return;
    }
    mcp_text_print(text, "normal (%.4g, %.4g, %.4g) offset %.6g", mcp_number_at(normal, 0), mcp_number_at(normal, 1),
                   mcp_number_at(normal, 2), mcp_number_of(plane, "offset"));
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
        const cJSON *axis = mcp_get(item, "axis"), *order = mcp_get(item, "order");
        if (turn_count++ >= TURNS_DESCRIBED) continue;
        mcp_text_put(text, turn_count == 1 ? "; turn " : ", ");
        if (cJSON_IsNumber(order))
            mcp_text_print(text, "%.0f-fold", order->valuedouble);
        else
            mcp_text_put(text, "round");
        mcp_text_print(text, " about (%.4g, %.4g, %.4g)", mcp_number_at(axis, 0), mcp_number_at(axis, 1),
                       mcp_number_at(axis, 2));
    }
    const cJSON *at = mcp_get(cJSON_GetArrayItem(turns, 0), "at");
    if (turn_count > TURNS_DESCRIBED) mcp_text_print(text, " and %d more", turn_count - TURNS_DESCRIBED);
    if (turn_count == 0)
        mcp_text_put(text, "; no turn");
    else
        mcp_text_print(text, " at (%.6g, %.6g, %.6g)", mcp_number_at(at, 0), mcp_number_at(at, 1),
                       mcp_number_at(at, 2));
}

static void describe_least_wall(struct mcp_text *text, const cJSON *part)
{
    const cJSON *wall = mcp_get(part, "leastWall"), *at = mcp_get(part, "leastWallAt");
    if (cJSON_IsNumber(wall))
        mcp_text_print(text, "\n  least wall between parallel faces: %.5g at (%.6g, %.6g, %.6g)", wall->valuedouble, mcp_number_at(at, 0),
                       mcp_number_at(at, 1), mcp_number_at(at, 2));
    else if (cJSON_IsTrue(mcp_get(part, "leastWallOmitted")))
        mcp_text_put(text, "\n  least wall between parallel faces: not searched, too much work or memory");
}

/* Writes the number of open loops, and the first, which is the longest. */
static void describe_open_loops(struct mcp_text *text, const cJSON *features)
{
    const cJSON *loops = mcp_get(features, "openLoops"), *first = cJSON_GetArrayItem(loops, 0),
                *center = mcp_get(first, "center");
    const double count = cJSON_GetArraySize(loops) + mcp_number_of(features, "openLoopsOmitted");
    if (!first) return;
    mcp_text_print(text, "\n  open loops: %.0f, %s %.0f edges, length %.5g, around (%.6g, %.6g, %.6g)", count,
                   count > 1 ? "the longest of" : "of", mcp_number_of(first, "edges"), mcp_number_of(first, "length"),
                   mcp_number_at(center, 0), mcp_number_at(center, 1), mcp_number_at(center, 2));
}

void mcp_features_describe(struct mcp_text *text, const cJSON *part)
{
    const cJSON *features = mcp_get(part, "features");
    describe_round(text, features);
    if (features) describe_symmetry(text, mcp_get(features, "symmetry"));
    describe_least_wall(text, part);
    describe_open_loops(text, features);
}
