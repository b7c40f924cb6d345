/* server/keep/meshes.c, core/input/model/kept_mesh.c: model files kept between requests. No answer depends on them. */
#include "base/run.h"
#include "base/team.h"
#include "keep/images.h"
#include "keep/meshes.h"
#include "scene/scene.h"
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/mesh_requests.h"
#include "unit/common/sheet_files.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ARENA_BYTES = 1 << 28 };

/* ---- files ---- */

static struct sheet_file files[SHEET_KINDS];

static int make_files(void **state)
{
    (void)state;
    return sheet_files_make(files) ? 0 : -1;
}

static int free_files(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHEET_KINDS; kind++)
        free(files[kind].bytes);
    return 0;
}

/* ---- answers ---- */

struct answered {
    enum zr_status status;
    char *bytes; /* of the answer, or the faults */
    size_t size, used, held;
};

static void answered_free(struct answered *answered)
{
    free(answered->bytes);
    *answered = (struct answered){.bytes = NULL};
}

static int reads; /* of the store, by the test's own thread */

static enum zr_status read_stored(void *context, const char *sha256, struct zr_arena *arena, const void **bytes,
                                  size_t *size)
{
    const struct sheet_file *file = context;
    (void)sha256;
    reads++;
    if (!file->bytes) return ZR_BAD_SCENE;
    *size = file->size;
    *bytes = zr_arena_copy(arena, file->bytes, file->size);
    return *bytes ? ZR_OK : ZR_NO_MEMORY;
}

static enum zr_status look_at_stored(void *context, const char *sha256, size_t *size)
{
    const struct sheet_file *file = context;
    (void)sha256;
    *size = file->size;
    return file->bytes ? ZR_OK : ZR_BAD_SCENE;
}

/* A copy that lives as long as its request. */
static char *lend(const struct sheet_file *file)
{
    char *copy = malloc(file->size);
    assert_non_null(copy);
    return memcpy(copy, file->bytes, file->size);
}

static void take_back(const void *bytes, size_t size)
{
    memset((void *)(uintptr_t)bytes, 0xEE, size);
    free((void *)(uintptr_t)bytes);
}

static struct zr_request request_of(const struct row *row, struct zr_asset *assets, struct meshes_use *use)
{
    const struct sheet_file scene = {(char *)(uintptr_t)row->scene, row->scene ? strlen(row->scene) : 0};
    const struct sheet_file *body = row->scene ? &scene : &files[row->body];
    struct zr_request request = {.format = row->format,
                                 .bytes = lend(body),
                                 .size = body->size,
                                 .assets = assets,
                                 .stored = {read_stored, look_at_stored, &files[row->stored], NULL},
                                 .meshes = meshes_lend(use),
                                 .look = row->look,
                                 .azimuth = row->azimuth,
                                 .channel = row->channel,
                                 .strict = row->strict,
                                 .up = row->up,
                                 .animation = row->animation};
    if (!row->scene) request.width = request.height = "40";
    for (; row->parts[request.asset_count].name; request.asset_count++) {
        const struct sheet_file *file = &files[row->parts[request.asset_count].kind];
        assets[request.asset_count] =
            (struct zr_asset){.name = row->parts[request.asset_count].name, .bytes = lend(file), .size = file->size};
    }
    return request;
}

static char *copy_answer(enum zr_status status, const struct zr_answer *answer, const struct zr_error *error,
                         size_t *size)
{
    char *text;
    FILE *out = open_memstream(&text, size);
    if (status == ZR_OK) {
        fwrite(answer->bytes, answer->size, 1, out);
        fputs(answer->warnings, out);
    }
    /* How much memory is needed at least depends on whether a mesh is found whole. */
    if (status == ZR_NO_MEMORY) fputs("no memory", out);
    for (size_t i = 0; status != ZR_OK && status != ZR_NO_MEMORY && i < zr_error_held(error); i++)
        fprintf(out, "%s: %s\n", error->items[i].pointer, error->items[i].detail);
    fclose(out);
    return text;
}

static struct kept *images; /* for requests that keep meshes */

