/* jpeg.c - output: colours as JPEG, by libjpeg.
 *
 * Colours have half the resolution of brightness below FINE_FROM; from there on, they have all of it. */
#include <setjmp.h>

#include "base/cancel.h"
#include "input/images/jpeg_memory.h"
#include "output/bytes/buffer.h"
#include "output/images/lossy.h"

#include <jerror.h>

enum { FINE_FROM = 90, ROOM = 1 << 16 };

/* Context of libjpeg's callbacks. */
struct writing {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_destination_mgr destination;
    struct jpeg_progress_mgr progress;
    struct zr_jpeg_memory memory;
    struct zr_buffer out;
    const struct zr_cancel *cancel;
    enum zr_status status;
    jmp_buf jump;
};

static _Noreturn void leave(struct writing *writing, enum zr_status status)
{
    writing->status = status;
    longjmp(writing->jump, 1);
}

static _Noreturn void take_error(j_common_ptr jpeg)
{
    leave(jpeg->client_data, jpeg->err->msg_code == JERR_OUT_OF_MEMORY ? ZR_NO_MEMORY : ZR_INTERNAL);
}

static void take_message(j_common_ptr jpeg, int level)
{
    (void)jpeg;
    (void)level;
}

static void print_nothing(j_common_ptr jpeg)
{
    (void)jpeg;
}

static void check_progress(j_common_ptr jpeg)
{
    struct writing *writing = jpeg->client_data;
    if (zr_is_cancelled(writing->cancel)) leave(writing, ZR_CANCELLED);
}

/* ---- destination ---- */

static void make_room(struct writing *writing)
{
    unsigned char *room = zr_buffer_room(&writing->out, ROOM);
    if (!room) leave(writing, ZR_NO_MEMORY);
    writing->destination.next_output_byte = room;
    writing->destination.free_in_buffer = ROOM;
}

static void begin_output(j_compress_ptr jpeg)
{
    make_room(jpeg->client_data);
}

static boolean flush_output(j_compress_ptr jpeg)
{
    struct writing *writing = jpeg->client_data;
    writing->out.size += ROOM;
    make_room(writing);
    return TRUE;
}

static void end_output(j_compress_ptr jpeg)
{
    struct writing *writing = jpeg->client_data;
    writing->out.size += ROOM - writing->destination.free_in_buffer;
}

/* ---- the picture ---- */

static void set_callbacks(struct writing *writing)
{
    writing->jpeg.err = jpeg_std_error(&writing->errors);
    writing->errors.error_exit = take_error;
    writing->errors.emit_message = take_message;
    writing->errors.output_message = print_nothing;
    writing->jpeg.client_data = writing;
    writing->progress.progress_monitor = check_progress;
    writing->destination = (struct jpeg_destination_mgr){
        .init_destination = begin_output, .empty_output_buffer = flush_output, .term_destination = end_output};
}

static void set_quality(struct jpeg_compress_struct *jpeg, uint32_t quality)
{
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, (int)quality, TRUE);
    jpeg->dct_method = JDCT_ISLOW;
    jpeg->optimize_coding = TRUE;
    jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = quality < FINE_FROM ? 2 : 1;
}

static void write_rows(struct jpeg_compress_struct *jpeg, const struct zr_lossy *image)
{
    jpeg_start_compress(jpeg, TRUE);
    while (jpeg->next_scanline < jpeg->image_height) {
        JSAMPROW row = (JSAMPROW)image->rgba + 4 * (size_t)image->width * jpeg->next_scanline;
        jpeg_write_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_compress(jpeg);
}

/* Errors jump back to the setjmp here, once. Only *writing and its targets change before the jump. */
static void run(struct writing *writing, struct zr_arena *scratch, const struct zr_lossy *image)
{
    struct jpeg_compress_struct *jpeg = &writing->jpeg;
    if (setjmp(writing->jump) != 0) return;
    jpeg_create_compress(jpeg);
    zr_jpeg_memory_begin(&writing->memory, scratch, (j_common_ptr)jpeg);
    jpeg->progress = &writing->progress;
    jpeg->dest = &writing->destination;
    jpeg->image_width = image->width;
    jpeg->image_height = image->height;
    jpeg->input_components = 4;
    jpeg->in_color_space = JCS_EXT_RGBX;
    set_quality(jpeg, image->quality);
    if (image->dpi > 0.0f) {
        jpeg->density_unit = 1;
        jpeg->X_density = jpeg->Y_density = (UINT16)image->dpi;
    }
    write_rows(jpeg, image);
}

enum zr_status zr_jpeg_write(struct zr_arena *arena, const struct zr_lossy *image, size_t most,
                             const struct zr_cancel *cancel, struct zr_lossy_file *file)
{
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    struct writing writing = {.out = {.arena = &scratch}, .cancel = cancel};
    set_callbacks(&writing);
    run(&writing, &scratch, image);
    zr_jpeg_memory_end(&writing.memory, (j_common_ptr)&writing.jpeg);
    jpeg_destroy_compress(&writing.jpeg);
    enum zr_status status = writing.status;
    *file = (struct zr_lossy_file){.size = writing.out.size, .quality = image->quality};
    if (status == ZR_NO_MEMORY) scratch.failed = true;
    return zr_lossy_end_try(arena, &scratch, &writing.out, most, status, file);
}

#define TEXT(word)     #word
#define TEXT_OF(macro) TEXT(macro)

const char *zr_jpeg_encoder(void)
{
#ifdef LIBJPEG_TURBO_VERSION
    return "libjpeg-turbo " TEXT_OF(LIBJPEG_TURBO_VERSION);
#else
    return "libjpeg " TEXT_OF(JPEG_LIB_VERSION);
#endif
}
