/* What the server provides: the page of a run, or while it runs a page that follows it,
 * its state, the densities so far and the pictures of its scales. */
#ifndef VIEW_PAGES_H
#define VIEW_PAGES_H

#include "view/child.h"
#include "view/server.h"

typedef struct view_pages {
  const cli_child *child; /* its folder may be that of a finished run */
  const char *input;
} view_pages;

/* A give_answer function with `data` a view_pages. No other files of the folder are
 * served. */
void pages_give(cli_answer *out, const char *name, void *pages);

/* The page that follows a run: live.html, embedded by CMake. */
extern const size_t view_live_page_size;
extern const unsigned char view_live_page[];

#endif
