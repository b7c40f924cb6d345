/* Symbols of edgebreaker connectivity: as bits, or one list per valence of the active vertex. */
#include "input/codecs/draco_mesh.h"

enum { VALENCE_LEAST = 2, VALENCE_MOST = VALENCE_LEAST + ZR_DRACO_VALENCES - 1 };

static bool open_bits(struct zr_draco *draco, struct zr_draco_traversal *out)
{
    const uint64_t size = zr_draco_varint(&draco->stream);
    const unsigned char *bytes = zr_draco_take(&draco->stream, size);
    out->symbols = (struct zr_draco_bits){bytes, 0, 8 * size, false};
    return bytes;
}

static bool open_valences(struct zr_draco *draco, uint32_t vertices, struct zr_draco_traversal *out)
{
    out->context = ZR_DRACO_VALENCES;
    out->valences = zr_arena_zero(&draco->scratch, vertices, sizeof *out->valences);
    if (!out->valences) return false;
    for (int i = 0; i < ZR_DRACO_VALENCES; i++) {
        out->left[i] = zr_draco_count(&draco->stream);
        if (out->left[i] > draco->mesh->face_count) return false;
        out->of_valence[i] = zr_draco_numbers(draco, out->left[i]);
        if (!out->of_valence[i] ||
            !zr_draco_read_symbols(&draco->stream, &draco->scratch, draco->cancel, out->left[i], 1, out->of_valence[i]))
            return false;
    }
    return true;
}

bool zr_draco_traversal_open(struct zr_draco *draco, bool by_valence, uint32_t vertices, struct zr_draco_traversal *out)
{
    *out = (struct zr_draco_traversal){.by_valence = by_valence};
    if (!by_valence && !open_bits(draco, out)) return false;
    if (!zr_draco_flags_open(&draco->stream, &out->starts)) return false;
    for (uint32_t i = 0; i < draco->seam_count; i++)
        if (!zr_draco_flags_open(&draco->stream, &out->seams[i])) return false;
    return !by_valence || open_valences(draco, vertices, out);
}

enum zr_draco_symbol zr_draco_traversal_next(struct zr_draco_traversal *of)
{
    static const enum zr_draco_symbol long_ones[] = {ZR_DRACO_S, ZR_DRACO_L, ZR_DRACO_R, ZR_DRACO_E};
    if (!of->by_valence) {
        const bool is_long = zr_draco_bits_read(&of->symbols, 1);
        const enum zr_draco_symbol symbol = is_long ? long_ones[zr_draco_bits_read(&of->symbols, 2)] : ZR_DRACO_C;
        return of->symbols.is_broken ? ZR_DRACO_NO_SYMBOL : symbol;
    }
    if (of->context == ZR_DRACO_VALENCES) return ZR_DRACO_E;
    if (of->left[of->context] == 0) return ZR_DRACO_NO_SYMBOL;
    const uint32_t symbol = of->of_valence[of->context][--of->left[of->context]];
    return symbol <= ZR_DRACO_E ? (enum zr_draco_symbol)symbol : ZR_DRACO_NO_SYMBOL;
}

void zr_draco_traversal_add(struct zr_draco_traversal *of, enum zr_draco_symbol symbol, uint32_t tip, uint32_t next,
                            uint32_t previous)
{
    /* New edges at the vertices tip, next and previous. */
    static const uint8_t edges[][3] = {{0, 1, 1}, {0, 1, 1}, {1, 2, 1}, {1, 1, 2}, {2, 2, 2}};
    if (!of->by_valence) return;
    of->valences[tip] += edges[symbol][0];
    of->valences[next] += edges[symbol][1];
    of->valences[previous] += edges[symbol][2];
    const uint32_t valence = of->valences[next];
    of->context = (valence < VALENCE_LEAST  ? VALENCE_LEAST
                   : valence > VALENCE_MOST ? VALENCE_MOST
                                            : valence) -
                  VALENCE_LEAST;
}

void zr_draco_traversal_merge(struct zr_draco_traversal *of, uint32_t kept, uint32_t merged)
{
    if (of->by_valence) of->valences[kept] += of->valences[merged];
}
