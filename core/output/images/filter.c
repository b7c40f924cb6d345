#include "output/images/filter.h"

#include <string.h>
#ifdef __SSE2__
#include <tmmintrin.h>
#endif

/* ---- changed part of a row ---- */

/* memcmp does most of the work: 1920x1080 pixels take 0.2 ms in these steps, 0.6 in steps of 64 only, and 0.4 if the
 * last 64 bytes are searched as well. */
enum { STEP = 512, LAST_STEP = 64 };

struct zr_column_span zr_filter_span(enum zr_layout layout, const uint8_t *row, const uint8_t *above,
                                     struct zr_column_span bounds)
{
    size_t pixel = zr_layout_memory(layout), begin = bounds.begin * pixel, end = bounds.end * pixel, size = end;
    for (size_t step = STEP; step >= LAST_STEP; step /= STEP / LAST_STEP)
        while (begin + step <= size && memcmp(row + begin, above + begin, step) == 0)
            begin += step;
    for (size_t step = STEP; step >= LAST_STEP; step /= STEP / LAST_STEP)
        while (end >= begin + step && memcmp(row + end - step, above + end - step, step) == 0)
            end -= step;
    return (struct zr_column_span){(uint32_t)(begin / pixel), (uint32_t)(end / pixel)};
}

/* ---- differences ---- */

static void subtract_bytes(const uint8_t *restrict row, const uint8_t *restrict above, size_t size,
                           uint8_t *restrict out)
{
    for (size_t i = 0; i < size; i++) /* compilers vectorize this, sixteen bytes at a time */
        out[i] = (uint8_t)(row[i] - above[i]);
}

static void subtract_words(const uint8_t *restrict row, const uint8_t *restrict above, size_t count,
                           uint8_t *restrict out)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    for (size_t i = 0; i < count; i++) {
        uint16_t a, b;
        memcpy(&a, row + 2 * i, sizeof a);
        memcpy(&b, above + 2 * i, sizeof b);
        uint16_t low = (uint16_t)((a & 0xff) - (b & 0xff)), high = (uint16_t)((a >> 8) - (b >> 8));
        uint16_t word = (uint16_t)((high & 0xff) | low << 8); /* high byte first */
        memcpy(out + 2 * i, &word, sizeof word);
    }
#else
    subtract_bytes(row, above, 2 * count, out);
#endif
}

static void subtract_rgb_slowly(const uint8_t *row, const uint8_t *above, size_t count, uint8_t *out)
{
    for (; count > 0; count--, row += 4, above += 4, out += 3)
        for (int k = 0; k < 3; k++)
            out[k] = (uint8_t)(row[k] - above[k]);
}

#ifdef __SSE2__
/* Processes four pixels at a time: 1920x1080 pixels take 0.3 ms, with the loop above 2.0. */
__attribute__((target("ssse3"))) static size_t subtract_rgb_shuffled(const uint8_t *row, const uint8_t *above,
                                                                     size_t count, uint8_t *out)
{
    const __m128i pack = _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1);
    size_t done = 0;
    for (; done + 4 <= count; done += 4) {
        __m128i a = _mm_loadu_si128((const __m128i *)(row + 4 * done));
        __m128i b = _mm_loadu_si128((const __m128i *)(above + 4 * done));
        _mm_storeu_si128((__m128i *)(out + 3 * done), _mm_shuffle_epi8(_mm_sub_epi8(a, b), pack));
    }
    return done;
}
#endif

static void subtract_rgb(const uint8_t *row, const uint8_t *above, size_t count, uint8_t *out)
{
    size_t done = 0;
#ifdef __SSE2__
    if (__builtin_cpu_supports("ssse3")) done = subtract_rgb_shuffled(row, above, count, out);
#endif
    subtract_rgb_slowly(row + 4 * done, above + 4 * done, count - done, out + 3 * done);
}

/* ---- checksum ---- */