static struct answered ask_within(struct zr_arena *arena, struct kept *meshes, const struct row *row)
{
    struct meshes_use use = {meshes, NULL};
    struct images_use images_use = {meshes ? images : NULL, NULL, NULL};
    struct zr_asset assets[4];
    struct zr_request request = request_of(row, assets, &use);
    request.images = images_lend(&images_use);
    const struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene = NULL;
    struct zr_answer answer = {.bytes = NULL};
    struct answered answered = {
        .status = zr_scene_read(&(struct zr_run){.arena = arena, .error = &error}, &request, &limits, &scene)};
    take_back(request.bytes, request.size);
    for (size_t i = 0; i < request.asset_count; i++)
        take_back(assets[i].bytes, assets[i].size);
    answered.used = arena->used;
    answered.held = arena->held;
    if (answered.status == ZR_OK) {
        const struct zr_frame *frame;
        answered.status = zr_render(&(struct zr_run){.arena = arena, .error = &error}, scene, NULL, &frame);
        if (answered.status == ZR_OK)
            answered.status = zr_encode(&(struct zr_run){.arena = arena, .error = &error}, scene, frame, &answer);
    }
    answered.bytes = copy_answer(answered.status, &answer, &error, &answered.size);
    meshes_release(&use);
    images_release(&images_use);
    if (images) kept_drop(images);
    return answered;
}

static struct answered ask(struct kept *meshes, const struct row *row, size_t ceiling)
{
    struct zr_arena arena;
    zr_arena_init(&arena, ceiling);
    const struct answered answered = ask_within(&arena, meshes, row);
    zr_arena_free(&arena);
    return answered;
}

static void assert_same(const struct answered *want, struct answered got, const char *name, const char *how)
{
    if (got.status != want->status)
        fail_msg("%s, %s: status %d, not %d: %s", name, how, got.status, want->status, got.bytes);
    if (got.size != want->size || memcmp(got.bytes, want->bytes, got.size) != 0)
        fail_msg("%s, %s: other bytes: %.300s", name, how, want->status == ZR_OK ? "" : got.bytes);
    if (got.used != want->used || got.held != want->held)
        fail_msg("%s, %s: %zu bytes used and %zu held, not %zu and %zu", name, how, got.used, got.held, want->used,
                 want->held);
    answered_free(&got);
}

/* In any memory. */
static void assert_same_bytes(const struct answered *want, struct answered got, const char *name, const char *how)
{
    got.used = want->used;
    got.held = want->held;
    assert_same(want, got, name, how);
}

static struct kept *open_meshes(uint64_t max_bytes)
{
    struct kept *meshes = meshes_open(max_bytes);
    assert_non_null(meshes);
    return meshes;
}

/* Asks a server whose table is too small to keep anything. Without a table, equal places of STL may be stored once: the
 * bytes are the same, in less memory. */
static struct answered ask_unkept(const struct row *row, size_t ceiling)
{
    struct kept *none = open_meshes(1);
    const struct answered answered = ask(none, row, ceiling);
    kept_close(none);
    return answered;
}

/* ---- tests ---- */

/* The rows follow each other in one table, so each finds the files of the others. */
TEST(answers_are_the_same_with_and_without_kept_meshes)
{
    struct answered want[ROWS];
    images = images_open(1 << 20);
    struct kept *many = open_meshes(1 << 28), *few = open_meshes(1 << 20), *off = open_meshes(0);
    for (int i = 0; i < ROWS; i++) {
        want[i] = ask_unkept(&rows[i], ARENA_BYTES);
        if ((want[i].status != ZR_OK) != rows[i].fails)
            fail_msg("%s: status %d: %.300s", rows[i].name, want[i].status, want[i].bytes);
        assert_same_bytes(&want[i], ask(NULL, &rows[i], ARENA_BYTES), rows[i].name, "no table");
    }
    for (int round = 0; round < 2; round++)
        for (int i = 0; i < ROWS; i++) {
            for (int again = 0; again < 2; again++)
                assert_same(&want[i], ask(many, &rows[i], ARENA_BYTES), rows[i].name, "many kept");
            assert_same(&want[i], ask(few, &rows[i], ARENA_BYTES), rows[i].name, "few kept");
            assert_same_bytes(&want[i], ask(off, &rows[i], ARENA_BYTES), rows[i].name, "none kept");
        }
    assert_true(kept_look(many).hits > ROWS && kept_look(many).dropped == 0);
    assert_true(kept_look(few).dropped > 0 && kept_look(few).bytes <= 1 << 20);
    assert_int_equal(kept_look(off).count, 0);
    assert_true(kept_drop(many));
    assert_int_equal(kept_look(many).bytes, 0);
    for (int i = 0; i < ROWS; i++) {
        assert_same(&want[i], ask(many, &rows[i], ARENA_BYTES), rows[i].name, "all dropped");
        answered_free(&want[i]);
    }
    kept_close(many);
    kept_close(few);
    kept_close(off);
    kept_close(images);
    images = NULL;
}

