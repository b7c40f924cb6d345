#include "facts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "features.h"
#include "picked.h"
#include "place.h"
#include "tree.h"

enum { PARTS_MAX = 50, PARTS_DESCRIBED = 12, SHELL_KINDS = 3, NAME_MAX_BYTES = 80, WARNING_MAX_BYTES = 1000 };

/* A coordinate of a centre of mass up to this share of the cube's side is 0. */
#define CENTER_ZERO 1e-5

static const char *const SHELLS[SHELL_KINDS] = {"outward", "inward", "open"};

/* Returns a number of a float's digits. */
static cJSON *make_number(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.7g", value);
    return cJSON_CreateNumber(strtod(text, NULL));
}

static void copy(cJSON *to, const cJSON *from, const char *name)
{
    const cJSON *item = mcp_get(from, name);
    if (item) mcp_add(to, name, cJSON_Duplicate(item, true));
}

/* ---- the model ---- */

static cJSON *make_box(const cJSON *bounds)
{
    double size[3];
    const cJSON *min = mcp_get(bounds, "min"), *max = mcp_get(bounds, "max");
    if (!min || !max) return cJSON_CreateNull();
    cJSON *box = cJSON_CreateObject();
    for (int i = 0; i < 3; i++)
        size[i] = mcp_number_at(max, i) - mcp_number_at(min, i);
    mcp_add(box, "min", cJSON_Duplicate(min, true));
    mcp_add(box, "max", cJSON_Duplicate(max, true));
    cJSON *list = cJSON_AddArrayToObject(box, "size");
    for (int i = 0; i < 3; i++)
        mcp_append(list, make_number(size[i]));
    return box;
}

static cJSON *make_part(const cJSON *part)
{
    static const char *const keys[] = {"name",         "id",          "hidden",           "triangles", "area",
                                       "volume",       "volumeError", "closed",           "shells",    "openEdges",
                                       "flippedEdges", "leastWall",   "centerOfMass",     "color",     "pixels",
                                       "features",     "leastWallAt", "leastWallOmitted", "capArea"};
    cJSON *made = cJSON_CreateObject();
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        copy(made, part, keys[i]);
    mcp_add(made, "box", make_box(mcp_get(part, "box")));
    return made;
}

void mcp_facts_add_unit(cJSON *content, const cJSON *info)
{
    const cJSON *unit = mcp_get(info, "unit");
    mcp_add(content, "units", unit ? cJSON_Duplicate(unit, true) : cJSON_CreateNull());
}

/* Adds how many parts were not searched for holes, and why the first of them. */
static void add_unsearched(cJSON *content, const cJSON *parts)
{
    const cJSON *part, *reason = NULL;
    int count = 0;
    cJSON_ArrayForEach(part, parts)
    {
        const cJSON *features = mcp_get(part, "features"), *why = mcp_get(features, "omittedReason");
        if (!cJSON_IsTrue(mcp_get(features, "omitted")) || !cJSON_IsString(why)) continue;
        if (count++ == 0) reason = why;
    }
    if (count == 0) return;
    cJSON *made = cJSON_AddObjectToObject(content, "holesNotSearched");
    cJSON_AddNumberToObject(made, "parts", count);
    cJSON_AddStringToObject(made, "reason", reason->valuestring);
}

/* Replaces the sums over the operands by the values of the solid. */
static void add_combined(cJSON *content, const cJSON *info)
{
    static const char *const own[] = {"volume", "volumeError", "centerOfMass"}, *const unknown[] = {"area", "shells"};
    const cJSON *csg = mcp_get(info, "csg");
    if (!csg) return;
    copy(content, info, "csg");
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        cJSON_DeleteItemFromObjectCaseSensitive(content, own[i]);
        copy(content, csg, own[i]);
    }
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        cJSON_DeleteItemFromObjectCaseSensitive(content, unknown[i]);
        cJSON_AddNullToObject(content, unknown[i]);
    }
}

/* Adds the centre of mass of the parts that are shown, which are closed. Parts that are inside out beside others have
 * none in common. */
