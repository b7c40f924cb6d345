/* Paint of slicers on triangles of 3MF (paint_color, mmu_segmentation).
 *
 * Text:   hexadecimal digits, from the last to the first. A digit is a node of a tree: its lower two bits are the
 *         number of split sides, 0 for a leaf. The upper bits of a leaf are its extruder; 0 means the part's extruder.
 *         If they are 3, the extruder is the next digit plus 3. The upper bits of an inner node are the corner from
 *         which its sides are counted. A node with n split sides has n + 1 children, the last one first.
 * Source: PrusaSlicer 2.9, TriangleSelector::serialize and perform_split. */
#include "input/text/text.h"
#include "input/threemf/threemf_file.h"

enum { DEPTH_MAX = 64, EXTENDED = 3 };

/* A triangle to read, by its corners. */
struct piece {
    zr_vec4 corners[3];
};

struct reader {
    const char *at, *begin; /* digits before `at` are unread */
    struct piece stack[4 * DEPTH_MAX];
    size_t depth;
};

/* Returns the next digit, or -1. */
static int next_digit(struct reader *reader)
{
    return reader->at == reader->begin ? -1 : zr_hex_digit(*--reader->at);
}

static zr_vec4 middle(zr_vec4 a, zr_vec4 b)
{
    return (zr_vec4){a.x * 0.5f + b.x * 0.5f, a.y * 0.5f + b.y * 0.5f, a.z * 0.5f + b.z * 0.5f, 1};
}

/* Pushes the children of a triangle, the last one on top. */
static bool split(struct reader *reader, const struct piece *piece, int sides, int first)
{
    struct piece *out = &reader->stack[reader->depth];
    if (first > 2 || reader->depth + 4 > sizeof reader->stack / sizeof *reader->stack) return false;
    const zr_vec4 a = piece->corners[first], b = piece->corners[(first + 1) % 3], c = piece->corners[(first + 2) % 3];
    if (sides == 1) {
        const zr_vec4 bc = middle(b, c);
        out[0] = (struct piece){{a, b, bc}};
        out[1] = (struct piece){{bc, c, a}};
    } else if (sides == 2) {
        const zr_vec4 ab = middle(a, b), ca = middle(c, a);
        out[0] = (struct piece){{a, ab, ca}};
        out[1] = (struct piece){{ab, b, ca}};
        out[2] = (struct piece){{b, c, ca}};
    } else {
        const zr_vec4 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        out[0] = (struct piece){{a, ab, ca}};
        out[1] = (struct piece){{ab, b, bc}};
        out[2] = (struct piece){{bc, c, ca}};
        out[3] = (struct piece){{ab, bc, ca}};
    }
    reader->depth += (size_t)sides + 1;
    return true;
}

/* Reads the extruder of a leaf whose digit is given. -1 at the end of the text. */
static int read_leaf(struct reader *reader, int digit)
{
    int next = digit >> 2;
    if (next < EXTENDED) return next;
    for (int sum = EXTENDED;; sum += 15) {
        next = next_digit(reader);
        if (next < 0 || sum > 200) return -1;
        if (next < 15) return sum + next;
    }
}

uint32_t zr_threemf_paint_read(struct zr_xml_text text, const zr_vec4 corners[3], zr_vec4 *positions,
                               uint8_t *extruders)
{
    struct reader reader = {.at = text.at + text.length, .begin = text.at, .depth = 1};
    uint32_t count = 0;
    for (int i = 0; i < 3; i++)
        reader.stack[0].corners[i] = corners[i];
    while (reader.depth > 0) {
        const struct piece piece = reader.stack[--reader.depth];
        const int digit = next_digit(&reader);
        if (digit < 0) return 0;
        if (digit & 3) {
            if (!split(&reader, &piece, digit & 3, digit >> 2)) return 0;
            continue;
        }
        const int extruder = read_leaf(&reader, digit);
        if (extruder < 0) return 0;
        if (extruders) {
            extruders[count] = (uint8_t)extruder;
            for (int i = 0; i < 3; i++)
                positions[3 * (size_t)count + (size_t)i] = piece.corners[i];
        }
        count++;
    }
    return count;
}