static const struct row *row_of(const char *name)
{
    const struct row *row = rows;
    while (strcmp(row->name, name) != 0)
        row++;
    return row;
}

static void ask_and_forget(struct kept *meshes, const struct row *row, size_t ceiling)
{
    struct answered answered = ask(meshes, row, ceiling);
    answered_free(&answered);
}

TEST(a_file_is_kept_from_the_second_time_on)
{
    static const struct {
        const char *name;
        uint64_t count;
    } all[] = {{"STL", 1}, {"small OBJ", 0}, {"broken glTF", 0}, {"scene of a stored file", 1}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        struct kept *meshes = open_meshes(1 << 28);
        ask_and_forget(meshes, row_of(all[i].name), ARENA_BYTES);
        assert_int_equal(kept_look(meshes).count, 0);
        ask_and_forget(meshes, row_of(all[i].name), ARENA_BYTES);
        assert_int_equal(kept_look(meshes).count, all[i].count);
        assert_int_equal(kept_look(meshes).hits, 0);
        reads = 0;
        ask_and_forget(meshes, row_of(all[i].name), ARENA_BYTES);
        assert_int_equal(kept_look(meshes).hits, all[i].count);
        assert_int_equal(reads, 0);
        kept_close(meshes);
    }
}

/* A client cannot change the picture of another one by bytes that are equal where samples are taken. */
TEST(changed_bytes_are_another_file)
{
    static const char *const names[] = {"STL", "GLB", "glTF with its buffer", "scene of glTF"};
    struct kept *meshes = open_meshes(1 << 28);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct row *row = row_of(names[i]);
        struct sheet_file *file = &files[row->parts[0].name ? BIN : row->body];
        for (int again = 0; again < 3; again++)
            ask_and_forget(meshes, row, ARENA_BYTES);
        for (size_t at = 4000; at < 4100; at++) {
            const char old = file->bytes[at];
            file->bytes[at] = (char)(old ^ 1);
            if (at % 33 == 0 || at % 4 == 2) {
                struct answered want = ask_unkept(row, ARENA_BYTES);
                assert_same(&want, ask(meshes, row, ARENA_BYTES), names[i], "changed");
                answered_free(&want);
            }
            file->bytes[at] = old;
        }
    }
    kept_close(meshes);
}

/* Otherwise the first one would stay, and all of its changes would be read anew for ever. */
TEST(files_that_differ_between_samples_are_kept_beside_each_other)
{
    enum { FILES = 4, FIRST = 4002, STEP = 24 };
    static const char *const names[] = {"STL", "GLB", "glTF with its buffer", "scene of glTF"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct kept *meshes = open_meshes(1 << 28);
        const struct row *row = row_of(names[i]);
        char *bytes = files[row->parts[0].name ? BIN : row->body].bytes;
        uint64_t misses = 0;
        for (int round = 0; round < 2; round++) {
            misses = kept_look(meshes).misses;
            for (int k = 0; k < FILES; k++) {
                bytes[FIRST + STEP * k] ^= 1;
                for (int again = 0; again < 2; again++)
                    ask_and_forget(meshes, row, ARENA_BYTES);
                bytes[FIRST + STEP * k] ^= 1;
            }
        }
        if (kept_look(meshes).count != FILES || kept_look(meshes).misses != misses)
            fail_msg("%s: %d kept, %d read anew", names[i], (int)kept_look(meshes).count,
                     (int)(kept_look(meshes).misses - misses));
        kept_close(meshes);
    }
}

/* For each ceiling, requests end the same way, and say the same. */
TEST(limits_of_memory_hold_for_kept_meshes)
{
    static const char *const names[] = {
        "STL", "OBJ", "GLB", "scene of parts", "scene of a stored file", "scene of a file twice"};
    struct kept *meshes = open_meshes(1 << 28);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct row *row = row_of(names[i]);
        int failed = 0, done = 0;
        for (int again = 0; again < 3; again++)
            ask_and_forget(meshes, row, ARENA_BYTES);
        for (size_t ceiling = 1 << 16; ceiling < (size_t)1 << 25; ceiling += ceiling / 12) {
            struct answered want = ask_unkept(row, ceiling);
            failed += want.status == ZR_NO_MEMORY;
            done += want.status == ZR_OK;
            if (want.status != ZR_OK) want.used = want.held = 0;
            struct answered got = ask(meshes, row, ceiling);
            if (got.status != ZR_OK) got.used = got.held = 0;
            assert_same(&want, got, names[i], "little memory");
            answered_free(&want);
        }
        if (failed < 3 || done < 3) fail_msg("%s: %d ceilings are too low, %d are not", names[i], failed, done);
    }
    kept_close(meshes);
}