static void add_center(cJSON *content, const cJSON *parts, double volume)
{
    const cJSON *part;
    double moment[3] = {0};
    cJSON_ArrayForEach(part, parts)
    {
        const cJSON *center = mcp_get(part, "centerOfMass");
        if (cJSON_IsTrue(mcp_get(part, "hidden"))) continue;
        if (!cJSON_IsArray(center) || mcp_number_of(part, "volume") * volume < 0) return;
        for (int i = 0; i < 3; i++)
            moment[i] += mcp_number_of(part, "volume") * mcp_number_at(center, i);
    }
    if (volume == 0) return;
    cJSON *list = cJSON_AddArrayToObject(content, "centerOfMass");
    for (int i = 0; i < 3; i++)
        mcp_append(list, cJSON_CreateNumber(moment[i] / volume));
}

void mcp_facts_add(cJSON *content, const cJSON *info)
{
    const cJSON *parts = mcp_get(info, "parts"), *part;
    static const char *const given[] = {"distances", "picks", "between"};
    const double omitted = mcp_number_of(info, "partsOmitted");
    double area = 0, volume = 0, error = 0, shells[SHELL_KINDS] = {0};
    bool is_closed = true; /* as far as the parts are listed */
    double hidden = 0;
    mcp_facts_add_unit(content, info);
    mcp_add(content, "box", make_box(mcp_get(info, "bounds")));
    cJSON *list = cJSON_CreateArray();
    cJSON_ArrayForEach(part, parts)
    {
        if (cJSON_GetArraySize(list) < PARTS_MAX) mcp_append(list, make_part(part));
        if (cJSON_IsTrue(mcp_get(part, "hidden"))) {
            hidden++;
            continue;
        }
        area += mcp_number_of(part, "area");
        volume += mcp_number_of(part, "volume");
        error += mcp_number_of(part, "volumeError");
        is_closed = is_closed && cJSON_IsTrue(mcp_get(part, "closed"));
        for (int i = 0; i < SHELL_KINDS; i++)
            shells[i] += mcp_number_of(mcp_get(part, "shells"), SHELLS[i]);
    }
    is_closed = is_closed && cJSON_GetArraySize(parts) > hidden;
    if (hidden > 0) cJSON_AddNumberToObject(content, "partsHidden", hidden);
    copy(content, info, "explode");
    copy(content, info, "origin");
    mcp_add(content, "volume", is_closed && omitted == 0 ? cJSON_CreateNumber(volume) : cJSON_CreateNull());
    if (is_closed && omitted == 0 && error > 0) cJSON_AddNumberToObject(content, "volumeError", error);
    if (is_closed && omitted == 0) add_center(content, parts, volume);
    mcp_add(content, "area", omitted == 0 ? cJSON_CreateNumber(area) : cJSON_CreateNull());
    mcp_add(content, "closed", is_closed && omitted > 0 ? cJSON_CreateNull() : cJSON_CreateBool(is_closed));
    cJSON *sum = omitted == 0 ? cJSON_AddObjectToObject(content, "shells") : cJSON_AddNullToObject(content, "shells");
    for (int i = 0; i < SHELL_KINDS && omitted == 0; i++)
        cJSON_AddNumberToObject(sum, SHELLS[i], shells[i]);
    const double more = omitted + cJSON_GetArraySize(parts) - cJSON_GetArraySize(list);
    add_combined(content, info);
    add_unsearched(content, parts);
    mcp_add(content, "parts", list);
    for (size_t i = 0; i < sizeof given / sizeof *given; i++)
        copy(content, info, given[i]);
    if (more > 0) cJSON_AddNumberToObject(content, "partsOmitted", more);
}

/* ---- views ---- */

/* Rounds to three digits after the point. */
static double rounded(double value)
{
    return round(value * 1e3) / 1e3;
}

static cJSON *make_vector(double x, double y, double z)
{
    const double values[] = {x, y, z};
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < 3; i++)
        mcp_append(list, cJSON_CreateNumber(values[i] == 0 ? 0 : round(values[i] * 1e4) / 1e4));
    return list;
}

