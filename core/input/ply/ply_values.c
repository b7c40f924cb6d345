#include "input/ply/ply_file.h"

/* load_ID reads a value of type ID. */
#define LOAD(ID, name, newer, type)                                                                                    \
    ZR_INLINED double load_##ID(const char *at, bool is_swapped)                                                       \
    {                                                                                                                  \
        unsigned char bytes[sizeof(type)];                                                                             \
        type value;                                                                                                    \
        for (size_t i = 0; i < sizeof(type); i++)                                                                      \
            bytes[i] = (unsigned char)at[is_swapped ? sizeof(type) - 1 - i : i];                                       \
        memcpy(&value, bytes, sizeof value);                                                                           \
        return (double)value;                                                                                          \
    }
ZR_PLY_TYPE_ROWS(LOAD)
#undef LOAD

double zr_ply_value(const char *at, enum zr_ply_type type, bool is_swapped)
{
    switch (type) {
#define CASE(ID, ...)                                                                                                  \
    case ZR_PLY_##ID:                                                                                                  \
        return is_swapped ? load_##ID(at, true) : load_##ID(at, false);
        ZR_PLY_TYPE_ROWS(CASE)
#undef CASE
    case ZR_PLY_TYPES:
        break;
    }
    return 0.0;
}

void zr_ply_column(const char *at, size_t stride, size_t count, enum zr_ply_type type, bool is_swapped, double *out)
{
    switch (type) {
#define CASE(ID, ...)                                                                                                  \
    case ZR_PLY_##ID:                                                                                                  \
        if (is_swapped)                                                                                                \
            for (size_t i = 0; i < count; i++)                                                                         \
                out[i] = load_##ID(at + i * stride, true);                                                             \
        else                                                                                                           \
            for (size_t i = 0; i < count; i++)                                                                         \
                out[i] = load_##ID(at + i * stride, false);                                                            \
        break;
        ZR_PLY_TYPE_ROWS(CASE)
#undef CASE
    case ZR_PLY_TYPES:
        break;
    }
}