static void sum_slowly(const uint8_t *bytes, size_t size, struct zr_adler *sum)
{
    uint64_t a = 0, b = 0; /* for at most 2^23 bytes: below 2^54 */
    for (size_t i = 0; i < size; i++)
        b += a += bytes[i];
    zr_adler_add(sum, size, a, b);
}

#ifdef __SSE2__
/* Processes sixteen bytes at a time: a picture of 1920x1080 takes 0.2 ms, with zlib's adler32 2.2. */
enum { VECTOR = 16, VECTORS_PER_SUM = 16384 }; /* the lanes of `b` stay below 255 * 2 * (16 + 8) * 16384 < 2^32 */

static inline uint64_t sum_of_lanes(__m128i v)
{
    uint64_t lanes[2];
    _mm_storeu_si128((__m128i *)lanes, v);
    return lanes[0] + lanes[1];
}

static void sum_vectors(const uint8_t *bytes, size_t count, struct zr_adler *sum)
{
    const __m128i zero = _mm_setzero_si128();
    const __m128i low = _mm_setr_epi16(16, 15, 14, 13, 12, 11, 10, 9), high = _mm_setr_epi16(8, 7, 6, 5, 4, 3, 2, 1);
    __m128i a = zero, before = zero, b = zero;
    for (size_t i = 0; i < count; i++) {
        __m128i v = _mm_loadu_si128((const __m128i *)(bytes + i * VECTOR));
        before = _mm_add_epi64(before, a); /* earlier bytes count once more per vector */
        a = _mm_add_epi64(a, _mm_sad_epu8(v, zero));
        b = _mm_add_epi32(b, _mm_add_epi32(_mm_madd_epi16(_mm_unpacklo_epi8(v, zero), low),
                                           _mm_madd_epi16(_mm_unpackhi_epi8(v, zero), high)));
    }
    __m128i wide = _mm_add_epi64(_mm_unpacklo_epi32(b, zero), _mm_unpackhi_epi32(b, zero));
    zr_adler_add(sum, count * VECTOR, sum_of_lanes(a), sum_of_lanes(before) * VECTOR + sum_of_lanes(wide));
}

static void sum_bytes(const uint8_t *bytes, size_t size, struct zr_adler *sum)
{
    for (size_t some; size >= VECTOR; bytes += some * VECTOR, size -= some * VECTOR) {
        some = size / VECTOR < VECTORS_PER_SUM ? size / VECTOR : VECTORS_PER_SUM;
        sum_vectors(bytes, some, sum);
    }
    sum_slowly(bytes, size, sum);
}
#else
static void sum_bytes(const uint8_t *bytes, size_t size, struct zr_adler *sum)
{
    sum_slowly(bytes, size, sum);
}
#endif

void zr_filter_row(enum zr_layout layout, const uint8_t *row, const uint8_t *above, uint32_t width,
                   struct zr_column_span bounds, uint8_t *out, struct zr_adler *sum)
{
    const size_t memory = zr_layout_memory(layout), file = zr_layout_file(layout);
    const struct zr_column_span span = zr_filter_span(layout, row, above, bounds);
    size_t count = span.end - span.begin, lead = span.begin * file, tail = (width - span.end) * file;
    *out++ = ZR_FILTER_UP;
    zr_adler_add(sum, 1, ZR_FILTER_UP, ZR_FILTER_UP);
    memset(out, 0, lead);
    zr_adler_add(sum, lead, 0, 0);
    row += span.begin * memory;
    above += span.begin * memory;
    out += lead;
    if (layout == ZR_LAYOUT_RGB)
        subtract_rgb(row, above, count, out);
    else if (layout == ZR_LAYOUT_16)
        subtract_words(row, above, count, out);
    else
        subtract_bytes(row, above, count * memory, out);
    sum_bytes(out, count * file, sum);
    memset(out + count * file, 0, tail);
    zr_adler_add(sum, tail, 0, 0);
}