/* Adds a view by its matrices. `pixels`: width of the view in the picture. */
static void add_view(cJSON *views, const cJSON *camera, const char *name, unsigned number, double pixels,
                     const cJSON *box)
{
    const cJSON *pose = mcp_get(camera, "worldToCamera"), *projection = mcp_get(camera, "projectionMatrix");
    cJSON *view = cJSON_CreateObject();
    const bool is_parallel = mcp_number_at(projection, 15) == 1 && mcp_number_at(projection, 0) != 0;
    cJSON_AddStringToObject(view, "name", *name ? name : "view");
    cJSON_AddNumberToObject(view, "image", number);
    if (box) mcp_add(view, "box", cJSON_Duplicate(box, true));
    copy(view, camera, "azimuthDegrees");
    copy(view, camera, "elevationDegrees");
    mcp_add(view, "looksAlong",
            make_vector(-mcp_number_at(pose, 2), -mcp_number_at(pose, 6), -mcp_number_at(pose, 10)));
    cJSON_AddStringToObject(view, "projection", is_parallel ? "orthographic" : "perspective");
    mcp_add(view, "unitsPerPixel",
            is_parallel ? make_number(2 / fabs(mcp_number_at(projection, 0) * pixels)) : cJSON_CreateNull());
    copy(view, camera, "eye");
    copy(view, camera, "coveredShare");
    if (mcp_get(camera, "coveredShare"))
        cJSON_AddBoolToObject(view, "blank", mcp_number_of(camera, "coveredShare") == 0);
    mcp_append(views, view);
}

void mcp_facts_add_views(cJSON *views, const struct mcp_shot *shot, unsigned number, bool is_sheet)
{
    const cJSON *sheet = mcp_get(shot->info, "sheet"), *cell;
    if (is_sheet && cJSON_IsArray(sheet)) {
        cJSON_ArrayForEach(cell, sheet)
        {
            const cJSON *name = mcp_get(cell, "name"), *box = mcp_get(cell, "box");
            add_view(views, cell, cJSON_IsString(name) ? name->valuestring : "", number,
                     mcp_number_at(box, 2) - mcp_number_at(box, 0), box);
        }
        return;
    }
    const int before = cJSON_GetArraySize(views);
    add_view(views, mcp_get(shot->info, "camera"), shot->name, number,
             mcp_number_of(mcp_get(shot->info, "window"), "width"), NULL);
    cJSON *view = cJSON_GetArrayItem(views, before);
    const cJSON *picture = mcp_get(shot->info, "picture");
    copy(view, picture, "coveredShare");
    copy(view, picture, "touchesBorder");
    copy(view, picture, "blank");
}

/* Copies a warning. Returns NULL for that of a blank first view of a sheet: each view has a key for it, `blank`. */
static cJSON *copy_warning(const cJSON *warning, bool is_sheet)
{
    static const char blank[] = "nothing is visible";
    if (!cJSON_IsString(warning)) return NULL;
    if (is_sheet && strncmp(warning->valuestring, blank, sizeof blank - 1) == 0) return NULL;
    return cJSON_Duplicate(warning, true);
}

void mcp_facts_add_warnings(cJSON *warnings, const cJSON *info)
{
    const bool is_sheet = mcp_get(info, "sheet");
    const cJSON *warning, *there;
    cJSON_ArrayForEach(warning, mcp_get(info, "warnings"))
    {
        cJSON *made = copy_warning(warning, is_sheet);
        bool is_there = !made;
        cJSON_ArrayForEach(there, warnings) is_there |= made && strcmp(there->valuestring, made->valuestring) == 0;
        if (is_there)
            cJSON_Delete(made);
        else
            mcp_append(warnings, made);
    }
}

/* ---- in words ---- */

