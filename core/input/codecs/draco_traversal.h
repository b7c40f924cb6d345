/* draco_traversal.h - input: the symbols of edgebreaker connectivity; private to the decoder of Draco meshes. */
#ifndef ZR_DRACO_TRAVERSAL_H
#define ZR_DRACO_TRAVERSAL_H

#include "input/codecs/draco_mesh.h"

/* The sides at which a new face meets faces that are decoded: both, both after a split, left, right, none. */
enum zr_draco_symbol { ZR_DRACO_C, ZR_DRACO_S, ZR_DRACO_L, ZR_DRACO_R, ZR_DRACO_E, ZR_DRACO_NO_SYMBOL };

enum { ZR_DRACO_VALENCES = 6 };

struct zr_draco_traversal {
    bool by_valence;
    struct zr_draco_bits symbols;            /* if not by_valence */
    uint32_t *of_valence[ZR_DRACO_VALENCES]; /* symbols of each context, read from their ends */
    uint32_t left[ZR_DRACO_VALENCES];
    uint32_t *valences;           /* per vertex, of the faces so far */
    uint32_t context;             /* of the next symbol; ZR_DRACO_VALENCES: it is E */
    struct zr_draco_flags starts; /* a component starts at a face inside */
    struct zr_draco_flags seams[ZR_DRACO_ATTRIBUTES];
};

/* Reads the start of all codes. `vertices`: the most vertices that the faces may make. */
bool zr_draco_traversal_open(struct zr_draco *draco, bool by_valence, uint32_t vertices,
                             struct zr_draco_traversal *out);

/* Returns the next symbol, or ZR_DRACO_NO_SYMBOL. */
enum zr_draco_symbol zr_draco_traversal_next(struct zr_draco_traversal *of);

/* Counts the valences of the vertices of a new face. tip: the vertex opposite to the active edge. */
void zr_draco_traversal_add(struct zr_draco_traversal *of, enum zr_draco_symbol symbol, uint32_t tip, uint32_t next,
                            uint32_t previous);

/* Adds the valence of a vertex to that of the vertex that replaces it. */
void zr_draco_traversal_merge(struct zr_draco_traversal *of, uint32_t kept, uint32_t merged);

#endif
