/* algorithm.h - scene: hidden-surface algorithms (raster/). All produce the same pixels. */
#ifndef ZR_ALGORITHM_H
#define ZR_ALGORITHM_H

/* ROW(ID, word); the first is the default: edge functions, tile by tile. */
#define ZR_ALGORITHMS(ROW)                                                                                             \
    ROW(HALFSPACE, "halfspace")                                                                                        \
    ROW(EDGELIST, "edgelist")                                                                                          \
    ROW(TRAPEZOID, "trapezoid")                                                                                        \
    ROW(SCANLINE, "scanline")                                                                                          \
    ROW(PAINTER, "painter")

enum zr_algorithm {
#define ROW(ID, word) ZR_ALGORITHM_##ID,
    ZR_ALGORITHMS(ROW)
#undef ROW
        ZR_ALGORITHM_COUNT
};

#endif