const char *mcp_facts_unit(const cJSON *content)
{
    static const char *const units[][2] = {{"millimetre", "mm"}, {"micron", "um"}, {"centimetre", "cm"},
                                           {"metre", "m"},       {"inch", "in"},   {"foot", "ft"}};
    const cJSON *unit = mcp_get(content, "units");
    for (size_t i = 0; cJSON_IsString(unit) && i < sizeof units / sizeof *units; i++)
        if (strcmp(unit->valuestring, units[i][0]) == 0) return units[i][1];
    return "units";
}

static void describe_box(struct mcp_text *text, const cJSON *box, const char *unit)
{
    const cJSON *min = mcp_get(box, "min"), *max = mcp_get(box, "max"), *size = mcp_get(box, "size");
    const int digits = MCP_PLACE_DIGITS + text->more_digits;
    if (!min) {
        mcp_text_put(text, "no box");
        return;
    }
    mcp_text_print(text, "box %.6g x %.6g x %.6g %s", mcp_number_at(size, 0), mcp_number_at(size, 1),
                   mcp_number_at(size, 2), unit);
    for (int i = 0; i < 3; i++)
        mcp_text_print(text, "%s%c %.*g..%.*g", i == 0 ? " (" : ", ", "xyz"[i], digits, mcp_number_at(min, i), digits,
                       mcp_number_at(max, i));
    mcp_text_put(text, ")");
}

/* Writes the number of shells of each kind. A single shell is left out: it is closed or open as the part is. */
static void describe_shells(struct mcp_text *text, const cJSON *shells)
{
    static const char *const words[SHELL_KINDS][2] = {
        {"closed shell", "closed shells"},
        {"inward shell (a void, or inside out)", "inward shells (voids, or inside out)"},
        {"open shell", "open shells"}};
    const double outward = mcp_number_of(shells, SHELLS[0]), inward = mcp_number_of(shells, SHELLS[1]);
    const char *between = "; ";
    if (inward == 0 && outward + mcp_number_of(shells, SHELLS[2]) <= 1) return;
    for (int i = 0; i < SHELL_KINDS; i++) {
        const double count = mcp_number_of(shells, SHELLS[i]);
        if (count == 0) continue;
        mcp_text_print(text, "%s%.0f %s", between, count, words[i][count > 1]);
        between = ", ";
    }
}

/* Writes volume and centre of mass. */
static void describe_volume(struct mcp_text *text, const char *before, const cJSON *solid, const char *unit)
{
    const double error = mcp_number_of(solid, "volumeError"), volume = mcp_number_of(solid, "volume");
    const cJSON *center = mcp_get(solid, "centerOfMass");
    mcp_text_print(text, "%svolume %.6g", before, volume);
    if (error > 0) mcp_text_print(text, " +- %.2g", error);
    mcp_text_print(text, " %s^3", unit);
    if (cJSON_IsArray(center)) mcp_place_put(text, ", centre of mass ", center, 6, CENTER_ZERO * cbrt(fabs(volume)));
}

/* Writes what keeps a part from being closed. */
static void describe_open(struct mcp_text *text, const cJSON *part)
{
    static const char *const kinds[][2] = {{"openEdges", "open"}, {"flippedEdges", "flipped"}};
    const char *between = ":";
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const cJSON *edges = mcp_get(part, kinds[i][0]);
        const double count = mcp_number_of(edges, "count");
        if (count == 0) continue;
        mcp_text_print(text, "%s %.0f %s edge%s", between, count, kinds[i][1], count == 1 ? "" : "s");
        mcp_place_put(text, ", one at ", mcp_get(edges, "at"), 6, 0);
        between = ",";
    }
}

/* Returns true if parts differ in colour. */
static bool have_colors(const cJSON *parts)
{
    const cJSON *part, *first = mcp_get(cJSON_GetArrayItem(parts, 0), "color");
    cJSON_ArrayForEach(part, parts) if (!cJSON_Compare(mcp_get(part, "color"), first, true)) return true;
    return false;
}

static void describe_triangles(struct mcp_text *text, const cJSON *part)
{
    const double triangles = mcp_number_of(part, "triangles");
    mcp_text_print(text, ", %.0f triangle%s", triangles, triangles == 1 ? "" : "s");
}

