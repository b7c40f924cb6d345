#include "input/images/image_file.h"

#include <inttypes.h>
#include <setjmp.h>
#include <string.h>

#include "base/cancel.h"
#include "input/images/jpeg_memory.h"

#include <jerror.h>

/* Limits of scans. A progressive file refines each of three channels bit by bit, and encoders make far fewer scans than
 * SCANS_MAX. Each scan visits the whole picture, however few bytes it has. So scans * texels is limited too, to
 * SCANS_OF_LARGEST scans of the largest picture. Arithmetic coding takes four times as long. */
enum { SCANS_MAX = 200, SCANS_OF_LARGEST = 16, ARITHMETIC_TIMES = 4 };

/* Context of libjpeg's callbacks. */
struct reading {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_source_mgr source;
    struct jpeg_progress_mgr progress;
    struct zr_jpeg_memory memory;
    struct zr_arena *arena, *scratch;
    struct zr_reason *reason;
    uint64_t texels_max;
    enum zr_status status;
    jmp_buf jump;
};

static struct reading *reading_of(j_common_ptr jpeg)
{
    return jpeg->client_data;
}

static _Noreturn void leave(struct reading *reading, enum zr_status status)
{
    reading->status = status;
    longjmp(reading->jump, 1);
}

/* ---- libjpeg's errors ---- */

static _Noreturn void take_error(j_common_ptr jpeg)
{
    struct reading *reading = reading_of(jpeg);
    char text[JMSG_LENGTH_MAX];
    if (jpeg->err->msg_code == JERR_OUT_OF_MEMORY) {
        reading->scratch->failed = true; /* also if malloc failed, before libjpeg used the arena */
        leave(reading, ZR_NO_MEMORY);
    }
    jpeg->err->format_message(jpeg, text);
    zr_reason_give(reading->reason, "a broken JPEG: %s", text);
    leave(reading, ZR_BAD_SCENE);
}

/* Warnings (level < 0) mean a broken picture; other messages are only traces. */
static void take_message(j_common_ptr jpeg, int level)
{
    if (level < 0) take_error(jpeg);
}

static void print_nothing(j_common_ptr jpeg)
{
    (void)jpeg;
}

static void reset_errors(j_common_ptr jpeg)
{
    jpeg->err->msg_code = 0;
}

static void set_errors(struct reading *reading)
{
    reading->jpeg.err = jpeg_std_error(&reading->errors);
    reading->errors.error_exit = take_error;
    reading->errors.emit_message = take_message;
    reading->errors.output_message = print_nothing;
    reading->errors.reset_error_mgr = reset_errors;
    reading->jpeg.client_data = reading;
}

/* ---- source ---- */

static void do_nothing(j_decompress_ptr jpeg)
{
    (void)jpeg;
}

static boolean end_early(j_decompress_ptr jpeg)
{
    struct reading *reading = jpeg->client_data;
    zr_reason_give(reading->reason, "a broken JPEG: it ends too early");
    leave(reading, ZR_BAD_SCENE);
}

static void skip(j_decompress_ptr jpeg, long count)
{
    if (count <= 0) return;
    if ((unsigned long)count > jpeg->src->bytes_in_buffer) end_early(jpeg);
    jpeg->src->next_input_byte += count;
    jpeg->src->bytes_in_buffer -= (size_t)count;
}

static void set_source(struct reading *reading, const void *bytes, size_t size)
{
    reading->source = (struct jpeg_source_mgr){.next_input_byte = bytes,
                                               .bytes_in_buffer = size,
                                               .init_source = do_nothing,
                                               .fill_input_buffer = end_early,
                                               .skip_input_data = skip,
                                               .resync_to_restart = jpeg_resync_to_restart,
                                               .term_source = do_nothing};
    reading->jpeg.src = &reading->source;
}

/* ---- the picture ---- */

static void check_progress(j_common_ptr common)
{
    struct reading *reading = reading_of(common);
    if (zr_is_cancelled(reading->arena->cancel)) leave(reading, ZR_CANCELLED);
    const struct jpeg_decompress_struct *jpeg = &reading->jpeg;
    const uint64_t texels = (uint64_t)jpeg->image_width * jpeg->image_height;
    const uint64_t times = (uint64_t)jpeg->input_scan_number * (jpeg->arith_code ? ARITHMETIC_TIMES : 1);
    if (jpeg->input_scan_number > SCANS_MAX)
        zr_reason_give(reading->reason, "a JPEG of more than %d scans", SCANS_MAX);
    else if (texels * times > SCANS_OF_LARGEST * reading->texels_max)
        zr_reason_give(reading->reason,
                       "a JPEG of %u x %u texels in %d scans or more%s; up to %" PRIu64
                       " texels in all scans together are allowed, %d times the rest of imagePixelsMax",
                       jpeg->image_width, jpeg->image_height, jpeg->input_scan_number,
                       jpeg->arith_code ? ", of arithmetic coding, which count four times" : "",
                       SCANS_OF_LARGEST * reading->texels_max, (int)SCANS_OF_LARGEST);
    else
        return;
    leave(reading, ZR_BAD_SCENE);
}

