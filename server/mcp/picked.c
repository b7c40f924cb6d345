#include "picked.h"

#include "place.h"
#include "tree.h"

#define NORMAL_ZERO 1e-6 /* up to this, a coordinate of a unit normal is 0 */

static void describe_distance(struct mcp_text *text, const cJSON *distance)
{
    const cJSON *parts = mcp_get(distance, "parts"), *length = mcp_get(distance, "distance");
    mcp_text_put(text, "\n- distance of ");
    mcp_name_put(text, cJSON_GetArrayItem(parts, 0));
    mcp_text_put(text, " and ");
    mcp_name_put(text, cJSON_GetArrayItem(parts, 1));
    if (!cJSON_IsNumber(length)) {
        mcp_text_put(text, ": not known");
        return;
    }
    mcp_text_print(text, ": %.6g", length->valuedouble);
    if (cJSON_IsTrue(mcp_get(distance, "crosses"))) mcp_text_put(text, ", they cross");
    mcp_place_put(text, ", from ", mcp_get(distance, "from"), 6, 0);
    mcp_place_put(text, " to ", mcp_get(distance, "to"), 6, 0);
}

void mcp_picked_describe_surface(struct mcp_text *text, const cJSON *pick)
{
    const cJSON *feature = mcp_get(pick, "feature"), *kind = mcp_get(feature, "kind"),
                *normal = mcp_get(pick, "normal");
    if (cJSON_IsString(kind)) mcp_text_print(text, ", %s", kind->valuestring);
    if (mcp_get(feature, "diameter")) mcp_text_print(text, " of diameter %.5g", mcp_number_of(feature, "diameter"));
    if (cJSON_IsArray(normal)) mcp_place_put(text, ", normal ", normal, 6, NORMAL_ZERO);
}

static void describe_pick(struct mcp_text *text, const cJSON *pick, int number)
{
    const cJSON *pixel = mcp_get(pick, "pixel");
    const int behind = cJSON_GetArraySize(mcp_get(pick, "behind"));
    mcp_text_print(text, "\n- pick %d at pixel (%.0f, %.0f): ", number, mcp_number_at(pixel, 0),
                   mcp_number_at(pixel, 1));
    if (!mcp_get(pick, "point")) {
        mcp_text_put(text, "nothing, the background");
        return;
    }
    mcp_text_put(text, "part ");
    mcp_name_put(text, mcp_get(pick, "part"));
    mcp_text_print(text, ", face %.0f", mcp_number_of(pick, "faceId"));
    mcp_place_put(text, ", point ", mcp_get(pick, "point"), 6, 0);
    mcp_picked_describe_surface(text, pick);
    if (behind > 0) mcp_text_print(text, ", %d surface%s behind", behind, behind == 1 ? "" : "s");
}

void mcp_picked_describe_between(struct mcp_text *text, const cJSON *between)
{
    mcp_text_print(text, "distance %.6g", mcp_number_of(between, "distance"));
    mcp_place_put(text, ", offset ", mcp_get(between, "offset"), 6, 0);
    if (mcp_get(between, "alongNormal"))
        mcp_text_print(text, ", along the first normal %.6g", mcp_number_of(between, "alongNormal"));
    if (mcp_get(between, "angleDegrees"))
        mcp_text_print(text, ", angle of the normals %.6g degrees", mcp_number_of(between, "angleDegrees"));
}

void mcp_picked_describe(struct mcp_text *text, const cJSON *info)
{
    const cJSON *item;
    int number = 0;
    cJSON_ArrayForEach(item, mcp_get(info, "distances")) describe_distance(text, item);
    cJSON_ArrayForEach(item, mcp_get(info, "picks")) describe_pick(text, item, number++);
    cJSON_ArrayForEach(item, mcp_get(info, "between"))
    {
        mcp_text_print(text, "\n- from pick %.0f to %.0f: ", mcp_number_of(item, "from"), mcp_number_of(item, "to"));
        mcp_picked_describe_between(text, item);
    }
}
