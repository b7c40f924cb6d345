/* part_labels.h - overlay: names of parts in a column at the right, with leader lines.
 *
 * Anchor: of the pixels of a part that lie at least 2.2 heights of capitals inside of it, or as deep as it is, the
 *         rightmost one, and of several the topmost.
 * Column: names in the order of their anchors, at least 2.3 heights of capitals apart, as near to the anchors as that
 *         allows. Leaders do not cross each other; they may cross lines of dimensions.
 * Many:   more parts than lines get numbers instead, and the column has a table of
 *         them, as far as it has room. All of it is a part of the channel info. */
#ifndef ZR_PART_LABELS_H
#define ZR_PART_LABELS_H

#include "overlay/annotate/layout.h"

/* Places the labels of visible parts. *numbered: in `arena`; NULL and 0 if names are drawn. */
void zr_part_labels_place(struct zr_layout *layout, const struct zr_numbered_part **numbered, uint32_t *count);

#endif
