#include "routes.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "body.h"
#include "clock.h"
#include "for_agents.h"
#include "form.h"
#include "jobs/slowness.h"
#include "mcp/model.h"
#include "problem.h"
#include "rendering.h"
#include "request/change.h"
#include "request/compare.h"
#include "text.h"

static const char sides[2][2] = {"a", "b"};

bool comparing_open(const struct service *service, struct request *request, struct answer *answer)
{
    const char *type = request->content_type ? request->content_type : "", *fault;
    (void)service;
    if (!rendering_is_multipart(type))
        problem_answer(answer, 415,
                       "Content-Type has the value '%.80s'; multipart/form-data is expected, with the "
                       "parts a and b",
                       type);
    else if (!multipart_boundary(type, request->boundary, &fault))
        problem_answer(answer, 400, "%s", fault);
    else
        return true;
    return false;
}

/* ---- the body ---- */

struct comparing {
    const struct work *work;
    struct zr_run run;
    struct zr_stored stored;
    struct zr_asset *assets; /* parts other than a and b */
    size_t asset_count;
    const struct zr_scene *scenes[2];
    char *numbers, *picture; /* parameters: of comparing, and of the picture */
};

/* True if the query asks for a picture. */
static bool has_picture(const char *query)
{
    const char *show = NULL;
    for (const char *at = query; *at; at += strcspn(at, "&"), at += *at == '&')
        if (strncmp(at, "show=", 5) == 0) show = at + 5;
    return show && strncmp(show, "none", 4) != 0;
}

/* Parts the query. Distances and features are left out if the answer has no numbers. False: the arena failed. */
static bool split_query(struct comparing *c)
{
    const char *query = c->work->request->query ? c->work->request->query : "";
    const char *const without = "deviation=off&features=off&"; /* later values override them */
    const size_t room = strlen(query) + strlen(without) + 2;
    c->numbers = zr_arena_zero(c->run.arena, room, 1);
    c->picture = zr_arena_zero(c->run.arena, room, 1);
    if (!zr_arena_ok(c->run.arena)) return false;
    if (c->work->request->parts == ACCEPT_NO_PARTS && has_picture(query)) strcpy(c->numbers, without);
    while (*query) {
        const size_t size = strcspn(query, "&");
        char *to = zr_compare_has_parameter(query) ? c->numbers : c->picture;
        if (*to && to[strlen(to) - 1] != '&') strcat(to, "&");
        strncat(to, query, size);
        query += size + (query[size] == '&');
    }
    return true;
}

/* Lists the parts other than a and b. False without memory. */
static bool list_assets(struct comparing *c, const struct multipart *parts)
{
    c->assets = zr_arena_alloc(c->run.arena, MULTIPART_PARTS_MAX, sizeof *c->assets);
    if (!c->assets) return false;
    for (const struct multipart_part *part = parts->parts; part < parts->parts + parts->count; part++)
        if (strcmp(part->name, sides[0]) != 0 && strcmp(part->name, sides[1]) != 0)
            c->assets[c->asset_count++] =
                (struct zr_asset){.name = part->name, .bytes = part->bytes, .size = part->size, .is_optional = true};
    return true;
}

static void report(const struct comparing *c, enum zr_status status)
{
    struct answer *answer = c->work->answer;
    if (status == ZR_NO_MEMORY)
        problem_memory(answer, c->run.arena, NULL);
    else if (status == ZR_CANCELLED)
        problem_timeout(answer, c->work->service->config->render_timeout_ms);
    else
        problem_answer_error(answer, problem_http_status(status), c->run.error);
}

/* Reads a model. Faults begin with the name of its part. False: the answer has the error. */
static bool read_side(struct comparing *c, const struct multipart *parts, int side)
{
    const struct multipart_part *part = multipart_find(parts, sides[side]);
    struct zr_error error = {0};
    struct zr_run run = zr_run_reporting(&c->run, &error);
    struct zr_scene_file file = {.assets = c->assets, .asset_count = c->asset_count, .stored = &c->stored};
    if (!part) {
        problem_answer(c->work->answer, 400, "multipart/form-data: the part '%s' is missing", sides[side]);
        return false;
    }
    if (part->type) {
        char *type = zr_arena_zero(c->run.arena, part->type_size + 1, 1);
        if (type) memcpy(type, part->type, part->type_size);
        file.type = type;
    }
    file.bytes = part->bytes;
    file.size = part->size;
    const enum zr_status status = zr_scene_read_file(&run, &file, &c->work->service->limits, &c->scenes[side]);
    for (size_t i = 0; i < zr_error_held(&error); i++)
        zr_error_add(c->run.error, error.status, error.items[i].pointer, "%s: %s", sides[side], error.items[i].detail);
    if (status != ZR_OK) report(c, status);
    return status == ZR_OK;
}

/* ---- the answer ---- */

static bool is_too_long(const struct comparing *c, struct zr_error *error)
{
    const double ms =
        zr_compare_cost_ms(c->scenes[0], c->scenes[1], c->numbers) * slowness_of(c->work->service->slowness, true);
    c->work->times->predicted_ms = ms;
    if (ms <= (double)c->work->service->config->cost_max_ms) return false;
    zr_error_add(error, ZR_BAD_SCENE, NULL,
                 "the work is predicted to take %.3g s of processor time, more than costMaxMs, %" PRIu64
                 " ms: models with fewer triangles, or precision=quick, take less",
                 1e-3 * ms, c->work->service->config->cost_max_ms);
    return true;
}

