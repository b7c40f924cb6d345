#include "shots.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "faults.h"
#include "scene/encodings.h"
#include "tree.h"
#include "unzip.h"

/* PNG_PIXELS: pictures of more pixels together rarely fit as PNG: 0.43 bytes per pixel are usual. */
enum { PNG_PIXELS = 1250000, SMALLER_MAX = 4 };

void mcp_shots_free(const struct mcp_host *host, struct mcp_shots *shots)
{
    for (unsigned i = 0; i < shots->count; i++)
        cJSON_Delete(shots->at[i].info);
    cJSON_Delete(shots->fragments);
    shots->fragments = NULL;
    if (shots->has_drawn) host->release(host->context, &shots->drawn);
    shots->count = 0;
    shots->has_drawn = false;
}

/* ---- files of an answer ---- */

/* Returns the shot of this view; a new one if it has none. */
static struct mcp_shot *shot_of(struct mcp_shots *shots, const char *name, size_t length)
{
    if (length >= sizeof shots->at->name) return NULL;
    for (unsigned i = 0; i < shots->count; i++)
        if (strlen(shots->at[i].name) == length && memcmp(shots->at[i].name, name, length) == 0) return &shots->at[i];
    if (shots->count == MCP_IMAGES_MAX) return NULL;
    struct mcp_shot *shot = &shots->at[shots->count++];
    *shot = (struct mcp_shot){.name = ""};
    memcpy(shot->name, name, length);
    return shot;
}

/* Takes the file "front.info.json", "front.color.png" or "info.json". */
static bool take_file(struct mcp_shots *shots, const char *name, const void *bytes, size_t size)
{
    const char *dot = strrchr(name, '.'), *channel = dot;
    while (channel > name && channel[-1] != '.')
        channel--;
    if (!dot) return false;
    struct mcp_shot *shot = shot_of(shots, name, channel > name ? (size_t)(channel - name) - 1 : 0);
    if (!shot) return false;
    if (strcmp(dot, ".json") == 0) {
        cJSON **place = strncmp(channel, "info", 4) == 0 ? &shot->info : &shots->fragments;
        cJSON_Delete(*place);
        *place = cJSON_ParseWithLength(bytes, size);
        return *place;
    }
    for (int i = 0; i < ZR_ENCODING_COUNT; i++)
        if (zr_encoding_has((enum zr_encoding)i, ZR_ENCODING_FOR_AGENTS) &&
            strcmp(dot + 1, zr_encoding_rows[i].ending) == 0) {
            shot->image = bytes;
            shot->size = size;
            shot->type = zr_encoding_rows[i].type;
        }
    return shot->image;
}

static bool take_files(struct mcp_shots *shots)
{
    const struct mcp_drawn *drawn = &shots->drawn;
    struct unzip unzip = {drawn->bytes, (const unsigned char *)drawn->bytes + drawn->size};
    struct unzip_file file;
    if (!drawn->is_zip) return take_file(shots, "info.json", drawn->bytes, drawn->size);
    while (unzip_next(&unzip, &file))
        if (!take_file(shots, file.name, file.data, file.size)) return false;
    return unzip.at && shots->count > 0;
}

enum mcp_draw_status mcp_shots_draw_once(struct mcp_job *job, const struct mcp_picture *picture,
                                         struct mcp_shots *shots)
{
    const struct mcp_host *host = job->host;
    struct mcp_draw draw;
    mcp_shots_free(host, shots);
    shots->drawn = (struct mcp_drawn){.bytes = NULL};
    job->faults.count = 0;
    if (!mcp_compose(job, picture, &draw)) {
        if (mcp_host_is_cancelled(host)) return MCP_CANCELLED;
        mcp_fault(&job->faults, "", "there is no memory for the scene");
        return MCP_REFUSED;
    }
    const enum mcp_draw_status status = host->draw(host->context, &draw, &shots->drawn);
    if (status == MCP_DRAWN) {
        shots->has_drawn = true;
        if (take_files(shots)) return MCP_DRAWN;
        mcp_fault(&job->faults, "", "the pictures cannot be read");
        return MCP_REFUSED;
    }
    for (size_t i = 0; status == MCP_REFUSED && i < shots->drawn.faults.count; i++) {
        struct mcp_fault *fault = &shots->drawn.faults.at[i];
        mcp_job_point(job, fault->pointer);
        mcp_fault(&job->faults, fault->pointer, "%s", fault->detail);
    }
    return status;
}

