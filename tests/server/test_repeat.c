/* The same request gives the same bytes: in another process, whose memory lies elsewhere, with another instruction set,
 * by another number of threads, and the second time. REPEAT_PROCESSES says how many daemons are asked. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/isa.h"
#include "server/support/client.h"
#include "support/random.h"
#include "support/tests.h"

enum { SMALL = 160, LARGE = 40, PICTURES = SMALL + LARGE, PROCESSES = 8 };

/* Of small ones a tenth is asked for again at once, when what the first time left in memory is still there. */
enum { AGAIN = 10 };

struct picture {
    const char *target;
    char *scene;
    struct reply first; /* all others must have its bytes */
    unsigned differences;
};

static struct picture pictures[PICTURES];

/* ---- what is asked for ---- */

static const char *const targets[] = {
    "/v1/render",
    "/v1/render",
    "/v1/render?channel=depth&encoding=png16",
    "/v1/render?compress=small",
    "/v1/render?channel=depth&encoding=png16&compress=small",
    "/v1/render?channel=faceId",
    "/v1/render?channel=info",
    "/v1/render", /* several outputs */
};
enum { TARGETS = sizeof targets / sizeof targets[0], SEVERAL = TARGETS - 1 };

static void print_polygon(FILE *out, struct random *random)
{
    fputs("{\"vertices\":[", out);
    for (int i = 0; i < 3; i++)
        fprintf(out, "%s[%.3f,%.3f,%.3f]", i ? "," : "", random_range(random, -1, 1), random_range(random, -1, 1),
                random_range(random, -1, 1));
    if (random_below(random, 3) == 0) {
        fputs("],\"colors\":[", out);
        for (int i = 0; i < 3; i++)
            fprintf(out, "%s\"#%06x\"", i ? "," : "", random_below(random, 1 << 24));
        fputs("],\"doubleSided\":true}", out);
    } else {
        fprintf(out, "],\"color\":\"#%06x\",\"doubleSided\":true}", random_below(random, 1 << 24));
    }
}

/* From one pixel up; large ones are deflated in several strips. */
static char *make_scene(struct random *random, bool large, bool several)
{
    char *scene = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&scene, &size);
    const uint32_t most = large ? 900 : 1u << (1 + random_below(random, 8)), least = large ? 450 : 1;
    fprintf(out, "{\"window\":{\"width\":%u,\"height\":%u},\"background\":\"#ffffff%s\",",
            least + random_below(random, most), least + random_below(random, most),
            random_below(random, 3) ? "" : "00");
    if (several)
        fputs("\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"depth\",\"encoding\":\"npy\"},{\"channel\":\"info\"}"
              "],",
              out);
    fputs("\"polygons\":[", out);
    for (uint32_t left = 1 + random_below(random, 40); left > 0; left--) {
        print_polygon(out, random);
        if (left > 1) fputc(',', out);
    }
    fputs("]}", out);
    assert_int_equal(fclose(out), 0);
    return scene;
}

static int make_pictures(void **state)
{
    struct random random = random_seeded(24);
    (void)state;
    for (size_t i = 0; i < PICTURES; i++) {
        pictures[i].target = targets[i % TARGETS];
        pictures[i].scene = make_scene(&random, i >= SMALL, i % TARGETS == SEVERAL);
    }
    return 0;
}

static int free_pictures(void **state)
{
    (void)state;
    for (size_t i = 0; i < PICTURES; i++) {
        free(pictures[i].scene);
        reply_free(&pictures[i].first);
    }
    return 0;
}

/* ---- asking ---- */

static void ask(const struct daemon *daemon, struct picture *picture)
{
    static const char *const json[] = {JSON_TYPE, NULL};
    struct reply got = client_send(daemon, "POST", picture->target, json, picture->scene, strlen(picture->scene));
    if (got.status != 200) fail_msg("%ld for %s: %s", got.status, picture->target, got.body);
    if (!picture->first.body) {
        picture->first = got;
        return;
    }
    picture->differences += !reply_is_same(&got, &picture->first);
    reply_free(&got);
}

static unsigned ask_for_all(const struct daemon *daemon)
{
    unsigned requests = 0;
    for (size_t i = 0; i < PICTURES; i++)
        for (int times = i % AGAIN == 0 ? 2 : 1; times > 0; times--, requests++)
            ask(daemon, &pictures[i]);
    return requests;
}

/* Instruction sets and threads in turns. */
static struct daemon start(unsigned process)
{
    static const enum zr_isa all[] = {ZR_ISA_SCALAR, ZR_ISA_SSE2, ZR_ISA_AVX2, ZR_ISA_AVX512, ZR_ISA_NEON};
    enum zr_isa isas[5];
    unsigned count = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (zr_isa_is_available(all[i])) isas[count++] = all[i];
    char isa[32], threads[32];
    snprintf(isa, sizeof isa, "--isa=%s", zr_isa_name(isas[process % count]));
    snprintf(threads, sizeof threads, "--threads=%u", 1 + process / count % 3);
    return daemon_start(LIST(isa, threads));
}

TEST(the_same_request_gives_the_same_bytes_in_every_process)
{
    const char *wanted = getenv("REPEAT_PROCESSES");
    const unsigned processes = wanted ? (unsigned)atoi(wanted) : PROCESSES;
    unsigned requests = 0, differences = 0;
    assert_true(processes > 1);
    for (unsigned i = 0; i < processes; i++) {
        struct daemon daemon = start(i);
        requests += ask_for_all(&daemon);
        daemon_stop(&daemon);
    }
    for (size_t i = 0; i < PICTURES; i++) {
        differences += pictures[i].differences;
        if (pictures[i].differences)
            print_message("picture %zu, %zu bytes of %s: %u times others\n", i, pictures[i].first.size,
                          pictures[i].target, pictures[i].differences);
    }
    print_message("%u requests of %d pictures to %u processes: %u answers of other bytes\n", requests, PICTURES,
                  processes, differences);
    assert_int_equal(differences, 0);
}

RUN_TESTS(make_pictures, free_pictures)