static enum zr_status draw(struct comparing *c, const struct zr_kept *kept, struct zr_answer *picture)
{
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    enum zr_status status = zr_scene_change_query(&c->run, kept, c->picture, &scene);
    if (status == ZR_OK) status = zr_render(&c->run, scene, NULL, &frame);
    return status == ZR_OK ? zr_encode(&c->run, scene, frame, picture) : status;
}

/* Answers with the picture, or with the numbers and the picture. */
static void answer_picture(const struct comparing *c, const struct zr_compare_answer *numbers,
                           const struct zr_answer *picture)
{
    struct answer *answer = c->work->answer;
    const struct form_file files[2] = {{"comparison.json", "application/json", numbers->json, numbers->size},
                                       {"picture.png", picture->content_type, picture->bytes, picture->size}};
    if (c->work->request->parts == ACCEPT_NO_PARTS)
        answer_copy(answer, picture->content_type, picture->bytes, picture->size);
    else
        form_answer(answer, c->work->request->parts, files, 2);
    answer_vary(answer, "Accept");
}

static enum zr_status make_answer(struct comparing *c)
{
    struct zr_compare_answer numbers;
    struct zr_answer picture;
    enum zr_status status = zr_compare(&c->run, c->scenes[0], c->scenes[1], c->numbers, &numbers);
    if (status != ZR_OK) return status;
    if (!numbers.scene && *c->picture)
        return zr_error_add(c->run.error, ZR_BAD_REQUEST, NULL,
                            "query: '%.80s' is for a picture: show=difference asks for one", c->picture);
    if (numbers.scene) status = draw(c, numbers.scene, &picture);
    if (status != ZR_OK) return status;
    if (numbers.scene)
        answer_picture(c, &numbers, &picture);
    else
        answer_copy(c->work->answer, "application/json", numbers.json, numbers.size);
    return ZR_OK;
}

static enum request_next compare(struct comparing *c, const struct multipart *parts)
{
    const int64_t begin_us = clock_us();
    if (!split_query(c) || !list_assets(c, parts)) {
        problem_memory(c->work->answer, c->run.arena, NULL);
        return REQUEST_ANSWERED;
    }
    if (!read_side(c, parts, 0) || !read_side(c, parts, 1)) return REQUEST_ANSWERED;
    if (is_too_long(c, c->run.error)) {
        report(c, ZR_BAD_SCENE);
        return REQUEST_ANSWERED;
    }
    const int64_t middle_us = clock_us();
    const enum zr_status status = make_answer(c);
    c->work->times->parse_ms = (double)(middle_us - begin_us) / 1000.0;
    c->work->times->render_ms = (double)(clock_us() - middle_us) / 1000.0;
    if (status != ZR_OK) report(c, status);
    return REQUEST_ANSWERED;
}

static struct comparing begin(const struct work *work, struct zr_error *error)
{
    return (struct comparing){.work = work,
                              .run = {.arena = work->arena,
                                      .scratch = work->arena,
                                      .team = work->service->team,
                                      .cancel = work->cancel,
                                      .error = error},
                              .stored = assets_stored(work->service)};
}

enum request_next comparing_work(const struct work *work)
{
    struct zr_error error = {0};
    struct multipart *parts;
    struct comparing c = begin(work, &error);
    if (work->request->small_only) return REQUEST_LARGE; /* takes longer than a small one in any case */
    const enum request_next next = body_next(work, body_parts(work, &parts));
    return next == REQUEST_WORK ? compare(&c, parts) : next;
}

/* ---- agents ---- */

static enum zr_status compare_drawn(struct comparing *c, const struct mcp_compare *compare, struct mcp_told *told)
{
    struct zr_compare_answer numbers;
    struct zr_answer picture = {.bytes = NULL};
    c->numbers = zr_arena_copy(c->run.arena, compare->query, strlen(compare->query) + 1);
    if (!c->numbers) return ZR_NO_MEMORY;
    if (is_too_long(c, c->run.error)) return ZR_BAD_SCENE;
    enum zr_status status = zr_compare(&c->run, c->scenes[0], c->scenes[1], c->numbers, &numbers);
    c->picture = (char[]){"width=800&height=600"};
    if (status == ZR_OK && numbers.scene) status = draw(c, numbers.scene, &picture);
    told->json = numbers.json;
    told->picture = picture.bytes;
    told->picture_size = picture.size;
    return status;
}

/* Pointers into a model get the name of its side; -1: of none. */
static enum mcp_draw_status refuse(const struct comparing *c, enum zr_status status, int side, struct mcp_told *told)
{
    const enum mcp_draw_status refused = for_agent_refuse(&c->run, status, &told->faults);
    for (size_t i = 0; side >= 0 && i < told->faults.count; i++)
        mcp_side_point(told->faults.at[i].pointer, side);
    return refused;
}

enum mcp_draw_status comparing_for_agent(const struct work *work, const struct mcp_compare *compare,
                                         struct mcp_told *told)
{
    struct zr_error error = {0};
    struct comparing c = begin(work, &error);
    if (work->request->small_only) return MCP_LATER;
    for (int i = 0; i < 2; i++) {
        const enum zr_status status = for_agent_read(work, &c.run, &compare->sides[i], &c.scenes[i]);
        if (status != ZR_OK) return refuse(&c, status, i, told);
    }
    const enum zr_status status = compare_drawn(&c, compare, told);
    return status == ZR_OK ? MCP_DRAWN : refuse(&c, status, -1, told);
}
