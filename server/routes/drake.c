#include "routes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <nettle/sha2.h>

#include "drake_form.h"
#include "input/json/json_writer.h"
#include "problem.h"
#include "render_request.h"
#include "rendering.h"

bool drake_open(const struct service *service, struct request *request, struct answer *answer)
{
    const char *type = request->content_type ? request->content_type : "", *fault;
    (void)service;
    if (request->query && *request->query)
        problem_answer(answer, 400, "%s has no parameters; the fields of a form have the settings", DRAKE_PATH);
    else if (!rendering_is_multipart(type))
        problem_answer(answer, 400, "Content-Type has the value '%.80s'; multipart/form-data is expected", type);
    else if (!multipart_boundary(type, request->boundary, &fault))
        problem_answer(answer, 400, "%s", fault);
    else
        return true;
    return false;
}

/* ---- the hash ---- */

enum { HASH_DIGITS = 2 * SHA256_DIGEST_SIZE, HASHED_AT_ONCE = 1 << 20 };

static bool is_hash(const struct multipart_part *part)
{
    static const char DIGITS[] = "0123456789abcdefABCDEF";
    if (!part || part->size != HASH_DIGITS) return false;
    for (size_t i = 0; i < part->size; i++)
        if (part->bytes[i] == '\0' || !strchr(DIGITS, part->bytes[i])) return false;
    return true;
}

/* Compares the hash with that of the file. Any other text is ignored, since some clients send one. */
static enum body_status check_hash(const struct drake_form *form, const struct zr_cancel *cancel, struct answer *answer)
{
    struct sha256_ctx sha256;
    unsigned char digest[SHA256_DIGEST_SIZE];
    char found[HASH_DIGITS + 1];
    if (!is_hash(form->hash)) return BODY_READY;
    sha256_init(&sha256);
    for (size_t at = 0; at < form->scene->size; at += HASHED_AT_ONCE) {
        const size_t left = form->scene->size - at;
        if (zr_is_cancelled(cancel)) return BODY_CANCELLED;
        sha256_update(&sha256, left < HASHED_AT_ONCE ? left : HASHED_AT_ONCE, (const uint8_t *)form->scene->bytes + at);
    }
    sha256_digest(&sha256, sizeof digest, digest);
    for (size_t i = 0; i < sizeof digest; i++)
        snprintf(found + 2 * i, 3, "%02x", digest[i]);
    if (strncasecmp(found, form->hash->bytes, HASH_DIGITS) == 0) return BODY_READY;
    problem_answer(answer, 400,
                   "field 'scene_sha256' has the value '%.*s'; the %zu bytes of the field 'scene' have the hash '%s'",
                   HASH_DIGITS, form->hash->bytes, form->scene->size, found);
    return BODY_REFUSED;
}

/* ---- the scene ---- */

static const char FILE_NAME[] = "scene";

static void put(struct zr_json_writer *json, const char *pointer, const char *text)
{
    zr_json_go_to(json, pointer);
    zr_json_put(json, text);
}

static void put_number(struct zr_json_writer *json, const char *pointer, double value)
{
    zr_json_go_to(json, pointer);
    zr_json_put_number(json, value);
}

/* Drake's world has z up. The look's outlines and the shadow on a ground that is not there are no parts of a scene. */
static void put_color(struct zr_json_writer *json)
{
    put(json, "/look", "\"studio\"");
    put(json, "/up", "\"z\"");
    put(json, "/edges", "false");
    put(json, "/groundShadow", "false");
    put(json, "/samples", "4");
    put(json, DRAKE_AT_SCENE "/asset", "\"scene\"");
    put(json, "/outputs/0/channel", "\"color\"");
    put(json, "/outputs/0/encoding", "\"png32\"");
}

/* Depths and labels show the nearest surface and ignore opacity. */
static void put_depth(struct zr_json_writer *json, const struct drake_form *form, bool is_tiff)
{
    char range[80];
    snprintf(range, sizeof range, "[%.17g,%.17g]", form->min_depth, form->max_depth);
    put(json, DRAKE_AT_SCENE "/asset", "\"scene\"");
    put(json, DRAKE_AT_SCENE "/alphaMode", "\"OPAQUE\"");
    put(json, "/outputs/0/channel", "\"depth\"");
    put(json, "/outputs/0/encoding", is_tiff ? "\"tiff\"" : "\"png16\"");
    put(json, DRAKE_AT_RANGE, range);
    if (!is_tiff) put(json, "/outputs/0/scale", "0.001");
}

