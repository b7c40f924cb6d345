/* encode.c - request: encodes each output of a frame, and puts several into one archive. */
#include "encode.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory_error.h"
#include "base/rgba.h"
#include "base/run.h"
#include "output/images/depth16.h"
#include "output/images/gif.h"
#include "output/images/lossy.h"
#include "output/images/png.h"
#include "output/images/tiff.h"
#include "output/info.h"
#include "output/json/fragments_json.h"
#include "output/json/trace_json.h"
#include "output/line_file.h"
#include "output/masks.h"
#include "output/npy.h"
#include "output/pfm.h"
#include "request/wall_picture.h"
#include "scene/looks.h"
#include "scene/output.h"
#include "scene/scene.h"
#include "scene/validate.h"
#include "shade/frame.h"

enum { ENCODERS_SIZE = 256 };

/* Inputs of encoding, and the results that the output info reports about the other outputs. */
struct encoding {
    const struct zr_run *run;
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    float depth_scale;                         /* scene units per step of 16-bit depth; 0: no such output */
    uint64_t clamped;                          /* pixels whose depth does not fit 16 bits */
    char *encoders;                            /* ENCODERS_SIZE bytes: of files made so far */
    const struct zr_drawing_warnings *drawing; /* NULL: made from the scene */
    struct zr_warning_list warnings;
};

/* Encodes as a PNG with the palette that it may have, as one that is always RGBA, or as a frame without a palette. */
static enum zr_status encode_color(const struct encoding *e, const struct zr_output *output, struct zr_buffer *out)
{
    const enum zr_encoding encoding = output->encoding;
    const bool has_alpha = encoding == ZR_ENCODING_PNG32 || e->scene->background.w < 1.0f;
    struct zr_png png = {.kind = has_alpha ? ZR_PNG_RGBA : ZR_PNG_RGB,
                         .width = e->frame->width,
                         .height = e->frame->height,
                         .pixels = e->frame->color,
                         .spans = e->frame->spans,
                         .compress = e->scene->compress,
                         .is_srgb = true,
                         .dpi = output->dpi,
                         .has_no_palette = encoding != ZR_ENCODING_PNG};
    return zr_png_write(&png, e->run->team, e->run->cancel, out);
}