TEST(memory_stays_within_its_bound_over_many_meshes)
{
    enum { MESHES = 1000, MAX_BYTES = 4 << 20 };
    struct kept *meshes = open_meshes(MAX_BYTES);
    struct zr_arena arena;
    zr_arena_init(&arena, ARENA_BYTES);
    for (int i = 0; i < MESHES; i++) {
        memcpy(files[STL].bytes, &i, sizeof i);
        for (int again = 0; again < 2; again++) {
            struct meshes_use use = {meshes, NULL};
            const struct zr_request request = {.format = ZR_FORMAT_STL,
                                               .bytes = files[STL].bytes,
                                               .size = files[STL].size,
                                               .meshes = meshes_lend(&use)};
            const struct zr_limits limits = zr_limits_default();
            struct zr_error error = {.count = 0};
            const struct zr_scene *scene;
            zr_arena_reset(&arena, SIZE_MAX);
            assert_int_equal(
                zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene), ZR_OK);
            meshes_release(&use);
            assert_true(kept_look(meshes).bytes <= MAX_BYTES);
        }
    }
    assert_true(kept_look(meshes).count > 2 && kept_look(meshes).dropped + kept_look(meshes).count == MESHES);
    memset(files[STL].bytes, 0, sizeof(int));
    zr_arena_free(&arena);
    kept_close(meshes);
}

TEST(a_mesh_in_use_stays_and_too_large_ones_are_not_kept)
{
    struct kept *meshes = open_meshes(600 << 10);
    for (int again = 0; again < 4; again++)
        ask_and_forget(meshes, row_of("STL"), ARENA_BYTES);
    assert_int_equal(kept_look(meshes).count, 0);
    kept_close(meshes);
    ask_and_forget(NULL, row_of("STL"), ARENA_BYTES);
}

/* ---- several threads ---- */

enum { THREADS = 3, ROUNDS = 20 };

struct thread {
    struct kept *meshes;
    const struct answered *want; /* by rows */
    int first;
    bool is_right;
};

static const char *const shared[] = {"STL", "GLB", "OBJ with MTL", "scene of parts", "scene of a file twice"};
enum { SHARED = sizeof shared / sizeof *shared };

static void *ask_often(void *context)
{
    struct thread *thread = context;
    struct zr_arena arena;
    zr_arena_init(&arena, ARENA_BYTES);
    for (int i = 0; i < ROUNDS; i++) {
        const int which = (thread->first + i * (1 + thread->first)) % SHARED;
        zr_arena_reset(&arena, SIZE_MAX);
        struct answered got = ask_within(&arena, thread->meshes, row_of(shared[which]));
        const struct answered *want = &thread->want[which];
        thread->is_right &= got.status == want->status && got.size == want->size && got.held == want->held &&
                            memcmp(got.bytes, want->bytes, got.size) == 0;
        answered_free(&got);
        if (i % 10 == 9) kept_drop(thread->meshes);
    }
    zr_arena_free(&arena);
    return NULL;
}

TEST(threads_share_meshes_and_drop_them)
{
    struct kept *meshes = open_meshes(3 << 20);
    struct answered want[SHARED];
    struct thread all[THREADS];
    pthread_t threads[THREADS];
    for (int i = 0; i < SHARED; i++)
        want[i] = ask_unkept(row_of(shared[i]), ARENA_BYTES);
    for (int i = 0; i < THREADS; i++) {
        all[i] = (struct thread){meshes, want, i, true};
        assert_int_equal(pthread_create(&threads[i], NULL, ask_often, &all[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_true(all[i].is_right);
    }
    assert_true(kept_look(meshes).hits > 0 && kept_look(meshes).dropped > 0);
    for (int i = 0; i < SHARED; i++)
        answered_free(&want[i]);
    kept_close(meshes);
}

RUN_TESTS(make_files, free_files)
