#include "scene/encodings.h"

#define ROW(ID, word, ending, spelling, type, noun, properties, side_max, cost, text)                                  \
    {word, ending, spelling, type, noun, properties, side_max, text},
const struct zr_encoding_row zr_encoding_rows[ZR_ENCODING_COUNT] = {ZR_ENCODING_ROWS(ROW)};
