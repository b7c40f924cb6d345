/* annotate_words.h - scene: words of annotate, in the order of enum zr_annotation (scene/annotate.h), for readers and
 * the page of the daemon. */
#ifndef ZR_ANNOTATE_WORDS_H
#define ZR_ANNOTATE_WORDS_H

#define ZR_ANNOTATE_WORDS "box", "title", "triad", "scale", "labels", "holes"

#endif
