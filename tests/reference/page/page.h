/* page.h - reference: one section of the report page, for a person to read and to look at.
 *
 * Each run of the program writes its section to a file of its own, and its line of the summary to
 * FILE.row; all.sh puts them together. Pictures are in the page itself.
 */
#ifndef ZR_TEST_PAGE_H
#define ZR_TEST_PAGE_H

#include "reference/harness.h"

struct page;

struct page_options {
    const char *path, *title;
    const char *renderer; /* the reference's name */
    enum compare_bar bar;
    bool plain; /* pictures of differences only */
};

/* Ends the program where there is no memory. */
struct page *page_open(const struct page_options *options);
/* Writes the files; false, explained on stderr, where that fails. `page` may be NULL. */
bool page_close(struct page *page, enum verdict verdict, const struct tally *total);

void page_row(struct page *page, const char *name, enum verdict verdict, const struct tally *tally);
void page_refused(struct page *page, const char *name, const char *reason);

/* A picture in the gallery: ours, and where the sides differ, the reference's and the difference too.
 * Figures with the same caption, one after the other, stand together. */
void page_picture(struct page *page, const char *caption, enum verdict verdict,
                  const struct harness_pictures *pictures);

#endif