/* ---- bytes ---- */

static size_t count_characters(const struct mcp_shots *shots)
{
    size_t count = 0;
    for (unsigned i = 0; i < shots->count; i++)
        count += (shots->at[i].size + 2) / 3 * 4;
    return count;
}

static bool has_alpha(const struct mcp_shots *shots)
{
    enum { AT_TYPE = 25 };
    for (unsigned i = 0; i < shots->count; i++) {
        const unsigned char *png = shots->at[i].image;
        if (strcmp(shots->at[i].type, "image/png") == 0 && shots->at[i].size > AT_TYPE && (png[AT_TYPE] & 4))
            return true;
    }
    return false;
}

/* Draws once. Lossy pictures get qualities by which all fit. */
static enum mcp_draw_status draw_as(struct mcp_job *job, const char *format, unsigned width, unsigned height,
                                    struct mcp_shots *shots)
{
    char outputs[160], most[48] = "";
    const unsigned share = MCP_IMAGE_BYTES_MAX / 4 * 3 / job->images - 3;
    if (strcmp(format, "png") != 0) snprintf(most, sizeof most, ",\"maxBytes\":%u", share);
    snprintf(outputs, sizeof outputs, "[{\"channel\":\"color\",\"encoding\":\"%s\"%s},{\"channel\":\"info\"}]", format,
             most);
    const struct mcp_picture picture = {.outputs = outputs, .width = width, .height = height, .only = -1};
    const enum mcp_draw_status status = mcp_shots_draw_once(job, &picture, shots);
    for (unsigned i = 0; i < shots->count; i++) {
        const cJSON *window = mcp_get(shots->at[i].info, "window"), *w = mcp_get(window, "width"),
                    *h = mcp_get(window, "height");
        if (status == MCP_DRAWN && !shots->at[i].image) {
            mcp_fault(&job->faults, "", "view '%s' has no picture", shots->at[i].name);
            return MCP_REFUSED;
        }
        shots->at[i].width = job->is_sheet || !w ? width : (unsigned)w->valuedouble;
        shots->at[i].height = job->is_sheet || !h ? height : (unsigned)h->valuedouble;
    }
    return status;
}

/* Returns true if the faults are those of a lossy format: a background that is not opaque. */
static bool is_of_format(const struct mcp_faults *faults)
{
    return faults->count == 1 && !*faults->at[0].pointer && !strstr(faults->at[0].detail, "maxBytes");
}

static bool is_of_bytes(const struct mcp_faults *faults)
{
    return faults->count == 1 && strstr(faults->at[0].detail, "maxBytes");
}

enum mcp_draw_status mcp_shots_draw(struct mcp_job *job, bool only_info, struct mcp_shots *shots)
{
    static const struct mcp_picture info = {.outputs = "[{\"channel\":\"info\"}]", .only = -1};
    unsigned width = job->width, height = job->height;
    if (only_info) return mcp_shots_draw_once(job, &info, shots);
    const bool is_large = (double)width * height * job->images > PNG_PIXELS;
    const char *format = job->format ? job->format : is_large ? "jpeg" : "png";
    for (int smaller = 0;;) {
        enum mcp_draw_status status = draw_as(job, format, width, height, shots);
        if (status != MCP_DRAWN && status != MCP_REFUSED) return status;
        const bool is_drawn = status == MCP_DRAWN, is_too_large = is_drawn || is_of_bytes(&job->faults);
        if (is_drawn && count_characters(shots) <= MCP_IMAGE_BYTES_MAX) return MCP_DRAWN;
        if (!job->format && strcmp(format, "png") == 0 && is_drawn) {
            format = has_alpha(shots) ? "webp" : "jpeg";
        } else if (!job->format && strcmp(format, "jpeg") == 0 && is_of_format(&job->faults)) {
            format = "webp";
        } else if (is_too_large && smaller++ < SMALLER_MAX && width > MCP_SIDE_MIN && height > MCP_SIDE_MIN) {
            width = width * 2 / 3;
            height = height * 2 / 3;
            shots->is_smaller = true;
        } else {
            if (is_drawn)
                mcp_fault(&job->faults, "", "the pictures have more than %d bytes: give fewer or smaller ones",
                          MCP_IMAGE_BYTES_MAX);
            return MCP_REFUSED;
        }
    }
}