static void put_label(struct zr_json_writer *json)
{
    put(json, "/background", "\"#ffffff\"");
    put(json, "/colors", "\"materials\"");
    put(json, DRAKE_AT_SCENE "/asset", "\"scene\"");
    put(json, DRAKE_AT_SCENE "/shading", "\"unlit\"");
    put(json, DRAKE_AT_SCENE "/alphaMode", "\"OPAQUE\"");
    put(json, "/outputs/0/channel", "\"color\"");
    put(json, "/outputs/0/encoding", "\"png32\"");
}

/* Writes the scene. False without memory. */
static bool make_scene(const struct drake_form *form, bool is_tiff, struct zr_arena *arena, struct zr_request *render)
{
    enum { TEXT_SIZE = 2048 }; /* some 700 are used */
    struct zr_json_writer json = {.text = zr_arena_alloc(arena, TEXT_SIZE, 1), .pointer = ""};
    if (!json.text) return false;
    put_number(&json, DRAKE_AT_WIDTH, form->width);
    put_number(&json, DRAKE_AT_HEIGHT, form->height);
    put(&json, DRAKE_AT_CAMERA, "0");
    put_number(&json, DRAKE_AT_FOCAL_X, form->focal_x);
    put_number(&json, DRAKE_AT_FOCAL_Y, form->focal_y);
    put_number(&json, DRAKE_AT_CENTER_X, form->center_x);
    put_number(&json, DRAKE_AT_CENTER_Y, form->center_y);
    put_number(&json, DRAKE_AT_NEAR, form->near);
    put_number(&json, DRAKE_AT_FAR, form->far);
    if (form->image == DRAKE_COLOR) put_color(&json);
    if (form->image == DRAKE_DEPTH) put_depth(&json, form, is_tiff);
    if (form->image == DRAKE_LABEL) put_label(&json);
    zr_json_go_to(&json, "");
    render->format = ZR_FORMAT_JSON;
    render->bytes = json.text;
    render->size = json.used;
    return true;
}

/* Makes the form a scene that names its file. */
static enum body_status unpack(const struct work *work, struct zr_request *render)
{
    struct multipart *parts;
    struct drake_form form;
    struct zr_error error = {0};
    enum body_status status = body_split(work, render, &parts);
    if (status != BODY_READY) return status;
    if (!drake_form_read(parts, work->service->limits.window_side_max, &form, &error)) {
        problem_answer_error(work->answer, 400, &error);
        return BODY_REFUSED;
    }
    status = check_hash(&form, work->reading, work->answer);
    if (status != BODY_READY) return status;
    struct zr_asset *file = zr_arena_alloc(work->arena, 1, sizeof *file);
    if (!file || !make_scene(&form, work->request->takes_tiff, work->arena, render)) {
        problem_memory(work->answer, work->arena, NULL);
        return BODY_REFUSED;
    }
    *file = (struct zr_asset){.name = FILE_NAME, .bytes = form.scene->bytes, .size = form.scene->size};
    render->assets = file;
    render->asset_count = 1;
    return BODY_READY;
}

static void report(struct answer *answer, enum zr_status status, const struct zr_error *error)
{
    struct zr_error named = {0};
    drake_form_report(error, status, &named);
    problem_answer_error(answer, problem_http_status(status), &named);
}

enum request_next drake_work(const struct work *work)
{
    /* Files that differ in the pose of the camera are never the same: a copy of each would cost half of the reading. */
    static const struct rendering_kind kind = {unpack, report, NULL, false};
    struct answer *answer = work->answer;
    answer->is_plain = true;
    const enum request_next next = rendering_run(&kind, work);
    if (answer->status == 415 || answer->status == 422) answer->status = 400; /* the protocol has no other fault */
    return next;
}
