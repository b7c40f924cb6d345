#include "routes.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "body.h"
#include "clock.h"
#include "for_agents.h"
#include "jobs/slowness.h"
#include "output/json/warnings.h"
#include "problem.h"
#include "request/drawing_file.h"
#include "text.h"

/* Returns the parameters of the query that are those of drawings, or all others. The caller frees them; NULL without
 * memory. */
static char *part_of(const char *query, bool is_drawing)
{
    char *part = calloc(strlen(query) + 2, 1), *end = part;
    while (part && *query) {
        const size_t size = strcspn(query, "&");
        if (size > 0 && zr_drawing_has_parameter(query) == is_drawing) {
            if (end > part) *end++ = '&';
            memcpy(end, query, size);
            end += size;
        }
        query += size + (query[size] == '&');
    }
    return part;
}

/* Checks the type, and the parameters of reading. Those of the drawing are read later. */
bool drawing_open(const struct service *service, struct request *request, struct answer *answer)
{
    char *query = request->query;
    char *others = part_of(query ? query : "", false);
    if (!others) {
        problem_busy(answer, 1, REFUSAL_MEMORY);
        return false;
    }
    request->query = others;
    const bool is_open = rendering_open(service, request, answer);
    request->query = query;
    request->is_shareable = false;
    free(others);
    return is_open;
}

static enum zr_status refuse_cost(const struct work *work, double ms, struct zr_error *error)
{
    return zr_error_add(error, ZR_BAD_SCENE, NULL,
                        "the work is predicted to take %.3g s of processor time, more than costMaxMs, %" PRIu64
                        " ms: a model with fewer triangles takes less",
                        1e-3 * ms, work->service->config->cost_max_ms);
}

/* Makes the file of a scene. */
static enum zr_status make_file(const struct work *work, const struct zr_run *run, const struct zr_scene *scene,
                                const char *numbers, struct zr_drawing_file *file)
{
    const double ms = zr_drawing_cost_ms(scene, numbers) * slowness_of(work->service->slowness, true);
    work->times->predicted_ms = ms;
    if (ms > (double)work->service->config->cost_max_ms) return refuse_cost(work, ms, run->error);
    const int64_t mark_us = clock_us();
    const enum zr_status status = zr_drawing_file_make(run, scene, numbers, file);
    work->times->render_ms = (double)(clock_us() - mark_us) / 1000.0;
    return status;
}

static enum zr_status make(const struct work *work, const struct zr_run *run, const struct zr_scene *scene,
                           struct zr_drawing_file *file)
{
    const char *query = work->request->query ? work->request->query : "";
    char *own = part_of(query, true);
    const enum zr_status status = own ? make_file(work, run, scene, own, file) : ZR_NO_MEMORY;
    free(own);
    return status;
}

static void report(const struct work *work, const struct zr_run *run, enum zr_status status)
{
    if (status == ZR_NO_MEMORY)
        problem_memory(work->answer, run->arena, NULL);
    else if (status == ZR_CANCELLED)
        problem_timeout(work->answer, work->service->config->render_timeout_ms);
    else
        problem_answer_error(work->answer, problem_http_status(status), run->error);
}

static void answer_drawing(const struct work *work, const struct zr_run *run, const struct zr_drawing_file *file)
{
    char warnings[ZR_WARNINGS_SIZE];
    answer_copy(work->answer, file->content_type, file->bytes, file->size);
    work->answer->warnings = file->warnings.count;
    if (file->warnings.count == 0) return;
    text_to_ascii(warnings, sizeof warnings, zr_warnings_join(run->arena, &file->warnings));
    answer_header(work->answer, "Zraster-Warnings", "%s", warnings);
}

static struct zr_run begin(const struct work *work, struct zr_error *error)
{
    return (struct zr_run){.arena = work->arena,
                           .scratch = work->arena,
                           .team = work->service->team,
                           .cancel = work->cancel,
                           .error = error};
}

enum request_next drawing_work(const struct work *work)
{
    struct zr_error error = {0};
    const struct zr_scene *scene;
    struct zr_drawing_file file;
    enum zr_status status = ZR_OK;
    const struct zr_run run = begin(work, &error);
    if (work->request->small_only) return REQUEST_LARGE; /* takes longer than a small one in any case */
    const int64_t mark_us = clock_us();
    const enum request_next next = body_next(work, body_read_scene(work, &run, &scene, &status));
    if (next != REQUEST_WORK) return next;
    work->times->parse_ms = (double)(clock_us() - mark_us) / 1000.0;
    if (status == ZR_OK) status = make(work, &run, scene, &file);
    if (status == ZR_OK)
        answer_drawing(work, &run, &file);
    else
        report(work, &run, status);
    return REQUEST_ANSWERED;
}

enum mcp_draw_status drawing_for_agent(const struct work *work, const struct mcp_draw *draw, const char *query,
                                       struct mcp_told *told)
{
    struct zr_error error = {0};
    struct zr_drawing_file file;
    const struct zr_scene *scene;
    const struct zr_run run = begin(work, &error);
    if (work->request->small_only) return MCP_LATER;
    enum zr_status status = for_agent_read(work, &run, draw, &scene);
    if (status == ZR_OK) status = make_file(work, &run, scene, query, &file);
    if (status != ZR_OK) return for_agent_refuse(&run, status, &told->faults);
    told->json = file.json;
    told->picture = file.bytes;
    told->picture_size = file.size;
    return MCP_DRAWN;
}
