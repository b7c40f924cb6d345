/* Reads attributes of 3MF: numbers, transforms, colours. */
#include <string.h>

#include "input/text/number.h"
#include "input/threemf/threemf_file.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static struct zr_xml_text trimmed(struct zr_xml_text text)
{
    while (text.length > 0 && is_blank(*text.at))
        text.at++, text.length--;
    while (text.length > 0 && is_blank(text.at[text.length - 1]))
        text.length--;
    return text;
}

bool zr_threemf_number(const struct zr_xml *xml, struct zr_xml_text text, double *out)
{
    const char *end = text.at + text.length;
#ifdef __SSE2__
    if (xml->end - text.at >= ZR_QUICKER_BYTES && zr_number_quicker(text.at, out) == end) return true;
#else
    (void)xml;
#endif
    const struct zr_xml_text word = trimmed(text);
    end = word.at + word.length;
    if (word.length == 0) return false;
    const char *behind = zr_number_quick(word.at, end, out);
    return behind == end || zr_number_read(word.at, end, out) == end;
}

bool zr_threemf_digits(struct zr_xml_text text, uint32_t *out)
{
    uint64_t value = 0;
    if (text.length == 0) return false;
    if ((unsigned char)(*text.at - '0') > 9) text = trimmed(text);
    const char *at = text.at, *const end = at + text.length;
    for (; at < end && (unsigned char)(*at - '0') < 10; at++)
        if (value < UINT32_MAX) value = value * 10 + (uint64_t)(*at - '0');
    while (at < end && is_blank(*at))
        at++;
    *out = value < UINT32_MAX ? (uint32_t)value : UINT32_MAX - 1;
    return text.length > 0 && at == end && (unsigned char)(*text.at - '0') < 10;
}

bool zr_threemf_count(struct zr_threemf *file, const char *name, bool is_needed, uint32_t *out)
{
    const struct zr_xml_text value = zr_xml_value(&file->tag, name);
    if (!value.at) return !is_needed || zr_threemf_fault(file, file->tag.at, "the attribute %s is missing", name);
    if (zr_threemf_digits(value, out)) return true;
    return zr_threemf_fault(file, file->tag.at, "%s: a whole number is needed, not %s", name,
                            zr_quote(value.at, value.length).text);
}

/* Twelve numbers: a matrix of four rows and three columns, for row vectors. */
bool zr_threemf_transform(struct zr_threemf *file, zr_mat4 *out, double offset[3])
{
    const struct zr_xml_text value = zr_xml_value(&file->tag, "transform");
    *out = zr_mat4_identity();
    offset[0] = offset[1] = offset[2] = 0.0;
    if (!value.at) return true;
    const char *at = value.at, *const end = at + value.length;
    for (int i = 0; i < 12; i++) {
        double number;
        while (at < end && is_blank(*at))
            at++;
        const char *behind = zr_number_read(at, end, &number);
        if (!behind || (behind < end && !is_blank(*behind)))
            return zr_threemf_fault(file, file->tag.at, "transform: 12 numbers are needed, not %s",
                                    zr_quote(value.at, value.length).text);
        if (!(number >= -(double)ZR_MATRIX_MAX && number <= (double)ZR_MATRIX_MAX))
            return zr_threemf_fault(file, file->tag.at, "transform: %s is beyond %g",
                                    zr_quote(at, (size_t)(behind - at)).text, (double)ZR_MATRIX_MAX);
        out->m[i / 3 * 4 + i % 3] = (float)number;
        if (i >= 9) offset[i - 9] = number;
        at = behind;
    }
    while (at < end && is_blank(*at))
        at++;
    return at == end || zr_threemf_fault(file, file->tag.at, "transform: more than 12 numbers");
}

/* #RRGGBB or #RRGGBBAA. */
bool zr_threemf_color(struct zr_threemf *file, const char *name, uint32_t *out)
{
    const struct zr_xml_text value = zr_xml_value(&file->tag, name);
    if (!value.at) return zr_threemf_fault(file, file->tag.at, "the attribute %s is missing", name);
    const struct zr_xml_text word = trimmed(value);
    bool good = (word.length == 7 || word.length == 9) && *word.at == '#';
    *out = 0xFF000000u;
    for (size_t i = 1; good && i < word.length; i += 2) {
        const int high = zr_hex_digit(word.at[i]), low = zr_hex_digit(word.at[i + 1]);
        const unsigned shift = (unsigned)(i - 1) * 4;
        good = high >= 0 && low >= 0;
        if (good) *out = (*out & ~(0xFFu << shift)) | (uint32_t)(high * 16 + low) << shift;
    }
    return good || zr_threemf_fault(file, file->tag.at, "%s: #RRGGBB or #RRGGBBAA is needed, not %s", name,
                                    zr_quote(value.at, value.length).text);
}