static void describe_part(struct mcp_text *text, const cJSON *part, const char *unit, bool has_color)
{
    const cJSON *volume = mcp_get(part, "volume");
    mcp_text_print(text, "\n- part %.0f ", mcp_number_of(part, "id"));
    mcp_name_put(text, mcp_get(part, "name"));
    mcp_text_put(text, ": ");
    if (cJSON_IsTrue(mcp_get(part, "hidden"))) mcp_text_put(text, "hidden, ");
    describe_box(text, mcp_get(part, "box"), unit);
    describe_triangles(text, part);
    mcp_text_print(text, ", area %.6g %s^2", mcp_number_of(part, "area"), unit);
    if (cJSON_IsNumber(volume))
        describe_volume(text, ", closed, ", part, unit);
    else {
        mcp_text_put(text, ", not closed");
        describe_open(text, part);
    }
    describe_shells(text, mcp_get(part, "shells"));
    if (has_color && mcp_get(part, "color")) mcp_text_print(text, ", color %s", mcp_get(part, "color")->valuestring);
    mcp_features_describe(text, part);
}

static void describe_unsearched(struct mcp_text *text, const cJSON *unsearched)
{
    const double count = mcp_number_of(unsearched, "parts");
    if (!unsearched) return;
    mcp_text_print(text, "\nholes were not searched in %.0f part%s: %s", count, count == 1 ? "" : "s",
                   mcp_get(unsearched, "reason")->valuestring);
}

void mcp_facts_describe(struct mcp_text *text, const cJSON *content)
{
    const char *unit = mcp_facts_unit(content);
    const cJSON *volume = mcp_get(content, "volume"), *area = mcp_get(content, "area"),
                *parts = mcp_get(content, "parts"), *part, *warning;
    int described = 0;
    mcp_place_set_digits(text, mcp_get(content, "box"));
    describe_box(text, mcp_get(content, "box"), unit);
    if (cJSON_IsNumber(area)) mcp_text_print(text, "; area %.6g %s^2", area->valuedouble, unit);
    const bool is_combined = mcp_get(content, "csg");
    if (cJSON_IsNumber(volume))
        describe_volume(text, is_combined ? "; solid combined by csg: " : "; closed, ", content, unit);
    else if (cJSON_IsNull(mcp_get(content, "closed")))
        mcp_text_put(text, "; area, volume and closedness are not known: more than 1000 parts");
    else
        mcp_text_put(text, "; not closed, so there is no volume");
    if (cJSON_GetArraySize(parts) == 1 && cJSON_IsFalse(mcp_get(content, "closed")))
        describe_open(text, cJSON_GetArrayItem(parts, 0));
    if (is_combined)
        mcp_text_put(text, "; the box may be larger; the parts listed are its operands, before they are combined");
    describe_shells(text, mcp_get(content, "shells"));
    const int count = cJSON_GetArraySize(parts) + (int)mcp_number_of(content, "partsOmitted");
    mcp_text_print(text, "; %d part%s", count, count == 1 ? "" : "s");
    const double hidden = mcp_number_of(content, "partsHidden");
    if (count == 1) describe_triangles(text, cJSON_GetArrayItem(parts, 0));
    if (hidden > 0)
        mcp_text_print(text, ", %.0f of them hidden: box and sums are of the others", hidden);
    else if (count > 1 && cJSON_IsNumber(volume) && !is_combined)
        mcp_text_put(text, ", whose areas and volumes are summed");
    if (mcp_get(content, "explode")) mcp_text_put(text, "; exploded: boxes and places are of the moved parts");
    const cJSON *origin = mcp_get(content, "origin");
    mcp_place_put(text, "; places are relative to the origin ", origin, 10, 0);
    if (origin) mcp_text_put(text, " of the file");
    if (strcmp(unit, "units") == 0) mcp_text_put(text, "; the format names no unit");
    const bool has_colors = have_colors(parts);
    if (count == 1) mcp_features_describe(text, cJSON_GetArrayItem(parts, 0));
    cJSON_ArrayForEach(part, parts)
    {
        if (count > 1 && described++ < PARTS_DESCRIBED) describe_part(text, part, unit, has_colors);
    }
    if (count > PARTS_DESCRIBED) mcp_text_print(text, "\n- and %d more parts", count - PARTS_DESCRIBED);
    describe_unsearched(text, mcp_get(content, "holesNotSearched"));
    mcp_picked_describe(text, content);
    cJSON_ArrayForEach(warning, mcp_get(content, "warnings"))
    {
        mcp_text_put(text, "\nwarning: ");
        mcp_text_line(text, warning->valuestring, WARNING_MAX_BYTES);
    }
}