static void check_kind(struct reading *reading)
{
    const struct jpeg_decompress_struct *jpeg = &reading->jpeg;
    if (jpeg->data_precision != 8)
        zr_reason_give(reading->reason, "a JPEG of %d bits per channel; 8 are read", jpeg->data_precision);
    else if (jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK)
        zr_reason_give(reading->reason, "a JPEG in CMYK, the colours of print; grey, RGB and YCbCr are read");
    else if (jpeg->jpeg_color_space != JCS_GRAYSCALE && jpeg->jpeg_color_space != JCS_YCbCr &&
             jpeg->jpeg_color_space != JCS_RGB)
        zr_reason_give(reading->reason, "a JPEG of %d channels; grey, RGB and YCbCr are read", jpeg->num_components);
    else
        return;
    leave(reading, ZR_BAD_SCENE);
}

static void set_output(struct jpeg_decompress_struct *jpeg)
{
    jpeg->out_color_space = JCS_EXT_RGBA;
    jpeg->dct_method = JDCT_ISLOW;
    jpeg->do_fancy_upsampling = TRUE;
    jpeg->do_block_smoothing = FALSE; /* differs between versions of libjpeg */
}

static void read_rows(struct reading *reading, uint8_t *rgba)
{
    struct jpeg_decompress_struct *jpeg = &reading->jpeg;
    jpeg_start_decompress(jpeg);
    while (jpeg->output_scanline < jpeg->output_height) {
        JSAMPROW row = rgba + (size_t)jpeg->output_scanline * jpeg->output_width * 4;
        jpeg_read_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_decompress(jpeg);
}

static void read_picture(struct reading *reading, struct zr_image *image)
{
    struct jpeg_decompress_struct *jpeg = &reading->jpeg;
    jpeg_read_header(jpeg, TRUE);
    check_kind(reading);
    if (!zr_image_fits(jpeg->image_width, jpeg->image_height, reading->texels_max, reading->reason))
        leave(reading, ZR_BAD_SCENE);
    const size_t texels = (size_t)jpeg->image_width * jpeg->image_height;
    uint8_t *rgba = zr_arena_alloc_beside(reading->arena, reading->scratch, texels, 4);
    if (!rgba) leave(reading, ZR_NO_MEMORY);
    *image = (struct zr_image){jpeg->image_width, jpeg->image_height, 8, rgba, NULL};
    set_output(jpeg);
    read_rows(reading, rgba);
}

bool zr_jpeg_looks_so(const void *bytes, size_t size)
{
    return size >= 3 && memcmp(bytes, "\xFF\xD8\xFF", 3) == 0;
}

bool zr_jpeg_size_read(const void *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    enum { FRAME_HEADER = 9 }; /* marker, length, precision, height, width */
    const unsigned char *at = bytes;
    if (!zr_jpeg_looks_so(bytes, size)) return false;
    for (size_t i = 2; size - i >= FRAME_HEADER && at[i] == 0xFF;) {
        const unsigned marker = at[i + 1];
        if (marker == 0xFF) { /* fill byte */
            i++;
            continue;
        }
        /* SOF0 to SOF15, except DHT, JPG and DAC */
        if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) {
            *height = (uint32_t)at[i + 5] << 8 | at[i + 6];
            *width = (uint32_t)at[i + 7] << 8 | at[i + 8];
            return true;
        }
        const size_t length = 2 + ((size_t)at[i + 2] << 8 | at[i + 3]);
        if (length > size - i) return false;
        i += length;
    }
    return false;
}

/* Decodes the picture; errors jump back to the setjmp here, once. Only *reading and its targets change before the
 * jump. */
static void run(struct reading *reading, const struct zr_encoded_image *file, struct zr_image *image)
{
    if (setjmp(reading->jump) != 0) return;
    jpeg_create_decompress(&reading->jpeg);
    zr_jpeg_memory_begin(&reading->memory, reading->scratch, (j_common_ptr)&reading->jpeg);
    set_source(reading, file->bytes, file->size);
    reading->progress.progress_monitor = check_progress;
    reading->jpeg.progress = &reading->progress;
    read_picture(reading, image);
}

enum zr_status zr_jpeg_read(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                            struct zr_image *image, struct zr_reason *reason)
{
    struct reading reading = {.arena = arena, .scratch = scratch, .reason = reason, .texels_max = file->texels_max};
    set_errors(&reading);
    run(&reading, file, image);
    zr_jpeg_memory_end(&reading.memory, (j_common_ptr)&reading.jpeg);
    jpeg_destroy_decompress(&reading.jpeg);
    return reading.status;
}