static enum zr_status encode_wall(const struct encoding *e, const struct zr_output *output, struct zr_buffer *out)
{
    const struct zr_frame *frame = e->frame;
    const struct zr_png png = {
        .kind = ZR_PNG_RGB,
        .width = frame->width,
        .height = frame->height,
        .pixels = zr_wall_picture_make(e->run, frame->channels[ZR_CHANNEL_WALL], frame->width, frame->height),
        .dpi = output->dpi,
        .is_srgb = true,
        .compress = e->scene->compress};
    if (!png.pixels) return zr_is_cancelled(e->run->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
    return zr_png_write(&png, e->run->team, e->run->cancel, out);
}

/* Maps value * scale + offset, 0 .. 1, to 0 .. 255; uncovered pixels are black. */
static enum zr_status encode_triples(const struct encoding *e, const struct zr_output *output, float scale,
                                     float offset, struct zr_buffer *out)
{
    const struct zr_frame *frame = e->frame;
    const size_t pixels = (size_t)frame->width * frame->height;
    const float *n = frame->channels[output->channel];
    uint32_t *colors = zr_arena_alloc(e->run->arena, pixels, sizeof *colors);
    if (!colors) return ZR_NO_MEMORY;
    for (size_t i = 0; i < pixels; i++, n += 3) {
        const bool uncovered = n[0] == 0.0f && n[1] == 0.0f && n[2] == 0.0f;
        const zr_vec4 color = {n[0] * scale + offset, n[1] * scale + offset, n[2] * scale + offset, 1.0f};
        colors[i] = zr_rgba_opaque(uncovered ? (zr_vec4){0, 0, 0, 1} : color);
    }
    const struct zr_png png = {.kind = ZR_PNG_RGB,
                               .width = frame->width,
                               .height = frame->height,
                               .pixels = colors,
                               .spans = frame->spans,
                               .dpi = output->dpi,
                               .compress = e->scene->compress};
    return zr_png_write(&png, e->run->team, e->run->cancel, out);
}

/* Returns the channel's values, moved to 0 and +inf outside of the output's range. NULL without memory. */
static const void *find_values(const struct encoding *e, const struct zr_output *output)
{
    const float *depth = e->frame->channels[output->channel];
    const size_t pixels = (size_t)e->frame->width * e->frame->height;
    if (!output->has_range) return depth;
    float *out = zr_arena_alloc(e->run->arena, pixels, sizeof *out);
    for (size_t i = 0; out && i < pixels; i++)
        out[i] = depth[i] < output->range[0] ? 0.0f : depth[i] > output->range[1] ? INFINITY : depth[i];
    return out;
}

/* Returns the values of a channel, with infinity for uncovered pixels, as in depth. Their thickness is 0. */
static const float *values_for_steps(const struct encoding *e, enum zr_channel channel)
{
    const size_t pixels = (size_t)e->frame->width * e->frame->height;
    const float *values = e->frame->channels[channel];
    if (channel != ZR_CHANNEL_THICKNESS && channel != ZR_CHANNEL_WALL) return values;
    float *made = zr_arena_alloc(e->run->arena, pixels, sizeof *made);
    for (size_t i = 0; made && i < pixels; i++)
        made[i] = values[i] > 0.0f ? values[i] : INFINITY;
    return made;
}

static enum zr_status encode_depth16(struct encoding *e, const struct zr_output *output, struct zr_buffer *out)
{
    const struct zr_frame *frame = e->frame;
    const bool is_depth = output->channel == ZR_CHANNEL_DEPTH;
    struct zr_depth16 depth16 = {.frame = frame,
                                 .values = is_depth ? frame->depth : values_for_steps(e, output->channel),
                                 .spans = is_depth ? frame->spans : NULL,
                                 .scale = zr_depth16_scale(frame, output->scale),
                                 .range = output->has_range ? output->range : NULL,
                                 .quantize = zr_depth16_of(zr_team_isa(e->run->team))};
    if (!depth16.values) return ZR_NO_MEMORY;
    char comment[160];
    const int used = snprintf(comment, sizeof comment, "%s in scene units = value * %.9g; ",
                              zr_channel_rows[output->channel].name, (double)depth16.scale);
    if (output->has_range)
        snprintf(comment + used, sizeof comment - (size_t)used, "0 nearer than %.9g; 65535 farther than %.9g",
                 (double)output->range[0], (double)output->range[1]);
    else
        snprintf(comment + used, sizeof comment - (size_t)used, "0 where nothing is");
    const struct zr_png png = {.kind = ZR_PNG_GREY16,
                               .width = frame->width,
                               .height = frame->height,
                               .rows = zr_depth16_rows(&depth16),
                               .spans = depth16.spans,
                               .text = comment,
                               .dpi = output->dpi,
                               .compress = e->scene->compress};
    const enum zr_status status = zr_png_write(&png, e->run->team, e->run->cancel, out);
    if (is_depth) e->depth_scale = depth16.scale;
    e->clamped += depth16.clamped;
    return status;
}

/* Notes the encoder of a file, "libwebp 1.2.4; quality=80". */
static void note_encoder(struct encoding *e, const struct zr_output *output, uint32_t quality)
{
    const struct zr_webp_encoder webp = zr_webp_encoder();
    const char *name = output->encoding == ZR_ENCODING_JPEG ? zr_jpeg_encoder() : webp.text;
    const size_t used = strlen(e->encoders), room = ENCODERS_SIZE - used;
    const char *comma = used > 0 ? ", " : "";
    char made[64];
    if (output->is_lossless)
        snprintf(made, sizeof made, "%s%s; lossless", comma, name);
    else
        snprintf(made, sizeof made, "%s%s; quality=%u", comma, name, quality);
    if (strlen(made) < room) memcpy(e->encoders + used, made, strlen(made) + 1);
}

static enum zr_status encode_lossy(struct encoding *e, const struct zr_output *output, struct zr_buffer *out)
{
    const struct zr_lossy image = {
        .dpi = output->dpi,
        .width = e->frame->width,
        .height = e->frame->height,
        .rgba = (const uint8_t *)e->frame->color,
        .has_alpha =
            e->scene->background.w<1.0f, .is_lossless = output->is_lossless,
                                   .is_small = e->scene->compress == ZR_COMPRESS_SMALL, .quality = output->quality> 0
                ? output->quality
                : ZR_QUALITY_DEFAULT};
    zr_lossy_write_fn *write = output->encoding == ZR_ENCODING_JPEG ? zr_jpeg_write : zr_webp_write;
    const size_t most = output->max_bytes > 0 ? output->max_bytes : SIZE_MAX;
    struct zr_lossy_file file;
    const enum zr_status status = zr_lossy_fit(e->run, write, &image, most, &file);
    if (status != ZR_OK) return status;
    *out = (struct zr_buffer){e->run->arena, file.bytes, file.size, file.size};
    if (file.bytes) note_encoder(e, output, file.quality);
    return ZR_OK;
}

static enum zr_status encode_gif(const struct encoding *e, struct zr_buffer *out)
{
    const struct zr_gif gif = {.width = e->frame->width,
                               .height = e->frame->height,
                               .rgba = (const uint8_t *)e->frame->color,
                               .has_alpha = e->scene->background.w < 1.0f};
    return zr_gif_write(&gif, e->run->cancel, out);
}

/* Refuses a file of more bytes than the output allows. */
static enum zr_status check_size(const struct encoding *e, uint32_t number, size_t size)
{
    char pointer[48];
    const struct zr_output *output = &e->frame->view->outputs[number];
    if (output->max_bytes == 0 || size <= output->max_bytes) return ZR_OK;
    const bool is_lossy = zr_encoding_has(output->encoding, ZR_ENCODING_HAS_QUALITY) && !output->is_lossless;
    snprintf(pointer, sizeof pointer, "/outputs/%u/maxBytes", number);
    return zr_error_add(e->run->error, ZR_BAD_SCENE, pointer,
                        "%u bytes are too few for this picture, which has %zu%s; a smaller window takes fewer",
                        output->max_bytes, size, is_lossy ? " at the quality 1" : "");
}

static enum zr_status encode_output(struct encoding *e, const struct zr_output *output, struct zr_buffer *out)
{
    const struct zr_frame *f = e->frame;
    if (zr_is_cancelled(e->run->cancel)) return ZR_CANCELLED;
    const struct zr_channel_row *row = &zr_channel_rows[output->channel];
    const void *values;
    switch (output->encoding) {
    case ZR_ENCODING_PNG:
        if (output->channel == ZR_CHANNEL_NORMALS) return encode_triples(e, output, 0.5f, 0.5f, out);
        if (output->channel == ZR_CHANNEL_WALL) return encode_wall(e, output, out);
        if (output->channel == ZR_CHANNEL_POSITION) return encode_triples(e, output, 1.0f, 0.0f, out);
        return encode_color(e, output, out);
    case ZR_ENCODING_PNG16:
        return encode_depth16(e, output, out);
    case ZR_ENCODING_PNG32:
    case ZR_ENCODING_APNG: /* of one frame; views/ joins those of several views */
        return encode_color(e, output, out);
    case ZR_ENCODING_NPY:
    case ZR_ENCODING_TIFF:
        if (!(values = find_values(e, output))) return ZR_NO_MEMORY;
        if (output->encoding == ZR_ENCODING_TIFF) return zr_tiff_write(f->width, f->height, row->words, values, out);
        return zr_npy_write(row->values == ZR_VALUES_UINT32 ? ZR_NPY_UINT32 : ZR_NPY_FLOAT32, f->width, f->height,
                            row->words, values, out);
    case ZR_ENCODING_JSON:
        if (output->channel == ZR_CHANNEL_FRAGMENTS) return zr_fragments_json_write(e->scene, f, out);
        if (output->channel == ZR_CHANNEL_TRACE) return zr_trace_json_write(f->trace, e->run->cancel, out);
        if (output->channel == ZR_CHANNEL_MASKS) return zr_masks_json_write(e->scene, f, e->run->cancel, out);
        return zr_info_write(e->scene, f, e->depth_scale, e->clamped, &e->warnings, e->encoders, e->run->cancel, out);
    case ZR_ENCODING_SVG:
        return zr_line_file_write(e->scene, f, out) ? ZR_OK : ZR_NO_MEMORY;
    case ZR_ENCODING_PFM:
        if (!(values = find_values(e, output))) return ZR_NO_MEMORY;
        return zr_pfm_write(f->width, f->height, row->words, values, out);
    case ZR_ENCODING_JPEG:
    case ZR_ENCODING_WEBP:
        return encode_lossy(e, output, out);
    case ZR_ENCODING_GIF:
        return encode_gif(e, out);
    case ZR_ENCODING_ZIP:
        return zr_masks_zip_write(f, e->run->cancel, e->run->error, out);
    case ZR_ENCODING_COUNT:
        break;
    }
    return ZR_INTERNAL;
}

/* Returns the name of an output in an archive, channel.extension; NULL without memory. */
static const char *file_name(struct zr_arena *arena, const struct zr_output *output)
{
    enum { LONGEST = 64 };
    char *name = zr_arena_alloc(arena, LONGEST, 1);
    if (name)
        snprintf(name, LONGEST, "%s.%s", zr_channel_rows[output->channel].name,
                 zr_encoding_rows[output->encoding].ending);
    return name;
}

/* Collects the warnings of scene and frame, and of outputs encoded so far. */
static enum zr_status find_warnings(struct encoding *e)
{
    const struct zr_drawing_warnings made =
        e->drawing ? *e->drawing : zr_drawing_warnings_make(e->run->arena, e->scene, e->frame);
    e->warnings = zr_warnings_list(e->run->arena, &made, e->clamped);
    if (!zr_arena_ok(e->run->arena)) return ZR_NO_MEMORY;
    return zr_strict_check(e->scene, e->warnings.texts, e->warnings.count, e->run->error);
}

/* Encodes all outputs except info, then collects warnings, then encodes info, which reports them. */
static enum zr_status encode_all(struct encoding *e, struct zr_zip_entry *entries, const char **types)
{
    const struct zr_view *view = e->frame->view;
    for (int reports = 0; reports < 2; reports++) {
        for (uint32_t i = 0; i < view->output_count; i++) {
            const struct zr_output *output = &view->outputs[i];
            if ((output->channel == ZR_CHANNEL_INFO) != (reports == 1)) continue;
            struct zr_buffer out = {.arena = e->run->arena};
            enum zr_status status = encode_output(e, output, &out);
            if (status == ZR_OK) status = check_size(e, i, out.size);
            if (status != ZR_OK) return status;
            entries[i] = (struct zr_zip_entry){file_name(e->run->arena, output), out.bytes, out.size};
            types[i] = zr_encoding_rows[output->encoding].type;
        }
        if (reports) continue;
        const enum zr_status status = find_warnings(e);
        if (status != ZR_OK) return status;
    }
    return ZR_OK;
}

static const char *pin_look(struct zr_arena *arena, const struct zr_scene *scene)
{
    struct zr_look_pin *pin = zr_arena_alloc(arena, 1, sizeof *pin);
    if (!pin) return NULL;
    *pin = zr_look_pin_of(scene->look);
    return pin->text;
}

enum zr_status zr_files_join(struct zr_arena *arena, const struct zr_files *files, struct zr_answer *answer,
                             struct zr_error *error)
{
    const struct zr_zip_entry *entries = files->entries;
    answer->content_type = files->count == 1 ? files->types[0] : "application/zip";
    answer->bytes = entries[0].bytes;
    answer->size = entries[0].size;
    if (files->count == 1) return ZR_OK;
    struct zr_buffer out = {.arena = arena};
    size_t size;
    if (!zr_zip_size(entries, files->count, &size))
        return zr_error_add(error, ZR_BAD_SCENE, "/outputs",
                            "together they have 4 GiB or more, which is too much for one ZIP: ask for fewer at once");
    const enum zr_status status = zr_zip_write(entries, files->count, &out);
    answer->bytes = out.bytes;
    answer->size = out.size;
    return status;
}

/* Explains a failure that has no fault yet. */
static enum zr_status explain(const struct zr_arena *arena, enum zr_status status, struct zr_error *error)
{
    if (status == ZR_OK && !zr_arena_ok(arena)) status = ZR_NO_MEMORY;
    if (status == ZR_NO_MEMORY) zr_memory_error_add(error, arena, "encoding", "");
    if (status == ZR_CANCELLED) zr_error_add(error, status, NULL, "encoding was stopped before it was done");
    if (status == ZR_INTERNAL) zr_error_add(error, status, NULL, "an image could not be written");
    return status;
}

static enum zr_status make_files(struct encoding *e, struct zr_files *files)
{
    const uint32_t count = e->frame->view->output_count;
    enum zr_status status = e->scene->is_strict ? find_warnings(e) : ZR_OK; /* before images are compressed */
    struct zr_zip_entry *entries = zr_arena_alloc(e->run->arena, count, sizeof *entries);
    const char **types = zr_arena_alloc(e->run->arena, count, sizeof *types);
    e->encoders = zr_arena_zero(e->run->arena, ENCODERS_SIZE, 1);
    if (status == ZR_OK) status = entries && types && e->encoders ? encode_all(e, entries, types) : ZR_NO_MEMORY;
    *files = (struct zr_files){count, entries, types, e->warnings, e->encoders};
    return status;
}

enum zr_status zr_encode_files(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                               const struct zr_drawing_warnings *drawing, struct zr_files *files)
{
    struct encoding encoding = {
        .run = run,
        .scene = scene,
        .frame = frame,
        .drawing = drawing,
    };
    return explain(run->arena, make_files(&encoding, files), run->error);
}

enum zr_status zr_files_describe(struct zr_arena *arena, const struct zr_files *files, const struct zr_scene *scene,
                                 struct zr_answer *answer, struct zr_error *error)
{
    answer->warnings = zr_warnings_join(arena, &files->warnings);
    answer->warning_count = files->warnings.count;
    answer->look = pin_look(arena, scene);
    answer->encoders = files->encoders;
    return explain(arena, ZR_OK, error);
}

enum zr_status zr_files_answer(struct zr_arena *arena, const struct zr_files *files, const struct zr_scene *scene,
                               struct zr_answer *answer, struct zr_error *error)
{
    const enum zr_status status = zr_files_describe(arena, files, scene, answer, error);
    return status == ZR_OK ? explain(arena, zr_files_join(arena, files, answer, error), error) : status;
}

enum zr_status zr_encode(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                         struct zr_answer *answer)
{
    struct zr_files files;
    const enum zr_status status = zr_encode_files(run, scene, frame, NULL, &files);
    return status == ZR_OK ? zr_files_answer(run->arena, &files, scene, answer, run->error) : status;
}
