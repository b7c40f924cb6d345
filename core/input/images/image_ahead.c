#include "input/images/image_ahead.h"

#include "base/cancel.h"
#include "input/images/image_read.h"

/* A file while it is decoded. */
struct job {
    struct zr_image_file *file;
    struct zr_file_hash hash;
    struct zr_arena texels; /* in the request's memory */
    size_t scratch_bytes;   /* limit for decoding; files that need more are not decoded here */
    const struct zr_cancel *cancel;
};

/* Scratch memory per file: blocks, and the coefficients of a progressive JPEG. */
enum { SCRATCH_BYTES = 2 * ZR_ARENA_BLOCK, SCRATCH_PER_TEXEL = 8 };

static void decode(void *context, size_t begin, size_t end)
{
    struct job *jobs = context;
    for (size_t i = begin; i < end && !zr_is_cancelled(jobs[i].cancel); i++) {
        struct job *job = &jobs[i];
        struct zr_image_file *file = job->file;
        struct zr_arena scratch;
        struct zr_reason reason;
        zr_arena_init(&scratch, job->scratch_bytes);
        scratch.cancel = job->texels.cancel = job->cancel;
        const struct zr_encoded_image encoded = {file->bytes, file->size, file->kept.texels_max};
        file->is_decoded = zr_image_decode(&job->texels, &scratch, &encoded, &file->kept, &reason) == ZR_OK;
        zr_arena_free(&scratch);
    }
}

/* Allocates the texels. `before`: scratch bytes of the images before this one.
 * False if memory for all of them is not ample. */
static bool prepare(struct zr_arena *arena, const struct zr_image *head, size_t before, struct job *job)
{
    const size_t texels = (size_t)head->width * head->height, bytes = zr_image_bytes(head) + 2 * ZR_ARENA_BLOCK;
    job->scratch_bytes = SCRATCH_BYTES + SCRATCH_PER_TEXEL * texels;
    if (zr_arena_left(arena) / 2 < 2 * bytes + job->scratch_bytes + before) return false;
    const size_t room = zr_image_bytes(head) + 4 * ZR_ARENA_ALIGN;
    void *within = zr_arena_alloc(arena, room, 1);
    if (!within) return false;
    zr_arena_init_within(&job->texels, within, room);
    job->texels.ceiling = room + job->scratch_bytes; /* zr_arena_alloc_beside counts the scratch memory, too */
    return true;
}

/* True if the image is kept, and decoding it here would succeed, too. */
static bool take_kept(const struct zr_kept_images *images, struct job *job, uint64_t texels_max)
{
    struct zr_image_file *file = job->file;
    return images->find && images->find(images->context, file->bytes, file->size, &job->hash, &file->kept) &&
           file->kept.texels_max <= texels_max && file->kept.scratch_bytes <= job->scratch_bytes;
}

void zr_images_read_ahead(const struct zr_run *run, const struct zr_kept_images *images, uint64_t texels_max,
                          struct zr_image_file *files, size_t count)
{
    struct zr_arena *arena = run->arena;
    struct job *jobs = zr_arena_zero(arena, count, sizeof *jobs);
    size_t job_count = 0, scratch_bytes = 0;
    for (size_t i = 0; jobs && i < count && !zr_is_cancelled(arena->cancel); i++) {
        struct job *job = &jobs[job_count];
        const struct zr_encoded_image file = {files[i].bytes, files[i].size, texels_max};
        struct zr_image head;
        *job = (struct job){.file = &files[i], .cancel = arena->cancel};
        if (!zr_image_head_read(&file, &head) || !prepare(arena, &head, scratch_bytes, job)) break;
        scratch_bytes += job->scratch_bytes;
        files[i].is_decoded = take_kept(images, job, texels_max);
        if (!files[i].is_decoded) {
            files[i].kept.texels_max = texels_max;
            job_count++;
        }
        texels_max -= (uint64_t)head.width * head.height;
    }
    if (!jobs) return;
    zr_team_ranges(run->team, job_count, 1, decode, jobs);
    for (size_t i = 0; i < job_count && images->keep; i++)
        if (jobs[i].file->is_decoded) images->keep(images->context, &jobs[i].hash, &jobs[i].file->kept);
}