/* Writes where a camera stands: "from the front-right and above". */
static void describe_side(struct mcp_text *text, const cJSON *view)
{
    static const char *const sides[] = {"front", "front-right", "right", "back-right",
                                        "back",  "back-left",   "left",  "front-left"};
    const cJSON *azimuth = mcp_get(view, "azimuthDegrees");
    const double elevation = mcp_number_of(view, "elevationDegrees");
    if (!azimuth) return;
    const int eighth = (int)floor(azimuth->valuedouble / 45 + 0.5);
    if (fabs(elevation) >= 89)
        mcp_text_print(text, ", seen from %s", elevation > 0 ? "above" : "below");
    else
        mcp_text_print(text, ", seen from the %s%s", sides[(eighth % 8 + 8) % 8],
                       elevation >= 10    ? " and above"
                       : elevation <= -10 ? " and below"
                                          : "");
    mcp_text_print(text, " (azimuth %.4g, elevation %.4g degrees)", azimuth->valuedouble, elevation);
}

static void describe_view(struct mcp_text *text, const cJSON *content, const cJSON *view)
{
    const cJSON *along = mcp_get(view, "looksAlong"), *scale = mcp_get(view, "unitsPerPixel"),
                *eye = mcp_get(view, "eye"), *covered = mcp_get(view, "coveredShare");
    mcp_text_line(text, mcp_get(view, "name")->valuestring, NAME_MAX_BYTES);
    describe_side(text, view);
    mcp_place_put(text, ", looks along ", along, 4, 0);
    if (cJSON_IsNumber(scale))
        mcp_text_print(text, ", %.5g %s per pixel", scale->valuedouble, mcp_facts_unit(content));
    else if (eye)
        mcp_place_put(text, ", perspective from ", eye, 5, 0);
    else
        mcp_text_put(text, ", perspective");
    if (cJSON_IsTrue(mcp_get(view, "blank"))) mcp_text_put(text, ", BLANK: nothing is visible");
    if (covered) mcp_text_print(text, ", %.3g %% covered", rounded(100 * covered->valuedouble));
    if (cJSON_IsTrue(mcp_get(view, "touchesBorder"))) mcp_text_put(text, ", cut off by the border");
}

void mcp_facts_describe_shot(struct mcp_text *text, const cJSON *content, const struct mcp_shot *shot, unsigned number)
{
    const cJSON *view;
    const cJSON *up = mcp_get(mcp_get(shot->info, "up"), "axis");
    mcp_text_print(text, "Image %u, %u x %u pixels, ", number, shot->width, shot->height);
    if (cJSON_IsString(up)) mcp_text_print(text, "%s is up, ", up->valuestring);
    describe_box(text, mcp_get(content, "box"), mcp_facts_unit(content));
    cJSON_ArrayForEach(view, mcp_get(content, "views"))
    {
        const cJSON *box = mcp_get(view, "box");
        if ((unsigned)mcp_number_of(view, "image") != number) continue;
        mcp_text_put(text, "\n- ");
        if (box)
            mcp_text_print(text, "pixels x %.0f..%.0f, y %.0f..%.0f: ", mcp_number_at(box, 0), mcp_number_at(box, 2),
                           mcp_number_at(box, 1), mcp_number_at(box, 3));
        describe_view(text, content, view);
    }
}
