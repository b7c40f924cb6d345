/* title_block.h - drawing: frame, centring marks and title block of the paper.
 *
 * Form:   ISO 5457: frame 0.7 mm, centring marks that reach 5 mm into it. ISO 7200: a title block 180 mm wide. The symbol
 *         of the projection is that of ISO 5456-2: a truncated cone and its circles. */
#ifndef ZR_TITLE_BLOCK_H
#define ZR_TITLE_BLOCK_H

#include "drawing/page.h"
#include "drawing/plot.h"

/* Texts in UTF-8; "": an empty field. Too long ones are made smaller, and then cut. */
struct zr_title_texts {
    const char *title, *scale, *unit, *size, *date;
};

/* Adds groups "frame" and "title". */
void zr_title_block_add(struct zr_plot *plot, const struct zr_page *page, const struct zr_title_texts *texts);

#endif
