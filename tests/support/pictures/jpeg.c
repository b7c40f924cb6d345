#include "support/pictures/jpeg.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

#include <jpeglib.h>

/* State that must stay in memory when libjpeg jumps out on an error. */
struct errors {
    struct jpeg_error_mgr manager;
    jmp_buf jump;
    uint8_t *bytes; /* written, or read */
    unsigned long count;
};

static void leave(j_common_ptr jpeg)
{
    longjmp(((struct errors *)(void *)jpeg->err)->jump, 1);
}

static struct jpeg_error_mgr *set_errors(struct errors *errors)
{
    jpeg_std_error(&errors->manager);
    errors->manager.error_exit = leave;
    return &errors->manager;
}

static size_t channels_of(const struct jpeg_kind *kind)
{
    return kind->colors == JPEG_GREY ? 1 : kind->colors < JPEG_CMYK ? 3 : 4;
}

/* ---- writing ---- */

static void set_colors(struct jpeg_compress_struct *jpeg, const struct jpeg_kind *kind)
{
    static const J_COLOR_SPACE given[] = {JCS_GRAYSCALE, JCS_RGB, JCS_RGB, JCS_CMYK, JCS_CMYK};
    static const J_COLOR_SPACE kept[] = {JCS_GRAYSCALE, JCS_YCbCr, JCS_RGB, JCS_CMYK, JCS_YCCK};
    jpeg->in_color_space = given[kind->colors];
    jpeg->input_components = (int)channels_of(kind);
    jpeg_set_defaults(jpeg);
    jpeg_set_colorspace(jpeg, kept[kind->colors]);
    jpeg_set_quality(jpeg, kind->quality, TRUE);
    jpeg->comp_info[0].h_samp_factor = kind->across;
    jpeg->comp_info[0].v_samp_factor = kind->down;
}

enum { COEFFICIENTS = 64, REFINEMENTS = 4, SCANS = 1 + (COEFFICIENTS - 1) * REFINEMENTS };

static void refine(jpeg_scan_info scans[SCANS])
{
    *scans++ = (jpeg_scan_info){.comps_in_scan = 1};
    for (int k = 1; k < COEFFICIENTS; k++)
        for (int bit = REFINEMENTS - 1; bit >= 0; bit--)
            *scans++ = (jpeg_scan_info){
                .comps_in_scan = 1, .Ss = k, .Se = k, .Ah = bit == REFINEMENTS - 1 ? 0 : bit + 1, .Al = bit};
}

static void write_rows(struct jpeg_compress_struct *jpeg, const struct jpeg_kind *kind, const uint8_t *pixels)
{
    jpeg_scan_info scans[SCANS];
    if (kind->is_progressive) jpeg_simple_progression(jpeg);
    if (kind->has_refinements) {
        refine(scans);
        jpeg->scan_info = scans;
        jpeg->num_scans = SCANS;
    }
    jpeg->restart_in_rows = kind->restart_rows;
    jpeg->arith_code = kind->is_arithmetic;
    jpeg_start_compress(jpeg, TRUE);
    for (size_t stride = jpeg->image_width * channels_of(kind); jpeg->next_scanline < jpeg->image_height;) {
        JSAMPROW row = (JSAMPROW)(uintptr_t)(pixels + jpeg->next_scanline * stride);
        jpeg_write_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_compress(jpeg);
}

uint8_t *jpeg_memory_write(const struct jpeg_kind *kind, const uint8_t *pixels, uint32_t width, uint32_t height,
                           size_t *size)
{
    struct errors errors;
    struct jpeg_compress_struct jpeg = {.err = set_errors(&errors)};
    errors.bytes = NULL;
    errors.count = 0;
    if (setjmp(errors.jump) == 0) {
        jpeg_create_compress(&jpeg);
        jpeg_mem_dest(&jpeg, &errors.bytes, &errors.count);
        jpeg.image_width = width;
        jpeg.image_height = height;
        set_colors(&jpeg, kind);
        write_rows(&jpeg, kind, pixels);
        *size = errors.count;
    } else {
        free(errors.bytes);
        errors.bytes = NULL;
    }
    jpeg_destroy_compress(&jpeg);
    return errors.bytes;
}

/* ---- reading ---- */

uint8_t *jpeg_memory_read(const void *bytes, size_t size, uint32_t *width, uint32_t *height, uint32_t *channels)
{
    struct errors errors;
    struct jpeg_decompress_struct jpeg = {.err = set_errors(&errors)};
    errors.bytes = NULL;
    if (setjmp(errors.jump) == 0) {
        jpeg_create_decompress(&jpeg);
        jpeg_mem_src(&jpeg, bytes, size);
        jpeg_read_header(&jpeg, TRUE);
        jpeg_start_decompress(&jpeg);
        *width = jpeg.output_width;
        *height = jpeg.output_height;
        *channels = (uint32_t)jpeg.output_components;
        const size_t stride = (size_t)*width * *channels;
        errors.bytes = malloc(stride * *height);
        while (errors.bytes && jpeg.output_scanline < jpeg.output_height) {
            JSAMPROW row = errors.bytes + jpeg.output_scanline * stride;
            jpeg_read_scanlines(&jpeg, &row, 1);
        }
        jpeg_finish_decompress(&jpeg);
    } else {
        free(errors.bytes);
        errors.bytes = NULL;
    }
    jpeg_destroy_decompress(&jpeg);
    return errors.bytes;
}
